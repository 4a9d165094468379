#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of --html in a headless Chromium: it plays, scrubs and goes to events, shows the numbers of the CSV, asks
the network for nothing, and takes what the model says as data."""
import json
import math
import os
import re
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
import limits  # noqa: E402
from browser import Browser, Missing  # noqa: E402
from claims import claim, close, finish, skip  # noqa: E402
from fbd import MODELS, many_bodies, result, run, table  # noqa: E402

SEVEN_DIGITS = 1.2e-7  # the page keeps numbers that are read as floats
SIX_DIGITS = 6e-6      # and shows six digits
INCLINE = MODELS / "kinetics/incline.yaml"
PENDULUM = MODELS / "rotation/compound_pendulum.yaml"
SPECIAL = """fbd: 1
title: "</script><script>alert(1)</script> & <b>bold</b> 'q' \\u2028"
bodies:
  constructor:
    mass: 2 kg
    motion: slide
    initial: {v: 1 m/s}
    forces: [gravity, normal, friction: {static: 0.2, kinetic: 0.1}]
simulate: {until: 1 s}
"""

# What is wrong with the scene at ten times, with names and values: labels on labels, labels and arrows over the edge.
CROWDING = """
document.getElementById('show-values').checked = true;
const found = [], outside = (x, y) => x < 0 || y < 0 || x > view.width || y > view.height;
for (let i = 0; i < 10; i++) {
  fbd.seek(run.start + (run.end - run.start) * (i + 0.37) / 10);
  const { labels, arrows } = fbd.drawn, at = (text) => found.push(`${text} at ${fbd.player.t}`);
  labels.forEach((a, k) => {
    if (outside(a.left, a.top) || outside(a.right, a.bottom)) at(`${a.text} sticks out`);
    for (const b of labels.slice(0, k))
      if (a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom) at(`${a.text} on ${b.text}`);
  });
  for (const [x1, y1, x2, y2, arc] of arrows)
    if (!outside(x1, y1) && outside(x2, y2) || arc && outside(x1, y1)) at(`an arrow from ${x1}, ${y1} to ${x2}, ${y2}`);
}
return found.slice(0, 4);
"""


def wait_for(browser, condition):
    """A condition of the page that comes true by and by."""
    end = time.monotonic() + limits.WAIT
    while not browser.run(f"return {condition}"):
        assert time.monotonic() < end, f"never: {condition}"
        time.sleep(0.02)


def page_is_quiet(browser, path):
    """No message on the console, no address asked for but those of the test's own files."""
    console = browser.log("browser")
    assert console == [], console
    foreign = [address for address in browser.requests()
               if not address.startswith(path.parent.as_uri()) and not address.startswith(("data:", "chrome:"))]
    assert foreign == [], foreign


def numbers_agree(browser, model, names, rows):
    for row in rows:
        shown = browser.run("const [names, t] = arguments; return names.map((name) => fbd.value(name, t));", names, row["t"])
        for name, value in zip(names, shown):
            # the residual is what is left of the energies
            of = "energy.kinetic" if name == "energy.residual" else name
            size = max(abs(other[of]) for other in rows)
            assert abs(value - row[name]) <= SEVEN_DIGITS * size + 1e-300, (name, row["t"], value, row[name])


