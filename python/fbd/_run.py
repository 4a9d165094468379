# SPDX-License-Identifier: GPL-3.0-or-later
"""A run from start to end: its rows, its events, and its state at any time."""
from __future__ import annotations

import difflib
import html
import math
import os
import threading
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

from ._binding import ffi, lib
from ._files import put
from ._library import bytes_of, checked, made, number, owned, positive, run_options, settings_of, taken, text_at, view
from ._notes import AccuracyNotReached, Error, RunFailed, Warning, complaint, warn
from ._records import Drift, Energy, Event, Progress, Stats, from_struct, preformatted
from ._state import State
from ._watch import Watch

if TYPE_CHECKING:
    import pandas  # type: ignore[import]

Column = npt.NDArray[np.float64]

_outcomes = {
    lib.FBD_DONE: "done",
    lib.FBD_STOPPED: "stopped",
    lib.FBD_BROKEN: "broken",
    lib.FBD_FAILED: "failed",
    lib.FBD_INTERRUPTED: "interrupted",
}


def _record(simulation: Any, watch: Watch, every: float, **recording: bool) -> Any:
    """Carry a simulation to its end; its result."""
    wanted = {"every": every, "progress": watch.function, "progress_context": watch.context, **recording}
    result = lib.fbd_simulation_run(simulation, ffi.new("fbd_recording *", wanted))
    held = ffi.NULL if result == ffi.NULL else owned(result, lib.fbd_result_free, simulation)
    watch.end()
    if held == ffi.NULL:
        raise MemoryError("fbd: out of memory")
    return held


