# SPDX-License-Identifier: GPL-3.0-or-later
"""Models as trees of text, other ways of writing them that mean the same, and errors. A change takes a sheet and says
whether it could be made; an error says what it has to be called: (kinds, body, name of the entry)."""
import math
import re

import yaml

# ---- trees of text: every scalar is the text that it was


class Plain(yaml.SafeLoader):
    yaml_implicit_resolvers = {}


class Dump(yaml.SafeDumper):
    yaml_implicit_resolvers = {}

    def ignore_aliases(self, data):
        return True


def read(path):
    return yaml.load(path.read_text(encoding="utf-8"), Plain)


def write(root):
    return yaml.dump(root, Dumper=Dump, sort_keys=False, width=10000, default_flow_style=None)


QUANTITY = re.compile(r"^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z][A-Za-z0-9*/^]*)?\s*$")


def expression(value, unit=""):
    """A value as part of an expression: `5 N` is `5[N]`; a bare number has the unit that is given."""
    found = QUANTITY.match(value)
    if not found:
        return f"({value})"
    unit = found[2] or unit
    return f"({found[1]}[{unit}])" if unit else f"({found[1]})"


def words(text):
    return set(re.findall(r"[A-Za-z_][A-Za-z0-9_]*(?:\.[A-Za-z_][A-Za-z0-9_]*)*", text))


def replaced(text, names):
    """Words of an expression replaced; units in brackets and what stands behind a dot are none."""
    pattern = re.compile(r"\[[^\]]*\]|(?<![\w.])(" + "|".join(map(re.escape, names)) + r")(?![\w.(])")
    return pattern.sub(lambda found: names[found[1]] if found[1] else found[0], text)


def map_texts(node, change):
    if isinstance(node, dict):
        return {key: map_texts(value, change) for key, value in node.items()}
    if isinstance(node, list):
        return [map_texts(value, change) for value in node]
    return change(node) if isinstance(node, str) else node


def all_texts(node):
    if isinstance(node, dict):
        for value in node.values():
            yield from all_texts(value)
    elif isinstance(node, list):
        for value in node:
            yield from all_texts(value)
    elif isinstance(node, str):
        yield node


# ---- a sheet


class Load:
    """An entry of `forces` or `moments` of a body."""

    def __init__(self, body, group, entry):
        self.body, self.group = body, group
        self.kind = entry if isinstance(entry, str) else next(iter(entry))
        value = None if isinstance(entry, str) else entry[self.kind]
        brief = {"applied": "value", "friction": "coefficient", "spring": "stiffness", "damper": "coefficient", "potential": "V"}
        self.keys = dict(value) if isinstance(value, dict) else {brief[self.kind]: value} if value else {}
        self.wrong = False

    @property
    def name(self):
        return self.keys.get("name", self.kind)

    def entry(self):
        return {self.kind: self.keys} if self.keys else self.kind


class Body:
    def __init__(self, sheet, name, node):
        self.sheet, self.name, self.node = sheet, name, node
        motion = node["motion"]
        self.kind = motion if isinstance(motion, str) else next(iter(motion))
        self.motion = motion[self.kind] if isinstance(motion, dict) else {}
        if not isinstance(self.motion, dict):
            self.motion = {"along": self.motion} if self.kind == "slide" else {}
        self.on_ground = "on" not in self.motion
        self.turns = self.kind in ("pivot", "planar")
        self.loads = [Load(self, group, entry) for group in ("forces", "moments") for entry in as_list(node.get(group))]

    def along(self):
        """Direction of a slide of the ground, as an expression, or None."""
        if self.kind == "slide" and self.on_ground and "line" not in self.motion:
            return expression(self.motion.get("along", "0"), "rad")
        return None

    def written(self):
        self.node["motion"] = {self.kind: self.motion} if self.motion else self.kind
        for group in ("forces", "moments"):
            entries = [load.entry() for load in self.loads if load.group == group]
            self.node.pop(group, None)
            if entries:
                self.node[group] = entries

    def has_children(self):
        return any(other.motion.get("on") == self.name for other in self.sheet.bodies)


