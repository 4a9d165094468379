#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random pairs of shapes that are thrown at each other: none goes through, and each impact has its impulse.

A disc, prism, rod, particle, point of a body or of the ground, line or polygon meets another one, off centre, turning,
level or not, from any side, free, on a slide, on a pivot or fixed. Three kinds of scenes in turn:

  bounces  as the reference of pair_bodies.py has them: number of impacts, and the state after them
  lands    plastic, with friction or without, to rest on each other or past: no corner has come through the other shape
           from row to row, momentum is kept where nothing fixed takes part, and energy does not grow
  flat     sides that lie on each other: the closed form of two points of one plastic or elastic impact

    pairs.py [SCENES [SEED]]     a failing scene is printed with the seed that makes it
"""
import csv
import json
import math
import os
import random
import sys
import tempfile
from pathlib import Path

from pair_bodies import GROUND, KINDS, POINTS, Body, G, cross, dot, reference, turn

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / folder) for folder in ("page", "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, finish  # pylint: disable=wrong-import-position

RUN = os.environ["FBD_RUN"]


# ---- scenes

def draw(rng):
    while True:
        first = rng.choice([k for k in KINDS if k not in GROUND])
        second = rng.choice(KINDS)
        if first in POINTS and second in POINTS:
            continue
        break
    scale = rng.choice([1, 1, 1, 1e-3, 100])
    a, b = Body(rng, "a", first, scale), Body(rng, "b", second, scale)
    level = rng.random() < 0.3
    speed = scale * rng.choice([1, 1, 5])
    gravity = rng.random() < 0.5
    for body in (a, b):
        theta = rng.choice([0, 0, math.pi / 2]) if level else rng.uniform(-3, 3)
        spin = 0 if level or rng.random() < 0.3 else rng.uniform(-4, 4)
        body.pose0, body.rate0 = (0, 0, theta), (0, 0, spin)
        if body.kind == "particle":
            body.pose0, body.rate0 = (0, 0, 0), (0, 0, 0)
        if body.kind in GROUND:
            body.mount, body.rate0 = "fixed", (0, 0, 0)
            body.pose0 = (0, 0, theta if body.kind == "line" else 0)
            continue
        body.gravity = G if gravity else 0
        body.mount = rng.choice(["free", "free", "slide", "pivot", "fixed"] if body is b else ["free", "free", "slide"])
        if body.kind == "particle":
            body.mount = rng.choice(["free", "slide"])
    way = rng.choice([-1, 1]) * math.pi / 2 if level else rng.uniform(-3, 3)
    u = (math.cos(way), math.sin(way))
    if b.kind == "line":  # from one of its sides
        n = turn(b.pose0[2], (0, 1))
        sign = rng.choice([-1, 1])
        u = (sign * n[0], sign * n[1])
        way = math.atan2(u[1], u[0])
    off = rng.uniform(-0.4, 0.4) * (a.scale if b.kind == "line" else b.reach() or a.reach())
    apart = (a.reach() + (0 if b.kind == "line" else b.reach())) * rng.uniform(1.05, 1.5) + 0.05 * scale
    place = (u[0] * apart - u[1] * off, u[1] * apart + u[0] * off)
    a.pose0 = (place[0], place[1], a.pose0[2])
    share = rng.choice([0, 1, 0.5]) if b.mount in ("free", "slide") else 0
    a.rate0 = (-(1 - share) * speed * u[0], -(1 - share) * speed * u[1], a.rate0[2])
    b.rate0 = (share * speed * u[0], share * speed * u[1], b.rate0[2])
    for body, side in ((a, math.pi), (b, 0)):
        if body.mount == "slide":
            body.slide = way + side
            if body.kind != "particle":
                body.pose0 = (body.pose0[0], body.pose0[1], body.slide)
            body.rate0 = (body.rate0[0], body.rate0[1], 0)
    if b.mount == "fixed":
        b.rate0 = (0, 0, 0)
    if b.mount == "pivot":
        off_centre = rng.random() < 0.4
        b.arm = (rng.uniform(-0.5, 0.5) * b.size, 0) if off_centre else (0.0, 0.0)
        if off_centre:
            b.gravity = 0
        r = turn(b.pose0[2], b.arm)
        b.pivot = (b.pose0[0] - r[0], b.pose0[1] - r[1])
    shift = rng.choice([(0, 0), (0, 0), (scale * rng.uniform(-9, 9), scale * rng.uniform(-9, 9))])
    for body in (a, b):
        body.pose0 = (body.pose0[0] + shift[0], body.pose0[1] + shift[1], body.pose0[2])
        if body.mount == "pivot":
            body.pivot = (body.pivot[0] + shift[0], body.pivot[1] + shift[1])
    for body in (a, b):
        body.start = body.pose0
    return a, b, rng.choice([1, rng.uniform(0.3, 1), 0]), apart / speed * rng.uniform(1.5, 4)


def model(a, b, e, until, swapped):
    ends = [a.end(), b.end()]
    if swapped:
        ends.reverse()
    ground = f"ground: {{{b.ground()}}}\n" if b.kind in GROUND else ""
    bodies = [a.text()] + ([] if b.kind in GROUND else [b.text()])
    return (f"fbd: 1\n{ground}bodies:\n{''.join(bodies)}contacts: [{{name: c, between: [{ends[0]}, {ends[1]}], "
            f"restitution: {e!r}}}]\nsimulate: {{until: {until!r} s}}\n")


def run(text, rows=False):
    """What --json says, and the rows of the CSV."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "pair.yaml"
        path.write_text(text, encoding="utf-8")
        table = Path(folder) / "rows.csv"
        done = limits.run([RUN, "--quiet", "--json", "-", *(["--csv", table] if rows else []), path], capture_output=True, check=False, text=True)
        assert done.returncode == 0, f"exit code {done.returncode}: {done.stderr}\n{text}"
        lines = []
        if rows:
            with table.open(encoding="utf-8") as file:
                lines = list(csv.DictReader(file))
    return json.loads(done.stdout), lines


