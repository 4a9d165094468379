# SPDX-License-Identifier: GPL-3.0-or-later
"""Differences between two outputs of one scene. Nothing here starts a program."""
import csv
import json
import math
import re

# In order of importance; `words` is the line of the summary.
KINDS = {
    "crash": "programs that crash or use up their processor time in one revision alone",
    "outcome": "outcomes that differ: exit code, outcome, ids of messages",
    "events": "events that differ: kind, body or time",
    "states": "final states that differ",
    "motion": "motions that differ along the run, with equal final states",
    "works": "works and energies that differ",
    "forces": "forces that differ",
    "keys": "results whose names differ",
    "text": "texts that differ",
}
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
# What a run has cost is no result: lines of the report, and times of the clock anywhere.
COST = re.compile(r"^  \d+ steps \(\d+ rejected\).*$|\"stats\": \{.*\}|\b[\d.]+ (?:ms|s) of processor time"
                  r"|(\d+ right-hand sides.*)?\d+ event samples.*$|\"seconds\": ?[-\d.e]+", re.MULTILINE)
ID = re.compile(r"\[([a-z][a-z0-9-]+)\]$", re.MULTILINE)


class Difference:
    """One difference of one scene: `size` sorts those of a kind."""

    def __init__(self, kind, words, size=1.0, group=""):
        self.kind, self.words, self.size, self.group = kind, words, size, group
        self.sensitive = False
        self.scene = self.command = self.folder = None

    def key(self):
        return (list(KINDS).index(self.kind), self.sensitive, -self.size)


# ---- numbers

def apart(a, b, scale):
    """The difference of two numbers in units of scale; NaN equals NaN."""
    if a == b or (math.isnan(a) and math.isnan(b)):
        return 0.0
    if not (math.isfinite(a) and math.isfinite(b)):
        return math.inf
    return abs(a - b) / scale if scale > 0 else math.inf


def same_number(a, b, tolerance):
    """Whether two printed numbers agree: within the tolerance, or by one unit of the last printed decimal."""
    x, y = float(a), float(b)
    if abs(x - y) <= tolerance * max(abs(x), abs(y)) + 1e-3 * tolerance:
        return True
    units = []
    for text in (a, b):
        mantissa, _, exponent = text.lower().partition("e")
        decimals = len(mantissa.partition(".")[2])
        if decimals < 3:
            return False
        units.append(10.0 ** (int(exponent or 0) - decimals))
    return abs(x - y) <= 1.01 * max(units)


# ---- texts

def same_line(a, b, tolerance):
    if a == b:
        return True
    if NUMBER.sub("#", a) != NUMBER.sub("#", b):
        return False
    return all(same_number(x, y, tolerance) for x, y in zip(NUMBER.findall(a), NUMBER.findall(b)))


def text_difference(base, new, tolerance):
    """(number of lines that differ, first of base, first of new), or None."""
    if base == new:
        return None
    one, two = (COST.sub("", text).splitlines() for text in (base, new))
    while one and two and same_line(one[-1], two[-1], tolerance):
        one.pop(), two.pop()
    start = 0
    while start < min(len(one), len(two)) and same_line(one[start], two[start], tolerance):
        start += 1
    one, two = one[start:], two[start:]
    if not one and not two:
        return None
    count = max(len(one), len(two))
    if len(one) == len(two):
        count = sum(not same_line(a, b, tolerance) for a, b in zip(one, two))
    return count, one[0] if one else "(no such line)", two[0] if two else "(no such line)"


# ---- outcomes

def outcome(run):
    """(exit code, what the result says, ids of the messages) of a finished program."""
    said = ""
    if run.json is not None:
        said = run.json.get("outcome", "")
    return run.code, said, tuple(sorted(set(ID.findall(run.err))))


def outcome_words(seen):
    code, said, ids = seen
    words = f"exit code {code}" if isinstance(code, int) else code
    return ", ".join([words, *([f"`{said}`"] if said else []), *ids])


def outcome_difference(base, new):
    one, two = outcome(base), outcome(new)
    if one == two:
        return None
    kind = "outcome" if isinstance(one[0], int) and isinstance(two[0], int) else "crash"
    words = f"{outcome_words(one)} -> {outcome_words(two)}"
    worse = isinstance(one[0], int) and not isinstance(two[0], int)
    return Difference(kind, words, size=(4 if worse else 2) + (one[0] != two[0]), group=words)


