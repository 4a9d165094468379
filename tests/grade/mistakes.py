# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of students. Each takes a sheet and says what it has to be called: (kinds, body, name of the entry), or None
where it cannot be made."""
import math

from trees import Load, as_list, expression, in_world, place, put, words

# ---- errors


def given(sheet):
    """A force or moment that is given, and its value by one expression."""
    loads = [load for load in sheet.loads("applied") + sheet.loads("applied", group="moments")
             if "toward" not in load.keys and not isinstance(load.keys.get("value"), list) and not sheet.is_zero(load.keys.get("value", "1"))]
    return sheet.rng.choice(loads) if loads else None


def scaled(load, factor):
    unit = load.body.sheet.force
    for key in ("value", "fx", "fy"):
        if key in load.keys:
            load.keys[key] = f"{factor}*{expression(load.keys[key], unit if load.group == 'forces' else unit + '*' + load.body.sheet.length)}"
    load.wrong = True


def forgotten(sheet):
    loads = [load for body in sheet.bodies for load in body.loads if load.kind not in ("normal", "distributed") and
             not (load.kind == "friction" and load.group == "forces")]
    if not loads:
        return None
    load = sheet.rng.choice(loads)
    if len(loads) == 1 and not any(body.node.get("hand") for body in sheet.bodies):
        return None  # a sheet without anything is none
    if load.kind == "gravity" and any(other.kind == "normal" for other in load.body.loads):
        return None  # nothing presses: the answer cannot be as the sheet is
    load.body.loads.remove(load)
    return ("missing",), load.body.name, ""


def friction_forgotten(sheet):
    load = sheet.a_load("friction")
    if not load:
        return None
    load.body.loads.remove(load)
    return ("missing",), load.body.name, ""


def one_too_many(sheet):
    body = sheet.rng.choice(sheet.bodies)
    rng, name = sheet.rng, sheet.new_name()
    keys = {"name": name, "value": f"{rng.uniform(3, 30):.3g} {sheet.force}", "angle": f"{rng.uniform(0, 360):.4g} deg"}
    load = Load(body, "forces", {"applied": keys})
    load.wrong = True
    body.loads.append(load)
    return ("superfluous",), body.name, name


def the_other_way(sheet):
    load = given(sheet)
    if not load:
        return None
    scaled(load, -1)
    return ("sense",), load.body.name, load.name


def too_large(sheet):
    load = given(sheet)
    if not load:
        return None
    scaled(load, sheet.rng.choice((0.5, 1.3, 2, 3)))
    return ("magnitude",), load.body.name, load.name


def another_unit(sheet):
    load = given(sheet)
    if not load:
        return None
    scaled(load, sheet.rng.choice((1000, 0.001, 4.4482216152605, 9.80665 if sheet.us else 4.4482216152605)))
    return ("unit", "magnitude") if sheet.us else ("unit",), load.body.name, load.name


def weight_upward(sheet):
    load = sheet.a_load("gravity")
    if not load or not sheet.down() or any(other.kind == "normal" for other in load.body.loads):
        return None
    name = sheet.new_name()
    put(load, ("forces", {"name": name, "value": "m*g", "angle": "90 deg"}))
    load.body.loads[[one.name for one in load.body.loads].index(name)].wrong = True
    return ("sense",), load.body.name, name


def weight_across(sheet):
    load = sheet.a_load("gravity")
    if not load or not sheet.down() or any(other.kind == "normal" for other in load.body.loads):
        return None
    name, turn = sheet.new_name(), sheet.rng.choice((-1, 1)) * sheet.rng.uniform(15, 165)
    put(load, ("forces", {"name": name, "value": "m*g", "angle": f"{-90 + turn:.4g} deg"}))
    load.body.loads[[one.name for one in load.body.loads].index(name)].wrong = True
    return ("direction",), load.body.name, name


def turned_away(sheet):
    load = given(sheet)
    if not load or load.group == "moments" or not in_world(load):
        return None
    x, y = in_world(load)
    turn = math.radians(sheet.rng.choice((-1, 1)) * sheet.rng.uniform(15, 165))
    c, s, name = math.cos(turn), math.sin(turn), load.name
    put(load, ("forces", {"name": name, "fx": f"{c:.15g}*({x}) - {s:.15g}*({y})", "fy": f"{s:.15g}*({x}) + {c:.15g}*({y})", **place(load)}))
    load.body.loads[[one.name for one in load.body.loads].index(name)].wrong = True
    return ("direction",), load.body.name, name


def at_another_place(sheet):
    loads = [load for load in sheet.loads("applied") if load.body.turns and in_world(load) and isinstance(load.keys.get("at", "G"), str)]
    if not loads:
        return None
    load = sheet.rng.choice(loads)
    x, y = in_world(load)
    size = f"hypot({x}, {y})"
    body, at, name = load.body.name, load.keys.get("at", "G"), load.name
    # across its line, by a length of its own size
    load.keys["at"] = {"point": at, "offset": ["0", "0"]}
    shift = f"{sheet.rng.choice((-1, 1)) * sheet.rng.uniform(0.3, 1):.3g}[{sheet.length}]"
    load.keys["at"]["offset"] = [f"-{shift}*({y})/({size})", f"{shift}*({x})/({size})"]
    load.wrong = True
    return ("place",), body, name


def another_coefficient(sheet):
    load = sheet.a_load("friction")
    if not load:
        return None
    for key in ("coefficient", "static", "kinetic"):
        if key in load.keys:
            load.keys[key] = f"1.4*{expression(load.keys[key])}"
    load.wrong = True
    return ("coefficient",), load.body.name, load.name


def another_stiffness(sheet):
    loads = [load for group in ("forces", "moments") for load in sheet.loads("spring", "damper", group=group)]
    if not loads:
        return None
    load = sheet.rng.choice(loads)
    key = "stiffness" if load.kind == "spring" else "coefficient"
    if sheet.is_zero(load.keys[key]):  # 1.7 times that is no error
        return None
    bare = {"forces": {"spring": f"{sheet.force}/{sheet.length}", "damper": f"{sheet.force}*s/{sheet.length}"},
            "moments": {"spring": f"{sheet.force}*{sheet.length}", "damper": f"{sheet.force}*{sheet.length}*s"}}[load.group][load.kind]
    load.keys[key] = f"1.7*{expression(load.keys[key], bare)}"
    load.wrong = True
    return ("magnitude",), load.body.name, load.name


def on_the_other_body(sheet):
    """A force that belongs to another body: missing there, superfluous here."""
    loads = [load for load in sheet.loads("applied") if in_world(load) and load.body.kind != "track" and len(sheet.bodies) > 1]
    if not loads:
        return None
    load = sheet.rng.choice(loads)
    x, y = in_world(load)
    if any("theta" in words(text) or "x" in words(text) or "v" in words(text) for text in (x, y)):
        return None
    body = sheet.rng.choice([body for body in sheet.bodies if body is not load.body])
    load.body.loads.remove(load)
    other = Load(body, "forces", {"applied": {"name": sheet.new_name(), "fx": x, "fy": y}})
    other.wrong = True
    body.loads.append(other)
    return ("missing", "superfluous"), None, None


def a_line_with_a_sign(sheet):
    return wrong_line(sheet, lambda left, right: f"{left}={flip(right)}" if flip(right) else None)


def flip(text):
    """The first sign between two terms is the other one."""
    depth = 0
    for i, letter in enumerate(text):
        depth += (letter in "([") - (letter in ")]")
        if depth == 0 and letter in "+-" and text[:i].strip() and text[:i].rstrip()[-1] not in "*/^(+-eE":
            return text[:i] + ("-" if letter == "+" else "+") + text[i + 1:]
    return None


def a_line_with_sine_for_cosine(sheet):
    def change(left, right):
        for one, other in (("sin(", "cos("), ("cos(", "sin(")):
            if one in right:
                return f"{left}={right.replace(one, other, 1)}"
        return None
    return wrong_line(sheet, change)


def a_line_twice_as_large(sheet):
    return wrong_line(sheet, lambda left, right: f"{left}=2*({right})" if right.strip() not in ("0",) else None)


def wrong_line(sheet, change):
    lines = [(body, i) for body in sheet.bodies for i, line in enumerate(as_list(body.node.get("hand")))
             if isinstance(line, str) or "equation" in line]
    if not lines:
        return None
    body, i = sheet.rng.choice(lines)
    hands = as_list(body.node["hand"])
    line = hands[i]
    text = line if isinstance(line, str) else line["equation"]
    left, _, right = text.partition("=")
    made = change(left, right)
    if not made:
        return None
    hands[i] = made if isinstance(line, str) else {**line, "equation": made}
    body.node["hand"] = hands
    return ("derivation",), body.name, None


ERRORS = [forgotten, friction_forgotten, one_too_many, the_other_way, too_large, another_unit, weight_upward, weight_across, turned_away,
          at_another_place, another_coefficient, another_stiffness, on_the_other_body, a_line_with_a_sign, a_line_with_sine_for_cosine,
          a_line_twice_as_large]
