"use strict";

// Formatting of numbers, units and names: six digits, m/s², θ, ω, v̇.

function show(value, digits = 6) {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    return `${minus(String(Number(mantissa)))}·10${raised(String(Number(power)))}`;
  }
  return minus(String(Number(value.toPrecision(digits))));
}

function minus(text) {
  return text.replace("-", "−");
}

function raised(text) {
  return text.replace(/[-0-9]/g, (digit) => (digit === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[digit]));
}

function unit(text) {
  return text.replace(/\*/g, "·").replace(/\^(-?[0-9]+)/g, (whole, power) => raised(power));
}

const greek = { alpha: "α", beta: "β", gamma: "γ", delta: "δ", epsilon: "ε", zeta: "ζ", eta: "η", theta: "θ", kappa: "κ", lambda: "λ",
  mu: "μ", nu: "ν", xi: "ξ", rho: "ρ", sigma: "σ", tau: "τ", phi: "φ", chi: "χ", psi: "ψ", omega: "ω", Delta: "Δ", Omega: "Ω", Phi: "Φ", pi: "π" };

// The name of a quantity: its last part may become a Greek letter, with a dot above for derivatives.
function quantity(name) {
  const parts = name.split("."), last = parts.pop();
  return [...parts, last.replace(/^([A-Za-z]+)(_dot)?(?=_|$)/, (whole, letter, dotted) => (greek[letter] || letter) + (dotted ? "\u0307" : ""))].join(".");
}

// ---- mathematics (MathML)

// The namespace is a URL, which this page must not contain: take it from an element of the page.
const mathSpace = document.getElementById("mathematics").namespaceURI;

function math(tag, ...children) {
  const node = document.createElementNS(mathSpace, tag);
  node.append(...children);
  return node;
}

// A symbol such as mu_k, m2, v_dot, I_O, rod.omega: one letter is italic, the part after the underscore an index.
function mathSymbol(name) {
  const plain = name.replace(/(^|\.)v([xy])(_dot)?$/, "$1v$3_$2").replace(/(^|\.)([A-Za-z]+)(\d+)$/, "$1$2_$3");
  const [, body, base, dotted, index] = /^(.*\.)?([^_]*)(_d+ot)?_?(.*)$/.exec(plain);
  const letter = (body || "") + (greek[base] || base), node = math("mi", letter + ({ _dot: "\u0307", _ddot: "\u0308" }[dotted] || ""));
  if (dotted) node.setAttribute("class", "dotted"); // two characters, which MathML would set upright
  if (!index) return node;
  const below = math(/^[0-9]+$/.test(index) ? "mn" : "mi", greek[index] || index);
  return math("msub", node, below);
}

function inMath(name) {
  return math("math", mathSymbol(name));
}

// A formula in plain notation (symbols.h): words, products by a blank, signs, parentheses.
function mathOf(text) {
  const nodes = [];
  for (const [token] of text.matchAll(/[A-Za-z][A-Za-z0-9_'.]*|\^[0-9]+|_[A-Za-z0-9]+|[0-9.]+|\[[a-z]+\]|\S/g)) {
    const last = nodes[nodes.length - 1];
    if (token === "[deg]") nodes.push(math("mo", "°"));
    else if (token[0] === "[") nodes.push(math("mtext", `\u00a0${token.slice(1, -1)}\u2009`));
    else if (token === "sin" || token === "cos") {
      const room = last && last.localName !== "mo" ? "\u2009" : "";
      nodes.push(math("mtext", room), math("mi", token), math("mo", "\u2061"));
    }
    else if (token[0] === "^") nodes.push(math("msup", nodes.pop(), math("mn", token.slice(1))));
    else if (/^[A-Za-z]/.test(token)) nodes.push(mathSymbol(token));
    else if (/^[0-9.]/.test(token)) nodes.push(math("mn", token));
    else if (token.startsWith("_")) nodes.push(math("msub", nodes.pop(), math("mi", token.slice(1))));
    else nodes.push(math("mo", token === "-" ? "−" : token));
    const newest = nodes[nodes.length - 1], factors = last && last.localName !== "mo" && newest.localName !== "mo";
    if (factors && !/^[_^[]/.test(token)) nodes.splice(nodes.length - 1, 0, math("mo", "\u2062"));
  }
  return nodes;
}

// A formula on a line of its own, which scrolls if it is too long.
function mathLine(row) {
  const box = document.createElement("div"), whole = math("math", row);
  box.className = "formula";
  whole.setAttribute("display", "block");
  box.append(whole);
  return box;
}