def check_incline(browser, folder):
    path = folder / "incline.html"
    run("--quiet", "--html", path, INCLINE)
    rows = table(INCLINE)
    browser.open(path)
    with claim("the title of the page is that of the model"):
        assert browser.run("return document.title") == "Block on an incline with dry friction"
    with claim("every column of the CSV has its numbers in the page, at every row of the CSV"):
        names = [name for name in rows[0] if name != "t"]
        numbers_agree(browser, INCLINE, names, [row for row in rows if row["t"] != rows[0]["t"]][::20])
    with claim("both sides of an event are there: friction jumps"):
        t = next(e["t"] for e in result(INCLINE)["events"])
        before, after = browser.run(
            "const t = arguments[0]; return [fbd.value('block.friction', t - 1e-9), fbd.value('block.friction', t)];", t)
        close(before, -8.495709211125343, 1e-5)
        close(after, 4.81, 1e-6)
    with claim("playing moves the time on at the speed of real time, and pausing stops it"):
        browser.run("fbd.seek(0); document.getElementById('play').click();")
        wait_for(browser, "fbd.player.t > 0.2")
        browser.run("document.getElementById('play').click();")
        t = browser.run("return fbd.player.t")
        time.sleep(0.1)
        assert browser.run("return fbd.player.t") == t and not browser.run("return fbd.player.playing")
    with claim("pausing and playing on before the next frame still draws each frame once"):
        drawn = browser.run("""fbd.seek(0); fbd.setPlaying(true);
            for (let i = 0; i < 3; i++) { fbd.setPlaying(false); fbd.setPlaying(true); }
            const frame = () => new Promise((done) => requestAnimationFrame(done));
            await frame(); const before = fbd.player.frames; await frame();
            const drawn = fbd.player.frames - before; fbd.setPlaying(false); return drawn;""")
        assert drawn == 1, drawn
    with claim("the end of the run ends the play"):
        browser.run("fbd.seek(2.9); fbd.setPlaying(true);")
        wait_for(browser, "!fbd.player.playing")
        assert browser.run("return fbd.player.t") == 3
    with claim("the slider scrubs"):
        browser.run("""const slider = document.getElementById('scrub'); slider.value = 1.25;
                       slider.dispatchEvent(new Event('input'));""")
        close(browser.run("return fbd.player.t"), 1.25, 1e-12)
    with claim("an event of the list is gone to by a click"):
        browser.run("document.querySelector('#events button').click()")
        close(browser.run("return fbd.player.t"), 0.45093424971163, 1e-12)
    with claim("keys play, step and go to events"):
        browser.run("fbd.seek(0); document.getElementById('scene').focus();")
        browser.press("n")
        close(browser.run("return fbd.player.t"), 0.45093424971163, 1e-12)
        browser.press("\ue014")  # right
        close(browser.run("return fbd.player.t"), 0.45093424971163 + 3 / 200, 1e-12)
        browser.press(" ")
        assert browser.run("return fbd.player.playing")
        browser.press(" ")
        assert not browser.run("return fbd.player.playing")
    with claim("the equation is that of --equations at this time, term by term"):
        browser.run("fbd.seek(0.2)")
        cells = browser.run("""return [...document.querySelectorAll('#equations tr')].map((row) =>
                               [row.cells[0].textContent, Number(row.cells[1].textContent.replace('−', '-'))]);""")
        want = {"gravity": -9.81, "normal": 0, "friction": -8.495709211, "push": 5, "sum": -13.30570921, "m": 2,
                "v\u0307": -6.652854606}
        assert [name for name, _ in cells] == list(want)
        for name, value in cells:
            close(value, want[name], SIX_DIGITS * 14)
    with claim("a click into a plot moves the cursor there"):
        box = browser.run("""const plot = document.querySelector('.plot'); plot.scrollIntoView();
                             const r = plot.getBoundingClientRect(); return [r.left, r.top, r.width, r.height];""")
        browser.click(box[0] + box[2] / 2, box[1] + box[3] / 2)
        t = browser.run("return fbd.player.t")
        assert 1.2 < t < 1.9, t
    with claim("zooming in one plot zooms all"):
        browser.run("fbd.zoom(0.4, 0.5)")
        ranges = browser.run("return charts.filter((chart) => chart.graph).map((chart) => chart.graph.xAxisRange())")
        assert len(ranges) >= 4 and all(r == [0.4, 0.5] for r in ranges), ranges
        browser.run("fbd.zoom(0, 3)")
    with claim("an address with a time opens there"):
        browser.open(path, "#t=0.75")
        wait_for(browser, "fbd.player.t === 0.75")
    with claim("the incline's page is quiet and asks for nothing"):
        page_is_quiet(browser, path)


