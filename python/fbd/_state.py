# SPDX-License-Identifier: GPL-3.0-or-later
"""States of a model, and what can be asked of one without time going on."""
from __future__ import annotations

import threading
from typing import Any, Dict, Iterator, Mapping, Optional, Tuple

from ._binding import ffi, lib
from ._library import bytes_of, checked, made, number, owned, taken, text_at
from ._linear import Linearization, Names
from ._records import Arrow, Coordinate, Equation, Limit, Member, Unbalanced, from_struct, picture, preformatted
from ._section import Section


def coordinates_of(model: Any) -> Tuple[Coordinate, ...]:
    """Of a C model, in its order."""
    found = []
    for i in range(lib.fbd_model_coordinate_count(model)):
        coordinate = lib.fbd_model_coordinate(model, i)
        body = text_at(lib.fbd_model_body_name(model, coordinate.body))
        found.append(from_struct(Coordinate, coordinate, body=body))
    return tuple(found)


def states_of(model: Any) -> Dict[str, str]:
    """The states of the file's own of a C model, by name with their units."""
    found = (lib.fbd_model_state(model, i) for i in range(lib.fbd_model_state_count(model)))
    return {text_at(state.name): text_at(state.unit) for state in found}


def _fill(function: Any, handle: Any, body: int) -> Tuple[Arrow, ...]:
    count = function(handle, body, ffi.NULL, 0)
    arrows = ffi.new("fbd_arrow[]", max(1, count))
    count = min(count, function(handle, body, arrows, count))
    return tuple(from_struct(Arrow, arrows[i]) for i in range(count))


def _diagrams(function: Any, handle: Any, model: Any) -> Dict[str, Tuple[Arrow, ...]]:
    bodies = range(lib.fbd_model_body_count(model))
    return {text_at(lib.fbd_model_body_name(model, b)): _fill(function, handle, b) for b in bodies}


def _equations_text(state: "State", form: int, components: bool) -> str:
    options = ffi.new("fbd_equations_options *", {"format": form, "components": bool(components)})
    return taken(checked(lib.fbd_equations_write, state._handle, options))


class Equations(Mapping[str, Equation]):
    """The assembled equations of a state, by coordinate: ``equations["pendulum.theta"].terms["gravity"]``.

    Printed they are the text of ``fbd-run --equations``; a notebook shows the free-body diagrams with it.
    """

    def __init__(self, state: "State", components: bool = False):
        assemble = lib.fbd_assemble_components if components else lib.fbd_assemble
        handle = owned(assemble(state._handle), lib.fbd_equations_free, state._handle)
        self._text = _equations_text(state, lib.FBD_TEXT, components)
        self._svg = taken(checked(lib.fbd_diagram_svg, state._handle, ffi.NULL))
        self._json = _equations_text(state, lib.FBD_JSON, components)
        self._equations: Dict[str, Equation] = {}
        for i in range(lib.fbd_equations_count(handle)):
            struct = lib.fbd_equations_get(handle, i)
            terms = {text_at(struct.terms[k].name): struct.terms[k].value for k in range(struct.term_count)}
            equation = from_struct(Equation, struct, terms=terms)
            self._equations[f"{equation.body}.{equation.coordinate}"] = equation

    def __getitem__(self, coordinate: str) -> Equation:
        return self._equations[coordinate]

    def __iter__(self) -> Iterator[str]:
        return iter(self._equations)

    def __len__(self) -> int:
        return len(self._equations)

    @property
    def svg(self) -> str:
        """The free-body diagrams as an SVG document."""
        return self._svg

    def json(self) -> str:
        """The equations and diagrams as one JSON object, as text."""
        return self._json

    def __str__(self) -> str:
        return self._text

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return picture(self._svg) + preformatted(self._text)


_limit_kinds = {lib.FBD_LIMIT_NORMAL: "normal", lib.FBD_LIMIT_FRICTION: "friction", lib.FBD_LIMIT_ROPE: "rope"}
_member_kinds = {lib.FBD_MEMBER_ROD: "rod", lib.FBD_MEMBER_ROPE: "rope", lib.FBD_MEMBER_BODY: "body"}


