#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of --html on paper and in windows of all widths: geometry of the print, contrast, focus and keys, what is zero."""
import math
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
from browser import Browser, Missing  # noqa: E402
from claims import claim, close, finish, skip  # noqa: E402
from fbd import MODELS, run  # noqa: E402

A4, LETTER = (21.0, 29.7), (21.59, 27.94)  # cm
INCLINE, CRANK, ROPE = MODELS / "kinetics/incline.yaml", MODELS / "couplings/slider_crank.yaml", MODELS / "couplings/rope_pendulum.yaml"
SETTLE = "await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));"

# Texts whose colour is not far enough from what is behind them (WCAG 2: 4.5 to 1).
CONTRAST = """
const channel = (v) => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
const light = ([r, g, b]) => 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
const numbers = (colour) => colour.match(/[0-9.]+/g).map(Number);
const behind = (node) => { for (; node; node = node.parentElement) {
  const c = numbers(getComputedStyle(node).backgroundColor); if (c.length < 4 || c[3] > 0) return c.slice(0, 3); } return [255, 255, 255]; };
const ratio = (a, b) => { const [x, y] = [light(a), light(b)]; return (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05); };
const found = [...document.querySelectorAll('body *')].filter((node) => [...node.childNodes].some((n) => n.nodeType === 3 && n.data.trim()))
  .map((node) => [node, ratio(numbers(getComputedStyle(node).color).slice(0, 3), behind(node))])
  .filter(([node, r]) => r < 4.5 && !['OPTION', 'SCRIPT', 'STYLE'].includes(node.tagName)).map(([node, r]) => `${node.textContent.slice(0, 20)} ${r}`);
const hex = (colour) => [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16)), paper = hex(view.colour.paper.length === 4
  ? view.colour.paper.replace(/[0-9a-f]/g, '$&$&') : view.colour.paper);
for (const name of ['ink', 'soft', 'gravity', 'reaction', 'friction', 'applied', 'velocity'])
  if (ratio(hex(view.colour[name]), paper) < 4.5) found.push(`${name} in the scene`);
return found;
"""

# What does not fit its window: a page wider than it, a scene or a plot that is not as large as its place.
UNFIT = """
const found = [];
if (document.documentElement.scrollWidth > innerWidth) found.push(`the page is ${document.documentElement.scrollWidth} wide`);
if (Math.abs(view.width - canvas.clientWidth) > 1) found.push(`the scene is drawn ${view.width} wide, and is ${canvas.clientWidth}`);
for (const chart of charts) if (chart.graph && Math.abs(chart.graph.width_ - chart.holder.clientWidth) > 1)
  found.push(`${chart.spec.title}: ${chart.graph.width_} in ${chart.holder.clientWidth}`);
for (const [x1, y1, x2, y2] of fbd.drawn.arrows) if (x2 < 0 || y2 < 0 || x2 > view.width || y2 > view.height) found.push(`an arrow to ${x2}, ${y2}`);
return found;
"""


def page_of(model, folder):
    path = folder / f"{model.stem}.html"
    run("--quiet", "--html", path, model)
    return path


