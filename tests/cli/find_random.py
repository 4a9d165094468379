#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: find_random.py [SCENES] [SEED]: `fbd-run --find` on random scenes whose answers have a closed form. Prints TAP.

Each family is a function of a generator of random numbers. It returns the file, the question, options, and the list of
all solutions in the range, from formulas of statics and dynamics that use nothing of fbd. A value must differ from its
formula by at most the error that is printed with it, and that error must be a small part of the value.
"""
import json
import math
import os
import random
import subprocess
import sys
from collections import Counter

RUN = os.environ["FBD_RUN"]
G = 9.81
SHARE = 1e-6  # of the range: most error; 1e-10 of an outcome, more where a tolerance of the run counts


def scene(parameters, body, until=1, more=""):
    return f"fbd: 1\nparameters: {parameters}\n{more}bodies:\n{body}\nsimulate: {{until: {until} s}}\n"


def around(rng, value, least=0.0):
    """A range with the value inside, whose ends are round, so that the scan does not meet the value."""
    low = max(least, value * rng.uniform(0.2, 0.9))
    return float(f"{low:.3g}"), float(f"{value * rng.uniform(1.1, 3):.4g}")


def asked(name, ends, unit, condition):
    return f"{name} = {ends[0]!r}..{ends[1]!r}{' ' + unit if unit else ''}: {condition}"


# ---- slip

def block_on_incline(rng):
    """mu N = m g sin(phi) - P, with P along the incline."""
    phi, m = rng.uniform(5, 60), rng.uniform(0.1, 50)
    P = rng.choice([0, rng.uniform(-0.5, 0.9)]) * m * G * math.sin(math.radians(phi))
    mu = (m * G * math.sin(math.radians(phi)) - P) / (m * G * math.cos(math.radians(phi)))
    body = (f"  block: {{mass: {m} kg, motion: {{slide: {{along: {phi} deg}}}}, forces: [gravity, normal, "
            f"applied: {{name: P, value: {P!r} N}}, friction: {{static: mu, kinetic: 0.8*mu}}]}}")
    if rng.random() < 0.5:
        return scene("{mu: 0.3}", body), asked("mu", around(rng, mu), "", "block slips"), [], [mu]
    return scene("{mu: 0.3}", body), asked("mu", around(rng, mu), "", "block.friction"), ["--static"], [mu]


def angle_of_slip(rng):
    mu = rng.uniform(0.05, 1.5)
    body = ("  block: {mass: 2 kg, motion: {slide: {along: phi}}, forces: [gravity, normal, "
            f"friction: {{static: {mu}, kinetic: {mu / 2}}}]}}")
    return (scene("{phi: 10 deg}", body), asked("phi", (1.0, 80.0), "deg", "block slips"), [],
            [math.degrees(math.atan(mu))])


def oblique_pull(rng):
    """P cos(a) = mu (m g - P sin(a)) on a floor."""
    mu, m, a = rng.uniform(0.1, 0.9), rng.uniform(1, 80), math.radians(rng.uniform(-30, 60))
    P = mu * m * G / (math.cos(a) + mu * math.sin(a))
    lifts = m * G / math.sin(a) if a > 0 else math.inf
    ends = around(rng, P)
    ends = (ends[0], min(ends[1], float(f"{(P + lifts) / 2:.4g}")) if lifts < 1e9 else ends[1])
    body = (f"  crate: {{mass: {m} kg, motion: slide, forces: [gravity, normal, applied: {{name: P, value: P, "
            f"angle: {math.degrees(a)!r} deg}}, friction: {{static: {mu}, kinetic: {mu * 0.9}}}]}}")
    statics = rng.random() < 0.5
    return (scene("{P: 1 N}", body), asked("P", ends, "N", "crate.friction" if statics else "crate slips"),
            ["--static"] if statics else [], [P])


def upper_block(rng):
    """The lower block is pulled: F = mu (m1 + m2) g, without friction below."""
    m1, m2, mu = rng.uniform(0.5, 9), rng.uniform(0.5, 9), rng.uniform(0.1, 0.8)
    F = mu * (m1 + m2) * G
    body = (f"  lower: {{mass: {m1} kg, motion: slide, forces: [gravity, normal, applied: {{name: F, value: F}}]}}\n"
            f"  upper: {{mass: {m2} kg, motion: {{slide: {{on: lower}}}}, forces: [gravity, normal, "
            f"friction: {{static: {mu}, kinetic: {mu * 0.7}}}]}}")
    return scene("{F: 1 N}", body, 0.2), asked("F", around(rng, F), "N", "upper slips"), [], [F]


def hanging_mass(rng):
    """A weight that hangs on a rope pulls a block: m2 = mu m1."""
    m1, mu = rng.uniform(0.5, 9), rng.uniform(0.1, 0.9)
    body = (f"  block: {{mass: {m1} kg, motion: {{slide: {{through: [-5 m, 0.1 m]}}}}, forces: [gravity, normal, "
            f"friction: {{static: {mu}, kinetic: {mu * 0.7}}}]}}\n"
            "  weight: {mass: m, motion: {slide: {along: -90 deg, through: [0.1 m, -1 m]}}, forces: [gravity]}\n"
            "  pulley: {mass: 0.2 kg, shape: disc, radius: 0.1 m, motion: pivot, forces: [gravity]}")
    more = "couplings:\n  - rope: {name: cord, through: [block.G, pulley, weight.G]}\n"
    m = mu * m1
    return scene("{m: 1 kg}", body, 0.2, more), asked("m", around(rng, m, 1e-3), "kg", "block slips"), [], [m]


def rolling_disc(rng):
    """A disc (ring, sphere) that rolls needs mu = tan(phi)/(1 + m r^2/I)."""
    shape, k = rng.choice([("disc", 3), ("ring", 2), ("sphere", 3.5)])
    phi, r = rng.uniform(5, 60), rng.uniform(0.05, 1)
    s, c = math.sin(math.radians(phi)), math.cos(math.radians(phi))
    body = (f"  disc: {{mass: 2 kg, shape: {shape}, radius: {r} m, motion: planar, forces: [gravity], "
            f"initial: {{x: {r * s!r} m, y: {r * c!r} m}}}}")
    more = (f"ground: {{lines: {{hill: {{along: -{phi} deg}}}}}}\n"
            "contacts:\n  - {name: tread, between: [disc, ground.hill], static: mu, kinetic: mu}\n")
    mu = s / c / k
    return scene("{mu: 0.3}", body, 0.1, more), asked("mu", around(rng, mu), "", "disc slips"), [], [mu]


def ladder(rng):
    """Smooth wall, friction at the foot only: mu N = F cot(phi) (W/2 + P s/L)/F, N = W + P + the foot's weight."""
    L, W, P, phi = rng.uniform(2, 6), rng.uniform(5, 30) * G, rng.uniform(0, 900), math.radians(rng.uniform(45, 75))
    s = rng.uniform(0.1, 0.9) * L
    wall = (W / 2 + P * s / L) / math.tan(phi)
    mu = wall / (W + P)
    body = (f"  ladder: {{shape: rod, length: {L!r} m, mass: {W / G!r} kg, motion: planar, points: {{rung: [{s - L / 2!r}, 0]}}, "
            f"initial: {{x: {-L / 2 * math.cos(phi)!r}, y: {L / 2 * math.sin(phi)!r}, theta: {phi!r}}}, "
            f"forces: [gravity, applied: {{name: P, value: [0, {-P!r} N], at: rung}}]}}")
    more = ("ground: {lines: {floor: {along: 0 deg}, wall: {along: 90 deg}}}\n"
            "contacts:\n  - {name: floor, between: [ladder, ground.floor], static: mu, kinetic: mu}\n"
            "  - {name: wall, between: [ladder, ground.wall]}\n")
    statics = rng.random() < 0.5
    return (scene("{mu: 0.9}", body, 0.05, more), asked("mu", around(rng, mu), "", "ladder slips")[:-15 if statics else None],
            ["--static"] if statics else [], [mu])


