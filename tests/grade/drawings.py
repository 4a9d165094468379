#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: drawings.py FBD-RUN [DRAWINGS [SEED]]

Answers that are drawn: the scenes of reactions.py as keys, and the program's own diagram of them as a student draws it, as
JSON of STACK's Meclib or of PrairieLearn's pl-drawing: some degrees off, beside the point, elsewhere on the line of action,
under other names, with values or without, by components, in any order. It has full marks; with one defect it loses the
points of that alone, which is named. FBD_DRAWS multiplies the number of drawings. Prints TAP.
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

import reactions
from reactions import KINDS, PINS, RUN

DRAWINGS = (int(sys.argv[2]) if len(sys.argv) > 2 else 120) * int(os.environ.get("FBD_DRAWS", "1"))
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1
DEFECTS = ("missing", "superfluous", "sense", "direction", "place", "magnitude", "inertial", "component")


class Arrow:
    """An arrow from `tail` along `angle`, in the world; `label`: a name, or a value as text."""

    def __init__(self, of, label, tail, angle, length):
        self.of, self.label, self.tail, self.angle, self.length = of, label, tail, angle, length

    def tip(self):
        return self.tail[0] + self.length * math.cos(self.angle), self.tail[1] + self.length * math.sin(self.angle)

    def slide(self, far):
        self.tail = self.tail[0] + far * math.cos(self.angle), self.tail[1] + far * math.sin(self.angle)

    def shift(self, off):
        self.tail = self.tail[0] - off * math.sin(self.angle), self.tail[1] + off * math.cos(self.angle)


class Meclib:
    """Lists, y up, units of the picture."""

    def __init__(self, rng, size):
        self.unit = size / 2.5
        self.origin = [round(rng.uniform(-3, 3), 2), round(rng.uniform(-3, 3), 2)]

    def place(self, point):
        return [self.origin[0] + point[0] / self.unit, self.origin[1] + point[1] / self.unit]

    def arrow(self, rng, arrow):
        return ["force", arrow.label, self.place(arrow.tail), self.place(arrow.tip()), rng.choice((10, -10)), "active"]

    def rest(self):
        return [["grid", "", "", -5, 5, -4, 4, 50], ["label", "A", [0, 0]], ["dim", "L", [0, -1], [2, -1], 0.4], ["fix1", "B", [2, 0], 0, "show"]]


class Pixels:
    """Objects, y down, angles clockwise."""

    def __init__(self, rng, size):
        self.unit = size / 100
        self.origin = [rng.randrange(100, 300), rng.randrange(100, 300)]

    def arrow(self, rng, arrow):
        x, y = (arrow.tail[0] / self.unit + self.origin[0], self.origin[1] - arrow.tail[1] / self.unit)
        made = {"type": "pl-vector", "gradingName": "vector", "id": rng.randrange(99), "left": x, "top": y, "width": arrow.length / self.unit,
                "angle": math.degrees(-arrow.angle) % 360, "label": arrow.label, "drawStartArrow": False, "drawEndArrow": True, "originY": "center"}
        if rng.random() < 0.2:
            made["originX"] = "center"
            made["left"] += made["width"] / 2 * math.cos(-arrow.angle)
            made["top"] += made["width"] / 2 * math.sin(-arrow.angle)
        return made

    def rest(self):
        return [{"type": "pl-line", "graded": False, "x1": 0, "y1": 0, "x2": 9, "y2": 9, "id": 100}, {"type": "pl-point", "left": 20, "top": 20, "id": 101}]


def between(a, b):
    """The angle between two lines."""
    turn = abs(a - b) % math.pi
    return min(turn, math.pi - turn)


def is_pin(name):
    return "pin" in name or name in PINS


def value_of(load):
    """The value of a force that is listed, as a student would write it."""
    return load.split("value: ")[1].split(",")[0] if "value: " in load and "[" not in load.split("value: ")[1].split(",")[0] else None


