#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes with bodies without mass (levers, pulleys, connecting rods), against closed forms and a separate
integration of their one coordinate; and the refusals of motions without inertia. By hand: `massless.py 500 SEED` draws
500 scenes of each kind. Prints TAP."""
import json
import math
import os
import random
import subprocess
import sys

RUN = os.environ["FBD_RUN"]
G, UNTIL = 9.81, 0.4


def run(text):
    return subprocess.run([RUN, "--json", "-", "--quiet", "-"], input=f"fbd: 1\n{text}simulate: {{until: {UNTIL} s}}\n",
                          capture_output=True, text=True, check=False)


def mass(draw):
    return 10 ** draw.uniform(-3, 3)


def integrated(acceleration, q, v):
    """q and q' at the end, with steps halved until that changes little: past a dead centre a heavy piston stands still
    and a light crank flies."""
    steps, last = 1000, None
    while True:
        try:
            now = stepped(acceleration, q, v, steps)
        except (OverflowError, ValueError):  # too long steps
            now = None
        if now and last and all(abs(a - b) <= 1e-7 * (1 + abs(a)) for a, b in zip(now, last)):
            return now
        steps, last = 2 * steps, now


def stepped(acceleration, q, v, steps):
    """By Runge and Kutta's method of fourth order."""
    h = UNTIL / steps
    for _ in range(steps):
        k1 = acceleration(q, v)
        k2 = acceleration(q + h / 2 * v, v + h / 2 * k1)
        k3 = acceleration(q + h / 2 * (v + h / 2 * k1), v + h / 2 * k2)
        k4 = acceleration(q + h * (v + h / 2 * k2), v + h * k3)
        q, v = q + h * v + h * h / 6 * (k1 + k2 + k3), v + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    return q, v


# ---- scenes, each with the values at the end

def atwood(draw):
    m1, m2, R = mass(draw), mass(draw), draw.uniform(0.05, 0.3)
    a = (m1 - m2) / (m1 + m2) * G
    return f"""
bodies:
  m1: {{mass: {m1!r} kg, motion: {{slide: {{along: -90 deg, through: [{-R!r} m, -9 m]}}}}, forces: [gravity]}}
  m2: {{mass: {m2!r} kg, motion: {{slide: {{along: -90 deg, through: [{R!r} m, -9 m]}}}}, forces: [gravity]}}
  pulley: {{mass: 0 kg, shape: disc, radius: {R!r} m, motion: pivot}}
couplings: [rope: {{through: [m1.G, pulley, m2.G]}}]
""", {("m1", "v"): a * UNTIL, ("m1", "x"): a * UNTIL ** 2 / 2, ("pulley", "omega"): a * UNTIL / R}


def movable_pulley(draw):
    M, m, r, R = mass(draw), mass(draw), draw.uniform(0.05, 0.3), draw.uniform(0.05, 0.3)
    a = (M - 2 * m) / (M + 4 * m) * G
    return f"""
ground: {{points: {{A: [{-r!r} m, 9 m]}}}}
bodies:
  load: {{mass: {M!r} kg, motion: {{slide: {{along: -90 deg}}}}, forces: [gravity]}}
  lower: {{mass: 0 kg, shape: disc, radius: {r!r} m, motion: {{pivot: {{on: load, at: [0, 0]}}}}}}
  upper: {{mass: 0 kg, shape: disc, radius: {R!r} m, motion: {{pivot: {{at: [{r + R!r} m, 9 m]}}}}}}
  weight: {{mass: {m!r} kg, motion: {{slide: {{along: -90 deg, through: [{r + 2 * R!r} m, 0 m]}}}}, forces: [gravity]}}
couplings: [rope: {{through: [ground.A, lower, upper, weight.G]}}]
""", {("load", "v"): a * UNTIL, ("weight", "v"): -2 * a * UNTIL, ("load", "x"): a * UNTIL ** 2 / 2}


