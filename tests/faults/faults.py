#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every file of the table EXPECTED, which says how a row is read, and holds it to what it must show."""
import csv
import functools
import json
import os
import re
import shlex
import sys
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
sys.path[:0] = [str(SOURCE / "tests" / "page"), str(SOURCE / "tests" / "tools")]
import limits  # pylint: disable=wrong-import-position
from claims import claim, close, finish  # pylint: disable=wrong-import-position

FOLDER = SOURCE / "tests" / "faults"
PROGRAMS = Path(os.environ["FBD_RUN"]).parent
# A sanitizer looks at each file once: numbers, which take another run, are the same there.
THOROUGH = os.environ.get("FBD_THOROUGH") != "no"
NUMBER = re.compile(r"^(\S+) = (\S+) \+- (\S+)$")


def rows():
    """(file, program and its options, exit code, what it must show) of each row."""
    for line in (FOLDER / "EXPECTED").read_text(encoding="utf-8").splitlines():
        if not line.strip() or line.startswith("#"):
            continue
        file, options, code, what = (part.strip() for part in line.split("|", 3))
        words = shlex.split(options)
        program = words.pop(0) if words and words[0].startswith("fbd-") else "fbd-run"
        yield file, [program, *words], int(code), [part.strip() for part in what.split(";") if part.strip()]


@functools.cache
def output(program, options, file):
    """The finished program; run once, whatever is claimed of it."""
    return limits.run([PROGRAMS / program, *options, FOLDER / file], input=b"", capture_output=True, check=False)


def run(command, file, code):
    """(standard output, standard error) of a program that ends with that code."""
    program, *options = command
    done = output(program, tuple(options), file)
    out, err = done.stdout.decode(errors="replace"), done.stderr.decode(errors="replace")
    assert done.returncode == code, f"exit code {done.returncode} instead of {code}: {err}"
    return out, err


def no_key_twice(pairs):
    names = [name for name, _ in pairs]
    assert len(set(names)) == len(names), f"a key stands twice in {names}"
    return dict(pairs)


def numbers(value):
    """Every number of a JSON value; null is what stands for one that is not finite."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for part in value:
            yield from numbers(part)
    elif value is None or isinstance(value, float):
        yield value


def as_json(command, file, code):
    return json.loads(run([*command, "--json", "-"], file, code)[0], object_pairs_hook=no_key_twice)


def as_csv(command, file, code):
    return list(csv.reader(run([*command, "--ledger", "--csv", "-"], file, code)[0].splitlines()))


def hold(what, command, file, code):
    """One claim of a row."""
    kind, _, rest = what.partition(" ")
    if kind in ("says", "never"):
        out, err = run(command, file, code)
        found = re.search(rest, out + err, re.MULTILINE) is not None
        assert found == (kind == "says"), f"what it says: {out}{err}"
    elif what == "one name each":
        as_json(command, file, code)
        no_key_twice([(name, 0) for name in as_csv(command, file, code)[0]])
    elif what == "all finite":
        bad = [x for x in numbers(as_json(command, file, code)) if x is None or not abs(x) < float("inf")]
        bad += [x for row in as_csv(command, file, code)[1:] for x in row if not abs(float(x)) < float("inf")]
        assert not bad, f"not finite: {bad}"
    else:
        path, want, tolerance = NUMBER.match(what).groups()
        value = as_json(command, file, code)
        for name in path.split("/"):
            value = value[int(name)] if isinstance(value, list) else value[name]
        close(value, float(want), float(tolerance))


def main():
    for file, command, code, whats in rows():
        title = " ".join([*command, file])
        with claim(f"{title}: exit code {code}"):
            run(command, file, code)
        for what in whats:
            if not THOROUGH and what.split()[0] not in ("says", "never"):
                continue
            with claim(f"{title}: {what}"):
                hold(what, command, file, code)
    listed = {file for file, *_ in rows()}
    for file in sorted(str(path.relative_to(FOLDER)) for path in FOLDER.glob("*/*.yaml")):
        with claim(f"{file} is in the table"):
            assert file in listed
    finish()


main()
