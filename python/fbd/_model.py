# SPDX-License-Identifier: GPL-3.0-or-later
"""A model: a file compiled, and what can be done with it."""
from __future__ import annotations

import json
import os
from typing import Any, Callable, Dict, Mapping, Optional, Sequence, Tuple, Type, Union

from . import _cost, _find, _fit, _inputs, _run, _sweep
from ._files import fmu_library, put
from ._binding import ffi, lib
from ._find import Found
from ._fit import Data, Fit
from ._library import (bytes_of, checked, made, names_of, notes_of, owned, path_of, run_options, settings_of, taken, text_at,
                       whole)
from ._linear import Linearization, Names
from ._notes import Error, Note, complaint
from ._records import Coordinate, HandCheck, Inertia, Parameter, Progress, from_struct, picture
from ._run import Run
from ._section import Section
from ._simulation import Simulation
from ._state import Equations, State, Statics, coordinates_of
from ._sweep import SweepTable, Vary
from ._widget import Sliders

Values = Optional[Mapping[str, Any]]
Hand = Mapping[str, Sequence[str]]
Time = Union[float, str, None]


def read_notes(source: bytes, name: bytes, parameters: Mapping[str, Any]) -> Tuple[Tuple[Note, ...], Tuple[str, ...]]:
    """The notes on a text and on its start, and the files that have been read for it."""
    errors = owned(lib.fbd_errors_new(), lib.fbd_errors_free)
    settings, count, kept = settings_of(dict(parameters))
    handle = lib.fbd_model_parse(source, len(source), name, settings, count, errors)
    if handle != ffi.NULL:
        handle = owned(handle, lib.fbd_model_free)
        lib.fbd_state_close(owned(lib.fbd_state_new(handle), lib.fbd_state_free, handle), errors)
        lib.fbd_model_check_key(handle, errors)
    files = tuple(text_at(lib.fbd_errors_file(errors, i)) for i in range(lib.fbd_errors_file_count(errors)))
    del kept
    return notes_of(errors), files


def check(model: Union[str, "os.PathLike[str]"], /, name: Optional[str] = None, **parameters: Any) -> Tuple[Note, ...]:
    """All that is wrong or doubtful with a model file and its start, as ``fbd-run --check`` says; () for a right one.

    ``model`` is a path, or the text of a model: a str of more than one line, which messages call ``name`` and
    beside which data files are looked for.

    >>> for note in fbd.check("pendulum.yaml"):
    ...     print(note.line, note.message, note.fix)
    """
    if isinstance(model, str) and ("\n" in model or name is not None):
        source, called = bytes_of(model, "the text"), bytes_of(name or "model", "the name")
    else:
        with open(model, "rb") as stream:
            source, called = stream.read(), path_of(model)
    return read_notes(source, called, parameters)[0]


def _with_hand(source: bytes, name: bytes, parameters: Mapping[str, Any], hand: Hand) -> Any:
    """The model with other derivations: of each body in place of its own, those of "" at the top of the file."""
    if not isinstance(hand, Mapping) or not all(isinstance(body, str) for body in hand):
        raise TypeError(f"`hand` is a mapping from the names of bodies to derivations, not {hand!r}")
    document = made(lib.fbd_document_parse, lib.fbd_document_free, (), source, len(source), name)
    entries = []
    for body, lines in hand.items():
        path = ["bodies", body, "hand"] if body else ["hand"]
        value: Any = [lines] if isinstance(lines, str) else list(lines)
        for key in reversed(path):
            value = {key: value}
        text = json.dumps(value, ensure_ascii=False).encode("utf-8")
        entry = made(lib.fbd_document_parse, lib.fbd_document_free, (), text, len(text), b"the derivation")
        entries.append(entry)
        texts, count, kept = names_of(path, "a body")
        if not lib.fbd_document_take(document, entry, texts, count):
            raise Error((complaint("error", "unknown-body", f"the model has no body `{body}`"),))
        del kept
    settings, count, kept = settings_of(dict(parameters))
    model = made(lib.fbd_model_parse_document, lib.fbd_model_free, (document, *entries), document, settings, count, True)
    del kept
    return model


