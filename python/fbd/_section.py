# SPDX-License-Identifier: GPL-3.0-or-later
"""Section forces along a straight body."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Dict, Tuple, Union

from ._binding import ffi, lib
from ._library import bytes_of, checked, made, number, taken
from ._records import from_struct, picture, preformatted

if TYPE_CHECKING:
    from ._state import State


@dataclass(frozen=True)
class Cut:
    """The forces of a section at x, with the signs of docs/statics.md."""

    x: float  #: from the first end [m]
    N: float  #: normal force, positive in tension [N]
    V: float  #: shear force [N]
    M: float  #: bending moment [N*m]


class Section:
    """Normal force, shear force and bending moment along a straight body (``fbd-run --cut``).

    ``section.at("1.2 m")`` is one place, ``section.extremes["M"]`` the least and the greatest value with their places
    as ``((x, value), (x, value))``. Printed it is the table of ``fbd-run``; a notebook shows the diagrams.
    """

    length: float  #: of the axis [m]
    extremes: Dict[str, Tuple[Tuple[float, float], Tuple[float, float]]]

    def __init__(self, state: "State", body: str, at_rest: bool):
        name = bytes_of(body, "the body")
        statics = ffi.NULL
        if at_rest:
            statics = made(lib.fbd_statics_new, lib.fbd_statics_free, (state._handle,), state._handle)
        handle = made(lib.fbd_section_new, lib.fbd_section_free, (state._model,), state._handle, statics, name)
        self._handle, self.length = handle, float(lib.fbd_section_length(handle))
        self.extremes = {}
        for i, force in enumerate("NVM"):
            ends = [lib.fbd_section_extreme_of(handle, i, greatest) for greatest in (False, True)]
            self.extremes[force] = ((ends[0].x, ends[0].value), (ends[1].x, ends[1].value))

    def at(self, x: Union[float, str], *, behind: bool = False) -> Cut:
        """The section at a distance from the first end, or at a named point of the body; where the forces jump, before
        it or ``behind`` it."""
        if isinstance(x, str):
            place = ffi.new("double *")
            checked(lib.fbd_section_place, self._handle, bytes_of(x, "the place"), place)
            x = float(place[0])
        distance = number(x, "x")
        if not 0 <= distance <= self.length:
            raise ValueError(f"x = {distance:g} lies outside of the body, whose axis is {self.length:.9g} long")
        return from_struct(Cut, lib.fbd_section_at(self._handle, distance, bool(behind)))

    @property
    def svg(self) -> str:
        """The diagrams of N, V and M as an SVG document."""
        return taken(lib.fbd_section_svg(self._handle))

    def json(self) -> str:
        """One JSON object as text."""
        return taken(lib.fbd_section_json(self._handle, ffi.NULL))

    def __str__(self) -> str:
        return taken(lib.fbd_section_text(self._handle, ffi.NULL))

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return picture(self.svg) + preformatted(str(self))
