# SPDX-License-Identifier: GPL-3.0-or-later
"""Inputs by functions in Python, compared with the same laws written in the file."""
import math
import pickle
import threading

import fbd
import numpy as np
import pytest

POLE = """
fbd: 1
title: A pole held upright
inputs: {M: 0 N*m}
bodies:
  pole:
    motion: {pivot: {at: [0, 0]}}
    parts: {rod: {shape: rod, mass: 2 kg, from: [0, 0], to: [0, 1 m]}}
    initial: {theta: 10 deg}
    forces: [gravity]
    moments: [applied: {name: motor, value: "LAW"}]
simulate: {until: 3 s, events: [{name: half, when: 'theta = 5 deg'}]}
"""
LAW = "-40[N*m]*theta - 8[N*m*s]*omega"


def pd(t, now):
    return -40 * now["pole.theta"] - 8 * now["omega"]


def of_file():
    return fbd.Model.parse(POLE.replace("LAW", LAW).replace("inputs: {M: 0 N*m}\n", ""))


def with_input():
    return fbd.Model.parse(POLE.replace("LAW", "M"))


def test_a_function_moves_the_pole_as_its_law_does():
    want, got = of_file().run(ledger=True), with_input().run(ledger=True, inputs={"M": pd})
    assert [event.name for event in got.events] == [event.name for event in want.events] == ["half"]
    assert got.events[0].t == pytest.approx(want.events[0].t, abs=1e-8)
    for name in ("pole.theta", "pole.omega", "pole.motor"):
        assert got.at(1.3)["theta"] == pytest.approx(want.at(1.3)["theta"], abs=1e-8)
        assert got[name][-1] == pytest.approx(want[name][-1], abs=1e-7)
    assert got.work("pole", "motor") == pytest.approx(want.work("pole", "motor"), abs=1e-7)


def test_the_report_says_that_the_input_is_from_outside():
    run = with_input().run(inputs={"M": pd}, error_bars=True)
    assert "an input by a callback of the program" in run.report()
    assert run.stats.error_estimate < 1e-7
    assert '"M": null' in run.json()
    assert math.isnan(with_input().with_inputs({"M": pd}).parameters["M"].value)


def test_it_is_a_model_with_equations_and_a_closed_loop():
    model = with_input().with_inputs({"M": pd})
    assert model.equations(theta=0.5, omega=0.25)["pole.theta"].terms["motor"] == -40 * 0.5 - 8 * 0.25
    np.testing.assert_allclose(model.linearize(theta=0).A[1], of_file().linearize(theta=0).A[1], rtol=1e-9)


def test_what_a_function_raises_is_raised():
    def late(t, now):
        if t > 1:
            raise ZeroDivisionError("late")
        return 0.0

    with pytest.raises(ZeroDivisionError, match="late"):
        with_input().run(inputs={"M": late})
    with pytest.raises(KeyError, match="did you mean `pole.theta`"):
        with_input().run(inputs={"M": lambda t, now: now["pole.thetta"]})
    with pytest.raises(TypeError):
        with_input().run(inputs={"M": lambda t, now: "two"})


def test_what_reads_the_file_again_refuses_functions():
    model = with_input().with_inputs({"M": pd})
    with pytest.raises(TypeError, match="not part of the file"):
        pickle.dumps(model)
    with pytest.raises(TypeError, match="not part of the file"):
        model.sweep({"M": [1, 2]})
    with pytest.raises(fbd.Error) as raised:
        model.emit_c()
    assert raised.value.id == "cannot-emit"


def test_wrong_inputs_are_refused_by_name():
    with pytest.raises(fbd.Error) as raised:
        with_input().run(inputs={"N": pd})
    assert raised.value.id == "unknown-input"
    with pytest.raises(TypeError):
        with_input().run(inputs={"M": 3})
    with pytest.raises(TypeError):
        with_input().run(inputs=[pd])


def test_the_motion_of_a_call_ends_with_it():
    kept = []

    def keep(t, now):
        kept.append(now)
        assert len(now) == 2 and list(now) == ["pole.theta", "pole.omega"]
        return 0.0

    with_input().run(until=0.1, inputs={"M": keep})
    with pytest.raises(RuntimeError):
        kept[0]["theta"]