# ---- events

def event_times(events):
    """Body, kind and name of events, each with its times in order."""
    times = {}
    for event in events:
        key = (event.get("body") or "", event.get("kind") or "", event.get("name") or "")
        times.setdefault(key, []).append(float(event["t"]))
    return {key: sorted(found) for key, found in times.items()}


def unmatched(one, two, slack):
    """The times of each of two sorted lists that have no partner in the other."""
    alone, i, j = ([], []), 0, 0
    while i < len(one) and j < len(two):
        if abs(one[i] - two[j]) <= slack:
            i, j = i + 1, j + 1
        elif one[i] < two[j]:
            alone[0].append(one[i])
            i += 1
        else:
            alone[1].append(two[j])
            j += 1
    return alone[0] + one[i:], alone[1] + two[j:]


def events_difference(base, new, tolerance, span):
    one, two = event_times(base), event_times(new)
    found = []
    for key in one.keys() | two.keys():
        alone = unmatched(one.get(key, []), two.get(key, []), tolerance * max(span, 1e-300))
        for side, times in zip(("base", "new"), alone):
            found += [(t, side, key) for t in times]
    if not found:
        return None
    t, side, (body, kind, name) = min(found)
    words = (f"{len(base)} -> {len(new)} events, {len(found)} without a partner; first t = {t:.9g} "
             f"{' '.join(part for part in (body, kind, name) if part)}, only in {side}")
    return Difference("events", words, size=(1 - t / span if span > 0 else 1) + (len(base) != len(new)))


# ---- columns

def table(text):
    """(header, rows of numbers) of a CSV."""
    rows = list(csv.reader(text.splitlines()))
    if not rows:
        return [], []
    return rows[0], [[float(cell) if cell else math.nan for cell in row] for row in rows[1:]]


def column_kind(name, states):
    plain = name.partition(" [")[0]
    if plain == "t":
        return "time"
    if plain in states:
        return "states"
    if plain.startswith("energy.") or plain.endswith(".work"):
        return "works"
    return "forces"


def column_scales(header, rows, states):
    """The scale of each column: coordinates by their own size, others by the largest of their unit."""
    sizes = [max((abs(row[i]) for row in rows if math.isfinite(row[i])), default=0.0) for i in range(len(header))]
    largest = {}
    for name, size in zip(header, sizes):
        unit = (column_kind(name, states), name.partition(" [")[2])
        largest[unit] = max(largest.get(unit, 0.0), size)
    scales = []
    for name, size in zip(header, sizes):
        kind = column_kind(name, states)
        most = largest[(kind, name.partition(" [")[2])]
        scales.append(max(size, 1e-6 * most) if kind == "states" else most)
    return scales


def worst(header, scales, one, two, kinds, tolerance):
    """(size, words) of the worst cell of two rows among columns of a kind, or None."""
    found = None
    for name, kind, scale, a, b in zip(header, kinds, scales, one, two):
        size = apart(a, b, scale)
        if kind != "time" and size > tolerance and (found is None or size > found[0]):
            found = (size, f"{name}: {a:.12g} -> {b:.12g}")
    return found


def table_differences(base, new, states, tolerance):
    """Differences of two CSV texts: of their last rows, and where both have the same rows along the run."""
    (header, one), (header_new, two) = table(base), table(new)
    if header != header_new:
        only = [name for name in header if name not in header_new], [name for name in header_new if name not in header]
        return [Difference("keys", f"columns only in base: {only[0][:3]}, only in new: {only[1][:3]}")]
    if not one or not two:
        return [] if bool(one) == bool(two) else [Difference("states", f"{len(one)} -> {len(two)} rows", math.inf)]
    kinds = [column_kind(name, states) for name in header]
    scales = column_scales(header, one + two, states)
    found = []
    span = max(abs(one[-1][0]), 1e-300)
    in_step = len(one) == len(two) and all(abs(a[0] - b[0]) <= tolerance * span for a, b in zip(one, two))
    for kind in ("states", "works", "forces"):
        mine = [kind if each == kind else "time" for each in kinds]
        at_end = worst(header, scales, one[-1], two[-1], mine, tolerance)
        if at_end:
            found.append(Difference(kind, f"at the end {at_end[1]}", at_end[0]))
            continue
        along = [(seen, a[0]) for a, b in zip(one, two) if (seen := worst(header, scales, a, b, mine, tolerance))]
        if in_step and along:
            (size, words), t = max(along)
            found.append(Difference("motion" if kind == "states" else kind, f"at t = {t:.9g} {words}", size))
    return found