# ---- tip

def box(rng, a, b, forces, more, start="", angle=0.0):
    return (f"  box: {{shape: prism, a: {a!r} m, b: {b!r} m, mass: 5 kg, motion: planar, forces: [gravity{forces}], "
            f"initial: {{x: {-b / 2 * math.sin(angle)!r} m, y: {b / 2 * math.cos(angle)!r} m, theta: {angle!r}{start}}}}}"), more


def box_on_incline(rng):
    """It tips at tan(phi) = a/b if it does not slip before: searched over the breadth of the box."""
    a, phi = rng.uniform(0.1, 0.5), math.radians(rng.uniform(5, 40))
    b = a / math.tan(phi)
    body = (f"  box: {{shape: prism, a: {a!r} m, b: b, mass: 5 kg, motion: planar, forces: [gravity], "
            f"initial: {{x: -b/2*sin({phi!r}), y: b/2*cos({phi!r}), theta: {phi!r}}}}}")
    more = (f"ground: {{lines: {{hill: {{along: {phi!r}}}}}}}\n"
            "contacts:\n  - {name: floor, between: [box, ground.hill], static: 1.2, kinetic: 1}\n")
    return scene("{b: 1 m}", body, 0.05, more), asked("b", around(rng, b), "m", "box tips"), [], [b]


