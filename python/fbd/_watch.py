# SPDX-License-Identifier: GPL-3.0-or-later
"""What is looked at while the library works: Ctrl-C, and who wants to know how far it is."""
from __future__ import annotations

import threading
from typing import Any, Callable, List, Optional

from ._binding import ffi, lib
from ._records import Progress, from_struct


class Watch:
    """Asked from within a run, twenty times a second. Signals are handled then, as between any two lines of
    Python; what is raised ends the run, and is raised again by :meth:`end`."""

    def __init__(self, progress: Optional[Callable[[Progress], Any]] = None, calls: Any = None):
        if progress is not None and not callable(progress):
            raise TypeError("progress must be callable")
        self._progress, self._calls = progress, calls  # of a model with inputs by functions: one that failed ends the run
        self.failure: Optional[BaseException] = None
        self._handle = ffi.new_handle(self)
        self.context = ffi.new("glue_watch *", {"handle": self._handle})
        self.function = ffi.addressof(lib, "glue_watch_run")

    def ask(self, progress: Any) -> int:
        if self._calls is not None and self._calls.failed():
            return 1
        if self._progress is None:
            return 0
        return 1 if self._progress(from_struct(Progress, progress[0])) else 0

    def end(self) -> None:
        failure, self.failure = self.failure, None
        try:
            if failure is not None:
                raise failure
        finally:
            del failure  # which knows this frame


def _keep(kind: Any, failure: Any, traceback: Any) -> None:
    """What was raised within fbd_ask, also by a signal before its first line."""
    if traceback is not None:
        ffi.from_handle(traceback.tb_frame.f_locals["handle"]).failure = failure


def fbd_ask(handle: Any, progress: Any) -> int:
    watch: Watch = ffi.from_handle(handle)
    return watch.ask(progress)


ffi.def_extern(error=1, onerror=_keep)(fbd_ask)


def in_background(work: Callable[[], Any], stop: Optional[Callable[[], Any]] = None,
                  look: Optional[Callable[[], None]] = None) -> Any:
    """Let a thread do what takes long and does not ask Python on its way, so that Ctrl-C is heard; `look` is
    called ten times a second. In another thread than the first, which hears no signals, it is simply done.

    `work` must hold all that the library works with: what cannot be stopped goes on when Ctrl-C has ended the
    wait.
    """
    if threading.current_thread() is not threading.main_thread():
        return work()
    done: List[Any] = []
    failures: List[BaseException] = []

    def run() -> None:
        try:
            done.append(work())
        except BaseException as failure:  # noqa: B902 - raised again below
            failures.append(failure)

    thread = threading.Thread(target=run, name="fbd", daemon=True)
    thread.start()
    try:
        while thread.is_alive():
            thread.join(0.1)
            if look:
                look()
    except BaseException:
        if stop:
            stop()
            thread.join()
        raise
    if failures:
        raise failures[0]
    return done[0]
