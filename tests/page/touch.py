#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of --html under mouse, fingers, keys and a screen reader, in two languages: arrows are pointed at and picked,
colours mean the same everywhere, controls are large and have names, the scene is told in words."""
import json
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
from browser import Browser, Missing  # noqa: E402
from claims import claim, close, finish, skip  # noqa: E402
from fbd import MODELS, SOURCE, run, table  # noqa: E402
from paper import CONTRAST, SETTLE, page_of  # noqa: E402

INCLINE, STAIRS, CRANK = MODELS / "kinetics/incline.yaml", MODELS / "contact/stairs.yaml", MODELS / "couplings/slider_crank.yaml"
PAGE = SOURCE / "lib/draw/page"
ESCAPE = "\ue00c"

# The middle of an arrow of the scene, in the window.
MIDDLE = """canvas.scrollIntoView({ block: 'center' }); const r = canvas.getBoundingClientRect(), key = arguments[0];
const [x1, y1, x2, y2] = fbd.drawn.arrows.find((arrow) => arrow[5] === key);
return [r.left + canvas.clientLeft + (x1 + 2 * x2) / 3, r.top + canvas.clientTop + (y1 + 2 * y2) / 3];"""
LIT = "return [...document.querySelectorAll('.lit')].map((node) => node.textContent);"
CARD = """return document.getElementById('card').hidden ? null : [document.getElementById('card-title').textContent,
Object.fromEntries([...document.querySelectorAll('#card-table tr')].map((row) => [row.cells[0].textContent, row.cells[1].textContent.replace('−', '-')]))];"""

# Controls that a finger misses (24 pixels either way, WCAG 2.5.8), and ones that have no name.
CONTROLS = """
const found = [], shown = (node) => node.getClientRects().length > 0;
for (const node of [...document.querySelectorAll('button, select, input, summary')].filter(shown)) {
  const { width, height } = node.getBoundingClientRect(), name = node.getAttribute('aria-label') || node.textContent || (node.labels && node.labels[0].textContent);
  if (width < 24 || height < 24) found.push(`${node.id || node.textContent.slice(0, 20)} is ${width} x ${height}`);
  if (!name.trim()) found.push(`${node.tagName} ${node.id} has no name`);
}
return found;
"""
# Rules of axe-core that can be told from the document: names of regions, levels of headings, ids, languages, parents.
STRUCTURE = """
const found = [], ids = [...document.querySelectorAll('[id]')].map((node) => node.id);
if (new Set(ids).size !== ids.length) found.push('an id occurs twice');
for (const node of document.querySelectorAll('section, aside, #scene, [role=img], [role=region]')) if (!node.getAttribute('aria-label')) found.push(`${node.id} has no name`);
const regions = [...document.querySelectorAll('section, aside, [role=region]')].map((node) => node.getAttribute('aria-label'));
if (new Set(regions).size !== regions.length) found.push('two regions have one name');
for (const node of document.querySelectorAll('[aria-describedby]')) if (!document.getElementById(node.getAttribute('aria-describedby'))) found.push('described by nothing');
if (document.querySelectorAll('h1').length !== 1 || document.querySelectorAll('main').length !== 1) found.push('not one h1 and one main');
if (!document.documentElement.lang) found.push('no language');
for (const node of document.querySelectorAll('[tabindex]')) if (node.tabIndex > 0) found.push(`${node.id} is before its turn`);
for (const box of document.querySelectorAll('#equations, #events, .formula'))
  if ((box.scrollHeight > box.clientHeight + 1 || box.scrollWidth > box.clientWidth) && box.tabIndex < 0 && !box.querySelector('button')) found.push(`keys do not scroll ${box.id || box.textContent}`);
