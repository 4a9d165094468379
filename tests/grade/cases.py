#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: cases.py FBD-RUN: keys and answers under cases/, graded as cases/EXPECTED says; an answer that would take long is
refused; and models of the gallery (every sixth; with FBD_DRAWS, as by `make generators`, each) are keys that have all
points for themselves, or that say what they lack. Prints TAP."""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

RUN = sys.argv[1]
SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
FOLDER = SOURCE / "tests" / "grade" / "cases"
SHARE = 1 if "FBD_DRAWS" in os.environ else 6 if os.environ.get("FBD_THOROUGH") != "no" else 24
count = bad = 0


def claim(fact, words, detail=""):
    global count, bad
    count += 1
    bad += not fact
    print(f"{'ok' if fact else 'not ok'} {count} - {words}")
    if not fact:
        print("\n".join("# " + line for line in str(detail).splitlines()))


def grade(key, answer):
    done = subprocess.run([RUN, "--grade", str(key), "--json", "-", str(answer)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    result = json.loads(done.stdout)["answers"][0] if done.returncode in (0, 4) else None
    return done.returncode, result, done.stderr.decode(errors="replace")


def kind_and_name(finding):
    return finding["kind"], finding["name"].partition(": ")[2]


def is_met(wanted, findings):
    """Each wanted `kind` or `kind name` by one finding, and no other."""
    left = list(findings)
    for one in wanted:
        kind, _, name = one.partition(" ")
        found = [f for f in left if f[0] == kind and name in ("", f[1])]
        if not found:
            return False
        left.remove(found[0])
    return not left


def test_cases():
    for line in (FOLDER / "EXPECTED").read_text(encoding="utf-8").splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        key, answer, code, points, wanted = (part.strip() for part in line.split("|"))
        got, result, errors = grade(FOLDER / f"{key}.yaml", FOLDER / (answer if "." in answer else f"{answer}.yaml"))
        findings = [kind_and_name(one) for one in result["tests"] if one["kind"] != "right"] if result else []
        fits = result and f"{result['points']:g} of {result['max_points']:g}" == points
        claim(got == int(code) and fits and is_met([part.strip() for part in wanted.split(";") if part.strip()], findings),
              f"{answer} for {key}: {points}", f"exit {got}: {json.dumps(result, indent=1)}{errors}")


def test_length(folder):
    key = FOLDER / "block_on_table_key.yaml"
    text = key.read_text(encoding="utf-8")
    sines = " + ".join(f"sin(v*{i}[s/m])" for i in range(500))
    lines = ", ".join(f'"m*a = T - mu*N + 0[N]*({sines})"' for _ in range(60))
    (folder / "long.yaml").write_text(text[:text.index("hand:")] + f"hand: [{lines}]\nsimulate: {{until: 1 s}}\n", encoding="utf-8")
    code, result, _ = grade(key, folder / "long.yaml")
    claim(code == 4 and not result["gradable"] and "longer" in result["message"], "an answer of 500 kB is not read", result)


def test_gallery():
    for model in sorted((SOURCE / "models").glob("*/*.yaml"))[::SHARE]:
        code, result, errors = grade(model, model)
        if code == 3:
            claim("nothing-to-grade" in errors, f"{model.name}: nothing to grade", errors)
            continue
        wrong = [one for one in result["tests"] if one["points"] < one["max_points"] or one["points"] < 0]
        told = "an answer has to draw reactions too" in errors
        claim(not wrong or (told and all(one["message"] == "a reaction is missing" for one in wrong)),
              f"{model.name}: all points for itself, or reactions that it says are missing", f"{wrong}\n{errors}")


def main():
    test_cases()
    with tempfile.TemporaryDirectory() as folder:
        test_length(Path(folder))
    test_gallery()
    print(f"1..{count}")
    return bad > 0


sys.exit(main())
