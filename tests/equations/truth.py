# SPDX-License-Identifier: GPL-3.0-or-later
"""Is every symbolic line of a scene true? Each term in symbols is read back, evaluated by numbers, and compared with
the number beside it.

What a symbol means is in docs/output.md. At one state: N_1 alone is the length of the arrow that the drawing labels so,
N_1x a component of the vector N_1, M_G(N_1) its moment, and the vector is the one on the body whose joint or list it is
in, or on the first body of a coupling. On the page, at all times: F alone is the component along the line of the slide,
M alone a moment counter-clockwise.
"""
import math
import re
import xml.etree.ElementTree as ElementTree
from collections import Counter

import yaml

from formula import Unbound, evaluate, from_latex, printed

LAWS = {"gravity", "spring", "damper", "drag"}
LAW = re.compile(r"[mM](_\w+|[0-9]*) (g\b|g_[xy]|\(|g ).*|[kc] .*|\(c \+ k .*")
WORDS = re.compile(r"acts across(?: the guide)?|through the axis|m g along (?:x|the axis|the track)|toward .*|drag at its point.*|"
                   r"k \(l - l0\) toward its end|-c l' along its line")
NORMAL = re.compile(r"acts across: N = (\S+)(?: \(contact is lost.*\))?")
STICKS = re.compile(r"sticks: the force of equilibrium, up to (.*) = (\S+)")
IDLE = re.compile(r"(.* = )0 (while out of contact|while slack|before the beginning|after the end)")
SLIPS = re.compile(r"slips: (\S.*?)(?: at slip = \S+)?")


def near(got, want, scale, what):
    assert abs(got - want) <= 2e-6 * (scale + abs(want)) + 1e-9, f"{what} is {got:.9g}, and the term {want:.9g}"


def cross(a, b):
    return a[0] * b[1] - a[1] * b[0]


class Entry:
    """A force or moment of the file, by the name of its arrow."""

    def __init__(self, entry, moment):
        self.kind, keys = (entry, {}) if isinstance(entry, str) else next(iter(entry.items()))
        self.keys = keys if isinstance(keys, dict) else {None: keys}
        self.name = self.keys.get("name", self.kind)
        self.moment = moment

    def get(self, *names):
        """The first key of these that is there; the value of a short form."""
        return next((self.keys[name] for name in (*names, None) if name in self.keys), None)