def pushed_box(rng):
    """P h = m g a/2 where it does not slide before, else P = mu m g."""
    a, b, mu = rng.uniform(0.1, 1), rng.uniform(0.1, 1), rng.uniform(0.05, 0.9)
    h = rng.uniform(0.1, 1) * b
    tips, slips = 5 * G * a / 2 / h, mu * 5 * G
    body, more = box(rng, a, b, f", applied: {{name: P, value: P, angle: 0 deg, at: [{-a / 2!r}, {h - b / 2!r}]}}",
                     "ground: {lines: {floor: {along: 0 deg}}}\n"
                     f"contacts:\n  - {{name: floor, between: [box, ground.floor], static: {mu}, kinetic: {mu}}}\n")
    first, word = (tips, "tips") if tips < slips else (slips, "slips")
    ends = (float(f"{first * 0.3:.3g}"), float(f"{(first + (max(tips, slips) - first) * 0.5) if first > 0.9 * max(tips, slips) else first * 1.08:.4g}"))
    return scene("{P: 1 N}", body, 0.02, more), asked("P", ends, "N", f"box {word}"), [], [first]


def braking_box(rng):
    """It slides and brakes by friction: it tips at mu b = a."""
    a, b = rng.uniform(0.2, 1), rng.uniform(0.4, 2)
    mu = a / b
    body, more = box(rng, a, b, "", "ground: {lines: {floor: {along: 0 deg}}}\n"
                     "contacts:\n  - {name: floor, between: [box, ground.floor], static: mu, kinetic: mu}\n", ", vx: 3 m/s")
    low = around(rng, mu)[0]  # with mu b > 2 a/b the box is near the limit of Painleve's paradox
    return scene("{mu: 0.3}", body, 0.05, more), asked("mu", (low, float(f"{1.15 * mu:.4g}")), "", "box tips"), [], [mu]


def overhanging_beam(rng):
    """A plank of length L on two supports, one at the left end, one at c; a load P at the right end: P (L - c) = W (c - L/2)."""
    L, m = rng.uniform(2, 6), rng.uniform(5, 40)
    c = rng.uniform(0.55, 0.9) * L
    P = m * G * (c - L / 2) / (L - c)
    # The left support is a surface that cannot pull: a massless-like foot on the ground below the end of the plank.
    foot = 0.5
    body = (f"  beam: {{shape: rod, length: {L!r} m, mass: {m!r} kg, motion: {{pivot: {{at: [{c!r}, 0], point: [{c - L / 2!r}, 0]}}}}, "
            f"forces: [gravity, applied: {{name: P, value: [0, -P], at: right}}]}}\n"
            f"  foot: {{mass: {foot} kg, motion: {{slide: {{along: 0 deg}}}}, forces: [gravity, normal]}}")
    more = "couplings:\n  - pin: {name: hinge, between: [beam.left, foot.G]}\n"
    P = (m * G * (c - L / 2) + foot * G * c) / (L - c)
    return scene("{P: 1 N}", body, 0.05, more), asked("P", around(rng, P), "N", "foot.normal"), ["--static"], [P]


# ---- lift

