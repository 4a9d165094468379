#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: states_json.py: `--equations --json` and `--linearize --json` of every model hold what they say. Prints TAP."""
import cmath
import json
import os
import subprocess
import sys
from pathlib import Path

RUN = os.environ["FBD_RUN"]
EVERY = 3 if os.environ.get("FBD_THOROUGH") == "no" else 1
MODELS = sorted((Path(os.environ["FBD_SOURCE_ROOT"]) / "models").rglob("*.yaml"))[::EVERY]


def ask(*arguments):
    done = subprocess.run([RUN, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else None


def adds_up(equation):
    """The terms are the sum, and inertia times acceleration is it but for the residual."""
    values = [term["value"] for term in equation["terms"]]
    size = sum(map(abs, values)) + abs(equation["sum"]["value"]) + 1e-300
    force = equation["inertia"]["value"] * equation["acceleration"]["value"]
    return (abs(sum(values) - equation["sum"]["value"]) <= 1e-12 * size
            and abs(force - equation["sum"]["value"] - equation["residual"]) <= 1e-12 * (size + abs(force)))


def determinant(rows):
    """By elimination with pivots, and the size of what cancels in it."""
    rows, value = [list(row) for row in rows], 1
    for i in range(len(rows)):
        pivot = max(range(i, len(rows)), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        if rows[i][i] == 0:
            return 0
        value *= rows[i][i]
        for k in range(i + 1, len(rows)):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return value


def is_eigenvalue(A, mode):
    """det(A - s) is as small as that of a neighbour of s at 1e-6 is large."""
    s = complex(mode["re"], mode["im"])
    away = 1e-4 * (abs(s) + max(abs(a) for row in A for a in row) ** 0.5)

    def at(value):
        return abs(determinant([[a - value * (i == k) for k, a in enumerate(row)] for i, row in enumerate(A)]))
    return at(s) <= 0.1 * max(at(s + away * cmath.exp(1j * k)) for k in range(4))


def main():
    equations = linear = count = 0
    wrong = []
    for model in MODELS:
        found = ask("--equations", "--json", "-", model)
        if found:
            equations += 1
            wrong += [f"{model.name}: {one['body']}.{one['coordinate']}" for one in found["equations"] if not adds_up(one)]
        found = ask("--linearize", "--json", "-", model)
        if found:
            linear += 1
            A = found["A"]
            if len(found["states"]) != len(A) or any(len(row) != len(A) for row in A):
                wrong.append(f"{model.name}: shape of A")
            if len(A) <= 12:
                wrong += [f"{model.name}: {mode}" for mode in found["eigenvalues"] if not is_eigenvalue(A, mode)]
    for fact, words in ((not wrong, "equations add up, and eigenvalues are those of A"),
                        (equations > 80 / EVERY, f"{equations} models have equations"), (linear > 20 / EVERY, f"{linear} an equilibrium")):
        count += 1
        print(f"{'ok' if fact else 'not ok'} {count} - {words}")
    print("".join(f"# {one}\n" for one in wrong[:20]), end="")
    print(f"1..{count}")
    return bool(wrong) or equations <= 80 / EVERY or linear <= 20 / EVERY


sys.exit(main())
