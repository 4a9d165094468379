#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: reactions.py FBD-RUN [SCENES [SEED]]

Random scenes as keys. The answer draws all reactions as the program's own diagram has them at the start: by value or as
unknowns, as one force or by components, anywhere on their lines of action. It has full marks; with one defect it loses the
points of that alone, which is named. FBD_DRAWS multiplies the number of scenes. Prints TAP.
"""
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

RUN = sys.argv[1]
SCENES = (int(sys.argv[2]) if len(sys.argv) > 2 else 60) * int(os.environ.get("FBD_DRAWS", "1"))
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1

# ---- scenes: the text of the file with FORCES_name for the lists of body `name`, and what each body lists


class Scene:
    def __init__(self, text, lists, turns=(), one_sided=()):
        self.text, self.lists, self.turns = text, lists, set(turns)
        self.one_sided = set(one_sided)  # names of reactions that only pull or press

    def write(self, extra=None):
        text = "fbd: 1\n" + self.text
        for body, loads in self.lists.items():
            more = (extra or {}).get(body, ([], []))
            lines = [f"      - {load}\n" for load in loads + more[0]]
            moments = [f"      - {load}\n" for load in more[1]]
            text = text.replace(f"    LOADS_{body}\n", ("    forces:\n" + "".join(lines) if lines else "") +
                                ("    moments:\n" + "".join(moments) if moments else ""))
        return text


def pull(rng, at=""):
    return f"applied: {{name: pull, value: {rng.uniform(5, 60):.4g} N, angle: {rng.uniform(-170, 170):.4g} deg{at}}}"


def pendulum(rng):
    text = f"""bodies:
  rod:
    shape: rod
    mass: {rng.uniform(1, 5):.3g} kg
    from: [0, 0]
    to: [0, -{rng.uniform(0.5, 2):.3g} m]
    motion: {{pivot: {{}}}}
    initial: {{theta: {rng.uniform(-150, 150):.4g} deg, omega: {rng.uniform(-3, 3):.4g} rad/s}}
    LOADS_rod
simulate: {{until: 1 s}}
"""
    return Scene(text, {"rod": ["gravity"] + ([pull(rng, ", at: right")] if rng.random() < 0.5 else [])}, ["rod"])


def atwood(rng):
    text = f"""ground: {{points: {{P: [-0.1, 2], Q: [0.1, 2]}}}}
bodies:
  a:
    mass: {rng.uniform(1, 3):.3g} kg
    motion: {{slide: {{along: 90 deg, through: [-0.1, 0]}}}}
    LOADS_a
  b:
    mass: {rng.uniform(1, 6):.3g} kg
    motion: {{slide: {{along: 90 deg, through: [0.1, 0]}}}}
    LOADS_b
couplings:
  - rope: {{name: cord, through: [a, ground.P, ground.Q, b]}}
simulate: {{until: 0.1 s}}
"""
    return Scene(text, {"a": ["gravity"], "b": ["gravity"]}, [], ["cord"])


def beam(rng):
    length, tilt = rng.uniform(2, 5), math.radians(rng.choice((0, rng.uniform(-40, 40))))
    c, s = length * math.cos(tilt), length * math.sin(tilt)
    way = rng.uniform(-150, -30) * math.pi / 180
    text = f"""ground: {{points: {{A: [0, 0], B: [{c + math.cos(way):.12g}, {s + math.sin(way):.12g}]}}}}
bodies:
  beam:
    shape: rod
    mass: {rng.uniform(5, 40):.3g} kg
    length: {length!r} m
    points: {{load: [{rng.uniform(-0.4, 0.4) * length:.4g}, 0]}}
    motion: planar
    initial: {{x: {c / 2:.12g}, y: {s / 2:.12g}, theta: {tilt:.12g} rad}}
    LOADS_beam
couplings:
  - pin: {{name: A, between: [beam.left, ground.A]}}
  - rod: {{name: B, between: [beam.right, ground.B]}}
simulate: {{until: 1 s}}
"""
    return Scene(text, {"beam": ["gravity", f"applied: {{name: P, value: [0, -{rng.uniform(50, 500):.4g} N], at: load}}"]}, ["beam"])


def block(rng):
    slope = rng.choice((0, rng.uniform(5, 30)))
    text = f"""bodies:
  block:
    mass: {rng.uniform(2, 9):.3g} kg
    motion: {{slide: {{along: {slope:.4g} deg}}}}
    initial: {{v: {rng.uniform(1, 3):.3g} m/s}}
    LOADS_block