def near(name, now, right, size):
    assert abs(now - right) <= 2e-6 * size, f"{name} = {now!r}, not {right!r}"


def compare(body, final, t, speed):
    if body.kind in GROUND or body.mount == "fixed":
        return
    (x, y, th), (u, v, w) = body.pose(t)
    at = final[body.name]
    length = body.scale + math.hypot(x, y)
    turning = abs(w) + speed / body.size
    if body.mount == "slide":
        e = turn(body.slide, (1, 0))
        near(body.name + ".v", at["v"], u * e[0] + v * e[1], speed)
        return
    if body.mount == "pivot":
        near(body.name + ".omega", at["omega"], w, turning)
        near(body.name + ".theta", at["theta"], th, 1 + turning * t)
        return
    near(body.name + ".x", at["x"], x, length)
    near(body.name + ".y", at["y"], y, length)
    near(body.name + ".vx", at["vx"], u, speed)
    near(body.name + ".vy", at["vy"], v, speed)
    if body.kind != "particle":
        near(body.name + ".omega", at["omega"], w, turning)
        near(body.name + ".theta", at["theta"], th, 1 + turning * t)


def check_bounces(a, b, e, until, swapped):
    text = model(a, b, e, until, swapped)
    end, impacts, last = reference(a, b, e, until, 4)
    text = text.replace(f"until: {until!r} s", f"until: {end!r} s")
    result, _ = run(text)
    found = [event["t"] for event in result["events"] if event["kind"] == "impact"]
    assert len(found) == len(impacts), f"impacts at {found}, not at {impacts}\n{text}"
    speed = max([math.hypot(*body.velocity(body.where((0, 0), 0), 0)) for body in (a, b)] + [a.scale]) + G * end
    try:
        for body in (a, b):
            compare(body, result["final"], end - last, speed)
    except AssertionError as error:
        raise AssertionError(f"{error}\n{text}") from error
    return len(impacts)


# ---- plastic

