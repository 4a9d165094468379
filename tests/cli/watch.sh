#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# --watch: runs again when the model or its data change, however an editor writes them; shows faults and goes on;
# ends by the signal that ends it.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"

cat >watching.py <<'END'
"""Claims of a program that goes on: each is `ok` or `not ok` in the output, by the time that it took to come true."""
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import limits

MODEL = """fbd: 1
title: {title}
tables: {{push: {{file: data/push.csv, x: 1, y: 2}}}}
bodies:
  block:
    mass: 2 kg
    motion: {{slide: {{along: 0 deg}}}}
    forces: [applied: {{name: push, value: "push(t)"}}]
simulate: {{until: {until}}}
"""
os.mkdir("data")
model, data = Path("block.yaml"), Path("data/push.csv")
failed = False


def write(title, until="2 s"):
    model.write_text(MODEL.format(title=title, until=until))


def push(newtons):
    data.write_text(f"t [s],F [N]\n0,{newtons}\n10,{newtons}\n")


def until(condition):
    end = time.monotonic() + limits.WAIT
    while not condition() and time.monotonic() < end:
        time.sleep(0.02)


class Watch:
    """`fbd-run --watch`, what it has printed so far, and how often it waits."""
    def __init__(self, *options):
        self.out = open("printed", "w+b")
        self.process = subprocess.Popen([os.environ["FBD_RUN"], "--watch", *options], stdout=self.out, stderr=self.out)
        self.seen = 0

    def text(self):
        return Path("printed").read_text(encoding="utf-8")

    def new(self):
        """What was printed since the last time that it waited."""
        return self.text()[self.seen:]

    def waits(self):
        """Until it waits for changes again: what it printed before that."""
        end = time.monotonic() + limits.WAIT
        while "waiting for changes" not in self.new():
            if time.monotonic() > end or self.process.poll() is not None:
                return f"[{self.process.poll()}] {self.new()}"
            time.sleep(0.02)
        start, self.seen = self.seen, self.seen + self.new().index("waiting for changes") + len("waiting for changes")
        return self.text()[start:self.seen]

    def stop(self, number):
        self.process.send_signal(number)
        return self.process.wait(limits.WAIT)


def claim(what, holds, *shown):
    global failed
    print("holds" if holds else "fails", "-", what)
    if not holds:
        failed = True
        for text in shown:
            print("# " + str(text).replace("\n", "\n# "))


write("First")
push(4)
watch = Watch("--csv", "out.csv", "--every", "1e-3", "--json", "out.json", "block.yaml")
said = watch.waits()
claim("it runs and then waits", "First" in said and "Final state" in said, said)
size = os.stat("out.json").st_size
claim("with its files written", size > 0)

write("Second")
said = watch.waits()
claim("a file that is written over runs again", "block.yaml has changed" in said and "Second" in said, said)
Path("new.yaml").write_text(model.read_text().replace("Second", "Third"))
os.rename("new.yaml", "block.yaml")
said = watch.waits()
claim("so does one that another is put in place of", "Third" in said, said)

same = model.read_text().replace("Third", "Fifth")
before = os.stat(model)
model.write_text(same)
said = watch.waits()
claim("and one of the same size", "Fifth" in said, said)

def gone_for_a_moment():
    os.rename("block.yaml", "block.yaml~")
    yield
    time.sleep(0.25)
    write("Sixth")
    yield