def as_list(node):
    return [] if node in (None, "", "[]") else node if isinstance(node, list) else [node]


class Sheet:
    def __init__(self, root, rng):
        self._root, self.rng = root, rng
        self.us = root.get("units") == "US"
        self.force = "lbf" if self.us else "N"
        self.length = "ft" if self.us else "m"
        self.bodies = [Body(self, name, node) for name, node in root["bodies"].items() if isinstance(node, dict)]
        self.count = 0

    @property
    def root(self):
        for body in self.bodies:
            body.written()
        return self._root

    def new_name(self):
        self.count += 1
        return f"own_{self.count}_{self.rng.randrange(1000)}"

    def down(self):
        return "gravity" not in self._root or QUANTITY.match(str(self._root["gravity"]))

    def loads(self, *kinds, group="forces"):
        return [load for body in self.bodies for load in body.loads if load.kind in kinds and load.group == group]

    def a_load(self, *kinds, group="forces", right=True):
        found = [load for load in self.loads(*kinds, group=group) if not (right and load.wrong)]
        return self.rng.choice(found) if found else None

    def is_named(self, load):
        """Does anything refer to the load? Then it keeps its name."""
        name = f"{load.body.name}.{load.name}"
        return any(name in text for text in all_texts(self._root.get("couplings", [])))


def components(load):
    """(fx, fy) of an applied force as expressions of the world or the body's frame, and the frame; None when unknown."""
    keys, body = load.keys, load.body
    unit = body.sheet.force
    if "toward" in keys or isinstance(keys.get("value"), list):
        if isinstance(keys.get("value"), list) and "toward" not in keys:
            return tuple(expression(value, unit) for value in keys["value"]) + (keys.get("frame", "world"),)
        return None
    if "fx" in keys or "fy" in keys:
        return expression(keys.get("fx", "0"), unit), expression(keys.get("fy", "0"), unit), keys.get("frame", "world")
    value, frame = expression(keys["value"], unit), keys.get("frame", "world")
    if "angle" in keys:
        angle = expression(keys["angle"], "rad")
        return f"{value}*cos{angle}", f"{value}*sin{angle}", frame
    if body.kind == "slide":
        return value, f"0[{unit}]", "body"
    return None


def in_world(load):
    parts = components(load)
    if not parts or parts[2] == "world":
        return parts and parts[:2]
    body = load.body
    if body.turns:
        angle = f"{body.name}.angle"
    else:
        angle = body.along()
    if angle is None:
        return None
    return (f"({parts[0]})*cos({angle}) - ({parts[1]})*sin({angle})", f"({parts[0]})*sin({angle}) + ({parts[1]})*cos({angle})")


def place(load):
    return {"at": load.keys["at"]} if "at" in load.keys else {}


def put(load, *entries):
    """Other loads in the place of one."""
    loads = load.body.loads
    where = loads.index(load)
    made = [Load(load.body, group, {"applied": keys}) for group, keys in entries]
    for one in made:
        one.wrong = load.wrong
    loads[where:where + 1] = made
    return True


# ---- the same in other words


def weight_by_hand(sheet):
    load = sheet.a_load("gravity")
    if not load or not sheet.down():
        return False
    name, rng = sheet.new_name(), sheet.rng
    way = rng.randrange(3)
    if way == 0:
        return put(load, ("forces", {"name": name, "value": "m*g", "angle": "-90 deg"}))
    if way == 1:
        return put(load, ("forces", {"name": name, "fx": f"0 {sheet.force}", "fy": "-m*g"}))
    # along inclined axes, of the slope where there is one
    angle = load.body.along() or f"({rng.uniform(-80, 80):.3g}[deg])"
    return put(load, ("forces", {"name": name + "a", "value": f"-m*g*sin{angle}", "angle": angle}),
               ("forces", {"name": name + "b", "value": f"m*g*cos{angle}", "angle": f"{angle} - pi/2"}))


