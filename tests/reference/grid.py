# SPDX-License-Identifier: GPL-3.0-or-later
"""The block on an inclined plane over coefficients of friction and angles: in closed form, and as fbd-sweep computes it.

x is the distance up the slope from the start, mu both coefficients, T = 1 s. Let go (v0 = 0), the block rests where
tan(phi) <= mu, else it slides down with g (sin(phi) - mu cos(phi)). Thrown up (v0 = 3 m/s), it slows down with
g (sin(phi) + mu cos(phi)), and at v = 0 it rests or slides back by the same rule. Points at the limit, tan(phi) = mu, where
rounding decides, are left out.
"""
import csv
import io
import subprocess
from dataclasses import dataclass
from math import cos, inf, radians, sin, tan
from pathlib import Path

MODEL = Path(__file__).resolve().parent.parent.parent / "models" / "kinetics" / "incline.yaml"
GRAVITY, T = 9.81, 1.0
SPEEDS = (0.0, 3.0)  # of the start [m/s]
MUS = [n / 10 for n in range(11)]
ANGLES = [5 * n for n in range(1, 13)]  # [deg]
COLUMNS = {"acceleration": "m/s^2", "stops": "s", "distance": "m", "speed": "m/s"}  # at T, but the time at which it stops
METHODS = (["--method", "auto", "--tolerance", "1e-12"], ["--method", "rk8pd", "--tolerance", "2e-14", "--no-structure"])


@dataclass
class Point:
    """Start velocity, coefficient, angle, whether it sticks at T, and {column: value}; None where friction does not stop it."""
    v0: float
    mu: float
    angle: float
    sticks: bool
    values: dict


def points():
    """All points of the grid in closed form."""
    return [by_hand(v0, mu, angle) for v0 in SPEEDS for mu in MUS for angle in ANGLES if abs(tan(radians(angle)) - mu) > 1e-9]


def by_hand(v0, mu, angle):
    """One of them."""
    weight, friction = GRAVITY * sin(radians(angle)), mu * GRAVITY * cos(radians(angle))
    up, down = weight + friction, max(weight - friction, 0.0)
    stop = v0 / up
    if stop > T:  # still on the way up
        return Point(v0, mu, angle, False, {"acceleration": -up, "stops": None, "distance": v0 * T - up * T**2 / 2, "speed": v0 - up * T})
    rest = T - stop
    return Point(v0, mu, angle, down == 0, {"acceleration": -down, "stops": stop if v0 * mu > 0 else None,
                                            "distance": v0 * stop / 2 - down * rest**2 / 2, "speed": -down * rest})


def by_sweep(programs, method):
    """The same points, by fbd-sweep."""
    found, mus = [], ",".join(map(str, MUS))
    for v0 in SPEEDS:
        command = [programs / "fbd-sweep", *method, "--set", "f1=0", "--set", f"v0={v0!r}", "--until", repr(T),
                   "--vary", f"mu_s={mus}; mu_k={mus}", "--vary", f"phi={','.join(map(str, ANGLES))} deg",
                   "--output", "block.x,block.v,block.G.ax,block.G.ay,time(block.stick),time(block.reversal)", MODEL]
        done = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True)
        rows = csv.DictReader(io.StringIO(done.stdout))
        found += [of_row(v0, {name.split(" [")[0]: cell for name, cell in row.items()}) for row in rows]
    return {(point.v0, point.mu, point.angle): point for point in found}


def of_row(v0, row):
    assert row["status"] == "done", row["reason"]
    angle = float(row["phi"])
    a = float(row["block.G.ax"]) * cos(radians(angle)) + float(row["block.G.ay"]) * sin(radians(angle))
    stop = [float(row[name]) for name in ("time(block.stick)", "time(block.reversal)") if row[name]]
    return Point(v0, float(row["mu_k"]), angle, float(row["block.v"]) == 0 and a == 0,
                 {"acceleration": a, "stops": stop[0] if stop else None, "distance": float(row["block.x"]), "speed": float(row["block.v"])})


def compared(programs):
    """[(point by hand, point computed, {column: error})]: the error from the difference of two methods and 3 roundings."""
    first, second = (by_sweep(programs, method) for method in METHODS)
    rows = []
    for hand in points():
        one, other = (found[(hand.v0, hand.mu, hand.angle)] for found in (first, second))
        rows.append((hand, one, {name: error(one.values[name], other.values[name]) for name in COLUMNS}))
    return rows


def error(one, other):
    """None where there is no such value, infinite where one of two methods has it."""
    if one is None and other is None:
        return None
    return inf if one is None or other is None else abs(one - other) + 3 * 2.3e-16 * abs(one)


def faults(rows, allowed):
    """Where the modes differ, or a value by more than its error and so much of the largest value of its column (3 to 10)."""
    for hand, one, errors in rows:
        where = f"v0 = {hand.v0:g} m/s, mu = {hand.mu:g}, {hand.angle:g} deg"
        if hand.sticks != one.sticks:
            yield f"{where}: sticks is {one.sticks}, by hand {hand.sticks}"
        for name, want in hand.values.items():
            got = one.values[name]
            if (want is None) != (got is None) or want is not None and not (abs(got - want) <= errors[name] + allowed and errors[name] <= 1e-12):
                yield f"{where}: {name} is {got!r}, by hand {want!r}, error {errors[name]}"


def table(rows):
    """(head, rows) for CSV."""
    head = ["v0 [m/s]", "mu", "angle [deg]", "mode"]
    for name, unit in COLUMNS.items():
        head += [f"{name} [{unit}]", f"{name} computed", "error"]
    show = lambda value: "" if value is None else repr(value)
    return head, [[hand.v0, hand.mu, hand.angle, "stick" if hand.sticks else "slip",
                   *(cell for name in COLUMNS for cell in (show(hand.values[name]), show(one.values[name]), "" if errors[name] is None else f"{errors[name]:.2g}"))]
                  for hand, one, errors in rows]
