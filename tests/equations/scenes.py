# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes for symbols: gravity of any direction, axes at any angle, bodies on bodies, and all that acts on them."""
import math

import yaml

DIRECTIONS = (0, 90, -90, 180, 270, 30, 150, -30, -150)


class Builder:
    def __init__(self, random):
        self.random, self.bodies, self.couplings, self.contacts, self.lines = random, {}, [], [], {}
        self.points = {"nail": [self.size(), self.size()]}

    def size(self, low=0.2, high=2.0):
        return round(self.random.choice((-1, 1)) * self.random.uniform(low, high), 3)

    def positive(self, low=0.2, high=3.0):
        return round(self.random.uniform(low, high), 3)

    def angle(self):
        return f"{self.random.choice((*DIRECTIONS, round(self.random.uniform(-180, 180), 2)))} deg"

    def perhaps(self, share=0.5):
        return self.random.random() < share

    def gravity(self):
        kind, g = self.random.randrange(8), self.positive(3, 12)
        return [None, g, [0, g], [0, -g], [g, 0], [-g, 0], [self.size(1, 9), self.size(1, 9)], None][kind]

    # ---- what acts

    def applied(self, name, slide):
        kinds = [{"value": self.size(), "angle": self.angle()}, {"fx": self.size()}, {"fy": self.size()},
                 {"fx": self.size(), "fy": self.size()}]
        if slide:
            kinds += [{"value": self.size()}] * 3
        return {"applied": {"name": name, **self.random.choice(kinds)}}

    def drag(self):
        keys = {key: self.positive(0.1, 1) for key in ("linear", "quadratic") if self.perhaps()} or {"linear": 0.3}
        return {"drag": {**keys, **({"wind": [self.size(), self.size()]} if self.perhaps(0.4) else {})}}

    def link(self, kind):
        if kind == "spring":
            return {"spring": {"name": "cable", "stiffness": self.positive(1, 20), "to": "nail", "free_length": self.positive()}}
        return {"damper": {"name": "strut", "coefficient": self.positive(), "to": "nail"}}

    def forces(self, kind, carried):
        found = ["gravity"] if self.perhaps(0.9) else []
        slide = kind == "slide"
        for i in range(self.random.randrange(3)):
            found.append(self.applied(f"push{i}" if self.perhaps() else f"pull{i}", slide))
        if self.perhaps(0.3):
            found.append(self.drag())
        if self.perhaps(0.25):
            found.append(self.link(self.random.choice(("spring", "damper"))))
        if slide and self.perhaps(0.3):
            found.append({"spring": {"stiffness": self.positive(1, 20), "neutral": self.size()}})
        if slide and self.perhaps(0.3):
            found.append({"damper": {"coefficient": self.positive()}})
        if slide and self.perhaps(0.15) and not carried:
            found.append({"power": {"value": self.positive()}})
        if slide and self.perhaps(0.2):
            found.append({"potential": {"name": "hill", "V": f"{self.size()}*x^3 + {self.size()}*x"}})
        if kind == "particle" and self.perhaps(0.2):
            found.append({"potential": {"name": "well", "V": f"{self.positive()}*x^2 + {self.positive()}*x*y"}})
        return found

    def friction(self):
        limit = self.positive(0.05, 0.6)
        return {"friction": {"static": round(1.3 * limit, 3), "kinetic": limit}}

    def moments(self):
        found = []
        for key, keys in (("spring", {"stiffness": self.positive(1, 20), "neutral": f"{self.size()} rad"}),
                          ("damper", {"coefficient": self.positive()})):
            if self.perhaps(0.35):
                found.append({key: keys})
        if self.perhaps(0.35):
            found.append({"applied": {"name": "twist", "value": self.size()}})
        if self.perhaps(0.25):
            found.append(self.friction())
        return found

    # ---- bodies

    def body(self, on=None):
        name = f"b{len(self.bodies)}"
        kinds = ["slide", "slide", "slide", "pivot", "pivot", "pivot"] + ([] if on else ["particle", "planar", "track"]) + (["weld"] if on else [])
        kind = self.random.choice(kinds)
        body = {"mass": self.positive()}
        place = {"on": on} if on else {}
        initial = {}
        if kind in ("pivot", "planar", "weld"):
            body["inertia"] = self.positive()
            center = self.random.choice(([self.size(), 0], [0, self.size()], [self.size(), self.size()], [0, 0]))
            body["center"] = center
            body["points"] = {"P": [self.size(), self.size()], "Q": [self.size(), self.size()]}
        body["forces"] = self.forces(kind, on is not None)
        if kind in ("slide", "particle") and not on and self.perhaps(0.15):
            body["mass"] = f"{self.positive(2, 3)}[kg] - {self.positive(0.1, 0.5)}[kg/s]*t"
            angle = {} if kind == "slide" and self.perhaps() else {"angle": self.angle()}
            body["forces"].append({"thrust": {"exhaust": self.positive(), **angle}})
        if kind == "slide":
            keys = {**place, "along": self.angle(), "through": [self.size(), self.size()]}
            if self.perhaps():
                body["forces"].append({"normal": {"two_sided": True}})
                if self.perhaps(0.7):
                    body["forces"].append(self.friction())
            initial = {"x": self.size(), "v": self.size()}
            if self.perhaps(0.15) and not any("friction" in f or "power" in f for f in body["forces"]):
                keys["x"], initial = f"{self.size()} + {self.size()}*sin(3[rad/s]*t)", {}
        elif kind == "pivot":
            body["moments"] = self.moments()
            keys = {**place, "at": [self.size(), self.size()], "point": [0, 0]}
            initial = {"theta": f"{self.size(0, 3)} rad", "omega": self.size()}
            if self.perhaps(0.15) and not any("friction" in m for m in body["moments"]):
                keys["theta"], initial = f"{self.size()} + {self.size()}*sin(2[rad/s]*t)", {}
        elif kind == "track":
            keys = {**place, "x": "p*1[m]", "y": f"{self.size()}*p^2*1[m]", "from": -40, "to": 40}
            body["forces"] = [f for f in body["forces"] if f == "gravity" or "applied" not in f and "spring" not in f]
            initial = {"p": self.size(), "v": self.size()}
        elif kind == "weld":
            keys = {**place, "at": [self.size(), self.size()], "angle": self.angle()}
        else:
            keys = {}
            if kind == "planar":
                body["moments"] = [m for m in self.moments() if "friction" not in m]
            initial = {"x": self.size(), "y": self.size(), "vx": self.size(), "vy": self.size()}
            if kind == "planar":
                initial.update({"theta": f"{self.size(0, 3)} rad", "omega": self.size()})
        body["motion"] = {kind: keys} if keys else kind
        if initial:
            body["initial"] = initial
        if not body["forces"]:
            del body["forces"]
        self.bodies[name] = body
        return name, kind

    # ---- couplings

    def couple(self, kinds):
        names = list(kinds)
        a, b = self.random.sample(names, 2) if len(names) > 1 else (names[0], None)
        choice = self.random.randrange(6)
        if choice >= 2:  # at rest, so that it fits
            for body in self.bodies.values():
                rates = body.get("initial", {})
                body["initial"] = {key: value for key, value in rates.items() if key not in ("v", "vx", "vy", "omega")}
                motion = body["motion"]
                keys = next(iter(motion.values())) if isinstance(motion, dict) else {}
                for key in ("x", "theta"):
                    if "sin" in str(keys.get(key, "")):
                        del keys[key]
        if b and choice == 0:
            self.couplings.append({"spring": {"name": "bond", "between": [f"{a}.G", f"{b}.G"], "stiffness": self.positive(1, 9), "free_length": self.positive()}})
        elif b and choice == 1:
            self.couplings.append({"damper": {"name": "dash", "between": [f"{a}.G", f"{b}.G"], "coefficient": self.positive()}})
        elif b and choice == 2:
            self.couplings.append({"rope": {"name": "cord", "through": [f"{a}.G", "ground.nail", f"{b}.G"]}})
        elif choice == 3:
            self.couplings.append({"rod": {"name": "bar", "between": [f"{a}.G", f"{b}.G" if b and self.perhaps() else "ground.nail"]}})
        elif b and choice == 4:
            self.couplings.append({"rope": {"name": "cord", "through": [f"{a}.G", f"{b}.G"]}})

    def rolling(self):
        """A disc on a slope, by a roll or a contact; a box on two corners."""
        slope, radius = self.random.uniform(-0.5, 0.5), self.positive(0.1, 0.5)
        self.lines["slope"] = {"along": f"{slope} rad"}
        body = {"mass": self.positive(), "motion": "planar", "forces": ["gravity", *([self.applied("push", False)] if self.perhaps() else [])]}
        normal = (-math.sin(slope), math.cos(slope))
        along, v = self.size(), self.size()
        if self.perhaps(0.6):
            body.update({"shape": "disc", "radius": radius})
            body["initial"] = {"x": along * normal[1] + radius * normal[0], "y": -along * normal[0] + radius * normal[1],
                               "vx": v * normal[1], "vy": -v * normal[0], "omega": -v / radius}
            law = {"static": 0.4, "kinetic": 0.3} if self.perhaps() else {}
            if self.perhaps():
                self.couplings.append({"roll": {"name": "tread", "body": "disc", "on": "slope", **law}})
            else:
                self.contacts.append({"name": "touch", "between": ["disc", "ground.slope"], **law})
            self.bodies["disc"] = body
            return
        body.update({"shape": "prism", "a": 0.8, "b": 0.4, "c": 0.3})
        body["initial"] = {"x": along * normal[1] + 0.2 * normal[0], "y": -along * normal[0] + 0.2 * normal[1], "theta": f"{slope} rad"}
        self.contacts.append({"name": "foot", "between": ["box", "ground.slope"], "static": 0.9, "kinetic": 0.3})
        self.bodies["box"] = body

    def wheels(self):
        """Two discs that turn, joined by gear or belt."""
        r, R = self.positive(0.1, 0.3), self.positive(0.2, 0.5)
        kind = self.random.choice(("gear", "belt"))
        angle = self.random.uniform(-3, 3)
        d = r + R if kind == "gear" else 1.5
        omega = self.size()
        for name, radius, at, rate in (("small", r, [0, 0], omega), ("large", R, [d * math.cos(angle), d * math.sin(angle)],
                                                                    omega * r / R * (-1 if kind == "gear" else 1))):
            self.bodies[name] = {"mass": self.positive(), "shape": "disc", "radius": radius, "forces": ["gravity"],
                                 "motion": {"pivot": {"at": at}}, "initial": {"omega": rate}, "moments": self.moments()}
        keys = {"name": "mesh", "between": ["small", "large"]}
        if kind == "belt":
            keys["tension"] = self.positive(20, 60)
        self.couplings.append({kind: keys})


def random_scene(random):
    """The text of a scene."""
    build = Builder(random)
    gravity = build.gravity()
    special = random.randrange(8)
    kinds = {}
    if special == 0:
        build.rolling()
        gravity = [round(random.uniform(-2, 2), 2), -9.81]
    elif special == 1:
        build.wheels()
    if special > 1 or build.perhaps(0.4):
        for _ in range(random.choice((1, 1, 2, 3))):
            on = None
            carriers = [n for n, kind in kinds.items() if kind in ("slide", "pivot", "planar")]
            if carriers and build.perhaps(0.6):
                on = random.choice(carriers)
            name, kind = build.body(on)
            kinds[name] = kind
        if build.perhaps(0.4):
            build.couple(kinds)
    scene = {"fbd": 1}
    if gravity is not None:
        scene["gravity"] = gravity
    scene["ground"] = {"points": build.points, **({"lines": build.lines} if build.lines else {})}
    scene["bodies"] = build.bodies
    if build.couplings:
        scene["couplings"] = build.couplings
    if build.contacts:
        scene["contacts"] = build.contacts
    scene["simulate"] = {"until": "0.2 s"}
    return yaml.safe_dump(scene, sort_keys=False, default_flow_style=None, width=200)
