#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The diagrams of --svg for every model of models/: valid SVG 1.1, the same every time, arrows that are the forces of
the JSON, and labels that do not overlap, by the boxes that a browser gives them."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
from browser import Browser, Missing  # noqa: E402
from claims import claim, close, finish  # noqa: E402
from fbd import MODELS, SOURCE, result, run  # noqa: E402

DTD = Path("/usr/share/xml/w3c-sgml-lib/schema/dtd/REC-SVG11-20110816/svg11.dtd")
SVG = "{http://www.w3.org/2000/svg}"
CROWDED = """fbd: 1
title: Many <forces> & "bodies"
bodies:
  crowd:
    shape: prism
    mass: 3 kg
    a: 0.4 m
    b: 0.2 m
    c: 0.2 m
    motion: planar
    initial: {theta: 25 deg, omega: 2 rad/s, vx: 3 m/s}
    forces:
      - gravity
      - drag: {linear: 2 N*s/m}
%s
    moments:
      - applied: {name: m1, value: 3 N*m}
      - applied: {name: m2, value: -2 N*m}
      - damper: {coefficient: 0.1 N*m*s/rad}
  block:
    mass: 1 kg
    motion: slide
    initial: {v: 1 m/s}
    forces:
      - gravity
      - normal
      - friction: {static: 0.3, kinetic: 0.3}
      - applied: {name: left, value: -3 N}
      - applied: {name: more_to_the_left, value: -4 N}
      - applied: {name: none, value: 0 N}
simulate: {until: 1 s}
""" % "\n".join(f"      - applied: {{name: p{i}, value: {8 + i} N, angle: {37 * i % 360} deg, at: [{0.2 * (i % 3 - 1)}, 0.1]}}"
                for i in range(16))

# Pairs of labels whose boxes share more than rounding, labels that stick out of the picture, and lines of bodies, arrows
# and leaders through labels.
BOXES = """
const labels = [...document.querySelectorAll('text')], boxes = labels.map((l) => l.getBoundingClientRect()), wrong = [];
const page = document.documentElement.getBoundingClientRect(), slack = 0.5;
boxes.forEach((a, i) => {
  if (a.left < page.left - slack || a.right > page.right + slack || a.top < page.top - slack || a.bottom > page.bottom + slack)
    wrong.push(labels[i].textContent + ' sticks out');
  for (let k = 0; k < i; k++) {
    const b = boxes[k], wide = Math.min(a.right, b.right) - Math.max(a.left, b.left), high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
    // a line box is higher than its letters: a fifth of it is empty
    if (wide > slack && high > 0.2 * Math.min(a.height, b.height)) wrong.push(labels[i].textContent + ' on ' + labels[k].textContent);
  }
});
// Lines of bodies, arrows, ropes, the ground, dimensions and leaders through a label: pieces of each line that lie in the box of its letters.
const letters = boxes.map((b) => ({ left: b.left + slack, right: b.right - slack, top: b.top + 0.2 * b.height, bottom: b.bottom - 0.2 * b.height }));
function along(element) {
  const matrix = element.getScreenCTM(), length = element.getTotalLength(), count = Math.max(8, Math.ceil(length * matrix.a / 0.7)), points = [];
  for (let k = 0; k <= count; k++) points.push(element.getPointAtLength(length * k / count).matrixTransform(matrix));
  return points;
}
const lines = document.querySelectorAll('.body, .hole, .bar, .shaft, .thread, .rope, .ground, .dimension, .leader');
for (const line of lines) {
  const half = line.classList.contains('bar') ? 1.2 * line.getScreenCTM().a : 0, points = along(line);
  letters.forEach((b, i) => {
    if (points.some((p) => p.x > b.left - half && p.x < b.right + half && p.y > b.top - half && p.y < b.bottom + half))
      wrong.push(labels[i].textContent + ' on a line: ' + line.getAttribute('class'));
  });
}
return [...new Set(wrong)];
"""


def models(folder):
    crowded = folder / "crowded.yaml"
    crowded.write_text(CROWDED, encoding="utf-8")
    every = 12 if os.environ.get("FBD_THOROUGH") == "no" else 1
    return [*sorted(MODELS.glob("*/*.yaml"))[::every], crowded]


def draw(model, path, *arguments):
    run("--equations", "--svg", path, *arguments, model)
    return path


def drawings(folder):
    """(name, path): at the start, the figure of the system, in the middle with components, of every model."""
    made = []
    for model in models(folder):
        name = f"{model.parent.name}-{model.stem}"
        made.append((name, draw(model, folder / f"{name}.svg")))
        made.append((f"{name}, system", draw(model, folder / f"{name}-system.svg", "--system")))
        until = re.search(r"until: *([0-9.e]+) *s", model.read_text(encoding="utf-8"))
        middle = folder / f"{name}-middle.svg"
        if until and "hard" not in str(model):
            time = float(until[1]) * 0.37
            try:
                made.append((f"{name} at {time:g} s", draw(model, middle, "--components", "--at", time)))
            except AssertionError as reason:  # it has ended before
                assert "the run ends before" in str(reason), reason
    return made


