# SPDX-License-Identifier: GPL-3.0-or-later
"""Linear systems about an equilibrium: x' = A x, and with inputs of the file x' = A x + B u, y = C x + D u."""
from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, Optional, Sequence, Tuple, Union

import numpy as np
import numpy.typing as npt

from ._binding import ffi, lib
from ._library import bytes_of, made, names_of, taken, text_at, view
from ._notes import Error, complaint
from ._records import Mode, from_struct, picture, preformatted

if TYPE_CHECKING:
    from ._state import State

Matrix = npt.NDArray[np.float64]
Names = Union[str, Sequence[str]]


@dataclass(frozen=True)
class Transfer:
    """A transfer function H(s) = gain prod(s - zeros) / prod(s - poles); called with s [1/s] it is H(s)."""

    input: str
    output: str
    unit: Tuple[str, str]  #: of the output and of the input
    zeros: Tuple[complex, ...]  #: [1/s]
    poles: Tuple[complex, ...]  #: [1/s]
    gain: float  #: 0 where the input does not act on the output
    static_gain: float  #: H(0); inf with a pole at 0, nan where a pole and a zero may cancel there

    def __call__(self, s: Any) -> Any:
        value: Any = np.full(np.shape(s), self.gain, dtype=np.complex128)[()]
        for zero in self.zeros:
            value = value * (np.asarray(s) - zero)
        for pole in self.poles:
            value = value / (np.asarray(s) - pole)
        return value


def _roots(array: Any, count: int) -> Tuple[complex, ...]:
    return tuple(complex(array[k].re, array[k].im) for k in range(count))