def test_threads_run_one_model():
    model, ends = with_input().with_inputs({"M": pd}), []
    threads = [threading.Thread(target=lambda: ends.append(model.run()["pole.theta"][-1])) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(ends) == 3 and len(set(ends)) == 1


OSCILLATOR = """
fbd: 1
inputs: {push: 5 N}
bodies:
  block:
    mass: 2 kg
    motion: slide
    forces: [spring: {stiffness: 50 N/m}, applied: {value: push}]
    initial: {x: 0.3 m}
simulate: {until: 4 s, events: [{name: middle, when: "x = 0.1", direction: falling}]}
"""


def swing(x, v, force, h):
    """Closed form: x'' = force/m - (k/m) x, with k/m = 25/s^2."""
    rest = force / 50
    return (rest + (x - rest) * math.cos(5 * h) + v / 5 * math.sin(5 * h),
            -5 * (x - rest) * math.sin(5 * h) + v * math.cos(5 * h))


def test_an_input_is_constant_until_it_is_set_anew():
    simulation, x, v, force = fbd.Model.parse(OSCILLATOR).simulate(), 0.3, 0.0, 5.0
    for i in range(1, 21):
        state = simulation.advance(0.1 * i)
        x, v = swing(x, v, force, 0.1)
        assert state["block.x"] == pytest.approx(x, abs=1e-9) and state["v"] == pytest.approx(v, abs=1e-8)
        force = 20 * math.sin(i)
        simulation.set_input("push", force)
    assert simulation.t == 2.0 and not simulation.ended
    assert all(event.name == "middle" and event.t <= 2 for event in simulation.events) and simulation.events


def test_without_a_change_the_steps_are_those_of_the_run():
    model = fbd.Model.parse(OSCILLATOR)
    simulation, run = model.simulate(), model.run()
    for t in (0.3, 1.7, 2.9):
        assert simulation.advance(t)["block.x"] == run.at(t)["block.x"]
    assert simulation.advance(9)["block.x"] == run.at(4)["block.x"]
    assert simulation.ended and simulation.t == 4


def test_what_cannot_be_set_is_refused():
    simulation = fbd.Model.parse(OSCILLATOR).simulate()
    with pytest.raises(fbd.Error) as raised:
        simulation.set_input("pull", 3)
    assert raised.value.id == "unknown-input" and "`push`" in str(raised.value)
    with pytest.raises(fbd.Error):
        simulation.set_input("push", "3 m")
    assert simulation.advance(0.2)["block.x"] == fbd.Model.parse(OSCILLATOR).run().at(0.2)["block.x"]
    with pytest.raises(ValueError, match="before"):
        simulation.advance(0.1)


def test_the_file_is_compiled_once():
    simulation = fbd.Model.parse(OSCILLATOR).simulate()
    simulation.set_input("push", 1)
    model = simulation._model
    for i in range(1, 4):
        simulation.advance(0.1 * i)
        simulation.set_input("push", f"{i + 1} N")
        assert simulation._model is model and simulation.state["block.x"] == simulation.advance(0.1 * i)["block.x"]
    x, v = 0.3, 0.0
    for force in (1, 2, 3):
        x, v = swing(x, v, force, 0.1)
    assert simulation.state["block.x"] == pytest.approx(x, abs=1e-9)
    with pytest.raises(ValueError):
        simulation.set_input("push", math.inf)


SLIDER = """
fbd: 1
inputs: {push: 5 N}
bodies:
  block:
    mass: 2 kg
    motion: slide
    forces: [gravity, normal, friction: {static: 0.3, kinetic: 0.2}, applied: {value: push}]
simulate: {until: 6 s}
"""


def test_a_block_breaks_away_at_the_instant_of_the_change():
    simulation, a = fbd.Model.parse(SLIDER).simulate(), 5 - 0.2 * 9.81
    assert simulation.advance(1)["block.v"] == 0 and not simulation.events
    simulation.set_input("push", "10 N")
    assert [(event.kind, event.t) for event in simulation.events] == [("breakaway", 1.0)]
    assert simulation.advance(2)["block.v"] == pytest.approx(a, abs=1e-9)
    simulation.set_input("push", 0)
    assert simulation.advance(5)["block.v"] == 0
    assert simulation.events[-1].t == pytest.approx(2 + a / (0.2 * 9.81), abs=1e-9)


def test_one_input_by_a_function_and_another_that_is_set():
    two = OSCILLATOR.replace("{push: 5 N}", "{push: 5 N, drag: 0 N}").replace("{value: push}", "{value: push + drag}")
    model = fbd.Model.parse(two).with_inputs({"drag": lambda t, now: -20 * now["v"]})
    simulation = model.simulate()
    simulation.advance(1)
    simulation.set_input("push", 20)
    assert simulation.advance(4)["block.x"] == pytest.approx(0.4, abs=1e-5)  # critically damped: by 16 e^-15
    with pytest.raises(fbd.Error) as raised:
        simulation.set_input("drag", 1)
    assert raised.value.id == "fixed-input"
