#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes at the ends of the scales, against statics and closed forms: boxes that rest or slide far from the origin,
stiff joints at rest, stacks, pulleys and chains of unequal masses, and linear frequencies beside held bodies, on tracks and in
bowls.

    scales.py [SCENES [SEED]]
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

PROGRAM = os.environ["FBD_RUN"]
G = 9.81
APART = "[masses-apart]"
TOO_FAR = "times the mass of the lightest"


def ask(text, *options):
    """(exit code, JSON or None, what it says) of a scene."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "m.yaml"
        path.write_text(text, encoding="utf-8")
        done = limits.run([PROGRAM, "--quiet", "--json", "-", *options, path], stdin=subprocess.DEVNULL,
                          capture_output=True, check=False)
    said = done.stderr.decode(errors="replace")
    return done.returncode, json.loads(done.stdout) if done.stdout.startswith(b"{") else None, said


def box(name, mass, a, b, x, y, more=""):
    return (f"  {name}: {{shape: prism, mass: {mass!r}, a: {a!r}, b: {b!r}, motion: planar, "
            f"initial: {{x: {x!r}, y: {y!r}}}, forces: [gravity{more}]}}\n")


def stack(rng, far, masses, push):
    """Boxes upon each other whose lowest one is pushed at its centre by that share of what friction holds."""
    mu, y, text, contacts = 0.5, far, "", ""
    for i, mass in enumerate(masses):
        a, b = 0.6, round(rng.uniform(0.1, 0.3), 3)
        force = f", applied: {{value: {push * mu * G * sum(masses)!r}, angle: 0}}" if i == 0 and push else ""
        text += box(f"b{i}", mass, a, b, far + round(rng.uniform(-0.02, 0.02), 3), y + b / 2, force)
        below = f"b{i - 1}" if i else "ground.floor"
        contacts += f"  - {{between: [b{i}, {below}], static: {mu}, kinetic: {mu}}}\n"
        y += b
    head = f"fbd: 1\nground: {{lines: {{floor: {{through: [{far!r}, {far!r}], along: 0}}}}}}\nbodies:\n"
    return head + text + "contacts:\n" + contacts + "simulate: {until: 0.5}\n"


def far_away(rng):
    """The boxes rest, or all of them slide together by Coulomb's law, wherever the origin is."""
    far = rng.choice([0, 1e2, 1e3, 3e3, 1e4, 1e5])
    masses = [round(rng.uniform(1, 3), 3) for _ in range(rng.randint(1, 3))]
    slides = rng.random() < 0.3
    push = rng.uniform(1.1, 1.4) if slides else rng.uniform(0, 0.9)
    text = stack(rng, far, masses, push)
    code, out, said = ask(text)
    assert code == 0, said
    start = [float(line.split("x: ")[1].split(",")[0]) for line in text.splitlines() if "initial" in line]
    way = 0.5 * (push - 1) * 0.5 * G * 0.25 if slides else 0
    for i, x in enumerate(start):
        close(out["final"][f"b{i}"]["x"], x + way, 1e-7 + 1e-13 * far)
        close(out["final"][f"b{i}"]["theta"], 0, 1e-6)


def stiff(rng):
    """A rod on a stiff joint comes to rest where the spring carries the weight."""
    k, m, length = 10 ** rng.uniform(0, 14), round(rng.uniform(1, 5), 3), 0.4
    k = max(k, 20 * m * G * length)
    text = (f"fbd: 1\nbodies:\n  rod: {{shape: rod, length: {length}, mass: {m}, motion: {{pivot: {{point: left}}}}, "
            f"initial: {{theta: 0.45 rad}}, forces: [gravity], moments: [spring: {{stiffness: {k!r} N*m, neutral: 0.5}}, "
            f"damper: {2 * math.sqrt(k * m * length ** 2 / 3)!r} N*m*s]}}\nsimulate: {{until: 5 s}}\n")
    code, out, said = ask(text)
    assert code == 0, said
    theta = 0.5
    for _ in range(100):
        theta = 0.5 - m * G * length / 2 * math.cos(theta) / k
    close(out["final"]["rod"]["theta"], theta, 1e-7)


