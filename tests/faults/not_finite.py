#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes with a number that is not finite somewhere, or soon, put to every question of every program.

A source (1/0, the logarithm of 0, the root of a negative number, what is beyond all numbers, points that
coincide) takes a random slot of a random scene. Whatever is asked: it ends with 0, and then no number that is
written is nan or inf; or it ends with another code, and then a message names something of the scene.

    not_finite.py [SCENES [SEED]]     a failing scene is printed with the seed that makes it
"""
import base64
import json
import os
import random
import re
import struct
import sys
import tempfile
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / "page"), str(SOURCE / "tests" / "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, finish  # pylint: disable=wrong-import-position

PROGRAMS = Path(os.environ["FBD_RUN"]).parent
ODD = re.compile(r"(?<![A-Za-z0-9_.+/])[-+]?(nan|inf|infinity)(?![A-Za-z0-9_+/=])", re.IGNORECASE)
BAD_TIME = 5  # s of processor time; of what takes longer nothing is claimed
DRIVEN = 0.15

QUESTIONS = [
    ["fbd-run"],
    ["fbd-run", "--quiet", "--ledger", "--csv", "OUT"],
    ["fbd-run", "--quiet", "--json", "OUT"],
    ["fbd-run", "--quiet", "--html", "OUT"],
    ["fbd-run", "--error-bars", "--ledger", "--csv", "OUT"],
    ["fbd-run", "--quiet", "--gnuplot", "OUT"],
    ["fbd-run", "--quiet", "--step", "0.01", "--method", "rk4", "--csv", "OUT"],
    ["fbd-run", "--method", "rodas5p"],
    ["fbd-run", "--check"],
    ["fbd-run", "--equations"],
    ["fbd-run", "--equations", "--at", "0.05"],
    ["fbd-run", "--svg", "OUT", "--equations"],
    ["fbd-run", "--svg", "OUT", "--at", "0.05"],
    ["fbd-run", "--static"],
    ["fbd-run", "--static", "--quiet", "--json", "OUT"],
    ["fbd-run", "--static", "--settle"],
    ["fbd-run", "--linearize", "--svg", "OUT"],
    ["fbd-run", "--linearize"],
    ["fbd-sweep", "--jobs", "1", "--quiet", "--vary", "k=1:2:2", "--output", "final,energy,times"],
    ["fbd-cost", "--budget", "0.01", "--methods", "dop853,rk4", "--csv", "OUT"],
    ["fbd-cost", "--budget", "0.01", "--effects", "--json", "OUT"],
]


class Scene:
    """A scene as text; `odd` is the slot that gets the source."""

    def __init__(self, rng):
        self.rng = rng
        self.slots = 0
        self.odd = -1
        self.bodies = []
        self.couplings = []

    def number(self, value, unit):
        """A constant; the odd one is huge, tiny or an overflow by a parameter."""
        self.slots += 1
        if self.slots != self.odd:
            return f"{value:.4g} {unit}"
        return f"{self.rng.choice(['1e308', '1e300', '1e200', '1e155', '1e-300', '1e-308', '1e-160'])} {unit}"

    def expression(self, value, unit, coordinates):
        """What may vary with time, place and rate."""
        rng = self.rng
        self.slots += 1
        variables = ["t/1[s]"] + [f"{name}/1[{of}]" for name, of in coordinates]
        u = rng.choice(variables)
        if self.slots != self.odd:
            shape = rng.choice(["{v}[{unit}]", "{v}[{unit}]*sin({u})", "{v}[{unit}]*cos({u})"])
            return '"' + shape.format(v=f"{value:.4g}", unit=unit, u=u) + '"'
        shape = rng.choice([
            "1[{unit}]/({u})", "-1[{unit}]/({u})", "1[{unit}]/({u})^2", "-2[{unit}]/({u})^2",
            "1[{unit}]*log({u})", "1[{unit}]*sqrt({u})", "1[{unit}]*sqrt(-1 - ({u})^2)",
            "1[{unit}]*log(0.05 - {u})", "1[{unit}]*sqrt(0.05 - {u})", "1[{unit}]/(0.05 - {u})",
            "1[{unit}]*exp(1000 + {u})", "1[{unit}]*exp(1e4*({u}))", "1e308[{unit}]*(1e3 + {u})",
            "1[{unit}]*({u})^-3", "({u})/({u})*1[{unit}]", "1[{unit}]*acos(2 + {u})", "1[{unit}]*tan({u})",
            "1[{unit}]*log(({u})^2)", "0[{unit}]/({u})", "1[{unit}]*abs({u})^0.5", "1[{unit}]*({u})^0.5",
        ])
        return '"' + shape.format(unit=unit, u=u) + '"'

    def initial(self, names):
        parts = []
        for name, unit in names:
            self.slots += 1
            value = self.rng.choice([0, 0, 0.5, 1, -0.7])
            if self.slots == self.odd:
                value = self.rng.choice([1e308, -1e308, 1e200, 1e155, 1e-308])
            parts.append(f"{name}: {value:g} {unit}")
        return "{" + ", ".join(parts) + "}"

    def body(self, index):
        rng = self.rng
        name = "abcd"[index]
        motion = rng.choice(["slide", "pivot", "particle", "planar"])
        on = rng.choice([None, None] + [b for b, m in self.bodies if m != "gone"]) if self.bodies else None
        lines = [f"  {name}:", f"    mass: {self.number(rng.uniform(0.5, 3), 'kg')}"]
        if motion in ("pivot", "planar"):
            lines.append(f"    shape: rod\n    length: {self.number(rng.uniform(0.3, 1), 'm')}")
        keys = [f"on: {on}"] if on else []
        if motion == "slide":
            keys.append(f"along: {rng.choice([0, 20, -40, 90])} deg")
        if motion == "pivot":
            keys.append("point: left" if not on or rng.random() < 0.5 else f"at: [0.{index}, 0.2]")
        driven = motion in ("slide", "pivot") and rng.random() < DRIVEN
        coordinates = {"slide": [("x", "m"), ("v", "m/s")], "pivot": [("theta", "rad"), ("omega", "rad/s")],
                       "particle": [("x", "m"), ("y", "m"), ("vx", "m/s"), ("vy", "m/s")],
                       "planar": [("x", "m"), ("y", "m"), ("theta", "rad"), ("vx", "m/s"), ("vy", "m/s"),
                                  ("omega", "rad/s")]}[motion]
        if driven:
            key, unit = ("x", "m") if motion == "slide" else ("theta", "rad")
            keys.append(f"{key}: {self.expression(0.1, unit, [])}")
        lines.append(f"    motion: {{{motion}: {{{', '.join(keys)}}}}}" if keys else f"    motion: {motion}")
        if not driven:
            lines.append(f"    initial: {self.initial(coordinates)}")
        lines.append(f"    forces: [{', '.join(self.forces(motion, coordinates))}]")
        if motion in ("pivot", "planar"):
            lines.append(f"    moments: [{', '.join(self.moments(motion, coordinates))}]")
        self.bodies.append((name, motion))
        return "\n".join(lines)

    def forces(self, motion, coordinates):
        rng = self.rng
        kinds = ["gravity", "applied", "drag", "spring", "damper", "potential"]
        if motion == "slide":
            kinds += ["guide", "line", "across"]
        out = []
        for kind in rng.sample(kinds, rng.randint(1, 3)):
            place = [c for c in coordinates if "/" not in c[1]]
            anchor = rng.choice(["[0, 0]", "[0.5, 1]", "[1, 0]", "O"])
            if kind == "gravity":
                out.append("gravity")
            elif kind == "applied":
                value = self.expression(rng.uniform(-3, 3), "N", coordinates)
                angle = self.expression(rng.uniform(-3, 3), "rad", coordinates)
                out.append(f"applied: {{value: {value}, angle: {angle}}}")
            elif kind == "across":
                out.append(f"applied: {{value: {self.expression(1, 'N', coordinates)}, angle: 77 deg}}")
            elif kind == "drag":
                out.append(f"drag: {{linear: {self.number(0.3, 'N*s/m')}, quadratic: "
                           f"{self.number(0.2, 'N*s^2/m^2')}}}")
            elif kind == "spring":
                out.append(f"spring: {{stiffness: {self.number(20, 'N/m')}, free_length: "
                           f"{self.number(0.3, 'm')}, to: {anchor}}}")
            elif kind == "damper":
                out.append(f"damper: {{coefficient: {self.number(2, 'N*s/m')}, to: {anchor}}}")
            elif kind == "potential":
                out.append(f"potential: {self.expression(1, 'J', place)}")
            elif kind == "line":
                out.append(f"spring: {{name: own, stiffness: {self.number(20, 'N/m')}, neutral: "
                           f"{self.number(0.3, 'm')}}}")
            else:
                speed = self.expression(0.3, "m/s", [])
                out += ["normal: {two_sided: true}" if rng.random() < 0.7 else "normal",
                        f"friction: {{coefficient: {self.expression(0.3, '1', coordinates).replace('[1]', '')}, "
                        f"surface_speed: {speed}}}"]
                if "gravity" not in out:
                    out.append("gravity")
        return list(dict.fromkeys(out))

    def moments(self, motion, coordinates):
        rng = self.rng
        kinds = ["applied", "spring", "damper", "potential"] + (["friction"] if motion == "pivot" else [])
        out = []
        for kind in rng.sample(kinds, rng.randint(0, 2)):
            if kind == "applied":
                out.append(f"applied: {self.expression(1, 'N*m', coordinates)}")
            elif kind == "spring":
                out.append(f"spring: {{stiffness: {self.number(3, 'N*m/rad')}}}")
            elif kind == "damper":
                out.append(f"damper: {{coefficient: {self.number(0.3, 'N*m*s/rad')}}}")
            elif kind == "potential":
                place = [c for c in coordinates if c[0] == "theta"]
                out.append(f"potential: {{name: V, V: {self.expression(1, 'J', place)}}}")
            else:
                out.append(f"friction: {{kinetic: {self.expression(0.1, 'N*m', [])}}}")
        return out

    def coupling(self):
        rng = self.rng
        names = [f"{name}.G" for name, _ in self.bodies] + ["ground.O", "ground.Q"]
        ends = rng.sample(names, 2)
        if all(end.startswith("ground") for end in ends):
            ends[0] = names[0]
        between = f"between: [{', '.join(ends)}]"
        kind = rng.choice(["spring", "spring", "damper", "rod", "rope", "rope", "pin"])
        if kind == "spring":
            return f"  - spring: {{{between}, stiffness: {self.number(5, 'N/m')}, free_length: {self.number(1, 'm')}}}"
        if kind == "damper":
            return f"  - damper: {{{between}, coefficient: {self.number(1, 'N*s/m')}}}"
        if kind == "pin":
            return f"  - pin: {{{between}}}"
        length = f", length: {self.number(2, 'm')}" if rng.random() < 0.5 else ""
        if kind == "rod":
            return f"  - rod: {{{between}{length}}}"
        return f"  - rope: {{through: [{', '.join(ends)}]{length}}}"

    def text(self):
        rng = self.rng
        lines = ["fbd: 1", "parameters: {k: 1 N}", "ground: {points: {O: [0, 0], Q: [0.5, 0]}}", "bodies:"]
        count = rng.randint(1, 3)
        for i in range(count):
            lines.append(self.body(i))
        lines[-1] = lines[-1].replace("    forces: [", "    forces: [applied: {name: extra, value: k, angle: 1 rad}, ", 1)
        couplings = [self.coupling() for _ in range(rng.choice([0, 0, 1, 2]))]
        if couplings:
            lines += ["couplings:"] + couplings
        lines.append("simulate: {until: 0.1 s}")
        return "\n".join(lines) + "\n"


def scene(seed):
    """A scene whose source is in a slot chosen evenly: the slots are counted first."""
    first = Scene(random.Random(seed))
    first.text()
    second = Scene(random.Random(seed))
    second.odd = random.Random(seed + 1).randint(1, max(1, first.slots))
    return second.text()


def page_numbers(page):
    """The packed columns of a page as text."""
    columns = []
    for name, code, size in (("doubles", "d", 8), ("floats", "f", 4)):
        for packed in re.findall(f'"{name}":"([A-Za-z0-9+/=]*)"', page):
            data = base64.b64decode(packed)
            columns += struct.unpack(f"<{len(data) // size}{code}", data)
    assert columns or not page, "the page has no data"
    return " ".join(repr(x) for x in columns)


def ask(question, folder):
    """(exit code, what was written, what was said) of a program."""
    out = folder / "out"
    out.unlink(missing_ok=True)
    command = [str(out) if word == "OUT" else word for word in question[1:]]
    done = limits.run([PROGRAMS / question[0], *command, "m.yaml"], BAD_TIME, cwd=folder, capture_output=True,
                      input=b"", check=False)
    if done.returncode == limits.TOO_LONG:
        return None, "", ""
    written = out.read_text(encoding="utf-8") if out.exists() else ""
    if "--html" in question:
        written = page_numbers(written)
    return done.returncode, written + done.stdout.decode(), done.stderr.decode()


def nulls(value, path=""):
    """Paths of what stands for a number and is none, in the objects whose every member is one."""
    if isinstance(value, dict):
        for name, part in value.items():
            yield from nulls(part, f"{path}/{name}")
    elif value is None and not re.search("/margin$|/error_estimate$|/balance/[a-z]+/moment_G$", path):
        yield path
    elif isinstance(value, list):
        for index, part in enumerate(value):
            yield from nulls(part, f"{path}/{index}")


def judge(question, folder):
    code, written, said = ask(question, folder)
    if code is None:
        return "slow"
    if code < 0:
        return f"signal {-code}"
    answers = code == 1 and "--static" in question and not said  # it does not rest: an answer, too
    if code == 0 or answers:
        odd = ODD.search(written)
        if odd:
            return f"writes {written[max(0, odd.start() - 60):odd.end()]!r}"
        if "--json" in question and question[0] == "fbd-run":
            empty = list(nulls(json.loads(written)))
            if empty:
                return f"null at {empty}"
        if question[0] == "fbd-sweep" and any(",," in row and row.split(",")[-2] == "done"
                                              for row in written.splitlines()):
            return f"a row that is done has an empty field: {written}"
    elif not re.search(r"`|\[[a-z-]+\]|no reference|the couplings pass", said + written):
        return f"exit code {code} without a name: {said!r}"
    elif "out of memory" in said:
        return "out of memory"
    return None


def show(seed):
    print(scene(seed), end="")


def main():
    if len(sys.argv) > 1 and sys.argv[1] == "show":
        show(int(sys.argv[2]))
        return
    count = int(sys.argv[1]) * int(os.environ.get("FBD_DRAWS", "1")) if len(sys.argv) > 1 else 60
    first = int(sys.argv[2]) if len(sys.argv) > 2 else 1
    slow = refused = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for seed in range(first, first + count):
            text = scene(seed)
            (folder / "m.yaml").write_text(text, encoding="utf-8")
            code, _, _ = ask(["fbd-run", "--explain"], folder)
            if code == 3:
                refused += 1
                continue
            for question in QUESTIONS:
                wrong = judge(question, folder)
                if wrong == "slow":
                    slow += 1
                    continue
                if wrong:
                    with claim(f"seed {seed}: {' '.join(question)}"):
                        print(text)
                        assert not wrong, wrong
    print(f"# {count} scenes from seed {first} on, {refused} of them wrong files; {slow} answers took too long")
    with claim(f"{count} scenes, {len(QUESTIONS)} questions"):
        assert refused < 0.7 * count
    finish()


main()