def lever(draw):
    """A seesaw with points pinned to its ends, by pivots or by pins."""
    m1, m2, l1, l2 = mass(draw), mass(draw), draw.uniform(0.3, 2), draw.uniform(0.3, 2)
    start, pins = draw.uniform(-1, 1), draw.random() < 0.5
    w2 = G * (m1 * l1 - m2 * l2) / (m1 * l1 ** 2 + m2 * l2 ** 2)
    theta, omega = integrated(lambda q, v: -w2 * math.cos(q), start, 0)
    disc = "shape: disc, radius: 0.1 m, forces: [gravity]"
    x, y = math.cos(start), math.sin(start)
    joints = [f"motion: {{pivot: {{on: lever, at: [{l1!r} m, 0]}}}}", f"motion: {{pivot: {{on: lever, at: [{-l2!r} m, 0]}}}}"]
    if pins:
        joints = [f"motion: planar, initial: {{x: {l1 * x!r} m, y: {l1 * y!r} m}}",
                  f"motion: planar, initial: {{x: {-l2 * x!r} m, y: {-l2 * y!r} m}}"]
    coupled = """couplings:
  - pin: {name: P, between: [lever.a, one.G]}
  - pin: {name: Q, between: [lever.b, two.G]}
""" if pins else ""
    return f"""
bodies:
  lever: {{mass: 0 kg, points: {{a: [{l1!r} m, 0], b: [{-l2!r} m, 0]}}, motion: pivot, initial: {{theta: {start!r} rad}}}}
  one: {{mass: {m1!r} kg, {disc}, {joints[0]}}}
  two: {{mass: {m2!r} kg, {disc}, {joints[1]}}}
{coupled}""", {("lever", "theta"): theta, ("lever", "omega"): omega}


def slider_crank(draw):
    """With a light connecting rod: (I + m s'^2) theta'' + m s' s'' theta'^2 = -m_c g (r/2) cos theta, x = s(theta)."""
    I_m, m, r = mass(draw), mass(draw), draw.uniform(0.1, 0.3)
    L, start, omega = r * draw.uniform(2, 4), draw.uniform(0.3, 1.2), draw.uniform(-5, 5)
    I = I_m * r ** 2 / 3

    def slopes(q):
        s, c = r * math.sin(q), r * math.cos(q)
        root = math.sqrt(L * L - s * s)
        return -s - s * c / root, -c - (c * c - s * s) / root - s * s * c * c / root ** 3

    def acceleration(q, v):
        first, second = slopes(q)
        return (-I_m * G * r / 2 * math.cos(q) - m * first * second * v * v) / (I + m * first * first)

    theta, speed = integrated(acceleration, start, omega)
    x, y = r * math.cos(start), r * math.sin(start)
    beta = -math.asin(y / L)
    vx, vy, turning = -y * omega, x * omega, -r * math.cos(start) * omega / (L * math.cos(beta))
    return f"""
bodies:
  crank: {{mass: {I_m!r} kg, shape: rod, length: {r!r} m, motion: {{pivot: {{point: left}}}}, forces: [gravity],
    initial: {{theta: {start!r} rad, omega: {omega!r} rad/s}}}}
  con: {{mass: 0 kg, shape: rod, length: {L!r} m, motion: planar, initial: {{x: {x + L / 2 * math.cos(beta)!r} m,
    y: {y / 2!r} m, theta: {beta!r} rad, vx: {vx - L / 2 * math.sin(beta) * turning!r} m/s,
    vy: {vy + L / 2 * math.cos(beta) * turning!r} m/s, omega: {turning!r} rad/s}}}}
  piston: {{mass: {m!r} kg, motion: slide, initial: {{x: {x + L * math.cos(beta)!r} m, v: {slopes(start)[0] * omega!r} m/s}}}}
couplings:
  - pin: {{name: A, between: [crank.right, con.left]}}
  - pin: {{name: B, between: [con.right, piston.G]}}
""", {("crank", "theta"): theta, ("crank", "omega"): speed}


# ---- motions without inertia

