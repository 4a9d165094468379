#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how the page plays 200 bodies in a headless Chromium that draws without a graphics card: frames a second,
the time of the page's own script, and the processor time of all threads of the browser. It judges nothing: `make bench`."""
import os
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(os.environ["FBD_SOURCE_ROOT"]) / "tests/tools"))
from browser import Browser, Missing  # noqa: E402
from fbd import many_bodies, run  # noqa: E402

SECONDS = 5
SCENES = {
    "as it opens": "",
    "forces, names, tables and plots of all bodies": "choose(-1);",
    "the same with velocities": "choose(-1); show('show-velocity');",
    "the same with traces": "choose(-1); show('show-velocity'); show('show-trace');",
}
SET = """
const choose = (body) => {
  const list = document.getElementById('body');
  list.value = String(body);
  list.dispatchEvent(new Event('change'));
};
const show = (id) => { document.getElementById(id).checked = true; };
"""
# What the machine has left: a page that only counts frames.
EMPTY = """<!DOCTYPE html><title>empty</title><p id="n"></p><script>
window.fbd = { player: { frames: 0, drawing: 0 } };
const next = () => { document.getElementById("n").textContent = ++fbd.player.frames; requestAnimationFrame(next); };
next();
</script>"""


def family(process):
    """The process with all it has started."""
    children = {}
    for status in Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = int(status.read_text().rsplit(")", 1)[1].split()[1])
        except OSError:  # it has ended
            continue
        children.setdefault(parent, []).append(int(status.parent.name))
    found = [process]
    for member in found:
        found.extend(children.get(member, []))
    return found


def processor_times(process):
    """{thread: ms}; the main thread of a process has its number."""
    times = {}
    for member in family(process):
        for thread in Path(f"/proc/{member}/task").glob("*/schedstat"):
            try:
                times[member, int(thread.parent.name)] = int(thread.read_text().split()[0]) * 1e-6
            except OSError:
                continue
    return times


def measure(browser, label):
    time.sleep(1)  # whatever the start costs is over
    browser.run("Object.assign(fbd.player, { frames: 0, drawing: 0 }); window.began = performance.now();")
    before = processor_times(browser.process.pid)
    time.sleep(SECONDS)
    frames, drawing, spent = browser.run("return [fbd.player.frames, fbd.player.drawing, performance.now() - window.began]")
    after = processor_times(browser.process.pid)
    used = {thread: (value - before.get(thread, 0)) / frames for thread, value in after.items()}
    page = max(value for (process, thread), value in used.items() if process == thread)
    print(f"{label:<48} {1000 * frames / spent:9.1f} {drawing / frames:11.2f} {page:12.2f} "
          f"{sum(used.values()):12.2f} {os.getloadavg()[0]:5.1f}", flush=True)


def main():
    try:
        with Browser() as browser, tempfile.TemporaryDirectory() as name:
            model, path, empty = (Path(name) / file for file in ("many.yaml", "many.html", "empty.html"))
            many_bodies(model)
            run("--quiet", "--html", path, model)
            empty.write_text(EMPTY, encoding="utf-8")
            print(f"200 bodies on {os.cpu_count()} processors; times are ms a frame, of which 60 frames/s leave 16.7;")
            print("a load above the number of processors costs frames, whatever the page does")
            print(f"{'':<48} {'frames/s':>9} {'script':>11} {'main thread':>12} {'all threads':>12} {'load':>5}")
            browser.open(empty)
            measure(browser, "nothing but counting frames")
            for label, setting in SCENES.items():
                browser.open(path)
                browser.run(SET + setting + "fbd.setPlaying(true);")
                measure(browser, label)
    except Missing as missing:
        print(f"not measured: {missing}")


if __name__ == "__main__":
    main()