class Scene:
    """What the file says."""

    def __init__(self, text, model):
        self.model = model
        self.file = yaml.load(text, yaml.BaseLoader)
        self.bodies = list(self.file["bodies"])
        self.entries = {b: {} for b in self.bodies}
        for b, body in self.file["bodies"].items():
            for list_name in ("forces", "moments"):
                for entry in body.get(list_name) or []:
                    entry = Entry(entry, list_name == "moments")
                    self.entries[b][entry.name] = entry
        self.couplings = [Entry(entry, False).name for entry in self.file.get("couplings") or []]
        self.parents = {b: self.parent_of(body.get("motion")) for b, body in self.file["bodies"].items()}

    @staticmethod
    def parent_of(motion):
        keys = next(iter(motion.values())) if isinstance(motion, dict) else None
        return keys.get("on") if isinstance(keys, dict) else None

    def number(self, text, unit):
        """Of a value of the file; None where it is more than a number."""
        if isinstance(text, dict):
            text = text.get("value", text.get("coefficient"))
        for _ in range(3):
            if not isinstance(text, str) or text not in self.file.get("parameters", {}):
                break
            text = self.file["parameters"][text]
            text = text["value"] if isinstance(text, dict) else text
        try:
            return None if text is None else self.model.quantity(text, unit)
        except Exception:  # an expression
            return None

    def mass_name(self, b, mass):
        """The parameter that is its mass; else by the number of the body, by m alone where it is the only one, or where a
        parameter of that name is another mass."""
        name = str(self.file["bodies"][b].get("mass"))
        if name in self.file.get("parameters", {}) and re.fullmatch(r"[mM](_\w+|\d*)", name):
            return name
        if len(self.bodies) == 1:
            return "m"
        number = self.bodies.index(b) + 1
        given = [p for p in (f"m_{number}", f"m{number}") if p in self.file.get("parameters", {})]
        return "m" if given and self.number(given[0], "kg") != mass else f"m_{number}"

    def kind(self, b):
        motion = self.file["bodies"][b].get("motion", "")
        return motion if isinstance(motion, str) else next(iter(motion))

    def turns_along(self, b):
        motion = self.file["bodies"][b]["motion"]
        return self.kind(b) == "track" and str(motion["track"].get("turn", "true")) == "true"

    def along(self, b):
        """The angle of a slide on the ground, where the file says it."""
        motion = self.file["bodies"][b]["motion"]
        keys = motion["slide"] if isinstance(motion, dict) else {}
        if not isinstance(keys, dict) or "line" in keys or "from" in keys:
            return None
        return self.number(keys["along"], "rad") if "along" in keys else 0

    def constants(self, b, name):
        """The numbers of one entry, by the letters of its law."""
        entry = self.entries[b].get(name)
        if not entry:
            return {}
        number = lambda unit, *keys: self.number(entry.get(*keys), unit)  # noqa: E731
        if entry.kind == "spring":
            unit = "N*m" if entry.moment else "N/m"
            rest = number("rad" if entry.moment else "m", "neutral") if "neutral" in entry.keys else 0
            return {"k": number(unit, "stiffness"), **dict.fromkeys(("x0", "s0", "theta0"), rest)}
        if entry.kind == "damper":
            return {"c": number("N*m*s" if entry.moment else "N*s/m", "coefficient")}
        if entry.kind == "drag":
            wind = entry.keys.get("wind")
            return {"c": number("N*s/m", "linear"), "k": number("N*s^2/m^2", "quadratic"),
                    "w": wind and self.vector(wind)}
        if entry.kind == "friction":
            unit = "N*m" if entry.moment else "1"
            return {letter + index: number(unit, key) for letter in ("mu_", "M_")
                    for index, key in (("s", "static"), ("k", "kinetic"))}
        if entry.kind == "thrust":
            return {"exhaust": number("m/s", "exhaust"), "thrust_angle": number("rad", "angle"),
                    "dm": self.mass_rate(b)}
        if entry.kind == "power":
            return {"P": number("W", "P", "value")}
        return {}

    def mass_rate(self, b):
        """Of a mass `3[kg] - 0.2[kg/s]*t`."""
        found = re.fullmatch(r"([0-9.]+)\[kg\] - ([0-9.]+)\[kg/s\]\*t", str(self.file["bodies"][b].get("mass")))
        return -float(found[2]) if found else None

    def slope(self, b, name, coordinate, values):
        """dV/dq of a potential that is a polynomial of pure numbers, by a central difference."""
        text = str(self.entries[b][name].get("V")).replace("^", "**")
        if not re.fullmatch(r"[xys0-9.*+\- ()]+", text):
            return None
        h = 1e-5
        at = lambda step: eval(text, {"__builtins__": {}},  # noqa: E731  pylint: disable=eval-used
                               {**{q: values[q] for q in "xys" if q in values}, coordinate: values[coordinate] + step})
        return (at(h) - at(-h)) / (2 * h)

    def angle(self, b, values):
        """Of the frame of a body in the world, by the angles of all that it moves on."""
        if b is None:
            return 0
        motion = self.file["bodies"][b].get("motion", "")
        kind, keys = self.kind(b), next(iter(motion.values())) if isinstance(motion, dict) else {}
        keys = keys if isinstance(keys, dict) else {}
        if kind == "particle":
            return 0
        if kind in ("pivot", "planar"):
            own = values.get(f"{b}.theta")
        elif kind == "weld":
            own = self.number(keys["angle"], "rad") if "angle" in keys else 0
        else:
            own = self.along(b) if kind == "slide" else None
        below = self.angle(self.parents[b], values)
        if own is None or below is None:
            raise Unbound("angle")
        return below + own

    def surface(self, b, e, force):
        """The component away from the side of a slide that its surface pushes to: up, unless it says right."""
        entry = next((entry for entry in self.entries[b].values() if entry.kind == "normal"), None)
        side = entry.keys.get("side") if entry else None
        flipped = side == "right" or side in (None, "up") and e[0] < -1e-12
        return -cross(e, force) if flipped else cross(e, force)

    def vector(self, pair):
        found = tuple(self.number(text, "m/s") for text in pair)
        return None if None in found else found


class Arrow:
    """A force with its point, and a couple."""

    def __init__(self, force, point, couple):
        self.force, self.point, self.couple = force, point, couple

    def moment(self, about):
        return self.couple + cross((self.point[0] - about[0], self.point[1] - about[1]), self.force)


