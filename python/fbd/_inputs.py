# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs of a model that functions in Python compute while it runs."""
from __future__ import annotations

import difflib
from typing import Any, Callable, Dict, Iterator, List, Mapping, Optional, Tuple

from ._binding import ffi, lib
from ._library import made, number, text_at


class Now(Mapping[str, float]):
    """The motion at the time of a call: coordinates, rates and user states by full name ("block.x"), coordinates and
    rates also by their own name where only one body has it. Valid until the function returns."""

    def __init__(self, places: Dict[str, int], short: Dict[str, int]):
        self._places, self._short, self._y = places, short, None  # type: Dict[str, int], Dict[str, int], Any

    def __getitem__(self, name: str) -> float:
        place = self._places.get(name, self._short.get(name))
        if place is None:
            near = difflib.get_close_matches(str(name), self._places, 1)
            raise KeyError(f"no coordinate, rate or state is called `{name}`" + (f": did you mean `{near[0]}`?" if near else ""))
        if self._y is None:
            raise RuntimeError("the motion at a call is valid until the function returns")
        return float(self._y[place])

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)


def _places_of(model: Any) -> Tuple[Dict[str, int], Dict[str, int]]:
    count = lib.fbd_model_coordinate_count(model)
    listed = [lib.fbd_model_coordinate(model, i) for i in range(count)]
    names = [text_at(c.name) for c in listed] + [text_at(c.rate_name) for c in listed]
    names += [text_at(lib.fbd_model_state(model, i).name) for i in range(lib.fbd_model_state_count(model))]
    short: Dict[str, List[int]] = {}
    for i, name in enumerate(names):
        short.setdefault(name.split(".", 1)[1], []).append(i)
    return {name: i for i, name in enumerate(names)}, {name: at[0] for name, at in short.items() if len(at) == 1}


Function = Callable[[float, Now], Any]


class Call:
    """One function, as the library calls it. What it raises ends the run, and is raised again by :meth:`end`."""

    def __init__(self, function: Function, places: Tuple[Dict[str, int], Dict[str, int]]):
        if not callable(function):
            raise TypeError(f"an input is computed by a function of t and the motion, not by {function!r}")
        self.function, self._places = function, places
        self.failure: Optional[BaseException] = None
        self.handle = ffi.new_handle(self)

    def value(self, t: float, y: Any) -> float:
        if self.failure is not None:
            return float("nan")
        now = Now(*self._places)
        now._y = y
        try:
            return number(self.function(t, now), "an input")
        finally:
            now._y = None


def _keep(kind: Any, failure: Any, traceback: Any) -> None:
    if traceback is not None:
        ffi.from_handle(traceback.tb_frame.f_locals["context"]).failure = failure


def fbd_input(context: Any, t: float, y: Any, value: Any) -> int:
    call: Call = ffi.from_handle(context)
    value[0] = call.value(t, y)
    return 0


ffi.def_extern(error=1, onerror=_keep)(fbd_input)


class Calls:
    """The functions of a model, and the model of the library that calls them."""

    def __init__(self, model: Any, inputs: Mapping[str, Function]):
        if not isinstance(inputs, Mapping) or not all(isinstance(name, str) for name in inputs):
            raise TypeError(f"`inputs` is a mapping from the names of inputs to functions, not {inputs!r}")
        places = _places_of(model)
        self._calls = [Call(function, places) for function in inputs.values()]
        names = [ffi.new("char[]", name.encode("utf-8")) for name in inputs]
        array = ffi.new("fbd_callback[]", max(1, len(inputs)))
        for entry, name, call in zip(array, names, self._calls):
            entry.input, entry.function, entry.context = name, ffi.addressof(lib, "glue_input"), call.handle
        self.model = made(lib.fbd_model_with_callbacks, lib.fbd_model_free, (self._calls,), model, array, len(inputs))

    def failed(self) -> bool:
        return any(call.failure is not None for call in self._calls)

    def end(self) -> None:
        """Raise what a function has raised."""
        for call in self._calls:
            failure, call.failure = call.failure, None
            if failure is not None:
                raise failure
