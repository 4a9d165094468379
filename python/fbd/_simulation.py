# SPDX-License-Identifier: GPL-3.0-or-later
"""A motion that is advanced step by step, with inputs that change on the way."""
from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any, Dict, List, Tuple

from ._binding import ffi, lib
from ._library import made, number, quantity, run_options, settings_of, text_at
from ._notes import Error, RunFailed, complaint
from ._records import Event, from_struct
from ._state import State
from ._watch import Watch

if TYPE_CHECKING:
    from ._model import Model


class Simulation:
    """A motion that is advanced to one time after the other (:meth:`fbd.Model.simulate`).

    An input keeps its value until it is set anew. A change restarts the integration from the state at that time, with
    the model of the new value, as an FMU does; while no input changes the steps do not depend on the times that are
    asked for. Threads may share one: they wait for each other.
    """

    def __init__(self, model: "Model", options: Dict[str, Any]):
        self._file, self._options = model, options
        self._inputs: Dict[str, Any] = {}
        self._lock = threading.RLock()
        self._events: List[Event] = []
        self._t, self._outcome = 0.0, lib.FBD_GOING
        self._begin(None)
        self._state = self._at(0.0)

    # ---- models and restarts

    def _begin(self, state: Any) -> None:
        """A simulation with the present inputs, from a state of the model before, or from the start of the file."""
        model = self._compiled()
        options, name = run_options(**self._options)
        if state is None:
            simulation = made(lib.fbd_simulation_new, lib.fbd_simulation_free, (model,), model, options)
        else:
            start = State(model)
            count = lib.fbd_state_pack(state._handle, ffi.NULL, 0)
            numbers = ffi.new("double[]", max(1, count))
            lib.fbd_state_pack(state._handle, numbers, count)
            if not lib.fbd_state_unpack(start._handle, numbers, count):
                raise Error((complaint("error", "not-here", "an input that switches `hysteresis`, or a coupling, on and off cannot be changed"),))
            simulation = made(lib.fbd_simulation_from, lib.fbd_simulation_free, (model,), start._handle, options)
        del name
        self._model, self._simulation = model, simulation

    def _compiled(self) -> Any:
        file = self._file
        if not self._inputs:
            return file._model
        source = file._read_again()
        settings, count, kept = settings_of({**file._parameters, **self._inputs})
        model = made(lib.fbd_model_parse, lib.fbd_model_free, (), source, len(source), file._name, settings, count)
        del kept
        return model

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
            text = quantity(value, f"input `{name}`")
            if self._inputs.get(name) == text:
                return
            before = dict(self._inputs), self._present_events()
            self._inputs[name] = text
            try:
                self._begin(self._state)
            except BaseException:
                self._inputs = before[0]
                raise
            self._events += before[1]
            self._state = self._at(self._t)

    def __repr__(self) -> str:
        return f"<fbd.Simulation at t = {self._t:.9g} s, {len(self.events)} events>"