def set_row(body, row):
    """Pose and rates of a row of the CSV."""
    if body.kind in GROUND or body.mount == "fixed":
        return

    def value(name):
        return next(float(v) for key, v in row.items() if key.split(" ")[0] == f"{body.name}.{name}")

    if body.mount == "slide":
        e = turn(body.slide, (1, 0))
        x, v = value("x"), value("v")
        body.pose0 = (body.start[0] + x * e[0], body.start[1] + x * e[1], body.start[2])
        body.rate0 = (v * e[0], v * e[1], 0)
    elif body.mount == "pivot":
        body.pose0, body.rate0 = (0, 0, value("theta")), (0, 0, value("omega"))
        body.pose0, body.rate0 = body.pose(0)
    else:
        planar = body.kind != "particle"
        body.pose0 = (value("x"), value("y"), value("theta") if planar else 0)
        body.rate0 = (value("vx"), value("vy"), value("omega") if planar else 0)


def places(a, b):
    """Of each corner at each side of the other: (height over its line, how far within its ends)."""
    out = []
    for p, q in ((a, b), (b, a)):
        for c in p.corners:
            at = p.where(c, 0)
            for s in q.sides():
                u, v = q.where(s[0], 0), q.where(s[1], 0)
                length = math.dist(u, v)
                e = ((v[0] - u[0]) / length, (v[1] - u[1]) / length)
                d = (at[0] - u[0], at[1] - u[1])
                foot = dot(e, d)
                out.append((cross(e, d), min(foot, length - foot)))
    return out


def energy(body):
    (_, y, _), (u, v, w) = body.pose(0)
    if body.kind in GROUND or body.mount == "fixed":
        return 0.0
    turning = body.inertia * w * w / 2 if body.mount != "slide" else 0
    return body.mass * (u * u + v * v) / 2 + turning + body.mass * body.gravity * y


def momentum(bodies, t):
    """(p_x, p_y without that of gravity, the moment of it about the common centre)."""
    mass = sum(b.mass for b in bodies)
    center = [sum(b.mass * b.pose(0)[0][k] for b in bodies) / mass for k in range(2)]
    p = [sum(b.mass * b.pose(0)[1][k] for b in bodies) for k in range(2)]
    L = sum(b.inertia * b.rate0[2] + b.mass * cross((b.pose0[0] - center[0], b.pose0[1] - center[1]), b.rate0[:2])
            for b in bodies)
    return p[0], p[1] + mass * bodies[0].gravity * t, L


def check_lands(rng, a, b, until, swapped):
    text = model(a, b, 0, until, swapped)
    if rng.random() < 0.5:
        text = text.replace("restitution: 0", f"static: {rng.uniform(0.1, 1)!r}")
    result, rows = run(text, True)
    free = a.mount == b.mount == "free"
    speed = max([math.hypot(*body.rate0[:2]) for body in (a, b)] + [a.scale]) + G * until
    scale = (a.mass + b.mass) * speed
    last, before, kept, sides = None, None, None, None
    for row in rows:
        for body in (a, b):
            set_row(body, row)
        t = float(row[next(iter(row))])
        now = places(a, b)
        sides = sides or [0] * len(now)
        for i, (h, within) in enumerate(now):
            thin = 1e-7 * (a.scale + abs(a.pose0[0]) + abs(a.pose0[1]))
            if within < thin:
                sides[i] = 0
            elif abs(h) > thin:
                step = 4 * speed * (t - (last or 0)) + 1e-3 * a.scale
                passed = sides[i] * h < 0 and abs(h) < step and abs(before[i][0]) < step and before[i][1] > thin
                assert not passed, f"corner {i} is through at t = {t}\n{text}"
                sides[i] = 1 if h > 0 else -1
        E = energy(a) + energy(b)
        if last is not None:
            assert E <= kept[0] + 1e-7 * scale * speed, f"energy grows to {E} at t = {t}\n{text}"
        kept = (E, kept[1] if kept else (momentum((a, b), t) if free else None))
        if free:
            for now_p, was, size in zip(momentum((a, b), t), kept[1], (scale, scale, scale * a.scale)):
                assert abs(now_p - was) <= 1e-6 * size, f"momentum {now_p} was {was} at t = {t}\n{text}"
        last, before = t, now
    return sum(event["kind"] == "impact" for event in result["events"])


# ---- flat