def force_by_components(sheet):
    load = sheet.a_load("applied")
    parts = load and components(load)
    if not parts or load.wrong:
        return False
    keys = {"name": sheet.new_name(), "fx": parts[0], "fy": parts[1], **place(load)}
    if parts[2] == "body":
        keys["frame"] = "body"
    return put(load, ("forces", keys))


def force_in_the_world(sheet):
    load = sheet.a_load("applied")
    parts = load and in_world(load)
    if not parts or (load.body.kind == "slide" and load.body.along() is None):
        return False
    return put(load, ("forces", {"name": sheet.new_name(), "fx": parts[0], "fy": parts[1], **place(load)}))


def force_along_inclined_axes(sheet):
    load = sheet.a_load("applied")
    parts = load and in_world(load)
    if not parts:
        return False
    angle = f"({sheet.rng.uniform(-80, 80):.3g}[deg])"
    name = sheet.new_name()
    x, y = f"({parts[0]})", f"({parts[1]})"
    return put(load, ("forces", {"name": name + "a", "value": f"{x}*cos{angle} + {y}*sin{angle}", "angle": angle, **place(load)}),
               ("forces", {"name": name + "b", "value": f"{y}*cos{angle} - {x}*sin{angle}", "angle": f"{angle} + pi/2", **place(load)}))


def force_in_parts(sheet):
    load = sheet.a_load("applied")
    parts = load and components(load)
    if not parts:
        return False
    name, share = sheet.new_name(), sheet.rng.uniform(-0.5, 1.5)
    frame = {"frame": "body"} if parts[2] == "body" else {}
    return put(load, *[("forces", {"name": name + letter, "fx": f"{f:.4f}*{parts[0]}", "fy": f"{f:.4f}*{parts[1]}", **frame, **place(load)})
                       for letter, f in (("a", round(share, 4)), ("b", 1 - round(share, 4)))])


def couple_for_an_offset(sheet):
    """At G, with the moment that it had about G."""
    found = [load for load in sheet.loads("applied") if load.body.turns and isinstance(load.keys.get("at"), (str, list))]
    load = sheet.rng.choice(found) if found else None
    parts = load and in_world(load)
    if not parts or load.wrong:
        return False
    body, at = load.body, load.keys["at"]
    if isinstance(at, list):
        at = sheet.new_name()
        body.node.setdefault("points", {})[at] = load.keys["at"]
    name, where = sheet.new_name(), body.name
    moment = f"({where}.{at}.x - {where}.G.x)*({parts[1]}) - ({where}.{at}.y - {where}.G.y)*({parts[0]})"
    return put(load, ("forces", {"name": name, "fx": parts[0], "fy": parts[1]}), ("moments", {"name": name + "m", "value": moment}))


def all_forces_at_the_centre(sheet):
    """Every given force of a body at G, and one moment for all of them."""
    for body in sheet.bodies:
        loads = [load for load in body.loads if load.kind == "applied" and load.group == "forces" and isinstance(load.keys.get("at"), str)]
        worlds = [in_world(load) for load in loads]
        if not body.turns or len(loads) < 2 or None in worlds or any(load.wrong for load in loads):
            continue
        moment, where = [], body.name
        for load, (x, y) in zip(loads, worlds):
            at = load.keys["at"]
            moment.append(f"({where}.{at}.x - {where}.G.x)*({y}) - ({where}.{at}.y - {where}.G.y)*({x})")
            put(load, ("forces", {"name": sheet.new_name(), "fx": x, "fy": y}))
        body.loads.append(Load(body, "moments", {"applied": {"name": sheet.new_name(), "value": " + ".join(moment)}}))
        return True
    return False