def draw(rng, name, arrow, turns, size, letter, value):
    """The arrows for one force."""
    angle, length = math.atan2(arrow["fy"], arrow["fx"]), size * rng.uniform(0.2, 0.5)
    label = value if value and not value.startswith("-") and rng.random() < 0.5 else rng.choice((name.replace(".", "_"), letter, letter, ""))
    point = (arrow["x"], arrow["y"])
    if is_pin(name) and turns and rng.random() < 0.5:
        ways = [math.pi / 2 * k for k in (0, 1)]
        ways = [way + (math.pi if math.cos(angle - way) < 0 and rng.random() < 0.7 else 0) for way in ways]
        return [Arrow(name, f"{letter}_{axis}", point, way, length) for way, axis in zip(ways, "xy")]
    one = Arrow(name, label, point, angle, length)
    one.slide(rng.choice((0, -length, rng.uniform(-0.3, 0.3) * size if turns and not is_pin(name) else 0)))
    return [one]


def is_alike(arrow, others, size, turns):
    """Could an arrow be one of these?"""
    for other in others:
        apart = (arrow.tail[0] - other.tail[0]) * math.sin(other.angle) - (arrow.tail[1] - other.tail[1]) * math.cos(other.angle)
        if between(arrow.angle, other.angle) < math.radians(16) and (not turns or abs(apart) < 0.3 * size):
            return True
    return False


def spoil(rng, kind, scene, drawn, size):
    """One defect: (kinds that name it, points lost), or None where it cannot be made."""
    body, name = rng.choice(sorted(drawn))
    turns, arrows = body in scene.turns, drawn[body, name]
    others = [arrow for (b, n), list_ in drawn.items() for arrow in list_ if b == body and n != name]
    defect, arrow = rng.choice(DEFECTS), rng.choice(arrows)
    single = len(arrows) == 1
    if defect == "missing":
        drawn[body, name] = []
        return ("missing",), 1
    if defect == "component" and not single:
        arrows.remove(arrow)
        return ("direction", "magnitude"), 0.5
    if defect in ("superfluous", "inertial"):
        place = (arrow.tail[0] + rng.uniform(0.5, 1) * size, arrow.tail[1] + rng.uniform(0.5, 1) * size) if defect == "superfluous" else scene.G[body]
        extra = Arrow("", rng.choice(("ma", "F_c", "", "5 N")), place, rng.uniform(-3, 3), 0.3 * size)
        beside = [a for (b, n), list_ in drawn.items() if b == body and is_pin(n) for a in list_]  # a component of that which is zero?
        if any(between(extra.angle + math.pi / 2, pin.angle) < math.radians(16) for pin in beside):
            return None
        if is_alike(extra, others + arrows, size, False) or (kind == "atwood" and abs(math.sin(extra.angle)) < 0.3):
            return None
        drawn[body, "extra"] = [extra]
        return ("superfluous",), 1
    if not single or any(n != name and m is not arrow and is_alike(arrow, [m], size, turns) for (b, n), l in drawn.items() if b == body for m in l):
        return None
    if defect == "sense":
        arrow.angle += math.pi
        arrow.slide(-arrow.length)
        return ("sense",), 0.5
    if defect == "direction":
        arrow.tail = scene.points[body, name]
        arrow.angle += rng.choice((-1, 1)) * rng.uniform(0.5, 1)
        return None if is_alike(arrow, others, size, False) else (("direction",), 0.5)
    if defect == "place" and turns:
        arrow.shift(rng.choice((-1, 1)) * rng.uniform(0.3, 0.5) * size)
        return None if is_alike(arrow, others, size, True) else (("place",), 0.5)
    if defect == "magnitude" and arrow.label.endswith(" N"):
        arrow.label = f"{float(arrow.label[:-2]) * rng.choice((0.5, 1.2, 1.5)):.4g} N"
        return ("magnitude",), 0.5
    return None


