"use strict";

// Numbers, units and names as they are printed: six digits, m/s², θ, ω, v̇.

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

// The name of a quantity: its last part may be a Greek letter, and a dot stands above the letter.
function quantity(name) {
  const parts = name.split("."), last = parts.pop();
  return [...parts, last.replace(/^([A-Za-z]+)(_dot)?(?=_|$)/, (whole, letter, dotted) => (greek[letter] || letter) + (dotted ? "\u0307" : ""))].join(".");
}

// ---- mathematics (MathML)

// Its name is an address, which this page has none of: the element that the page begins with knows it.
const mathSpace = document.getElementById("mathematics").namespaceURI;

function math(tag, ...children) {
  const node = document.createElementNS(mathSpace, tag);
  node.append(...children);
  return node;
}

// A symbol such as mu_k, T_cord, v_dot, I_O: one letter upright or not, what follows the line below it.
function mathSymbol(name) {
  const [, base, dotted, index] = /^([^_]*)(_dot)?_?(.*)$/.exec(name.replace(/^v([xy])(_dot)?$/, "v$2_$1"));
  const letter = greek[base] || base, node = math("mi", letter + (dotted ? "\u0307" : ""));
  if (dotted) node.setAttribute("class", "dotted"); // of two characters, which MathML would set upright
  if (!index) return node;
  const below = math(/^[0-9]+$/.test(index) ? "mn" : "mi", greek[index] || index);
  return math("msub", node, below);
}

function inMath(name) {
  return math("math", mathSymbol(name));
}