def loop(rng):
    """It leaves the loop for R < h < 5 R/2, with v^2 = 2 g h at its bottom."""
    R = rng.uniform(0.2, 3)
    body = ("  car: {mass: 2 kg, motion: {track: {x: R*sin(p), y: R*(1 - cos(p)), from: 0 deg, to: 360 deg, closed: true}}, "
            "initial: {v: sqrt(2*g*h)}, forces: [gravity, normal]}")
    return (scene(f"{{R: {R!r} m, h: 1 m}}", body, round(3 * math.sqrt(R), 2)),
            asked("h", (float(f"{0.3 * R:.3g}"), float(f"{3 * R:.3g}")), "m", "car lifts"), [], [R, 2.5 * R])


def bump(rng):
    """On top of a circular bump: v^2 = g R lifts it at once; below that it lifts at cos(p) = (2 + v^2/(g R))/3."""
    R = rng.uniform(0.5, 20)
    body = ("  car: {mass: 2 kg, motion: {track: {x: R*sin(p), y: R*cos(p), from: -80 deg, to: 80 deg}}, "
            "initial: {p: 0, v: v0}, forces: [gravity, normal]}")
    share = rng.uniform(0.3, 0.9)
    s = R * math.acos((2 + share) / 3)
    v0 = math.sqrt(share * G * R)
    return (scene(f"{{R: {R!r} m, v0: 1 m/s}}", body, 60),
            asked("v0", (float(f"{v0 * 0.8:.3g}"), float(f"{0.98 * math.sqrt(G * R):.3g}")), "m/s",
                  f"at(contact_lost, car.s) = {s!r} m"), [], [v0])


def bump_at_once(rng):
    R = rng.uniform(0.5, 20)
    body = ("  car: {mass: 2 kg, motion: {track: {x: R*sin(p), y: R*cos(p), from: -80 deg, to: 80 deg}}, "
            "initial: {p: 0, v: v0}, forces: [gravity, normal]}")
    v0 = math.sqrt(G * R)
    until = 1e-6
    return (scene(f"{{R: {R!r} m, v0: 1 m/s}}", body, until), asked("v0", around(rng, v0), "m/s", "car lifts"), [], [v0])


def slack_rope(rng):
    """A vertical circle from the bottom: the rope becomes slack for 2 g L < v^2 < 5 g L."""
    L = rng.uniform(0.3, 3)
    body = "  bob: {mass: 2 kg, motion: particle, initial: {x: 0, y: -L, vx: v0}, forces: [gravity]}"
    more = "ground: {points: {A: [0, 0]}}\ncouplings:\n  - rope: {name: cord, through: [bob, ground.A], length: L}\n"
    low, high = math.sqrt(2 * G * L), math.sqrt(5 * G * L)
    return (scene(f"{{L: {L!r} m, v0: 1 m/s}}", body, round(2.2 * math.sqrt(L), 2), more),
            asked("v0", (float(f"{0.5 * low:.3g}"), float(f"{1.3 * high:.3g}")), "m/s", "bob.rope_slack"), [], [low, high])


# ---- break

def breaking_string(rng):
    """A bob that is released at the angle alpha: T = m g (3 - 2 cos(alpha)) below."""
    L, m, alpha = rng.uniform(0.3, 3), rng.uniform(0.1, 5), math.radians(rng.uniform(20, 90))
    T = m * G * (3 - 2 * math.cos(alpha))
    body = (f"  bob: {{mass: m, motion: particle, initial: {{x: {L * math.sin(alpha)!r}, y: {-L * math.cos(alpha)!r}}}, "
            "forces: [gravity]}")
    more = ("ground: {points: {A: [0, 0]}}\n"
            "couplings:\n  - rope: {name: cord, through: [bob, ground.A], until: tension > T_max}\n")
    until = round(1.4 * math.sqrt(L), 2)
    if rng.random() < 0.5:
        return (scene(f"{{m: {m!r} kg, T_max: 1 N}}", body, until, more), asked("T_max", around(rng, T), "N", "cord breaks"),
                [], [T])
    return (scene(f"{{m: 1 kg, T_max: {T!r} N}}", body, until, more), asked("m", around(rng, m, 0.02), "kg", "cord breaks"), [], [m])