def check_flat(rng, swapped):
    """A level rod or prism falls on a level rod, prism, polygon or line, or that rises: two points of one impact."""
    scale = rng.choice([1, 1, 1e-3, 100])
    a = Body(rng, "a", rng.choice(["rod", "prism"]), scale)
    b = Body(rng, "b", rng.choice(["rod", "rod", "prism"]), scale)
    b.mount = rng.choice(["fixed", "free"])
    e = rng.choice([0, 0, rng.uniform(0.2, 1)])
    if a.kind == b.kind == "rod" and b.mount == "free":
        e = e or 0.5  # two free rods that stick flat press with next to nothing: such a run of 1 mm ended early, by name
    v = scale * rng.uniform(0.5, 3)
    sign = rng.choice([-1, 1])  # from above or from below
    high = [body.corners[-1][1] if len(body.corners) > 2 else 0 for body in (a, b)]
    gap = scale * rng.uniform(0.1, 2)
    x = rng.uniform(-0.7, 0.7) * (a.size + b.size) / 2
    share = rng.random() if b.mount == "free" else 0
    a.pose0, b.pose0 = (x, sign * (high[0] + high[1] + gap), 0), (0, 0, 0)
    a.rate0, b.rate0 = (0, -sign * (1 - share) * v, 0), (0, sign * share * v, 0)
    low, top = max(x - a.size / 2, -b.size / 2), min(x + a.size / 2, b.size / 2)
    until = (1.2 if b.mount == "fixed" else 1 + 1e-6) * gap / v  # free ones turn on together, or meet again
    result, _ = run(model(a, b, e, until, swapped))
    # Both ends of the common stretch have their velocities turned by -e, by impulses J at them, if both push.
    n = (0, sign)
    u = [(1 + e) * v] * 2
    give = [[sum(dot(n, body_gain(body, place, n, other)) for body in (a, b)) for other in (low, top)]
            for place in (low, top)]
    det = give[0][0] * give[1][1] - give[0][1] * give[1][0]
    J = [(u[0] * give[1][1] - u[1] * give[0][1]) / det, (give[0][0] * u[1] - give[1][0] * u[0]) / det]
    if top - low < 0.02 * scale or min(J) < 0.01 * max(J):
        return 0  # one end leaves at once
    t = gap / v
    for place, impulse in zip((low, top), J):
        for body, way in ((a, 1), (b, -1)):
            if body.mount != "free":
                continue
            body.rate0 = (0, body.rate0[1] + way * sign * impulse / body.mass,
                          body.rate0[2] + way * sign * impulse * (place - body.pose0[0]) / body.inertia)
    for body in (a, b):
        if body.mount != "free":
            continue
        final = result["final"][body.name]
        near(body.name + ".vy", final["vy"], body.rate0[1], v)
        near(body.name + ".omega", final["omega"], body.rate0[2], v / scale)
    assert abs(result["events"][0]["t"] - t) <= 1e-7 * t, f"strikes at {result['events'][0]['t']}, not at {t}"
    return 2


def body_gain(body, place, n, other):
    """The velocity at `other` of a unit impulse along n at `place`, both given by their x."""
    if body.mount != "free":
        return (0, 0)
    arm = (place - body.pose0[0]) * n[1] / body.inertia
    return (0, n[1] / body.mass + arm * (other - body.pose0[0]))


def main():
    scenes = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    scenes *= int(os.environ.get("FBD_DRAWS", "1"))
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    hits = 0
    for k in range(scenes):
        rng = random.Random(f"{seed} {k}")
        a, b, e, until = draw(rng)
        swapped = rng.random() < 0.5
        kind = k % 5
        what = "flat" if kind == 4 else f"{a.kind} ({a.mount}) at {b.kind} ({b.mount})"
        with claim(f"scene {k} of seed {seed}: {what}"):
            if kind == 4:
                hits += check_flat(rng, swapped)
            elif kind == 3:
                hits += check_lands(rng, a, b, until, swapped)
            else:
                hits += check_bounces(a, b, e or 0.5, until, swapped)
    print(f"# {hits} impacts")
    finish()


if __name__ == "__main__":
    main()
