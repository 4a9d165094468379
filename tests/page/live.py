#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The live page in a headless Chromium: what runs in the page is what fbd-run says, sliders move it by mouse and keyboard,
the editor marks what is wrong where it is, effects go off and on, links carry what is shown, and nothing is asked for.
Skipped where the library for browsers has not been made (`make live`)."""
import csv
import json
import math
import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
import limits  # noqa: E402
from browser import Browser, Missing  # noqa: E402
from claims import claim, close, finish, skip  # noqa: E402
from fbd import MODELS, result, run, table  # noqa: E402

INCLINE = MODELS / "kinetics/incline.yaml"
PENDULUM = MODELS / "rotation/compound_pendulum.yaml"
SAME = 1e-9  # of the largest size of a column: sin, cos and exp of the two C libraries differ in the last digit
LARGEST = 2000000  # bytes of a page
QUICK = 50  # ms from the slider to the scene and the numbers beside it; the plots follow
# What grows such differences: their coordinates and rates are held to SIMILAR of the largest. Forces are not where a
# mechanism passes through a position that says nothing of them (n_four_bar).
SIMILAR = 1e-3
MOTION = ("[m]", "[rad]", "[m/s]", "[rad/s]")
CHAOTIC = {"double_pendulum", "chain_of_ten_rods", "n_four_bar", "andrews_squeezer", "dominoes", "woodpecker"}
# Balls in a row touch exactly: whether one opens and closes at the instant of an impact is a matter of the last bit.
UNDECIDED = {"cradle"}
SLOW = {"million_revolutions", "long_pendulum"}  # minutes in a browser on a busy machine

WORKER = """
    const asked = arguments[0], client = makeClient(() => {});
    const answer = await new Promise((done) => client.request(asked, [bench.own, parts.name, ""], done));
    client.worker.terminate();
    return answer;"""


def wait_for(browser, condition):
    end = time.monotonic() + limits.WAIT
    while not browser.run(f"return {condition}"):
        assert time.monotonic() < end, f"never: {condition}; it says {browser.run('return element(`live-says`).textContent')}"
        time.sleep(0.02)


def live_page(folder, model, *options):
    path = folder / f"{Path(model).stem}.html"
    run("--quiet", "--html", path, "--live", *options, model, code=None)
    return path


def open_live(browser, path, fragment=""):
    browser.open(path, fragment)
    wait_for(browser, "typeof bench === 'object' && bench.shown > 0")


def settled(browser, action, *arguments):
    """Does something to the page, and waits until what it asked for is shown."""
    before = browser.run(f"const before = bench.shown; {action}; return before;", *arguments)
    wait_for(browser, f"bench.shown > {before} && !bench.runner.busy && !bench.runner.waiting")


def is_quiet(browser, path):
    console = browser.log("browser")
    assert console == [], console
    foreign = [address for address in browser.requests()
               if not address.startswith((path.parent.as_uri(), "data:", "blob:", "chrome:"))]
    assert foreign == [], foreign


def numbers_of(text):
    rows = list(csv.reader(text.splitlines()))
    return rows[0], [[float(cell) for cell in row] for row in rows[1:]]


def same_motion(browser, model):
    """The CSV that the worker writes, beside that of fbd-run."""
    chaotic = model.stem in CHAOTIC
    tolerance = SIMILAR if chaotic else SAME
    want_head, want = numbers_of(run("--csv", "-", "--ledger", model, code=None))
    head, rows = numbers_of(browser.run(WORKER, "csv"))
    assert head == want_head
    assert len(rows) == len(want), (len(rows), len(want))
    worst = (0, "")
    for k, name in enumerate(head):
        # a residual is what is left of the energies, a force that cancels is measured by the largest one with its unit
        unit = name[name.rfind("["):]
        if chaotic and unit not in MOTION:
            continue
        least = 1 if unit in ("[rad]", "[rad/s]") else 0  # angles are counted from anywhere, over seconds
        size = max((abs(row[i]) for row in want for i, other in enumerate(head) if other.endswith(unit)), default=0)
        size = max(size, least) or 1
        worst = max(worst, (max(abs(a[k] - b[k]) for a, b in zip(rows, want)) / size, name))
    assert worst[0] <= tolerance, worst
    return rows == want


def same_events(browser, model):
    got = browser.run("return run.events.times.map((t, i) => [t, eventLabel(i).kind])")
    want = [[event["t"], event["kind"]] for event in json.loads(run("--json", "-", model, code=None))["events"]]
    assert [kind for _, kind in got] == [kind for _, kind in want][:len(got)], (got[:5], want[:5])
    for (t, _), (u, _) in zip(got, want):
        close(t, u, SAME * max(abs(u), 1))


def check_models(browser, folder, share):
    models = sorted(MODELS.glob("*/*.yaml"))
    equal = 0
    for number, model in enumerate(models):
        if number % share or (model.stem in SLOW and share > 1):
            continue
        with claim(f"{model.stem}: the live run has the events and numbers of fbd-run"):
            path = live_page(folder, model)
            assert path.stat().st_size <= LARGEST, path.stat().st_size
            open_live(browser, path)
            if model.stem not in CHAOTIC | UNDECIDED:
                same_events(browser, model)
            equal += same_motion(browser, model)
            is_quiet(browser, path)
    print(f"# {equal} of the CSV are the same byte for byte")


SLIDER = "const slider = document.querySelector('[aria-label=\"{0}, slider\"]');"


def check_sliders(browser, folder):
    path = live_page(folder, INCLINE)
    open_live(browser, path)
    with claim("every parameter has a slider, with its unit, and so have initial values and the end"):
        names = browser.run("return [...document.querySelectorAll('#live .knob')].map((row) => row.firstChild.textContent + ' ' + row.lastChild.value)")
        for name in ("phi 30 deg", "mu_s 0.5", "v0 3 m/s", "block.x 0 m", "block.v v0", "until 3 s"):
            assert name in names, (name, names)
    with claim("every control is 24 pixels high at least, also where it is folded away"):
        small = browser.run("for (const part of document.querySelectorAll('details')) part.open = true; "
                            "return [...document.querySelectorAll('button, select, input, summary')].map((node) => [node.id || node.ariaLabel || node.textContent, "
                            "node.getBoundingClientRect().height]).filter(([, height]) => height > 0 && height < 24);")
        assert not small, small
    with claim("a slider that is dragged by the mouse runs the model anew, and writes into its text"):
        box = browser.run(SLIDER.format("phi") + "slider.scrollIntoView(); const r = slider.getBoundingClientRect(); return [r.left, r.top, r.width, r.height];")
        before = browser.run("return bench.shown")
        browser.click(box[0] + 0.25 * box[2], box[1] + box[3] / 2)
        wait_for(browser, f"bench.shown > {before} && !bench.runner.busy")
        phi = browser.run("return /phi: \\{value: (.*? deg)/.exec(editor.value)[1]")
        assert 10 < float(phi.split()[0]) < 20, phi
        want = result("--set", f"phi={phi}", INCLINE)
        close(browser.run("return fbd.value('block.x', run.end)"), want["final"]["block"]["x"], 1e-9)
    with claim("the arrows of the keyboard move it by a step"):
        browser.run(SLIDER.format("phi") + "slider.focus();")
        before = browser.run("return bench.shown")
        browser.press("\ue014")
        wait_for(browser, f"bench.shown > {before} && !bench.runner.busy")
        after = float(browser.run("return /phi: \\{value: (.*?) deg/.exec(editor.value)[1]"))
        assert 0 < after - float(phi.split()[0]) < 1, (phi, after)
    with claim("the command line that it shows gives the same end"):
        words = browser.run("return element('live-command').textContent")
        assert words.startswith("fbd-run --set 'phi=") and words.endswith("incline.yaml"), words
    with claim("a slider of an initial value that the file does not give writes one"):
        settled(browser, "setModel(bench.own, [])")
        settled(browser, "moved('initial.block.x', '0.5 m')")
        assert browser.run("return /initial: .*x: 0.5 m/.test(editor.value)"), browser.run("return editor.value")
        close(browser.run("return fbd.value('block.x', 0)"), 0.5, 0)
    with claim("a slider moves while a run is under way, and the last place counts"):
        settled(browser, "setModel(bench.own, [])")
        settled(browser, SLIDER.format("phi") + "for (const v of [10, 20, 40]) { slider.value = v; slider.dispatchEvent(new Event('input')); }")
        close(browser.run("return fbd.value('block.x', run.end)"), result("--set", "phi=40 deg", INCLINE)["final"]["block"]["x"], 1e-9)
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


# The centre of mass of the first body at the start, in the window.
CENTER = """canvas.scrollIntoView({ block: 'center' }); fbd.seek(run.start); const r = canvas.getBoundingClientRect(), body = run.bodies[0];
    const [x, y] = toScreen(place(frameAt(body, run.start, 0), ...body.G)); return [r.left + canvas.clientLeft + x, r.top + canvas.clientTop + y];"""


def check_pull(browser, folder):
    path = live_page(folder, PENDULUM)
    open_live(browser, path)
    with claim("at the start a pendulum is dragged to another angle, by mouse and by finger"):
        for pointer, turn in (("mouse", 0.5), ("touch", -0.8)):
            x, y = browser.run(CENTER)
            theta, pin = browser.run("return [fbd.value('pendulum.theta', 0), (() => { const r = canvas.getBoundingClientRect(), f = frameAt(run.bodies[0], 0, 0), "
                                     "[x, y] = toScreen([f.x, f.y]); return [r.left + canvas.clientLeft + x, r.top + canvas.clientTop + y]; })()]")
            arm, angle = math.hypot(x - pin[0], pin[1] - y), math.atan2(pin[1] - y, x - pin[0])
            places = [(pin[0] + arm * math.cos(angle + turn * k / 4), pin[1] - arm * math.sin(angle + turn * k / 4)) for k in range(5)]
            before = browser.run("return bench.shown")
            browser.drag(places, pointer)
            wait_for(browser, f"bench.shown > {before} && !bench.runner.busy && !bench.runner.waiting")
            close(browser.run("return fbd.value('pendulum.theta', 0)"), theta + turn, 1.5 / arm + 0.01)  # whole pixels, steps of the slider
        written = float(browser.run("return /theta0: \\{value: (.*?) deg/.exec(editor.value)[1]"))
        close(browser.run("return fbd.value('pendulum.theta', 0)"), math.radians(written), 1e-12)
    path = live_page(folder, INCLINE)
    open_live(browser, path)
    with claim("a block is dragged along its slide only, and a drag beside it moves the view"):
        x, y = browser.run(CENTER)
        scale, pan = browser.run("return [view.scale, view.pan]")
        before = browser.run("return bench.shown")
        browser.drag([(x, y), (x + 20, y), (x + 40, y)])
        wait_for(browser, f"bench.shown > {before} && !bench.runner.busy && !bench.runner.waiting")
        close(browser.run("return fbd.value('block.x', 0)"), 40 * math.cos(math.radians(30)) / scale, 0.01)
        assert browser.run("return view.pan") == pan
        box = browser.run("const r = canvas.getBoundingClientRect(); return [r.left, r.top]")
        browser.drag([(box[0] + 60, box[1] + 40), (box[0] + 80, box[1] + 60)])
        assert browser.run("return view.pan") == [pan[0] + 20, pan[1] + 20]
    with claim("at a later time a drag on a body moves the view as well"):
        browser.run("document.getElementById('zoom-all').click();")
        x, y = browser.run(CENTER)
        browser.run("fbd.seek(0.001);")
        text = browser.run("return editor.value")
        browser.drag([(x, y), (x + 30, y)])
        assert browser.run("return [view.pan[0], editor.value]") == [30, text]
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


# A place of the canvas, in the window.
WINDOW = "const box = canvas.getBoundingClientRect(), windowed = ([x, y]) => [box.left + canvas.clientLeft + x, box.top + canvas.clientTop + y];"
SAVED = "return new Promise((done) => savedText(done))"


def check_hand(browser, folder):
    path = live_page(folder, PENDULUM)
    open_live(browser, path)
    saved = folder / "pulled.yaml"
    with claim("a body is pulled while the page plays: the spring is drawn, and is a force of the model with arrow, term and work"):
        x, y = browser.run(WINDOW + "setSpeed(0.1); fbd.seek(0.5); const f = frameAt(run.bodies[0], 0.5, rowAt(0.5)); setPlaying(true); "
                           "return windowed(toScreen(place(f, ...run.bodies[0].G)));")
        browser.drag([(x, y), (x + 60, y + 20)], release=False)
        wait_for(browser, "run.columns.some((column) => column.n.startsWith('pendulum.pull')) && drawn.arrows.some((arrow) => arrow[5] === 'pendulum:pull')")
        assert browser.run("return run.links.some((link) => link.pulls) && player.playing")
        assert "the hand pulls with" in browser.run("return element('live-says').textContent")
        assert browser.run("return [...document.querySelectorAll('#equations .formula [data-arrow=\"pendulum:pull\"]')].length") == 2
        before = browser.run("return bench.shown")
        browser.drag([(x + 120, y - 60)], press=False, release=False)
        wait_for(browser, f"bench.shown > {before}")
    with claim("after the release the motion goes on, and what runs is what is saved: fbd-run has the same end and the same work of the hand"):
        browser.drag([(x + 120, y - 60)], press=False)
        wait_for(browser, "!pull.at && !bench.runner.busy && !bench.runner.waiting && player.playing")
        assert "has let go" in browser.run("return element('live-says').textContent") and not browser.run("return run.links.length")
        browser.run("setPlaying(false)")
        saved.write_text(browser.run(SAVED), encoding="utf-8")
        rows = table(saved)
        close(browser.run("return fbd.value('pendulum.theta', run.end)"), rows[-1]["pendulum.theta"], SAME)
        work = browser.run("const { work } = run.bodies[0].arrows.find(({ name }) => name === 'pull'); return [run.columns[work].n, valueAt(work, run.end, run.rows - 1)];")
        assert work[0] == "pendulum.pull.work", work
        close(work[1], rows[-1]["pendulum.pull.work"], 1e-6 * max(1, abs(work[1])))  # seven digits in the page
        assert abs(work[1]) > 1e-3, work
    with claim("derivations by hand, which have no pull, have become comments"):
        assert "# hand:" in browser.run("return editor.value")
    with claim("keys pull as well: g grabs and lets go, arrows move the hand"):
        settled(browser, "setModel(bench.own, [])")
        browser.run("setSpeed(0.1); fbd.seek(0.5); setPlaying(true); canvas.focus();")
        browser.press("g")
        browser.press("\ue014")
        wait_for(browser, "pull.at && drawn.arrows.some((arrow) => arrow[5] === 'pendulum:pull')")
        browser.press("g")
        wait_for(browser, "!pull.at && !bench.runner.busy && !bench.runner.waiting")
        assert browser.run("setPlaying(false); return /name: pull,/.test(editor.value)")
        browser.press("g")
        assert browser.run("return pull.at === null && element('live-says').textContent === phrase('live-pull-plays')")
    with claim("a body whose motion is prescribed cannot be pulled, which is said by its name"):
        open_live(browser, live_page(folder, MODELS / "couplings/driven_slider_crank.yaml"))
        browser.run("setSpeed(0.01); fbd.seek(0.001); setPlaying(true); canvas.focus();")
        browser.press("g")
        browser.press("\ue014")
        wait_for(browser, "element('live-says').lang === 'en'")
        said = browser.run("return [element('live-says').textContent, /pull/.test(editor.value)]")
        assert said == ["`crank` cannot be pulled: its motion is prescribed", False], said
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


def check_grips(browser, folder):
    path = live_page(folder, INCLINE)
    open_live(browser, path)
    with claim("a weight dragged to 3/2 of its arrow is that of 3/2 of the mass: text, slider and forces follow"):
        tail, tip = browser.run(WINDOW + "fbd.seek(0.2); const [x1, y1, x2, y2] = drawn.arrows.find((arrow) => arrow[5] === 'block:gravity'); "
                                "return [windowed([x1, y1]), windowed([x2, y2])];")
        before = browser.run("return bench.shown")
        end = [t + 1.5 * (p - t) for t, p in zip(tail, tip)]
        browser.drag([tip, [(a + b) / 2 for a, b in zip(tip, end)], end])
        wait_for(browser, f"bench.shown > {before} && !bench.runner.busy && !bench.runner.waiting")
        mass = float(browser.run("return /mass: (.*?) kg/.exec(editor.value)[1]"))
        close(mass, 3, 3 / math.dist(tail, tip) + 0.05)  # whole pixels, steps of the slider
        assert browser.run("return knobs.get('masses.block').box.value") == f"{mass:g} kg"
        close(browser.run("return fbd.value('block.gravity', 0.2)"), -mass * 9.81 * math.sin(math.radians(30)), 1e-5)
    with claim("a slope turns with the pointer, and the parameter of its angle follows"):
        settled(browser, "setModel(bench.own, [])")
        foot, at = browser.run(WINDOW + "const { through, along, normal } = run.bodies[0].line; for (let away = 60; ; away += 5) { "
                               "const [x, y] = toScreen(through), p = [x - away * along[0] - 12 * normal[0], y + away * along[1] + 12 * normal[1]]; "
                               "if (gripOfSlope(p, 8) && !gripAt(p, 0)) return [windowed([x, y]), windowed(p)]; if (away > 900) return [[], away]; }")
        before, arm, angle = browser.run("return bench.shown"), math.dist(foot, at), math.atan2(foot[1] - at[1], at[0] - foot[0])
        browser.drag([at, *[(foot[0] + arm * math.cos(angle + turn), foot[1] - arm * math.sin(angle + turn)) for turn in (0.05, 0.1, 0.15)]])
        wait_for(browser, f"bench.shown > {before} && !bench.runner.busy && !bench.runner.waiting")
        phi = float(browser.run("return /phi: \\{value: (.*?) deg/.exec(editor.value)[1]"))
        close(math.radians(phi), math.radians(30) + 0.15, 1.5 / arm + math.radians(0.25))
        close(browser.run("const { along } = run.bodies[0].line; return Math.atan2(along[1], along[0])"), math.radians(phi), 1e-12)
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


def check_language(browser, folder):
    path = live_page(folder, INCLINE)
    texts = json.loads((Path(os.environ["FBD_SOURCE_ROOT"]) / "lib/live/page/live-texts.json").read_text(encoding="utf-8"))
    with claim("live pages have the same texts in all languages, with the same places for values"):
        assert list(texts["de"]) == list(texts["en"])
        for key, text in texts["en"].items():
            places = [mark for mark in ("{0}", "{1}", "{2}", "{3}", "{4}") if mark in text]
            assert all(mark in texts["de"][key] for mark in places), key
    open_live(browser, path)
    with claim("the switch of the language changes the texts of the live panel"):
        browser.run("element('language').value = 'de'; element('language').dispatchEvent(new Event('change'))")
        for node, key in (("#live-save", "live-save"), ("#live legend", "live-simulated"), ("#live-costs summary", "live-costs")):
            assert browser.run(f"return document.querySelector('{node}').textContent") == texts["de"][key], key
        assert browser.run("return element('live').getAttribute('aria-label')") == texts["de"]["live-change"]
        assert browser.run("return [...document.querySelectorAll('#live .knob input[type=range]')].every((input) => /Schieber$/.test(input.getAttribute('aria-label')))")
        assert browser.run("return element('live-says').textContent").startswith("gelaufen in ")
    with claim("messages of the library stay English, are marked so, and the page says it"):
        assert browser.run("return document.querySelector('[data-text=live-messages]').textContent") == texts["de"]["live-messages"]
        browser.run("setEditor(bench.own.replace('gravity:', 'gravty:')); editor.dispatchEvent(new Event('input'))")
        wait_for(browser, "document.querySelector('#live-notes button')")
        assert browser.run("return element('live-notes').lang") == "en"
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


def check_editor(browser, folder):
    path = live_page(folder, PENDULUM)
    open_live(browser, path)
    with claim("what is wrong in the text is marked where it is, with what to write; the picture stays"):
        settled(browser, "setEditor(editor.value.replace('gravity', 'gravty')); editor.dispatchEvent(new Event('input'))")
        note = browser.run("return [document.querySelector('#live-notes button').textContent, document.querySelector('#live-marks mark').textContent]")
        assert "gravty" in note[0] and ": error: " in note[0] and note[1] == "gravty", note
        assert browser.run("return run.bodies.length") == 1
    with claim("a click on the note goes there"):
        browser.run("document.querySelector('#live-notes button').click()")
        assert browser.run("return editor.value.slice(editor.selectionStart, editor.selectionEnd)") == "gravty"
    with claim("mended, it runs again"):
        settled(browser, "setEditor(bench.own); editor.dispatchEvent(new Event('input'))")
        assert browser.run("return element('live-notes').childElementCount") == 0
    with claim("keys belong to the editor while one types"):
        browser.run("editor.focus()")
        browser.press(" ")
        assert not browser.run("return fbd.player.playing")
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


# Beginnings of texts, and words that may follow; or, behind a blank, words that may not.
FOLLOWING = {
    "bod": "bodies", "bodies:\n  a:\n    mo": "motion moments", "bodies:\n  a:\n    motion: ": "slide pivot", "bodies:\n  a:\n    motion: {slide: {": "along min max",
    "bodies:\n  a:\n    shape: ": "rod disc", "bodies:\n  a:\n    forces: [gravity, friction: {st": "static", "bodies:\n  a:\n    forces:\n      - gravity\n      - fr": "friction",
    "couplings:\n- gear: {name: x}\n- ro": "rod rope roll", "couplings:\n- gear: {name: x}\nsi": "simulate", "units: ": "SI US", "fbd: 1\n\n# of no matter: {\nun": "units",
    "simulate: {until: 3 s, events: [{name: 'a, [b', when: x > 1, then: ": "stop go_on",
}
WORDS = "const [text] = arguments, { word, from } = wordAt(text, text.length, false), { path: trail, value } = pathAtEnd(text.slice(0, from)); " \
        "return wordsOf(schemaAt(trail), !value).map((other) => other.word).filter((other) => other.startsWith(word));"


def check_hints(browser, folder):
    path = live_page(folder, INCLINE)
    open_live(browser, path)
    wait_for(browser, "hints.schema")
    with claim("the words that may follow are those of the schema at this place"):
        for text, words in FOLLOWING.items():
            assert set(words.split()) <= set(found := browser.run(WORDS, text)), (text, found)
        assert browser.run(WORDS, "bodies:\n  a:\n    motion: res") == []
    with claim("a word that is begun is listed with its meaning, and written by arrow and Enter; Enter alone begins a line"):
        browser.run("editor.focus(); const at = editor.value.indexOf('- gravity') + 9; editor.setSelectionRange(at, at)")
        browser.type("\n      - dra")
        assert browser.run("return hints.list.map(({ word }) => word)") == ["drag"]
        assert "drag" in browser.run("return document.querySelector('#live-words li').textContent")
        browser.press("\ue007")
        assert browser.run("return editor.value.includes('- dra\\n') && element('live-words').hidden")
        browser.press("\ue003")
        browser.press("\ue003")
        browser.type("a")
        browser.press("\ue015")
        browser.press("\ue007")
        assert browser.run("return editor.value.includes('- drag: ')"), browser.run("return editor.value")
    with claim("what the key means whose value is typed stands under the text"):
        assert browser.run("return element('live-hint').textContent").startswith("drag: ")
    with claim("Ctrl and Space list all that may stand at the caret, Tab takes the first, a click another one, Escape closes the list"):
        browser.type("{")
        browser.chord("\ue009", " ")
        assert browser.run("return hints.list.some(({ word }) => word === 'quadratic')")
        browser.press("\ue004")
        assert browser.run("return /- drag: \\{\\w+: /.test(editor.value) && document.activeElement === editor")
        browser.type("a, ")
        browser.chord("\ue009", " ")
        box = browser.run("const r = document.querySelector('#live-words li:nth-child(2)').getBoundingClientRect(); return [r.left + 10, r.top + 8]")
        word = browser.run("return hints.list[1].word")
        browser.click(*box)
        assert browser.run("return editor.value.slice(0, editor.selectionStart)").endswith(f"{word}: ")
        browser.chord("\ue009", " ")
        browser.press("\ue00c")
        assert browser.run("return element('live-words').hidden && document.activeElement === editor")
    with claim("under the pointer a key has its meaning, and in a comment there is none"):
        settled(browser, "setModel(bench.own, [])")
        for word, want in (("mass:", "mass: "), ("range:", "range: "), ("A block", browser.run("return phrase('live-hints')"))):
            x, y = browser.run("element('live-model').scrollIntoView(); const row = editor.value.slice(0, editor.value.indexOf(arguments[0])).split('\\n'), [w, h, pad] = editorGrid(); "
                               "editor.scrollTop = h * (row.length - 4); const r = editor.getBoundingClientRect(); "
                               "return [r.left + pad + w * (row.at(-1).length + 1.5), r.top + pad + h * (row.length - 0.5) - editor.scrollTop];", word)
            browser.drag([(x, y)], press=False, release=False)
            said = browser.run("return element('live-hint').textContent")
            assert said.startswith(want), (word, said)
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


def check_wrong(browser, folder):
    path = live_page(folder, INCLINE)
    open_live(browser, path, "#m=nothing-of-a-model")
    enter = "const { box } = knobs.get(arguments[0]); box.value = arguments[1]; box.dispatchEvent(new Event('change'))"
    with claim("a link that is none shows the page's own model"):
        assert browser.run("return editor.value === bench.own")
    with claim("a box with what is no value says it, is marked, and gets the last value back when it is emptied"):
        for text, said in (("abc", "nothing is called `abc` here"), ("100 deg", "this is no range for `phi`")):
            settled(browser, enter, "parameters.phi", text)
            assert browser.run("return [element('live-says').textContent, knobs.get('parameters.phi').box.getAttribute('aria-invalid')]") == [said, "true"]
        settled(browser, enter, "parameters.phi", "")
        assert browser.run("return [editor.value === bench.own, knobs.get('parameters.phi').box.getAttribute('aria-invalid')]") == [True, "false"]
    with claim("a value far off makes a range, which goes with it"):
        whole = browser.run("return knobs.get('until').range")
        settled(browser, enter, "until", "1e6 s")
        settled(browser, "setModel(bench.own, [])")
        assert browser.run("return knobs.get('until').range") == whole
    with claim("a note of a text that is no model says what is wrong"):
        settled(browser, "setEditor(bench.own.replace('{slide:', '{slid:')); editor.dispatchEvent(new Event('input'))")
        browser.run("element('live-says').textContent = ''; element('live-note').click()")
        wait_for(browser, "element('live-says').textContent.includes('`slid`')")
        settled(browser, "setModel(bench.own, [])")
    verdict = "[element('live-checked').textContent, [...document.querySelectorAll('#live-verdict li')].map((item) => [item.className, item.innerText])]"
    with claim("a button compares the derivations in the editor with the assembled equations, as --check-hand"):
        browser.run("element('live-hand').click()")
        wait_for(browser, "document.querySelector('#live-verdict li')")
        said, lines = browser.run(f"return {verdict}")
        assert said == f"{len(lines)} of {len(lines)} equations agree" and all(kind == "right" for kind, _ in lines), (said, lines)
        text = run("--check-hand", INCLINE)
        assert all(" ".join(line.split()) in " ".join(text.split()) for _, item in lines for line in item.removeprefix("✓ ").splitlines()), (lines, text)
    with claim("with another sign it names the equation and its term; the verdict of an earlier text is marked"):
        settled(browser, "setEditor(bench.own.replace(/(m\\*v_dot.*?= )/, '$1-')); editor.dispatchEvent(new Event('input'))")
        assert not browser.run("return element('live-earlier').hidden")
        browser.run("element('live-hand').click()")
        wait_for(browser, "document.querySelector('#live-verdict .wrong')")
        said, lines = browser.run(f"return {verdict}")
        assert browser.run("return element('live-earlier').hidden")
        assert [kind for kind, _ in lines].count("wrong") == 1 and said.startswith(f"{len(lines) - 1} of {len(lines)} "), (said, lines)
        assert "has the wrong sign" in next(text for kind, text in lines if kind == "wrong"), lines
        settled(browser, "setModel(bench.own, [])")
    with claim("an equation whose sides have different dimensions is reported at its place"):
        settled(browser, "setEditor(bench.own.replace(/m\\*v_dot/, 'm*vv_dot')); editor.dispatchEvent(new Event('input'))")
        browser.run("element('live-hand').click()")
        wait_for(browser, "document.querySelector('#live-verdict button')")
        assert "the left side is power" in browser.run("return element('live-verdict').innerText")
        settled(browser, "setModel(bench.own, [])")
    with claim("an answer is graded by the text of the editor, as by --grade"):
        assert browser.run("return element('live-grade').hidden")
        key, answer = folder / "key.yaml", folder / "anna.yaml"
        key.write_text("grading: {reactions: none}\n" + INCLINE.read_text(encoding="utf-8"), encoding="utf-8")
        answer.write_text(INCLINE.read_text(encoding="utf-8").replace("      - gravity\n", "", 1), encoding="utf-8")
        settled(browser, "setEditor(arguments[0]); editor.dispatchEvent(new Event('input'))", key.read_text(encoding="utf-8"))
        assert not browser.run("return element('live-grade').hidden")
        browser.run("const files = new DataTransfer(); files.items.add(new File([arguments[0]], 'anna.yaml')); element('live-answer').files = files.files; "
                    "element('live-answer').dispatchEvent(new Event('change'))", answer.read_text(encoding="utf-8"))
        wait_for(browser, "document.querySelector('#live-verdict li')")
        said, lines = browser.run(f"return {verdict}")
        want = run("--grade", key, answer, code=4).splitlines()[0]
        assert want.startswith(said), (said, want, lines)
        assert "wrong" in [kind for kind, _ in lines]
        settled(browser, "setModel(bench.own, [])")
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


def check_effects(browser, folder):
    path = live_page(folder, INCLINE)
    open_live(browser, path)
    with claim("an effect that is switched off is not simulated: as by --without"):
        settled(browser, "document.querySelector('[data-effect=\"block.friction\"]').click()")
        close(browser.run("return fbd.value('block.x', run.end)"), result("--without", "block.friction", INCLINE)["final"]["block"]["x"], 1e-9)
        assert not browser.run("return run.columns.some((column) => column.n === 'block.friction')")
        assert "--without block.friction" in browser.run("return element('live-command').textContent")
    with claim("what is saved runs the same, with the entry as a comment"):
        text = browser.run("return new Promise((done) => savedText(done))")
        saved = folder / "saved.yaml"
        saved.write_text(text, encoding="utf-8")
        assert any(line.strip().startswith("# - friction") for line in text.splitlines()), text
        close(result(saved)["final"]["block"]["x"], result("--without", "block.friction", INCLINE)["final"]["block"]["x"], 0)
    with claim("a link carries the text and what is off"):
        wait_for(browser, "/#m=/.test(bench.link || '')")
        fragment = browser.run("return '#' + bench.link.split('#')[1]")
        settled(browser, "setModel(bench.own, [])")
        wait_for(browser, "location.hash === ''")
        open_live(browser, path, fragment)
        wait_for(browser, "bench.off.has('block.friction') && bench.runFor === editor.value + offNames()")
        assert not browser.run("return run.columns.some((column) => column.n === 'block.friction')")
    with claim("switched on again, it is there"):
        settled(browser, "document.querySelector('[data-effect=\"block.friction\"]').click()")
        close(browser.run("return fbd.value('block.x', run.end)"), result(INCLINE)["final"]["block"]["x"], 1e-9)
    with claim("method and tolerance are chosen in the page"):
        settled(browser, "element('live-method').value = 'rk4'; element('live-method').dispatchEvent(new Event('change'))")
        assert browser.run("return run.stats.method") == "rk4"
    with claim("what accuracy costs is measured in the page"):
        browser.run("element('live-costs').open = true")
        wait_for(browser, "element('live-diagram').complete && element('live-diagram').naturalWidth > 100")
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


def check_values(browser, folder):
    path = live_page(folder, INCLINE)
    open_live(browser, path)
    with claim("at which value the block slides back is found in the page, marked on its slider, and set by a button"):
        browser.run("element('live-values').open = true; element('live-question').value = 'phi'; element('live-find').requestSubmit()")
        wait_for(browser, "element('live-found').childElementCount > 0")
        want = json.loads(run("--find", "phi", "--json", "-", INCLINE))["solutions"][0]["value"]
        settled(browser, "document.querySelector('#live-found button').click()")
        phi = browser.run("return /phi: \\{value: (.*?) deg/.exec(editor.value)[1]")
        close(math.radians(float(phi)), want, 1e-9)
        close(math.radians(float(browser.run("return document.querySelector('#live-values-marks option').value"))), want, 1e-12)
    with claim("a question that is none is answered by what is wrong"):
        browser.run("element('live-question').value = 'nothing'; element('live-find').requestSubmit()")
        wait_for(browser, "element('live-find-says').className === 'error'")
        assert "nothing" in browser.run("return element('live-find-says').textContent")
    with claim("the calculation note is that of fbd-run"):
        answer = json.loads(browser.run(WORKER, "note"))
        assert answer["errors"] == [] and "Block on an incline" in answer["note"] and "</html>" in answer["note"], answer["errors"]
    with claim("the page is quiet and asks for nothing"):
        is_quiet(browser, path)


def check_set(browser, folder):
    with claim("what the command line sets is where the sliders begin"):
        path = live_page(folder, INCLINE, "--set", "phi=40 deg", "--until", "2")
        open_live(browser, path)
        assert browser.run("return /value: 40 deg/.test(editor.value) && run.end === 2")
    with claim("a model that reads data from a file has it in the page"):
        path = live_page(folder, MODELS / "data/measured_push.yaml")
        open_live(browser, path)
        assert (notes := browser.run("return element('live-notes').textContent")) == "", notes


def check_speed(browser, folder):
    for model, name in ((INCLINE, "parameters.phi"), (PENDULUM, "parameters.theta0")):
        with claim(f"{model.stem}: from the slider to the picture in {QUICK} ms"):
            open_live(browser, live_page(folder, model))
            whole, plots, running, drawing = browser.run("""
                const knob = knobs.get(arguments[0]), whole = [], plots = [], running = [], drawing = [];
                const wait = () => charts.some(({ stale, unseen, box }) => stale && !unseen && box.open);
                for (let i = 0; i < 24; i++) {
                  knob.slider.value = knob.range[0] + (knob.range[1] - knob.range[0]) * (0.3 + 0.02 * i);
                  const before = bench.shown, start = performance.now();
                  knob.slider.dispatchEvent(new Event("input"));
                  while (bench.shown === before) await new Promise((done) => setTimeout(done, 0));
                  whole.push(performance.now() - start);
                  while (wait()) await new Promise((done) => setTimeout(done, 0));
                  plots.push(performance.now() - start);
                }
                const client = makeClient(() => {}), question = [editor.value, parts.name, ""];
                for (let i = 0; i < 24; i++) {
                  const start = performance.now();
                  const [, answer] = await new Promise((done) => client.request("both", question, done, [rowsUnderWay])), asked = performance.now();
                  showAgain(JSON.parse(answer).data);
                  running.push(asked - start);
                  drawing.push(performance.now() - asked);
                }
                client.worker.terminate();
                return [whole, plots, running, drawing].map((list) => list.sort((a, b) => a - b));""", name)
            print(f"# {model.stem}: median {whole[len(whole) // 2]:.0f} ms, least {whole[0]:.0f} ms; of it the run {running[0]:.1f} ms, "
                  f"the scene {drawing[0]:.1f} ms at least; with all plots {plots[len(plots) // 2]:.0f} ms, {plots[0]:.0f} ms")
            # the least of each part; judged by `make live-check` alone, on a machine that has nothing else to do
            if os.environ.get("FBD_ALL_PAGES") and os.getloadavg()[0] < os.cpu_count() + 1:
                assert running[0] + drawing[0] < QUICK, (running, drawing)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        probe = run("--quiet", "--html", folder / "probe.html", "--live", INCLINE, code=None)
        if not (folder / "probe.html").exists():
            skip("this fbd-run has no live pages: make live")
        del probe
        try:
            with Browser(1100, 1000) as browser:
                check_sliders(browser, folder)
                check_pull(browser, folder)
                check_hand(browser, folder)
                check_grips(browser, folder)
                check_language(browser, folder)
                check_editor(browser, folder)
                check_hints(browser, folder)
                check_wrong(browser, folder)
                check_effects(browser, folder)
                check_values(browser, folder)
                check_set(browser, folder)
                check_speed(browser, folder)
                check_models(browser, folder, 1 if os.environ.get("FBD_ALL_PAGES") else 9)
        except Missing as missing:
            skip(str(missing))
    finish()


if __name__ == "__main__":
    main()