def whirled_string(rng):
    """v = sqrt(L (T/m - g)) at the lowest point."""
    L, m = rng.uniform(0.3, 3), rng.uniform(0.1, 5)
    T = m * G * rng.uniform(1.3, 2.9)
    v0 = math.sqrt(L * (T / m - G))
    body = f"  bob: {{mass: {m!r} kg, motion: particle, initial: {{x: 0, y: {-L!r}, vx: v0}}, forces: [gravity]}}"
    more = ("ground: {points: {A: [0, 0]}}\n"
            f"couplings:\n  - rope: {{name: cord, through: [bob, ground.A], until: tension > {T!r} N}}\n")
    return scene("{v0: 1 m/s}", body, 0.01, more), asked("v0", around(rng, v0), "m/s", "bob breaks"), [], [v0]


def most_tension(rng):
    L, m, alpha = rng.uniform(0.3, 3), rng.uniform(0.1, 5), rng.uniform(20, 85)
    T = m * G * (3 - 2 * math.cos(math.radians(alpha)))
    body = f"  bob: {{mass: {m!r} kg, motion: particle, initial: {{x: {L!r}*sin(alpha), y: -{L!r}*cos(alpha)}}, forces: [gravity]}}"
    more = "ground: {points: {A: [0, 0]}}\ncouplings:\n  - rope: {name: cord, through: [bob, ground.A]}\n"
    until = round(1.4 * math.sqrt(L), 2)
    event = f"{until} s, events: [{{name: strong, when: cord.tension > {T!r} N}}]}}"
    return (scene("{alpha: 30 deg}", body, until, more).replace(f"{until} s}}", event),
            asked("alpha", (5.0, 89.0), "deg", "strong"), [], [alpha])


# ---- results of a run

def braking_distance(rng):
    mu, d = rng.uniform(0.1, 1), rng.uniform(1, 80)
    v0 = math.sqrt(2 * mu * G * d)
    body = (f"  car: {{mass: 900 kg, motion: slide, initial: {{v: v0}}, forces: [gravity, normal, friction: {{static: {mu}, "
            f"kinetic: {mu}}}]}}")
    if rng.random() < 0.5:
        return scene("{v0: 1 m/s}", body, 60), asked("v0", around(rng, v0), "m/s", f"car.x = {d!r} m"), [], [v0]
    t = v0 / (mu * G)
    return scene("{v0: 1 m/s}", body, 60), asked("v0", around(rng, v0), "m/s", f"time(car.stick) = {t!r} s"), [], [v0]


def two_angles(rng):
    """Height y at the distance d: g d^2/(2 v^2) (1 + u^2) - d u + y = 0 for u = tan(angle)."""
    v, d = rng.uniform(10, 30), rng.uniform(2, 8)
    q = G * d * d / (2 * v * v)
    y = rng.uniform(-0.5, 0.95) * (d * d / (4 * q) - q)
    root = math.sqrt(d * d - 4 * q * (q + y))
    both = [math.degrees(math.atan((d + sign * root) / (2 * q))) for sign in (-1, 1)]
    body = (f"  ball: {{mass: 1 kg, motion: particle, initial: {{vx: \"{v!r}[m/s]*cos(angle)\", vy: \"{v!r}[m/s]*sin(angle)\"}}, "
            "forces: [gravity]}")
    file = scene("{angle: 45 deg}", body, 500).replace("500 s}", f"500 s, events: [{{name: wall, when: x = {d!r} m, then: stop}}]}}")
    return file, asked("angle", (-60.0, 89.0), "deg", f"ball.y = {y!r} m"), [], [a for a in both if -60 < a < 89]


def best_angle_is_a_pair(rng):
    """The range v^2 sin(2a)/g a little below its maximum: two angles near each other."""
    v, share = rng.uniform(5, 30), rng.choice([1e-2, 1e-3, 1e-4, 1e-5]) * rng.uniform(0.5, 5)
    d = v * v / G * (1 - share)
    half = math.degrees(math.asin(1 - share)) / 2
    body = f"  ball: {{mass: 1 kg, motion: particle, initial: {{vx: \"{v!r}[m/s]*cos(angle)\", vy: \"{v!r}[m/s]*sin(angle)\"}}, forces: [gravity]}}"
    file = scene("{angle: 45 deg}", body, 50).replace("50 s}", "50 s, events: [{name: land, when: y = 0 m, then: stop}]}")
    return file, asked("angle", (10.0, 77.0), "deg", f"ball.x = {d!r} m"), [], [half, 90 - half]