def heavy_on_light(rng):
    """The floor carries both, or it is said that the masses are too far apart; nothing else."""
    ratio = 10 ** rng.uniform(-14, 14)
    code, out, said = ask(stack(rng, 0, [2.0, 2.0 * ratio], 0))
    if not 1e-11 < ratio < 1e11 and APART in said:
        return
    assert code == 0, said
    carried = sum(arrow["fy"] for name, arrow in out["forces"]["b0"].items() if name.startswith("contact_b0_ground"))
    close(carried, 2 * (1 + ratio) * G, 1e-5 * 2 * (1 + ratio) * G)


def pulley(rng):
    """Blocks over a fixed and a hanging pulley: the exact acceleration, or the masses are too far apart."""
    m1, m2, m3 = (round(rng.uniform(1, 5), 3) for _ in range(3))
    mp = 10 ** rng.uniform(-15, 0)
    text = "fbd: 1\nground: {points: {P: [0, 0]}}\nbodies:\n"
    for name, mass, y in (("a", m1, -1), ("p", mp, -1), ("b", m2, -2), ("c", m3, -2)):
        text += f"  {name}: {{mass: {mass!r}, motion: {{slide: {{along: -90 deg, through: [0, {y}]}}}}, forces: [gravity]}}\n"
    text += "couplings:\n  - rope: {through: [a, ground.P, p]}\n  - rope: {through: [b, p, c]}\nsimulate: {until: 0.2}\n"
    code, out, said = ask(text)
    if mp < 1e-11 and APART in said:
        return
    assert code == 0, said
    # a goes down by a, p up by it; relative to p the lower blocks go by r: T from each, 2 T on p.
    tension = 4 * m2 * m3 / (m2 + m3)
    acceleration = (m1 - mp - tension) * G / (m1 + mp + tension)
    close(out["final"]["a"]["v"], acceleration * 0.2, 1e-6)


def chain(rng):
    """Rods of any masses on pins move as on pivots, which have no couplings; only masses further apart are refused."""
    count = rng.randint(1, 3)
    masses = [10 ** rng.uniform(-12, 1) for _ in range(count)]
    lengths = [round(rng.uniform(0.3, 1), 3) for _ in masses]
    angles = [rng.uniform(-2, 0) for _ in masses]
    pins, pivots, couplings, x, y = "", "", "", 0, 0
    for i, (mass, length, angle) in enumerate(zip(masses, lengths, angles)):
        dx, dy = length * math.cos(angle), length * math.sin(angle)
        shape = f"shape: rod, mass: {mass!r}, length: {length!r}, forces: [gravity]"
        pins += (f"  b{i}: {{{shape}, motion: planar, "
                 f"initial: {{x: {x + dx / 2!r}, y: {y + dy / 2!r}, theta: {angle!r}}}}}\n")
        on = f", on: b{i - 1}, at: right" if i else ""
        pivots += (f"  b{i}: {{{shape}, motion: {{pivot: {{point: left{on}}}}}, "
                   f"initial: {{theta: {angle - (angles[i - 1] if i else 0)!r}}}}}\n")
        couplings += f"  - pin: {{between: [b{i}.left, {f'b{i - 1}.right' if i else 'ground.O'}]}}\n"
        x, y = x + dx, y + dy
    head, simulate = "fbd: 1\nground: {points: {O: [0, 0]}}\nbodies:\n", "simulate: {until: 0.5, tolerance: 1e-10}\n"
    code, right, said = ask(head + pivots + simulate)
    assert code == 0, said
    code, out, said = ask(head + pins + "couplings:\n" + couplings + simulate)
    if max(masses) / min(masses) > 1e10 and TOO_FAR in said:
        return
    assert code == 0, said
    angle = 0
    for i in range(count):
        angle = right["final"][f"b{i}"]["theta"] + angle
        close(out["final"][f"b{i}"]["theta"], angle, 1e-6)