class Run(Mapping[str, Column]):
    """A run. It is a mapping from names of columns, those of ``fbd-run --csv`` without their units, to arrays:
    ``run["t"]``, ``run["block.x"]``; with error bars ``run["block.x ±"]`` too.

    The arrays are the library's own rows, not copies, and cannot be written; they live as long as anyone holds
    them. Threads may share a run.
    """

    columns: Tuple[str, ...]  #: "t", then as in the CSV
    units: Dict[str, str]  #: of each column
    rows: Column  #: all of them, rows x columns

    def __init__(self, model: Any, options: Any, every: float, watch: Watch, title: str, **columns: bool):
        self._model, self._every, self._title = model, every, title
        self._lock = threading.RLock()
        self._simulation = made(lib.fbd_simulation_new, lib.fbd_simulation_free, (model,), model, options)
        self._bars = bool(options.error_bars)
        self._result = _record(self._simulation, watch, every, table=True, **columns)
        outcome = lib.fbd_result_outcome(self._result)
        if outcome == lib.FBD_OUT_OF_MEMORY:
            raise MemoryError("fbd: out of memory")
        self._outcome = _outcomes[outcome]
        table = lib.fbd_result_table(self._result)
        heads = [table.heads[i] for i in range(table.columns)]
        self.columns = tuple(text_at(head.name) for head in heads)
        self.units = {text_at(head.name): text_at(head.unit) for head in heads}
        self.rows = view(table.values, (table.rows, table.columns), self._result)
        self._places = {name: i for i, name in enumerate(self.columns)}
        self._events: Optional[Tuple[Event, ...]] = None
        self._replay: Any = None
        self._made_by: Any = None  # the model, and the options of its run

    def _judge(self) -> None:
        """What fbd-run ends with another exit code for is raised, or warned of."""
        if self._outcome == "failed":
            try:
                checked(lib.fbd_simulation_blame, self._simulation)
            except Error as error:
                raise RunFailed(error.notes, self) from None
            raise RunFailed((complaint("error", "run-failed", self.reason),), self)
        if not lib.fbd_result_accurate(self._result):
            stats = self.stats
            best = f"{stats.error_estimate:.2g} is the best" if math.isfinite(stats.error_estimate) else "the error is not known"
            text = f"the accuracy {stats.accuracy:g} was not reached: {best} of {stats.runs} runs, at tolerance {stats.tolerance:g}"
            if self._outcome == "interrupted":
                warn(complaint("warning", "accuracy-not-reached", text))
            else:
                raise AccuracyNotReached((complaint("error", "accuracy-not-reached", text),), self)
        residual, explained = ffi.new("double *"), ffi.new("double *")
        if self._outcome in ("done", "stopped") and not lib.fbd_result_balanced(self._result, residual, explained):
            text = (f"the motion is not accurate: the residual of its energy is {residual[0]:.2g}, "
                    f"where the tolerance explains {explained[0]:.2g}")
            raise AccuracyNotReached((complaint("error", "energy-not-balanced", text),), self)
        if self._outcome == "broken":
            warn(complaint("warning", "run-ended-early", self.reason))

    # ---- how it went

    @property
    def outcome(self) -> str:
        """"done"; "stopped" by an event of the file; "broken" where an assumption of the scene ended, as a contact
        that is lost; "interrupted" by ``progress``; "failed" in the run of an :class:`fbd.RunFailed`."""
        return self._outcome

    @property
    def reason(self) -> str:
        """Why it ended: one sentence; "" while all is well."""
        return text_at(lib.fbd_simulation_reason(self._simulation))

    @property
    def t_end(self) -> float:
        """When it ended [s]."""
        to = ffi.new("double *")
        lib.fbd_simulation_interval(self._simulation, ffi.NULL, to)
        return float(to[0])

    @property
    def stats(self) -> Stats:
        """What it has cost."""
        with self._lock:
            return from_struct(Stats, lib.fbd_simulation_stats(self._simulation))

    @property
    def drift(self) -> Drift:
        """How far couplings were off."""
        return from_struct(Drift, lib.fbd_simulation_drift(self._simulation))

    @property
    def events(self) -> Tuple[Event, ...]:
        """What happened, in the order of time."""
        with self._lock:
            if self._events is None:
                structs = [lib.fbd_simulation_event(self._simulation, i)
                           for i in range(lib.fbd_simulation_event_count(self._simulation))]
                self._events = tuple(
                    from_struct(Event, struct, kind=text_at(lib.fbd_event_kind_name(struct.kind)))
                    for struct in structs)
            return self._events

    # ---- columns

    def __getitem__(self, name: str) -> Column:
        place = self._places.get(name)
        if place is None:
            near = difflib.get_close_matches(str(name), self.columns, 1)
            hint = f"did you mean `{near[0]}`?" if near else "forces, works and energies are there with ledger=True"
            raise KeyError(f"no column is called `{name}`: {hint}")
        return self.rows[:, place]

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = object.__hash__

    @property
    def t(self) -> Column:
        """The times of the rows [s]: regular ones, events and the end."""
        return self["t"]

    def to_pandas(self) -> "pandas.DataFrame":
        """The rows as a DataFrame over t; units are in its ``attrs["units"]``. It is a copy."""
        import pandas

        index = pandas.Index(self.t.copy(), name="t")
        frame = pandas.DataFrame(self.rows[:, 1:].copy(), index=index, columns=list(self.columns[1:]))
        frame.attrs["units"] = dict(self.units)
        return frame

    # ---- at the end

    @property
    def energy(self) -> Energy:
        """At the end [J]."""
        with self._lock:
            return from_struct(Energy, lib.fbd_result_energy(self._result))

    @property
    def energy_error(self) -> Energy:
        """Estimated errors of it; nan without error bars, inf when they are not known."""
        with self._lock:
            return from_struct(Energy, lib.fbd_result_energy_error(self._result))


    def work(self, body: str, load: str) -> float:
        """The work that a force or moment of a body has done since the start [J]."""
        names = bytes_of(body, "the body"), bytes_of(load, "the load")
        with self._lock:
            value = float(lib.fbd_result_work(self._result, *names))
        if math.isnan(value):
            raise KeyError(f"no load of `{body}` is called `{load}`")
        return value

    def work_error(self, body: str, load: str) -> float:
        """Its estimated error; nan without error bars."""
        names = bytes_of(body, "the body"), bytes_of(load, "the load")
        with self._lock:
            return float(lib.fbd_result_work_error(self._result, *names))

    def error(self, name: str) -> float:
        """The estimated error of "block.x" or "block.v" at the end; nan without error bars."""
        with self._lock:
            return float(lib.fbd_result_error(self._result, bytes_of(name, "the name")))

    @property
    def end(self) -> State:
        """The state at the end."""
        state = State(self._model)
        with self._lock:
            lib.fbd_simulation_state(self._simulation, self.t_end, state._handle)
        return state

    # ---- anywhere

    def _again(self, error_bars: bool) -> Any:
        return made(lib.fbd_simulation_again, lib.fbd_simulation_free, (self._model,), self._simulation, error_bars)

    def _seek(self, t: float) -> State:
        """From the step of the time before, or from the start. Called with the lock held."""
        if not 0 <= t <= self.t_end:
            raise ValueError(f"t = {t:g} lies outside of the run, which goes from 0 to {self.t_end:.9g} s")
        start = ffi.new("double *")
        if self._replay is not None:
            lib.fbd_simulation_interval(self._replay, start, ffi.NULL)
        if self._replay is None or t < start[0]:
            self._replay = self._again(False)
        state, watch = State(self._model), Watch()
        lib.glue_seek(self._replay, t, watch.context)
        watch.end()
        if not lib.fbd_simulation_state(self._replay, t, state._handle):
            raise RuntimeError(f"fbd: the run cannot be followed again to t = {t:.9g}")
        return state

    @overload
    def at(self, t: float) -> State: ...

    @overload
    def at(self, t: Iterable[float]) -> List[State]: ...

    def at(self, t: Union[float, Iterable[float]]) -> Union[State, List[State]]:
        """The state at a time [s], or at each of several, by the dense output of the run itself: what a row there
        would have. At an event it is the state after it.

        Steps are not kept but made again, from the last time that was asked for, or from the start if that lies
        later. So going forward costs one run altogether, and several times are best given at once, in any order.
        """
        if not isinstance(t, Iterable):
            with self._lock:
                return self._seek(number(t, "t"))
        times = [number(each, "t") for each in t]
        states: Dict[int, State] = {}
        with self._lock:
            for i in sorted(range(len(times)), key=times.__getitem__):
                states[i] = self._seek(times[i])
        return [states[i] for i in range(len(times))]

    # ---- shown

    def report(self, full: bool = False) -> str:
        """The report of ``fbd-run``; of many bodies it is short, unless it is to be full."""
        with self._lock:
            return taken(lib.fbd_result_report(self._result, bool(full)))

    def json(self) -> str:
        """The run as one JSON object, as text: that of ``fbd-run --json``."""
        with self._lock:
            return taken(lib.fbd_result_json(self._result))

    def _kept(self) -> Tuple[Any, Any]:
        """The same run with what pages and plots need."""
        simulation, watch = self._again(self._bars), Watch()
        return simulation, _record(simulation, watch, self._every, keep=True)

    def html(self, *, live: bool = False) -> str:
        """One self-contained page that plays the run, at most some 5 MB. It makes the run once more. With ``live`` it
        has sliders and an editor, and repeats the run after each change (docs/live.md)."""
        _, result = self._kept()
        if not live:
            return taken(checked(lib.fbd_result_html, result))
        model, made_with = self._made_by
        model._read_again()
        settings, count, kept = settings_of(dict(model._parameters))
        options, name = run_options(**made_with["options"])
        chosen = ffi.new("fbd_live_options *", {"settings": settings, "setting_count": count, "run": options})
        page = taken(checked(lib.fbd_result_live_html, result, chosen))
        del kept, name
        return page

    def __reduce__(self) -> Any:
        """A copy in another process makes the run once more, with the same rows. One that ``progress`` has ended does
        not end there again."""
        if self._made_by is None or self._outcome == "interrupted":
            raise TypeError("a run that was interrupted cannot be pickled: it does not end there again")
        return _made_again, self._made_by

    def gnuplot(self, file: Optional[str] = None, columns: Optional[str] = None) -> str:
        """A script for gnuplot with its data, as ``fbd-run --gnuplot``. It makes the run once more."""
        names = [ffi.NULL if text is None else ffi.new("char[]", bytes_of(text, "a name")) for text in (file, columns)]
        _, result = self._kept()
        return taken(checked(lib.fbd_result_gnuplot, result, *names))

    def note(self, path: Union[str, "os.PathLike[str]"], *, date: Optional[str] = None) -> None:
        """Write the calculation note of the run, as ``fbd-run --note``: ``.html``, or ``.md`` with drawings beside it.

        With error bars it states the errors of the results. ``date`` is printed as it is; without it the day is that of
        SOURCE_DATE_EPOCH, or today.
        """
        target = Path(os.fspath(path))
        formats = {".html": lib.FBD_NOTE_HTML, ".md": lib.FBD_NOTE_MARKDOWN}
        if target.suffix.lower() not in formats:
            raise ValueError(f"a note ends in .html or .md, not `{target.name}`; fbd-run --note also makes .tex and .pdf")
        settings, count, kept = settings_of(dict(self._made_by[0]._parameters))
        day = ffi.NULL if date is None else ffi.new("char[]", bytes_of(date, "the date"))
        chosen = ffi.new("fbd_note_options *", {"settings": settings, "setting_count": count, "date": day})
        with self._lock:
            note = made(lib.fbd_note_new, lib.fbd_note_free, (), self._simulation, self._result, chosen)
        text = taken(lib.fbd_note_write(note, formats[target.suffix.lower()], bytes_of(target.stem, "the name")))
        for i in range(0 if target.suffix.lower() == ".html" else lib.fbd_note_drawing_count(note)):
            put(target.with_name(f"{target.stem}-{i + 1}.svg"), text_at(lib.fbd_note_drawing(note, i)))
        put(target, text)
        del kept

    def __repr__(self) -> str:
        title = f" of `{self._title}`" if self._title else ""
        why = f" ({self.reason})" if self.reason else ""
        return (f"<fbd.Run{title}: {self._outcome} at t = {self.t_end:.9g} s{why}, {len(self.rows)} rows, "
                f"{len(self.events)} events>")

    def _repr_html_(self) -> str:
        """The page, in a frame of its own; where the library has none, the report."""
        if not lib.fbd_has_html() or self._outcome in ("failed", "interrupted"):
            return preformatted(self.report())
        page = html.escape(self.html(), quote=True)
        return (f'<iframe srcdoc="{page}" sandbox="allow-scripts allow-downloads" '
                'style="width: 100%; height: 720px; border: 0"></iframe>')


def _made_again(model: Any, made_with: Dict[str, Any]) -> Run:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Warning)
        return start(model, None, **made_with)


def start(model: Any, progress: Optional[Callable[[Progress], Any]], every: Optional[float], ledger: bool,
          components: bool, options: Dict[str, Any]) -> Run:
    """Make a run of a model, and judge it."""
    chosen, name = run_options(**options)
    interval = 0.0 if every is None else positive(every, "every")
    try:
        run = Run(model._model, chosen, interval, Watch(progress, model._calls), model.title, ledger=bool(ledger),
                  components=bool(components))
    finally:
        if model._calls is not None:
            model._calls.end()
    run._made_by = model, {"every": every, "ledger": ledger, "components": components, "options": options}
    del name
    run._judge()
    return run
