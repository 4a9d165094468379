#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: derivatives.py: directional and adjoint derivatives of FMUs are those of differences. Prints TAP."""
import sys

from fmu import OK
from claims_of_fmus import STICKS, close, fmu_of, run_claims

OSCILLATOR = "forcing/pushed_oscillator.yaml"

SMOOTH = """fbd: 1
parameters: {x0: 0.3 m, v0: -0.7 m/s, a0: 40 deg, w0: 1.3 rad/s, b0: -25 deg, u0: 0.4 rad/s}
inputs: {push: 3 N, k: 20 N/m, wind: 1 m/s}
bodies:
  cart:
    mass: 2 kg
    motion: slide
    initial: {x: x0, v: v0}
    forces: [gravity, applied: {value: "push*cos(3*x/1[m]) - k*x"}, drag: {quadratic: 0.3 kg/m, wind: [wind, 0]}]
  arm:
    motion: {pivot: {on: cart, at: G}}
    parts: {rod: {shape: rod, mass: 1 kg, from: [0, 0], to: [0, -0.8 m]}}
    points: {end: [0, -0.8 m]}
    initial: {theta: a0, omega: w0}
    forces: [gravity]
    moments: [damper: {coefficient: 0.2 N*m*s/rad}]
  hand:
    motion: {pivot: {on: arm, at: end}}
    parts: {bob: {shape: point, mass: 0.5 kg, center: [0, -0.4 m]}}
    initial: {theta: b0, omega: u0}
    forces: [gravity, applied: {name: motor, value: push*theta, angle: 30 deg, at: [0, -0.4 m]}]
simulate: {until: 3 s}
"""
STARTS = {"cart.x": "x0", "cart.v": "v0", "arm.theta": "a0", "arm.omega": "w0", "hand.theta": "b0", "hand.omega": "u0"}
SLIPS = """fbd: 1
parameters: {x0: 0.1 m, v0: 0.5 m/s}
inputs: {push: 3 N, mu: 0.3}
bodies:
  block:
    mass: 2 kg
    motion: {slide: {along: 20 deg}}
    initial: {x: x0, v: v0}
    forces:
      - gravity
      - normal
      - friction: {static: 0.5, kinetic: mu}
      - applied: {name: hand, value: "push*(1 + x/1[m])^2", angle: -30 deg}
      - applied: {name: spring, value: "-20[N/m]*x - 50[N/m^3]*x^3"}
simulate: {until: 2 s}
"""


def values_at_start(fmu, values):
    instance = fmu.start()
    assert instance.set(values) == OK and instance.initialize() == OK
    got = instance.get()
    assert isinstance(got, dict), instance.messages
    instance.free()
    return got


def derivatives_are_those_of_differences():
    for version in (2, 3):
        for model, starts in ((SMOOTH, STARTS), (SLIPS, {"block.x": "x0", "block.v": "v0"}),
                              (OSCILLATOR, {})):
            fmu = fmu_of(model, version)
            knowns = list(starts) + fmu.inputs
            instance = fmu.open()
            for known in knowns:
                name = starts.get(known, known)
                middle, h = float(fmu.variables[name].start), 1e-5
                above, below = (values_at_start(fmu, {name: middle + sign * h}) for sign in (1, -1))
                got = dict(zip(fmu.outputs, instance.derivative(fmu.outputs, [known], [1.0])))
                for output in fmu.outputs:
                    want = (above[output] - below[output]) / (2 * h)
                    # Differences are good to h^2 of the third derivative, and roundings over h.
                    assert close(got[output], want, 10 + abs(want), 1e-8), (known, output, got[output], want)
            seed = [0.3 * (i + 1) * (-1) ** i for i in range(len(knowns))]
            columns = [instance.derivative(fmu.outputs, [known], [1.0]) for known in knowns]
            along = instance.derivative(fmu.outputs, knowns, seed)
            for i, value in enumerate(along):
                want = sum(column[i] * s for column, s in zip(columns, seed))
                assert close(value, want, 1 + abs(want), 1e-12)
            if version == 3:
                back = instance.derivative(fmu.outputs, knowns, [1.0 + i for i in range(len(fmu.outputs))], adjoint=True)
                for k, value in enumerate(back):
                    want = sum(columns[k][i] * (1.0 + i) for i in range(len(fmu.outputs)))
                    assert close(value, want, 1 + abs(want), 1e-12)
            instance.free()