def _restored(kind: "Type[Model]", source: bytes, name: str, parameters: Mapping[str, Any]) -> "Model":
    settings, count, kept = settings_of(dict(parameters))
    model = kind.__new__(kind)
    handle = made(lib.fbd_model_parse, lib.fbd_model_free, (), source, len(source), os.fsencode(name), settings, count)
    model._begin(handle, os.fsencode(name), parameters)
    del kept
    return model


class Model:
    """A model file, read and compiled. It does not change, and threads may share it.

    >>> model = fbd.Model("pendulum.yaml", theta0="60 deg")

    Keywords set parameters of the file: texts with a unit, or numbers in the model's units (SI, or ``units: US``).
    What is wrong is raised as :class:`fbd.Error`, all of it in its ``notes``; what is doubtful is an
    :class:`fbd.Warning`.
    """

    def __init__(self, path: Union[str, "os.PathLike[str]"], /, **parameters: Any):
        settings, count, kept = settings_of(parameters)
        handle = made(lib.fbd_model_read, lib.fbd_model_free, (), path_of(path), settings, count)
        self._begin(handle, path_of(path), parameters)
        del kept

    @classmethod
    def parse(cls, text: str, name: str = "model", /, **parameters: Any) -> "Model":
        """The same from a text; messages call it ``name``, and data files are looked for beside that."""
        source, called = bytes_of(text, "the text"), bytes_of(name, "the name")
        settings, count, kept = settings_of(parameters)
        model = cls.__new__(cls)
        handle = made(lib.fbd_model_parse, lib.fbd_model_free, (), source, len(source), called, settings, count)
        model._begin(handle, called, parameters)
        del kept
        return model

    def _begin(self, handle: Any, name: bytes, parameters: Mapping[str, Any]) -> None:
        self._model, self._parameters = handle, dict(parameters)
        self._calls: Optional[_inputs.Calls] = None  # functions that compute inputs
        self._name = os.path.abspath(name)  # beside which a sweep looks for data files, wherever it is called

    # ---- what it is

    @property
    def title(self) -> str:
        """The title of the file; "" without one."""
        return text_at(lib.fbd_model_title(self._model))

    def _source(self) -> bytes:
        length = ffi.new("size_t *")
        source = lib.fbd_model_source(self._model, length)
        return bytes(ffi.buffer(source, length[0])) if length[0] else b""

    @property
    def source(self) -> str:
        """The text of the file as it was read."""
        return self._source().decode("utf-8", "replace")

    @property
    def bodies(self) -> Tuple[str, ...]:
        """Names of the bodies."""
        count = lib.fbd_model_body_count(self._model)
        return tuple(text_at(lib.fbd_model_body_name(self._model, i)) for i in range(count))

    @property
    def coordinates(self) -> Tuple[Coordinate, ...]:
        """The coordinates of the scene, with their rates and units."""
        return coordinates_of(self._model)

    @property
    def parameters(self) -> Dict[str, Parameter]:
        """The parameters of the file and then its inputs, by name, with their values in this model."""
        listed = (lib.fbd_model_parameter(self._model, i) for i in range(lib.fbd_model_parameter_count(self._model)))
        return {text_at(struct.name): from_struct(Parameter, struct) for struct in listed}

    def _read_again(self) -> bytes:
        """The text of the file, for what reads it again, without functions for its inputs."""
        if self._calls is not None:
            raise TypeError("inputs by functions are not part of the file: write their laws into it, or run this model itself")
        return self._source()

    def with_inputs(self, inputs: Mapping[str, "_inputs.Function"]) -> "Model":
        """This model, with some of its ``inputs`` computed by functions of the time [s] and the motion
        (:class:`fbd.Now`), in the unit of the input, in every evaluation of the forces.

        >>> model.with_inputs({"M": lambda t, now: -40 * now["pole.theta"] - 8 * now["pole.omega"]}).run()

        A function must depend on its arguments only, and smoothly between the events of the file. Error bars hold for
        the function as it is. What it raises ends the run, and is raised.
        """
        model = type(self).__new__(type(self))
        calls = _inputs.Calls(self._model, inputs)
        model._begin(calls.model, os.fsencode(self._name), self._parameters)
        model._calls = calls
        return model

    def __reduce__(self) -> Any:
        """A copy in another process reads the same text; data files of tables are read again."""
        self._read_again()
        return _restored, (type(self), self._source(), self._name, self._parameters)

    def _seconds(self, value: Time, name: str) -> Optional[float]:
        """A time given as a number [s] or as a text with a unit ("200 ms")."""
        if not isinstance(value, str):
            return value
        seconds = ffi.new("double *")
        checked(lib.fbd_model_quantity, self._model, name.encode(), bytes_of(value, name), b"s", seconds)
        return float(seconds[0])

    def inertia(self, body: str) -> Inertia:
        """Mass, moments of inertia and centre of mass of a body."""
        struct = lib.fbd_model_inertia(self._model, self.bodies.index(body))
        return from_struct(Inertia, struct, G=(struct.G[0], struct.G[1]))

    def explain(self, **options: Any) -> str:
        """The plan in words: what is simulated, what is not, by which method, and why. Options of a run."""
        chosen, name = run_options(**options)
        text = taken(lib.fbd_explain(self._model, chosen))
        del name
        return text

    # ---- states

    def state(self, values: Values = None, /, **named: Any) -> State:
        """A state at the initial values of the file and t = 0, but for those that are given: by keyword
        (``x=0.1``, ``theta="60 deg"``), or with full names in a mapping (``{"block.x": 0.1}``); ``t`` too."""
        state = State(self._model)
        state._set(values, named)
        return state

    def equations(self, values: Values = None, /, **named: Any) -> Equations:
        """The assembled equations, term by term, at the start or where the values say (see :meth:`state`).

        >>> model.equations(theta="60 deg")["pendulum.theta"].terms["gravity"]
        """
        return self.state(values, **named).fit().equations()

    def linearize(self, values: Values = None, /, *, inputs: Names = (), outputs: Names = (), **named: Any) -> Linearization:
        """Linearise about the equilibrium near the start, or near where the values say; ``inputs`` and ``outputs`` as of
        :meth:`State.linearize`.

        >>> model.linearize(outputs=["cart.x", "rod.tip.x"]).transfer("F", "rod.tip.x").zeros
        """
        return self.state(values, **named).linearize(inputs=inputs, outputs=outputs)

    def section(self, body: str, values: Values = None, /, *, at_rest: bool = False, **named: Any) -> Section:
        """Section forces along a straight body, in motion at the start or where the values say, or ``at_rest``.

        >>> model.section("beam", at_rest=True).extremes["M"]
        """
        state = self.state(values, **named)
        return (state if at_rest else state.fit()).section(body, at_rest=at_rest)

    def statics(self, values: Values = None, /, *, settle: bool = False, **named: Any) -> Statics:
        """The scene at rest at the start or where the values say, with every reaction. With ``settle`` it is
        first let down to an equilibrium."""
        state = self.state(values, **named)
        return (state.settle() if settle else state).statics()

    def check_hand(self, seed: int = 1, hand: Optional[Hand] = None) -> HandCheck:
        """Hold every ``hand:`` derivation of the file against the assembly at random states, lines of energy and
        momentum against a run. The number of those that differ, with its ``text``. ``hand`` has other lines for some
        bodies, ``{"block": ["m*a = T - f"]}``, of which "" stands for those of the whole scene."""
        model = self._model if hand is None else _with_hand(self._source(), self._name, self._parameters, hand)
        differing = ffi.new("size_t *")
        text = lib.fbd_check_hand(model, whole(seed, "the seed", 2**32 - 1), differing)
        return HandCheck(differing[0], taken(text))

    # ---- runs

    def run(self, *, until: Time = None, tolerance: Optional[float] = None, step: Time = None,
            method: Optional[str] = None, accuracy: Optional[float] = None, error_bars: bool = False,
            structure: bool = True, every: Time = None, ledger: bool = False, components: bool = False,
            progress: Optional[Callable[[Progress], Any]] = None,
            inputs: Optional[Mapping[str, "_inputs.Function"]] = None) -> Run:
        """Run the model from t = 0 to its end.

        until: end time, in seconds or a text with a unit ("200 ms"), as step and every; tolerance: relative error of a step; step: a fixed step [s]; method: "auto",
        "rk8pd", ...; accuracy: the global accuracy to be delivered, whatever tolerance that takes; error_bars:
        estimate the global errors; structure: False integrates all bodies together; every: interval of the rows
        [s]; ledger: columns of each force, its work and the energies; components: with the components of each
        force; inputs: functions that compute inputs of the file (:meth:`with_inputs`). What is not given is as in the file.

        ``progress`` is called up to twenty times a second with an :class:`fbd.Progress`; what is true ends the
        run there, as "interrupted". Ctrl-C ends it with KeyboardInterrupt.

        A run that fails is raised as :class:`fbd.RunFailed`, one that does not reach its accuracy as
        :class:`fbd.AccuracyNotReached`, both with the run; one that a lost contact ends is returned, with a warning.
        """
        options: Dict[str, Any] = {"until": self._seconds(until, "until"), "tolerance": tolerance,
                                   "step": self._seconds(step, "step"), "method": method, "accuracy": accuracy,
                                   "error_bars": error_bars, "structure": structure}
        model = self if inputs is None else self.with_inputs(inputs)
        return _run.start(model, progress, self._seconds(every, "every"), ledger, components, options)

    def simulate(self, *, until: Time = None, tolerance: Optional[float] = None, step: Time = None,
                 method: Optional[str] = None, structure: bool = True) -> Simulation:
        """A motion from the start of the file that is advanced step by step, with :meth:`fbd.Simulation.set_input` on the
        way. Options of :meth:`run`.

        >>> simulation = model.simulate()
        >>> simulation.set_input("push", "8 N")
        >>> simulation.advance(0.5)["block.x"]
        """
        options: Dict[str, Any] = {"until": self._seconds(until, "until"), "tolerance": tolerance,
                                   "step": self._seconds(step, "step"), "method": method, "structure": structure}
        return Simulation(self, options)

    def sliders(self, show: Optional[Callable[["Model"], Any]] = None) -> Sliders:
        """Sliders for the parameters that have a ``range``, in a notebook, above the run with their values. It needs
        ipywidgets. ``show`` maps the present model to what is shown instead: a run, a state, equations, any text.

        >>> model.sliders(lambda now: now.state())
        """
        return Sliders(self, show)

    def note(self, path: Union[str, "os.PathLike[str]"], *, date: Optional[str] = None, **options: Any) -> Run:
        """Run the model with error bars, and write its calculation note (:meth:`Run.note`). Options of :meth:`run`.

        >>> model.note("note.html")
        """
        run = self.run(error_bars=True, **options)
        run.note(path, date=date)
        return run

    def sweep(self, vary: Vary, outputs: Union[str, Sequence[str]] = (), *, zip: bool = False, seed: int = 1,
              jobs: int = 0, until: Time = None, tolerance: Optional[float] = None,
              step: Time = None, method: Optional[str] = None, structure: bool = True, find: Optional[str] = None,
              statics: bool = False, runs: int = 0, progress: Optional[Callable[[int, int], Any]] = None) -> SweepTable:
        """Run the model under many values of its parameters; a structured array with a row for each run.

        vary: texts of ``fbd-sweep --vary`` ("mu=0.1:0.6:51", "m=normal(2,0.1) kg:100"), or a mapping from names to
        values ({"mu": [0.1, 0.2]}); each value is combined with each, with ``zip`` they go side by side. outputs:
        names of what is noted ("block.x", "max(block.v)", "time(stick)"): docs/sweep.md. jobs: threads, 0 for all
        processors; the rows do not depend on it. find: instead of outputs a question of :meth:`find`, with its statics
        and runs, for each row. ``progress`` is called with the rows that are done, and all.
        """
        options: Dict[str, Any] = {"until": self._seconds(until, "until"), "tolerance": tolerance,
                                   "step": self._seconds(step, "step"), "method": method, "structure": structure}
        plan, kept = _sweep._plan(vary, outputs, zip, seed, self._parameters, options, find, statics, runs)
        table = _sweep.sweep(self._read_again(), self._name, plan, whole(jobs, "jobs", 10000), progress)
        del kept
        return table

    def find(self, question: str, *, statics: bool = False, runs: int = 0, until: Time = None,
             tolerance: Optional[float] = None, step: Time = None, method: Optional[str] = None,
             structure: bool = True, progress: Optional[Callable[[Progress], Any]] = None) -> Found:
        """The values of a parameter at which something changes or has a given result.

        >>> model.find("P = 0..40 N: crate tips")[0].value

        question: as of ``fbd-run --find`` (docs/find.md); without a range, that of the file. statics: of the scene
        at rest at its start. runs: of the first scan, 0 for 33. ``progress`` is called after runs, up to twenty
        times a second; what is true ends the search with :class:`fbd.Error`. No solution is an empty result.
        """
        options: Dict[str, Any] = {"until": self._seconds(until, "until"), "tolerance": tolerance,
                                   "step": self._seconds(step, "step"), "method": method, "structure": structure}
        return _find.find(self._read_again(), self._name, question, self._parameters, statics, runs, progress, options)

    def fit(self, data: Data, parameters: Union[str, Sequence[str]] = (), *, tolerance: Optional[float] = None,
            step: Optional[float] = None, method: Optional[str] = None, structure: bool = True,
            progress: Optional[Callable[[Progress], Any]] = None) -> Fit:
        """Fit parameters to measured data by least squares, from the values of this model.

        >>> model.fit("measured.csv", ["m", "c"])["c"].error

        data: the path of a CSV file, or a mapping from the names of columns ("t", "block.x [cm]", "block.x +-") to
        numbers, nan for those that are missing (docs/fit.md). parameters: their names; without them all that do
        not follow from others. ``progress`` is called after runs, up to twenty times a second; what is true ends
        the fit with :class:`fbd.Error`.
        """
        options: Dict[str, Any] = {"tolerance": tolerance, "step": step, "method": method, "structure": structure}
        return _fit.fit(self._read_again(), self._name, data, parameters, self._parameters, progress, options)

    # ---- for other programs

    def emit_c(self, *, until: Time = None, tolerance: Optional[float] = None) -> str:
        """The scene as one C program for GSL, as text (docs/emit-c.md)."""
        options, name = run_options(until=self._seconds(until, "until"), tolerance=tolerance)
        text = taken(checked(lib.fbd_emit_c, self._model, options))
        del name
        return text

    def fmu(self, path: Union[str, "os.PathLike[str]"], *, version: int = 3, until: Time = None,
            tolerance: Optional[float] = None, step: Time = None, method: Optional[str] = None, structure: bool = True,
            outputs: Sequence[str] = ()) -> None:
        """Write the model as a Functional Mock-up Unit (docs/fmi.md), of FMI 3.0 or 2.0. `outputs` are the forces,
        reactions, energies and works that are outputs of it, by their names in the CSV with ledger. :class:`fbd.Error` with the id `no-fmu` where the module was built without the binary for it."""
        self._read_again()
        library = fmu_library()
        settings, count, kept = settings_of(self._parameters)
        options, name = run_options(until=self._seconds(until, "until"), tolerance=tolerance,
                                    step=self._seconds(step, "step"), method=method, structure=structure)
        data, length = ffi.from_buffer(library), ffi.new("size_t *")
        stem = ffi.new("char[]", os.fsencode(os.path.splitext(os.path.basename(self._name))[0]))
        names = ffi.new("char[]", ",".join(outputs).encode()) if outputs else ffi.NULL
        chosen = ffi.new("fbd_fmu_options *", {"outputs": names, "version": whole(version, "the version", 3), "library": data, "name": stem,
                                               "library_length": len(library), "settings": settings,
                                               "setting_count": count, "run": options})
        archive = owned(checked(lib.fbd_fmu, self._model, chosen, length), lib.fbd_free)
        put(path, bytes(ffi.buffer(archive, length[0])))
        del kept, name

    # ---- what it costs

    def cost(self, *, until: Time = None, budget: float = 6, methods: Sequence[str] = (),
             quantities: Sequence[str] = (), fixed_steps: bool = False) -> _cost.Cost:
        """What accuracy costs: every method at every tolerance of a ladder, true error against time. ``budget``:
        how long all may take [s]."""
        return _cost.cost(self._model, until=self._seconds(until, "until"), budget=budget, methods=methods, quantities=quantities,
                          fixed_steps=fixed_steps)

    def effects(self, *, until: Time = None, budget: float = 6) -> _cost.Effects:
        """What each effect changes and costs: each is left out in turn."""
        return _cost.effects(self._model, until=self._seconds(until, "until"), budget=budget, methods=(), quantities=(), fixed_steps=False)

    def __repr__(self) -> str:
        title = f" `{self.title}`" if self.title else ""
        return f"<fbd.Model{title}: {', '.join(self.bodies[:8])}{', ...' if len(self.bodies) > 8 else ''}>"

    def _repr_html_(self) -> str:
        """The free-body diagrams at the start."""
        return picture(self.state().svg())