def frequency(rng):
    """A rod that hangs from a body which is held has the frequency of a pendulum; a track that is held, that of its slope."""
    length, x = round(rng.uniform(0.2, 2), 3), round(rng.uniform(-2, 2), 3)
    text = (f"fbd: 1\nbodies:\n  base: {{mass: 3, motion: {{slide: {{along: {rng.uniform(-30, 30)!r} deg, x: {x}}}}}}}\n"
            f"  bob: {{mass: 2, shape: rod, length: {length}, motion: {{pivot: {{on: base, at: [0, 0], point: left}}}}, "
            f"initial: {{theta: -80 deg}}, forces: [gravity]}}\nsimulate: {{until: 1}}\n")
    code, out, said = ask(text, "--linearize")
    assert code == 0, said
    found = max(abs(complex(value["re"], value["im"])) for value in out["eigenvalues"])
    close(found, math.sqrt(1.5 * G / length), 1e-7)


def eigenvalues(text):
    """Those of the linearisation with an imaginary part that is not negative."""
    code, out, said = ask(text, "--linearize")
    assert code == 0, said
    return sorted((complex(value["re"], value["im"]) for value in out["eigenvalues"] if value["im"] >= 0), key=abs)


def on_track(rng):
    """What rests at the lowest point of a curve swings by its curvature; a body that turns with it has more inertia."""
    curvature, mass, inertia = rng.uniform(0.2, 3), rng.uniform(0.5, 4), rng.uniform(0.01, 0.5)
    stiffness, damping, at = rng.choice([0, rng.uniform(1, 50)]), rng.choice([0, rng.uniform(0.1, 2)]), rng.uniform(-1, 1)
    turns = rng.random() < 0.5
    body = f"mass: {mass!r}, inertia: {inertia!r}" if turns else f"mass: {mass!r}"
    x = f"(x - ({at!r}[m]))"
    text = (f"fbd: 1\nbodies:\n  b: {{{body}, motion: {{track: {{y: '{curvature / 2!r}[1/m]*{x}^2 + "
            f"{rng.uniform(-0.1, 0.1)!r}[1/m^2]*{x}^3', from: -1.5, to: 1.5, turn: {'true' if turns else 'false'}}}}}, "
            f"initial: {{x: {at!r}}}, forces: [gravity, spring: {{stiffness: {stiffness!r}, neutral: REST}}, "
            f"damper: {damping!r}]}}\nsimulate: {{until: 1}}\n")
    code, out, said = ask(text.replace("REST", "0"), "--until", "0")
    assert code == 0, said
    s = out["final"]["b"]["s"]
    found = eigenvalues(text.replace("REST", repr(s)))
    moved = mass + (inertia * curvature ** 2 if turns else 0)
    half, square = damping / moved / 2, (mass * G * curvature + stiffness) / moved
    close(found[0].real, -half, 1e-6)
    close(found[0].imag, math.sqrt(square - half ** 2), 1e-6)


def in_bowl(rng):
    """What rolls to and fro in a bowl that is held has the frequency of a pendulum of the distance of the centres."""
    a = rng.uniform(0.05, 0.2)
    b, mass, inertia, weight = a + rng.uniform(0.1, 1), rng.uniform(0.5, 5), rng.uniform(1e-6, 0.3), rng.uniform(0.1, 2)
    shape, beta = rng.choice([("cylinder", 0.5), ("sphere", 0.4)])
    text = (f"fbd: 1\nbodies:\n  arm: {{mass: {weight!r}, inertia: {inertia!r}, motion: pivot, "
            f"points: {{C: [0, {a - b!r}]}}}}\n  ball: {{shape: {shape}, mass: {mass!r}, radius: {a!r}, "
            f"motion: {{pivot: {{on: arm, at: C}}}}, forces: [gravity]}}\n"
            f"  bowl: {{shape: ring, mass: 1, radius: {b!r}, motion: {{pivot: {{theta: 0}}}}}}\n"
            "couplings:\n  - gear: {between: [ball, bowl], inside: true}\nsimulate: {until: 1}\n")
    square = mass * G * (b - a) / (mass * (1 + beta) * (b - a) ** 2 + inertia)
    close(eigenvalues(text)[-1].imag, math.sqrt(square), 1e-6)


def main():
    count = int(sys.argv[1]) * int(os.environ.get("FBD_DRAWS", "1")) if len(sys.argv) > 1 else 30
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    for seed in range(first, first + count):
        for scene in (far_away, stiff, heavy_on_light, pulley, chain, frequency, on_track, in_bowl):
            with claim(f"seed {seed}: {scene.__name__}"):
                scene(random.Random(seed))
    finish()


main()
