#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: exchange.py: FMUs for model exchange, integrated by an importer, move as fbd-run says they do. Prints TAP.

The importer is the plainest: Runge's and Kutta's classical method of a fixed step, and events by bisection of its steps, whose
cubic interpolants it does not need. So its errors are those of its step, and of the resolution of its bisection."""
import ctypes as c
import math
import sys

from fmu import ERROR, OK
from claims_of_fmus import check_close, close, fmu_of, run_claims, run_csv


class Importer:
    """An instance for model exchange and the state of its integration."""

    def __init__(self, model, version, *arguments, inputs=None, parameters=None):
        self.fmu = fmu_of(model, version, *arguments)
        assert self.fmu.xml.find("ModelExchange") is not None
        kind = {"exchange": True}
        self.instance = self.fmu.open(parameters=parameters, **kind)
        self.call, self.version, self.inputs = self.instance.call, version, inputs
        self.states = len([one for one in self.fmu.variables.values() if one.derivative])
        count = self.fmu.xml.get("numberOfEventIndicators") or len(self.fmu.xml.findall("ModelStructure/EventIndicator"))
        self.indicators = int(count)
        self.t, self.events, self.ended, self.next = 0.0, 0, False, math.inf
        self.y = None
        self.update()

    def need(self, status):
        assert status == OK, (status, self.instance.messages)

    def numbers(self, name, count):
        array = (c.c_double * count)()
        self.need(self.call(name, array, c.c_size_t(count)))
        return list(array)

    def put(self, t, y):
        self.need(self.call("SetTime", c.c_double(t)))
        self.need(self.call("SetContinuousStates", (c.c_double * len(y))(*y), c.c_size_t(len(y))))
        if self.inputs:
            self.need(self.instance.set(self.inputs(t)))

    def slopes(self, t, y):
        self.put(t, y)
        return self.numbers("GetContinuousStateDerivatives" if self.version == 3 else "GetDerivatives", self.states)

    def signs(self, t, y):
        self.put(t, y)
        return [z > 0 for z in self.numbers("GetEventIndicators", self.indicators)]

    def update(self):
        """Event Mode, in which the FMU is at the start, or has been put."""
        if self.version == 3:
            status, again, ends, _, jumps, has_next, time = self.instance.update()
        else:
            status, again, ends, _, jumps, has_next, time = self.instance.new_states()
        self.need(status)
        assert not again
        self.ended, self.next = ends, time if has_next else math.inf
        self.need(self.call("EnterContinuousTimeMode"))
        if jumps or self.y is None:
            self.y = self.numbers("GetContinuousStates", self.states)

    def event(self):
        self.put(self.t, self.y)
        self.need(self.call("EnterEventMode"))
        self.events += 1
        self.update()

    def step(self, h):
        t, y = self.t, self.y
        k = [self.slopes(t, y)]
        for share in (0.5, 0.5, 1):
            k.append(self.slopes(t + share * h, [a + share * h * b for a, b in zip(y, k[-1])]))
        return [a + h / 6 * (p + 2 * q + 2 * r + s) for a, p, q, r, s in zip(y, *k)]

    def go_to(self, target, h):
        while self.t < target and not self.ended:
            before = self.signs(self.t, self.y)
            length = min(h, target - self.t, self.next - self.t)
            end = self.step(length)
            low = 0.0
            crossed = self.signs(self.t + length, end) != before
            while crossed and length - low > 1e-13 * max(1, self.t):
                middle = low + (length - low) / 2
                end_there = self.step(middle)
                if self.signs(self.t + middle, end_there) != before:
                    length, end = middle, end_there
                else:
                    low = middle
            at_time = self.t + length >= self.next
            self.t, self.y = (self.next if at_time else self.t + length), end
            self.put(self.t, self.y)
            asked = self.complete()
            if crossed or at_time or asked:
                self.event()
        self.put(self.t, self.y)

    def complete(self):
        if self.version == 3:
            flags = [c.c_bool(), c.c_bool()]
            self.need(self.call("CompletedIntegratorStep", c.c_bool(True), *map(c.byref, flags)))
        else:
            flags = [c.c_int(), c.c_int()]
            self.need(self.call("CompletedIntegratorStep", 1, *map(c.byref, flags)))
        return bool(flags[0].value)

    def values(self, names):
        return self.instance.get(names)


def compare(model, h, tolerance, until, version=3):
    """At regular times, where no event is."""
    rows = run_csv(model, "--every", until / 10, "--until", until)
    importer = Importer(model, version)
    names = [name for name in rows[0] if name in importer.fmu.variables]
    size = {name: max(abs(row[name]) for row in rows) + 1e-300 for name in names}
    for row in rows:
        if abs(10 * row["t"] / until - round(10 * row["t"] / until)) > 1e-9:
            continue
        importer.go_to(row["t"], h)
        got = importer.values(names)
        for name in names:
            assert close(got[name], row[name], size[name], tolerance), (model, row["t"], name, got[name], row[name])
    return importer


# ---- motions, with the step of the importer and the accuracy that it has then

def a_motion_without_events_is_integrated():
    for version in (2, 3):
        importer = compare("trees/double_pendulum.yaml", 1 / 500, 1e-7, 1, version=version)
        assert importer.events == 0 and importer.states == 4


def errors_fall_with_the_fourth_power_of_the_step_past_events():
    """Stick and slip, with some thirty events: a wrong state at one of them would not fall."""
    errors = []
    for steps in (1000, 2000):
        importer = Importer("hard/stick_slip_belt.yaml", 3)
        importer.go_to(10, 10 / steps)
        want = run_csv("hard/stick_slip_belt.yaml", "--every", 10, "--until", 10)[-1]
        got = importer.values(["block.x", "block.v"])
        errors.append(max(abs(got[name] - want[name]) for name in got))
        assert importer.events > 20
    assert errors[1] < errors[0] / 12 and errors[1] < 1e-5, errors


def a_ball_bounces_and_comes_to_rest():
    """Past the limit of infinitely many bounces, which the transition sums."""
    for version in (2, 3):
        importer = compare("contact/bouncing_ball.yaml", 0.01, 1e-10, 4.5, version=version)
        assert 15 < importer.events < 80, importer.events


def mechanisms_stay_closed():
    importer = compare("couplings/driven_slider_crank.yaml", 1 / 1000, 1e-9, 1)
    importer = compare("couplings/four_bar.yaml", 1 / 1000, 1e-5, 1)
    assert importer.events > 10


def ropes_bodies_that_strike_and_switches_in_time():
    compare("couplings/rope_pendulum.yaml", 1 / 500, 1e-8, 2)
    compare("contact/woodpecker.yaml", 1 / 8000, 2e-5, 0.2)
    compare("forcing/square_wave_with_friction.yaml", 0.02, 1e-12, 10)
    compare("data/measured_push.yaml", 0.001, 1e-12, 0.2)


def a_mechanism_at_rest_asks_for_no_events():
    importer = Importer("statics/truss.yaml", 3)
    importer.go_to(0.1, 1e-3)
    assert importer.events == 0, importer.events


# ---- inputs

DRIVEN = """fbd: 1
parameters: {{m: 1.5 kg, k: 40 N/m}}
{}
bodies:
  block:
    mass: m
    motion: slide
    forces: [gravity, normal, friction: {{static: 0.4, kinetic: 0.3}}, spring: {{stiffness: k}}, applied: {{value: {}}}]
