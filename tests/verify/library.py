# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of lib/fbd.h that is needed to ask a model for its accelerations with all their digits."""
import ctypes
from ctypes import POINTER, Structure, byref, c_bool, c_char_p, c_double, c_size_t, c_void_p


class Equation(Structure):
    _fields_ = [(name, c_char_p) for name in ("body", "coordinate", "inertia_name", "acceleration_name", "unit", "inertia_unit", "acceleration_unit")] + [
        ("inertia", c_double), ("sum", c_double), ("acceleration", c_double), ("term_count", c_size_t), ("terms", c_void_p), ("normal", c_double)]


PROTOTYPES = {
    "fbd_errors_new": (c_void_p, []),
    "fbd_model_read": (c_void_p, [c_char_p, c_void_p, c_size_t, c_void_p]),
    "fbd_state_new": (c_void_p, [c_void_p]),
    "fbd_state_set": (c_bool, [c_void_p, c_char_p, c_double]),
    "fbd_state_get": (c_bool, [c_void_p, c_char_p, POINTER(c_double)]),
    "fbd_state_close": (c_bool, [c_void_p, c_void_p]),
    "fbd_assemble_components": (c_void_p, [c_void_p]),
    "fbd_equations_find": (Equation, [c_void_p, c_char_p]),
    "fbd_equations_free": (None, [c_void_p]),
}


class Model:
    """A model file and a state of it."""

    def __init__(self, library, path):
        self.fbd = ctypes.CDLL(str(library))
        for name, (result, arguments) in PROTOTYPES.items():
            getattr(self.fbd, name).restype, getattr(self.fbd, name).argtypes = result, arguments
        self.errors = self.fbd.fbd_errors_new()
        model = self.fbd.fbd_model_read(str(path).encode(), None, 0, self.errors)
        assert model, f"{path} cannot be read"
        self.state = self.fbd.fbd_state_new(model)

    def set(self, values):
        for name, value in values.items():
            assert self.fbd.fbd_state_set(self.state, name.encode(), value), name
        assert self.fbd.fbd_state_close(self.state, self.errors), "no such state"

    def knows(self, name):
        return self.fbd.fbd_state_get(self.state, name.encode(), byref(c_double()))

    def get(self, name):
        value = c_double()
        assert self.fbd.fbd_state_get(self.state, name.encode(), byref(value)), name
        return value.value

    def accelerations(self, coordinates):
        equations = self.fbd.fbd_assemble_components(self.state)
        found = [self.fbd.fbd_equations_find(equations, name.encode()).acceleration for name in coordinates]
        self.fbd.fbd_equations_free(equations)
        return found
