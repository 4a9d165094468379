# SPDX-License-Identifier: GPL-3.0-or-later
"""Parameters from measured data (docs/fit.md)."""
from __future__ import annotations

import io
import math
import os
from dataclasses import dataclass
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from ._binding import ffi, lib
from ._library import made, names_of, run_options, settings_of, taken, text_at
from ._notes import Error
from ._records import Progress, preformatted
from ._watch import Watch

Data = Union[str, "os.PathLike[str]", Mapping[str, Sequence[float]]]


@dataclass(frozen=True)
class Fitted:
    """A parameter that was fitted, in the units of the model."""

    name: str
    unit: str
    value: float
    error: float  #: its standard error; inf where the data do not determine it, nan without degrees of freedom
    low: float  #: the confidence interval of 95 %
    high: float


class Fit(Mapping[str, Fitted]):
    """The fitted parameters by their names."""

    def __init__(self, handle: Any):
        self._text, self._json = taken(lib.fbd_fit_text(handle)), taken(lib.fbd_fit_json(handle))
        self._script = taken(lib.fbd_fit_gnuplot(handle, ffi.NULL))
        count = lib.fbd_fit_count(handle)
        structs = [lib.fbd_fit_get(handle, i) for i in range(count)]
        self._fitted = {text_at(s.name): Fitted(text_at(s.name), text_at(s.unit), s.value, s.error, s.low, s.high)
                        for s in structs}
        #: a matrix, in the order of the parameters
        self.correlations = np.array([[lib.fbd_fit_correlation(handle, a, b) for b in range(count)] for a in range(count)])
        quality = lib.fbd_fit_summary(handle)
        #: measured values, and those less the parameters
        self.values_count, self.freedom = quality.values, quality.freedom
        #: sum of squares of the residuals, and sqrt(squares/freedom) with its unit
        self.squares, self.deviation, self.unit = quality.squares, quality.deviation, text_at(quality.unit)
        self.weighted, self.iterations, self.runs = bool(quality.weighted), quality.iterations, quality.runs

    def __getitem__(self, name: str) -> Fitted:
        return self._fitted[name]

    def __iter__(self) -> Any:
        return iter(self._fitted)

    def __len__(self) -> int:
        return len(self._fitted)

    def json(self) -> str:
        """What ``fbd-run --fit --json`` writes."""
        return self._json

    def gnuplot(self) -> str:
        """A script for gnuplot that draws the data and the fitted run."""
        return self._script

    def __str__(self) -> str:
        return self._text

    def __repr__(self) -> str:
        return "<fbd.Fit: " + ", ".join(f"{f.name} = {f.value:.6g} +- {f.error:.2g}" for f in self.values()) + ">"

    def _repr_html_(self) -> str:
        return preformatted(self._text)


def _csv(data: Data) -> Any:
    """The text of the data, and its name."""
    if not isinstance(data, Mapping):
        path = os.fspath(data)
        with open(path, "rb") as file:
            return file.read(), os.fsencode(path)
    columns = [np.asarray(column, dtype=np.float64) for column in data.values()]
    if len({column.shape for column in columns}) != 1 or columns[0].ndim != 1:
        raise ValueError("the columns of the data must have one length")
    text = io.StringIO()
    text.write(",".join('"' + str(name).replace('"', "") + '"' for name in data) + "\n")
    for row in zip(*columns):
        text.write(",".join("" if math.isnan(value) else repr(float(value)) for value in row) + "\n")
    return text.getvalue().encode("utf-8"), b"data"


def fit(source: bytes, name: bytes, data: Data, names: Union[str, Sequence[str]], parameters: Mapping[str, Any],
        progress: Optional[Callable[[Progress], Any]], options: Mapping[str, Any]) -> Fit:
    text, called = _csv(data)
    chosen, chosen_count, first = names_of(names, "the name of a parameter")
    settings, count, second = settings_of(dict(parameters))
    run, method = run_options(**options)
    watch = Watch(progress)
    plan = ffi.new("fbd_fit_plan *", {
        "parameters": chosen, "parameter_count": chosen_count, "settings": settings, "setting_count": count, "run": run,
        "progress": watch.function, "progress_context": watch.context,
    })
    try:
        handle = made(lib.fbd_fit_parse, lib.fbd_fit_free, (), source, len(source), name, text, len(text), called, plan)
    except Error:
        watch.end()
        raise
    watch.end()
    del first, second, method
    return Fit(handle)
