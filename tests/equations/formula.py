# SPDX-License-Identifier: GPL-3.0-or-later
"""Formulas as the program writes them, plainly ("-m g sin(along) + (mu_k N)_x") and as LaTeX: read and evaluated."""
import math
import re

GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "theta": "θ", "lambda": "λ", "mu": "μ", "phi": "φ", "psi": "ψ",
         "omega": "ω", "rho": "ρ", "tau": "τ"}
TOKEN = re.compile(r"\s*(d[A-Za-z]\w*/d[a-z]+|[A-Za-z][A-Za-z0-9']*(?:[_.][A-Za-z0-9]+)*|[0-9.]+(?:e[-+]?[0-9]+)?|\[[a-z]+\]|.)")


class Unbound(Exception):
    """A name without a value."""


def from_latex(text):
    """The same formula, plainly."""
    text = re.sub(r"\\mathit\{(\w*)\}", r"\1", text)
    text = re.sub(r"\\(d+ot)\{\s*\\?(\w+)\s*\}", r"\2_\1", text)
    text = re.sub(r"(\w+)_dot_\{(\w)\}", r"\1\2_dot", text)
    text = re.sub(r"\\,\\mathrm\{(\w+)\}", r"[\1]", text).replace(r"\,", " ").replace(r"^\circ", "[deg]")
    text = re.sub(r"\\mathit\{(\w*)\}", r"\1", text)
    text = re.sub(r"\\([a-z]+) ", r"\1", text).replace(". ", ".")
    text = re.sub(r"\bv_\{([xy])\}", r"v\1", text)
    previous = None
    while previous != text:
        previous, text = text, re.sub(r"_\{((?:[^{}\\]|\\_)*)\}", lambda m: "_" + m.group(1).replace(r"\_", "_"), text)
    return re.sub(r"\b(sin|cos) ?\(\s*(.*?)\s*\)", r"\1(\2)", text).strip()


def printed(symbol):
    """A symbol as a drawing has it."""
    low = {**{str(i): chr(0x2080 + i) for i in range(10)}, "k": "ₖ", "s": "ₛ"}

    def word(match):
        base, *indices = match.group(0).split("_")
        out = GREEK.get(base, base)
        for index in indices:
            out += "".join(low[c] for c in index) if re.fullmatch(r"[0-9]+|[ks]", index) else "_" + GREEK.get(index, index)
        return out
    return re.sub(r"[A-Za-z]\w*", word, symbol).replace(" ", "")


def pieces(text):
    """The terms of a sum, each a sign and what it is of."""
    found, depth, bars, start = [], 0, False, 0
    for i, c in enumerate(text):
        depth += {"(": 1, ")": -1}.get(c, 0)
        bars ^= c == "|"
        if depth == 0 and not bars and c in "+-" and text[i - 1:i] == " " and text[i + 1:i + 2] == " ":
            found.append(text[start:i].strip())
            start = i
    found.append(text[start:].strip())
    return [(-1 if piece[0] == "-" else 1, piece.lstrip("+- ")) for piece in found if piece != "0"]


class Formula:
    """A recursive descent over products by juxtaposition; `values` has numbers by name, vectors as pairs."""

    def __init__(self, text, values):
        self.tokens = TOKEN.findall(text)
        self.values = values
        self.at = 0

    def value(self):
        value = self.sum()
        assert self.at == len(self.tokens), f"{self.tokens} goes on at {self.at}"
        return value

    def next(self):
        return self.tokens[self.at] if self.at < len(self.tokens) else ""

    def take(self):
        self.at += 1
        return self.tokens[self.at - 1]

    def sum(self):
        sign = -1 if self.next() == "-" else 1
        if self.next() in ("+", "-"):
            self.take()
        value = scaled(sign, self.product())
        while self.next() in ("+", "-"):
            sign = -1 if self.take() == "-" else 1
            value = added(value, scaled(sign, self.product()))
        return value

    def product(self):
        value = self.power()
        while self.next() and self.next() not in "+-)|_":
            if self.next() == "/":
                self.take()
                value = scaled(1 / self.factor(), value)
            else:
                value = scaled(value, self.power())
        if self.next() == "|" and self.bars == 0:
            value = scaled(value, self.product())
        return value

    bars = 0

    def power(self):
        value = self.factor()
        if self.next() == "^":
            self.take()
            value **= int(self.take())
        return value

    def factor(self):
        token = self.take()
        if token == "(":
            value = self.sum()
            assert self.take() == ")"
            if self.next() == "_":
                self.take()
                return self.values["component"](value, self.take())
            return value
        if token == "|":
            self.bars += 1
            value = self.sum()
            assert self.take() == "|"
            self.bars -= 1
            return math.hypot(*value) if isinstance(value, tuple) else abs(value)
        if token in ("sin", "cos"):
            return getattr(math, token)(self.factor())
        if token[0].isdigit():
            unit = self.take() if self.next()[:1] == "[" else None
            return float(token) * (math.pi / 180 if unit == "[deg]" else 1)
        if token not in self.values or self.values[token] is None:
            raise Unbound(token)
        return self.values[token]


def scaled(factor, value):
    return (factor * value[0], factor * value[1]) if isinstance(value, tuple) else factor * value


def added(a, b):
    return (a[0] + b[0], a[1] + b[1]) if isinstance(a, tuple) else a + b


def evaluate(text, values):
    return Formula(text, values).value()