def moment_for_a_force_at_the_rim(sheet):
    """A couple: two opposite forces, apart from each other."""
    load = sheet.a_load("applied", group="moments")
    if not load or load.wrong:
        return False
    arm = f"{sheet.rng.uniform(0.1, 2):.4g}"
    value, name = expression(load.keys["value"], f"{sheet.force}*{sheet.length}"), sheet.new_name()
    size = f"{value}/(2*{arm}[{sheet.length}])"
    return put(load, ("forces", {"name": name + "a", "fx": "0 N", "fy": size, "frame": "body", "at": [f"{arm} {sheet.length}", "0"]}),
               ("forces", {"name": name + "b", "fx": "0 N", "fy": f"-{size}", "frame": "body", "at": [f"-{arm} {sheet.length}", "0"]}))


def resultant_of_two(sheet):
    for body in sheet.bodies:
        loads = [load for load in body.loads if load.kind == "applied" and load.group == "forces"]
        if len(loads) < 2 or any(load.wrong for load in loads[:2]):
            continue
        a, b = loads[:2]
        one, two = in_world(a), in_world(b)
        if one and two and a.keys.get("at") == b.keys.get("at"):
            body.loads.remove(b)
            return put(a, ("forces", {"name": sheet.new_name(), "fx": f"{one[0]} + {two[0]}", "fy": f"{one[1]} + {two[1]}", **place(a)}))
    return False


def spring_by_hand(sheet):
    for group, unit, angle in (("forces", f"{sheet.force}/{sheet.length}", False), ("moments", f"{sheet.force}*{sheet.length}", True)):
        load = sheet.a_load("spring", group=group)
        if not load or load.wrong or "to" in load.keys or not load.body.on_ground:
            continue
        if not (load.body.kind == "pivot" if angle else load.body.along()):
            continue
        if not angle and "free_length" in load.keys:
            continue
        stiffness = expression(load.keys["stiffness"], unit)
        neutral = expression(load.keys.get("neutral", "0"), "rad" if angle else sheet.length)
        coordinate = "theta" if angle else "x"
        return put(load, (group, {"name": sheet.new_name(), "value": f"-{stiffness}*({coordinate} - {neutral})"}))
    return False


def damper_by_hand(sheet):
    for group, rate in (("forces", "v"), ("moments", "omega")):
        load = sheet.a_load("damper", group=group)
        if not load or load.wrong or "to" in load.keys or not load.body.on_ground:
            continue
        if not (load.body.kind == "pivot" if group == "moments" else load.body.along()):
            continue
        unit = f"{sheet.force}*{sheet.length}*s" if group == "moments" else f"{sheet.force}*s/{sheet.length}"
        return put(load, (group, {"name": sheet.new_name(), "value": f"-{expression(load.keys['coefficient'], unit)}*{rate}"}))
    return False


def drag_by_hand(sheet):
    load = sheet.a_load("drag")
    if not load or load.wrong or "wind" in load.keys or "at" in load.keys or load.body.kind not in ("particle", "planar"):
        return False
    where, parts = load.body.name, []
    speed = f"hypot({where}.G.vx, {where}.G.vy)"
    unit = f"{sheet.force}*s/{sheet.length}"
    if "linear" in load.keys:
        parts.append(expression(load.keys["linear"], unit))
    if "quadratic" in load.keys:
        parts.append(f"{expression(load.keys['quadratic'], unit + '*s/' + sheet.length)}*{speed}")
    c = " + ".join(parts)
    return put(load, ("forces", {"name": sheet.new_name(), "fx": f"-({c})*{where}.G.vx", "fy": f"-({c})*{where}.G.vy"}))


def other_order(sheet):
    for body in sheet.bodies:
        sheet.rng.shuffle(body.loads)
    return True