def line_slope(picture):
    """The angle in degrees of the surface's line in a PPM, by the median slope of pairs of its points."""
    header = re.match(rb"P6\s+(\d+)\s+(\d+)\s+255\s", picture)
    width, height = int(header[1]), int(header[2])
    data = picture[header.end():]
    points = []
    for x in range(int(0.12 * width), int(0.82 * width), max(1, width // 160)):
        ys = []
        for y in range(int(0.12 * height), int(0.43 * height)):
            at = 3 * (y * width + x)
            if all(abs(data[at + i] - want) < 40 for i, want in enumerate((92, 101, 112))):  # the colour --soft
                ys.append(y)
        if ys and max(ys) - min(ys) < 8:
            points.append((x, statistics.mean(ys)))
    slopes = [math.degrees(math.atan2(y1 - y2, x2 - x1)) for i, (x1, y1) in enumerate(points)
              for x2, y2 in points[i + 1:] if x2 - x1 > width / 5]
    assert len(slopes) > 100, f"the line was found at {len(points)} places only"
    print(f"# the line is inclined by {statistics.median(slopes):.3f} degrees")
    return statistics.median(slopes)


def check_print(browser, folder):
    if not shutil.which("pdftoppm"):
        print("# what is printed is not looked at: there is no pdftoppm")
        return
    browser.open(page_of(INCLINE, folder))
    browser.run("for (const id of ['show-forces', 'show-axes', 'show-trace']) document.getElementById(id).checked = false; fbd.seek(1);")
    for name, (width, height) in {"A4": A4, "Letter": LETTER}.items():
        with claim(f"on {name} the incline of 30 degrees is one of 30 degrees"):
            browser.print(folder / "print.pdf", width, height)
            done = subprocess.run(["pdftoppm", "-r", "110", "-f", "1", "-l", "1", folder / "print.pdf"], capture_output=True, check=True)
            close(line_slope(done.stdout), 30, 0.2)
    with claim("the curves of the plots are on paper, in their colours"):
        done = subprocess.run(["pdftoppm", "-r", "60", folder / "print.pdf"], capture_output=True, check=True)
        blue = len(re.findall(rb"(?=(?:\x45|\x46|\x47)\x64\x8c)", done.stdout))
        assert blue > 100, blue
    with claim("after printing the page is that of the screen again"):
        assert browser.run(SETTLE + UNFIT) == []
    browser.open(page_of(CRANK, folder))
    with claim("every line of the equations is on paper, within the margins"):
        browser.print(folder / "print.pdf", *A4)
        words = subprocess.run(["pdftotext", "-bbox", folder / "print.pdf", "-"], capture_output=True, check=True).stdout.decode()
        boxes = [(float(a), float(b)) for a, b in re.findall(r'<word xMin="([-0-9.]+)" yMin="[^"]*" xMax="([-0-9.]+)"', words)]
        most = A4[0] / 2.54 * 72 - 30  # points
        assert boxes and all(low > 30 and high < most for low, high in boxes), [b for b in boxes if b[0] <= 30 or b[1] >= most]
        equations = browser.run("return run.bodies.reduce((sum, body) => sum + body.equations.length, 0)")
        assert words.count(">sum<") == equations, (words.count(">sum<"), equations)


def check_windows(browser, folder):
    browser.open(page_of(CRANK, folder))
    with claim("windows of 1400, 800, 390, 320, 2560 and again 1400 pixels are filled and not overrun"):
        unfit = {}
        for width in (1400, 800, 390, 320, 2560, 1400):
            browser.resize(width)
            if found := browser.run(SETTLE + SETTLE + UNFIT):
                unfit[width] = found
        assert not unfit, unfit
    for dark in (False, True):
        browser.dark_mode(dark)
        with claim(f"texts stand out from what is behind them, {'dark' if dark else 'light'}"):
            assert (found := browser.run(SETTLE + CONTRAST)) == [], found
    browser.dark_mode(False)


def check_hands(browser, folder):
    browser.open(page_of(INCLINE, folder))
    with claim("Space on a checkbox ticks it, and the page does not play"):
        browser.run("document.getElementById('show-values').focus();")
        browser.press(" ")
        assert browser.run("return [document.getElementById('show-values').checked, fbd.player.playing]") == [True, False]
    with claim("a label has name, value and unit where these are asked for"):
        assert "gravity 19.6 N" in browser.run("return fbd.drawn.labels.map((label) => label.text)")
    with claim("a click on a name in a legend hides its curve, another one shows it"):
        found = browser.run("""const chart = charts.find((c) => c.spec.columns.length > 1), item = chart.box.querySelector('.legend button');
            const state = () => [chart.graph.visibility()[0], item.getAttribute('aria-pressed')], all = [state()];
            item.click(); all.push(state()); item.click(); all.push(state()); return all;""")
        assert found == [[True, "true"], [False, "false"], [True, "true"]], found
    with claim("the wheel with ctrl zooms about the pointer, and `whole` goes back"):
        before, same, zoomed, after = browser.run("""const at = toScreen([0.3, 0.2]), before = view.scale;
            canvas.dispatchEvent(new WheelEvent('wheel', { deltaY: -200, ctrlKey: true, clientX: canvas.getBoundingClientRect().left + canvas.clientLeft + at[0],
              clientY: canvas.getBoundingClientRect().top + canvas.clientTop + at[1], cancelable: true }));
            const now = toScreen([0.3, 0.2]), zoomed = view.scale, same = Math.hypot(now[0] - at[0], now[1] - at[1]);
            document.getElementById('zoom-all').click(); return [before, same, zoomed, view.scale];""")
        assert zoomed > 1.2 * before and same < 2 and after == before, (before, same, zoomed, after)
    with claim("a plot of rounding is folded away and opens"):
        folded, opened = browser.run("""const chart = charts[charts.length - 1], folded = [chart.box.open, chart.graph === null];
            chart.box.open = true; while (chart.graph === null) await new Promise((done) => setTimeout(done, 10)); return [folded, chart.graph !== null];""")
        assert folded == [False, True] and opened, (folded, opened)
    with claim("a loop begins anew at the end"):
        # However late the browser draws: until it has begun anew, or has stopped.
        t = browser.run("""document.getElementById('loop').checked = true; fbd.seek(2.99); fbd.setPlaying(true);
            while (fbd.player.playing && fbd.player.t >= 2.99) await new Promise((done) => setTimeout(done, 10));
            const t = fbd.player.t, playing = fbd.player.playing; fbd.setPlaying(false); return playing ? t : -1;""")
        assert 0 <= t < 2.99, t


def check_zero(browser, folder):
    browser.open(page_of(ROPE, folder))
    with claim("the force of a slack rope is shown as zero, at every time of the slack"):
        texts = browser.run("""const [from, to] = run.events.times, found = new Set();
            const coupling = run.couplings[0].force, column = run.bodies.flatMap((body) => body.arrows).find((arrow) => arrow.arrow[0] === coupling).force;
            for (let i = 1; i < 50; i++) { const t = from + (to - from) * i / 50; for (const c of column) found.add(show(readAt(c, t, rowAt(t)))); }
            return [...found];""")
        assert texts == ["0"], texts


def main():
    try:
        with Browser() as browser, tempfile.TemporaryDirectory() as name:
            browser.open("/dev/null")
            browser.log("browser")
            for check in (check_print, check_hands, check_zero, check_windows):
                check(browser, Path(name))
            with claim("without a word on the console"):
                assert (console := browser.log("browser")) == [], console
    except Missing as missing:
        skip(str(missing))
    finish()


if __name__ == "__main__":
    main()