simulate: {{until: 0.1 s}}
"""
    listed = ["normal", f"friction: {rng.uniform(0.1, 0.5):.3g}"] if rng.random() < 0.5 else []
    return Scene(text, {"block": ["gravity", f"applied: {{name: pull, value: {rng.uniform(1, 9):.4g} N, angle: {rng.uniform(0, 80):.4g} deg}}"] +
                        listed}, [], ["normal", "friction"])


def wheel(rng):
    slope, radius = math.radians(rng.choice((0, rng.uniform(5, 30)))), rng.uniform(0.2, 0.6)
    text = f"""ground: {{lines: {{floor: {{along: {slope:.12g} rad}}}}}}
bodies:
  wheel:
    shape: disc
    mass: {rng.uniform(2, 9):.3g} kg
    radius: {radius:.12g} m
    motion: planar
    initial: {{x: {-radius * math.sin(slope):.12g}, y: {radius * math.cos(slope):.12g}}}
    LOADS_wheel
couplings:
  - roll: {{name: tread, body: wheel, on: floor, radius: {radius:.12g} m}}
simulate: {{until: 0.1 s}}
"""
    string = f"applied: {{name: string, value: {rng.uniform(2, 15):.4g} N, angle: {rng.uniform(-30, 30):.4g} deg, at: {{point: G, offset: [0, {rng.uniform(-0.9, 0.9) * radius:.4g}]}}}}"
    return Scene(text, {"wheel": ["gravity", string]}, ["wheel"], ["tread.normal"])


def ladder(rng):
    length, lean = rng.uniform(2, 5), math.radians(rng.uniform(45, 75))
    mu = rng.choice(("", f", static: {rng.uniform(0.6, 0.9):.3g}, kinetic: 0.5"))
    text = f"""ground:
  lines: {{floor: {{along: 0 deg}}, wall: {{along: 90 deg}}}}
bodies:
  ladder:
    shape: rod
    mass: {rng.uniform(5, 20):.3g} kg
    length: {length!r} m
    motion: planar
    initial: {{x: {length / 2 * math.cos(lean):.15g}, y: {length / 2 * math.sin(lean):.15g}, theta: {math.pi - lean:.15g}}}
    LOADS_ladder
contacts:
  - {{name: floor, between: [ladder, ground.floor]{mu}}}
  - {{name: wall, between: [ladder, ground.wall]}}
simulate: {{until: 0.1 s}}
"""
    return Scene(text, {"ladder": ["gravity"]}, ["ladder"], ["floor.normal", "wall.normal"])


def slider_crank(rng):
    r, l, angle = rng.uniform(0.2, 0.4), rng.uniform(0.7, 1.2), math.radians(rng.choice((-1, 1)) * rng.uniform(20, 160))
    x, y = r * math.cos(angle), r * math.sin(angle)
    end = x + math.sqrt(l * l - y * y)
    text = f"""bodies:
  crank:
    shape: rod
    mass: {rng.uniform(1, 3):.3g} kg
    from: [0, 0]
    to: [{r:.15g}, 0]
    motion: pivot
    initial: {{theta: {angle:.15g}, omega: 0}}
    LOADS_crank
  rod:
    shape: rod
    mass: {rng.uniform(1, 3):.3g} kg
    length: {l:.15g} m
    motion: planar
    initial: {{x: {(x + end) / 2:.15g}, y: {y / 2:.15g}, theta: {math.atan2(-y, end - x):.15g}}}
    LOADS_rod
  piston:
    mass: {rng.uniform(1, 3):.3g} kg
    motion: slide
    initial: {{x: {end:.15g}}}
    LOADS_piston
couplings:
  - pin: {{name: knuckle, between: [crank.right, rod.left]}}
  - pin: {{name: wrist, between: [rod.right, piston]}}
simulate: {{until: 0.01 s}}
"""
    force = f"applied: {{name: gas, value: {rng.uniform(-90, 90):.4g} N}}"
    return Scene(text, {"crank": ["gravity"], "rod": ["gravity"], "piston": ["gravity", force]}, ["crank", "rod"])


def double_pendulum(rng):
    text = f"""bodies:
  upper:
    shape: rod
    mass: {rng.uniform(1, 3):.3g} kg
    from: [0, 0]
    to: [1, 0]
    motion: pivot
    initial: {{theta: {rng.uniform(-170, 170):.4g} deg, omega: {rng.uniform(-2, 2):.3g} rad/s}}
    LOADS_upper
  lower:
    shape: rod
    mass: {rng.uniform(1, 3):.3g} kg
    from: [0, 0]
    to: [{rng.uniform(0.5, 1):.3g} m, 0]
    motion: {{pivot: {{on: upper, at: right}}}}
    initial: {{theta: {rng.uniform(-170, 170):.4g} deg}}
    LOADS_lower