def check_pendulum(browser, folder):
    path = folder / "pendulum.html"
    run("--quiet", "--html", path, PENDULUM)
    browser.open(path)
    with claim("between the rows numbers are interpolated to six digits"):
        exact = {row["t"]: row for row in table("--every", "0.00731", PENDULUM)}
        names = ["pendulum.theta", "pendulum.omega", "pendulum.pin.x", "pendulum.gravity", "energy.kinetic"]
        for t in list(exact)[1::97]:
            shown = browser.run("const [n, t] = arguments; return n.map((name) => fbd.value(name, t));", names, t)
            for name, value in zip(names, shown):
                close(value, exact[t][name], 1e-6 * max(abs(row[name]) for row in exact.values()))
    with claim("bearing, rod, bob and the trace of the bob are drawn where they are"):
        # The bob's edge and the rod are darker than paper; nothing is drawn far from them and from the trace.
        found = browser.run("""
            fbd.seek(0); for (const id of ['show-forces', 'show-names', 'show-axes']) document.getElementById(id).checked = false;
            fbd.seek(fbd.run.events.times[1]);
            const t = fbd.player.t, theta = fbd.value('pendulum.theta', t), at = (r, a) => toScreen([r * Math.sin(a), -r * Math.cos(a)]);
            const all = pen.getImageData(0, 0, canvas.width, canvas.height);
            const ink = (r, a) => { const [x, y] = at(r, a).map((v) => Math.round(v * view.ratio)); let least = 255;
              for (let i = x - 4; i <= x + 4; i++) for (let k = y - 4; k <= y + 4; k++)
                least = Math.min(least, all.data[4 * (k * all.width + i)]);
              return least; };
            return [ink(0, 0), ink(0.5, theta), ink(1.06 + 0.06, theta), ink(1.06, 0.7), ink(0.5, theta + 1.2), theta];""")
        axis, rod, bob, trace, nothing, theta = found
        assert axis < 128 and rod < 128 and bob < 128 and trace < 220 and nothing == 255, found
    with claim("the events of the file are in the list"):
        assert browser.run("return document.querySelectorAll('#events button').length") == len(result(PENDULUM)["events"])
    with claim("the pendulum's page is quiet and asks for nothing"):
        page_is_quiet(browser, path)
    run("--quiet", "--degrees", "--html", path, PENDULUM)
    browser.open(path)
    with claim("with --degrees the plots of angles and their rates are in degrees, and nothing else is"):
        titles, theta, rows, legend = browser.run("""fbd.seek(0.5); const chart = charts[0];
            return [charts.map(({ spec }) => `${spec.title} [${spec.unit}]`), fbd.value('pendulum.theta', 0.5),
                    chartRows(chart.spec.columns, 0, 0.5, chart.spec.size).map((row) => row[1]), chart.values[0].data];""")
        assert titles[:2] == ["Coordinates [deg]", "Velocities [deg/s]"], titles
        assert not any("deg" in title for title in titles[2:]), titles
        row = next(row for row in table("--every", "0.5", PENDULUM) if row["t"] == 0.5)
        close(theta, row["pendulum.theta"], 1e-6)
        close(rows[0], math.degrees(table(PENDULUM)[0]["pendulum.theta"]), 1e-6)
        assert legend.endswith(" deg"), legend


def check_joined(browser, folder):
    for name in ("double_pendulum", "block_on_wedge", "elastic_pendulum"):
        model, path = MODELS / f"trees/{name}.yaml", folder / f"{name}.html"
        run("--quiet", "--html", path, model)
        browser.open(path)
        rows = table(model)
        with claim(f"{name}: every column of the CSV has its numbers in the page"):
            numbers_agree(browser, model, [column for column in rows[0] if column != "t"], rows[::50])
        with claim(f"{name}: in every equation the terms add up to inertia times acceleration, at every time"):
            worst = browser.run("""let worst = 0;
                for (let i = 0; i <= 40; i++) {
                  const t = run.end * i / 40, row = rowAt(t);
                  for (const body of run.bodies) for (const e of body.equations) {
                    const values = e.terms.map(([, column]) => valueAt(column, t, row));
                    const product = e.value * valueAt(e.acceleration, t, row);
                    const size = Math.max(...values.map(Math.abs), Math.abs(product));
                    if (size > 0) worst = Math.max(worst, Math.abs(values.reduce((a, b) => a + b, 0) - product) / size);
                  }
                } return worst;""")
            assert worst < 1e-5, worst  # seven digits of each term, and cubics between the rows
        with claim(f"{name}: the page is quiet and asks for nothing"):
            page_is_quiet(browser, path)


