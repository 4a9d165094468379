# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are written, and those of the package."""
from __future__ import annotations

import os
from pathlib import Path
from typing import Union

from ._notes import Error, complaint


def put(path: "Union[str, os.PathLike[str]]", content: Union[str, bytes]) -> None:
    """Write a file whole, or not at all."""
    target = Path(os.fspath(path))
    beside = target.with_name(f"{target.name}.{os.getpid()}.tmp")
    try:
        beside.write_bytes(content.encode("utf-8") if isinstance(content, str) else content)
        os.replace(beside, target)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def fmu_library() -> bytes:
    """The binary that goes into an FMU."""
    try:
        return Path(__file__).with_name("fbd-fmu.bin").read_bytes()
    except FileNotFoundError:
        text = "this module was built without the binary of FMUs, which a build of fbd with the archives of GSL and libyaml has"
        raise Error((complaint("error", "no-fmu", text, "fbd-run --fmu writes the same file"),)) from None