simulate: {{until: 0.1 s}}
"""
    return Scene(text, {"upper": ["gravity"], "lower": ["gravity"]}, ["upper", "lower"])


KINDS = (pendulum, atwood, beam, block, wheel, ladder, slider_crank, double_pendulum)

# ---- what the answer draws: pieces of one reaction


PINS = ("A", "knuckle", "wrist")


class Piece:
    """A force: value along an angle at a place, in one of several forms."""

    def __init__(self, name, size, angle, place, unknown=False, free=False):
        self.name, self.size, self.angle, self.place = name, size, angle, place
        self.unknown, self.free = unknown, free

    def entry(self, G, turns):
        at = f", at: {{point: G, offset: [{self.place[0] - G[0]:.12g}, {self.place[1] - G[1]:.12g}]}}" if turns else ""
        value = "unknown" if self.unknown else f"{self.size:.9g} N"
        angle = "unknown" if self.free else f"{self.angle:.12g} rad"
        return f"applied: {{name: {self.name}, value: {value}, angle: {angle}{at}}}"


def draw_reaction(rng, name, arrow, turns, one_sided):
    fx, fy, place = arrow["fx"], arrow["fy"], (arrow["x"], arrow["y"])
    size, angle = math.hypot(fx, fy), math.atan2(fy, fx)
    # Where places do not matter, an unknown component might be another force on the same line.
    if not turns and name != "cord":
        form = rng.choice(("value", "unknown"))
    else:
        form = rng.choice(("value", "value", "parts", "unknown", "unknown", "unknown parts") + (("free",) if "pin" in name or name in PINS else ()))
    label = f"own_{name.replace('.', '_')}"
    if form in ("value", "unknown"):
        along = rng.uniform(-0.5, 0.5) if turns else 0
        place = (place[0] + along * math.cos(angle), place[1] + along * math.sin(angle))
        back = form == "value" and rng.random() < 0.2  # a negative value the other way round
        return [Piece(label, -size if back else size, angle + (math.pi if back else 0), place, form == "unknown")]
    if form == "free":
        return [Piece(label, size, angle, place, True, True)]
    axis = rng.choice((0, rng.uniform(-math.pi, math.pi)))
    pin = "pin" in name or name in PINS
    parts = []
    for k, letter in enumerate("xy"):
        way = axis + k * math.pi / 2
        value = size * math.cos(angle - way)
        if value < 0 and (one_sided or not pin):
            way, value = way + math.pi, -value
        if abs(value) < 0.02 * size and not pin:  # a component that is zero is drawn of what may point anywhere
            return [Piece(label, size, angle, place, form == "unknown parts")]
        parts.append(Piece(f"{label}_{letter}", value, way, place, form == "unknown parts"))
    return parts


DEFECTS = ("missing", "sense", "direction", "place", "magnitude", "superfluous")


def spoil(rng, drawn, points, scene):
    """One defect: (kind, body, name, points lost), or None where this one cannot be made."""
    kind = rng.choice(DEFECTS)
    body, name = rng.choice(sorted(drawn))
    pieces = drawn[body, name]
    if kind == "missing":
        contact, _, part = name.rpartition(".")
        rest = [drawn.get((body, f"{contact}.{other}"), []) for other in ("normal", "friction") if contact and other != part]
        if any(len(pieces) == 2 and pieces[0].unknown for pieces in rest):
            return None  # two unknown components: they may be those of both, as one force
        drawn[body, name] = []
        return kind, body, None, 1
    if kind == "superfluous":
        first = pieces[0]
        extra = Piece("of_motion", rng.uniform(10, 40), rng.uniform(-3, 3), (first.place[0] + rng.uniform(0.3, 1), first.place[1] + rng.uniform(0.3, 1)),
                      rng.random() < 0.3)
        pieces.append(extra)
        return kind, body, "of_motion", 1
    piece = rng.choice(pieces)
    total = math.hypot(*(p.size for p in pieces)) if len(pieces) > 1 else abs(pieces[0].size)
    single = len(pieces) == 1 and not piece.free
    if kind == "sense" and (single or (not piece.unknown and abs(piece.size) > 0.2 * total)):
        piece.angle += math.pi
    elif kind == "direction" and single:
        piece.angle += rng.choice((-1, 1)) * rng.uniform(0.5, 1)
        piece.place = points[body, name]
    elif kind == "place" and single and body in scene.turns:
        off = rng.choice((-1, 1)) * rng.uniform(0.3, 0.6)
        piece.place = (piece.place[0] - off * math.sin(piece.angle), piece.place[1] + off * math.cos(piece.angle))
    elif kind == "magnitude" and single and not piece.unknown:
        piece.size *= rng.choice((0.7, 1.3))
    else:
        return None
    return kind, body, piece.name, 0.5


def diagram(folder, text):
    path = folder / "start.yaml"
    path.write_text(text, encoding="utf-8")
    done = subprocess.run([RUN, "--json", "-", "--quiet", "--until", "1e-9", str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 0, (done.stderr.decode(), text)
    return json.loads(done.stdout)["forces"]


def make(folder, number):
    """(key, answer, expected defect or None, points to be had, what it is)."""
    rng = random.Random(f"{SEED} {number}")
    kind = rng.choice(KINDS)
    scene = kind(rng)
    key = scene.write()
    forces = diagram(folder, key)
    largest = max(math.hypot(arrow["fx"], arrow["fy"]) for arrows in forces.values() for arrow in arrows.values())
    drawn, points, most = {}, {}, 0
    as_such = rng.random() < 0.5
    given = {body: list(loads) for body, loads in scene.lists.items()}
    for body, arrows in forces.items():
        for name, arrow in arrows.items():
            listed = any(load.startswith(name) or f"name: {name}," in load for load in scene.lists[body])
            follows = name in ("normal", "friction") and not as_such
            if math.hypot(arrow["fx"], arrow["fy"]) < 1e-6 * largest and not listed:
                continue
            most += 1
            if listed and not follows:
                continue
            given[body] = [load for load in given[body] if not (follows and load.startswith(name))]
            pieces = draw_reaction(rng, name, arrow, body in scene.turns, name in scene.one_sided)
            if follows:  # by value they are compared at all states: here as unknowns
                pieces = [Piece(f"own_{name}", math.hypot(arrow["fx"], arrow["fy"]), math.atan2(arrow["fy"], arrow["fx"]),
                                (arrow["x"], arrow["y"]), True)]
            drawn[body, name] = pieces
            points[body, name] = (arrow["x"], arrow["y"])
    expected = None
    if drawn and rng.random() < 0.6:
        while expected is None:
            expected = spoil(rng, drawn, points, scene)
    extra = {body: ([], []) for body in forces}
    for (body, _), pieces in drawn.items():
        gravity = forces[body]["gravity"]
        extra[body][0].extend(piece.entry((gravity["x"], gravity["y"]), body in scene.turns) for piece in pieces)
    scene.lists = given
    return key, scene.write(extra), expected, most, kind.__name__


def fault(result, expected, most):
    wrong = [one for one in result["tests"] if one["kind"] != "right"]
    if abs(result["max_points"] - most) > 1e-9:
        return f"{result['max_points']} points are to be had, not {most}"
    if not expected:
        return "" if result["passed"] and result["score"] == 1 and not wrong else "a right diagram loses points"
    kind, body, name, lost = expected
    if abs(result["points"] - max(0, most - lost)) > 1e-9:
        return f"{result['points']} of {most} points, not {most - lost}"
    if len(wrong) != 1 or wrong[0]["kind"] != kind:
        return "the defect is not named, or more is"
    where, _, called = wrong[0]["name"].partition(": ")
    return "" if where == body and (name is None or called == name) else "another force is blamed"


def main():
    bad = 0
    with tempfile.TemporaryDirectory() as path:
        folder = Path(path)
        for number in range(SCENES):
            key, answer, expected, most, kind = make(folder, number)
            (folder / "key.yaml").write_text(key, encoding="utf-8")
            (folder / "answer.yaml").write_text(answer, encoding="utf-8")
            done = subprocess.run([RUN, "--grade", str(folder / "key.yaml"), "--json", "-", "--details", str(folder / "answer.yaml")],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
            said, result = f"exit code {done.returncode}: {done.stderr.decode()}", {}
            if done.returncode in (0, 4):
                result = json.loads(done.stdout)["answers"][0]
                said = fault(result, expected, most)
            if not said:
                continue
            bad += 1
            print(f"# scene {number} of seed {SEED}, {kind}: {said}; expected {expected}")
            for one in result.get("tests", []):
                print(f"#     {one['points']:g} {one['kind']}: {one['name']}: {one['message']} ({one.get('output', '')})")
            if os.environ.get("FBD_KEEP"):
                for name, text in (("key", key), ("answer", answer)):
                    Path(os.environ["FBD_KEEP"], f"{number}.{name}.yaml").write_text(text, encoding="utf-8")
    print(f"{'not ok' if bad else 'ok'} 1 - {SCENES} scenes of seed {SEED}: reactions are worth what they are ({bad} not so)")
    print("1..1")
    return bad > 0


if __name__ == "__main__":
    sys.exit(main())