def greatest_deflection(rng):
    m, k, v0 = rng.uniform(0.1, 9), rng.uniform(10, 900), rng.uniform(0.1, 3)
    d = v0 * math.sqrt(m / k)
    body = f"  block: {{mass: {m!r} kg, motion: slide, initial: {{v: {v0!r} m/s}}, forces: [spring: {{stiffness: k}}]}}"
    return (scene("{k: 1 N/m}", body, round(4 * math.sqrt(m / k) * 2, 3)),
            asked("k", around(rng, k), "N/m", f"max(block.x) = {d!r} m"), [], [k])


def many_zeros(rng):
    """x = cos(sqrt(k/m) t): every zero in the range."""
    t = rng.uniform(1, 3)
    roots = [((n + 0.5) * math.pi / t) ** 2 for n in range(40)]
    low, high = 8.0, float(f"{rng.uniform(200, 500):.3g}")
    body = "  block: {mass: 1 kg, motion: slide, initial: {x: 1 m}, forces: [spring: {stiffness: k}]}"
    return (scene("{k: 1 N/m}", body, repr(t)), asked("k", (low, high), "N/m", "block.x = 0 m"), ["--runs", "257"],
            [k for k in roots if low < k < high])


def drop_height(rng):
    """The time of an event: h = g t^2/2."""
    t = rng.uniform(0.3, 3)
    h = G * t * t / 2
    body = "  ball: {mass: 1 kg, motion: particle, initial: {y: h}, forces: [gravity]}"
    file = scene("{h: 1 m}", body, 50).replace("50 s}", "50 s, events: [{name: land, when: y = 0 m, then: stop}]}")
    return file, asked("h", around(rng, h), "m", f"time(land) = {t!r} s"), [], [h]


FAMILIES = [block_on_incline, angle_of_slip, oblique_pull, upper_block, hanging_mass, rolling_disc, ladder, box_on_incline,
            pushed_box, braking_box, overhanging_beam, loop, bump, bump_at_once, slack_rope, breaking_string, whirled_string,
            most_tension, braking_distance, two_angles, best_angle_is_a_pair, greatest_deflection, many_zeros, drop_height]


def fault(family, seed):
    """What is wrong with the answer to a scene, or None; and the scene."""
    file, question, options, expected = family(random.Random(f"{family.__name__} {seed}"))
    command = [RUN, "--find", question, *options, "--json", "-", "-"]
    done = subprocess.run(command, input=file, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    told = f"{file}# {question} {' '.join(options)}\n# expected {expected}\n{done.stdout}{done.stderr}"
    if done.returncode != (0 if expected else 1) or not done.stdout:
        return f"exit {done.returncode}", told
    it = json.loads(done.stdout)
    found = [s for s in it["solutions"] if s["kind"] != "jump"]
    if len(found) != len(expected):
        return f"{len(found)} solutions of {len(expected)}", told
    for solution, value in zip(found, sorted(expected)):
        off, error = abs(solution["value"] - value), solution["error"]
        if not off <= error + 4e-15 * abs(value):
            return f"off by {off:.2g}, error {error:.2g}", told
        if not error <= SHARE * (it["to"] - it["from"]) * (10 if "--static" in options else 1):
            return f"error {error:.2g}", told
    return None, told


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 120
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    faults = Counter()
    for i in range(count):
        family = FAMILIES[i % len(FAMILIES)]
        wrong, told = fault(family, first + i // len(FAMILIES))
        if not wrong:
            continue
        faults[family.__name__] += 1
        if faults[family.__name__] <= 2:
            print(f"# {family.__name__} {first + i // len(FAMILIES)}: {wrong}\n" + "\n".join(f"#   {line}" for line in told.splitlines()))
    for number, family in enumerate(FAMILIES, 1):
        print(f"{'not ok' if faults[family.__name__] else 'ok'} {number} - {family.__name__}"
              f"{f' # {faults[family.__name__]} wrong' if faults[family.__name__] else ''}")
    print(f"1..{len(FAMILIES)}")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