class Place:
    """All numbers of one state: arrows by body and name, coordinates and rates, masses."""

    def __init__(self, scene):
        self.scene = scene
        self.arrows, self.values, self.mass, self.axis, self.center = {}, {}, {}, {}, {}
        self.accelerations = {}  # of G, and the angular one
        self.moments = {}        # of arrows about the axis of a pivot, else about G, as the diagram has them

    def weight(self, b):
        name = next((e.name for e in self.scene.entries[b].values() if e.kind == "gravity"), None)
        return self.arrows.get((b, name))

    def law_values(self, b, name):
        """Everything that the law of a term may name."""
        scene = self.scene
        values = {n.split(".", 1)[1]: v for n, v in self.values.items() if n.startswith(b + ".")}
        values.update(scene.constants(b, name))
        weight = self.weight(b)
        if weight and self.mass.get(b):
            m = self.mass[b]
            g = (weight.force[0] / m, weight.force[1] / m)
            O, G = self.center.get((b, "O")), weight.point
            L = O and math.hypot(G[0] - O[0], G[1] - O[1])
            values.update({"L": L, f"L_{scene.bodies.index(b) + 1}": L})
            values.update({"m": m, scene.mass_name(b, m): m, "g": math.hypot(*g), "g_x": g[0], "g_y": g[1]})
            if O:
                values.update({"r_x": G[0] - O[0], "r_y": G[1] - O[1]})
        kind = scene.kind(b)
        if kind == "slide":
            values["along"] = scene.along(b)
            values.update({p: scene.number(p, "rad") for p in scene.file.get("parameters", {})
                           if p not in values and scene.number(p, "rad") is not None})
        e = self.axis.get(b)
        if "vx" in values:
            v = (values["vx"], values["vy"])
            values["v"] = v
        elif kind == "slide" and e and values.get("w"):
            values["v"] = (values["v"] * e[0], values["v"] * e[1])
        if name == "moving axis":  # a_O less what goes along OG, which has no moment: a_G - alpha k x r
            if (b, "G") not in self.center:
                raise Unbound("G")
            G, O, (a, alpha) = self.center[b, "G"], self.center[b, "O"], self.accelerations[b]
            r = (G[0] - O[0], G[1] - O[1])
            values.update({"m": self.mass[b], scene.mass_name(b, self.mass[b]): self.mass[b], "r_x": r[0], "r_y": r[1],
                           "a_Ox": a[0] + alpha * r[1], "a_Oy": a[1] - alpha * r[0]})
        values["component"] = lambda vector, axis: (
            vector[0] * e[0] + vector[1] * e[1] if kind == "slide" else vector["xy".index(axis)])
        if scene.entries[b].get(name) and scene.entries[b][name].kind == "potential":
            values.update({f"dV/d{q}": scene.slope(b, name, q, values) for q in "xys" if q in values})
        if values.get("dm") is not None:
            angle, c = values["thrust_angle"], values["exhaust"]
            u = (-c * math.cos(angle), -c * math.sin(angle)) if angle is not None else None
            values["dm/dt"] = values["dm"]
            if c is not None:
                values["u_x"] = -c if u is None else u[0] * e[0] + u[1] * e[1]
                values["u_y"] = None if u is None else u[1]
        return values


class Equation:
    def __init__(self, b, part, cut_free, about, terms):
        self.body, self.part, self.cut_free, self.about, self.terms = b, part, cut_free, about, terms


