#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: nasty.py PART BIN   (PART: titles, studies, paths, words, files)

Texts that a terminal would obey, that turn the order of a text around, that nobody sees, or that mean something in
XML, JSON, CSV, HTML or gnuplot, put into everything that a user may write, and every output looked at: what a person
reads holds none of it raw, and what a program reads is well formed. BIN holds the three programs.
"""
import csv
import io
import json
import os
import re
import shutil
import subprocess
import sys
import unicodedata

sys.path.insert(0, os.path.join(os.environ["FBD_SOURCE_ROOT"], "tests", "tools"))
import limits  # pylint: disable=wrong-import-position

TEXTS = [
    "\x1b]0;pwned\x07\x1b[31mred", "\x9b31mred\x9d0;x\x9c", "\u202egnp.exe\u2066\u2069\u200f\u061c", "a\u200b\u200d\u2060\ufeffb\u00ad",
    "\x7f\b\r\x0b\x0c", "a ]]> b", "</title><script>touch(1)</script>", "</script><!--<script>", "`touch pwned`",
    "'`touch pwned`'", "''`touch pwned`''`touch pwned`'", "$(touch pwned)", "\"; system(\"touch pwned\"); \"", "'; system('touch pwned'); '",
    "x\n!touch pwned\n", "x\n'\nsystem 'touch pwned'\n", "=1+1", "@SUM(1)", "-1", "+1", "\uffff\ufffe\U0010ffff\ufdd0", "two\nlines: error",
    "back\\", "\"quotes\" & <b> ,;", "\u2028\u2029\x85", "\U000e0001\U000e0041", "%s%n%d%999999d", "END\n", "{}[]#@x", "zero\0byte",
    "\u115f\u3164\ufe0f\u034f", "plain \u03c9\u2080 \u00b5 \U0001f600",
]
SCENE = """fbd: 1
title: {title}
bodies:
  pendulum:
    motion: {{pivot: {{at: [0, 0], point: left}}}}
    shape: rod
    mass: 2 kg
    length: 1 m
    initial: {{theta: 10 deg}}
    forces: [gravity]
    hand: "I_O*omega_dot = -m*g*L*cos(theta)"