def other_names_of_parameters(sheet):
    root = sheet.root
    if not isinstance(root.get("parameters"), dict) or root.get("tables") or root.get("grading"):
        return False
    names = {name: f"{name}_{sheet.rng.randrange(100)}" for name in root["parameters"]}
    own = {load.name for load in sheet.loads("applied")} | {body.name for body in sheet.bodies}
    for points in [root.get("ground", {}).get("points")] + [body.node.get("points") for body in sheet.bodies]:
        own |= set(points or ())
    root["parameters"] = {names[name]: value for name, value in root["parameters"].items()}
    keep = {key: root.pop(key) for key in ("title", "description") if key in root}

    def change(node, key=""):
        if isinstance(node, dict):
            return {name: change(value, name) for name, value in node.items()}
        if isinstance(node, list):
            return [change(value, key) for value in node]
        if not isinstance(node, str) or node in own or (QUANTITY.match(node) and not node.strip()[0].isalpha()):
            return node
        return node if key in ("name", "between", "on", "motion", "line") else replaced(node, names)

    for key, value in list(root.items()):
        root[key] = change(value, key)
    root.update(keep)
    again = Sheet(root, sheet.rng)
    wrong = [[load.wrong for load in body.loads] for body in sheet.bodies]
    for body, flags in zip(again.bodies, wrong):
        for load, flag in zip(body.loads, flags):
            load.wrong = flag
    sheet.bodies, sheet._root = again.bodies, again._root
    for body in sheet.bodies:
        body.sheet = sheet
    return True


# What counts and where from: expressions of a body in the coordinate that it had.


def mentioned(sheet, body):
    """Does something outside the body name its coordinates?"""
    own = sheet.root["bodies"][body.name]
    rest = {**sheet.root, "bodies": {name: node for name, node in sheet.root["bodies"].items() if name != body.name}, "simulate": None}
    names = [f"{body.name}.{name}" for name in ("x", "v", "v_dot", "a", "theta", "omega", "omega_dot", "x_dot", "theta_ddot", "alpha")]
    return any(word in names for text in all_texts(rest) for word in words(text)) or any(
        word in names for text in all_texts(own) for word in words(text))


SLIDE = ("x", "v", "v_dot", "a", "x_dot", "x_ddot", "a_x")


def of_other_coordinate(body, place_, sign):
    """Expressions of a slide in another coordinate: x is place_, rates have the sign."""
    names = {"x": place_, **({name: f"({sign}{name})" for name in SLIDE[1:]} if sign else {})}

    def change(node, key=""):
        if isinstance(node, dict):
            return {name: change(value, name) for name, value in node.items()}
        if isinstance(node, list):
            return [change(value, key) for value in node]
        return replaced(node, names) if isinstance(node, str) and key not in ("name", "at") else node

    for load in body.loads:
        load.keys = change(load.keys)
    if "hand" in body.node:
        body.node["hand"] = change(body.node["hand"])


def can_count_otherwise(sheet, body):
    return (body.along() and not body.has_children() and not mentioned(sheet, body) and "prescribed" not in body.motion and
            "exact" not in body.node and not {"low", "high", "x", "p"} & set(body.motion) and "parts" not in body.node and
            not any(load.kind in ("potential", "distributed") or isinstance(load.keys.get("value"), list) or "surface_speed" in load.keys
                    or "frame" in load.keys or "side" in load.keys for load in body.loads) and
            not sheet.root.get("couplings") and not sheet.root.get("contacts") and isinstance(body.node.get("initial", {}), dict) and
            all(isinstance(value, str) for value in body.node.get("initial", {}).values()))


def x_counts_the_other_way(sheet):
    bodies = [body for body in sheet.bodies if can_count_otherwise(sheet, body)]
    if not bodies:
        return False
    body = sheet.rng.choice(bodies)
    of_other_coordinate(body, "(-x)", "-")
    for load in body.loads:
        if load.kind == "applied" and "angle" not in load.keys and "fx" not in load.keys and "fy" not in load.keys and "toward" not in load.keys:
            load.keys["value"] = f"-{expression(load.keys['value'], sheet.force)}"
        if load.kind == "spring" and "neutral" in load.keys:
            load.keys["neutral"] = f"-{expression(load.keys['neutral'], sheet.length)}"
    body.motion["along"] = f"{body.along()} + pi"
    body.node["initial"] = {name: f"-{expression(value, sheet.length + ('/s' if name == 'v' else ''))}"
                            for name, value in body.node.get("initial", {}).items()}
    return True


