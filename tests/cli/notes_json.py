#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors as data: the notes of --json are those that are printed; what is written when a model or an option is wrong. The
fixes are those of tests/unit/test_fixes.c."""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / folder) for folder in ("page", "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, finish  # pylint: disable=wrong-import-position

INCLINE = SOURCE / "models/kinetics/incline.yaml"

# Every twelfth file; with FBD_DRAWS (`make generators`) each.
SHARE = 1 if "FBD_DRAWS" in os.environ else 12


def fbd_run(*arguments):
    """Exit code, JSON on standard output (None without), and what is printed as errors."""
    done = limits.run([os.environ["FBD_RUN"], *map(str, arguments)], capture_output=True, stdin=subprocess.DEVNULL, check=False)
    return done.returncode, json.loads(done.stdout) if done.stdout else None, done.stderr.decode("utf-8", "replace")


def heads(notes):
    """The first line of each note as it is printed."""
    for note in notes:
        place = f"{note['line']}:{note['column']}:" if note["line"] else ""
        file = f"{note['file']}:" if note["file"] else ""
        yield f"{file}{place}{' ' if file or place else ''}{note['severity']}: {note['message']} [{note['id']}]"


def same_as_printed():
    os.chdir(SOURCE / "tests/bad")
    for path in sorted(Path(".").glob("*.yaml"))[::SHARE]:
        _, answer, printed = fbd_run("--check", "--json", "-", path)
        with claim(f"{path.name}: the notes are those that are printed"):
            assert [line for line in printed.splitlines() if line in set(heads(answer["notes"]))] == list(heads(answer["notes"]))


def answers_of_runs(folder):
    wrong = Path(folder) / "wrong.yaml"
    wrong.write_text(INCLINE.read_text().replace("forces:", "focres:"))
    for mode in ([], ["--equations"], ["--static"], ["--linearize"], ["--check"]):
        with claim(f"{' '.join(mode) or 'a run'} of a wrong model writes its notes"):
            code, answer, _ = fbd_run(*mode, "--json", "-", wrong)
            assert code == 3
            assert answer["notes"][0]["fix"]["with"] == "forces"
    with claim("a right one is checked without notes"):
        assert fbd_run("--check", "--json", "-", INCLINE)[:2] == (0, {"notes": []})
    with claim("a wrong option is a note, too"):
        code, answer, _ = fbd_run("--until", "-1", "--json", "-", INCLINE)
        assert code == 2 and answer["notes"][0]["id"] == "bad-option"
    with claim("the result of a run is no list of notes"):
        assert "notes" not in fbd_run("--json", "-", INCLINE)[1]
    with claim("--check --json FILE writes a file"):
        assert fbd_run("--check", "--json", Path(folder) / "n.json", wrong)[0] == 3
        assert len(json.loads((Path(folder) / "n.json").read_text())["notes"]) > 0
    with claim("a data file is not overwritten"):
        data = Path(folder) / "data.csv"
        data.write_text("t,x\n0,0\n1,1\n")
        wrong.write_text("fbd: 1\ntables: {f: {file: data.csv, x: t, y: x}}\nbodies: {a: {mass: 1}}\n")
        assert fbd_run("--check", "--json", data, wrong)[0] in (2, 3)
        assert data.read_text().startswith("t,x")


def main():
    same_as_printed()
    with tempfile.TemporaryDirectory() as folder:
        answers_of_runs(folder)
    finish()


main()
