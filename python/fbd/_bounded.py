# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls in a process of their own: bounded in time, without access to files if so wanted, and no harm to the caller when they
crash."""
from __future__ import annotations

import json
import os
import select
import signal
import time
import warnings
from typing import Any, Callable, Dict, List, Sequence

from ._json_rpc import coded
from ._model import read_notes
from ._notes import Error, Note, Warning as FbdWarning, complaint

try:
    import resource
except ImportError:  # not POSIX: without --root, data files cannot be refused there
    resource = None  # type: ignore[assignment]


class TooLong(Exception):
    """The call was ended at its limit."""


class Crashed(Exception):
    """The process of the call ended without an answer."""


def note_json(note: Note) -> Dict[str, Any]:
    """As `fbd-run --check --json` writes it."""
    fix = note.fix and {"line": note.fix.line, "column": note.fix.column, "replace": note.fix.replace, "with": note.fix.to}
    return {**note._asdict(), "fix": fix}


def without_files() -> None:
    """No file can be opened from now on; those that are open stay so."""
    if resource is None:
        raise Error((complaint("error", "no-limit", "this system cannot forbid the access to files"),))
    resource.setrlimit(resource.RLIMIT_NOFILE, (0, 0))


def files_refused(texts: Sequence[str], name: str, root: "str | None", parameters: Dict[str, Any]) -> None:
    """Refuse models that read files, or with a root those that read files outside of it."""
    allowed = os.path.realpath(root) if root else None
    for text in texts:
        _, files = read_notes(text.encode("utf-8", "replace"), os.fsencode(name), parameters)
        for file in files:
            if file == name or (allowed and os.path.commonpath([allowed, os.path.realpath(file)]) == allowed):
                continue
            hint = "write the values in the model, or start the server with --root FOLDER" if allowed is None else None
            raise Error((complaint("error", "file-not-allowed", f"the model reads the file `{file}`, which is not allowed", hint),))


def _answer(function: Callable[[], Dict[str, Any]]) -> Dict[str, Any]:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            answer: Dict[str, Any] = {"value": function()}
        except Error as error:
            answer = {"notes": [note_json(note) for note in error.notes], "text": str(error)}
        except Exception as error:  # pylint: disable=broad-exception-caught # bad arguments, and whatever else
            answer = {"notes": [], "text": f"{type(error).__name__}: {error.args[0] if error.args else error}"}
    answer["warnings"] = [note_json(note) for w in caught if isinstance(w.message, FbdWarning) for note in w.message.notes]
    return answer


def _child(function: Callable[[], Dict[str, Any]], end: int) -> None:
    try:
        body = coded(_answer(function))
        while body:
            body = body[os.write(end, body):]
        os._exit(0)
    finally:
        os._exit(1)


def _read_all(end: int, seconds: float) -> bytes:
    limit = time.monotonic() + seconds
    pieces: List[bytes] = []
    while True:
        left = limit - time.monotonic()
        if left <= 0 or not select.select([end], [], [], left)[0]:
            raise TooLong
        piece = os.read(end, 1 << 16)
        if not piece:
            return b"".join(pieces)
        pieces.append(piece)


def bounded(function: Callable[[], Dict[str, Any]], seconds: float) -> Dict[str, Any]:
    """What the function returns as JSON, made by a copy of this process: {"value": ...}, or {"notes": ..., "text": ...} for what
    was wrong; and "warnings"."""
    if not hasattr(os, "fork"):
        return _answer(function)
    end, other = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(end)
        _child(function, other)
    os.close(other)
    try:
        body = _read_all(end, seconds)
    finally:
        os.close(end)
        os.kill(child, signal.SIGKILL)
        status = os.waitpid(child, 0)[1]
    if not body or (os.WIFSIGNALED(status) and os.WTERMSIG(status) != signal.SIGKILL):
        raise Crashed(f"the call ended without an answer (status {status})")
    answer: Dict[str, Any] = json.loads(body)
    return answer
