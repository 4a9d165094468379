# SPDX-License-Identifier: GPL-3.0-or-later
"""From C to Python and back: texts, numbers, lists of errors, and who frees what.

An object of the library is freed by the last reference to it, and holds those that it needs until then, so that
the order is right however Python collects.
"""
from __future__ import annotations

import math
import numbers
import os
from typing import Any, Callable, Dict, Optional, Sequence, Tuple, Union

import numpy as np

from ._binding import ffi, lib
from ._notes import Error, Fix, Note, warn

lib.glue_quiet()


class _Release:
    """Frees a C object; the owners go after it."""

    __slots__ = ("free", "owners")

    def __init__(self, free: Callable[[Any], None], owners: Tuple[Any, ...]):
        self.free, self.owners = free, owners

    def __call__(self, pointer: Any) -> None:
        self.free(pointer)


def owned(pointer: Any, free: Callable[[Any], None], *owners: Any) -> Any:
    """The C object, to be freed with its last reference."""
    if pointer == ffi.NULL:
        raise MemoryError("fbd: out of memory")
    return ffi.gc(pointer, _Release(free, owners))


# ---- texts


def bytes_of(text: Any, what: str) -> bytes:
    """A text for C, which would end it at the first zero."""
    if not isinstance(text, str):
        raise TypeError(f"{what} must be a str, not {type(text).__name__}")
    coded = text.encode("utf-8")
    if b"\0" in coded:
        raise ValueError(f"{what} has a zero character")
    return coded


def path_of(path: Any) -> bytes:
    coded = os.fsencode(path)
    if b"\0" in coded:
        raise ValueError("the path has a zero character")
    return coded


def text_at(pointer: Any) -> str:
    """A text that the library keeps; "" for none."""
    return "" if pointer == ffi.NULL else str(ffi.string(pointer), "utf-8", "replace")


def taken(pointer: Any) -> str:
    """A text that is ours, to be freed."""
    if pointer == ffi.NULL:
        raise MemoryError("fbd: out of memory")
    try:
        return str(ffi.string(pointer), "utf-8", "replace")
    finally:
        lib.fbd_free(pointer)


def _shown(pointer: Any) -> Optional[str]:
    """A text that somebody else wrote, safe to print."""
    if pointer == ffi.NULL:
        return None
    room = lib.fbd_escape(pointer, ffi.NULL, 0) + 1
    shown = ffi.new("char[]", room)
    lib.fbd_escape(pointer, shown, room)
    return text_at(shown)


# ---- numbers


def number(value: Any, what: str) -> float:
    """A finite number. True is none, nor is a text."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, numbers.Real):
        raise TypeError(f"{what} must be a number, not {type(value).__name__}")
    plain = float(value)
    if not math.isfinite(plain):
        raise ValueError(f"{what} must be finite, not {plain}")
    return plain


def positive(value: Any, what: str) -> float:
    """A number above zero: to the library zero means that none was given."""
    plain = number(value, what)
    if plain <= 0:
        raise ValueError(f"{what} must be above 0, not {plain}")
    return plain


def whole(value: Any, what: str, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, numbers.Integral):
        raise TypeError(f"{what} must be a whole number, not {type(value).__name__}")
    if not 0 <= int(value) <= most:
        raise ValueError(f"{what} must be from 0 to {most}, not {value}")
    return int(value)


def quantity(value: Any, what: str) -> str:
    """A value as a text of the model language: a number with all its digits, or a text with a unit."""
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        bytes_of(value, what)
        return value
    if isinstance(value, numbers.Integral) and not isinstance(value, bool):
        return str(int(value))
    return repr(number(value, what))


def view(pointer: Any, shape: Tuple[int, ...], owner: Any) -> "np.ndarray[Any, np.dtype[np.float64]]":
    """The library's own doubles as an array that cannot be written; it keeps their owner alive."""
    size = math.prod(shape)
    if size == 0:
        return np.zeros(shape)
    held = ffi.gc(pointer, _Release(lambda _: None, (owner,)))
    array = np.frombuffer(ffi.buffer(held, 8 * size), dtype=np.float64).reshape(shape)
    array.flags.writeable = False
    return array