return found;
"""


def move(browser, x, y):
    browser._call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [
        {"type": "pointerMove", "x": round(x), "y": round(y)}]}]})


def pinch(browser, middle, before, after):
    """Two fingers beside `middle` move apart."""
    def finger(side):
        at = [{"type": "pointerMove", "x": round(middle[0] + side * apart), "y": round(middle[1])} for apart in (before, (before + after) / 2, after)]
        return {"type": "pointer", "id": f"finger {side}", "parameters": {"pointerType": "touch"},
                "actions": [at[0], {"type": "pointerDown", "button": 0}, *at[1:], {"type": "pointerUp", "button": 0}]}
    browser._call("POST", "/actions", {"actions": [finger(-1), finger(1)]})


def check_arrows(browser, folder):
    browser.open(page_of(INCLINE, folder))
    browser.run("fbd.seek(0.2);")
    with claim("pointing at an arrow marks its terms in the equations and its curves, and nothing else"):
        move(browser, *browser.run(MIDDLE, "block:gravity"))
        marked = browser.run(LIT)
        assert len(marked) >= 4 and all("gravity" in text or text in ("mgsin\u2061(φ)", "9.81") for text in
                                        (t.replace("\u2062", "").replace("\u2009", "") for t in marked)), marked
        move(browser, 5, 5)
        assert browser.run(LIT) == []
    with claim("pointing at a term draws its arrow stronger"):
        before, pointed, after = browser.run("""const ink = () => pen.getImageData(0, 0, canvas.width, canvas.height).data.reduce((sum, v) => sum + 255 - v, 0);
            const row = [...document.querySelectorAll('#equations tr')].find((r) => r.dataset.arrow === 'block:push'), found = [ink()];
            row.dispatchEvent(new PointerEvent('pointerover', { bubbles: true })); found.push(ink());
            element('equations').dispatchEvent(new PointerEvent('pointerleave')); found.push(ink()); return found;""")
        assert pointed > before == after, (before, pointed, after)
    with claim("a click on an arrow shows its name, value, components and work, at the cursor's time"):
        browser.click(*browser.run(MIDDLE, "block:friction"))
        title, numbers = browser.run(CARD)
        row = next(row for row in table("--every", "0.2", INCLINE) if abs(row["t"] - 0.2) < 1e-12)
        size = abs(row["block.friction"])
        assert title == "friction on block", title
        close(float(numbers["magnitude"]), size, 1e-5 * size)
        close(float(numbers["x"]) ** 2 + float(numbers["y"]) ** 2, size ** 2, 1e-4 * size ** 2)
        close(float(numbers["x"]), row["block.friction"] * 3 ** 0.5 / 2, 1e-5 * size)
        close(float(numbers["work"]), browser.run("return readAt(run.bodies[0].arrows.find((a) => a.name === 'friction').work, 0.2, rowAt(0.2))"), 1e-4)
        assert float(numbers["work"]) < 0
    for dark in (False, True):
        browser.dark_mode(dark)
        with claim(f"what is marked, and the numbers, stand out from what is behind them, {'dark' if dark else 'light'}"):
            assert browser.run("return document.querySelectorAll('.lit').length") and (found := browser.run(SETTLE + CONTRAST)) == [], found
    browser.dark_mode(False)
    with claim("its numbers follow the time, and Escape closes them"):
        browser.run("fbd.seek(2);")
        close(float(browser.run(CARD)[1]["magnitude"]), 4.81, 1e-5)
        browser.press(ESCAPE)
        assert browser.run(CARD) is None
    with claim("the key `a` goes from arrow to arrow"):
        browser.run("fbd.seek(0.2); canvas.focus();")
        titles = []
        for _ in range(4):
            browser.press("a")
            titles.append(browser.run(CARD)[0])
        assert sorted(titles) == ["friction on block", "gravity on block", "normal on block", "push on block"], titles
        browser.press(ESCAPE)


def check_fingers(browser, folder):
    browser.resize(390, 844)
    browser.open(page_of(INCLINE, folder))
    middle = browser.run("const r = canvas.getBoundingClientRect(); return [r.left + r.width / 2, r.top + r.height / 2];")
    with claim("a finger that drags moves the scene, not the page"):
        x, y, scroll = browser.run("return [view.x, view.y, scrollY]")
        browser.drag([middle, (middle[0] + 20, middle[1] - 30), (middle[0] + 40, middle[1] - 60)], "touch")
        after = browser.run("return [view.x, view.y, scrollY]")
        assert [after[0] - x, after[1] - y, after[2] - scroll] == [40, -60, 0], (x, y, scroll, after)
    with claim("two fingers zoom about the point between them"):
        before = browser.run("return view.scale")
        pinch(browser, middle, 30, 60)
        after = browser.run("return view.scale")
        close(after / before, 2, 0.1)
        browser.run("document.getElementById('zoom-all').click();")
        close(browser.run("return view.scale"), before, 1e-9 * before)
    with claim("a tap near an arrow shows its numbers, a tap beside all closes them"):
        x, y = browser.run(MIDDLE, "block:gravity")
        browser.drag([(x + 10, y)], "touch")
        assert browser.run(CARD)[0] == "gravity on block"
        browser.drag([browser.run("const r = canvas.getBoundingClientRect(); return [r.left + 30, r.top + 30];")], "touch")
        assert browser.run(CARD) is None
    with claim("the first plot is under the scene, before the tables, as wide as the scene, at 390 and at 1400 pixels"):
        for width in (390, 1400):
            browser.resize(width, 900)
            scene, plot, tables, wide = browser.run(SETTLE + """const top = (id) => document.querySelector(id).getBoundingClientRect();
                return [top('#controls').bottom, top('.chart').top, innerWidth > 800 ? Infinity : top('#equations').top, innerWidth - top('.chart').width];""")
            assert scene <= plot <= (tables or 1e9) and wide < 40, (width, scene, plot, tables, wide)
    browser.resize(1400, 900)


def check_names(browser, folder):
    for model in (INCLINE, STAIRS, CRANK):
        path = page_of(model, folder)
        for width in (1400, 390):
            browser.resize(width, 900)
            browser.open(path)
            with claim(f"{model.stem} at {width} pixels: every control is at least 24 pixels large and has a name"):
                assert (found := browser.run(SETTLE + CONTROLS)) == [], found
            with claim(f"{model.stem} at {width} pixels: regions have names, ids are unique, what scrolls takes keys"):
                assert (found := browser.run(STRUCTURE)) == [], found
    browser.resize(1400, 900)


def check_words(browser, folder):
    browser.open(page_of(INCLINE, folder))
    browser.run("fbd.seek(0.2); canvas.focus();")
    with claim("the scene is told in words: time, bodies, forces with size and direction, the next event"):
        told = browser.run("return document.getElementById(canvas.getAttribute('aria-describedby')).textContent")
        for part in ("Time 0.2 s.", "block: ", "gravity 19.6 N down;", "normal 17 N up and left", "Next event: t = 0.450934 s  block stick"):
            assert part in told, (part, told)
    with claim("an event that keys go to is said at once"):
        browser.press("n")
        said = browser.run("return [document.getElementById('said').getAttribute('role'), document.getElementById('said').textContent]")
        assert said[0] == "status" and "block stick: friction holds" in said[1], said
    with claim("coordinates have the hue of their body, forces that of their arrow, in plots and equations"):
        browser.open(page_of(CRANK, folder))
        wrong = browser.run("""const hue = (node) => node.style.color, found = [];
            for (const { spec, box } of charts) box.querySelectorAll('.legend button').forEach((button, i) => {
              const c = spec.columns[i], body = run.bodies.find((b) => [...b.coordinates, ...b.rates].includes(c));
              const owner = run.bodies.find((b) => b.arrows.some((a) => a.force.includes(c))), arrow = owner && owner.arrows.find((a) => a.force.includes(c));
              if (body && hue(button) !== `var(--curve-${run.bodies.indexOf(body)})`) found.push(button.textContent);
              if (arrow && hue(button) !== `var(--${arrow.hue})`) found.push(button.textContent);
            });
            for (const row of document.querySelectorAll('#equations tr[data-arrow]'))
              if (hue(row) !== `var(--${arrowBy(row.dataset.arrow).arrow.hue})`) found.push(row.textContent);
            return found;""")
        assert wrong == [], wrong
    with claim("curves of one hue in a plot differ in their dashes"):
        alike = browser.run("""return charts.filter(({ spec }) => spec.columns.length < 5).filter(({ spec }) => {
            const looks = curvesOf(spec.columns).map(({ hue, dash }) => hue + dash[1]); return new Set(looks).size !== looks.length; }).length;""")
        assert alike == 0, alike


def check_languages(browser, folder):
    texts = json.loads((PAGE / "texts.json").read_text(encoding="utf-8"))
    with claim("all languages have the same texts, with the same places for values"):
        for name, own in texts.items():
            assert list(own) == list(texts["en"]), name
            for key, text in own.items():
                assert sorted(filter(text.count, ("{0}", "{1}", "{2}"))) == sorted(filter(texts["en"][key].count, ("{0}", "{1}", "{2}"))), (name, key)
    with claim("every text is used, and none stands elsewhere: no word between tags of the page"):
        source = "".join(path.read_text(encoding="utf-8") for path in sorted(PAGE.glob("*.js")))
        template = (PAGE / "page.html").read_text(encoding="utf-8")
        for key in texts["en"]:
            assert not key or f'"{key}"' in source + template, key
        words = browser.run("""const page = new DOMParser().parseFromString(arguments[0], 'text/html');
            page.querySelectorAll('title, style, script').forEach((node) => node.remove());
            return page.body.textContent.replace(/@[^@\\n]+@/g, '').match(/[A-Za-z]{2,}/g);""", template)
        assert words is None, words
    browser.open(page_of(STAIRS, folder))
    with claim("in German the page has no English text left but the model's own, and goes back"):
        german = browser.run("""const list = document.getElementById('language'), all = () => [...document.querySelectorAll('header p, main, #charts, #numbers')].map((node) => node.textContent).join(' '), before = all();
            list.value = 'de'; list.dispatchEvent(new Event('change')); const after = all();
            list.value = 'en'; list.dispatchEvent(new Event('change'));
            return [document.documentElement.lang, before === all(), before, after];""")
        assert german[0] == "en" and german[1], german[:2]
        for word in ("Gleichungen bei", "Ereignisse", "Kräfte", "Koordinaten", "Energie und Arbeit bei", "Summe", "Verfahren", "Echtzeit"):
            assert word in german[3] and word not in german[2], word
        for word in ("Equations", "Events", "Coordinates", "Energy and", "tolerance", "real time", "names"):
            assert word in german[2] and word not in german[3], word


def main():
    try:
        with Browser() as browser, tempfile.TemporaryDirectory() as name:
            browser.open("/dev/null")
            browser.log("browser")
            for check in (check_arrows, check_fingers, check_names, check_words, check_languages):
                check(browser, Path(name))
            with claim("without a word on the console"):
                console = [entry for entry in browser.log("browser") if "willReadFrequently" not in entry["message"]]
                assert console == [], console
    except Missing as missing:
        skip(str(missing))
    finish()


if __name__ == "__main__":
    main()
