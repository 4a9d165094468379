# SPDX-License-Identifier: GPL-3.0-or-later
"""What accuracy and effects cost (docs/cost.md)."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Optional, Sequence, Tuple

from ._binding import ffi, lib
from ._library import made, names_of, number, positive, taken, text_at
from ._records import Stats, from_struct, picture, preformatted
from ._watch import in_background

_states = {lib.FBD_POINT_MEASURED: "measured", lib.FBD_POINT_FAILED: "failed", lib.FBD_POINT_SKIPPED: "skipped"}


@dataclass(frozen=True)
class CostPoint:
    """One method with one setting on the scene: what error is left, and what it costs."""

    method: str
    tolerance: float  #: 0 with a fixed step
    step: float  #: [s], or 0
    state: str  #: "measured", "failed" or "skipped"
    reason: str  #: "" when measured
    error: float  #: largest true error over the run, relative to the largest size of its quantity
    error_end: float  #: the same at the end
    worst: str  #: the quantity of ``error``
    floor: bool  #: no more than what the reference is in doubt by
    event_error: float  #: of the times of events [s]; nan without
    same_events: bool
    seconds: float  #: of one run without output: the median
    low: float  #: its quartiles
    high: float
    repeats: int
    front: bool  #: no other point is both more accurate and cheaper
    stats: Stats


@dataclass(frozen=True)
class Effect:
    """The scene with one effect left out, beside the scene itself."""

    body: str
    name: str
    change: str
    reason: str  #: why there is no number, or ""
    change_end: float  #: of the answer, relative to its size
    change_max: float
    worst: str
    noise: bool
    time: float  #: run time without it / run time of the scene
    events: int  #: of the run without it, less those of the scene


def _options(until: Optional[float], budget: float, methods: Sequence[str], quantities: Sequence[str],
             fixed_steps: bool) -> Tuple[Any, Any]:
    method_names, method_count, first = names_of(methods, "a method")
    quantity_names, quantity_count, second = names_of(quantities, "a quantity")
    options = ffi.new("fbd_cost_options *", {
        "until": float("nan") if until is None else number(until, "until"), "budget": positive(budget, "the budget"),
        "methods": method_names, "method_count": method_count,
        "quantities": quantity_names, "quantity_count": quantity_count, "fixed_steps": bool(fixed_steps),
    })
    return options, (method_names, first, quantity_names, second)


class _Study:
    """Texts of a study."""

    _prefix: str
    _handle: Any

    def _told(self, what: str) -> str:
        return taken(getattr(lib, f"fbd_{self._prefix}_{what}")(self._handle))

    def csv(self) -> str:
        """As CSV text."""
        return self._told("csv")

    def json(self) -> str:
        """As one JSON object, as text."""
        return self._told("json")

    def __str__(self) -> str:
        return self._told("text")

    __repr__ = __str__


class Cost(_Study):
    """True error against time, for every method at every tolerance of a ladder."""

    _prefix = "cost"
    points: Tuple[CostPoint, ...]

    def __init__(self, handle: Any):
        self._handle = handle
        points = (lib.fbd_cost_point(handle, i) for i in range(lib.fbd_cost_point_count(handle)))
        self.points = tuple(self._point(point) for point in points)

    @staticmethod
    def _point(point: Any) -> CostPoint:
        return from_struct(CostPoint, point, state=_states[point.state], stats=from_struct(Stats, point.stats))

    @property
    def reference(self) -> str:
        """What the errors are measured against, in words."""
        return text_at(lib.fbd_cost_reference(self._handle).says)

    def cheapest(self, error: float) -> Optional[CostPoint]:
        """The cheapest point whose error is at most that; None when there is none."""
        point = lib.fbd_cost_cheapest(self._handle, positive(error, "the error"))
        return None if point.method == ffi.NULL else self._point(point)

    @property
    def svg(self) -> str:
        """The work-precision diagram as an SVG document."""
        return self._told("svg")

    def _repr_html_(self) -> str:
        return picture(self.svg) + preformatted(str(self))


class Effects(_Study):
    """What each effect that the scene lists changes, and what it costs."""

    _prefix = "effects"
    effects: Tuple[Effect, ...]

    def __init__(self, handle: Any):
        self._handle = handle
        count = lib.fbd_effects_count(handle)
        self.effects = tuple(from_struct(Effect, lib.fbd_effects_get(handle, i)) for i in range(count))

    def _repr_html_(self) -> str:
        return preformatted(str(self))


def _study(make: Any, free: Any, model: Any, options: Mapping[str, Any]) -> Any:
    chosen, kept = _options(**options)
    return in_background(lambda: (made(make, free, (model,), model, chosen), kept))[0]


def cost(model: Any, **options: Any) -> Cost:
    return Cost(_study(lib.fbd_cost_new, lib.fbd_cost_free, model, options))


def effects(model: Any, **options: Any) -> Effects:
    return Effects(_study(lib.fbd_effects_new, lib.fbd_effects_free, model, options))
