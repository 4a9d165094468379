# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps: one model under many values of its parameters."""
from __future__ import annotations

import csv
import html
import io
import re
from typing import TYPE_CHECKING, Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union

import numpy as np

from ._binding import ffi, lib
from ._library import bytes_of, made, names_of, quantity, run_options, settings_of, text_at, whole
from ._notes import complaint, warn
from ._records import preformatted
from ._watch import in_background

if TYPE_CHECKING:
    import pandas  # type: ignore[import]

Vary = Union[str, Sequence[str], Mapping[str, Any]]


class SweepTable(np.ndarray):  # type: ignore[type-arg]
    """A structured array, a row for each run: ``run`` (from 1), what varies, what was asked for, ``events``,
    ``status`` (done, stopped, broken, failed, wrong) and ``reason``; nan where there is no value."""

    units: Dict[str, str]  #: of the columns that have one

    def __array_finalize__(self, source: Any) -> None:
        self.units = getattr(source, "units", {})

    def __reduce__(self) -> Any:
        made_by: Any = super().__reduce__()
        return made_by[0], made_by[1], (made_by[2], self.units)

    def __setstate__(self, state: Any) -> None:
        array, self.units = state
        super().__setstate__(array)

    def _repr_html_(self) -> str:
        """A table for notebooks; of many rows the first and the last ones."""
        names = list(self.dtype.names or ())
        if self.ndim != 1 or not names:
            return preformatted(repr(self))
        most = 60
        rows = list(range(len(self)))
        shown = rows if len(rows) <= most else rows[: most // 2] + [-1] + rows[-most // 2:]
        heads = (html.escape(f"{n} [{self.units[n]}]" if n in self.units else n) for n in names)
        lines = ["<tr>" + "".join(f"<th>{head}</th>" for head in heads) + "</tr>"]
        for row in shown:
            cells = ("&#8942;" if row < 0 else html.escape(_shown(self[n][row])) for n in names)
            lines.append("<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>")
        return "<table>\n" + "\n".join(lines) + f"\n</table>\n<p>{len(self)} runs</p>"

    def to_pandas(self) -> "pandas.DataFrame":
        """The rows as a DataFrame over ``run``; units are in its ``attrs["units"]``. It is a copy."""
        import pandas

        frame = pandas.DataFrame({name: np.asarray(self[name]) for name in self.dtype.names or ()})
        frame = frame.set_index("run")
        frame.attrs["units"] = dict(self.units)
        return frame


def _shown(value: Any) -> str:
    """A cell: numbers with six digits, nothing for nan."""
    if isinstance(value, np.floating):
        return "" if np.isnan(value) else f"{value:.6g}"
    return str(value)


def _values(name: str, values: Any) -> str:
    """Texts stand as they are; numbers get all their digits."""
    if isinstance(values, str):
        return f"{name}={values}"
    return f"{name}=" + ",".join(quantity(value, f"a value of `{name}`") for value in values)


def _texts(vary: Vary) -> List[str]:
    if isinstance(vary, str):
        return [vary]
    if isinstance(vary, Mapping):
        return [_values(name, values) for name, values in vary.items()]
    return list(vary)


def _column(texts: List[str], kind: Optional[type]) -> "np.ndarray[Any, Any]":
    """Numbers where all of them are: files of a table are not."""
    if kind is not None:
        return np.array([kind(text) for text in texts], dtype=kind)
    try:
        return np.array([float(text) if text else np.nan for text in texts], dtype=np.float64)
    except ValueError:
        return np.array(texts, dtype=np.str_)


def _table(header: str, rows: str) -> SweepTable:
    read = list(csv.reader(io.StringIO(header + rows, newline="")))
    heads = [re.fullmatch(r"(.*?)(?: \[(.*)\])?", head) for head in read[0]]
    names = [head[1] for head in heads if head]
    last = len(names) - 1
    columns = []
    for i in range(len(names)):
        texts = [row[i] for row in read[1:]]
        if i >= last - 1:
            columns.append(np.array(texts or [""], dtype=np.str_)[: len(texts)])
        else:
            columns.append(_column(texts, np.int64 if i == 0 else None))
    table = np.empty(len(read) - 1, dtype=[(n, c.dtype) for n, c in zip(names, columns)]).view(SweepTable)
    for name, column in zip(names, columns):
        table[name] = column
    table.units = {head[1]: head[2] for head in heads if head and head[2]}
    return table


def _work(sweep: Any, sheet: Any, jobs: int) -> Any:
    wanted = {
        "end": lib.fbd_sweep_run_count(sweep), "jobs": jobs,
        "write": ffi.addressof(lib, "glue_keep"), "write_context": sheet,
        "progress": ffi.addressof(lib, "glue_count"), "progress_context": sheet,
        "stop": ffi.addressof(lib, "glue_is_stopped"), "stop_context": sheet,
    }
    return ffi.new("fbd_sweep_work *", wanted)


def _plan(vary: Vary, outputs: Union[str, Sequence[str]], zip: bool, seed: int, parameters: Mapping[str, Any],
          options: Mapping[str, Any], find: Optional[str], statics: bool, runs: int) -> Tuple[Any, Any]:
    texts, text_count, first = names_of(_texts(vary), "what varies")
    asked, asked_count, second = names_of(outputs, "what is noted")
    varied = {name for text in _texts(vary) for name in re.findall(r"(?:^|;)\s*([^=;]+?)\s*=", str(text))}
    question = ffi.NULL if find is None else ffi.new("char[]", bytes_of(find, "the question"))
    if find is not None:
        varied.add(find.split(":")[0].split("=")[0].strip())
    settings, setting_count, third = settings_of({n: v for n, v in parameters.items() if n not in varied})
    run, method = run_options(**options)
    plan = ffi.new("fbd_sweep_plan *", {
        "vary": texts, "vary_count": text_count, "zip": bool(zip), "seed": whole(seed, "the seed", 2**64 - 1),
        "settings": settings, "setting_count": setting_count,
        "outputs": asked, "output_count": asked_count, "run": run,
        "find": question, "statics": bool(statics), "find_runs": whole(runs, "runs", 1000000),
    })
    return plan, (texts, first, asked, second, settings, third, run, method, question)


def sweep(source: bytes, name: bytes, plan: Any, jobs: int,
          progress: Optional[Callable[[int, int], Any]]) -> SweepTable:
    """Make the rows of a plan, by threads."""
    handle = made(lib.fbd_sweep_parse, lib.fbd_sweep_free, (), source, len(source), name, plan)
    runs = lib.fbd_sweep_run_count(handle)
    sheet = ffi.gc(ffi.new("glue_sheet *"), lib.glue_free)
    work, counts = _work(handle, sheet, jobs), ffi.new("fbd_sweep_counts *")

    def look() -> None:
        if progress:
            progress(sheet.written, runs)

    def make() -> Any:
        return lib.fbd_sweep_run(handle, work, counts), sheet

    end = in_background(make, lambda: lib.glue_stop(sheet), look)[0]
    if end != lib.FBD_SWEEP_DONE:
        raise MemoryError("fbd: out of memory")
    rows = "" if sheet.length == 0 else ffi.buffer(sheet.data, sheet.length)[:].decode("utf-8", "replace")
    if counts.failed:
        text = f"{counts.failed} of {counts.written} runs came to no good end: their `status` and `reason` say why"
        warn(complaint("warning", "runs-failed", text))
    return _table(text_at(lib.fbd_sweep_header(handle)), rows)