class Linearization:
    """x' = A x about an equilibrium, x the deviations of the independent coordinates and then of their rates. Of a model
    with ``inputs`` u also y = C x + D u and x' = A x + B u, with transfer functions."""

    A: Matrix  #: size x size; rows of rates in 1/s^2, of accelerations 1/s^2 or 1/s
    B: Matrix  #: size x inputs
    C: Matrix  #: outputs x size
    D: Matrix  #: outputs x inputs
    coordinates: Tuple[str, ...]  #: the independent ones, "pendulum.theta"
    states: Tuple[str, ...]  #: names of x: coordinates, then rates, then states of the file's own
    inputs: Dict[str, str]  #: names of u with their units; {} without inputs
    outputs: Dict[str, str]  #: names of y with their units
    modes: Tuple[Mode, ...]  #: eigenvalues of A
    equilibrium: Dict[str, float]  #: all coordinates and states there, in their units

    def __init__(self, state: "State", inputs: Names = (), outputs: Names = ()):
        from ._state import coordinates_of, states_of

        handle = made(lib.fbd_linearize, lib.fbd_linearization_free, (state._handle,), state._handle)
        size = lib.fbd_linearization_size(handle)
        every, own = coordinates_of(state._model), states_of(state._model)
        count = (size - len(own)) // 2
        free = [every[lib.fbd_linearization_coordinate(handle, i)] for i in range(count)]
        self.A = view(lib.fbd_linearization_matrix(handle), (size, size), handle)
        self.coordinates = tuple(c.name for c in free)
        self.states = self.coordinates + tuple(c.rate_name for c in free) + tuple(own)
        self.modes = tuple(from_struct(Mode, lib.fbd_linearization_mode(handle, i)) for i in range(size))
        self.equilibrium = {name: state._get(name) for name in (*(c.name for c in every), *own)}
        self._svg = taken(lib.fbd_linearization_svg(handle))
        self._system = self._make_system(handle, inputs, outputs)
        system = self._system
        self.inputs, self.outputs = self._signals("input"), self._signals("output")
        shapes = {"B": (size, len(self.inputs)), "C": (len(self.outputs), size), "D": (len(self.outputs), len(self.inputs))}
        if system is None:
            self.B, self.C, self.D = (np.zeros(shapes[name]) for name in "BCD")
        else:
            self.B = view(lib.fbd_linear_system_input_matrix(system), shapes["B"], system)
            self.C = view(lib.fbd_linear_system_output_matrix(system), shapes["C"], system)
            self.D = view(lib.fbd_linear_system_feedthrough(system), shapes["D"], system)
        texts = (lib.fbd_linearization_text, lib.fbd_linearization_json)
        if system is not None:
            texts = (lib.fbd_linear_system_text, lib.fbd_linear_system_json)
        self._text, self._json = (taken(function(handle if system is None else system)) for function in texts)

    @staticmethod
    def _make_system(handle: Any, inputs: Names, outputs: Names) -> Any:
        """None where the file has no inputs, or none with derivatives, and no names are given."""
        first, input_count, kept_inputs = names_of(inputs, "an input")
        second, output_count, kept_outputs = names_of(outputs, "an output")
        plan = ffi.new("fbd_linear_plan *", {"inputs": first, "input_count": input_count,
                                             "outputs": second, "output_count": output_count})
        try:
            return made(lib.fbd_linear_system_new, lib.fbd_linear_system_free, (handle,), handle, plan)
        except Error as error:
            if input_count or output_count or error.id not in ("no-inputs", "no-derivatives"):
                raise
            return None
        finally:
            del kept_inputs, kept_outputs

    def _signals(self, kind: str) -> Dict[str, str]:
        if self._system is None:
            return {}
        count, get = getattr(lib, f"fbd_linear_system_{kind}_count"), getattr(lib, f"fbd_linear_system_{kind}")
        found = [get(self._system, i) for i in range(count(self._system))]
        return {text_at(signal.name): text_at(signal.unit) for signal in found}

    def _index(self, names: Dict[str, str], name: Optional[str], kind: str) -> int:
        """Of a name, which may be left out where there is only one."""
        if self._system is None:
            raise Error((complaint("error", "no-inputs", "the file declares no `inputs`: there is no transfer function"),))
        if name is None and len(names) == 1:
            return 0
        if name is None or name not in names:
            raise KeyError(f"{kind} must be one of {', '.join(names)}, not {name}")
        return list(names).index(name)

    def transfer(self, input: Optional[str] = None, output: Optional[str] = None) -> Transfer:
        """The transfer function of an input to an output; a name may be left out where there is only one.

        >>> model.linearize(outputs="cart.x").transfer().zeros
        """
        i, o = self._index(self.inputs, input, "input"), self._index(self.outputs, output, "output")
        found = made(lib.fbd_transfer_new, lib.fbd_transfer_free, (self._system,), self._system, i, o)
        source, target = list(self.inputs)[i], list(self.outputs)[o]
        return Transfer(source, target, (self.outputs[target], self.inputs[source]), _roots(found.zeros, found.zero_count),
                        _roots(found.poles, found.pole_count), found.gain, found.static_gain)

    def response(self, omega: Any, input: Optional[str] = None, output: Optional[str] = None) -> "npt.NDArray[np.complex128]":
        """The frequency response H(i omega), as an array of complex numbers, at frequencies [rad/s]."""
        i, o = self._index(self.inputs, input, "input"), self._index(self.outputs, output, "output")
        wanted = np.ascontiguousarray(omega, dtype=np.float64)
        found = np.empty(wanted.shape, dtype=np.complex128)
        if not lib.fbd_linear_system_response(self._system, i, o, ffi.from_buffer("double[]", wanted), wanted.size,
                                              ffi.from_buffer("fbd_complex[]", found, require_writable=True)):
            raise ValueError("omega must be finite")
        return found

    def csv(self) -> str:
        """The frequency responses of all inputs and outputs as a table: magnitudes, and phases in degrees."""
        self._index({"": ""}, None, "input")
        return taken(lib.fbd_linear_system_csv(self._system))

    def gnuplot(self, file: Optional[str] = None) -> str:
        """A Bode plot as a script for gnuplot with its data; the ending of ``file`` chooses its terminal."""
        self._index({"": ""}, None, "input")
        name = ffi.NULL if file is None else ffi.new("char[]", bytes_of(file, "the file"))
        return taken(lib.fbd_linear_system_gnuplot(self._system, name))

    @property
    def svg(self) -> str:
        """The eigenvalues in the complex plane as an SVG document."""
        return self._svg

    def json(self) -> str:
        """One JSON object as text."""
        return self._json

    def __str__(self) -> str:
        return self._text

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return picture(self._svg) + preformatted(self._text)
