#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: tests/verify/verify.py BUILD [NAME...]   write docs/verification.md and its line in README.md (`make verify`)

Runs every model of tests/books and tests/verify/cases against what others have published for it, with the default
method and with each of the others, and the programs beside fbd. With NAMEs only those cases, and nothing is written.
"""
import platform
import re
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import beside
from case import Case, Refused

SOURCE = Path(__file__).resolve().parent.parent.parent
METHODS = ["dop853", "rodas5p", "rk4", "rkf45", "rkck", "rk8pd", "rk4imp", "bsimp", "msadams", "msbdf"]
MARK = "[docs/verification.md](docs/verification.md)"  # the line of README.md


class Outcome:
    """What a case came to with one method: the largest error, in units of the uncertainty, and where."""

    def __init__(self, case, method):
        case.method, case.seconds, case.cache, case.limit = method, 0.0, {}, 60 if method is None else 10
        self.method, self.ratio, self.worst, self.got, self.why = method or "auto", 0.0, None, {}, ""
        try:
            for answer in case.answers:
                self._hold(answer, case.get(answer))
        except (Refused, AssertionError, KeyError, IndexError, StopIteration) as failure:
            self.ratio, self.why = float("inf"), f"{type(failure).__name__}: {failure}".replace("\n", " ")[:200]
        self.seconds = case.seconds

    def _hold(self, answer, got):
        want = answer["instead"] or answer
        error = abs(got - want["value"])
        ratio = 0.0 if error == 0 else error / want["within"] if want["within"] else float("inf")
        self.got[answer["name"]] = got
        if self.worst is None or not ratio <= self.ratio:
            self.ratio, self.worst = ratio, answer


class Row:
    """A case with the outcomes of all methods."""

    def __init__(self, case):
        self.case = case
        self.default = Outcome(case, None)
        takes_time = any("run(" in answer["expression"] or "rows(" in answer["expression"] for answer in case.answers)
        names = [] if case.say["methods"] == "none" or not takes_time else METHODS
        names = case.say["methods"].split(", ") if names and case.say["methods"] != "all" else names
        self.others = sorted((Outcome(case, name) for name in names), key=lambda one: (one.ratio, one.seconds))
        self.wrong_prints = [answer for answer in case.answers if answer["instead"]]

    def status(self):
        if not self.default.ratio <= 1:
            return "**missed**"
        return "met; print wrong" if self.wrong_prints else "met"

    def answers(self):
        """The worst answer as printed, and as fbd has it."""
        if self.default.worst is None:
            return "", self.default.why
        one = self.default.worst
        more = len(self.case.answers) - 1
        got = f"{self.default.got[one['name']]:.12g}" if one["name"] in self.default.got else self.default.why
        unit = f" {one['unit']}" if one["unit"] else ""
        printed = f"{one['name']} = {one['value']:.12g}{unit} ± {one['within']:.2g}" + (f" (worst of {more + 1})" if more else "")
        return printed, got

    def best(self):
        return ", ".join(f"{one.method} {one.ratio:.2g} ({milliseconds(one.seconds)})" for one in self.others[:3] if one.ratio < float("inf"))

    def cells(self):
        printed, got = self.answers()
        default_time = milliseconds(self.default.seconds)
        path = self.case.path.relative_to(SOURCE)
        return [f"[{self.case.path.stem}](../{path})", printed, got, f"{self.default.ratio:.2g}", default_time, self.best(), self.status()]


def milliseconds(seconds):
    if seconds < 1e-3:
        return "< 1 ms"  # less than some clocks tell
    return f"{seconds * 1e3:.2g} ms" if seconds < 0.0995 else f"{seconds * 1e3:.0f} ms"


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "| " + " | ".join("---" for _ in head) + " |"]
    return lines + ["| " + " | ".join(str(cell).replace("|", "\\|") for cell in row) + " |" for row in rows]


def counts(rows):
    met = [row for row in rows if row.default.ratio <= 1]
    wrong = sum(1 for row in met if row.wrong_prints)
    return len(rows), len(met), wrong, len(rows) - len(met), max((row.default.ratio for row in met), default=0.0)


def summary(rows):
    cases, met, wrong, missed, largest = counts(rows)
    return (f"{met} of {cases} published cases agree, {missed} do not; for {wrong} the printed answer is wrong, which a separate derivation shows; "
            f"the largest error of those that agree is {largest:.2g} of the uncertainty of the reference")


def waiting(cases):
    """Rows for the models that the language cannot read yet, and for the cases that have no model."""
    text = (SOURCE / "tests" / "books" / "waiting" / "WITHOUT_MODEL").read_text(encoding="utf-8")
    return [[case.path.stem, case.title(), case.source(), case.say["needs"]] for case in cases] + [
        line.split(" | ") for line in text.splitlines() if line and line[0] != "#"]


INTRODUCTION = """# Verification against published results

