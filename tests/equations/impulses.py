#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Impulses in derivations are those of the impact: lines with impulse(...) are compared with the impulses that the law of
impact has found, which the event of the run tells. A line of that number is accepted, or not checked; one that is off by
1e-6 is never accepted. Random scenes with one impact: slides with and without friction against oblique walls, spinning
bodies on slopes, oblique impacts, pendulums, ropes.

FBD_DRAWS: times as many; FBD_SEED: other ones.
"""
import json
import os
import random
import subprocess
import sys
from collections import Counter
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path.insert(0, str(SOURCE / "tests" / "page"))
from claims import claim, finish  # noqa: E402

RUN = os.environ["FBD_RUN"]
DRAWS = 24 * int(os.environ.get("FBD_DRAWS", "1"))
SEED = int(os.environ.get("FBD_SEED", "20261128"))


def friction(rng, name="static: {0:.3f}, kinetic: {0:.3f}"):
    return ", " + name.format(rng.uniform(0.05, 0.6)) if rng.random() < 0.6 else ""


def slide_and_wall(rng):
    """A disc on a slope, its slide with friction or without, against a wall that is not across it."""
    slope, lean = rng.uniform(-30, 30), rng.uniform(60, 120)
    rubs = f", {{friction: {rng.uniform(0.1, 0.5):.3f}}}" if rng.random() < 0.5 else ""
    return (f"ground: {{lines: {{wall: {{through: [0.8, 0.1], along: {slope + lean:.4f} deg}}}}}}\nbodies:\n"
            f"  b: {{shape: disc, radius: 0.1, mass: {rng.uniform(0.5, 5):.3f}, motion: {{slide: {{along: {slope:.4f} deg}}}},\n"
            f"      initial: {{v: {rng.uniform(2, 6):.3f}}}, forces: [gravity, normal{rubs}], hand: [HAND]}}\n"
            f"contacts: [{{name: c, between: [b, ground.wall], restitution: {rng.uniform(0, 0.9):.3f}}}]\n", "b.v", "v", [])


def body_and_floor(rng):
    shape = rng.choice(["shape: disc, radius: 0.2", "shape: prism, a: 0.4, b: 0.25", "shape: rod, length: 0.6"])
    rubs = friction(rng)
    return (f"ground: {{lines: {{floor: {{through: [0, 0], along: {rng.uniform(-25, 25):.4f} deg}}}}}}\nbodies:\n"
            f"  b: {{{shape}, mass: {rng.uniform(0.5, 5):.3f}, motion: planar, forces: [gravity], hand: [HAND],\n"
            f"      initial: {{y: 1.2, vx: {rng.uniform(-1, 1):.3f}, theta: {rng.uniform(-3, 3):.3f}, omega: {rng.uniform(-6, 6):.3f}}}}}\n"
            f"contacts: [{{name: c, between: [b, ground.floor], restitution: {rng.uniform(0, 0.9):.3f}{rubs}}}]\n", "b.vy", "vy", [rubs])


def two_bodies(rng):
    rubs, slide = friction(rng), rng.random() < 0.5
    guide = f", {{friction: {rng.uniform(0.1, 0.5):.3f}}}" if slide and rng.random() < 0.5 else ""
    second = (f"motion: slide, forces: [gravity, normal{guide}]" if slide else "motion: planar")
    place = f"x: 1, v: {rng.uniform(-2, 0):.3f}" if slide else f"x: 1, y: {rng.uniform(-0.15, 0.15):.3f}, omega: {rng.uniform(-5, 5):.3f}"
    return (f"bodies:\n  b: {{shape: disc, radius: 0.1, mass: {rng.uniform(0.5, 5):.3f}, motion: planar, hand: [HAND],\n"
            f"      initial: {{y: {rng.uniform(-0.1, 0.1):.3f}, vx: {rng.uniform(2, 5):.3f}, omega: {rng.uniform(-5, 5):.3f}}}}}\n"
            f"  o: {{shape: disc, radius: 0.1, mass: {rng.uniform(0.5, 5):.3f}, {second}, initial: {{{place}}}}}\n"
            f"contacts: [{{name: c, between: [b, o], restitution: {rng.uniform(0, 0.9):.3f}{rubs}}}]\n", "b.vx", "vx", [rubs])


def pendulum(rng):
    """A rod on a pin is struck by a disc, or strikes a peg."""
    rubs = friction(rng)
    return ("bodies:\n"
            f"  rod: {{shape: rod, length: 1, mass: {rng.uniform(0.5, 5):.3f}, motion: {{pivot: {{at: [0, 0], point: left}}}},\n"
            f"        initial: {{theta: {rng.uniform(-120, -60):.3f} deg, omega: {rng.uniform(-1, 1):.3f}}}, forces: [gravity]}}\n"
            f"  b: {{shape: disc, radius: 0.1, mass: {rng.uniform(0.5, 5):.3f}, motion: planar, hand: [HAND],\n"
            f"      initial: {{x: -1, y: {rng.uniform(-0.8, -0.5):.3f}, vx: {rng.uniform(3, 6):.3f}, omega: {rng.uniform(-5, 5):.3f}}}}}\n"
            f"contacts: [{{name: c, between: [b, rod], restitution: {rng.uniform(0, 0.9):.3f}{rubs}}}]\n", "b.vx", "vx", [rubs])


def rope(rng):
    guide = f", {{friction: {rng.uniform(0.1, 0.5):.3f}}}" if rng.random() < 0.5 else ""
    return ("bodies:\n"
            f"  b: {{mass: {rng.uniform(0.5, 5):.3f}, motion: particle, hand: [HAND],\n"
            f"      initial: {{x: 0.3, y: {rng.uniform(0.1, 0.4):.3f}, vx: {rng.uniform(3, 6):.3f}, vy: {rng.uniform(-1, 1):.3f}}}}}\n"
            f"  o: {{shape: disc, radius: 0.1, mass: {rng.uniform(0.5, 5):.3f}, motion: slide, forces: [gravity, normal{guide}]}}\n"
            "couplings: [{rope: {name: c, through: [b.G, o.G], length: 1}}]\n", "b.vx", "vx", None)


def run(text, *options):
    return subprocess.run([RUN, *options, "-"], input=text, capture_output=True, text=True, check=False)


def impacts(text):
    done = run(text, "--quiet", "--json", "/dev/stdout")
    found = json.loads(done.stdout)
    return [e for e in found["events"] if e["kind"] in ("impact", "rope_taut")]


def check(rng, kind, total):
    body, _, speed, rubs = kind(rng)
    scene = "fbd: 1\n" + body
    whole = impacts(scene.replace(", hand: [HAND]", "") + "simulate: {until: 2}\n")
    if not whole or (len(whole) > 1 and whole[1]["t"] < whole[0]["t"] + 1e-6):
        total["without one impact"] += 1
        return
    first, until = whole[0], 2 if len(whole) == 1 else (whole[0]["t"] + whole[1]["t"]) / 2
    name, p, tau = "impulse(c)" if rubs is None else "impulse(c.normal)", first["normal_impulse"], first["friction_impulse"]
    lines = [(name, p, "")]
    if rubs and rubs[0]:
        lines.append(("impulse(c.friction)", abs(tau), "abs"))
    for line, value, wrap in lines:
        for factor in (1, 1 + 1e-6, -1):
            if wrap and factor == -1:
                continue
            left = f"abs({line})" if wrap else line
            text = f'"{left} + 0*m*after({speed}) = {factor * value:.17g}[N*s]"'
            done = run(scene.replace("HAND", text) + f"simulate: {{until: {until:.17g}}}\n", "--check-hand")
            assert "not checked" in done.stdout or done.returncode in (0, 4), done.stdout + done.stderr
            accepted = "holds at 1 impact" in done.stdout
            total["true" if factor == 1 and accepted else "not checked" if "not checked" in done.stdout else "false"] += 1
            if factor == 1:
                assert accepted or "not checked" in done.stdout, f"{text}: {done.stdout}\n{scene}"
            else:
                assert not accepted or value == 0, f"{text}: {done.stdout}\n{scene}"


def main():
    rng, total = random.Random(SEED), Counter()
    for kind in (slide_and_wall, body_and_floor, two_bodies, pendulum, rope):
        with claim(f"{kind.__name__}: impulses of derivations are those of the law"):
            for _ in range(DRAWS // 4):
                check(rng, kind, total)
    with claim(f"most are known: {dict(total)}"):
        assert total["true"] > total["not checked"] / 3 and total["true"] >= DRAWS / 2, total
    finish()


main()
