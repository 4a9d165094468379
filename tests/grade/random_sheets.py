#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: random_sheets.py FBD-RUN [SHEETS [SEED]]

Random bodies with random forces and moments; the answer is the key with other names, in another order and written in
other ways, and with so many errors of known kinds (none, one or two). Every error is named, and nothing else. Prints TAP.
"""
import json
import math
import random
import subprocess
import sys
import tempfile
from pathlib import Path

RUN = sys.argv[1]
SHEETS = int(sys.argv[2]) if len(sys.argv) > 2 else 150
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1


class Force:
    """A force (or moment) in the world or body frame: magnitude with a factor of t or of the motion, angle, place."""

    def __init__(self, rng, moment):
        self.moment = moment
        self.size = rng.uniform(2, 20) * rng.choice((-1, 1) if moment else (1,))
        self.angle = rng.uniform(-180, 180)
        self.at = (rng.uniform(-1, 1), rng.uniform(-1, 1))
        self.body = rng.random() < 0.3
        self.law = rng.choice(("1", "1", "(1 + t*1[1/s])", "cos(theta)", "(2 + sin(3[rad/s]*t))", "(1 + (x/1[m])^2)"))

    def copy(self):
        other = Force(random.Random(1), self.moment)
        other.__dict__.update(self.__dict__)
        return other

    def entry(self, name, components=False, factor=1):
        unit, value = ("N*m" if self.moment else "N"), f"{self.size * factor:.15g}"
        if self.moment:
            return f'      - applied: {{name: {name}, value: "{value}[{unit}]*{self.law}"}}\n'
        frame = ", frame: body" if self.body else ""
        place = f"{frame}, at: [{self.at[0]:.15g} m, {self.at[1]:.15g} m]}}\n"
        if not components:
            return f'      - applied: {{name: {name}, value: "{value}[N]*{self.law}", angle: {self.angle:.15g} deg{place}'
        a = math.radians(self.angle)
        fx, fy = (f"{self.size * factor * f(a):.15g}" for f in (math.cos, math.sin))
        return f'      - applied: {{name: {name}, fx: "{fx}[N]*{self.law}", fy: "{fy}[N]*{self.law}"{place}'


def write(forces, entries):
    lines = ["fbd: 1", "bodies:", "  plate:", "    mass: 3 kg", "    shape: prism", "    a: 2 m", "    b: 1 m", "    c: 0.1 m",
             "    motion: {planar: {}}", "    forces:", "      - gravity"]
    text = "\n".join(lines) + "\n" + "".join(entry for force, entry in zip(forces, entries) if not force.moment)
    moments = "".join(entry for force, entry in zip(forces, entries) if force.moment)
    return text + ("    moments:\n" + moments if moments else "")


ERRORS = ("missing", "superfluous", "sense", "magnitude", "direction", "place")


def spoil(rng, force, kind):
    """The force with an error of this kind."""
    wrong = force.copy()
    if kind == "sense":
        wrong.size = -wrong.size
    elif kind == "magnitude":
        wrong.size *= rng.choice((0.5, 1.7, 2, 3))
    elif kind == "direction":
        wrong.angle += rng.uniform(20, 160)
    elif kind == "place":
        across = math.radians(wrong.angle) + math.pi / 2
        shift = rng.choice((-1, 1)) * rng.uniform(0.3, 1)
        if not wrong.body:  # its line turns against the body: any other place will do
            across = rng.uniform(-math.pi, math.pi)
        wrong.at = (wrong.at[0] + shift * math.cos(across), wrong.at[1] + shift * math.sin(across))
    return wrong


def sheet(rng):
    forces = [Force(rng, rng.random() < 0.25) for _ in range(rng.randint(1, 6))]
    key = write(forces, [force.entry(f"f{i}") for i, force in enumerate(forces)])
    expected, answer, entries = [], [], []
    chosen = rng.sample(range(len(forces)), min(len(forces), rng.choice((0, 1, 1, 1, 2))))
    for i, force in enumerate(forces):
        kind = rng.choice(ERRORS) if i in chosen else None
        if kind in ("direction", "place") and force.moment:
            kind = "sense"
        if kind:
            expected.append(kind)
        if kind == "missing":
            continue
        own = spoil(rng, force, kind) if kind else force
        # Half of those that are wrong keep their names: without, only what is alike can be told.
        keeps = kind is not None and kind != "superfluous"
        name = f"f{i}" if keeps else f"g{rng.randrange(10**6)}"
        if kind is None and rng.random() < 0.2:  # in two parts
            share = rng.uniform(0.2, 0.8)
            for part, factor in enumerate((share, 1 - share)):
                answer.append(own)
                entries.append(own.entry(f"{name}_{part}", rng.random() < 0.5, factor))
            continue
        answer.append(own)
        entries.append(own.entry(name, rng.random() < 0.5))
        if kind == "superfluous":
            more = Force(rng, False)  # any moment is a multiple of any other
            answer.append(more)
            entries.append(more.entry(f"extra{i}"))
    order = list(range(len(answer)))
    rng.shuffle(order)
    return key, write([answer[i] for i in order], [entries[i] for i in order]), sorted(expected)


def main():
    bad = 0
    with tempfile.TemporaryDirectory() as path:
        key, answer = Path(path, "key.yaml"), Path(path, "answer.yaml")
        for number in range(SHEETS):
            key_text, text, expected = sheet(random.Random(SEED * 100003 + number))
            key.write_text(key_text, encoding="utf-8")
            answer.write_text(text, encoding="utf-8")
            done = subprocess.run([RUN, "--grade", str(key), "--json", "-", str(answer)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, check=False)
            found = "nothing"
            if done.returncode in (0, 4):
                tests = json.loads(done.stdout)["answers"][0]["tests"]
                found = sorted(one["kind"] for one in tests if one["kind"] != "right")
            if found != expected or done.returncode != (4 if expected else 0):
                bad += 1
                print(f"# sheet {number} of seed {SEED}: {found} instead of {expected}, exit {done.returncode}")
                if bad == 1:
                    print("".join(f"# {line}\n" for line in f"{key_text}----\n{text}\n{done.stderr.decode()}".splitlines()))
    print(f"{'not ok' if bad else 'ok'} 1 - {SHEETS} random sheets: every error is named, and nothing else ({bad} not so)")
    print("1..1")
    return bad > 0


sys.exit(main())