simulate: {{until: 3 s}}
"""
BY_INPUT = DRIVEN.format("inputs: {push: 0 N}", "push")
BY_TIME = DRIVEN.format("", '"25[N]*sin(4[1/s]*t)"')
BY_JUMPS = DRIVEN.format("tables: {push: {points: [[0, 0], [0.5, 20], [1.25, -25], [5, -25]], interpolation: step}}",
                         '"push(t/1[s])*1[N]"')


def an_input_changes_within_steps():
    for version in (2, 3):
        rows = run_csv(BY_TIME, "--every", 0.25)
        importer = Importer(BY_INPUT, version, inputs=lambda t: {"push": 25 * math.sin(4 * t)})
        for row in rows:
            if abs(row["t"] * 4 - round(row["t"] * 4)) > 1e-9:
                continue
            importer.go_to(row["t"], 1 / 500)
            check_close(importer.values(["block.x", "block.v"]), {n: row[n] for n in ("block.x", "block.v")}, 1e-7)
        assert importer.events > 3


def an_input_jumps_in_event_mode():
    push = [0.0]
    importer = Importer(BY_INPUT, 3, inputs=lambda t: {"push": push[0]})
    for start, end, value in ((0, 0.5, 0), (0.5, 1.25, 20), (1.25, 3, -25)):
        push[0] = value
        importer.event()
        importer.go_to(end, 1 / 500)
    want = run_csv(BY_JUMPS, "--every", 3)[-1]
    check_close(importer.values(["block.x", "block.v"]), {n: want[n] for n in ("block.x", "block.v")}, 1e-8)


def a_scene_of_more_than_500_numbers_has_inputs():
    bodies = "".join(f"  b{k}: {{mass: 1 kg, motion: slide, initial: {{x: {k} m}}, "
                     f"forces: [spring: {{stiffness: {1 + k % 7} N/m}}, applied: {{value: push}}]}}\n" for k in range(1, 261))
    text = f"fbd: 1\ninputs: {{push: 0 N}}\nbodies:\n{bodies}simulate: {{until: 1 s}}\n"
    importer = Importer(text, 3, inputs=lambda t: {"push": 3})
    assert importer.states == 520
    importer.go_to(0.5, 0.01)
    for k in (1, 130, 260):
        rest, rate = 3 / (1 + k % 7), math.sqrt(1 + k % 7)
        check_close(importer.values([f"b{k}.x"]), {f"b{k}.x": rest + (k - rest) * math.cos(0.5 * rate)}, 1e-7)


# ---- the rest of the interface

ENDS = """fbd: 1
parameters: {k: 9 N/m}
states: {work: {rate: "k*block.x*block.v", initial: 0 J}}
bodies: {block: {mass: 1 kg, motion: slide, initial: {x: 1 m}, forces: [spring: {stiffness: k}]}}
simulate: {until: 3 s, events: [{name: middle, when: block.x = 0, then: stop}]}
"""


def an_event_of_the_file_ends_it_and_parameters_can_be_set():
    importer = Importer(ENDS, 3, parameters={"k": 16})
    importer.go_to(3, 0.005)
    assert importer.ended and close(importer.t, math.pi / 8, 1, 1e-8), importer.t
    got = importer.values(["block.x", "states.work", "der(states.work)"])
    check_close(got, {"block.x": 0, "states.work": -8, "der(states.work)": 0}, 1e-6)


def a_scene_whose_events_have_no_indicators_is_refused_by_name():
    for version in (2, 3):
        fmu = fmu_of("couplings/block_over_pulley.yaml", version)
        assert fmu.xml.find("ModelExchange") is None
        instance = fmu.start(exchange=True)
        assert not instance.pointer and "rope `cord`" in instance.messages[-1][2], instance.messages


def calls_of_the_other_interface_are_refused():
    for exchange, name in ((True, "EnterStepMode"), (False, "EnterContinuousTimeMode")):
        instance = fmu_of(BY_INPUT, 3).open(exchange=exchange, events=True)
        assert instance.call(name) == ERROR and instance.messages
        instance.free()
    instance = fmu_of(BY_INPUT, 3).open(exchange=True)
    assert instance.call("GetFMUState", c.byref(c.c_void_p())) == ERROR
    instance.free()


CLAIMS = [a_motion_without_events_is_integrated, errors_fall_with_the_fourth_power_of_the_step_past_events,
          a_ball_bounces_and_comes_to_rest, mechanisms_stay_closed, ropes_bodies_that_strike_and_switches_in_time,
          a_mechanism_at_rest_asks_for_no_events,
          an_input_changes_within_steps, an_input_jumps_in_event_mode,
          a_scene_of_more_than_500_numbers_has_inputs,
          an_event_of_the_file_ends_it_and_parameters_can_be_set,
          a_scene_whose_events_have_no_indicators_is_refused_by_name, calls_of_the_other_interface_are_refused]

sys.exit(run_claims(CLAIMS))