# ---- lists of errors


def _note(errors: Any, index: int) -> Note:
    error, fix = lib.fbd_errors_get(errors, index), lib.fbd_errors_fix(errors, index)
    see = lib.fbd_errors_guide(error.id)
    return Note(
        "error" if error.severity == lib.FBD_ERROR else "warning",
        text_at(error.id),
        text_at(error.message),
        text_at(error.hint) if error.hint != ffi.NULL else None,
        _shown(error.file),
        error.line,
        error.column,
        error.context_line,
        error.context_column,
        None if fix.replace == ffi.NULL else Fix(fix.line, fix.column, text_at(fix.replace), text_at(getattr(fix, "with"))),
        text_at(see) if see != ffi.NULL else None,
    )


def notes_of(errors: Any) -> Tuple[Note, ...]:
    """The notes of a list of the library."""
    notes = tuple(_note(errors, i) for i in range(lib.fbd_errors_count(errors)))
    if any(note.id == "out-of-memory" for note in notes):
        raise MemoryError("fbd: out of memory")
    return notes


def _call(function: Callable[..., Any], arguments: Tuple[Any, ...]) -> Tuple[Any, Tuple[Note, ...]]:
    """Call a function that takes a list of errors last. Errors are raised; its result, and what is left to warn of."""
    errors = owned(lib.fbd_errors_new(), lib.fbd_errors_free)
    result = function(*arguments, errors)
    notes = notes_of(errors)
    if lib.fbd_errors_failed_count(errors):
        raise Error(notes)
    return result, notes


def checked(function: Callable[..., Any], *arguments: Any) -> Any:
    """The same, with the warnings."""
    result, notes = _call(function, arguments)
    for note in notes:
        warn(note)
    return result


def made(function: Callable[..., Any], free: Callable[[Any], None], owners: Tuple[Any, ...], *arguments: Any) -> Any:
    """The same for an object, which is owned before a warning may be raised as an error."""
    result, notes = _call(function, arguments)
    handle = owned(result, free, *owners)
    for note in notes:
        warn(note)
    return handle


# ---- lists


def settings_of(parameters: Dict[str, Any]) -> Tuple[Any, int, Any]:
    """Parameters as the library takes them: array, count, and what must live as long."""
    kept = []
    array = ffi.new("fbd_setting[]", max(1, len(parameters)))
    for i, (name, value) in enumerate(parameters.items()):
        texts = (bytes_of(name, "the name of a parameter"), quantity(value, f"parameter `{name}`").encode("utf-8"))
        pair = [ffi.new("char[]", text) for text in texts]
        array[i].name, array[i].value = pair
        kept.append(pair)
    return array, len(parameters), kept


def names_of(texts: Union[str, Sequence[str]], what: str) -> Tuple[Any, int, Any]:
    """The same for a text or several; none at all is NULL."""
    texts = [texts] if isinstance(texts, str) else texts
    kept = [ffi.new("char[]", bytes_of(text, what)) for text in texts]
    return (ffi.new("char *[]", kept) if kept else ffi.NULL), len(kept), kept


def run_options(
    until: Optional[float] = None,
    tolerance: Optional[float] = None,
    step: Optional[float] = None,
    method: Optional[str] = None,
    accuracy: Optional[float] = None,
    error_bars: bool = False,
    structure: bool = True,
) -> Tuple[Any, Any]:
    """fbd_options, and what must live as long."""
    name = ffi.NULL if method is None else ffi.new("char[]", bytes_of(method, "the method"))
    options = ffi.new("fbd_options *", {"size": ffi.sizeof("fbd_options")})
    options.until = math.nan if until is None else number(until, "until")
    options.tolerance = 0 if tolerance is None else positive(tolerance, "the tolerance")
    options.step = 0 if step is None else positive(step, "the step")
    options.method = name
    options.error_bars = bool(error_bars)
    options.accuracy = 0 if accuracy is None else positive(accuracy, "the accuracy")
    options.no_structure = not structure
    return options, name