class Judge:
    """Collects what is claimed of the symbols of one scene at one place, or on its page."""

    def __init__(self, scene, general):
        self.scene, self.general = scene, general
        self.counts = Counter()
        self.uses = {}    # symbol: {(body, arrow): sign of the vector on this body}
        self.signs = {}   # symbol: of the number that it stands for
        self.kinds = {}   # symbol: is it a moment?
        self.seen = {}    # symbol: the bodies that it stands on

    def words(self, text, b):
        """The names of a term that no number of the file has, nor the body: those of its force."""
        known = {"sin", "cos", "angle", "theta", *self.scene.file.get("parameters", {})} - {"mu_k"}
        return [w for w in re.findall(r"[A-Za-z][\w.]*", re.sub(r"\[[a-z]+\]", "", text))
                if w not in known and not re.fullmatch(r"L(_[0-9]+)?", w)]

    def lengths(self, place, b):
        """What an arm or a slope is called by."""
        scene = self.scene
        values = {p: next((x for x in (scene.number(p, "m"), scene.number(p, "rad")) if x is not None), None)
                  for p in scene.file.get("parameters", {})}
        O, G = place.center.get((b, "O")), place.center.get((b, "G"))
        L = math.hypot(G[0] - O[0], G[1] - O[1]) if O and G else None
        values.update({"L": L, f"L_{scene.bodies.index(b) + 1}": L})
        return values

    def force(self, place, equation, name, text, value, label):
        """A term by the symbol of its force. By itself that is the size of the force with a sign, the same one in all equations;
        R_1x is a component of one vector, x_R1 where it acts, and M(R_1) a couple beside it."""
        b, arrow = equation.body, place.arrows[equation.body, name]
        whole = re.fullmatch(r"-?(?:M_([GO])|Q_s)\((.*)\)", text)
        if whole and not whole[1]:
            self.counts["not judged: Q_s"] += 1
            return None
        values = self.lengths(place, b)
        if re.search(r"\b(theta|angle)\b", text):
            values.update({"theta": place.values.get(f"{b}.theta"), "angle": self.scene.angle(b, place.values)})
        words = [label] if label and label in text and not re.search(rf"{re.escape(label)}\w", text) else self.words(text, b)
        words = [w for w in words if w != "M" or "M(" not in text]
        size = math.hypot(*arrow.force)
        if whole:
            symbol, vector = whole[2], True
            got = (-1 if text[0] == "-" else 1) * arrow.moment(place.center[b, equation.about])
        else:
            ends = [re.fullmatch(r"(.*_[0-9]+|.*?)_?([xys])", w) for w in words]
            at = [re.fullmatch(r"[xy]_(.*)", w) for w in words]
            vectors = {m[1] for w, m, p in zip(words, ends, at) if m and not p and self.is_component(w, label)}
            lone = [w for w, p in zip(words, at) if not p and not self.is_component(w, label)]
            if "M(" in text:
                vectors.add(re.search(r"M\(([^()]*)\)", text)[1])
                lone = [w for w in lone if w not in vectors]
                text = re.sub(r"M\([^()]*\)", "couple", text)
            vector = bool(vectors)
            symbol = vectors.pop() if vector else " ".join(dict.fromkeys(lone))
            assert not vectors and not (vector and lone), f"{text} has several symbols"
            values.update(self.parts(place, equation, arrow, symbol))
            if not vector:
                if " " in symbol:
                    self.is_product(place, b, name, symbol)
                text = re.sub(rf"(?<![\w.]){re.escape(symbol)}(?![\w.])", "size", text)
                values["size"] = abs(arrow.couple) if size == 0 else size
            got = evaluate(text, values)
        slips = label and label.startswith("mu_k ") and symbol != label
        assert not label or slips or symbol == label, f"the drawing calls it {label}, the equation {symbol}"
        self.seen.setdefault(symbol, set()).add(b)
        side = 1 if abs(got - value) <= abs(got + value) else -1
        if not vector:
            assert size == 0 or arrow.couple == 0 or equation.about is None, f"{symbol} is a force and a couple"
            if size > 0 or arrow.couple != 0:
                assert self.kinds.setdefault(symbol, size == 0) == (size == 0), f"{symbol} is a force and a moment"
        if abs(got) > 1e-6 * (abs(arrow.couple) + size + 1e-3):  # else its sign is rounding
            if vector:
                self.use(symbol, b, name, side, False)
            else:
                assert self.signs.setdefault(symbol, side) == side, f"{symbol} has two signs"
        return side * got

    def is_component(self, word, label):
        if label:
            return word != label
        return bool(re.search(r"(_|_[0-9]+)[xys]$", word))

    def parts(self, place, equation, arrow, symbol):
        """Its components, its couple, and where it acts."""
        b, line = equation.body, "" if "_" in symbol else "_"
        values = {f"{symbol}{line}{axis}": f for axis, f in zip("xy", arrow.force)}
        e = place.axis.get(b)
        values[f"{symbol}{line}s"] = e and e[0] * arrow.force[0] + e[1] * arrow.force[1]
        values["couple"] = arrow.couple
        about = place.center.get((b, equation.about))
        if about:
            values.update({f"{axis}_{symbol.replace('_', '')}": p - q for axis, p, q in zip("xy", arrow.point, about)})
        return values

    def is_product(self, place, b, name, symbol):
        """Friction that slips is mu_k N of the body's own surface."""
        owner, _, own = name.rpartition(".")
        owner = owner or b
        normal = next(e for e in self.scene.entries[owner].values() if e.kind == "normal")
        mu = self.scene.constants(owner, own)["mu_k"]
        if mu is not None:
            N = math.hypot(*place.arrows[owner, normal.name].force)
            near(mu * N, math.hypot(*place.arrows[b, name].force), N, symbol)

    def use(self, symbol, b, name, sign, moment):
        self.seen.setdefault(symbol, set()).add(b)
        known = self.uses.setdefault(symbol, {}).setdefault((b, name), sign)
        assert known == sign, f"{symbol} has both signs for {name} on {b}"
        assert self.kinds.setdefault(symbol, moment) == moment, f"{symbol} is a force and a moment"

    def term(self, place, equation, name, text, value, label, scale):
        """Hold one term against its number."""
        if not text:
            near(0, value, scale, f"no term of {name} on {equation.body}")
            return
        if text == f"({name})":
            self.counts["by its name"] += 1
            return
        entry = self.scene.entries[equation.body].get(name)
        by_law = name == "moving axis" or entry and entry.kind in LAWS and LAW.fullmatch(text.lstrip("-"))
        try:
            if by_law:
                got = evaluate(text, place.law_values(equation.body, name))
            else:
                got = self.force(place, equation, name, text, value, label)
        except Unbound as unbound:
            self.counts[f"not judged: {unbound}"] += 1
            return
        if got is None:
            return
        arms = not by_law and re.search(r"[ \[(]", re.sub(r"^-?mu_k ", "", text))
        self.counts["laws" if by_law else "symbols"] += 1
        if arms:
            self.counts["arms and slopes"] += 1
        arrow = place.arrows.get((equation.body, name))
        if arrow:  # an arm has nine digits, and a couple may take away its moment
            scale += math.hypot(*arrow.force) + abs(arrow.couple)
        near(got, value, scale, f"{text} of {name} on {equation.body}")

    def finish(self, place):
        """A symbol is one vector: its uses on all bodies agree, and on the body that it is said of it has no sign."""
        scene = self.scene
        for symbol, uses in self.uses.items():
            forces = {}
            for (b, name), sign in uses.items():
                arrow = place.arrows[b, name]
                forces[b, name] = tuple(sign * x for x in (*arrow.force, arrow.couple))
            bodies = sorted(self.seen[symbol], key=scene.bodies.index)
            corners = symbol[0] == "T" and all(sign > 0 for sign in uses.values())
            values = list(forces.values())
            scale = max(math.hypot(*a.force) + abs(a.couple) for a in place.arrows.values())
            for v in values[1:] if not corners else []:
                same = all(abs(x - y) <= 1e-6 * scale + 1e-9 for x, y in zip(v[:2], values[0][:2]))
                assert same, f"{symbol} is {values[0]} on one body and {v} on another: {list(uses)}"
            if corners:
                sizes = [math.hypot(*v[:2]) for v in values]
                assert max(sizes) - min(sizes) <= 1e-6 * scale + 1e-9, f"{symbol} has two sizes: {sizes}"
            owner = bodies[0]
            for b, name in uses:
                child = name.split(".")[0]
                if child in scene.parents and scene.parents[child] == b and child in bodies:
                    owner = child
            if not corners:
                signs = {sign for (b, _), sign in uses.items() if b == owner}
                lone = len(bodies) == 1 and any("." in name for _, name in uses)
                assert signs <= {1} or lone, f"{symbol} has a minus sign on {owner}"
        for symbol, moment in self.kinds.items():
            letter = re.sub(r"_[0-9]+$", "", symbol)
            named = letter in scene.couplings or any(letter in entries for entries in scene.entries.values())
            assert named or (letter == "M") == moment, f"{symbol} for a {'moment' if moment else 'force'}"