class Statics:
    """The scene at rest where it is, with every reaction (docs/statics.md)."""

    holds: bool  #: is it in equilibrium, within the limits of friction, contact and ropes?
    indeterminacy: int  #: how many reactions more than equations there are
    mobility: int  #: how many ways to move the supports leave
    undetermined: Tuple[str, ...]  #: reactions that equilibrium does not determine, "beam.pin in x"
    unbalanced: Tuple[Unbalanced, ...]  #: what would hold a scene that moves
    limits: Tuple[Limit, ...]
    members: Tuple[Member, ...]  #: two-force members and their forces
    diagram: Dict[str, Tuple[Arrow, ...]]  #: of each body

    def __init__(self, state: "State"):
        handle = made(lib.fbd_statics_new, lib.fbd_statics_free, (state._handle,), state._handle)
        self.holds = bool(lib.fbd_statics_holds(handle))
        self.indeterminacy = lib.fbd_statics_indeterminacy(handle)
        self.mobility = lib.fbd_statics_mobility(handle)
        undetermined = range(lib.fbd_statics_undetermined_count(handle))
        self.undetermined = tuple(text_at(lib.fbd_statics_undetermined(handle, i)) for i in undetermined)
        self.unbalanced = tuple(
            from_struct(Unbalanced, lib.fbd_statics_unbalanced(handle, i))
            for i in range(lib.fbd_statics_unbalanced_count(handle))
        )
        limits = [lib.fbd_statics_limit(handle, i) for i in range(lib.fbd_statics_limit_count(handle))]
        self.limits = tuple(from_struct(Limit, limit, kind=_limit_kinds[limit.kind]) for limit in limits)
        members = [lib.fbd_statics_member(handle, i) for i in range(lib.fbd_statics_member_count(handle))]
        self.members = tuple(from_struct(Member, member, kind=_member_kinds[member.kind]) for member in members)
        self.diagram = _diagrams(lib.fbd_statics_diagram, handle, state._model)
        self._text = taken(lib.fbd_statics_text(handle))
        self._json = taken(lib.fbd_statics_json(handle))

    def json(self) -> str:
        """One JSON object as text."""
        return self._json

    def __str__(self) -> str:
        return self._text

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return preformatted(self._text)


