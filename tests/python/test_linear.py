# SPDX-License-Identifier: GPL-3.0-or-later
"""Linear systems with inputs and outputs, compared with closed forms."""
import math

import fbd
import numpy as np
import pytest
from conftest import MODELS, PENDULUM

OSCILLATOR = """
fbd: 1
inputs: {F: 0 N}
bodies:
  b:
    mass: 2 kg
    motion: slide
    forces:
      - spring: {stiffness: 50 N/m}
      - damper: {coefficient: 4 N*s/m}
      - applied: {name: push, value: F}
"""


def test_an_oscillator_has_its_matrices():
    linear = fbd.Model.parse(OSCILLATOR).linearize(outputs=["b.x", "b.v_dot"])
    assert linear.inputs == {"F": "N"} and linear.outputs == {"b.x": "m", "b.v_dot": "m/s^2"}
    np.testing.assert_allclose(linear.A, [[0, 1], [-25, -2]], rtol=1e-14)
    np.testing.assert_allclose(linear.B, [[0], [0.5]], rtol=1e-14)
    np.testing.assert_allclose(linear.C, [[1, 0], [-25, -2]], rtol=1e-14)
    np.testing.assert_allclose(linear.D, [[0], [0.5]], rtol=1e-14)


def test_and_its_transfer_function():
    linear = fbd.Model.parse(OSCILLATOR).linearize()
    transfer = linear.transfer()
    assert transfer.zeros == () and transfer.unit == ("m", "N")
    assert transfer.static_gain == pytest.approx(0.02, rel=1e-14)
    assert sorted(pole.imag for pole in transfer.poles) == pytest.approx([-math.sqrt(24), math.sqrt(24)], rel=1e-12)
    omega = np.geomspace(0.1, 100, 31)
    closed = 1 / (50 - 2 * omega**2 + 4j * omega)
    np.testing.assert_allclose(transfer(1j * omega), closed, rtol=1e-12)
    np.testing.assert_allclose(linear.response(omega), closed, rtol=1e-12)
    assert linear.csv().startswith("omega [rad/s],b.x/F [m/N],b.x/F phase [deg]\n")
    assert "logscale" in linear.gnuplot("bode.svg")


def test_a_model_without_inputs_has_none():
    linear = fbd.Model(PENDULUM).linearize()
    assert linear.inputs == {} and linear.B.shape == (2, 0)
    with pytest.raises(fbd.Error) as caught:
        linear.transfer()
    assert caught.value.id == "no-inputs"
    with pytest.raises(fbd.Error) as caught:
        fbd.Model.parse(OSCILLATOR).linearize(outputs="b.y")
    assert caught.value.id == "unknown-output"
    with pytest.raises(KeyError):
        fbd.Model.parse(OSCILLATOR).linearize().transfer("G")


def test_parameters_and_inputs_are_listed():
    parameters = fbd.Model(MODELS / "forcing/pushed_oscillator.yaml", push="7 N").parameters
    assert parameters["push"].input and parameters["push"].value == 7 and parameters["push"].unit == "N"
    assert not fbd.Model(PENDULUM).parameters["theta0"].input
