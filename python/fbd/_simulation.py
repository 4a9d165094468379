# SPDX-License-Identifier: GPL-3.0-or-later
"""A motion that is advanced step by step, with inputs that change on the way."""
from __future__ import annotations

import math
import threading
from typing import TYPE_CHECKING, Any, Dict, List, Tuple

from ._binding import ffi, lib
from ._library import bytes_of, checked, made, number, run_options, text_at
from ._notes import Error, RunFailed, complaint
from ._records import Event, from_struct
from ._state import State
from ._watch import Watch

if TYPE_CHECKING:
    from ._model import Model


class Simulation:
    """A motion that is advanced to one time after the other (:meth:`fbd.Model.simulate`).

    An input keeps its value until it is set anew. A change restarts the integration from the state at that time; while no
    input changes the steps do not depend on the times that are asked for. Threads may share one: they wait for each
    other.
    """

    def __init__(self, model: "Model", options: Dict[str, Any]):
        self._file, self._options = model, options
        self._model, self._holds = model._model, False
        self._lock = threading.RLock()
        self._events: List[Event] = []  # before the inputs were held
        self._t, self._outcome = 0.0, lib.FBD_GOING
        plain, method = run_options(**options)
        self._simulation = made(lib.fbd_simulation_new, lib.fbd_simulation_free, (self._model,), self._model, plain)
        del method
        self._state = self._at(0.0)

    # ---- models

    def _hold_inputs(self) -> None:
        """Continue with the model in which all inputs that no function computes are set between steps. It is compiled at
        the first change; until then the steps are those of a run."""
        values = {name: each.value for name, each in self._file.parameters.items() if each.input and not math.isnan(each.value)}
        names = [ffi.new("char[]", bytes_of(name, "an input")) for name in values]
        callbacks = ffi.new("fbd_callback[]", len(names))
        for callback, name in zip(callbacks, names):
            callback.input = name
        model = made(lib.fbd_model_with_callbacks, lib.fbd_model_free, (self._file._calls,), self._file._model, callbacks,
                     len(names))
        count = lib.fbd_state_pack(self._state._handle, ffi.NULL, 0)
        numbers = ffi.new("double[]", count + len(values))
        lib.fbd_state_pack(self._state._handle, numbers, count)
        numbers[count:count + len(values)] = list(values.values())
        start = State(model)
        if not lib.fbd_state_unpack(start._handle, numbers, count + len(values)):
            raise Error((complaint("error", "not-here", "an input that switches `hysteresis`, or a coupling, on and off cannot be changed"),))
        options, method = run_options(**self._options)
        simulation = made(lib.fbd_simulation_from, lib.fbd_simulation_free, (model,), start._handle, options)
        del method
        self._events = self._present_events()
        self._model, self._simulation, self._holds = model, simulation, True

    def _at(self, t: float) -> State:
        state = State(self._model)
        if not lib.fbd_simulation_state(self._simulation, t, state._handle):
            raise RuntimeError(f"fbd: there is no state at t = {t:.9g}")
        return state

    # ---- going on

    @property
    def t(self) -> float:
        """The time that has been reached [s]."""
        return self._t

    @property
    def state(self) -> State:
        """The state at that time; at an event the one after it."""
        return self._state

    @property
    def ended(self) -> bool:
        """True if an event of the file, or the end time, has ended the motion."""
        return bool(self._outcome in (lib.FBD_DONE, lib.FBD_STOPPED, lib.FBD_BROKEN) and self._t >= self._reached())

    @property
    def events(self) -> Tuple[Event, ...]:
        """What happened until now, in the order of time."""
        with self._lock:
            return (*self._events, *self._present_events())

    def _present_events(self) -> List[Event]:
        structs = [lib.fbd_simulation_event(self._simulation, i)
                   for i in range(lib.fbd_simulation_event_count(self._simulation))]
        return [from_struct(Event, struct, kind=text_at(lib.fbd_event_kind_name(struct.kind)))
                for struct in structs if struct.t <= self._t]

    def _reached(self) -> float:
        to = ffi.new("double *")
        lib.fbd_simulation_interval(self._simulation, ffi.NULL, to)
        return float(to[0])

    def advance(self, t: float) -> State:
        """Go to a time [s], or to the end of the motion if that comes first; the state there. A motion that cannot
        continue is raised as :class:`fbd.RunFailed`, without a run."""
        target = number(t, "t")
        with self._lock:
            if target < self._t:
                raise ValueError(f"t = {target:g} lies before the time {self._t:.9g} s that has been reached")
            watch = Watch(None, self._file._calls)
            lib.glue_seek(self._simulation, target, watch.context)
            watch.end()
            if self._file._calls is not None:
                self._file._calls.end()
            self._outcome = lib.fbd_simulation_outcome(self._simulation)
            if self._outcome in (lib.FBD_FAILED, lib.FBD_OUT_OF_MEMORY) and self._reached() <= target:
                reason = text_at(lib.fbd_simulation_reason(self._simulation))
                raise RunFailed((complaint("error", "run-failed", reason),), None)
            self._t = min(target, self._reached())
            self._state = self._at(self._t)
            return self._state

    def set_input(self, name: str, value: Any) -> None:
        """Set an input of the file from now on, to a number in its unit or a text with one ("8 N")."""
        with self._lock:
            known = self._file.parameters.get(name)
            if known is None or not known.input:
                inputs = ", ".join(f"`{each}`" for each, is_a in self._file.parameters.items() if is_a.input)
                hint = f"its inputs: {inputs}" if inputs else "the file has no `inputs`"
                raise Error((complaint("error", "unknown-input", f"the file declares no input `{name}`; {hint}"),))
            if math.isnan(known.value):
                raise Error((complaint("error", "fixed-input", f"the input `{name}` is computed by a function"),))
            plain = self._number(name, value, known.unit)
            if not self._holds:
                if plain == known.value:
                    return
                self._hold_inputs()
            checked(lib.fbd_simulation_set_input, self._simulation, self._t, bytes_of(name, "an input"), plain)
            self._state = self._at(self._t)

    def _number(self, name: str, value: Any, unit: str) -> float:
        """A value of an input in its unit."""
        if not isinstance(value, str):
            return number(value, f"input `{name}`")
        result = ffi.new("double *")
        checked(lib.fbd_model_quantity, self._model, bytes_of(name, "an input"), bytes_of(value, f"input `{name}`"),
                bytes_of(unit, "a unit"), result)
        return float(result[0])

    def __repr__(self) -> str:
        return f"<fbd.Simulation at t = {self._t:.9g} s, {len(self.events)} events>"
