#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages that fbd-run writes, by axe-core, which finds nothing in them: in each language, light and dark, at three widths; with the
module also in live pages and sheets to learn by. `make axe` runs it: it takes axe-core from npm, and is no part of `make test`."""
import os
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
from browser import Browser  # noqa: E402
from claims import claim, finish  # noqa: E402
from fbd import MODELS, SOURCE, run  # noqa: E402

AXE = Path(os.environ["FBD_AXE"]).read_text(encoding="utf-8")
WIDTHS = [(1400, 1000), (800, 1000), (390, 844)]
NAMES = ["kinetics/incline", "couplings/slider_crank", "contact/cradle", "vibration/damped_oscillator"]
# Each finding as its rule, its element and its reasons; all parts that are folded are unfolded, and words for the editor listed.
FIND = """
for (const part of document.querySelectorAll('details')) part.open = true;
if (typeof openHints === 'function') { editor.focus(); openHints(true); }
await new Promise((done) => setTimeout(done, 500));
const found = await axe.run(document, { resultTypes: ['violations'] });
return found.violations.flatMap(({ id, nodes }) =>
  nodes.map((node) => `${id}: ${node.target}: ${[...node.any, ...node.all, ...node.none].map((check) => check.message).join('; ')}`));
"""
LANGUAGES = "return [...(document.getElementById('language') || { options: [] }).options].map((option) => option.value);"
CHOOSE = """
const choice = document.getElementById('language');
choice.value = arguments[0];
choice.dispatchEvent(new Event('change'));
"""


# Of a live page also the verdict on its derivations.
CHECK = """
const button = document.getElementById('live-hand');
if (!button) return;
while (!(bench.shown > 0)) await new Promise((done) => setTimeout(done, 20));
button.click();
while (element('live-checked').textContent === phrase('live-checking')) await new Promise((done) => setTimeout(done, 20));
"""


def written(path, *arguments):
    """The page, if this fbd-run can write it."""
    run(*arguments, code=None)
    return [path] if path.exists() else []


def pages(folder):
    """(what it is, paths)"""
    plain, live, notes, sheets = [], [], [], []
    for name in NAMES:
        model, stem = MODELS / f"{name}.yaml", name.replace("/", "-")
        for made, kind, *arguments in ((plain, "html", "--quiet", "--html"), (live, "live", "--quiet", "--live", "--html"),
                                       (notes, "note", "--quiet", "--note")):
            path = folder / f"{stem}-{kind}.html"
            made += written(path, *arguments, path, model)
    for model in (SOURCE / "docs/course/wheel.yaml", SOURCE / "docs/course/carts.yaml"):
        for kind, *arguments in (("sheet",), ("exam", "--exam")):
            path = folder / f"{model.stem}-{kind}.html"
            sheets += written(path, "--handout", "--student", "anna", *arguments, "--page", path, model)
    return [("pages of --html", plain), ("live pages", live), ("notes", notes), ("sheets to draw on", sheets)]


def look(browser, path, dark):
    """Findings in the page at every width and in every language."""
    found = set()
    browser.dark_mode(dark)
    browser.open(path)
    browser.run(CHECK)
    browser.run(AXE)
    for language in browser.run(LANGUAGES) or [""]:
        if language:
            browser.run(CHOOSE, language)
        for width, height in WIDTHS:
            browser.resize(width, height)
            found |= {f"{path.name}, {width} px, {'dark' if dark else 'light'} {language}: {one}" for one in browser.run(FIND)}
    return found


with tempfile.TemporaryDirectory() as made, Browser() as driven:
    for what, files in pages(Path(made)):
        for shade in (False, True):
            with claim(f"{len(files)} {what}, {'dark' if shade else 'light'}: axe finds nothing"):
                findings = sorted(set().union(*(look(driven, file, shade) for file in files)))
                assert not findings, "\n".join(findings)
finish()
