#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: tests/reference/engines.py BUILD ENGINES   (`make engines`)

Compare the engines whose programs are in the folder ENGINES with the reference data, at two steps, and write the table into
docs/reference-systems.md.
"""
import statistics
import subprocess
import sys
from dataclasses import dataclass
from math import cos, degrees, hypot, pi, radians, sin
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parent))
import grid  # pylint: disable=wrong-import-position
from reference import GRAVITY, SOURCE, Reference  # pylint: disable=wrong-import-position
from systems import SYSTEMS, bounce  # pylint: disable=wrong-import-position

ENGINES = {"box2d": ("Box2D", "libbox2d-dev"), "chipmunk": ("Chipmunk", "libchipmunk-dev"), "mujoco": ("MuJoCo", "libmujoco-dev")}
STEPS = (0.01, 0.001)  # seconds
AT_REST = 0.01  # m/s; the slowest point of the grid that slips is faster
PAGE = SOURCE / "docs" / "reference-systems.md"
BEGIN, END = "<!-- written by make engines -->\n", "<!-- end -->\n"


@dataclass
class Engine:
    """A program that computes scenes (engines/scenes.h)."""
    path: Path

    def compute(self, scenes):
        """The results of each scene, an empty list where the engine does not have it."""
        lines = "".join(" ".join([name, *map(repr, numbers)]) + "\n" for name, *numbers in scenes)
        done = subprocess.run([self.path], input=lines, capture_output=True, text=True, check=True)
        found = [[float(number) for number in line.split()[1:]] for line in done.stdout.splitlines() if line.startswith("=")]
        assert len(found) == len(scenes)
        return found

    def version(self, package):
        asked = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", package], capture_output=True, text=True, check=False)
        return asked.stdout.partition("-")[0]


def two_digits(value):
    return f"{value:.0f}" if value >= 99.5 else f"{value:.2g}"


def of_grid(engine, h, v0):
    """Cells: modes that are right, median and largest error of the distance [mm]."""
    points = [point for point in grid.points() if point.v0 == v0]
    results = engine.compute([("incline", h, grid.T, point.mu, radians(point.angle), point.v0) for point in points])
    right = sum((abs(v) < AT_REST) == (abs(point.values["speed"]) < AT_REST) for point, (_, v) in zip(points, results))
    errors = [1e3 * abs(x - point.values["distance"]) for point, (x, _) in zip(points, results)]
    return [f"{right} of {len(points)}", f"{two_digits(statistics.median(errors))} mm", f"{two_digits(max(errors))} mm"]


def of_disc(engine, h, mu):
    """Error of the distance down 30 degrees after 1 s, and of the angular velocity, relative."""
    angle = pi / 6
    normal = GRAVITY * cos(angle)
    friction = min(mu * normal, GRAVITY * sin(angle) / 3)
    distance, omega = (GRAVITY * sin(angle) - friction) / 2, -2 * friction / 0.2
    (x, _, w), = engine.compute([("disc", h, 1.0, mu, angle)])
    return [f"{abs(x / distance - 1):.1%}", f"{abs(w / omega - 1):.1%}"]


def of_bounce(engine, h):
    """Error of the height after 1.5 s, in its second flight, of the height at which it was let go."""
    result, = engine.compute([("bounce", h, 1.5, 0.8, 1.0)])
    height = bounce(SimpleNamespace(g=GRAVITY, h=1, e=0.8, r=0), 1.5)["ball.y"]
    return [f"{abs(result[0] - height):.1%}"] if result else ["–"]


def of_rope(engine, h, state):
    """Distance from the place at the end, of the length of the rope."""
    x, y, *_ = engine.compute([("rope", h, 2.0, 4.0)])[0]
    return [f"{hypot(x - state['bob.x'], y - state['bob.y']):.1%}"]


def of_four_bar(engine, h, state):
    """Error of the angle of the crank after 1 s, some two turns, in degrees."""
    crank, *_ = engine.compute([("fourbar", h, 1.0)])[0]
    return [f"{two_digits(degrees(abs(crank - state['crank.theta'])))}°"]


def state_at(programs, name, t):
    """{quantity: value} of a reference system at one of its times."""
    reference = Reference(programs, next(system for system in SYSTEMS if system.name == name))
    return next({value.name: value.value for value in values} for time, values in reference.states if abs(time - t) < 1e-9)


ROWS = ["grid, let go: modes", "… distance, median error", "… largest error", "grid, thrown up: modes", "… distance, median error",
        "… largest error", "disc that slips (μ = 0.1): distance", "… angular velocity", "disc that rolls (μ = 0.5): distance",
        "… angular velocity", "ball that bounces (e = 0.8): height", "rope pendulum, slack and taut: place", "four-bar linkage: angle of the crank"]


def column(engine, h, rope, four_bar):
    return [*of_grid(engine, h, 0.0), *of_grid(engine, h, 3.0), *of_disc(engine, h, 0.1), *of_disc(engine, h, 0.5),
            *of_bounce(engine, h), *of_rope(engine, h, rope), *of_four_bar(engine, h, four_bar)]


def main():
    build = Path(sys.argv[1])
    rope, four_bar = state_at(build / "apps", "rope_pendulum", 2), state_at(build / "apps", "four_bar", 1)
    head, columns = ["error"], []
    for program, (name, package) in ENGINES.items():
        engine = Engine(Path(sys.argv[2]) / f"by_{program}")
        for h in STEPS:
            head.append(f"{name} {engine.version(package)}, {h:g} s")
            columns.append(column(engine, h, rope, four_bar))
    lines = [head, ["---"] * len(head), *([row, *cells] for row, *cells in zip(ROWS, *columns))]
    table = "".join("| " + " | ".join(cells) + " |\n" for cells in lines)
    print(table, end="")
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    PAGE.write_text(before + BEGIN + "\n" + table + "\n" + END + rest.partition(END)[2], encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