simulate: {{until: 1 s, events: [{{name: low, when: pendulum.theta}}]}}
"""
# Into each place goes every sixth text, under a sanitizer every 24th; with FBD_DRAWS (`make generators`) each.
SHARE = 1 if "FBD_DRAWS" in os.environ else 24 if os.environ.get("FBD_THOROUGH") == "no" else 6
commands = 0


def texts_for(place):
    """Those that go into the place of that number."""
    return TEXTS[place % SHARE::SHARE]


def program(name):
    return os.path.join(BIN, "fbd-" + name)


def run(name, *arguments, **how):
    """(exit code, standard output, diagnostics), as bytes; never ended by a signal."""
    global commands
    commands += 1
    done = limits.run([program(name), *arguments], 120, capture_output=True, check=False, **how)
    assert done.returncode >= 0, (name, arguments, done)
    return done.returncode, done.stdout, done.stderr


def harmless(data, where):
    """What a person may see: UTF-8 without controls (but line ends), format characters and line separators."""
    text = data.decode("utf-8")
    for c in text:
        assert c == "\n" or unicodedata.category(c) not in ("Cc", "Cf", "Zl", "Zp", "Cs"), (where, text)
    return text


def well_formed(data, where):
    subprocess.run(["xmllint", "--noout", "--nonet", "-"], input=data, check=True)
    harmless(data.replace(b"\t", b""), where)


def quoted(text):
    """A YAML scalar in double quotes, all but ASCII letters escaped."""
    return '"' + "".join(c if c.isascii() and (c.isalnum() or c in " .") else f"\\U{ord(c):08x}" for c in text) + '"'


def write(title):
    with open("m.yaml", "w", encoding="utf-8") as file:
        file.write(SCENE.format(title=quoted(title)))


def not_run(where):
    assert not os.path.exists("pwned"), where


def same_rows(data, where):
    rows = list(csv.reader(io.StringIO(harmless(data, where), newline=""), strict=True))
    assert len(rows) > 1 and len({len(row) for row in rows}) == 1, (where, data)
    for row in rows:
        for cell in row:
            assert not re.match(r"[=@]|[-+](?![0-9.])", cell), (where, row)


def page(data, where):
    """As many elements of script and title as a page with a plain title has; its data is JSON."""
    text = data.decode("utf-8")
    head = harmless(re.search(r"<title>(.*?)</title>", text, re.S)[1].encode(), where)
    assert "<" not in head
    found = re.search(r'<script[^>]*type="application/json" id="data">(.*?)</script>', text, re.S)
    harmless(json.loads(found[1])["title"].encode(), where)
    return len(re.findall(r"<script\b", text)), len(re.findall(r"</script\b", text)), len(re.findall(r"</?title\b", text))


def titles():
    """Every title in every output of fbd-run."""
    write("plain")
    counts = page(run("run", "--quiet", "--html", "-", "m.yaml")[1], "plain")

    def shown(place):
        for title in texts_for(place):
            if "\0" not in title:
                write(title)
                yield title

    options = [], ["--equations"], ["--explain"], ["--static"], ["--linearize"], ["--check-hand"], ["--check"]
    for place, option in enumerate(options):
        for title in shown(place):
            code, out, err = run("run", *option, "m.yaml")
            assert code in (0, 1, 4), (option, err)
            harmless(out, option)
            harmless(err, option)
    for title in shown(7):
        whole = json.loads(harmless(run("run", "--json", "-", "m.yaml")[1], title))
        assert whole["title"] == title, (whole["title"], title)
        assert json.loads(harmless(run("run", "--static", "--json", "-", "m.yaml")[1], title))["title"] == title
    for title in shown(8):
        well_formed(run("run", "--quiet", "--svg", "-", "m.yaml")[1], title)
        well_formed(run("run", "--linearize", "--svg", "-", "m.yaml")[1], title)
    for title in shown(9):
        same_rows(run("run", "--csv", "-", "m.yaml")[1], title)
        assert page(run("run", "--quiet", "--html", "-", "m.yaml")[1], title) == counts, title
    for title in shown(10):
        script = run("run", "--quiet", "--gnuplot", "-", "m.yaml")[1]
        harmless(script, title)
        with open("plot.gp", "wb") as file:
            file.write(script)
        drawn = subprocess.run(["gnuplot", "-e", "set terminal svg; set output '/dev/null'", "plot.gp"], check=False, capture_output=True)
        assert drawn.returncode == 0, (title, drawn.stderr)
        not_run(title)
        code, _, err = run("run", "--quiet", "--plot", "plot.svg", "m.yaml")
        assert code == 0, err
        with open("plot.svg", "rb") as file:
            well_formed(file.read(), title)
        not_run(title)


def studies():
    """All of them in one title, in fbd-cost and fbd-sweep."""
    for title in "".join(t for t in TEXTS if "\0" not in t), "\x1b[31m ]]> <b>":
        write(title)
        code, out, err = run("cost", "--budget", "0.5", "--json", "c.json", "--svg", "c.svg", "--csv", "c.csv", "m.yaml")
        assert code in (0, 1), err
        harmless(out, title)
        harmless(err, title)
        for name in "c.json", "c.svg", "c.csv":
            with open(name, "rb") as file:
                data = file.read()
            if name == "c.json":
                assert json.loads(harmless(data, title))["title"] == title
            elif name == "c.svg":
                well_formed(data, title)
            else:
                same_rows(data, title)
        code, out, err = run("cost", "--effects", "--budget", "0.5", "--json", "e.json", "--csv", "e.csv", "m.yaml")
        assert code == 0, err
        harmless(out, title)
        harmless(err, title)
        with open("e.json", "rb") as file:
            assert json.loads(harmless(file.read(), title))["title"] == title
        with open("e.csv", "rb") as file:
            same_rows(file.read(), title)


def paths():
    """Paths of models and of outputs; what is wrong with a model is said with its path, also in a table."""
    names = [t.replace("/", "|").replace("\0", "").encode() for t in texts_for(0)] + [b"\xff\xfe\x1b[1m", b"\x9b31m", b"\xed\xa0\x80\xf5"]
    for name in names:
        for model in b"wrong" + name, name:
            with open(b"./" + model, "wb") as file:
                file.write(b"fbd: 1\nparameters: {k: 1}\nbodies: {b: {mass: k kg, motoin: slide}}\n")
            code, out, err = run("run", b"./" + model)
            assert code == 3 and b"motoin" in err, err
            harmless(out + err, name)
            os.remove(b"./" + model)
        for place in b"./" + name + b"/x", b"./nowhere/" + name:
            write("plain")
            for option in "--csv", "--json", "--svg", "--html", "--gnuplot":
                code, out, err = run("run", "--quiet", option, place, "m.yaml")
                assert code == 1 and err, (option, place)
                harmless(out + err, name)
            code, out, err = run("sweep", "--vary", "g0=1", "--csv", place, "m.yaml")
            harmless(out + err, name)
            code, out, err = run("run", place)
            assert code == 3
            harmless(out + err, name)
    for name in b"=1+1.yaml", b"@x.yaml", b"+1.yaml", b"\x1b[31m.yaml", b'a,"b.yaml', b"new\nline.yaml":
        with open(name, "wb") as file:
            file.write(b"fbd: 1\nparameters: {k: 1 kg}\nbodies: {b: {mass: k, motion: slide}}\nsimulate: {until: 1 s}\n")
        code, out, err = run("sweep", "--vary", "k=-1,1 kg", name)
        assert code == 1 and out.count(b"wrong") == 1, (out, err)
        same_rows(out, name)
        harmless(err, name)
        os.remove(name)


def words():
    """Words of the command line, echoed in messages."""
    write("plain")
    for name, options in {
        "run": ["--set", "--method", "--tolerance", "--until", "--step", "--accuracy", "--every", "--at", "--body", "--plot-of",
                "--seed", "--plot", "--", "", "--svg=x --body"],
        "cost": ["--methods", "--of", "--budget", "--until", "--set"],
        "sweep": ["--vary", "--output", "--jobs", "--seed", "--method", "--set"],
    }.items():
        for place, option in enumerate(options):
            for text in texts_for(place) + ["\udcff\udc9b"]:
                word = text.replace("\0", "")
                asked = option + word if option in ("--", "") else option  # the option itself
                more = {"--at": ["--equations"], "--body": ["--svg", "-"], "--plot-of": ["--gnuplot", "-"]}.get(option, [])
                pairs = ("a=" + word, word + "=1", "k=1,2 " + word) if option in ("--set", "--vary", "--at") else ()
                for value in (word, *pairs):
                    code, out, err = run(name, *more, asked, value, "m.yaml")
                    harmless(err, (name, option, value))
                    if not more:
                        harmless(out, (name, option, value))
    assert not os.path.exists("pwned")


def files():
    """Everything else in a file: names, keys, units, expressions, events, derivations."""
    scene = """fbd: 1