def check_couplings(browser, folder):
    """What is drawn of a coupling is what changes in the picture when the page forgets it."""
    unseen, loud = {}, {}
    every = 1 if os.environ.get("FBD_ALL_PAGES") else 4
    shown = sorted((MODELS / "couplings").glob("*.yaml"))[::every]
    for model in sorted({*shown, *(MODELS / f"couplings/{name}.yaml" for name in ("atwood", "rope_pendulum"))}):
        path = folder / f"{model.stem}.html"
        run("--quiet", "--html", path, model)
        browser.open(path)
        browser.run("for (let i = 0; i <= 10; i++) fbd.seek(run.end * i / 10);")
        if console := browser.log("browser"):
            loud[model.stem] = console
        changed = browser.run("""
            for (const id of ['show-forces', 'show-names', 'show-axes', 'show-trace']) document.getElementById(id).checked = false;
            fbd.seek(run.end * 0.2);
            const all = run.couplings, picture = () => {
              drawStill(); refresh(); return pen.getImageData(0, 0, canvas.width, canvas.height).data; };
            const whole = picture();
            return all.map((coupling) => {
              run.couplings = all.filter((other) => other !== coupling);
              const without = picture();
              run.couplings = all;
              return [coupling.name, whole.reduce((sum, value, i) => sum + (value !== without[i]), 0)]; });""")
        forces_alone = not re.search(r"^ +- (?!actuator|spring|damper)\w+: ", model.read_text().partition("\ncouplings:")[2], re.M)
        if not changed and not forces_alone or any(pixels < 20 for _, pixels in changed):
            unseen[model.stem] = changed
        browser.log("browser")  # Chromium's advice for who reads pixels often
    with claim("each coupling of the models is to be seen in its page"):
        assert not unseen, unseen
    with claim("and none of these pages has a word for the console"):
        assert not loud, loud
    with claim("a rope touches its pulley where it leaves it: Atwood's hangs straight down from both sides"):
        browser.open(folder / "atwood.html")
        ends = browser.run("fbd.seek(0.5); return run.couplings.map((coupling) => coupling.reached);")
        for got, want in zip(ends[0], (-0.1, 0)):
            close(got, want, 1e-9)
        assert abs(ends[1][0] - 0.1) < 1e-9, ends
    with claim("a rope is drawn slack between the events that say so, and taut else"):
        browser.open(folder / "rope_pendulum.html")
        slack = browser.run("""const [loose, taut] = run.events.times;
            return [0, loose / 2, loose + 1e-6, (loose + taut) / 2, taut - 1e-6, taut + 1e-6, run.end].map(
              (t) => isSlack(run.couplings[0], t, rowAt(t)));""")
        assert slack == [False, False, True, True, True, False, False], slack


STOPS = """fbd: 1
bodies:
  cart:
    mass: 2 kg
    shape: prism
    a: 0.3 m
    b: 0.2 m
    motion: {slide: {min: -0.4 m, max: 0.5 m, restitution: 0.5}}
    initial: {v: 1 m/s}
    forces: [gravity, normal, friction: {static: 0.4, kinetic: 0.1, surface_speed: -0.5 m/s}]
  flap:
    mass: 1 kg
    shape: rod
    length: 0.4 m
    motion: {pivot: {on: cart, at: [0, 0.1], point: left, min: 30 deg, max: 120 deg, restitution: 0.4}}
    initial: {theta: 60 deg}
    forces: [gravity]
    moments: [spring: {stiffness: 2 N*m/rad}]
simulate: {until: 1 s}
"""


RUNNING = """fbd: 1
bodies:
  drum: {shape: disc, mass: 5 kg, radius: 0.5 m, motion: pivot, forces: [gravity]}
  disc: {shape: disc, mass: 1 kg, radius: 0.1 m, motion: planar, initial: {y: 0.6 m}, forces: [gravity]}
  table: {shape: prism, mass: 4 kg, a: 2 m, b: 0.1 m, motion: {pivot: {at: [0, -1.5]}}, initial: {theta: 30 deg}}
  cart:
    mass: 1 kg
    motion: {slide: {on: table, along: 0 deg, through: [0, 0.05 m]}}
    forces: [gravity, normal, friction: {coefficient: 0.2, surface_speed: 0.5 m/s}]
contacts: [{name: rim, between: [disc, drum], static: 0.4, kinetic: 0.3, surface_speed: -1.5 m/s}]
simulate: {until: 0.5 s}
"""


