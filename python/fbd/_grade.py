# SPDX-License-Identifier: GPL-3.0-or-later
"""Grading: answers of students held against a teacher's model by mechanics (docs/grading.md)."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Optional, Tuple, Union

from ._binding import ffi, lib
from ._library import bytes_of, checked, made, path_of, settings_of, taken, text_at
from ._records import from_struct, preformatted

Path = Union[str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Finding:
    """One part of an answer. ``message`` names only what the student wrote, and may be shown; ``detail`` names the
    key's."""

    kind: str  #: "right", "missing", "superfluous", "sense", ...
    body: str
    name: str
    line: int  #: in the answer, 0 when it is not there
    column: int
    points: float  #: got; below zero: taken off
    most: float  #: to be had
    message: str
    detail: str


class Grade:
    """What an answer is worth, and why."""

    points: float  #: at least 0
    most: float  #: to be had
    passed: bool  #: there is an answer, and its points are enough
    findings: Tuple[Finding, ...]

    def __init__(self, key: "Key", path: Optional[Path] = None, student: Optional[str] = None, *,
                 text: Optional[str] = None):
        if (path is None) == (text is None):
            raise TypeError("give the path of an answer, or its `text`")
        if text is not None and student is None:
            raise TypeError("an answer as text needs `student`, who has no file to be named by")
        name = ffi.NULL if student is None else ffi.new("char[]", bytes_of(student, "the student"))
        if text is None:
            handle = made(lib.fbd_grade_new, lib.fbd_grade_free, (key._handle,), key._handle, path_of(path), name)
        else:
            answer = bytes_of(text, "the answer")
            handle = made(lib.fbd_grade_parse, lib.fbd_grade_free, (key._handle,), key._handle, answer, len(answer), name)
        self.points, self.most = lib.fbd_grade_points(handle), lib.fbd_grade_most(handle)
        self.passed = bool(lib.fbd_grade_passed(handle))
        structs = [lib.fbd_grade_finding(handle, i) for i in range(lib.fbd_grade_finding_count(handle))]
        self.findings = tuple(
            from_struct(Finding, struct, kind=text_at(lib.fbd_finding_kind_name(struct.kind))) for struct in structs)
        self._handle = handle

    def text(self, details: bool = False) -> str:
        """As text; with ``details`` those that name the key's forces."""
        return taken(lib.fbd_grade_text(self._handle, bool(details)))

    def json(self, details: bool = False) -> str:
        """As one JSON object, as text."""
        return taken(lib.fbd_grade_json(self._handle, bool(details)))

    def __str__(self) -> str:
        return self.text()

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return preformatted(self.text())


class Key:
    """A teacher's model that answers are compared with. Keywords set parameters of the file, for all students."""

    def __init__(self, path: Path, /, **parameters: Any):
        settings, count, kept = settings_of(parameters)
        self._handle = made(lib.fbd_key_read_set, lib.fbd_key_free, (), path_of(path), settings, count)
        del kept

    @classmethod
    def parse(cls, text: str, name: str = "key", /, **parameters: Any) -> "Key":
        """The same from a text; messages call it ``name``, and data files are looked for beside that."""
        source, called = bytes_of(text, "the text"), bytes_of(name, "the name")
        settings, count, kept = settings_of(parameters)
        key = cls.__new__(cls)
        key._handle = made(lib.fbd_key_parse, lib.fbd_key_free, (), source, len(source), called, settings, count)
        del kept
        return key

    def handout(self, student: str) -> str:
        """What a student gets of it, as the text of a model file, with the values drawn for that name."""
        return taken(checked(lib.fbd_key_handout, self._handle, bytes_of(student, "the student")))

    def solution(self, student: str) -> str:
        """The worked solution for the values of that sheet, as the text of a model file."""
        return taken(checked(lib.fbd_key_solution, self._handle, bytes_of(student, "the student")))

    def page(self, student: str, exam: bool = False) -> str:
        """The same as an HTML page to draw on; with ``exam`` nothing of the key is in it."""
        return taken(checked(lib.fbd_key_page, self._handle, bytes_of(student, "the student"), bool(exam)))

    def grade(self, path: Optional[Path] = None, student: Optional[str] = None, *, text: Optional[str] = None) -> Grade:
        """Compare an answer with it, a file or its ``text``. ``student`` chooses the values that are drawn; else the
        name of the file does, without ``.yaml``."""
        return Grade(self, path, student, text=text)
