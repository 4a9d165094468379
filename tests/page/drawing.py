#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The drawing page of a sheet in a headless Chromium: what is drawn by mouse, by finger and by keyboard is the answer that
fbd-run --grade has asked for; a page for an exam has nothing of the key; and, after `make live`, the page gives the
verdict itself. `drawing.py FOLDER` keeps pictures of it there."""
import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
import limits  # noqa: E402
from browser import Browser, Missing  # noqa: E402
from claims import claim, finish, skip  # noqa: E402
from fbd import run  # noqa: E402

WHEEL = """fbd: 1
title: A wheel that is pulled
description: a secret of the teacher
grading: {reactions: all, draw: {F: [20 N, 30 N]}}
parameters: {m: 2 kg, R: 0.3 m, F: 24 N}
ground: {lines: {floor: {along: 0 deg}}}
bodies:
  wheel:
    shape: disc
    mass: m
    radius: R
    motion: planar
    initial: {y: R}
    forces: [gravity, applied: {name: hawser, value: F, angle: 0}]
    hand: "3/2*m*ax = F"
couplings: [roll: {name: tread, body: wheel, on: floor, radius: R}]
simulate: {until: 1 s}
"""
BEAM = """fbd: 1
title: A beam on two supports
grading: {reactions: all}
ground: {points: {A: [0, 0], below_B: [4, -0.5]}}
bodies:
  beam: {shape: rod, mass: 20 kg, length: 4 m, motion: planar, initial: {x: 2 m}, forces: [gravity]}
couplings:
  - pin: {name: A, between: [beam.left, ground.A]}
  - rod: {name: B, between: [beam.right, ground.below_B]}
simulate: {until: 1 s}
"""
CRATE = """fbd: 1
title: A crate on an incline
parameters: {phi: 25 deg, pull: 90 N, mu: 0.3, m: 12 kg}
bodies:
  crate:
    mass: m
    motion: {slide: {along: phi}}
    initial: {v: 2 m/s}
    forces: [gravity, normal, friction: mu, applied: {name: pull, value: pull}]
simulate: {until: 1 s}
"""
LOADED = """fbd: 1
title: A loaded beam
grading: {reactions: none}
parameters: {a: 2.7 m}
bodies:
  beam: {shape: rod, mass: 20 kg, length: 4 m, motion: planar, initial: {x: 2 m, theta: 20 deg},
    forces: [gravity, applied: {name: load, value: 30 N, angle: -90 deg, at: [0.7 m, 0]}]}
simulate: {until: 1 s}
"""
TRAIN = """fbd: 1
title: Two carts on a rope
parameters: {m: 2 kg, M: 3 kg, F: 12 N}
grading: {reactions: [cord]}
bodies:
  rear: {mass: m, motion: {slide: {along: 0}}, forces: [gravity, normal], hand: "m*a = cord"}
  front: {mass: M, motion: {slide: {along: 0}}, initial: {x: 1 m}, forces: [gravity, normal, applied: {name: tug, value: F}]}
couplings: [rod: {name: cord, between: [rear, front]}]
simulate: {until: 1 s}
"""
OVER = """fbd: 1
title: A crate above a floor
parameters: {phi: 30 deg}
ground: {lines: {floor: {along: 0 deg}}}
bodies:
  crate: {shape: prism, mass: 2 kg, a: 0.2 m, b: 2 m, motion: planar, initial: {y: 3 m, theta: 10 deg}, forces: [gravity]}
contacts: [{name: floor, between: [crate, ground.floor]}]
simulate: {until: 0.1 s}
"""
FLYWHEEL = """fbd: 1
title: A flywheel
grading: {reactions: none, points: {inertia: 2}}
bodies: {wheel: {mass: 4 kg, inertia: 0.125 kg*m^2, motion: {pivot: {at: [0, 0], point: [0, 0]}}, initial: {omega: 3 rad/s}, forces: [gravity]}}
simulate: {until: 1 s}
"""
PENDULUM = """fbd: 1
title: A driven rod
grading: {reactions: none}
bodies:
  rod: {shape: rod, mass: 3 kg, from: [0, 0], to: [0, -1 m], motion: pivot, initial: {theta: 40 deg},
    forces: [gravity, applied: {name: thrust, value: 5 N, angle: 0, frame: body, at: right}], moments: [applied: {name: drive, value: -2 N*m}]}