def check_running(browser, folder):
    """Surfaces of bodies that run."""
    model, path = folder / "running.yaml", folder / "running.html"
    model.write_text(RUNNING, encoding="utf-8")
    run("--quiet", "--html", path, model)
    browser.open(path)
    arcs, arrows, drum, cart, turn, texts = browser.run("""
        const arcs = [], arrows = [], old = [drawArc, plainArrow], t = 0.2;
        drawArc = (at, radius, from, sweep, ...others) => { if (radius === 18) arcs.push([...at, sweep]); old[0](at, radius, from, sweep, ...others); };
        plainArrow = (at, e, length, ...others) => { if (at[1] < view.height - 30) arrows.push([at[0] + length / 2 * e[0], at[1] + length / 2 * e[1], ...e]);
          old[1](at, e, length, ...others); };
        fbd.seek(t);
        [drawArc, plainArrow] = old;
        const frames = framesAt(t), [drum, , table, cart] = frames;
        return [arcs, arrows, toScreen([drum.x, drum.y]), toScreen([cart.x, cart.y]), table.angle, drawn.labels.map(({ text }) => text)];""")
    with claim("the surface of a drum that runs clockwise has an arc about its centre in that sense, with its speed"):
        assert len(arcs) == 1 and arcs[0][2] < 0 and math.dist(arcs[0][:2], drum) < 1e-6 and "1.5 m/s" in texts, (arcs, drum, texts)
    with claim("that of a slide on a body an arrow along the line, in the body below the one that slides"):
        assert len(arrows) == 1 and "0.5 m/s" in texts, (arrows, texts)
        x, y, ex, ey = arrows[0]
        close(math.atan2(-ey, ex), turn, 1e-9)
        close((x - cart[0]) * ex + (y - cart[1]) * ey, 0, 1e-6)
        assert (x - cart[0]) * math.sin(turn) + (y - cart[1]) * math.cos(turn) > 0, (arrows, cart, turn)
    with claim("the page of surfaces that run is quiet"):
        page_is_quiet(browser, path)


def check_guides(browser, folder):
    """Stops, springs about an axis and surfaces that run, in the frame of the body that carries them."""
    model, path = folder / "stops.yaml", folder / "stops.html"
    model.write_text(STOPS, encoding="utf-8")
    run("--quiet", "--html", path, model)
    browser.open(path)
    walls, spirals, arrows = browser.run("""
        const walls = [], spirals = [], arrows = [], old = [drawWall, drawSpiral, plainArrow];
        const world = ([x, y]) => [(x - view.x) / view.scale, (view.y - y) / view.scale];
        drawWall = (at, n, half) => { if (half === 12) walls.push([...world(at), n[0], -n[1]]); old[0](at, n, half); };
        drawSpiral = (body, ...others) => { spirals.push(body.name); old[1](body, ...others); };
        plainArrow = (at, e, ...others) => { if (at[1] < view.height - 30) arrows.push(e[0]); old[2](at, e, ...others); };
        fbd.seek(0.05); drawStill();
        [drawWall, drawSpiral, plainArrow] = old;
        return [walls, spirals, arrows];""")
    with claim("the walls of a slide stand where its body stops"):
        for wall, want in zip(walls, ((-0.4 - 0.15, -1), (0.5 + 0.15, 1))):
            close(wall[0], want[0], 1e-9)
            close(wall[2], want[1], 1e-9)
    with claim("those of a pivot at its limits, on the body that carries it, hatched on the far side"):
        x = browser.run("return fbd.value('cart.x', 0.05)")
        for wall, limit, sign in zip(walls[2:], (30, 120), (-1, 1)):
            close(math.degrees(math.atan2(wall[1] - 0.1, wall[0] - x)), limit, 1e-9)
            beyond = math.radians(limit + sign * 90)
            close(wall[2] * math.cos(beyond) + wall[3] * math.sin(beyond), 1, 1e-12)
    with claim("a spring about an axis is at the body that lists it, and a surface that runs has arrows in its direction"):
        assert len(walls) == 4 and spirals == ["flap"], (walls, spirals)
        assert arrows and all(way == -1 for way in arrows), arrows
    with claim("an actuator between two points is drawn between them, where they are"):
        ram = folder / "ram.html"
        run("--quiet", "--html", ram, MODELS / "couplings/ram_on_a_cart.yaml")
        browser.open(ram)
        ends = browser.run("""const old = drawRam, found = []; drawRam = (a, b, at) => { found.push(a, b); old(a, b, at); };
            fbd.seek(0.4); drawRam = old; return found.map(([x, y]) => [(x - view.x) / view.scale, (view.y - y) / view.scale]);""")
        x, theta = browser.run("return [fbd.value('cart.x', 0.4), fbd.value('boom.theta', 0.4)]")
        for end, want in zip(ends, ((x, -0.6), (x + 0.8 * math.cos(theta), 0.8 * math.sin(theta)))):
            close(math.dist(end, want), 0, 1e-6)
        browser.open(path)
        browser.run("fbd.seek(0.05)")
    with claim("the limits and the speed are written"):
        texts = browser.run("return drawn.labels.map(({ text }) => text)")
        assert {"x ≥ −0.4 m", "x ≤ 0.5 m", "θ ≥ 30°", "θ ≤ 120°", "0.5 m/s"} <= set(texts), texts
    with claim("a page with stops is quiet and asks for nothing"):
        page_is_quiet(browser, path)


