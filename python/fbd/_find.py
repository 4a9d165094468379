# SPDX-License-Identifier: GPL-3.0-or-later
"""At which value of a parameter (docs/find.md)."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Callable, Mapping, Optional, Tuple

from ._binding import ffi, lib
from ._library import bytes_of, made, run_options, settings_of, taken, text_at, whole
from ._notes import Error
from ._records import Progress, preformatted
from ._watch import Watch

_kinds = {lib.FBD_SOLUTION_ROOT: "root", lib.FBD_SOLUTION_CHANGE: "change", lib.FBD_SOLUTION_JUMP: "jump"}


@dataclass(frozen=True)
class Solution:
    """A value of the parameter."""

    kind: str  #: "root" of an equation or margin, "change" of an outcome, "jump": no value solves the equation there
    value: float
    error: float  #: estimated, of any sign
    closed_form: bool  #: from a margin of statics that is linear in the parameter
    below: str  #: what happens with smaller values; of a root the difference of both sides
    above: str


@dataclass(frozen=True)
class Gap:
    """A run of the search without a value, beside which was not searched."""

    value: float
    failed: bool
    status: str  #: as in a sweep
    reason: str


class Found:
    """The solutions of a question, in ascending order; a sequence of :class:`fbd.Solution`."""

    def __init__(self, handle: Any):
        self._text = taken(lib.fbd_find_text(handle))
        self._json = taken(lib.fbd_find_json(handle))
        found = lib.fbd_find_summary(handle)
        #: the parameter, the unit of all its values, and the condition
        self.parameter, self.unit, self.condition = (
            text_at(found.parameter), text_at(found.unit), text_at(found.condition))
        #: the range that was searched, and the distance of the runs of the scan: of two solutions closer than
        #: that both may be missed
        self.low, self.high, self.step = getattr(found, "from"), found.to, found.step
        #: of an equation: the difference of its sides is linear in the range, and there is no other solution
        self.linear = bool(found.linear)
        #: all runs, those of the scan, and those that failed
        self.runs, self.scan, self.failed = found.runs, found.scan, found.failed
        solutions = (lib.fbd_find_solution(handle, i) for i in range(lib.fbd_find_solution_count(handle)))
        self._solutions = tuple(
            Solution(_kinds[s.kind], s.value, s.error, s.closed_form, text_at(s.below), text_at(s.above)) for s in solutions)
        gaps = (lib.fbd_find_gap_get(handle, i) for i in range(lib.fbd_find_gap_count(handle)))
        #: the runs without a value
        self.gaps = tuple(Gap(g.value, g.failed, text_at(g.status), text_at(g.reason)) for g in gaps)

    def __len__(self) -> int:
        return len(self._solutions)

    def __getitem__(self, index: int) -> Solution:
        return self._solutions[index]

    def json(self) -> str:
        """What ``fbd-run --find --json`` writes."""
        return self._json

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        values = ", ".join(f"{solution.value:.9g}" for solution in self._solutions)
        return f"<fbd.Found: {self.parameter} = [{values}]{' ' + self.unit if self.unit else ''}>"

    def _repr_html_(self) -> str:
        return preformatted(self._text)


def find(source: bytes, name: bytes, question: str, parameters: Mapping[str, Any], statics: bool, runs: int,
         progress: Optional[Callable[[Progress], Any]], options: Mapping[str, Any]) -> Found:
    asked = bytes_of(question, "the question")
    named = question.split(":")[0].split("=")[0].strip()
    settings, count, kept = settings_of({n: v for n, v in parameters.items() if n != named})
    run, method = run_options(**options)
    watch = Watch(progress)
    plan = ffi.new("fbd_find_plan *", {
        "settings": settings, "setting_count": count, "run": run, "statics": bool(statics),
        "runs": whole(runs, "runs", 1000000), "progress": watch.function, "progress_context": watch.context,
    })
    try:
        handle = made(lib.fbd_find_parse, lib.fbd_find_free, (), source, len(source), name, asked, plan)
    except Error:
        watch.end()
        raise
    watch.end()
    del kept, method
    return Found(handle)
