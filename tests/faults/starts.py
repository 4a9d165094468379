#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes with couplings whose start fits, and the same put out of place, asked in every way.

One that fits is refused by nobody for that; one that does not is refused by a run, --check, --equations,
--svg, statics, linearisation and the row of a sweep, with one id.

    starts.py [SCENES [SEED]]
"""
import math
import os
import random
import sys
import tempfile
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / "page"), str(SOURCE / "tests" / "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, finish  # pylint: disable=wrong-import-position

PROGRAMS = Path(os.environ["FBD_RUN"]).parent
QUESTIONS = [["fbd-run"], ["fbd-run", "--check"], ["fbd-run", "--equations"], ["fbd-run", "--static"],
             ["fbd-run", "--linearize"], ["fbd-run", "--quiet", "--svg", "OUT"],
             ["fbd-run", "--equations", "--svg", "OUT"],
             ["fbd-sweep", "--jobs", "1", "--quiet", "--vary", "push=0,1"]]


def scene(rng, off):
    """A scene about the point (X, Y) of the size L; a length or place in it is off by that share of L."""
    L = 10 ** rng.uniform(-4, 4)
    X, Y = (rng.choice([0, 0, 1, 1e4]) * L * rng.uniform(-1, 1) for _ in range(2))
    turn = rng.uniform(0, 2 * math.pi)
    error = off * L
    c, s = math.cos(turn), math.sin(turn)

    def at(x, y):
        return f"[{X + x * L:.17g}, {Y + y * L:.17g}]"

    def particle(name, x, y, mass=1):
        return (f"  {name}: {{mass: {mass}, motion: particle, initial: {{x: {X + x * L:.17g}, y: {Y + y * L:.17g}}}, "
                f"forces: [gravity, applied: {{value: push, angle: 0.3 rad}}]}}")

    head = f"fbd: 1\nparameters: {{push: 0.5 N}}\nground: {{points: {{A: {at(0, 0)}, B: {at(3, 0.5)}}}, " \
           f"lines: {{floor: {{through: {at(0, 0)}, along: 0}}}}}}\nbodies:\n"
    kind = rng.choice(["rod", "rope", "rope over", "pin", "four bar", "roll", "pulley", "slack", "two rods"])
    tail = "simulate: {until: " + f"{1e-3 * math.sqrt(L):.17g}" + "}\n"
    if kind == "rod":
        return kind, head + particle("p", 2 * c, 2 * s) + (
            f"\ncouplings: [rod: {{between: [p, ground.A], length: {2 * L + error:.17g}}}]\n") + tail
    if kind == "two rods":
        return kind, head + particle("p", c, s) + "\n" + particle("q", c - s, s + c, 2) + (
            f"\ncouplings:\n  - rod: {{between: [p, ground.A]}}\n"
            f"  - rod: {{between: [p, q], length: {L + error:.17g}}}\n") + tail
    if kind in ("rope", "slack"):  # only one that is too short does not fit
        length = 2 * L - abs(error) if kind == "rope" or off else 2.5 * L
        return kind, head + particle("p", 2 * c, 2 * s) + (
            f"\ncouplings: [rope: {{through: [p, ground.A], length: {length:.17g}}}]\n") + tail
    if kind == "rope over":
        far = math.hypot(3 - 3, 0.5 + 2)
        length = (math.hypot(3, 0.5) + far) * L - abs(error)
        return kind, head + particle("p", 3, -2) + (
            f"\ncouplings: [rope: {{through: [ground.A, ground.B, p], length: {length:.17g}}}]\n") + tail
    if kind == "pin":
        return kind, head + (
            f"  bar: {{shape: rod, mass: 1, length: {L:.17g}, motion: {{pivot: {{at: A, point: left}}}}, "
            f"initial: {{theta: {turn:.17g} rad}}, forces: [gravity]}}\n") + particle("p", c + off, s) + (
            "\ncouplings: [pin: {between: [bar.right, p]}]\n") + tail
    if kind == "four bar":  # a parallelogram: A, A + (c, s), that + (3, 0.5), B
        along = math.atan2(0.5, 3)
        return kind, head + (
            f"  a: {{shape: rod, mass: 1, length: {L:.17g}, motion: {{pivot: {{at: A, point: left}}}}, "
            f"initial: {{theta: {turn:.17g} rad}}, forces: [gravity, applied: {{value: push, angle: 0.3 rad}}]}}\n"
            f"  b: {{shape: rod, mass: 1, length: {math.hypot(3, 0.5) * L + error:.17g}, motion: {{pivot: {{on: a, at: "
            f"right, point: left}}}}, initial: {{theta: {along - turn:.17g} rad}}, forces: [gravity]}}\n"
            f"  c: {{shape: rod, mass: 1, length: {L:.17g}, motion: {{pivot: {{at: B, point: left}}}}, "
            f"initial: {{theta: {turn:.17g} rad}}, forces: [gravity]}}\n"
            "couplings: [pin: {between: [b.right, c.right]}]\n") + tail
    if kind == "roll":
        return kind, head + (
            f"  wheel: {{shape: disc, mass: 2, radius: {0.5 * L:.17g}, motion: planar, initial: {{x: {X + 0.3 * L:.17g}, "
            f"y: {Y + (0.5 + abs(off)) * L:.17g}}}, forces: [gravity, applied: {{value: push, angle: 0}}]}}\n"
            "couplings: [roll: {body: wheel, on: floor}]\n") + tail
    inside = 0.3 if off else 1.0  # pulley: an end within its rim
    return kind, head + (
        f"  wheel: {{shape: disc, mass: 1, radius: {0.5 * L:.17g}, motion: {{pivot: {{at: A}}}}}}\n" +
        particle("p", 0.5, -2, 3) + "\n" + particle("q", -0.5 * inside, -2 if not off else -0.2) +
        "\ncouplings: [rope: {through: [p, wheel, q]}]\n") + tail


def ask(question, folder):
    out = folder / "out.svg"
    command = [str(out) if word == "OUT" else word for word in question[1:]]
    done = limits.run([PROGRAMS / question[0], *command, "m.yaml"], cwd=folder, capture_output=True, input=b"",
                      check=False)
    return done.returncode, done.stdout.decode() + done.stderr.decode()


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 60
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for seed in range(first, first + count):
            rng = random.Random(seed)
            share = rng.choice([-1, 1]) * 10 ** rng.uniform(-4, -0.3)
            for off in (0, share):
                kind, text = scene(random.Random(seed), off)
                (folder / "m.yaml").write_text(text, encoding="utf-8")
                for question in QUESTIONS:
                    code, said = ask(question, folder)
                    refused = "[does-not-fit]" in said
                    if refused == (off != 0) and code >= 0 and (code == 1 or not refused):
                        continue
                    with claim(f"seed {seed}, {kind} off by {off:g}: {' '.join(question)}"):
                        print("".join(f"# {line}\n" for line in text.splitlines()), end="")
                        assert False, f"exit code {code}: {said}"
    with claim(f"{count} scenes that fit and {count} that do not, {len(QUESTIONS)} questions"):
        assert count > 0
    finish()


main()