def derivatives_by_inputs_hold_on_the_way():
    for model in (STICKS.replace("0.4[N]*hysteresis(theta, -0.2[rad], 0.3[rad])", "0.4[N]*max(theta/1[rad], sin(2*t))"), SMOOTH, SLIPS):
        fmu = fmu_of(model, 3)
        instance = fmu.open(events=True)
        assert instance.call("EnterStepMode") == OK
        for t in (0.13, 0.31, 0.8):
            assert instance.go_to(t)[0] == OK and instance.call("EnterEventMode") == OK
            for name in fmu.inputs:
                got = dict(zip(fmu.outputs, instance.derivative(fmu.outputs, [name], [1.0])))
                middle, h, values = instance.get([name])[name], 1e-5, []
                saved = instance.save()
                for sign in (1, -1):
                    assert instance.set({name: middle + sign * h}) == OK
                    values.append(instance.get())
                    assert instance.restore(saved) == OK
                instance.forget(saved)
                for output in fmu.outputs:
                    want = (values[0][output] - values[1][output]) / (2 * h)
                    assert close(got[output], want, 10 + abs(want), 1e-8), (t, name, output, got[output], want)
            assert instance.call("EnterStepMode") == OK
        instance.free()


# Coordinates that are joined: a slider-crank with what its coordinates would be if they were free is no state that a
# file can begin at, so the derivative by an input is all that differences can be held against.
JOINED = """fbd: 1
parameters: {a0: 35 deg, w0: 3 rad/s}
inputs: {torque: 2 N*m, load: -4 N}
ground: {points: {O: [0, 0]}}
bodies:
  crank:
    shape: rod
    mass: 1 kg
    length: 0.2 m
    motion: {pivot: {at: O, point: left}}
    initial: {theta: a0, omega: w0}
    forces: [gravity]
    moments: [applied: {name: drive, value: torque*cos(theta)}]
  rod:
    shape: rod
    mass: 1 kg
    length: 0.5 m
    motion: {pivot: {on: crank, at: right, point: left}}
    initial: {assemble: true}
    forces: [gravity]
  piston:
    mass: 2 kg
    motion: {slide: {along: 0 deg}}
    initial: {assemble: true}
    forces: [applied: {name: gas, value: "load*v/1[m/s]"}]
couplings: [pin: {name: wrist, between: [rod.right, piston.G]}]
simulate: {until: 1 s}
"""


def couplings_are_followed():
    fmu = fmu_of(JOINED, 3)
    instance = fmu.open()
    for name in fmu.inputs:
        middle, h = float(fmu.variables[name].start), 1e-5
        above, below = (values_at_start(fmu, {name: middle + sign * h}) for sign in (1, -1))
        got = dict(zip(fmu.outputs, instance.derivative(fmu.outputs, [name], [1.0])))
        for output in fmu.outputs:
            want = (above[output] - below[output]) / (2 * h)
            assert close(got[output], want, 10 + abs(want), 1e-8), (name, output, got[output], want)
    instance.free()


def what_has_none_says_so():
    driven = "couplings/driven_slider_crank.yaml"
    points = SLIPS + "output: {points: [block]}\n"
    for version in (2, 3):
        for model in (driven, points, STICKS):
            fmu = fmu_of(model, version)
            assert not fmu.has_derivatives
            instance = fmu.open()
            assert instance.derivative(fmu.outputs[:1], fmu.outputs[:1], [1.0]) == 3
            instance.free()
        capable = fmu_of(OSCILLATOR, version).co_simulation.attrib
        assert capable["providesDirectionalDerivative" + "s" * (version == 3)] == "true"


CLAIMS = [derivatives_are_those_of_differences, derivatives_by_inputs_hold_on_the_way, couplings_are_followed,
          what_has_none_says_so]

sys.exit(run_claims(CLAIMS))
