# SPDX-License-Identifier: GPL-3.0-or-later
"""TAP for tests in Python: `with claim("what holds"): assert ...`, then finish()."""
import sys
import traceback
from contextlib import contextmanager

_counts = {"all": 0, "failed": 0}


@contextmanager
def claim(text):
    _counts["all"] += 1
    try:
        yield
    except Exception:  # whatever goes wrong, the other claims are still to be made
        _counts["failed"] += 1
        print(f"not ok {_counts['all']} - {text}")
        print("".join(f"# {line}\n" for line in traceback.format_exc().splitlines()), end="", flush=True)
    else:
        print(f"ok {_counts['all']} - {text}", flush=True)


def finish():
    print(f"1..{_counts['all']}")
    sys.exit(1 if _counts["failed"] else 0)


def skip(reason):
    print(f"1..0 # SKIP {reason}")
    sys.exit(0)


def close(got, want, tolerance):
    assert abs(got - want) <= tolerance, f"got {got!r}, want {want!r}, tolerance {tolerance:g}"
