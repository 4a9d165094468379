#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random slides on moving bodies: slides, drives and welds at angles, and pivots that are held at an angle.

What is up, and what gravity does across a line, goes by the line in the world. The force of the surface, its side and the
motion are held against Newton's law along and across that line; the warnings against the line itself.

    carried_slides.py [SCENES [SEED]]
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / folder) for folder in ("page", "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, close, finish  # pylint: disable=wrong-import-position

G = 9.81
UNTIL = 0.125


def angle(rng):
    """Degrees; often such that lines are level, upright or parallel."""
    return rng.choice([15 * rng.randrange(-12, 13), 90 * rng.randrange(-2, 3), rng.uniform(-180, 180)])


def carriers(rng):
    """(lines of the file, degrees from the world to the last frame, acceleration of it, whether the carriers move along
    one line, and along which) of one to three carriers, each on the one before."""
    lines, turned, ax, ay, moving = [], 0.0, 0.0, 0.0, []
    for k in range(rng.randrange(1, 4)):
        on = f"on: c{k - 1}, " if k else ""
        kind = rng.choice(["drive", "drive", "free", "pivot", "weld"] if k else ["drive", "drive", "free", "pivot"])
        if kind == "free" and k:
            kind = "drive"
        phi = angle(rng)
        turned += phi
        if kind in ("drive", "free"):
            a = rng.choice([0, rng.uniform(-20, 20)])
            c, s = math.cos(math.radians(turned)), math.sin(math.radians(turned))
            if kind == "drive":
                motion = f"slide: {{{on}along: {phi:.17g} deg, x: '{a / 2:.17g}[m/s^2]*t^2'}}"
            else:  # as heavy as nothing that it carries is felt
                a = 0
                motion = f"slide: {{{on}along: {phi:.17g} deg}}"
            ax, ay = ax + a * c, ay + a * s
            moving.append(turned)
        elif kind == "pivot":
            motion = f"pivot: {{{on}at: [0.3, 0.2], theta: '{math.radians(phi):.17g}'}}"
            moving.append(None)
        else:
            motion = f"weld: {{{on}angle: {phi:.17g} deg}}"
        mass = "1e15" if kind == "free" else "3"
        lines.append(f"  c{k}: {{mass: {mass} kg, shape: disc, radius: 0.2 m, motion: {{{motion}}}}}")
    return lines, turned, (ax, ay), moving


def is_upright(degrees):
    return abs(math.cos(math.radians(degrees))) < 1e-9


def scene(rng):
    lines, turned, (ax, ay), moving = carriers(rng)
    beta, m, v, mu = angle(rng), rng.uniform(0.5, 3), rng.choice([-1, 1]) * 9.0, rng.choice([0, rng.uniform(0, 0.4)])
    line = turned + beta
    e = math.cos(math.radians(line)), math.sin(math.radians(line))
    n = -e[1], e[0]
    if n[1] < 0 and not is_upright(line):
        n = -n[0], -n[1]
    across = m * (n[0] * ax + n[1] * (ay + G))
    along = -(e[0] * ax + e[1] * (ay + G))
    friction = f", friction: {mu:.17g}" if mu else ""
    forces = f"[gravity, normal{friction}]"
    lines.append(f"  block: {{mass: {m:.17g} kg, motion: {{slide: {{on: c{len(lines) - 1}, along: {beta:.17g} deg}}}}, "
                 f"initial: {{v: {v:g} m/s}}, forces: {forces}}}")
    if rng.random() < 0.3:  # bodies may stand in any order
        rng.shuffle(lines)
    a = along - math.copysign(mu * across / m, v)
    along_all = all(d is not None and abs(math.sin(math.radians(d - line))) < 1e-9 for d in moving)
    return {
        "text": "fbd: 1\nbodies:\n" + "\n".join(lines) + f"\nsimulate: {{until: {UNTIL} s}}\n",
        "across": across, "n": n, "x": v * UNTIL + a * UNTIL ** 2 / 2, "stops": abs(a) * UNTIL > 8,
        "no-side-up": is_upright(line), "nothing-presses": is_upright(line) and along_all,
    }


def check(wanted, folder):
    path = Path(folder) / "m.yaml"
    path.write_text(wanted["text"], encoding="utf-8")
    done = limits.run([os.environ["FBD_RUN"], "--json", "-", path], capture_output=True, check=False,
                      stdin=subprocess.DEVNULL)
    said = done.stderr.decode()
    for warning in ("no-side-up", "nothing-presses"):
        assert (f"[{warning}]" in said) == wanted[warning], f"{warning}: {wanted[warning]} {said}"
    if abs(wanted["across"]) < 0.01 or wanted["stops"]:
        return
    if wanted["across"] < 0:
        assert done.returncode == 1 and "pull" in said, f"exit code {done.returncode}, N = {wanted['across']}: {said}"
        return
    assert done.returncode == 0, f"exit code {done.returncode}, N = {wanted['across']}: {said}"
    result = json.loads(done.stdout)
    force = result["forces"]["block"]["normal"]
    for k, axis in enumerate(("fx", "fy")):
        close(force[axis], wanted["across"] * wanted["n"][k], 1e-8 * (1 + wanted["across"]))
    close(result["final"]["block"]["x"], wanted["x"], 1e-9)


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 20
    count *= int(os.environ.get("FBD_DRAWS", "1"))
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    sound = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            wanted = scene(random.Random(seed))
            try:
                check(wanted, folder)
                sound += 1
            except (AssertionError, KeyError):
                with claim(f"seed {seed}"):
                    print("".join(f"# {line}\n" for line in wanted["text"].splitlines()), end="")
                    raise
    with claim(f"{count} slides on moving bodies"):
        assert sound == count, f"{count - sound} are wrong"
    finish()


main()