def make(folder, number):
    """(key, answer, defect or None, points to be had, what it is)."""
    rng = random.Random(f"drawing {SEED} {number}")
    kind = rng.choice(KINDS)
    scene = kind(rng)
    key = scene.write()
    forces = reactions.diagram(folder, key)
    largest = max(math.hypot(arrow["fx"], arrow["fy"]) for arrows in forces.values() for arrow in arrows.values())
    scene.G = {body: (arrows["gravity"]["x"], arrows["gravity"]["y"]) for body, arrows in forces.items()}
    reach = [math.dist(scene.G[body], (arrow["x"], arrow["y"])) for body, arrows in forces.items() for arrow in arrows.values()]
    size = max(reach) if max(reach) > 0.01 else 1
    canvas, letters = rng.choice((Meclib, Pixels))(rng, size), list("PQSTUVWXYZ")
    rng.shuffle(letters)
    drawn, scene.points, most = {}, {}, 0
    for body, arrows in forces.items():
        for name, arrow in arrows.items():
            loads = [load for load in scene.lists[body] if load.startswith(name) or f"name: {name}," in load]
            if math.hypot(arrow["fx"], arrow["fy"]) < 1e-6 * largest and not loads:
                continue
            most += 1
            scene.points[body, name] = (arrow["x"], arrow["y"])
            drawn[body, name] = draw(rng, name, arrow, body in scene.turns, size, letters[len(drawn) % 10], value_of(loads[0]) if loads else None)
    if kind.__name__ == "ladder" and most < 3:
        return None  # of contacts that rounding has opened
    # Two lines that cross at a few degrees cannot be told apart by hand.
    for (body, name), arrows in drawn.items():
        for (other, own), more in drawn.items():
            if body == other and name < own and any(math.radians(1) < between(a.angle, b.angle) < math.radians(14) for a in arrows for b in more):
                return None
    defect = None
    for _ in range(20 if rng.random() < 0.6 else 0):
        saved = {place: [Arrow(**vars(arrow)) for arrow in arrows] for place, arrows in drawn.items()}
        defect = spoil(rng, kind.__name__, scene, drawn, size)
        if defect:
            break
        drawn = saved
    objects = {body: [] for body in forces}
    for (body, _), arrows in drawn.items():
        for arrow in arrows:
            arrow.angle += math.radians(rng.uniform(-3, 3))
            arrow.shift(rng.uniform(-0.02, 0.02) * size)
            objects[body].append(canvas.arrow(rng, arrow))
    for list_ in objects.values():
        list_ += canvas.rest()
        rng.shuffle(list_)
    only = len(objects) == 1 and rng.random() < 0.7
    answer = next(iter(objects.values())) if only else {"bodies": {body: {"drawing": list_} for body, list_ in objects.items()}}
    key += f"grading: {{reactions: all, canvas: {{origin: {canvas.origin}, unit: {canvas.unit:.15g} m}}}}\n"
    return key, json.dumps(answer), defect, most, f"{kind.__name__} in {type(canvas).__name__}"


def fault(result, defect, most):
    wrong = [one for one in result["tests"] if one["kind"] != "right"]
    if abs(result["max_points"] - most) > 1e-9:
        return f"{result['max_points']} points are to be had, not {most}"
    if not defect:
        return "" if result["passed"] and result["score"] == 1 and not wrong else "a right drawing loses points"
    kinds, lost = defect
    if abs(result["points"] - max(0, most - lost)) > 1e-9:
        return f"{result['points']} of {most} points, not {most - lost}"
    return "" if len(wrong) == 1 and wrong[0]["kind"] in kinds else "the defect is not named, or more is"


def main():
    bad = done = 0
    with tempfile.TemporaryDirectory() as path:
        folder, number = Path(path), 0
        while done < DRAWINGS:
            number += 1
            made = make(folder, number)
            if not made:
                continue
            done += 1
            key, answer, defect, most, what = made
            (folder / "key.yaml").write_text(key, encoding="utf-8")
            (folder / "answer.json").write_text(answer, encoding="utf-8")
            run = subprocess.run([RUN, "--grade", str(folder / "key.yaml"), "--json", "-", "--details", str(folder / "answer.json")],
                                 stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
            said, result = f"exit code {run.returncode}: {run.stderr.decode()}", {}
            if run.returncode in (0, 4):
                result = json.loads(run.stdout)["answers"][0]
                said = fault(result, defect, most)
            if not said:
                continue
            bad += 1
            print(f"# drawing {number} of seed {SEED}, {what}: {said}; expected {defect}")
            for one in result.get("tests", []):
                print(f"#     {one['points']:g} {one['kind']}: {one['name']}: {one['message']} ({one.get('output', '')})")
            if os.environ.get("FBD_KEEP"):
                for name, text in (("key.yaml", key), ("answer.json", answer)):
                    Path(os.environ["FBD_KEEP"], f"{number}.{name}").write_text(text, encoding="utf-8")
    print(f"{'not ok' if bad else 'ok'} 1 - {DRAWINGS} drawings of seed {SEED} are worth what they are ({bad} not so)")
    print("1..1")
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