# ---- accelerations of G

def kinematics(scene, found, place, judge):
    """The lines of a_G, and of a_O where they name it, beside the acceleration of G."""
    known, angle_dot = {}, {}
    for e in found["equations"]:
        b, a = e["body"], e["acceleration"]
        if e["coordinate"] in ("G.x", "G.y"):
            known[f"{b}.{a['name']}"] = a["value"]
        elif e["coordinate"] == "G.angle":
            known[f"{b}.angle_ddot"] = a["value"]
        elif not scene.parents[b] and scene.kind(b) in ("slide", "pivot", "particle", "planar"):
            known[f"{b}.{a['name']}"] = a["value"]
    for b in scene.bodies:  # parents may come later
        chain, at = [], b
        while at:
            chain.append(place.values.get(f"{at}.omega", 0) if scene.kind(at) in ("pivot", "planar") else 0)
            at = scene.parents[at]
        angle_dot[f"{b}.angle_dot"] = sum(chain)
    for b, lines in found.get("kinematics", {}).items():
        if scene.kind(b) == "planar":  # its vx_dot is no number of the report
            continue
        values = {**judge.lengths(place, b), **place.values, **known, **angle_dot}
        for other in scene.bodies:
            values.update({k: v for k, v in judge.lengths(place, other).items() if k.startswith("L_")})
            try:
                values[f"{other}.angle"] = scene.angle(other, place.values)
            except Unbound:
                values[f"{other}.angle"] = None
        values.update({name.split(".", 1)[1]: v for name, v in values.items() if name.startswith(b + ".")})
        slope = scene.along(b) if scene.kind(b) == "slide" else None
        values.update({p: scene.number(p, "rad") for p in scene.file.get("parameters", {}) if slope is not None and
                       values.get(p) is None})
        for line in sorted(lines, key=lambda line: "a_O" not in line.split(" = ")[0]):
            left, right = line.split(" = ")
            try:
                got = evaluate(right, values)
            except Unbound as unbound:
                judge.counts[f"not judged: {unbound} of a_G"] += 1
                continue
            if left.startswith("a_O"):
                values[left] = got
                continue
            size = sum(abs(x) for x in values.values() if isinstance(x, float) and math.isfinite(x))
            near(got, known[f"{b}.{left}"], size, f"{left} of {b}")
            judge.counts["accelerations of G"] += 1


# ---- one state

def labels_of(svg):
    """{(body, arrow): label of its force, or of its couple}, as they are drawn."""
    found = {}
    for node in ElementTree.fromstring(svg).iter("{http://www.w3.org/2000/svg}g"):
        if not node.get("class", "").startswith("arrow"):
            continue
        title = node.find("{http://www.w3.org/2000/svg}title").text
        name, b = re.match(r"(\S+) on (\S+):", title).groups()
        text = [t.text for t in node.iter("{http://www.w3.org/2000/svg}text") if t.get("class") == "label"]
        if text:
            found.setdefault((b, name), []).append(text[0])
    return found


