"use strict";

// Equations as they are typed, in mathematics: 3/2*m*a_x = F - f, N = m*g*cos(phi), \frac{1}{2} m v^2.
// What cannot be read so is shown as it stands: it may be half a line.

const relations = ["<=", ">=", "==", "=", "<", ">"];
const functions = ["sin", "cos", "tan", "asin", "acos", "atan", "sqrt", "exp", "log", "abs", "sign", "min", "max"];

// Of a text its words, numbers and signs; \left and \right say nothing.
function tokensOf(text) {
  return [...text.replace(/\\(left|right)\b/g, "").matchAll(/\\?[A-Za-z\u0370-\u03ff][\w.\u0370-\u03ff]*'*|[0-9]+\.?[0-9]*(?:[eE][-+]?[0-9]+)?|\.[0-9]+|<=|>=|==|\\[,; ]|\S/g)]
    .map(([token]) => token).filter((token) => !/^\\[,; ]$/.test(token));
}

// A reader of tokens; each rule returns a tree {is, of: [...]}.
function readerOf(tokens) {
  let at = 0;
  const next = () => tokens[at], is = (...signs) => signs.includes(tokens[at]);
  const take = () => tokens[at++];
  const need = (sign) => { if (take() !== sign) throw new SyntaxError(sign); };
  const group = (open, close) => { need(open); const inside = sum(); need(close); return inside; };

  function power() {
    let base = primary();
    while (is("^", "²", "³")) {
      const sign = take(), index = { "²": "2", "³": "3" }[sign];
      base = { is: "power", of: [base, index ? { is: "number", text: index } : is("{") ? group("{", "}") : is("-") ? signed() : primary()] };
    }
    return base;
  }

  function signed() {
    if (!is("-", "+", "−")) return power();
    const sign = take() === "+" ? "+" : "−";
    return { is: "signed", sign, of: [power()] };
  }

  function product() {
    let left = power();
    for (;;) {
      if (is("/")) { take(); left = { is: "quotient", of: [left, signed()] }; }
      else if (is("*", "·", "\\cdot", "\\times")) { take(); left = { is: "product", of: [left, signed()] }; }
      else if (next() !== undefined && /^[\w\\(.\u0370-\u03ff]/.test(next()) && !is("\\cdot")) left = { is: "product", of: [left, power()] };
      else return left;
    }
  }

  function sum() {
    const minus = is("-", "+", "−") && (take() === "+" ? "+" : "−");
    let left = minus ? { is: "signed", sign: minus, of: [product()] } : product();
    while (is("+", "-", "−")) { const sign = take() === "+" ? "+" : "−"; left = { is: "sum", sign, of: [left, product()] }; }
    return left;
  }

  function call(name) {
    const raisedTo = is("^") ? (take(), primary()) : null;
    const of = is("(") ? list() : [is("{") ? group("{", "}") : power()];
    return { is: "call", name, power: raisedTo, of };
  }

  function list() {
    need("(");
    const parts = [sum()];
    while (is(",")) { take(); parts.push(sum()); }
    need(")");
    return parts;
  }

  function word() {
    const token = take(), name = token.replace(/^\\/, "");
    if (token === "\\frac" || token === "\\tfrac" || token === "\\dfrac") return { is: "quotient", of: [group("{", "}"), group("{", "}")] };
    if (token === "\\dot" || token === "\\ddot") {
      const inside = is("{") ? (need("{"), word()) : word();
      if (is("}")) take();
      return { is: "dotted", dots: token === "\\dot" ? 1 : 2, of: [inside] };
    }
    if (functions.includes(name)) return call(name);
    if (token.startsWith("\\") && !greek[name.split("_")[0]]) throw new SyntaxError(token);
    if (name.endsWith("_") && is("{")) {
      take();
      let below = "";
      while (!is("}") && next() !== undefined) below += take();
      need("}");
      return { is: "name", text: name + below };
    }
    if (is("(")) return { is: "call", name, power: null, of: list() };
    return { is: "name", text: name };
  }

  function primary() {
    const token = next();
    if (token === undefined) throw new SyntaxError("end");
    if (token === "(") return { is: "round", of: [group("(", ")")] };
    if (token === "{") return group("{", "}");
    if (token === "[") { take(); let text = ""; while (!is("]") && next() !== undefined) text += take(); need("]"); return { is: "unit", text }; }
    if (/^[0-9.]/.test(token)) {
      const number = { is: "number", text: take() };
      if (is("[")) return { is: "measure", of: [number, primary()] };
      if (is("°")) { take(); return { is: "measure", of: [number, { is: "unit", text: "deg" }] }; }
      return number;
    }
    if (/^[\\A-Za-z\u0370-\u03ff]/.test(token)) return word();
    throw new SyntaxError(token);
  }

  function line() {
    const sides = [sum()], signs = [];
    while (relations.includes(next())) { signs.push(take().replace("==", "=")); sides.push(sum()); }
    if (at < tokens.length) throw new SyntaxError(next());
    return { is: "line", signs, of: sides };
  }
  return line();
}

// Its tree, or null where it cannot be read.
function treeOf(text) {
  try { return readerOf(tokensOf(text)); } catch { return null; }
}

// ---- as mathematics

const bare = (tree) => (tree.is === "round" ? tree.of[0] : tree);
const sign = (text) => math("mo", text);
const fenced = (...inside) => [sign("("), ...inside, sign(")")];

function symbolOf(text) {
  const primes = /'+$/.exec(text), node = mathSymbol(text.replace(/'+$/, "").replace(/^([av])(G?[xy])(?=_dot$|$)/, "$1_$2"));
  return primes ? math("msup", node, sign("′".repeat(primes[0].length))) : node;
}

function dotted(tree) {
  const node = mathOfTree(tree.of[0])[0];
  return math("mover", node, sign("˙¨"[tree.dots - 1]));
}

function callOf({ name, power, of }) {
  const inside = of.flatMap((part, i) => [...(i ? [sign(",")] : []), ...mathOfTree(part)]);
  if (name === "sqrt") return [math("msqrt", ...inside)];
  if (name === "abs") return [sign("|"), ...inside, sign("|")];
  const head = functions.includes(name) ? math("mi", name) : symbolOf(name);
  return [power ? math("msup", head, math("mrow", ...mathOfTree(power))) : head, sign("\u2061"), ...fenced(...inside)];
}

// Between two factors: a dot before a number, a little room before a name of several letters.
function timesSign(right) {
  const first = right.is === "power" ? right.of[0] : right;
  if (first.is === "number" || first.is === "measure") return sign("·");
  return first.is === "name" && /^[A-Za-z]{2}/.test(first.text) && !greek[first.text.split("_")[0]] ? math("mtext", "\u2009") : sign("\u2062");
}

// Nodes of a row.
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
    case "dotted": return [dotted(tree)];
    case "product": return [...mathOfTree(tree.of[0]), timesSign(tree.of[1]), ...mathOfTree(tree.of[1])];
    case "sum": return [...mathOfTree(tree.of[0]), sign(tree.sign), ...mathOfTree(tree.of[1])];
    case "call": return callOf(tree);
    default: return tree.of.flatMap((side, i) => [...(i ? [sign({ "<=": "≤", ">=": "≥" }[tree.signs[i - 1]] || tree.signs[i - 1])] : []), ...mathOfTree(side)]);
  }
}

// A line in mathematics, or as it was typed.
function typeset(text) {
  const tree = treeOf(text);
  if (tree) return mathLine(math("mrow", ...mathOfTree(tree)));
  return Object.assign(document.createElement("div"), { className: "formula", textContent: text });
}

// ---- as a number

// The value of a tree for named numbers; NaN where one of them is none.
function valueOf(tree, names) {
  const values = () => tree.of.map((part) => valueOf(part, names));
  switch (tree.is) {
    case "number": return Number(tree.text);
    case "name": return tree.text === "pi" ? Math.PI : names(tree.text);
    case "unit": return { deg: Math.PI / 180, rad: 1 }[tree.text] ?? NaN;
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

// An angle in degrees: "30 deg", "-90°", "phi + 90 deg", "1.2"; NaN where it is none.
function degreesOf(text, names) {
  const tree = treeOf(text.replace(/([0-9.])\s*(deg|rad)\b/g, "$1[$2]"));
  return tree ? valueOf(tree, names) * 180 / Math.PI : NaN;
}
