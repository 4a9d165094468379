# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes that are rich in events: contacts, dry friction, ropes, stops and switches. The same seed gives the
same text on every machine; the smooth ones are those of tests/cross."""
import random


class Draw(random.Random):
    def number(self, low, high):
        return round(self.uniform(low, high), 3)

    def maybe(self, chance):
        return self.random() < chance


def scene(bodies, contacts=(), couplings=(), ground="", until=2):
    text = ["fbd: 1", *([ground] if ground else []), "bodies:", *bodies]
    for key, entries in (("contacts", contacts), ("couplings", couplings)):
        if entries:
            text += [f"{key}:", *(f"  - {{{entry}}}" for entry in entries)]
    return "\n".join([*text, f"simulate: {{until: {until} s}}", ""])


def body(name, motion, mass, initial, forces, more=""):
    return f"  {name}: {{mass: {mass}, motion: {motion}, {more}initial: {{{initial}}}, forces: [{', '.join(forces)}]}}"


def push(draw, size):
    return f'applied: {{name: push, value: "{draw.number(0, size)}*sin({draw.number(0.5, 12)}*t)", angle: {draw.number(-3, 3)}}}'


def shape(draw):
    return draw.choice([f"shape: disc, radius: {draw.number(0.05, 0.2)}, ",
                        f"shape: prism, a: {draw.number(0.1, 0.4)}, b: {draw.number(0.1, 0.4)}, ",
                        f"shape: rod, length: {draw.number(0.2, 0.6)}, "])


def law(draw):
    words = f"restitution: {draw.choice([0, draw.number(0, 1)])}"
    if draw.maybe(0.7):
        mu = draw.number(0.05, 0.8)
        words += f", static: {mu}, kinetic: {round(draw.choice([1, draw.uniform(0.5, 1)]) * mu, 4)}"
    return words


def falling(draw):
    """One to three bodies fall onto a floor that may be inclined, and onto each other."""
    count = draw.randint(1, 3)
    bodies = [body(f"b{i}", "planar", draw.number(0.2, 3),
                   f"x: {draw.number(-0.3, 0.3)}, y: {round(0.5 + 0.9 * i + draw.uniform(0, 0.2), 3)}, "
                   f"theta: {draw.number(-3, 3)}, vx: {draw.number(-1, 1)}, omega: {draw.choice([0, draw.number(-5, 5)])}",
                   ["gravity", *([push(draw, 2)] if draw.maybe(0.2) else [])], shape(draw)) for i in range(count)]
    contacts = [f"between: [b{i}, ground.floor], {law(draw)}" for i in range(count)]
    contacts += [f"between: [b{i}, b{i + 1}], {law(draw)}" for i in range(count - 1)]
    along = draw.choice([0, draw.number(-0.4, 0.4)])
    return scene(bodies, contacts, ground=f"ground: {{lines: {{floor: {{along: {along}}}}}}}", until=draw.number(0.3, 1.5))


def belt(draw):
    """A block at a spring on a belt: it sticks and slips."""
    mu = draw.number(0.1, 0.8)
    forces = ["gravity", "normal", f"friction: {{static: {mu}, kinetic: {round(mu * draw.uniform(0.5, 1), 4)}, "
              f"surface_speed: {draw.number(-0.5, 0.5)}}}", f"spring: {{stiffness: {draw.number(5, 200)}}}"]
    if draw.maybe(0.4):
        forces.append(f"damper: {{coefficient: {draw.number(0, 1)}}}")
    if draw.maybe(0.4):
        forces.append(push(draw, 5))
    return scene([body("block", "slide", draw.number(0.5, 3), f"v: {draw.number(-1, 1)}", forces)], until=4)


def switches(draw):
    """A block that a square wave pushes over dry friction."""
    mu = draw.number(0, 0.4)
    forces = ["gravity", "normal", f"friction: {mu}",
              f'applied: {{name: wave, value: "{draw.number(1, 20)}*square(t/{draw.number(0.2, 1.5)})"}}']
    if draw.maybe(0.5):
        forces.append(f"spring: {{stiffness: {draw.number(1, 50)}}}")
    return scene([body("block", f"{{slide: {{along: {draw.number(-0.5, 0.5)}}}}}", 1, "v: 0", forces)], until=4)


def stops(draw):
    """A slide or a pendulum between stops."""
    low, high = draw.number(-0.8, -0.1), draw.number(0.1, 0.8)
    limits = f"min: {low}, max: {high}, restitution: {draw.choice([0, draw.number(0.1, 0.9)])}"
    if draw.maybe(0.5):
        motion, more, initial = f"{{slide: {{along: {draw.number(-1.5, 1.5)}, {limits}}}}}", "", f"v: {draw.number(-3, 3)}"
    else:
        motion = f"{{pivot: {{at: [0, 0], {limits}}}}}"
        more, initial = "shape: point, center: [0, -1], ", f"omega: {draw.number(-5, 5)}"
    return scene([body("b", motion, draw.number(0.5, 2), initial, ["gravity", push(draw, 8)], more)], until=3)


def ropes(draw):
    """Two weights on a rope over a pulley, one of them over dry friction; the rope may be slack."""
    mu = draw.number(0, 0.5)
    along = draw.number(0, 0.7)
    slack = draw.maybe(0.3)
    block = body("block", f"{{slide: {{along: {along}, through: [-5, 0]}}}}", draw.number(0.5, 3),
                 f"x: 0, v: {draw.number(-1, 1) if slack else 0}",
                 ["gravity", "normal", f"friction: {mu}", *([push(draw, 20)] if draw.maybe(0.4) else [])])
    weight = body("weight", "{slide: {along: -1.5707963267948966, through: [1, -1]}}", draw.number(0.5, 3), "x: 0",
                  ["gravity"])
    length = ", length: 8" if slack else ""
    return scene([block, weight], couplings=[f"rope: {{name: cord, through: [block.G, ground.P, weight.G]{length}}}"],
                 ground="ground: {points: {P: [0, 1]}}", until=1)


def pendulums(draw):
    """A row of pendulums that hit each other or a wall."""
    count, r = draw.randint(1, 4), 0.05
    bodies = [body(f"b{i}", f"{{pivot: {{at: [{round(2.1 * r * i, 4)}, 0], point: [0, 0.4]}}}}", draw.number(0.1, 1),
                   f"theta: {draw.number(-1.2, -0.2) if i == 0 else 0}", ["gravity"], f"shape: sphere, radius: {r}, ")
              for i in range(count)]
    contacts = [f"between: [b{i}, b{i + 1}], restitution: {draw.number(0, 1)}" for i in range(count - 1)]
    contacts.append(f"between: [b{count - 1}, ground.wall], restitution: {draw.number(0, 1)}")
    wall = round(2.1 * r * (count - 1) + r + draw.uniform(0, 0.2), 4)
    return scene(bodies, contacts, ground=f"ground: {{lines: {{wall: {{through: [{wall}, 0], along: 1.5707963267948966}}}}}}",
                 until=1)


KINDS = [falling, falling, belt, switches, stops, ropes, pendulums]


def write(folder, first, count):
    """Scenes FIRST, FIRST + 1, ... as files below folder."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = []
    for seed in range(first, first + count):
        draw = Draw(seed)
        kind = draw.choice(KINDS)
        path = folder / f"{kind.__name__}_{seed}.yaml"
        path.write_text(kind(draw), encoding="utf-8")
        paths.append(path)
    return paths