simulate: {until: 1 s}
"""

# Keys of WebDriver.
UP, DOWN, ENTER, TAB, DELETE, CONTROL, ESCAPE = "\ue013", "\ue015", "\ue007", "\ue004", "\ue017", "\ue009", "\ue00c"

# Places of the window beside points of a body, in millimetres, y down.
AT = """const { board } = desks[arguments[1]];
  board.scrollIntoView({ block: "center" });
  const m = board.getScreenCTM();
  return arguments[0].map(([name, dx, dy]) => {
    const [x, y] = sheet.bodies[arguments[1]].points.find((p) => p.name === name).paper;
    return [m.a * (x + dx) + m.e, m.d * (y + dy) + m.f];
  });"""
FIELDS = """for (const [field, text] of Object.entries(arguments[0])) {
    const input = desks[arguments[1]][field];
    input.value = text;
    input.dispatchEvent(new Event(input.localName === "select" ? "change" : "input"));
  }"""
SHOT = 34  # mm that a stroke is long


class Page:
    def __init__(self, browser, folder, name, key, *options, student="anna"):
        self.browser, self.folder, self.student, self.body = browser, folder, student, 0
        self.key, self.path = folder / f"{name}.yaml", folder / f"{name}.html"
        self.key.write_text(key, encoding="utf-8")
        run("--handout", "--student", student, "--page", self.path, *options, self.key)
        browser.open(self.path)

    def at(self, *places):
        return self.browser.run(AT, places, self.body)

    def draw(self, point, dx, dy, name, value="", pointer="mouse", pressing=False, kind="force"):
        """An arrow from a point to a place beside it in millimetres, y down; or from there to the point."""
        if kind == "moment":
            self.browser.run("setMode('moment')")
        places = self.at((point, 0, 0), (point, dx / 2, dy / 2), (point, dx, dy))
        self.browser.drag(places[::-1] if pressing else places, pointer)
        self.say(name=name, value=value)

    def say(self, **fields):
        self.browser.run(FIELDS, fields, self.body)

    def verdict(self):
        """What fbd-run says of the file that the page saves."""
        answer = self.folder / "answer.yaml"
        answer.write_text(self.browser.run("return fbd.answer()"), encoding="utf-8")
        grades = self.folder / "grade.json"
        run("--grade", self.key, "--student", self.student, "--quiet", "--json", grades, answer, code=None)
        return json.loads(grades.read_text(encoding="utf-8"))["answers"][0]

    def all_points(self):
        verdict = self.verdict()
        assert verdict["score"] == 1, (verdict, self.browser.run("return fbd.answer()"))

    def kinds(self):
        return [test["kind"] for test in self.verdict()["tests"]]

    def quiet(self):
        console = self.browser.log("browser")
        assert console == [], console
        foreign = [address for address in self.browser.requests()
                   if not address.startswith((self.folder.as_uri(), "data:", "blob:", "chrome:"))]
        assert foreign == [], foreign


def draw_wheel(page, pointer="mouse"):
    page.draw("G", SHOT, 1, "P", "F", pointer)
    page.draw("G", 1, SHOT, "W", "m*g", pointer)
    page.draw("bottom of the rim", 0, 25, "N", "N", pointer, pressing=True)
    page.draw("bottom of the rim", -SHOT, 0, "f", "", pointer)
    page.say(lines="F - f = m*ax\nN = m*g")


def check_layout(browser, pictures):
    for width, height in ((400, 1600), (1400, 1000)):
        with claim(f"nothing is wider than a window of {width} pixels, and all that is to be pressed has a name"):
            browser.resize(width, height)
            assert browser.run("return document.documentElement.scrollWidth") <= width
            nameless = browser.run("""return [...document.querySelectorAll("button, input, select, textarea, [role=button]")].filter((e) =>
                !(e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.length)).map((e) => e.outerHTML)""")
            assert nameless == [], nameless
        if pictures:
            browser.run("scrollTo(0, 0)")
            browser.screenshot(pictures / f"drawing-{width}.png")


def check_labels(browser):
    boxes = browser.run("""return [...desks[0].board.querySelectorAll("text")].map((text) => {
        const { left, top, right, bottom } = text.getBoundingClientRect();
        return [text.textContent, left, top + 0.25 * (bottom - top), right, bottom - 0.25 * (bottom - top)]; })""")
    for i, (name, left, top, right, bottom) in enumerate(boxes):
        for other, x0, y0, x1, y1 in boxes[:i]:
            assert right < x0 or x1 < left or bottom < y0 or y1 < top, (name, other)


def check_points(browser, folder):
    page = Page(browser, folder, "over", OVER, "--exam")
    with claim("points are those of the body, with a name each: not where a contact is open"):
        names = browser.run("return sheet.bodies[0].points.map((point) => point.name)")
        assert len(set(names)) == len(names) and "lower left corner" in names, names
        assert not any("floor" in name for name in names), names
    with claim("what is given of the body and of the scene is shown"):
        text = browser.run("return document.body.innerText")
        assert "shape: prism" in text and "= 30°" in text, text
        page.quiet()


def check_reloaded(browser):
    """The browser writes its storage by and by: a page that is loaded at once may still see an older draft."""
    before, end = browser.run("return fbd.answer()"), time.monotonic() + limits.WAIT
    while True:
        browser.run("window.isBefore = true; location.reload()")
        wait_for(browser, "!window.isBefore && document.readyState === 'complete' && typeof fbd === 'object'")
        after = browser.run("return fbd.answer()")
        if after == before:
            return
        assert time.monotonic() < end, (before, after)


def check_mouse(browser, folder, pictures):
    page = Page(browser, folder, "wheel", WHEEL, "--exam")
    with claim("the page for an exam has nothing of the key, and no library"):
        text = page.path.read_text(encoding="utf-8")
        for secret in ("hawser", "3/2*m*ax", "secret", "grading", "wasm", "live-parts"):
            assert secret not in text, secret
        assert page.browser.run("return element('check').hidden")
    with claim("a right diagram by mouse, with its equations, has all points"):
        draw_wheel(page)
        page.all_points()
        page.quiet()
    with claim("no name lies over another"):
        check_labels(browser)
    check_layout(browser, pictures)
    with claim("the equations are shown in mathematics"):
        shown = browser.run("return [...document.querySelectorAll('.shown math')].map((m) => m.textContent)")
        assert shown == ["F−f=m\u2009ax", "N=m\u2062g"], shown
    with claim("the end of an arrow that is dragged turns it: the verdict names it"):
        browser.run("choose(fbd.drawing.entries[3].id)")
        browser.drag(page.at(("bottom of the rim", -SHOT, 0), ("bottom of the rim", 10, 10), ("bottom of the rim", SHOT, 0)))
        wrong = [(test["name"], test["kind"]) for test in page.verdict()["tests"] if test["points"] < test["max_points"]]
        assert wrong == [("wheel: f", "sense")], wrong
    with claim("Ctrl Z takes that back, and Ctrl Y does it again"):
        browser.chord(CONTROL, "z")
        page.all_points()
        browser.chord(CONTROL, "y")
        assert "sense" in page.kinds()
        browser.chord(CONTROL, "z")
    with claim("an arrow at another point has another line of action; one too many is superfluous"):
        browser.drag(page.at(("G", 27, 1), ("top of the rim", 20, 0), ("top of the rim", 27, 1)))
        page.draw("left of the rim", -20, 20, "C", "5 N")
        kinds = page.kinds()
        assert "place" in kinds and "superfluous" in kinds, page.verdict()
    with claim("a page that is loaded again has what was drawn"):
        check_reloaded(browser)


def check_touch(browser, folder):
    page = Page(browser, folder, "beam", BEAM, "--exam")
    with claim("a right diagram by touch has all points; a pin by components"):
        page.draw("G", 0, SHOT, "W", "20[kg]*g", "touch")
        page.draw("left", SHOT, 0, "A_x", "", "touch")
        page.draw("left", 0, -SHOT, "A_y", "", "touch")
        page.draw("right", 0, 25, "B", "B", "touch", pressing=True)
        page.all_points()
        page.quiet()
    with claim("a pin by a force of unknown direction, and a roller that pulls"):
        browser.run("for (const name of ['A_x', 'A_y', 'B']) removeEntry(fbd.drawing.entries.find((e) => e.name === name))")
        page.draw("left", 20, -20, "A", "", "touch")
        page.say(direction="unknown")
        page.draw("right", 0, SHOT, "B", "", "touch")
        kinds = page.kinds()
        assert kinds.count("right") == 2 and "sense" in kinds, page.verdict()


def check_keyboard(browser, folder):
    page = Page(browser, folder, "crate", CRATE, "--exam")
    with claim("a right diagram by the keyboard alone has all points"):
        browser.run("desks[0].board.focus()")

        for turns, name, value in (["r"], "W", "m*g"), ([UP] * 2, "N", "N"), ([DOWN] * 5, "P", "pull"), ([UP] * 9, "f", ""):
            browser.type(["f", *turns, ENTER, *name, TAB, *value, ESCAPE])
        page.all_points()
        page.quiet()
    with claim("Delete deletes"):
        browser.type([DELETE])
        assert page.kinds().count("missing") == 1, page.verdict()


def check_body_frame(browser, folder):
    page = Page(browser, folder, "pendulum", PENDULUM, "--exam")
    with claim("a direction that turns with the body, a moment clockwise, a given number"):
        page.draw("G", 0, SHOT, "W", "3[kg]*g")
        page.draw("right", 0, -SHOT, "T", "5 N")
        choice = browser.run("return [...desks[0].direction.options].find((o) => o.text.startsWith('along the body')).value")
        page.say(direction=choice)
        page.draw("O", 12, 3, "M", "2 N*m", kind="moment")
        page.all_points()
    with claim("any angle may be typed, and is drawn"):
        browser.run("choose(fbd.drawing.entries[1].id)")
        page.say(direction="other")
        page.say(angle="40 deg + 0°")
        assert abs(browser.run("return fbd.drawing.entries[1].direction.degrees") - 40) < 1e-9
        assert "angle: \"40[deg] + 0[deg]\"" in browser.run("return fbd.answer()"), browser.run("return fbd.answer()")


def wait_for(browser, condition):
    end = time.monotonic() + limits.WAIT
    while not browser.run(f"return {condition}"):
        assert time.monotonic() < end, f"never: {condition}; it says {browser.run('return element(`says`).textContent')}"
        time.sleep(0.05)


def check_without_live(folder):
    """Does this fbd write pages that check? Where it does not, it says so."""
    key, page = folder / "key.yaml", folder / "page.html"
    key.write_text(WHEEL, encoding="utf-8")
    command = [os.environ["FBD_RUN"], "--handout", "--student", "anna", "--page", page, key]
    done = subprocess.run(command, capture_output=True, check=False, text=True)
    if done.returncode == 0:
        return True
    with claim("without live pages there are no pages that check: an error says what there is"):
        assert done.returncode == 1 and not page.exists(), done
        assert "no-live" in done.stderr and "--exam" in done.stderr, done.stderr
    return False


def check_typed_place(browser, folder):
    page = Page(browser, folder, "loaded", LOADED, "--exam")
    with claim("a place that is typed is exact, and formulas may have units without brackets"):
        page.draw("G", 0, SHOT, "W", "20 kg*g")
        page.draw("G", 25, -SHOT, "S", "30 N", pressing=True)
        page.say(point="place")
        page.say(beside="a - 2 m, 0", direction="3")
        page.all_points()
        assert "at: [\"a - 2[m]\", 0]" in browser.run("return fbd.answer()"), browser.run("return fbd.answer()")
    with claim("what is no place is said, and changes nothing"):
        before = browser.run("return fbd.answer()")
        page.say(beside="a, b, c")
        assert "two lengths" in browser.run("return desks[0].says.textContent")
        assert browser.run("return fbd.answer()") == before


def check_several(browser, folder):
    page = Page(browser, folder, "train", TRAIN, "--exam")
    with claim("each body has its own diagram; only one that the key derives has lines"):
        assert browser.run("return desks.map((desk) => Boolean(desk.lines))") == [True, False]
        page.draw("G", SHOT, 0, "T", "")
        page.draw("G", 0, SHOT, "W", "m*g")
        page.draw("G", 0, -SHOT, "N", "")
        page.say(lines="m a = T")
        page.body = 1
        page.draw("G", -SHOT, 0, "T", "", "touch")
        page.draw("G", SHOT, 0, "F", "F", "touch")
        page.draw("G", 0, -SHOT, "N", "", "touch")
        page.draw("G", 0, SHOT, "W", "M*g", "touch")
        page.all_points()
        page.quiet()
    with claim("what is undone is undone on its own body"):
        page.say(direction="0")
        assert page.verdict()["score"] < 1
        browser.run("undo()")
        page.all_points()


def check_inertia(browser, folder):
    page = Page(browser, folder, "flywheel", FLYWHEEL, "--exam")
    with claim("a moment of inertia that is asked is typed, and is not in the page"):
        assert "0.125" not in page.path.read_text(encoding="utf-8")
        page.draw("G", 0, SHOT, "W", "4 kg*g")
        page.say(inertia="0.5*0.25 kg*m^2")
        page.all_points()
        page.quiet()


def check_verdict(browser, folder):
    page = Page(browser, folder, "graded", WHEEL, "--set", "F=25 N", "--set", "m=3 kg")
    with claim("the page gives the verdict of fbd-run"):
        draw_wheel(page)
        browser.run("element('check').click()")
        wait_for(browser, "!element('verdict').hidden")
        assert "F=25 N" not in browser.run("return fbd.answer()")
        assert "6 of 6" in browser.run("return element('points').textContent")
        page.quiet()
    with claim("and marks what is wrong where it is drawn"):
        browser.run("choose(fbd.drawing.entries[3].id); reverse(fbd.drawing.entries[3]); changed(); showAll(); element('check').click()")
        wait_for(browser, "!element('verdict').hidden")
        assert browser.run("return document.querySelectorAll('.arrow.wrong').length") == 1


def main():
    pictures = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    with tempfile.TemporaryDirectory(prefix="fbd-drawing-") as name:
        folder = Path(name)
        try:
            browser = Browser(1400, 1000)
        except Missing as missing:
            skip(str(missing))
        with browser:
            check_mouse(browser, folder, pictures)
            for check in (check_touch, check_keyboard, check_body_frame, check_typed_place, check_several, check_points, check_inertia):
                check(browser, folder)
            if check_without_live(folder):
                check_verdict(browser, folder)
    finish()


main()