def check_early_end(browser, folder):
    model, path = MODELS / "hard/not_a_number_beyond.yaml", folder / "early.html"
    outcome = json.loads(run("--json", "-", "--html", path, model, code=1))
    browser.open(path)
    with claim("the page of a run that failed says why, and plays what there is"):
        assert outcome["reason"]
        assert outcome["reason"] in browser.run("return document.getElementById('summary').textContent")
        assert browser.run("fbd.seek(1e9); return fbd.player.t") == outcome["final"]["t"] > 0
    with claim("quietly"):
        page_is_quiet(browser, path)


def check_all(browser, folder):
    """Every model has a page that plays, and a run of no length has one as well. A twelfth of them in the tests: a
    page takes a second. All with FBD_ALL_PAGES=1 (`make pages`), as after a change of the page."""
    gallery = [(model, []) for model in sorted(MODELS.glob("*/*.yaml")) if model.parent.name != "hard"]
    gallery = gallery if os.environ.get("FBD_ALL_PAGES") else gallery[::12]
    wrong, crowded = {}, {}
    for model, options in [*gallery, (INCLINE, ["--until", "0"]), (INCLINE, ["--until", "1e9"])]:
        path = folder / f"{model.stem}.html"
        run("--quiet", "--html", path, *options, model)
        browser.open(path)
        plots, strange = browser.run("""fbd.seek(run.end * 0.3); fbd.setPlaying(true);
            const before = fbd.player.frames; while (fbd.player.playing && fbd.player.frames === before) await new Promise((done) => setTimeout(done, 10));
            fbd.setPlaying(false);
            return [charts.length, charts.filter((c) => c.graph && !c.graph.yAxisRange().every(Number.isFinite)).length];""")
        if faults := browser.run(CROWDING):
            crowded[model.stem] = faults
        console = browser.log("browser")
        if not plots or strange or console:
            wrong[model.stem] = (plots, strange, console)
    with claim(f"the pages of {len(gallery)} models play and plot, without a word on the console"):
        assert not wrong, wrong
    with claim("at ten times of each no label lies on another, and no label and no arrow leaves the scene"):
        assert not crowded, crowded


def check_text_is_data(browser, folder):
    model, path = folder / "special.yaml", folder / "special.html"
    model.write_text(SPECIAL, encoding="utf-8")
    run("--quiet", "--html", path, "--svg", folder / "special.svg", model)
    browser.open(path)
    title = "</script><script>alert(1)</script> & <b>bold</b> 'q' \u2028"
    with claim("markup in a title stays text"):
        shown = title.replace("\u2028", "\\u2028")  # what would break a line is written out
        assert browser.run("return document.getElementById('title').textContent") == shown
        assert browser.run("return document.querySelectorAll('#title *').length") == 0
        assert browser.run("return document.title").startswith("</script><script>alert(1)")
    with claim("and nothing of it runs"):
        page_is_quiet(browser, path)
    with claim("so it does in the diagram"):
        browser.open(folder / "special.svg")
        assert browser.run("return document.querySelectorAll('script, b').length") == 0
        assert "<script>alert(1)" in browser.run("return document.querySelector('text').textContent")