def x_counts_from_elsewhere(sheet):
    bodies = [body for body in sheet.bodies if can_count_otherwise(sheet, body) and "through" not in body.motion]
    if not bodies:
        return False
    body = sheet.rng.choice(bodies)
    shift, along = f"{sheet.rng.uniform(0.5, 2):.3g}[{sheet.length}]", body.along()
    of_other_coordinate(body, f"(x + {shift})", "")
    for load in body.loads:
        if load.kind == "spring" and "to" not in load.keys:
            load.keys["neutral"] = f"{expression(load.keys.get('neutral', '0'), sheet.length)} - {shift}"
    body.motion["along"] = along
    body.motion["through"] = [f"{shift}*cos{along}", f"{shift}*sin{along}"]
    initial = dict(body.node.get("initial", {}))
    initial["x"] = f"{expression(initial.get('x', '0'), sheet.length)} - {shift}"
    body.node["initial"] = initial
    return True


def theta_counts_from_elsewhere(sheet):
    """The frame of a rod on a pivot turned: its ends are elsewhere in it, and theta is less by that."""
    for body in sheet.bodies:
        node = body.node
        if (body.kind != "pivot" or not body.on_ground or body.has_children() or mentioned(sheet, body) or "parts" in node or
                not {"from", "to"} <= set(node) or "points" in node or "exact" in node or sheet.root.get("couplings") or
                sheet.root.get("contacts") or "prescribed" in body.motion or not {"point"}.isdisjoint(body.motion) or
                any(load.kind in ("potential", "distributed", "spring") or "frame" in load.keys or not isinstance(load.keys.get("at", ""), str)
                    for load in body.loads)):
            continue
        turn = sheet.rng.choice((90, -90, 180, 37.5))
        c, s = f"cos({-turn}[deg])", f"sin({-turn}[deg])"
        for end in ("from", "to"):
            x, y = (expression(value, sheet.length) for value in node[end])
            node[end] = [f"{x}*{c} - {y}*{s}", f"{x}*{s} + {y}*{c}"]
        names = {"theta": f"(theta + {turn}[deg])", "angle": f"(angle + {turn}[deg])"}
        for load in body.loads:
            load.keys = {key: map_texts(value, lambda text: replaced(text, names)) if key not in ("name", "at", "angle") else
                         replaced(value, {"theta": names["theta"]}) if key == "angle" else value for key, value in load.keys.items()}
        if "hand" in node:
            node["hand"] = map_texts(node["hand"], lambda text: replaced(text, names))
        initial = dict(node.get("initial", {}))
        initial["theta"] = f"{expression(initial.get('theta', '0'), 'rad')} + {turn}[deg]"
        node["initial"] = initial
        # the frame turned by -turn in the body: a direction at phi of the old frame is at phi - turn in the new one
        return True
    return False


SAME = [weight_by_hand, force_by_components, force_in_the_world, force_along_inclined_axes, force_in_parts, couple_for_an_offset,
        all_forces_at_the_centre, moment_for_a_force_at_the_rim, resultant_of_two, spring_by_hand, damper_by_hand, drag_by_hand,
        other_order, other_names_of_parameters, x_counts_the_other_way, x_counts_from_elsewhere, theta_counts_from_elsewhere]


# ---- errors


def given(sheet):
    """A force or moment that is given, and its value by one expression."""
    loads = [load for load in sheet.loads("applied") + sheet.loads("applied", group="moments")
             if "toward" not in load.keys and not isinstance(load.keys.get("value"), list)]
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
    loads = [load for load in sheet.loads("applied") if in_world(load)]
    if not loads:
        return None
    load = sheet.rng.choice(loads)
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
    lines = [(body, i) for body in sheet.bodies for i, _ in enumerate(as_list(body.node.get("hand")))]
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