def axis_by_fit(equations, forces, b):
    """The direction of x of a body, from what all forces do along it: (e_x, e_y), where that tells it."""
    rows = [(forces[b][t["name"]]["fx"], forces[b][t["name"]]["fy"], t["value"]) for e in equations
            if e["body"] == b and not e["coordinate"].startswith("G.") and e["inertia"]["name"] == "m"
            and e["coordinate"] != "y" for t in e["terms"] if t["name"] in forces[b]]
    xx, xy, yy = (sum(r[i] * r[j] for r in rows) for i, j in ((0, 0), (0, 1), (1, 1)))
    px, py = (sum(r[i] * r[2] for r in rows) for i in (0, 1))
    det = xx * yy - xy * xy
    if det > 1e-9 * (xx + yy) ** 2:
        return ((yy * px - xy * py) / det, (xx * py - xy * px) / det)
    return None


def place_of(scene, found):
    place = Place(scene)
    place.values = found["coordinates"]
    equations, forces = found["equations"], found["forces"]
    for b, arrows in forces.items():
        for name, a in arrows.items():
            place.arrows[b, name] = Arrow((a["fx"], a["fy"]), (a["x"], a["y"]), a["couple"])
            place.moments[b, "O" if scene.kind(b) == "pivot" else "G", name] = a["moment"]
        place.center.update(centers(scene, b, arrows))
        kind = scene.kind(b)
        if kind == "slide" and not scene.parents[b] and scene.along(b) is not None:
            place.axis[b] = (math.cos(scene.along(b)), math.sin(scene.along(b)))
        elif kind in ("particle", "planar") and not scene.parents[b]:
            place.axis[b] = (1, 0)
        else:
            place.axis[b] = axis_by_fit(equations, forces, b)
    for e in equations:
        a = place.accelerations.setdefault(e["body"], ([0, 0], 0))
        if e["coordinate"] == "G.x":
            place.mass[e["body"]] = e["inertia"]["value"]
        if e["coordinate"] in ("G.x", "G.y"):
            a[0]["xy".index(e["coordinate"][-1])] = e["acceleration"]["value"]
        if e["coordinate"] == "G.angle":
            place.accelerations[e["body"]] = (a[0], e["acceleration"]["value"])
    return place


def centers(scene, b, arrows):
    """The axis O, where the force of a pin acts, and G, where the weight does."""
    found = {}
    for name, a in arrows.items():
        if name == "pin" and scene.kind(b) == "pivot":
            found[b, "O"] = (a["x"], a["y"])
        if scene.entries[b].get(name) and scene.entries[b][name].kind == "gravity":
            found[b, "G"] = (a["x"], a["y"])
    return found


def lines_of(report):
    """{body: lines} of the bodies cut free, as the report has them; and {body: symbols of forces that are zero now}."""
    found, idle, b = {}, {}, None
    for line in report.partition("\nCut free, in symbols at this time\n")[2].splitlines():
        if line[:4] != "    ":
            b = line.strip()
        elif IDLE.fullmatch(line.strip()):
            idle.setdefault(b, []).extend(IDLE.fullmatch(line.strip())[1].split(" = ")[:-1])
        else:
            found.setdefault(b, []).append(line.strip())
    return found, idle


def judge_idle(found, b, symbol):
    """A force that is said to be zero now stands in an equation of the body, and is zero."""
    word = re.compile(rf"(?<![\w.]){re.escape(symbol)}(_?[xy])?(?![\w.])")
    terms = [t for e in found["equations"] if e["body"] == b for t in e["terms"] if word.search(t.get("symbol", ""))]
    assert terms, f"{symbol} of {b} is in no equation"
    assert all(t["value"] == 0 for t in terms), f"{symbol} of {b} is not zero"


