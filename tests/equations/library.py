# SPDX-License-Identifier: GPL-3.0-or-later
"""What the library writes of a model: equations as JSON, text and LaTeX, its diagram, and the data of its page."""
import base64
import ctypes
import json
import os
import re
import struct
from pathlib import Path

NAN = float("nan")


class Drawing(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("body", ctypes.c_char_p),
                *((name, ctypes.c_bool) for name in ("components", "supports", "symbols", "worksheet", "solution")),
                ("scale", ctypes.c_double)]


class Options(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("until", ctypes.c_double), ("tolerance", ctypes.c_double),
                ("step", ctypes.c_double), ("method", ctypes.c_char_p), ("error_bars", ctypes.c_bool),
                ("accuracy", ctypes.c_double), ("no_structure", ctypes.c_bool)]


class Recording(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("every", ctypes.c_double), ("ledger", ctypes.c_bool),
                ("csv", ctypes.c_void_p), ("csv_context", ctypes.c_void_p), ("motion_only", ctypes.c_bool),
                ("keep", ctypes.c_bool), ("progress", ctypes.c_void_p), ("progress_context", ctypes.c_void_p),
                ("table", ctypes.c_bool), ("components", ctypes.c_bool), ("rows", ctypes.c_uint),
                ("degrees", ctypes.c_bool)]


class EquationsOptions(ctypes.Structure):
    _fields_ = [("size", ctypes.c_size_t), ("format", ctypes.c_int), ("components", ctypes.c_bool)]


TEXT, LATEX, JSON = 0, 2, 3  # fbd_format
LIBRARY = ctypes.CDLL(str(Path(os.environ["FBD_BUILD_ROOT"]) / "lib" / "libfbd.so"))
for _name in ("fbd_model_parse", "fbd_state_new", "fbd_simulation_new", "fbd_simulation_run", "fbd_result_state",
              "fbd_equations_write", "fbd_diagram_svg", "fbd_result_html", "fbd_errors_new", "fbd_emit_c"):
    getattr(LIBRARY, _name).restype = ctypes.c_void_p
for _name in ("fbd_state_close", "fbd_state_set", "fbd_has_html", "fbd_model_quantity"):
    getattr(LIBRARY, _name).restype = ctypes.c_bool


class Refused(Exception):
    """The model, its start or its run."""


def taken(pointer):
    """A text of the library, as a string."""
    if not pointer:
        raise Refused("nothing is written")
    text = ctypes.string_at(pointer).decode()
    LIBRARY.fbd_free(ctypes.c_void_p(pointer))
    return text


class Model:
    """A model with one state."""

    def __init__(self, text, name="scene"):
        data = text.encode()
        self.state = None
        self.model = ctypes.c_void_p(LIBRARY.fbd_model_parse(data, ctypes.c_size_t(len(data)), str(name).encode(), None,
                                                             ctypes.c_size_t(0), None))
        if not self.model:
            raise Refused("the file")
        self.state = ctypes.c_void_p(LIBRARY.fbd_state_new(self.model))
        if not LIBRARY.fbd_state_close(self.state, None):
            self.free()
            raise Refused("the start")

    def free(self):
        LIBRARY.fbd_state_free(self.state)
        LIBRARY.fbd_model_free(self.model)

    def quantity(self, text, unit):
        """A number of the file that has a unit, in that of the model."""
        value = ctypes.c_double()
        if not LIBRARY.fbd_model_quantity(self.model, b"it", str(text).encode(), unit.encode(), ctypes.byref(value), None):
            raise Refused(f"{text!r} in {unit}")
        return value.value

    def written(self, form):
        options = EquationsOptions(ctypes.sizeof(EquationsOptions), form, True)
        return taken(LIBRARY.fbd_equations_write(self.state, ctypes.byref(options), None))

    def equations(self):
        return json.loads(self.written(JSON))

    def report(self):
        return self.written(TEXT)

    def latex(self):
        return self.written(LATEX)

    def svg(self):
        drawing = Drawing(ctypes.sizeof(Drawing), None, False, False, True, False, False, 0)
        return taken(LIBRARY.fbd_diagram_svg(self.state, ctypes.byref(drawing), None))

    def page(self, until, rows):
        """The data of the page of a run of that length."""
        options = Options(ctypes.sizeof(Options), until, 0, 0, None, False, 0, False)
        simulation = ctypes.c_void_p(LIBRARY.fbd_simulation_new(self.model, ctypes.byref(options), None))
        if not simulation:
            raise Refused("the run")
        recording = Recording(ctypes.sizeof(Recording), keep=True, components=True, rows=rows, every=until)
        result = ctypes.c_void_p(LIBRARY.fbd_simulation_run(simulation, ctypes.byref(recording)))
        try:
            html = taken(LIBRARY.fbd_result_html(result, None))
        finally:
            LIBRARY.fbd_result_free(result)
            LIBRARY.fbd_simulation_free(simulation)
        return Page(json.loads(re.search(r'id="data">\s*(.*?)</script>', html, re.DOTALL).group(1)))


class Page:
    """The numbers of a page: cell(column, row)."""

    def __init__(self, data):
        self.data = data
        self.rows = data["rows"]
        self.doubles = self.numbers(data["doubles"], "d", 8)
        self.floats = self.numbers(data["floats"], "f", 4)
        self.index = {column["n"]: i for i, column in enumerate(data["columns"])}

    @staticmethod
    def numbers(text, code, size):
        raw = base64.b64decode(text)
        return struct.unpack(f"<{len(raw) // size}{code}", raw)

    def cell(self, column, row):
        of = self.data["columns"][column]
        if "d" in of:
            return self.doubles[(of["d"] + 1) * self.rows + row]
        if "f" in of:
            return self.floats[of["f"] * self.rows + row]
        if "of" in of:
            return of["a"] + of["b"] * self.cell(of["of"], row)
        return NAN if of["c"] is None else of["c"]

    def named(self, name, row):
        return self.cell(self.index[name], row)
