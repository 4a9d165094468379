"use strict";

// Typed equations as mathematics: 3/2*m*a_x = F - f, N = m*g*cos(phi), \frac{1}{2} m v^2. A text that cannot be parsed,
// as an incomplete line, is shown unchanged.

const relations = ["<=", ">=", "==", "=", "<", ">"];
const functions = ["sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "exp", "log", "abs", "sign", "min", "max"];

// Split a text into words, numbers and signs; \left and \right are ignored.
function tokensOf(text) {
  const word = "\\\\?[A-Za-z\\u0370-\\u03ff][\\w.\\u0370-\\u03ff]*'*", number = "[0-9]+\\.?[0-9]*(?:[eE][-+]?[0-9]+)?|\\.[0-9]+";
  const tokens = new RegExp(`${word}|${number}|<=|>=|==|\\\\[,; ]|\\S`, "g");
  return [...text.replace(/\\(left|right)\b/g, "").matchAll(tokens)].map(([token]) => token).filter((token) => !/^\\[,; ]$/.test(token));
}

// A reader of tokens; each rule returns a tree {is, of: [...]}.
class Reader {
  constructor(tokens) { Object.assign(this, { tokens, at: 0 }); }

  get next() { return this.tokens[this.at]; }

  is(...signs) { return signs.includes(this.next); }

  take() { return this.tokens[this.at++]; }

  need(token) { if (this.take() !== token) throw new SyntaxError(token); }

  group(open, close) {
    this.need(open);
    const inside = this.sum();
    this.need(close);
    return inside;
  }

  // The unparsed text up to a closing bracket.
  until(close) {
    let text = "";
    while (!this.is(close) && this.next !== undefined) text += this.take();
    this.need(close);
    return text;
  }

  line() {
    const sides = [this.sum()], signs = [];
    while (relations.includes(this.next)) {
      signs.push(this.take().replace("==", "="));
      sides.push(this.sum());
    }
    if (this.next !== undefined) throw new SyntaxError(this.next);
    return { is: "line", signs, of: sides };
  }

  sum() {
    const first = this.is("-", "+", "−") && (this.take() === "+" ? "+" : "−");
    let left = first ? { is: "signed", sign: first, of: [this.product()] } : this.product();
    while (this.is("+", "-", "−")) {
      const between = this.take() === "+" ? "+" : "−";
      left = { is: "sum", sign: between, of: [left, this.product()] };
    }
    return left;
  }

  product() {
    let left = this.power();
    for (;;) {
      if (this.is("/")) {
        this.take();
        left = { is: "quotient", of: [left, this.signed()] };
      } else if (this.is("*", "·", "\\cdot", "\\times")) {
        this.take();
        left = { is: "product", of: [left, this.signed()] };
      } else if (this.next !== undefined && /^[\w\\(.\u0370-\u03ff]/.test(this.next)) left = { is: "product", of: [left, this.power()] };
      else return left;
    }
  }

  signed() {
    if (!this.is("-", "+", "−")) return this.power();
    return { is: "signed", sign: this.take() === "+" ? "+" : "−", of: [this.power()] };
  }

  power() {
    let base = this.primary();
    while (this.is("^", "²", "³")) base = { is: "power", of: [base, this.index()] };
    return base;
  }

  index() {
    const index = { "²": "2", "³": "3" }[this.take()];
    if (index) return { is: "number", text: index };
    return this.is("{") ? this.group("{", "}") : this.signed();
  }

  primary() {
    if (this.next === undefined) throw new SyntaxError("end");
    if (this.is("(")) return { is: "round", of: [this.group("(", ")")] };
    if (this.is("{")) return this.group("{", "}");
    if (this.is("[")) return this.unit();
    if (/^[0-9.]/.test(this.next)) return this.number();
    if (/^[\\A-Za-z\u0370-\u03ff]/.test(this.next)) return this.word();
    throw new SyntaxError(this.next);
  }

  unit() {
    this.need("[");
    return { is: "unit", text: this.until("]") };
  }

  number() {
    const number = { is: "number", text: this.take() };
    if (this.is("[")) return { is: "measure", of: [number, this.unit()] };
    if (!this.is("°")) return number;
    this.take();
    return { is: "measure", of: [number, { is: "unit", text: "deg" }] };
  }

  word() {
    const token = this.take(), name = token.replace(/^\\/, "");
    if (/^\\[td]?frac$/.test(token)) return { is: "quotient", of: [this.group("{", "}"), this.group("{", "}")] };
    if (/^\\d?dot$/.test(token)) return { is: "dotted", dots: token === "\\dot" ? 1 : 2, of: [this.is("{") ? this.group("{", "}") : this.word()] };
    if (functions.includes(name)) return this.call(name);
    if (token.startsWith("\\") && !greek[name.split("_")[0]]) throw new SyntaxError(token);
    if (name.endsWith("_") && this.is("{")) {
      this.take();
      return { is: "name", text: name + this.until("}") };
    }
    return this.is("(") ? { is: "call", name, power: null, of: this.list() } : { is: "name", text: name };
  }

  call(name) {
    const power = this.is("^") ? (this.take(), this.primary()) : null;
    const of = this.is("(") ? this.list() : [this.is("{") ? this.group("{", "}") : this.power()];
    return { is: "call", name, power, of };
  }

  list() {
    this.need("(");
    const parts = [this.sum()];
    while (this.is(",")) {
      this.take();
      parts.push(this.sum());
    }
    this.need(")");
    return parts;
  }
}

// The tree of a text, or null if it cannot be parsed.
function treeOf(text) {
  try { return new Reader(tokensOf(text)).line(); } catch { return null; }
}

// ---- as mathematics

const bare = (tree) => (tree.is === "round" ? tree.of[0] : tree);
const sign = (text) => math("mo", text);
const fenced = (...inside) => [sign("("), ...inside, sign(")")];

function symbolOf(text) {
  const primes = /'+$/.exec(text), node = mathSymbol(text.replace(/'+$/, "").replace(/^([av])(G?[xy])(?=_dot$|$)/, "$1_$2"));
  return primes ? math("msup", node, sign("′".repeat(primes[0].length))) : node;
}

