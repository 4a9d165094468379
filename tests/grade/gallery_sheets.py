#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: gallery_sheets.py FBD-RUN [SHEETS [SEED]]

Models of the gallery as keys. An answer is the key written in other ways that mean the same (answers.py), and in half
of the cases with one error of a known kind: nothing may be accused but that. Reactions are not asked for
(reactions.py). Prints TAP. Needs python3-yaml.
"""
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import yaml
except ImportError:
    print("1..0 # SKIP python3-yaml is not installed")
    sys.exit(0)

from answers import SAME
from mistakes import ERRORS
from trees import Sheet, read, write

RUN = sys.argv[1]
SHEETS = int(sys.argv[2]) if len(sys.argv) > 2 else 200
SEED = int(sys.argv[3]) if len(sys.argv) > 3 else 1
SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
TOGETHER = 12  # answers to one key

# A force that acts for less of the run than random states find; forces beside which another is a rounding.
BEYOND = {"pulse_in_a_coast.yaml", "scales.yaml", "scales_us.yaml"}


def is_it(one, expected):
    """Is a finding what was expected: (kinds, body, name or None)?"""
    kinds, body, name = expected
    where, _, called = one["name"].rpartition(": ")
    return one["kind"] in kinds and (body is None or where in (body, "")) and (not name or one["kind"] == "missing" or called == name)


def fault(result, expected):
    """What is wrong with a verdict, or nothing."""
    found = [one for one in result["tests"] if one["kind"] != "right"]
    if not expected:
        return "" if result["passed"] and not found else "accused without an error"
    if result["passed"] and "derivation" not in expected[0]:  # another line may say the same
        return "passes"
    if not any(is_it(one, expected) for one in found):
        return "the error is not named"
    # A derivation that is wrong is missing as well.
    more = [one for one in found if not is_it(one, expected) and not (
        "derivation" in expected[0] and one["kind"] == "missing" and "equation" in one["message"])]
    return "more is accused than the error" if more else ""


def agrees(model, sheet):
    """Does a line with an error say what is so, as 0 = 2*(0)?"""
    path = model.parent / "line.yaml"
    path.write_text(write(sheet.root), encoding="utf-8")
    return subprocess.run([RUN, "--check-hand", "--quiet", str(path)], stdout=subprocess.DEVNULL, check=False).returncode != 4


def make_answer(model, rng):
    """(text, what was done to it, expected finding or None)."""
    root = read(model)
    root.pop("grading")
    sheet = Sheet(root, rng)
    expected, done = None, []
    if rng.random() < 0.5:
        for error in rng.sample(ERRORS, len(ERRORS)):
            expected = error(sheet)
            if expected and "derivation" in expected[0] and agrees(model, sheet):
                return make_answer(model, rng)
            if expected:
                done.append(f"ERROR {error.__name__} {expected}")
                break
    for change in rng.sample(SAME, len(SAME)):
        if rng.random() < 0.4 and change(sheet):
            done.append(change.__name__)
    return write(sheet.root), done, expected


def grade(folder, model, numbers, report):
    key = folder / model.name
    key.write_text(model.read_text(encoding="utf-8") + "\ngrading: {reactions: none}\n", encoding="utf-8")
    rngs = {number: random.Random(f"{SEED} {number}") for number in numbers}
    answers = {number: make_answer(key, rng) for number, rng in rngs.items()}
    for number, (text, _, _) in answers.items():
        (folder / f"answer{number}.yaml").write_text(text, encoding="utf-8")
    done = subprocess.run([RUN, "--grade", str(key), "--json", "-", *[str(folder / f"answer{number}.yaml") for number in answers]],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    if done.returncode not in (0, 4):
        report(model.name, 0, [], None, f"exit code {done.returncode}: {done.stderr.decode()}", "", {})
        return
    for number, result in zip(answers, json.loads(done.stdout)["answers"]):
        text, changes, expected = answers[number]
        report(model.name, number, changes, expected, fault(result, expected), text, result)


def main():
    models = [model for model in sorted((SOURCE / "models").glob("*/*.yaml")) if model.name not in BEYOND and Sheet(read(model), None).bodies]
    counts = {"right": 0, "wrong": 0}
    faults = []

    def report(model, number, changes, expected, said, text, result):
        counts["wrong" if expected else "right"] += 1
        if not said:
            return
        faults.append(said)
        print(f"# {model}, sheet {number} of seed {SEED}: {said}: {changes}")
        for one in result.get("tests", []):
            if one["kind"] != "right":
                print(f"#     {one['kind']}: {one['name']}: {one['message']}")
        if os.environ.get("FBD_KEEP"):
            Path(os.environ["FBD_KEEP"], f"{model}.{number}.yaml").write_text(text, encoding="utf-8")

    order = random.Random(SEED)
    with tempfile.TemporaryDirectory() as path:
        for data in (SOURCE / "models/data").glob("*.csv"):
            shutil.copy(data, path)
        for start in range(0, SHEETS, TOGETHER):
            numbers = range(start, min(SHEETS, start + TOGETHER))
            grade(Path(path), order.choice(models), numbers, report)
    print(f"{'not ok' if faults else 'ok'} 1 - {counts['right']} right answers are accused of nothing, and {counts['wrong']} of the one "
          f"error that they have ({len(faults)} not so)")
    print("1..1")
    return bool(faults)


if __name__ == "__main__":
    sys.exit(main())