title: x
{key}: 1
parameters: {{k: {unit}, {name}: 2}}
ground: {{points: {{{name}: [0, 0]}}}}
bodies:
  {body}:
    mass: {mass}
    motion: {motion}
    {bodykey}: 3
    forces: [gravity, {force}, applied: {{name: {load}, value: {value}}}]
    hand: {hand}
couplings: [{{rope: {{name: {rope}, through: [b.G, {rope}]}}}}]
simulate: {{until: 1 s, method: {method}, events: [{{name: {event}, when: {when}}}]}}
"""
    usual = {"key": "units", "unit": "1 kg", "name": "n", "body": "b", "mass": "k", "motion": "slide", "bodykey": "angle", "force": "normal",
             "load": "p", "value": "1 N", "hand": '"m*v_dot = 0"', "rope": "r", "method": "auto", "event": "e", "when": "b.x"}
    for number, place in enumerate(usual):
        for text in texts_for(number):
            for word in (text, "1 " + text, "1[N]*" + text):
                with open("m.yaml", "w", encoding="utf-8") as file:
                    file.write(scene.format(**{**usual, place: quoted(word)}))
                code, out, err = run("run", "m.yaml")
                assert code == 3, (code, place, word)
                harmless(out + err, (place, word))
    # Raw in the file, not as an escape.
    for text in texts_for(len(usual)):
        with open("m.yaml", "w", encoding="utf-8", errors="surrogateescape", newline="") as file:
            file.write(SCENE.format(title=text) + "wrong " + text + ": " + text)
        _, out, err = run("run", "m.yaml")
        harmless(out + err, text)


PART, BIN = sys.argv[1:]
if PART == "titles" and not shutil.which("gnuplot"):
    sys.exit("no gnuplot")
{"titles": titles, "studies": studies, "paths": paths, "words": words, "files": files}[PART]()
print(commands, "commands")