def written_in_parts():
    text = MODEL.format(title="Whole", until="2 s")
    with open(model, "w", encoding="utf-8") as half:
        for part in range(6):
            half.write(text[len(text) * part // 6:len(text) * (part + 1) // 6])
            half.flush()
            yield
            time.sleep(0.04)


def quick(change, most, title):
    """Make a change whose steps follow each other within so many seconds, anew where the machine was slower: what was
    printed then; of a machine that never was as fast the title alone, as nothing can be said."""
    for _ in range(20):
        times = [time.monotonic() for _ in change()]
        said = watch.waits()
        if max(b - a for a, b in zip(times, times[1:])) < most:
            return said
        while title not in said and watch.process.poll() is None:
            said = watch.waits()
    return title


said = quick(gone_for_a_moment, 0.8, "Sixth")
claim("one that is gone for a moment is not missed", "Sixth" in said and "cannot" not in said, said)

said = quick(written_in_parts, 0.08, "Whole")
claim("one that is being written is read when it is whole", "Whole" in said and "error" not in said, said)

before = Path("out.csv").read_bytes()
push(8)
said = watch.waits()
claim("data of a table run again", "data/push.csv has changed" in said and "Whole" in said, said)
claim("with other numbers", Path("out.csv").read_bytes() != before)

push("nothing")
said = watch.waits()
claim("a fault of the data is shown, with its place", "data/push.csv:2:3: error" in said and "waiting" in said, said)
held = Path("out.csv").read_bytes()
push(16)
said = watch.waits()
claim("and mending it there runs again", "error" not in said and "Final state" in said, said)
claim("nothing was written in between", held != Path("out.csv").read_bytes())

os.remove(data)
said = watch.waits()
claim("data that are gone are said", "data/push.csv`: No such file" in said, said)
push(2)
said = watch.waits()
claim("and found when they are back", "Final state" in said, said)

model.write_text("bodies: [")
said = watch.waits()
claim("a model that is wrong is shown with its place", "block.yaml:2:1: error" in said, said)
os.remove(model)
said = watch.waits()
claim("one that is gone as well", "block.yaml: error: cannot read" in said, said)
write("Seventh")
said = watch.waits()
claim("and it goes on when the model is back", "Seventh" in said, said)

runs = watch.text().count("Final state")
time.sleep(0.7)
claim("without a change it stays quiet", watch.text().count("Final state") == runs and watch.new().strip() == "; Ctrl-C ends", watch.new())
status = Path(f"/proc/{watch.process.pid}/status")
if status.exists():
    looks = lambda: int(re.search(r"^voluntary_ctxt_switches:\s*(\d+)", status.read_text(), re.MULTILINE)[1])
    start, begin = looks(), time.monotonic()
    time.sleep(1)
    made, took = looks() - start, time.monotonic() - begin
    claim("and looks ten times a second", made <= 10 * took + 2, made, took)

write("Long", "1e7 s")
until(lambda: any(path.stat().st_size for path in Path(".").glob("out.csv.??????")))
claim("a long run is under way", list(Path(".").glob("out.csv.??????")))
watch.seen = len(watch.text())
write("Short")
said = watch.waits()
claim("a change ends it", "Short" in said and "Final state" in said.split("Short")[1], said)

code = watch.stop(signal.SIGINT)
claim("Ctrl-C ends by that signal: 130 in a shell", code == -signal.SIGINT, code)
claim("and leaves no temporary file", not list(Path(".").glob("*.??????")), list(Path(".").iterdir()))

write("Long", "1e9 s")
os.remove("out.csv")
watch = Watch("--csv", "out.csv", "--every", "1e-3", "block.yaml")
until(lambda: any(path.stat().st_size for path in Path(".").glob("out.csv.??????")))
code = watch.stop(signal.SIGTERM)
claim("a signal in the middle of a run ends both", code == -signal.SIGTERM, code)
claim("with the file whole", Path("out.csv").exists() and not list(Path(".").glob("out.csv.??????")))

write("Rest")
watch = Watch("--quiet", "--check", "block.yaml")
time.sleep(1)
claim("--quiet says nothing of a model that is right", watch.text() == "", watch.text())
model.write_text("fbd: 1\nbodies: {}\nx: 1\n")
until(lambda: "error" in watch.text())
claim("--check is watched as well", "block.yaml:3:1: error" in watch.text(), watch.text())
watch.stop(signal.SIGTERM)
sys.exit(failed)
END

PYTHONPATH=$FBD_SOURCE_ROOT/tests/tools python3 watching.py >claims 2>trace
grep -E '^(holds|fails) - ' claims >list
while read -r verdict _ claim; do
    check "$claim" test "$verdict" = holds
done <list
check 'every claim was tried' sh -c 'cat claims trace | sed -n "/^# /p;/Error/p" | head -60; ! grep -q . trace && [ "$(grep -c . list)" -ge 25 ]'

cat >m.yaml <<'END'
fbd: 1
parameters: {m: 2 kg}
tables: {push: {file: push.csv, x: 1, y: 2}}
bodies:
  block: {mass: m, motion: slide, forces: [applied: {name: push, value: "push(t)"}]}
simulate: {until: 1 s}
END
printf 't [s],F [N]\n0,1\n2,1\n' >push.csv
check 'standard input is not watched' exits 2 run --watch -
check 'which is said' says '--watch wants a model that is a file' err
check 'nor is a pipe' exits 2 run --watch /dev/stdin
check 'data to standard output are not written anew' exits 2 run --watch --csv - m.yaml
check 'which is said too' says 'which is possible for files only' err
spares() { # spares COMMAND...: refused since it would be written over data
    exits 2 "$@" 2>err && says 'overwrite a file that the model reads: push.csv' err
}
check 'outputs are never written over data that are read' spares "$program" --csv push.csv m.yaml
check 'nor by fbd-cost' spares "$FBD_BUILD_ROOT/apps/fbd-cost" --budget 0.1 --json push.csv m.yaml
check 'nor by fbd-sweep' spares "$FBD_BUILD_ROOT/apps/fbd-sweep" --vary m=1,2 --csv push.csv m.yaml
check 'and they stay' says '^2,1' push.csv
finish
