#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of `fbd-run --watch --html` in a headless Chromium, opened from its file: it loads itself anew when the
model changes, stays where it is, says nothing on the console, and is an ordinary page once the watch has ended."""
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
import limits  # noqa: E402
from browser import Browser, Missing  # noqa: E402
from claims import claim, finish, skip  # noqa: E402
from fbd import MODELS, RUN, run  # noqa: E402

INCLINE = (MODELS / "kinetics/incline.yaml").read_text(encoding="utf-8")


def until(condition, what):
    end = time.monotonic() + limits.WAIT
    while not condition():
        assert time.monotonic() < end, f"never: {what}"
        time.sleep(0.05)


def loads(browser, title):
    """The page of this title, within what an error while it is being exchanged takes."""
    def shown():
        try:
            return browser.run("return document.title") == title and browser.run("return window.fbd !== undefined")
        except RuntimeError:
            return False
    until(shown, title)


def check_watch(browser, folder):
    model, page = folder / "block.yaml", folder / "a page #1.html"
    stamp = page.with_name(page.name + ".stamp.js")
    title = "Block on an incline with dry friction"
    model.write_text(INCLINE, encoding="utf-8")
    with subprocess.Popen([RUN, "--watch", "--quiet", "--html", page, model]) as watch:
        until(stamp.exists, "a stamp")
        browser.open(page)
        with claim("the page is that of the model"):
            loads(browser, title)
        with claim("it rests as long as nothing changes"):
            browser.run("window.mark = 1; fbd.seek(1.25); fbd.zoom(0.5, 2); document.getElementById('show-velocity').click();")
            time.sleep(1.6)
            assert browser.run("return window.mark") == 1
        with claim("a change of the model is seen without a touch"):
            model.write_text(INCLINE.replace(title, "Another"), encoding="utf-8")
            loads(browser, "Another")
            assert browser.run("return window.mark === undefined")
        with claim("at the same time, with the same zoom and choices"):
            state = browser.run("return [fbd.player.t, fbd.player.playing, charts[0].graph.xAxisRange(), document.getElementById('show-velocity').checked]")
            assert state == [1.25, False, [0.5, 2], True], state
        with claim("a faulty model leaves the page as it is, and mending it is seen"):
            browser.run("window.mark = 2; fbd.setPlaying(true)")
            model.write_text("fbd: 1\n", encoding="utf-8")
            time.sleep(1.2)
            assert browser.run("return window.mark") == 2
            model.write_text(INCLINE.replace(title, "Mended"), encoding="utf-8")
            loads(browser, "Mended")
        with claim("a page that plays goes on playing"):
            assert browser.run("return fbd.player.playing || fbd.player.t === run.end")
        with claim("the console has no word of all that"):
            console = browser.log("browser")
            assert console == [], console
        with claim("nothing but the page and its stamp was asked for"):
            asked = {address.split("?")[0].split("#")[0] for address in browser.requests() if not address.startswith(("data:", "chrome:"))}
            assert asked <= {page.as_uri(), stamp.as_uri()}, asked
        with claim("a stamp that no page has does not make it reload for ever"):
            browser.run("window.mark = 3")
            stamp.write_text('fbd.stamp("other");\n', encoding="utf-8")
            until(lambda: browser.run("return window.mark === undefined"), "reloaded once")
            browser.run("window.mark = 4")
            time.sleep(1.6)
            assert browser.run("return window.mark") == 4
        browser.open("about:blank")  # a live page whose watch has ended asks in vain, and the console says so
        browser.log("browser")
        watch.send_signal(signal.SIGINT)
        watch.wait(limits.WAIT)
    with claim("the watch leaves an ordinary page and no stamp"):
        assert not stamp.exists()
        # the same but for the time that the run took
        run("--quiet", "--html", folder / "plain.html", model)
        plain, left = (path.read_text(encoding="utf-8") for path in (folder / "plain.html", page))
        assert plain.split('<script type="application/json"')[0] == left.split('<script type="application/json"')[0]
        assert plain.split("<!--")[1] == left.split("<!--")[1]
        assert len(plain.splitlines()) == len(left.splitlines())
    browser.open(page)
    with claim("which asks for nothing and says nothing"):
        loads(browser, "Mended")
        time.sleep(1)
        said = browser.log("browser")
        assert said == [], said


def main():
    try:
        with Browser() as browser, tempfile.TemporaryDirectory() as name:
            check_watch(browser, Path(name))
    except Missing as missing:
        skip(str(missing))
    finish()


if __name__ == "__main__":
    main()