REFUSED = {
    "pulley without a rope": ("pulley: {mass: 0 kg, shape: disc, radius: 0.1 m, motion: pivot}", "pulley.theta"),
    "wheel of a point mass": ("wheel: {mass: 1 kg, inertia: 0 kg*m^2, motion: {pivot: {point: G}}}", "wheel.theta"),
    "slider with a hanging point": ("""slider: {mass: 0 kg, motion: slide}
  point: {mass: 1 kg, motion: {pivot: {on: slider, at: [0, 0], point: [1 m, 0]}}, initial: {theta: 90 deg}, forces: [gravity]}""",
                                    "slider.x"),
}


def refused(bodies, name):
    done = run(f"bodies:\n  {bodies}\n")
    return done.returncode != 0 and f"no inertia resists the motion along `{name}`" in done.stderr


def slackens():
    """With one side of a rope on a light pulley the other one becomes slack, and nothing holds the pulley."""
    done = run("""bodies:
  pulley: {mass: 0 kg, shape: disc, radius: 0.2 m, motion: pivot}
  a: {mass: 1 kg, motion: {slide: {along: -90 deg, through: [-0.2 m, -3 m]}}, forces: [gravity, drag: {linear: 3 kg/s}]}
  b: {mass: 1 kg, motion: {slide: {along: -90 deg, through: [0.2 m, -3 m]}}, forces: [gravity, applied: {value: "-80[N/s]*t"}]}
couplings: [rope: {through: [a.G, pulley, b.G]}]
""")
    return done.returncode != 0 and "no inertia resists the motion along `pulley.theta`" in done.stderr


def fault(kind, draw):
    text, wanted = kind(draw)
    done = run(text)
    if done.returncode != 0:
        return f"{done.stderr}{text}"
    final = json.loads(done.stdout)["final"]
    for (body, name), value in wanted.items():
        if abs(final[body][name] - value) > 1e-7 * (1 + abs(value)):
            return f"{body}.{name} is {final[body][name]!r}, not {value!r}:{text}"
    return None


def swings():
    """Small oscillations of a disc on a light lever: those of a point, and the disc keeps its angle."""
    text = """fbd: 1
bodies:
  lever: {mass: 0 kg, motion: pivot, initial: {theta: -90 deg}}
  disc: {mass: 2 kg, shape: disc, radius: 0.2 m, motion: {pivot: {on: lever, at: [0.7 m, 0]}}, forces: [gravity]}
"""
    done = subprocess.run([RUN, "--linearize", "--json", "-", "--quiet", "-"], input=text, capture_output=True, text=True, check=False)
    return done.returncode == 0 and any(abs(value["im"] - math.sqrt(G / 0.7)) < 1e-7
                                        for value in json.loads(done.stdout)["eigenvalues"])


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 8
    draw = random.Random(int(sys.argv[2]) if len(sys.argv) > 2 else 1)
    kinds = [atwood, movable_pulley, lever, slider_crank]
    print(f"1..{len(kinds) + len(REFUSED) + 2}")
    failed = False
    for number, kind in enumerate(kinds, 1):
        faults = [text for text in (fault(kind, draw) for _ in range(count)) if text]
        print(f"{'not ok' if faults else 'ok'} {number} - {kind.__name__}: {count - len(faults)} of {count}")
        for line in "".join(faults[:2]).splitlines():
            print(f"# {line}")
        failed |= bool(faults)
    for number, (what, (bodies, name)) in enumerate(REFUSED.items(), len(kinds) + 1):
        fine = refused(bodies, name)
        print(f"{'ok' if fine else 'not ok'} {number} - {what} is refused")
        failed |= not fine
    last = len(kinds) + len(REFUSED)
    for number, (name, fine) in enumerate((("small oscillations of a disc on a light lever", swings()),
                                           ("a light pulley whose rope becomes slack is refused", slackens())), last + 1):
        print(f"{'ok' if fine else 'not ok'} {number} - {name}")
        failed |= not fine
    return failed


if __name__ == "__main__":
    sys.exit(main())