function callOf({ name, power, of }) {
  const inside = of.flatMap((part, i) => [...(i ? [sign(",")] : []), ...mathOfTree(part)]);
  if (name === "sqrt") return [math("msqrt", ...inside)];
  if (name === "abs") return [sign("|"), ...inside, sign("|")];
  const head = functions.includes(name) ? math("mi", name) : symbolOf(name);
  return [power ? math("msup", head, math("mrow", ...mathOfTree(power))) : head, sign("\u2061"), ...fenced(...inside)];
}

// The sign between two factors: a dot before a number, a small space before a name of several letters.
function timesSign(right) {
  const first = right.is === "power" ? right.of[0] : right;
  if (first.is === "number" || first.is === "measure") return sign("·");
  if (first.is === "call") return math("mtext", "\u2009");
  return first.is === "name" && /^[A-Za-z]{2}/.test(first.text) && !greek[first.text.split("_")[0]] ? math("mtext", "\u2009") : sign("\u2062");
}

// The MathML nodes of a tree.
function mathOfTree(tree) {
  const row = (part) => math("mrow", ...mathOfTree(part));
  switch (tree.is) {
    case "number": return [math("mn", tree.text)];
    case "name": return [symbolOf(tree.text)];
    case "unit": return [math("mtext", tree.text === "deg" ? "°" : `\u2009${unit(tree.text)}`)];
    case "measure": return tree.of.flatMap(mathOfTree);
    case "round": return fenced(...mathOfTree(tree.of[0]));
    case "quotient": return [math("mfrac", row(bare(tree.of[0])), row(bare(tree.of[1])))];
    case "power": return [math("msup", row(tree.of[0]), row(bare(tree.of[1])))];
    case "signed": return [sign(tree.sign), ...mathOfTree(tree.of[0])];
    case "dotted": return [math("mover", mathOfTree(tree.of[0])[0], sign("˙¨"[tree.dots - 1]))];
    case "product": return [...mathOfTree(tree.of[0]), timesSign(tree.of[1]), ...mathOfTree(tree.of[1])];
    case "sum": return [...mathOfTree(tree.of[0]), sign(tree.sign), ...mathOfTree(tree.of[1])];
    case "call": return callOf(tree);
    default: return tree.of.flatMap((side, i) => [...(i ? [sign(tree.signs[i - 1].replace("<=", "≤").replace(">=", "≥"))] : []), ...mathOfTree(side)]);
  }
}

