# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong: notes of the library, and the exceptions and warnings that carry them."""
from __future__ import annotations

import builtins
import sys
import warnings
from typing import TYPE_CHECKING, NamedTuple, Optional, Tuple

if TYPE_CHECKING:
    from ._run import Run


class Fix(NamedTuple):
    """An edit of the model text: ``replace``, which stands at line and column (of characters, from 1), becomes ``to``."""

    line: int
    column: int
    replace: str
    to: str

    def apply(self, text: str) -> str:
        """The text with this edit."""
        lines = text.splitlines(keepends=True)
        line, at = lines[self.line - 1], self.column - 1 + (self.line == 1 and text.startswith("\ufeff"))
        if not line.startswith(self.replace, at):
            raise ValueError(f"`{self.replace}` does not stand at {self.line}:{self.column} of the text")
        lines[self.line - 1] = line[:at] + self.to + line[at + len(self.replace):]
        return "".join(lines)


class Note(NamedTuple):
    """One thing that is wrong with a model file or with a call. Its text is that of ``fbd-run``.

    Lines and columns count from 1; 0 means that none is known.
    """

    severity: str  #: "error" or "warning"
    id: str  #: stable, for programs: "unknown-key", "wrong-dimension", ...
    message: str  #: what is wrong, one line
    hint: Optional[str]  #: what to write instead
    file: Optional[str]
    line: int
    column: int
    context_line: int  #: what was being read there
    context_column: int
    fix: Optional[Fix] = None  #: the edit that the hint suggests, where it is one
    see: Optional[str] = None  #: the section of the guide about it, where there is one

    def __str__(self) -> str:
        place = f"{self.file}:" if self.file else ""
        place += f"{self.line}:{self.column}:" if self.line else ""
        mark = f" [{self.id}]" if self.id else ""
        text = f"{place}{' ' if place else ''}{self.severity}: {self.message}{mark}"
        if self.context_line:
            text += f"\n    in the block that starts at line {self.context_line}, column {self.context_column}"
        text += f"\n    hint: {self.hint}" if self.hint else ""
        return text + (f"\n    see: {self.see}" if self.see else "")


class _Noted:
    """The first note's fields, beside all notes."""

    notes: Tuple[Note, ...]

    def _first(self) -> Note:
        errors = [note for note in self.notes if note.severity == "error"]
        return (errors or list(self.notes))[0]

    @property
    def id(self) -> str:
        """A stable name of what is wrong, for programs: docs/format.md lists them."""
        return self._first().id

    @property
    def message(self) -> str:
        return self._first().message

    @property
    def hint(self) -> Optional[str]:
        """What to write instead, where the library has an idea."""
        return self._first().hint

    @property
    def file(self) -> Optional[str]:
        return self._first().file

    @property
    def line(self) -> int:
        """From 1; 0 where none is known."""
        return self._first().line

    @property
    def column(self) -> int:
        """From 1; 0 where none is known."""
        return self._first().column

    def __str__(self) -> str:
        """As fbd-run, with each section of the guide once."""
        seen = [note.see for note in self.notes]
        return "\n".join(str(note._replace(see=None) if note.see in seen[:i] else note) for i, note in enumerate(self.notes))


class Error(_Noted, Exception):
    """A model file, a value or a scene is wrong. All that is wrong is in ``notes``; ``id``, ``message``, ``hint``,
    ``file``, ``line`` and ``column`` are those of the first error."""

    def __init__(self, notes: Tuple[Note, ...]):
        super().__init__(notes)
        self.notes = tuple(notes)


class RunFailed(Error):
    """A run came to no good end. ``run`` is what there is of it: its rows end with the last good state."""

    def __init__(self, notes: Tuple[Note, ...], run: "Optional[Run]" = None):
        super().__init__(notes)
        self.run = run

    def __reduce__(self) -> "Tuple[type, Tuple[Tuple[Note, ...]]]":
        return type(self), (self.notes,)  # a run stays in its process


class AccuracyNotReached(RunFailed):
    """The accuracy that was asked for was not reached, or the balance of energy does not hold; ``run`` is the best one, and
    came to its end."""


class Warning(_Noted, builtins.UserWarning):  # noqa: A001 - the library's word
    """Something that is probably not meant, with the fields of :class:`Error`."""

    def __init__(self, *notes: Note):
        super().__init__(*notes)
        self.notes = notes


def complaint(severity: str, id: str, message: str, hint: Optional[str] = None) -> Note:
    """A note that has no place in a file."""
    return Note(severity, id, message, hint, None, 0, 0, 0, 0)


def warn(note: Note) -> None:
    """As a warning of the line that has called this package."""
    level, frame = 1, sys._getframe()
    while frame.f_back and frame.f_globals.get("__name__", "").split(".")[0] == __package__:
        level, frame = level + 1, frame.f_back
    warnings.warn(Warning(note), stacklevel=level)
