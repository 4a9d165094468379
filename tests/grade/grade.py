#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: grade.py FBD-RUN: errors of students, each named rightly; and the same mechanics in other words. Prints TAP."""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import inventions
from errors import CASES, KEYS, RIGHT

RUN = sys.argv[1]
EVERY = 6 if os.environ.get("FBD_THOROUGH") == "no" else 1  # of the cases
count = 0
bad = 0


def claim(fact, words, detail=""):
    global count, bad
    count += 1
    bad += not fact
    print(f"{'ok' if fact else 'not ok'} {count} - {words}")
    if not fact and detail:
        print("\n".join("# " + line for line in str(detail).splitlines()))


def changed(text, changes):
    for old, new in changes.items():
        assert text.count(old) == 1, f"{old!r} stands {text.count(old)} times"
        text = text.replace(old, new)
    return text


def grade(key, *answers, options=()):
    done = subprocess.run([RUN, "--grade", key, "--json", "-", "--details", *options, *map(str, answers)],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode in (0, 4), (done.returncode, done.stderr)
    return done.returncode, json.loads(done.stdout)["answers"]


def test_cases(folder):
    for number, (name, what, changes, kind, item) in enumerate(CASES):
        if kind is None or number % EVERY != 0:
            continue
        key, answer = folder / f"{name}.key.yaml", folder / f"case{number}.yaml"
        answer.write_text(changed(KEYS[name], changes), encoding="utf-8")
        code, (result,) = grade(key, answer)
        wrong = [one for one in result["tests"] if one["kind"] != "right"]
        named = [one for one in wrong if one["kind"] == kind and
                 (item is None or one["name"].split(": ", 1)[-1] == item or (item == "" and True))]
        claim(code == 4 and named and not result["passed"], f"{name}: {what}: {kind}",
              json.dumps(wrong, indent=1)[:1500])


def test_right(folder):
    for number, (name, what, changes) in list(enumerate(RIGHT))[::EVERY]:
        key, answer = folder / f"{name}.key.yaml", folder / f"right{number}.yaml"
        answer.write_text(changed(KEYS[name], changes), encoding="utf-8")
        code, (result,) = grade(key, answer)
        wrong = [one for one in result["tests"] if one["kind"] != "right"]
        claim(code == 0 and result["passed"] and result["score"] == 1, f"{name}: {what}: right",
              json.dumps(wrong, indent=1)[:1500])


def test_inventions(folder):
    for number, (name, what, changes, expected) in list(enumerate(inventions.CASES))[::EVERY]:
        key, answer = folder / f"{name}.key.yaml", folder / f"invention{number}.yaml"
        answer.write_text(changed(inventions.KEYS[name], changes), encoding="utf-8")
        code, (result,) = grade(key, answer)
        wrong = [one for one in result["tests"] if one["kind"] != "right"]
        full = result["score"] == 1
        found = sorted(one["kind"] for one in wrong)
        claim(found == expected and full == (code == 0) == (expected in ([], ["unreadable"])),
              f"{name}: {what}: {', '.join(expected) or 'right'}", json.dumps(wrong, indent=1)[:1500])


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Path(path)
        assert not set(KEYS) & set(inventions.KEYS)
        for name, text in {**KEYS, **inventions.KEYS}.items():
            asks = "" if "grading:" in text else "grading: {reactions: none}\n"  # of them: reactions.py
            (folder / f"{name}.key.yaml").write_text(text + asks, encoding="utf-8")
            code, (result,) = grade(folder / f"{name}.key.yaml", folder / f"{name}.key.yaml")
            claim(code == 0 and result["score"] == 1, f"{name}: the key passes itself", json.dumps(result)[:1500])
        test_cases(folder)
        test_right(folder)
        test_inventions(folder)
    print(f"1..{count}")
    return bad > 0


sys.exit(main())