def judge_state(scene, model):
    """Report, JSON, LaTeX and drawing of a state. Returns (counts)."""
    found = model.equations()
    place, judge = place_of(scene, found), Judge(scene, False)
    labels = labels_of(model.svg())
    report, plain = model.report(), {}
    lines = {name: f"{from_latex(left)} = {from_latex(right)}" for name, left, right in
             re.findall(r"^% (\S+)\n\\begin\{align\*\}\n(.*?) &= (.*?) \\\\$", model.latex(), re.MULTILINE)}
    for e in found["equations"]:
        if "symbols" in e:
            plain.setdefault(e["body"], []).append(e["symbols"])
            assert lines.pop(f"{e['body']}.{e['coordinate']}") == e["symbols"], "LaTeX and JSON differ"
    assert not lines, f"LaTeX has {lines} besides"
    for e in found["equations"]:
        b, coordinate = e["body"], e["coordinate"]
        cut_free = coordinate.startswith("G.")
        turns = e["inertia"]["name"] != "m"
        part = {"x": 0, "y": 1, "s": 0}.get(coordinate.rsplit(".", maxsplit=1)[-1], 2 if turns else 0)
        about = e["inertia"]["name"][-1] if turns else None
        equation = Equation(b, part, cut_free, about, e["terms"])
        scale = max((abs(t["value"]) for t in e["terms"]), default=0)
        for term in e["terms"]:
            if term.get("remark"):
                remark(judge, place, equation, term)
                assert re.search(rf"^    {re.escape(term['name'])} .* {re.escape(term['remark'])}$", report, re.MULTILINE), \
                    f"the report has another remark than {term['remark']}"
        wanted = is_written(scene, place, b, coordinate)
        if scene.kind(b) == "planar" and (b, "G") not in place.center:  # is its frame at G?
            wanted = "symbols" in e
        if "symbols" not in e:
            assert not wanted or e["inertia"]["value"] == 0, f"{b}.{coordinate} has no line"
            continue
        assert wanted, f"{b}.{coordinate} says what other lines say"
        index = f"{scene.bodies.index(b) + 1}" if len(scene.bodies) > 1 else ""
        inertia = e["inertia"]["name"] + index if turns else scene.mass_name(b, e["inertia"]["value"])
        whole = " + ".join(t["symbol"] for t in e["terms"] if t["symbol"]).replace("+ -", "- ")
        names = ["omega_dot", "angle_ddot"] if e["acceleration"]["name"] == "alpha" else [e["acceleration"]["name"]]
        massless = all(one["inertia"]["value"] == 0 for one in found["equations"] if one["body"] == b)
        left = ["0"] if massless else [f"{inertia} {a}" for a in names]
        assert e["symbols"] in [f"{one} = {whole or 0}" for one in left], f"{e['symbols']!r} for {whole!r}"
        for term in e["terms"]:
            label = label_for(labels, b, term["name"], term["symbol"])
            judge.term(place, equation, term["name"], term["symbol"], term["value"], label, scale)
            judge.counts["lines"] += 1
    judge.finish(place)
    kinematics(scene, found, place, judge)
    latex = re.sub(r" \\\\$", "", model.latex(), flags=re.MULTILINE)
    for b, lines in found.get("kinematics", {}).items():
        plain[b] += lines
        for line in lines:
            left, right = line.split(" = ")
            assert any(from_latex(p) == left and from_latex(q) == right for p, _, q in (
                x.partition(" &= ") for x in latex.splitlines())), f"LaTeX lacks {line}"
    reported, idle = lines_of(report)
    for b, symbols in idle.items():
        for symbol in symbols:
            judge_idle(found, b, symbol)
            judge.counts["zero now"] += 1
    assert {b: sorted(lines) for b, lines in reported.items()} == {b: sorted(lines) for b, lines in plain.items()}, \
        "report and JSON differ"
    for (b, name), texts in labels.items():
        arrow = place.arrows[b, name]
        if len(texts) > 1:
            assert texts[1] == f"M({texts[0]})", texts
        elif arrow.couple != 0 and math.hypot(*arrow.force) == 0:
            named = name in texts[0] or texts[0].startswith("M")
            assert named, f"a moment is labelled {texts[0]}"
    return judge.counts


def is_written(scene, place, b, coordinate):
    """The equations of the coordinates of a body on the ground, and of forces along x and y and moments about G those that are
    none of these."""
    kind, ground = scene.kind(b), not scene.parents[b]
    axis, G = place.axis[b], place.center.get((b, "G"))
    frame = (place.values.get(f"{b}.x"), place.values.get(f"{b}.y"))
    off_center = kind == "planar" and G and math.dist(G, frame) > 1e-9
    ground = ground and kind not in ("weld", "") and not off_center
    if not coordinate.startswith("G."):
        return ground
    if not ground:
        return True
    own = {"pivot": ["G.angle"], "planar": ["G.x", "G.y", "G.angle"], "particle": ["G.x", "G.y"], "track": []}
    lies = ["G.x"] if axis and abs(axis[1]) < 1e-12 else ["G.y"] if axis and abs(axis[0]) < 1e-12 else []
    return coordinate not in own.get(kind, lies)


def label_for(labels, b, name, text):
    """The symbol of the arrow as the drawing labels it, in the writing of the equation; None where it is not drawn, or the
    term has another one."""
    drawn = labels.get((b, name))
    if not drawn:
        return None
    words = re.findall(r"[A-Za-z][\w.]*", text)
    candidates = [*words, *(re.sub(r"_?[xys]$", "", w) for w in words), *(" ".join(words[i:i + 2]) for i in range(len(words)))]
    wanted = re.sub(r"^M\((.*)\)$", r"\1", drawn[0])
    return next((c for c in candidates if c and printed(c) == wanted), None)