Written by `make verify` (tests/verify), the command that reproduces every figure here; times are those of one machine ({machine}).
{summary}.

The first lines of each model give its question, its source, the method of the published number and its uncertainty
(tests/verify/case.py describes the format); the compared values are outputs of the program. The uncertainty of a number in a book is its
rounding. Where a reference has more digits than a run at the default tolerance of 1e-10 provides, the requirement is 1e-8 of the size of the motion
(1e-7 where errors grow during the motion, or the tolerance of the benchmark). *error* is the largest one of a case with the default method, in units of
that uncertainty: up to 1 the case is met. *best* are the three other methods with the smallest errors at the same tolerance. Missed cases stay in the table."""


def document(rows, unread, crossed):
    head = ["case", "published", "fbd", "error", "time", "best three", ""]
    books = [row for row in rows if SOURCE / "tests" / "books" in row.case.path.parents]
    others = [row for row in rows if row not in books]
    lines = INTRODUCTION.format(machine=platform.machine(), summary=summary(rows)).splitlines()
    for name, part in (("Books", books), ("Benchmarks", others)):
        lines += ["", f"## {name}", "", summary(part) + ".", "", *table(head, [row.cells() for row in part])]
    lines += ["", "## Sources and methods", ""]
    lines += table(["case", "problem", "source", "method"], [[row.case.path.stem, row.case.title(), row.case.source(), row.case.say["method"]] for row in rows])
    lines += ["", "## Wrong printed answers", ""]
    for row in rows:
        for answer in row.wrong_prints:
            unit = f" {answer['unit']}" if answer["unit"] else ""
            lines.append(f"- **{row.case.path.stem}**, {answer['name']}: printed {answer['value']:.6g}{unit}, right {answer['instead']['value']:.9g}{unit}: {answer['instead']['why']}")
    missed = [row for row in rows if not row.default.ratio <= 1]
    lines += ["", "## Missed", ""]
    lines += [f"- {row.case.path.stem}: {row.default.why or f'{row.default.ratio:.2g} times the uncertainty'}" for row in missed] or ["None."]
    lines += ["", "## Waiting", "", "Cases whose models need features that the language does not have yet.", ""]
    lines += table(["case", "problem", "source", "needs"], waiting(unread))
    lines += ["", "## Other programs", "", *crossed, ""]
    return "\n".join(lines)


def main():
    build, names = Path(sys.argv[1]).resolve(), sys.argv[2:]
    started = time.monotonic()
    folders = ("tests/books", "tests/books/waiting", "tests/verify/cases")
    cases = [Case(path, build / "apps") for folder in folders for path in sorted((SOURCE / folder).glob("*.yaml")) if not names or path.stem in names]
    unread = [case for case in cases if case.say["needs"] and not case.is_read()]
    with ThreadPoolExecutor(2) as pool:
        rows = list(pool.map(Row, [case for case in cases if case not in unread]))
    for row in rows:
        print(f"{row.status():17s} {row.case.path.stem:36s} {row.default.ratio:8.2g}  {row.best()}  {row.default.why}")
    print(summary(rows))
    if names:
        return
    crossed = beside.lines(SOURCE, build)
    (SOURCE / "docs" / "verification.md").write_text(document(rows, unread, crossed), encoding="utf-8")
    readme = SOURCE / "README.md"
    text = readme.read_text(encoding="utf-8")
    line = f"- {MARK}: {summary(rows)}"
    pattern = rf"^- {re.escape(MARK)}.*$"
    assert re.search(pattern, text, re.MULTILINE), "README.md has no line for docs/verification.md"
    readme.write_text(re.sub(pattern, lambda _: line, text, flags=re.MULTILINE), encoding="utf-8")
    print(f"docs/verification.md written, {time.monotonic() - started:.0f} s")


main()