// A line as mathematics, or as it was typed.
function typeset(text) {
  const tree = treeOf(text);
  if (tree) return mathLine(math("mrow", ...mathOfTree(tree)));
  return Object.assign(document.createElement("div"), { className: "formula", textContent: text });
}

// ---- as a number

const unitSizes = { deg: Math.PI / 180, rad: 1, m: 1, mm: 0.001, cm: 0.01, km: 1000, in: 0.0254, ft: 0.3048 };

// The value of a tree for named numbers; NaN if one of them is not a number.
function numberOf(tree, names) {
  const values = () => tree.of.map((part) => numberOf(part, names));
  switch (tree.is) {
    case "number": return Number(tree.text);
    case "name": return tree.text === "pi" ? Math.PI : names(tree.text);
    case "unit": return unitSizes[tree.text] ?? NaN;
    case "round": return values()[0];
    case "measure":
    case "product": { const [a, b] = values(); return a * b; }
    case "quotient": { const [a, b] = values(); return a / b; }
    case "power": { const [a, b] = values(); return a ** b; }
    case "signed": return tree.sign === "+" ? values()[0] : -values()[0];
    case "sum": { const [a, b] = values(); return tree.sign === "+" ? a + b : a - b; }
    case "call": return Math[tree.name]?.(...values()) ?? NaN;
    default: return tree.of.length === 1 ? values()[0] : NaN;
  }
}

// A typed number ("20 N", "-90°", "20 kg*g", "L/2 + 3 cm") as in the file, with units within a formula in brackets.
// `isName`: true for a quantity given in the sheet.
function fileNumber(text, isName) {
  const one = "(?:kN|N|kg|deg|rad|mm|cm|km|m|in|ft|lbf|lb|s)(?:\\^[0-9])?", units = `${one}(?:[*/]${one})*(?!\\w)`;
  const typed = text.trim().replace(/·/g, "*").replace(/([0-9.])\s*°/g, "$1 deg");
  const plain = new RegExp(`^([-+]?[0-9.]+(?:e[-+]?[0-9]+)?)\\s*(${units})?$`).exec(typed);
  if (plain) return plain[2] ? `${plain[1]} ${plain[2]}` : typed;
  return typed.replace(new RegExp(`\\b([0-9.]+)\\s*(${units})`, "g"), (whole, number, found) => {
    const parts = found.split(/(?=[*/])/), end = parts.findIndex((part) => isName(part.replace(/^[*/]|\^.*/g, "")));
    if (end === 0) return `${number}*${found}`;
    return end < 0 ? `${number}[${found}]` : `${number}[${parts.slice(0, end).join("")}]${parts.slice(end).join("")}`;
  });
}

// The value of such a number in radians or metres; NaN for other quantities.
function amountOf(text, names) {
  const tree = treeOf(fileNumber(text, (name) => !Number.isNaN(names(name))).replace(/^([-+0-9.e]+) (\w+)$/, "$1[$2]"));
  return tree ? numberOf(tree, names) : NaN;
}