def remark(judge, place, equation, term):
    """Beside a term of the report: words, or a formula that is true."""
    text, name, value, scale = term["remark"], term["name"], term["value"], abs(term["value"])
    b = equation.body
    normal, sticks, slips = NORMAL.fullmatch(text), STICKS.fullmatch(text), SLIPS.fullmatch(text)
    if WORDS.fullmatch(text):
        judge.counts["words"] += 1
        if text in ("through the axis", "acts across"):
            near(0, value, 1, text)
        return
    surface = next((place.arrows[b, e.name] for e in judge.scene.entries[b].values() if e.kind == "normal"), None)
    try:
        values = place.law_values(b, name)
        if surface:
            values["N"] = math.hypot(*surface.force)
        if normal:
            across = abs(float(normal[1]))  # the force of a curve that turns its body is not all across it
            if judge.scene.turns_along(b):
                assert across <= values["N"] * (1 + 1e-6)
            else:
                near(across, values["N"], values["N"], text)
            values["N"] = across
        elif sticks:
            if not judge.scene.turns_along(b):
                near(evaluate(sticks[1], values), float(sticks[2]), 1, text)
            assert abs(value) <= float(sticks[2]) * (1 + 1e-6) + 1e-9, f"{text} for {value}"
        elif slips and judge.scene.turns_along(b):
            assert (slips[1][0] == "-") == (value < 0), text
        else:
            near(evaluate(slips[1] if slips else text, values), value, scale, f"{text} of {name} on {b}")
        judge.counts["remarks"] += 1
    except Unbound as unbound:
        judge.counts[f"not judged: {unbound} in a remark"] += 1


# ---- the page

def place_on_page(scene, page, row):
    place = Place(scene)
    cell = lambda index: page.cell(index, row)  # noqa: E731
    found = {b["name"]: b for b in page.data["bodies"]}
    for b, body in found.items():
        for index in (*body["coordinates"], *body["rates"]):
            place.values[page.data["columns"][index]["n"]] = cell(index)
        frame, parent = [cell(i) for i in body["frame"]], body["parent"]
        for arrow in body["arrows"]:
            x = [cell(index) for index in arrow["arrow"]]
            place.arrows[b, arrow["name"]] = Arrow(tuple(x[:2]), moved(frame, x[2:4]), x[4])
        angle = cell(page.data["bodies"][parent]["frame"][2]) if parent >= 0 else 0
        if body["motion"] == "slide":
            e = body["line"]["along"]
            place.axis[b] = turned(e, angle)
        elif body["motion"] in ("particle", "planar"):
            place.axis[b] = turned((1, 0), angle)
        elif body["motion"] == "track" and parent < 0:
            v, velocity = cell(body["rates"][0]), [cell(i) for i in body["velocity"]]
            place.axis[b] = (velocity[0] / v, velocity[1] / v) if abs(v) > 1e-3 else None
        place.center[b, "G"] = moved(frame, body["G"])
        if body["motion"] == "pivot":
            place.center[b, "O"] = tuple(frame[:2])
        for e in body["equations"]:
            a = place.accelerations.setdefault(b, ([0, 0], 0))
            if e["name"].endswith((".G.x", ".G.y")):
                a[0]["xy".index(e["name"][-1])] = cell(e["acceleration"])
            if e["name"].endswith(".G.angle"):
                place.accelerations[b] = (a[0], cell(e["acceleration"]))
            if e["inertia"] == "m":
                place.mass[b] = e["value"] * (cell(e["mass"]) / e["massAtStart"] if "mass" in e else 1)
    return place


def turned(v, angle):
    c, s = math.cos(angle), math.sin(angle)
    return (c * v[0] - s * v[1], s * v[0] + c * v[1])


def moved(frame, point):
    return tuple(p + q for p, q in zip(frame, turned(point, frame[2])))


def judge_page(scene, page, rows):
    counts = Counter()
    for row in rows:
        place, judge = place_on_page(scene, page, row), Judge(scene, True)
        for body in page.data["bodies"]:
            b = body["name"]
            for e in body["equations"]:
                name = e["name"].rsplit(".", maxsplit=1)[-1]
                turns = e["inertia"] != "m"
                part = {"x": 0, "y": 1, "s": 0}.get(name, 2 if turns else 0)
                cut_free = ".G." in e["name"]
                equation = Equation(b, part, cut_free, e["inertia"][-1] if turns else None, e["terms"])
                values = [page.cell(column, row) for _, column, _ in e["terms"]]
                scale = 1 + max(map(abs, values), default=0)
                if not any(symbol for _, _, symbol in e["terms"]):
                    continue
                for (term, _, symbol), value in zip(e["terms"], values):
                    if term != "turning along":
                        judge.term(place, equation, term, symbol, value, None, scale)
        judge.finish(place)
        counts.update({f"page {k}": n for k, n in judge.counts.items()})
    return counts