def check_many(browser, folder):
    model, path = folder / "many.yaml", folder / "many.html"
    many_bodies(model)
    run("--quiet", "--html", path, model)
    with claim("the page of 200 bodies is below 5 MB"):
        assert path.stat().st_size < 5e6, path.stat().st_size
    browser.open(path)
    with claim("it plays"):
        browser.run("fbd.player.frames = 0; fbd.player.drawing = 0; fbd.setPlaying(true);")
        wait_for(browser, f"fbd.player.frames > {30 if os.environ.get('FBD_ALL_PAGES') else 10}")
        spent = browser.run("fbd.setPlaying(false); return fbd.player.drawing / fbd.player.frames;")
        print(f"# 200 bodies: {spent:.2f} ms of drawing a frame (60 frames a second leave 16.7)")
    with claim("a choice of bodies brings their equations and plots"):
        found = browser.run("""const list = document.getElementById('body'), found = [];
            for (const choice of ['7', '-1']) {
              list.value = choice; list.dispatchEvent(new Event('change'));
              found.push([document.querySelectorAll('#equations table').length, document.querySelectorAll('.chart').length]);
            } return found;""")
        assert found[1][0] == 200 and found[0][0] == 1 and found[1][1] > 200 > 20 > found[0][1], found
    with claim("a plot that comes into sight has the values of the cursor's time"):
        last = "charts.filter((chart) => chart.graph).pop()"
        wait_for(browser, f"{last}.unseen")
        browser.run(f"fbd.seek(3.21); {last}.box.scrollIntoView();")
        wait_for(browser, f"!{last}.unseen")
        text, value = browser.run(f"return [{last}.values[0].data, show(fbd.value('energy.kinetic', 3.21))]")
        assert text.startswith(f"energy.kinetic = {value} "), (text, value)
    with claim("the page of 200 bodies is quiet"):
        page_is_quiet(browser, path)


def check_long(browser, folder):
    """Over a million steps, with a short pulse that only one row in a thousand could show."""
    model, path = folder / "long.yaml", folder / "long.html"
    model.write_text("""fbd: 1
bodies:
  pendulum:
    shape: rod
    mass: 1 kg
    length: 1 m
    motion: {pivot: {at: [0, 0], point: left}}
    forces: [gravity]
    moments:
      - applied: {name: pulse, value: "if(t > 20000[s] and t < 20000.01[s], 5[N*m], 0[N*m])"}
simulate:
  until: 60000 s
  events: [{name: never_lost, when: "t = 12345.678[s]"}]
""", encoding="utf-8")
    steps = json.loads(run("--no-structure", "--json", "-", "--html", path, model))["stats"]["steps"]
    with claim(f"a run of {steps} steps (at least a million) makes a page below 5 MB"):
        assert steps > 1e6 and path.stat().st_size < 5e6, (steps, path.stat().st_size)
    browser.open(path)
    with claim("the plot of the whole run still has the pulse's height"):
        most = browser.run("""const c = fbd.run.columns.findIndex((column) => column.n === 'pendulum.pulse');
            return Math.max(...chartRows([c], fbd.run.start, fbd.run.end).map((row) => row[1]));""")
        close(most, 5, 1e-6)
    with claim("and the events are all there"):
        times = browser.run("return fbd.run.events.times")
        for t in (12345.678, 20000, 20000.01):
            assert any(abs(t - other) < 1e-6 for other in times), t
    with claim("the extremes of the angle over the run are kept to four digits"):
        # released from rest, horizontal: it swings from 0 to -180 degrees
        low, high = browser.run("""const c = fbd.run.columns.findIndex((column) => column.n === 'pendulum.theta');
            const rows = chartRows([c], 0, 19000).map((row) => row[1]); return [Math.min(...rows), Math.max(...rows)];""")
        close(low, -3.141592653589793, 3e-4)
        close(high, 0, 3e-4)
    with claim("the long page is quiet"):
        page_is_quiet(browser, path)


def main():
    try:
        with Browser() as browser, tempfile.TemporaryDirectory() as name:
            browser.open("/dev/null")
            browser.requests()  # those of the browser's first page
            browser.log("browser")
            for check in (check_incline, check_pendulum, check_joined, check_couplings, check_guides, check_running, check_early_end, check_all,
                          check_text_is_data, check_many, check_long):
                check(browser, Path(name))
    except Missing as missing:
        skip(str(missing))
    finish()


if __name__ == "__main__":
    main()
