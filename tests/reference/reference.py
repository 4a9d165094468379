#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: tests/reference/reference.py BUILD FOLDER [--record]   (`make reference`)

Write reference data of thirty systems and of the grid of inclined planes into FOLDER, as CSV and JSON
(docs/reference-systems.md describes them); with --record also the states at the ends into recorded.csv beside this file.
Exit code 1 if a value has less than 12 digits, or differs from a closed form.

Each system is run twice with error bars: by dop853 at a tolerance of 1e-14, and by rk8pd at 2e-14 without the use of
structure. A value is that of the first run; its error is the largest of both bars and of the difference of the runs.
"""
import csv
import io
import json
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from math import inf
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parent))
import grid  # pylint: disable=wrong-import-position
from systems import SYSTEMS  # pylint: disable=wrong-import-position

RECORDED = Path(__file__).resolve().parent / "recorded.csv"
SOURCE = Path(__file__).resolve().parent.parent.parent
METHODS = (["--method", "dop853", "--tolerance", "1e-14"], ["--method", "rk8pd", "--tolerance", "2e-14", "--no-structure"])
SAMPLES = 10  # evenly spaced times after the start
DIGITS = 5e-13  # an error of more than this, of the size, has less than 12 digits
ROUNDING = 8e-15  # of a closed form, of the size
SMALLEST = 1e-2  # size of a quantity, in its unit, that is smaller all the time
GRAVITY = 9.81


@dataclass
class Value:
    """A quantity with its error, and its closed form where there is one (None otherwise)."""
    name: str
    unit: str
    value: float
    error: float
    closed: float | None = None

    def fault(self, size):
        """What is wrong with it beside the size of the quantity, or an empty string."""
        if not self.error <= DIGITS * size:
            return f"{self.name} = {self.value!r} has an error of {self.error:.2g}, of {size:.3g}"
        if self.closed is not None and not abs(self.value - self.closed) <= self.error + ROUNDING * size:
            return f"{self.name} = {self.value!r} is {self.closed!r} in closed form, the error {self.error:.2g}"
        return ""


def run(programs, system, options):
    """The object of --json and the rows of the CSV, as {column: [values]}."""
    with tempfile.TemporaryDirectory() as folder:
        motion, result = Path(folder) / "motion.csv", Path(folder) / "result.json"
        command = [programs / "fbd-run", "--error-bars", *options, "--every", repr(system.until / SAMPLES), "--until", repr(system.until)]
        for name, value in system.set.items():
            command += ["--set", f"{name}={value}"]
        done([*command, "--quiet", "--csv", motion, "--json", result, SOURCE / "models" / system.model])
        rows = list(csv.reader(io.StringIO(motion.read_text(encoding="utf-8"))))
        return json.loads(result.read_text(encoding="utf-8")), rows[0], [[number(cell) for cell in row] for row in rows[1:]]


def done(command):
    """The output of a program that has to succeed."""
    return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True).stdout


def number(cell):
    return float(cell) if cell else inf


def at_samples(head, rows):
    """{time: {name: (unit, value, bar)}} of the rows at even times after the start; events in between have rows of their own."""
    every, found = rows[-1][0] / SAMPLES, {}
    for row in rows:
        n = round(row[0] / every)
        if n > 0 and abs(row[0] - n * every) <= 1e-14 * rows[-1][0]:
            pairs = [(head[i].split(" [")[0], head[i].split(" [")[1].rstrip("]"), row[i], row[i + 1]) for i in range(1, len(head), 2)]
            found[n] = (row[0], {name: (unit, value, bar) for name, unit, value, bar in pairs})
    return [found[n] for n in range(1, SAMPLES + 1)]


def both(one, other):
    """The error of a value from two runs: of the bars and the difference the largest."""
    return max(one[1], other[1], abs(one[0] - other[0]))


class Reference:
    """The data of one system."""

    def __init__(self, programs, system):
        first, second = (run(programs, system, options) for options in METHODS)
        self.system, self.result, self.faults = system, first[0], []
        self.until = first[2][-1][0]
        self.p = SimpleNamespace(g=GRAVITY, **self.result["parameters"])
        self.states = self._states(at_samples(*first[1:]), at_samples(*second[1:]))
        self.events = self._events(first[0]["events"], second[0]["events"])
        self._judge()

    def _states(self, first, second):
        """[(time, [Value])]."""
        rows = []
        for (t, ours), (_, others) in zip(first, second):
            closed = self.system.states(self.p, t)
            unknown = closed.keys() - ours.keys()
            assert not unknown, f"{self.system.name}: no columns {unknown}"
            rows.append((t, [Value(name, unit, value, both((value, bar), others[name][1:]), closed.get(name))
                             for name, (unit, value, bar) in ours.items()]))
        return rows

    def _events(self, first, second):
        """[(kind, body, name, Value of the time)]."""
        kinds = [[(event["kind"], event["body"], event["name"]) for event in events] for events in (first, second)]
        if kinds[0] != kinds[1]:
            self.faults.append("the events of the two runs differ")
        closed, rows = self.system.events(self.p), []
        for n, pair in enumerate(zip(first, second)):
            error = both(*((event["t"], inf if event["t_error"] is None else event["t_error"]) for event in pair))
            rows.append((*kinds[0][n], Value("t", "s", pair[0]["t"], error, closed.get(n))))
        return rows

    def _judge(self):
        sizes = {"s": self.until}
        for _, values in self.states:
            for value in values:
                sizes[value.unit] = max(sizes.get(value.unit, SMALLEST), abs(value.value))
        all_values = [(f"at {t:g} s: ", value) for t, values in self.states for value in values]
        all_values += [(f"event {n}, {event[0]}: ", event[3]) for n, event in enumerate(self.events)]
        self.faults += [where + value.fault(sizes[value.unit]) for where, value in all_values if value.fault(sizes[value.unit])]
        self.sizes = sizes
        self.largest = max(value.error / sizes[value.unit] for _, value in all_values)
        self.known = sum(value.closed is not None for _, value in all_values)

    def record(self):
        """Rows of recorded.csv: the number of events, the time of the last one, and the state at the end, to 12 digits."""
        rows = [[self.system.name, "events", len(self.events)]]
        rows += [[self.system.name, "last event [s]", f"{self.events[-1][3].value:.12g}"]] if self.events else []
        return rows + [[self.system.name, f"{value.name} [{value.unit}]", f"{value.value if abs(value.value) > value.error else 0:.12g}"]
                       for value in self.states[-1][1]]

    def as_object(self):
        """For JSON."""
        model = (SOURCE / "models" / self.system.model).read_text(encoding="utf-8")
        values = lambda value: {"value": value.value, "error": value.error, "unit": value.unit} | (
            {} if value.closed is None else {"closed_form": value.closed})
        return {"system": self.system.name, "kind": self.system.kind, "title": self.result["title"], "gravity": GRAVITY, "until": self.until,
                "set": self.system.set, "parameters": self.result["parameters"], "model": model,
                "states": [{"t": t} | {value.name: values(value) for value in row} for t, row in self.states],
                "events": [{"kind": kind, "body": body, "name": name, "t": values(t)} for kind, body, name, t in self.events]}


def write_csv(path, head, rows):
    with path.open("w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *rows])


def cells(value):
    return [repr(value.value), f"{value.error:.2g}", "" if value.closed is None else repr(value.closed)]


def write(folder, references):
    folder.mkdir(parents=True, exist_ok=True)
    write_csv(folder / "systems.csv", ["system", "kind", "title", "until [s]", "events", "closed forms", "largest error"],
              [[one.system.name, one.system.kind, one.result["title"], one.until, len(one.events), one.known, f"{one.largest:.1e}"] for one in references])
    write_csv(folder / "parameters.csv", ["system", "parameter", "value"],
              [[one.system.name, name, repr(value)] for one in references for name, value in one.result["parameters"].items()])
    write_csv(folder / "states.csv", ["system", "t [s]", "quantity", "unit", "value", "error", "closed form"],
              [[one.system.name, t, value.name, value.unit, *cells(value)] for one in references for t, row in one.states for value in row])
    write_csv(folder / "events.csv", ["system", "number", "kind", "body", "name", "t [s]", "error", "closed form"],
              [[one.system.name, n, kind, body, name, *cells(t)] for one in references for n, (kind, body, name, t) in enumerate(one.events)])
    (folder / "systems.json").write_text(json.dumps([one.as_object() for one in references], indent=1) + "\n", encoding="utf-8")
    for one in references:
        (folder / f"{one.system.name}.yaml").write_text(one.as_object()["model"], encoding="utf-8")


def write_grid(folder, rows):
    head, lines = grid.table(rows)
    write_csv(folder / "incline_grid.csv", head, lines)
    of = lambda point: {"mode": "stick" if point.sticks else "slip"} | point.values
    (folder / "incline_grid.json").write_text(json.dumps(
        [{"v0": hand.v0, "mu": hand.mu, "angle_deg": hand.angle, "closed_form": of(hand), "computed": of(one), "error": errors}
         for hand, one, errors in rows], indent=1) + "\n", encoding="utf-8")


def main():
    programs, folder = Path(sys.argv[1]) / "apps", Path(sys.argv[2])
    references = [Reference(programs, system) for system in SYSTEMS]
    write(folder, references)
    if sys.argv[3:] == ["--record"]:
        write_csv(RECORDED, ["system", "quantity", "value"], [row for one in references for row in one.record()])
    for one in references:
        print(f"{one.system.name}: {len(one.states)} times, {len(one.events)} events, {one.known} closed forms, largest error {one.largest:.1e}")
        for fault in one.faults:
            print(f"  {fault}")
    rows = grid.compared(programs)
    write_grid(folder, rows)
    wrong = list(grid.faults(rows, ROUNDING))
    print(f"incline_grid: {len(rows)} points, {sum(hand.sticks for hand, *_ in rows)} of them stick at {grid.T:g} s")
    for fault in wrong:
        print(f"  {fault}")
    return 1 if wrong or any(one.faults for one in references) else 0


if __name__ == "__main__":
    sys.exit(main())