class State(Mapping[str, float]):
    """Time, coordinates and rates, by name: ``state["block.x"]`` in the units of the model.

    A state can be set, ``state["pendulum.theta"] = "60 deg"``; the body may be left out where only one has a
    coordinate of that name. Threads may share one: they wait for each other.
    """

    def __init__(self, model: Any):
        self._model = model
        self._handle = owned(lib.fbd_state_new(model), lib.fbd_state_free, model)
        self._lock = threading.RLock()
        coordinates = coordinates_of(model)
        own = states_of(model)
        self._names = ("t", *(c.name for c in coordinates), *(c.rate_name for c in coordinates), *own)
        self._units = ("s", *(c.unit for c in coordinates), *(c.rate_unit for c in coordinates), *own.values())

    # ---- by name

    def _full(self, name: str) -> str:
        """The qualified name, where it is clear; else the name as it is, for the library to complain of."""
        if name in self._names:
            return name
        ends = [full for full in self._names if full.rpartition(".")[2] == name]
        return ends[0] if len(ends) == 1 else name

    def _get(self, name: str) -> float:
        value = ffi.new("double *")
        if not lib.fbd_state_get(self._handle, name.encode(), value):
            raise KeyError(name)
        return float(value[0])

    def __getitem__(self, name: str) -> float:
        bytes_of(name, "a name")
        with self._lock:
            return self._get(self._full(name))

    def __setitem__(self, name: str, value: Any) -> None:
        full = self._full(bytes_of(name, "a name").decode())
        with self._lock:
            if isinstance(value, str) and full != "t":
                checked(lib.fbd_state_set_text, self._handle, full.encode(), bytes_of(value, f"`{name}`"))
            elif not lib.fbd_state_set(self._handle, full.encode(), number(value, f"`{name}`")):
                # The text of a number brings the complaint that there is no such name.
                checked(lib.fbd_state_set_text, self._handle, full.encode(), b"0")
                raise KeyError(name)

    def _set(self, values: Optional[Mapping[str, Any]], named: Mapping[str, Any]) -> None:
        for name, value in {**(values or {}), **named}.items():
            self[name] = value

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = object.__hash__

    @property
    def t(self) -> float:
        """Time [s]."""
        return self["t"]

    @property
    def units(self) -> Dict[str, str]:
        """The unit of each quantity."""
        return dict(zip(self._names, self._units))

    # ---- what can be asked

    def fit(self) -> "State":
        """Make it a state that a motion can start at: bodies with ``assemble`` find their place, the others fit
        their couplings. :class:`fbd.Error` says what a run would be refused for."""
        with self._lock:
            checked(lib.fbd_state_close, self._handle)
        return self

    def settle(self) -> "State":
        """Move it to the equilibrium where the scene comes to rest when it is let down slowly."""
        with self._lock:
            checked(lib.fbd_find_equilibrium, self._handle)
        return self

    def equations(self, components: bool = False) -> Equations:
        """The assembled equations here, term by term; with ``components`` also Newton's and Euler's of every body."""
        with self._lock:
            return Equations(self, components)

    def linearize(self, *, inputs: Names = (), outputs: Names = ()) -> Linearization:
        """Linearise about the equilibrium near it; the state is moved there. ``inputs`` of the file (default: all) and
        ``outputs`` (default: coordinates and states), as "cart.v_dot" or "rod.tip.x", are those of B, C and D."""
        with self._lock:
            return Linearization(self, inputs, outputs)

    def section(self, body: str, *, at_rest: bool = False) -> Section:
        """Normal force, shear force and bending moment along a straight body, in motion here or ``at_rest``."""
        with self._lock:
            return Section(self, body, at_rest)

    def statics(self) -> Statics:
        """The reactions that hold every body at rest here; rates count as zero."""
        with self._lock:
            return Statics(self)

    def diagram(self) -> Dict[str, Tuple[Arrow, ...]]:
        """All forces and moments on each body, reactions included."""
        with self._lock:
            return _diagrams(lib.fbd_diagram, self._handle, self._model)

    def redundant(self) -> Tuple[str, ...]:
        """Rows of couplings that depend on the rows before them: "knuckle in y"."""
        with self._lock:
            count = lib.fbd_redundant(self._handle, ffi.NULL, 0)
            names = ffi.new("const char *[]", max(1, count))
            count = min(count, lib.fbd_redundant(self._handle, names, count))
            return tuple(text_at(names[i]) for i in range(count))

    def svg(self, body: Optional[str] = None, components: bool = False, *, supports: bool = False, symbols: bool = False,
            worksheet: bool = False, solution: bool = False, scale: float = 0, system: bool = False) -> str:
        """The free-body diagrams as an SVG document, of one body or of all; with the components of each force, with what the
        bodies are cut free from, with symbols instead of values, as a worksheet or its solution; 10 mm stand for `scale`. With
        `system` the bodies joined, with supports, springs, ropes and applied forces."""
        name = ffi.NULL if body is None else ffi.new("char[]", bytes_of(body, "the body"))
        with self._lock:
            drawing = ffi.new("fbd_drawing *", {
                "body": name, "components": bool(components), "supports": bool(supports), "symbols": bool(symbols),
                "worksheet": bool(worksheet), "solution": bool(solution), "scale": float(scale), "system": bool(system)})
            return taken(checked(lib.fbd_diagram_svg, self._handle, drawing))

    def __repr__(self) -> str:
        return "<fbd.State " + ", ".join(f"{name} = {value:.9g} {unit}" for (name, value), unit
                                         in zip(self.items(), self._units)) + ">"

    def _repr_html_(self) -> str:
        return picture(self.svg()) + preformatted(repr(self)[11:-1])
