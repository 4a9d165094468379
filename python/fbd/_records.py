# SPDX-License-Identifier: GPL-3.0-or-later
"""Plain results: the structs of fbd.h, with its names.

Units are those of the model: SI (m, kg, s, N, N*m, J, rad), or in a file with ``units: US`` ft, slug, s, lbf,
ft*lbf and rad.
"""
from __future__ import annotations

import html
from base64 import b64encode
from dataclasses import dataclass, fields
from typing import Any, Dict, Type, TypeVar

from ._binding import ffi
from ._library import text_at

T = TypeVar("T")


def from_struct(record: Type[T], struct: Any, /, **others: Any) -> T:
    """A record from the fields of a struct that have its names."""
    values = dict(others)
    for field in fields(record):
        if field.name not in values:
            value = getattr(struct, field.name)
            values[field.name] = text_at(value) if isinstance(value, ffi.CData) else value
    return record(**values)


@dataclass(frozen=True)
class Inertia:
    """What a body weighs and how it turns."""

    mass: float  #: kg (slug)
    I_G: float  #: about the centre of mass, kg*m^2
    I_O: float  #: of a pivot about its axis, else 0
    L: float  #: of a pivot from its axis O to the centre of mass G, else 0, m
    G: "tuple[float, float]"  #: centre of mass in the frame of the body, m


@dataclass(frozen=True)
class Coordinate:
    """A coordinate of the scene and its rate, with qualified names: "block.x", "block.v"."""

    name: str
    unit: str
    rate_name: str
    rate_unit: str
    body: str


@dataclass(frozen=True)
class Parameter:
    """A parameter or an input of the file with its value in the model."""

    name: str
    unit: str  #: "" for a pure number, or one whose dimension follows from its use
    description: str
    value: float  #: in that unit
    input: bool  #: of ``inputs``: it may change during a motion
    derived: bool  #: defined by other parameters or gravity
    low: float  #: of its range; nan where the file does not give it
    high: float


@dataclass(frozen=True)
class Equation:
    """One assembled equation: inertia * acceleration = sum of terms."""

    body: str
    coordinate: str  #: "x"
    inertia_name: str  #: "m", "I_O" or "I_G"
    acceleration_name: str  #: "v_dot", "omega_dot", ...
    unit: str  #: of terms and sum: "N", "N*m", ...
    inertia_unit: str
    acceleration_unit: str
    inertia: float
    sum: float
    acceleration: float
    normal: float  #: of a slide the normal force on the body [N], else 0
    terms: Dict[str, float]  #: by name, in ``unit``


@dataclass(frozen=True)
class Arrow:
    """One force or moment of a free-body diagram."""

    name: str
    fx: float  #: force in the world [N]
    fy: float
    x: float  #: where it acts [m]
    y: float
    couple: float  #: a moment by itself [N*m]
    moment: float  #: about the axis of a pivot, else about the centre of mass [N*m]
    power: float  #: [W]


@dataclass(frozen=True)
class Event:
    """What happened in a run."""

    t: float  #: [s]
    kind: str  #: "stick", "breakaway", "impact", "user", ...: docs/output.md
    body: str  #: "" for an event of the file
    name: str  #: of the event of the file, or of the load
    detail: str
    t_error: float  #: estimated error of t [s]; nan without error bars, inf when it is not known


@dataclass(frozen=True)
class Stats:
    """What a run has cost, and the estimate of its global error (docs/error-bars.md)."""

    method: str
    tolerance: float
    steps: int
    stiff_steps: int
    rejected: int
    rhs: int
    jacobians: int
    events: int
    event_samples: int
    seconds: float  #: processor time of the run itself
    error_estimate: float  #: relative; nan without error bars, inf when it is not known
    companion_steps: int
    companion_rhs: int
    accuracy: float  #: that was asked for, or 0
    runs: int  #: made to reach it
    seconds_spent: float  #: of all of them, with ledgers, output and companions
    groups: int
    linear: int
    constant: int
    velocity_free: int


@dataclass(frozen=True)
class Energy:
    """Energies of the scene [J]. ``work``: what the forces without a potential have done since the start;
    ``residual``: change of kinetic + potential - work, which says how right the run is."""

    kinetic: float
    potential: float
    work: float
    residual: float
    initial_kinetic: float
    initial_potential: float


@dataclass(frozen=True)
class Drift:
    """How far a run with couplings was from them at the ends of its steps, before it was brought back and
    after (``left_``): position [m], velocity [m/s], and the larger one over the tolerance times the size of the
    motion."""

    rows: int
    position: float
    velocity: float
    share: float
    left_position: float
    left_velocity: float
    left_share: float
    worst: str  #: "knuckle in x"; "" without couplings


@dataclass(frozen=True)
class Progress:
    """How far a run is."""

    t: float  #: simulated time reached [s]
    until: float  #: end time [s]
    steps: int
    events: int


@dataclass(frozen=True)
class Mode:
    """One eigenvalue of a linearisation."""

    re: float  #: [1/s]
    im: float  #: [rad/s]
    frequency: float  #: its size [rad/s]
    damping_ratio: float  #: -re / frequency; nan for an eigenvalue 0

    @property
    def eigenvalue(self) -> complex:
        """re + im j [1/s]."""
        return complex(self.re, self.im)


@dataclass(frozen=True)
class Member:
    """A two-force member: a rod, a rope, or a body that is loaded at two points only."""

    name: str
    kind: str  #: "rod", "rope" or "body"
    tension: float  #: N; below zero: compression


@dataclass(frozen=True)
class Limit:
    """What a surface, a friction or a rope has to bear at rest, and whether it does."""

    name: str  #: "block.friction"
    unit: str
    kind: str  #: "normal" and "rope": needed >= 0; "friction": needed <= limit
    needed: float
    limit: float
    holds: bool


@dataclass(frozen=True)
class Unbalanced:
    """A force or moment along a coordinate that would hold a scene that moves: alone, or all of them together."""

    coordinate: str
    unit: str
    holding: float
    alone: bool


class HandCheck(int):
    """How many hand derivations differ from the assembly; ``text`` says which term of which is at fault."""

    text: str

    def __new__(cls, differ: int, text: str) -> "HandCheck":
        made = super().__new__(cls, differ)
        made.text = text
        return made

    def __repr__(self) -> str:
        return f"{int(self)} differ\n{self.text}"

    def __str__(self) -> str:
        return self.text

    def __reduce__(self) -> Any:
        return HandCheck, (int(self), self.text)


def picture(svg: str) -> str:
    """An SVG document as an element of a page, whose ids cannot meet those of another one."""
    return f'<img alt="diagram" style="background: white" src="data:image/svg+xml;base64,{b64encode(svg.encode()).decode()}">'


def preformatted(text: str) -> str:
    return f"<pre>{html.escape(text)}</pre>"
