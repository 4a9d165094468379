# SPDX-License-Identifier: GPL-3.0-or-later
"""Models as trees of text: their bodies and what these list."""
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
        self.loads.sort(key=lambda load: load.group)
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

    def is_zero(self, value):
        """Is it zero, or does it name a parameter that is?"""
        parameters = self._root.get("parameters", {})
        given = [parameters.get(word, "1") for word in words(str(value))]
        texts = [value, *(one["value"] if isinstance(one, dict) and "value" in one else one for one in given)]
        found = [QUANTITY.match(str(text)) for text in texts]
        return any(one and float(one[1]) == 0 for one in found)


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