def check_grammar(made):
    if DTD.exists() and shutil.which("xmllint"):
        with claim(f"{len(made)} diagrams are valid by the document type of SVG 1.1"):
            done = subprocess.run(["xmllint", "--noout", "--nonet", "--dtdvalid", DTD, *(path for _, path in made)],
                                  capture_output=True, check=False)
            assert done.returncode == 0, done.stderr.decode()
    with claim("every diagram is well-formed, with ids that are unique"):
        for name, path in made:
            ids = [element.get("id") for element in ElementTree.parse(path).iter() if element.get("id")]
            assert len(ids) == len(set(ids)), name
    with claim("every arrow has a title, a label and a head"):
        for name, path in made:
            for group in ElementTree.parse(path).iter(SVG + "g"):
                if "arrow" in (group.get("class") or "").split():
                    parts = [child.tag.replace(SVG, "") for child in group]
                    assert parts[0] == "title" and "polygon" in parts and parts[-1] == "text", (name, parts)


def check_labels(made):
    try:
        with Browser() as browser:
            with claim(f"no label of {len(made)} diagrams lies on another or on a line, or sticks out"):
                wrong = {}
                for name, path in made:
                    browser.open(path)
                    found = browser.run(BOXES)
                    if "crowded" in name:  # up to 53 arrows around one body leave no place for every label
                        found = [mistake for mistake in found if " on a line: " not in mistake]
                    if found:
                        wrong[name] = found
                assert not wrong, wrong
    except Missing as missing:
        print(f"# labels are not looked at: {missing}")


def arrows_of(path):
    """{id: (fx, fy)} from the titles."""
    found = {}
    for group in ElementTree.parse(path).iter(SVG + "g"):
        title = group.find(SVG + "title")
        vector = re.search(r"\((\S+), (\S+)\)", title.text) if title is not None else None
        if vector:
            found[group.get("id")] = (float(vector[1]), float(vector[2]), group)
    return found


def check_numbers(folder):
    incline = MODELS / "kinetics/incline.yaml"
    arrows = arrows_of(draw(incline, folder / "numbers.svg", "--at", "3"))
    forces = result(incline)["forces"]["block"]
    with claim("the arrows at the end of the run are the forces of the JSON"):
        assert set(arrows) == {f"block-{name}" for name in forces}, list(arrows)
        for name, force in forces.items():
            close(arrows[f"block-{name}"][0], force["fx"], 1e-8 * 20)
            close(arrows[f"block-{name}"][1], force["fy"], 1e-8 * 20)
    with claim("their lengths are to the printed scale, and their directions those of the forces"):
        text = (folder / "numbers.svg").read_text(encoding="utf-8")
        newtons = float(re.search(r"forces: 10 mm = (\S+) N", text)[1])
        for fx, fy, group in arrows.values():
            shaft, tip = group.find(SVG + "line"), group.find(SVG + "polygon").get("points").split()[0].split(",")
            dx, dy = float(tip[0]) - float(shaft.get("x1")), float(tip[1]) - float(shaft.get("y1"))
            close(dx, fx * 10 / newtons, 2e-3)  # coordinates are written to 1/1000 mm
            close(-dy, fy * 10 / newtons, 2e-3)
    with claim("the same state gives the same picture"):
        assert draw(incline, folder / "again.svg", "--at", "3").read_bytes() == (folder / "numbers.svg").read_bytes()
    with claim("the picture that the README shows is this one"):
        draw(incline, folder / "readme.svg", "--at", "0.2")
        assert (folder / "readme.svg").read_bytes() == (SOURCE / "docs/pictures/incline.svg").read_bytes(), "make gallery"
    with claim("--body draws this body alone"):
        draw(folder / "crowded.yaml", folder / "one.svg", "--body", "block")
        found = ElementTree.parse(folder / "one.svg").iter(SVG + "g")
        assert [g.get("id") for g in found if g.get("class") == "diagram"] == ["block"]
    with claim("a body that is not there is a mistake of the command line, with the nearest name"):
        run("--quiet", "--svg", folder / "none.svg", "--body", "blok", incline, code=2)
        assert not (folder / "none.svg").exists()
    with claim("forces that are zero are named, not drawn"):
        text = (folder / "one.svg").read_text(encoding="utf-8")
        assert "zero here: none" in text and 'id="block-none"' not in text
    with claim("components add up to their force"):
        arrows = arrows_of(draw(incline, folder / "components.svg", "--components"))
        assert {"block-gravity-x", "block-gravity-n"} <= set(arrows)


def check_eigenvalues(folder):
    model, path = MODELS / "vibration/damped_oscillator.yaml", folder / "eigenvalues.svg"
    run("--linearize", "--svg", path, model)
    titles = [g.find(SVG + "title").text for g in ElementTree.parse(path).iter(SVG + "g")]
    with claim("--linearize --svg has the eigenvalues -zeta w +- i wd"):
        # w = 10 rad/s, zeta = 0.05: wd = 10 sqrt(1 - 0.0025)
        assert len(titles) == 2 and all(t.startswith("-0.5 ") and "9.98749218 i" in t for t in titles), titles
    return [("eigenvalues", path)]


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        made = drawings(folder)
        check_numbers(folder)
        made += check_eigenvalues(folder)
        check_grammar(made)
        check_labels(made)
    finish()


if __name__ == "__main__":
    main()
