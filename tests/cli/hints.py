#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Hints that show what to write are followed: for each such hint of tests/bad one of the edits that a reader would make
with the text shown removes the message and brings no other error into its place.

    hints.py [FILE...]
"""
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / folder) for folder in ("page", "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, finish  # pylint: disable=wrong-import-position

NOTE = re.compile(r"^[^:\n]+:(\d+):(\d+): (error|warning): (.*)\n    hint: (.*)$|^[^:\n]+:(\d+):(\d+): error: (.*)$",
                  re.MULTILINE)
SHOWN = re.compile(r"(?:(?:^|[:;] |variable |, )write|did you mean|^it is|^the key is) `([^`]*)`(?!, which)")

# Forms with names that stand for others.
FORMS = {"name: value", "through: [a, drum, b]", "along", "y", "hysteresis(u, low, high)"}


# Every twelfth file; with FBD_DRAWS (`make generators`) each.
SHARE = 1 if "FBD_DRAWS" in os.environ else 12

# Right hints, behind which another mistake of the file comes to light.
BEFORE_OTHERS = {("slot_with_friction.yaml", "kinetic"), ("plane_with_open_weight.yaml", "normal"),
                 ("plane_with_open_weight.yaml", "points")}


def notes(text, folder):
    """(line, column, severity, message, hint) of each note."""
    path = Path(folder) / "m.yaml"
    path.write_bytes(text.encode("utf-8", "surrogateescape"))
    done = limits.run([os.environ["FBD_RUN"], "--check", path], capture_output=True, stdin=subprocess.DEVNULL,
                      check=False)
    for match in NOTE.finditer(done.stderr.decode("utf-8", "replace")):
        line, column, severity, message, hint, bare_line, bare_column, bare = match.groups()
        if bare:
            yield int(bare_line), int(bare_column), "error", bare, ""
        else:
            yield int(line), int(column), severity, message, hint


def edits(lines, line, column, shown):
    """The text with `shown` in the place of the word, value, pair or entry at that place, the shortest first."""
    old, at = lines[line - 1], column - 1
    starts = [m.end() for m in re.finditer(r"^\s*|[:,{\[-]\s*|[\s(*/\[]|\b(?=\W)|(?<=\W)", old[:at + 1]) if m.end() <= at]
    ends = [m.start() for m in re.finditer(r"\s*(?:[,}\])#*/]|$)|\b", old) if m.start() > at] + [at + 1]
    for start, end in sorted({(a, b) for a in starts for b in ends}, key=lambda span: span[1] - span[0]):
        yield "\n".join([*lines[:line - 1], old[:start] + shown + old[end:], *lines[line:]])


def leads_on(text, note, shown, before, folder):
    line, column, _, message, _ = note
    others = {other[3] for other in before if other is not note}
    for edit in edits(text.split("\n"), line, column, shown):
        after = list(notes(edit, folder))
        if not any(n[3] not in others and (n[3] == message or n[2] == "error" and abs(n[0] - line) <= 1) for n in after):
            return True
    return False


def main():
    paths = [Path(name) for name in sys.argv[1:]] or sorted((SOURCE / "tests" / "bad").glob("*.yaml"))[::SHARE]
    followed = 0
    with tempfile.TemporaryDirectory() as folder:
        for path in paths:
            text = path.read_bytes().decode("utf-8", "surrogateescape")
            before = list(notes(text, folder))
            for note in before:
                for shown in SHOWN.findall(note[4]):
                    if "..." in shown or shown in FORMS or (path.name, shown) in BEFORE_OTHERS:
                        continue
                    if "needs quotes" in note[4]:
                        shown = f'"{shown}"'
                    with claim(f"{path.name}:{note[0]}:{note[1]}: {shown}"):
                        assert leads_on(text, note, shown, before, folder), f"{note[3]}: {note[4]}"
                        followed += 1
    if not sys.argv[1:]:
        with claim("there are such hints"):
            assert followed > 0
    finish()


main()
