#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program's own equations are derivations that agree: each line of `--symbols` is written into its file under `hand`, and
--check-hand has nothing against it, at random states.

    printed_lines.py [FILE...]

Of the gallery every fifth file, from the third; with FBD_DRAWS (`make generators`) each, and each of tests/books.
"""
import json
import os
import re
import subprocess
import sys
from collections import Counter
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path.insert(0, str(SOURCE / "tests" / "page"))
from claims import claim, finish, skip  # noqa: E402
try:
    import yaml
except ImportError:
    skip("python3-yaml is not installed")

RUN = [os.environ["FBD_RUN"]]
# A couple beside a force, the place of a point that moves in the body, forces along a curve that turns the body, and names with
# a dot have no name in a line.
NO_NAMES = re.compile(r"\bM\(|\b[xy]_[A-Z]|\b[xy]_f|Q_s|\b\w+\.\w+_[xy]\b|turning along|M_[OG]\(|a_s|\br_[xy]\b")
LAW = re.compile(r"(^|[- (])[kc] |dV/d|\|v|- w|g_[xy]|dm/dt")  # constants of the file by their letters
MOST_BODIES = 8


def lines_of(path):
    """{body: lines} of the equations that hand lines have names for, and the number of the others."""
    text = subprocess.run([*RUN, "--symbols", "--json", "-", path.name], capture_output=True, text=True, check=False)
    if text.returncode:
        return {}, 0
    found, kept, others = json.loads(text.stdout), {}, 0
    for e in found["equations"]:
        line, b = e.get("symbols", ""), e["body"]
        if not line or NO_NAMES.search(line) or LAW.search(line):
            others += 1
            continue
        entry = line
        if "mu_k" in line:  # as it slips now
            v = found["coordinates"].get(f"{b}.v")
            if not v:
                continue
            entry = {"equation": line, "when": "v > 0" if v > 0 else "v < 0"}
        kept.setdefault(b, []).append(entry)
    for b, lines in found.get("kinematics", {}).items():
        own = list(found["forces"]).index(b) + 1  # the L of another body has no name
        kept.setdefault(b, []).extend(line for line in lines if all(n == str(own) for n in re.findall(r"\bL_([0-9]+)", line)))
    return kept, others


def check(path, total):
    os.chdir(path.parent)  # where its data are
    file = yaml.load(path.read_text(encoding="utf-8"), yaml.BaseLoader)
    if len(file["bodies"]) > MOST_BODIES:
        return
    kept, others = lines_of(path)
    total["others"] += others
    for b, body in file["bodies"].items():
        body.pop("hand", None)
        if b in kept:
            body["hand"] = kept[b]
    if not kept:
        return
    with claim(f"{path.parent.name}/{path.name}"):
        done = subprocess.run([*RUN, "--check-hand", "-"], input=re.sub(r"'(true|false)'", r"\1", yaml.dump(file, sort_keys=False)), capture_output=True, text=True,
                              check=False)
        total.update(re.findall(r"^  (\w+ \w+)", done.stdout, re.MULTILINE))
        for line, differs in re.findall(r"^(\S+: .*)\n  differs at ([0-9]+) of", done.stdout, re.MULTILINE):
            of_file = re.search(r"\[(m|deg)\]", line) and int(differs) <= 264  # numbers, of its parameters alone
            assert of_file, f"{line} differs at {differs}"
        assert done.returncode in (0, 4), f"{done.returncode}: {done.stdout}{done.stderr}"


def main():
    total = Counter()
    files = [Path(name).resolve() for name in sys.argv[1:]]
    if not files:
        files = sorted((SOURCE / "models").glob("*/*.yaml"))
        files = files + sorted((SOURCE / "tests" / "books").glob("*.yaml")) if "FBD_DRAWS" in os.environ else files[2::5]
    for path in files:
        check(path, total)
    with claim(f"most lines are held against the assembly: {dict(total)}"):
        assert len(sys.argv) > 1 or total["agrees at"] > 1.5 * total["others"], total
    finish()


main()