# ---- a result as JSON

def leaves(value, path=""):
    """Path and value of each number, word and truth value of a JSON value."""
    if isinstance(value, dict):
        for key, part in value.items():
            if key not in ("stats", "seconds"):
                yield from leaves(part, f"{path}/{key}")
    elif isinstance(value, list):
        for i, part in enumerate(value):
            yield from leaves(part, f"{path}/{i}")
    else:
        yield path, value


def json_difference(base, new, tolerance):
    """The first difference of two JSON values, numbers beside the largest of their last name, or None."""
    one, two = dict(leaves(base)), dict(leaves(new))
    if one.keys() != two.keys():
        only = sorted(one.keys() - two.keys())[:3], sorted(two.keys() - one.keys())[:3]
        return Difference("keys", f"names only in base: {', '.join(only[0]) or 'none'}; only in new: "
                                  f"{', '.join(only[1]) or 'none'}")
    scales = {}
    for path, value in [*one.items(), *two.items()]:
        if isinstance(value, (int, float)):
            name = path.rpartition("/")[2]
            scales[name] = max(scales.get(name, 0.0), abs(value))
    found = []
    for path, a in one.items():
        b = two[path]
        if isinstance(a, (int, float)) and isinstance(b, (int, float)):
            size = apart(a, b, max(scales[path.rpartition("/")[2]], 1e-9))
            if size > tolerance:
                found.append((size, path, a, b))
        elif a != b and not (isinstance(a, str) and isinstance(b, str) and same_line(a, b, tolerance)):
            found.append((math.inf, path, a, b))
    if not found:
        return None
    size, path, a, b = max(found, key=lambda each: each[0])
    return Difference("text", f"{len(found)} values, first {path}: {a} -> {b}", size)


def state_names(result):
    """The columns of the CSV that are coordinates and speeds: body.name."""
    return {f"{body}.{name}" for body, values in result.get("final", {}).items() if isinstance(values, dict)
            for name in values}


def run_differences(base, new, tolerance):
    """Differences of two whole runs that end alike: events, states, works, forces."""
    found = []
    states = state_names(base.json or {})
    if base.json is not None and new.json is not None:
        span = float(base.json.get("final", {}).get("t") or 0)
        found.append(events_difference(base.json.get("events", []), new.json.get("events", []), tolerance, span))
    if base.csv is not None and new.csv is not None:
        found += table_differences(base.csv, new.csv, states, tolerance)
    return [each for each in found if each]


def differences(output, base, new, tolerance):
    """Every difference of one output of two programs, the weightiest first."""
    found = outcome_difference(base, new)
    if found:
        return [found]
    found = run_differences(base, new, tolerance) if output == "run" else []
    if output != "run" and base.json is not None and new.json is not None:
        found += filter(None, [json_difference(base.json, new.json, tolerance)])
    elif not found:
        text = text_difference(base.out, new.out, 1e-3 if output == "run" else tolerance)
        if text:
            count, one, two = text
            found.append(Difference("text", f"{output}: {count} lines; first\n    - {one.strip()[:150]}\n"
                                            f"    + {two.strip()[:150]}", count))
    message = text_difference(base.err, new.err, tolerance)
    if message and not found:
        found.append(Difference("text", f"messages; first\n    - {message[1][:150]}\n    + {message[2][:150]}",
                                message[0], "messages"))
    for each in found:
        if each.kind in ("keys", "text"):
            each.group = each.group or output # one thing that all scenes say otherwise is shown once
    return sorted(found, key=Difference.key)


def parsed(text):
    """A JSON object, or None where the text is none."""
    try:
        value = json.loads(text)
    except ValueError:
        return None
    return value if isinstance(value, dict) else None
