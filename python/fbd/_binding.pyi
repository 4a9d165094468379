# SPDX-License-Identifier: GPL-3.0-or-later
"""What make_binding.py writes: every function and type of fbd.h, by cffi."""
from typing import Any

ffi: Any
lib: Any
