#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: runs.py [all]: FMUs of models, driven by an importer, move as fbd-run says they do. Prints TAP."""
import math
import random
import sys

from fmu import DISCARD, ERROR, OK
from claims_of_fmus import MODELS, check_close, close, fmu_of, refused, run_claims, run_csv, run_json

THIN = ["contact/bouncing_ball.yaml", "contact/woodpecker.yaml", "couplings/block_over_pulley.yaml",
        "couplings/four_bar.yaml", "couplings/rope_pendulum.yaml", "couplings/rolling_on_incline.yaml",
        "couplings/driven_slider_crank.yaml", "data/measured_push.yaml", "energy/cubic_spring_force.yaml",
        "forcing/square_wave_with_friction.yaml", "hard/stick_slip_belt.yaml", "kinetics/incline.yaml",
        "plane/spring_pendulum.yaml", "rotation/bearing_friction.yaml", "trees/double_pendulum.yaml",
        "trees/chain_of_ten_rods.yaml", "vibration/damped_oscillator.yaml"]
# Runs that fail, as they should.
FAILING = {"hard/not_a_number_beyond.yaml", "hard/singular_reached.yaml"}


def gallery():
    if sys.argv[1:] != ["all"]:
        return THIN
    return sorted(str(path.relative_to(MODELS)) for path in MODELS.rglob("*.yaml")
                  if str(path.relative_to(MODELS)) not in FAILING)


def compare(model, version, pieces):
    """At rows of the CSV, by communication steps from row to row, of which each has some pieces."""
    fmu = fmu_of(model, version)
    until = float(fmu.xml.find("DefaultExperiment").get("stopTime"))
    rows = run_csv(model, "--every", until / 20)
    names = [name for name in rows[0] if name in fmu.variables]
    assert len(names) == len(rows[0]) - 1, (model, list(rows[0]))
    size = {name: max(abs(row[name]) for row in rows) + 1e-300 for name in names}
    instance = fmu.open()
    for row in rows:
        for k in range(1, pieces + 1):
            target = row["t"] if k == pieces else instance.t + (row["t"] - instance.t) * k / pieces
            if instance.t < target:
                answer = instance.go_to(target)
                assert answer[0] == (DISCARD if version == 2 and answer[2] else OK), (model, instance.messages)
        got = instance.get(names)
        for name in names:
            assert close(got[name], row[name], size[name], 1e-9), (model, row["t"], name, got[name], row[name])
    instance.free()


def they_move_as_fbd_run_says():
    for model in gallery():
        compare(model, 3, 1)


def they_do_so_by_FMI_2():
    for model in gallery():
        compare(model, 2, 1)


def communication_points_change_no_bit():
    for model in THIN[::2]:
        fmu = fmu_of(model, 3)
        until = 0.6 * float(fmu.xml.find("DefaultExperiment").get("stopTime"))
        dice = random.Random(model)
        ends = []
        for _ in range(3):
            instance = fmu.open()
            times = sorted(dice.uniform(0, until) for _ in range(dice.choice([0, 3, 40]))) + [until]
            for t in times:
                assert instance.go_to(t)[0] == OK, instance.messages
            ends.append(instance.get())
            instance.free()
        assert ends[0] == ends[1] == ends[2], (model, ends)


# ---- works and energies

def is_energy(name):
    return name.endswith(".work") or name.startswith("energy.")


def works_of(model, version, *settings):
    """An FMU with all of them as outputs, and their names."""
    names = [name for name in run_csv(model, "--ledger", "--until", "0 s", *settings)[0] if is_energy(name)]
    return fmu_of(model, version, "--fmu-outputs", ",".join(names), *settings), names


def works_and_energies_are_those_of_the_ledger():
    for number, model in enumerate(gallery() if len(gallery()) > len(THIN) else THIN[::3]):
        fmu, names = works_of(model, 2 + number % 2)
        assert fmu.xml.find("ModelExchange") is None
        until = float(fmu.xml.find("DefaultExperiment").get("stopTime"))
        rows = run_csv(model, "--ledger", "--every", until / 10)
        size = max([abs(row[name]) for row in rows for name in names])
        instance = fmu.open()
        for row in rows:
            if row["t"] > 0:
                instance.go_to(row["t"])
            got = instance.get(names)
            for name in names:
                assert close(got[name], row[name], size, 1e-9), (model, row["t"], name, got[name], row[name])
        instance.free()


# ---- inputs

PUSHED = """fbd: 1
parameters: {m: 1.5 kg, k: 40 N/m}
inputs: {push: {value: 2 N, description: "to <the> right & back"}, mu: 0.3}
bodies:
  block:
    mass: m
    motion: slide
    forces: [gravity, normal, friction: {static: 0.4, kinetic: mu}, spring: {stiffness: k}, applied: {value: push}]
simulate: {until: 3 s}
"""

# The same, with the input as a table of steps.
STEPPED = """fbd: 1
tables: {push: {points: [[0, 2], [0.4, 20], [0.9, -25], [1.3, -25], [1.9, 9], [2.2, 40], [5, 40]], interpolation: step}}
parameters: {m: 1.5 kg, k: 40 N/m}
bodies:
  block:
    mass: m
    motion: slide
    forces: [gravity, normal, friction: {static: 0.4, kinetic: 0.3}, spring: {stiffness: k}, applied: {value: "push(t/1[s])*1[N]"}]
simulate: {until: 3 s}
"""
STEPS = [(0, 2), (0.4, 20), (0.9, -25), (1.3, -25), (1.9, 9), (2.2, 40), (3, 40)]


def drive_steps(instance, in_event_mode):
    for (t, push), (until, _) in zip(STEPS, STEPS[1:]):
        if in_event_mode and t > 0:
            assert instance.call("EnterEventMode") == OK
        assert instance.set({"push": push}) == OK, instance.messages
        if in_event_mode:
            assert instance.update()[0] == OK
            assert instance.call("EnterStepMode") == OK
        while instance.t < until:
            answer = instance.go_to(until)
            assert answer[0] == OK, instance.messages
            if answer[1]:
                instance.handle_event()
    return instance.get()


def inputs_act_as_steps_of_a_table_do():
    want = run_json(STEPPED)["final"]["block"]
    for version in (2, 3):
        instance = fmu_of(PUSHED, version).open()
        got = drive_steps(instance, False)
        check_close(got, {"block.x": want["x"], "block.v": want["v"]}, 1e-9, version)
        instance.free()
    instance = fmu_of(PUSHED, 3).open(events=True, early=True)
    got = drive_steps(instance, True)
    check_close(got, {"block.x": want["x"], "block.v": want["v"]}, 1e-9, "by events")
    instance.free()


def swing(F, h, x, v, m=2.0, k=50.0, c=3.0):
    """x'' = (F - k x - c v)/m for h."""
    decay = c / (2 * m)
    w = math.sqrt(k / m - decay * decay)
    A, B = x - F / k, (v + decay * (x - F / k)) / w
    e = math.exp(-decay * h)
    C, S = math.cos(w * h), math.sin(w * h)
    return F / k + e * (A * C + B * S), e * ((w * B - decay * A) * C - (w * A + decay * B) * S)


def works_go_on_past_changes_of_inputs_and_saved_states():
    """The work of a constant force is that of its potential, that of one that varies an integral."""
    want = run_csv(STEPPED, "--ledger", "--every", 3)[-1]
    for version in (2, 3):
        fmu, names = works_of(PUSHED, version)
        instance = fmu.open()
        got = drive_steps(instance, False)
        size = max(abs(want[name]) for name in names)
        for name in set(names) - {"energy.work", "energy.potential"}:
            assert close(got[name], want[name], size, 1e-8), (name, got[name], want[name])
        total = sum(got[name] for name in names if name.startswith("block."))
        assert close(got["energy.kinetic"], total, size, 1e-8), (got, total)
        saved = instance.save()
        serialized = instance.serialize(saved)
        other = fmu.open()
        there = other.deserialize(serialized)
        assert other.restore(there) == OK and other.get() == got
        assert other.set({"push": -3}) == instance.set({"push": -3}) == OK
        assert other.go_to(3.5)[0] == instance.go_to(3.5)[0] == OK
        assert other.get() == instance.get()
        other.forget(there)
        instance.forget(saved)
        instance.free()
        other.free()


def a_control_of_many_steps_is_that_of_the_closed_form():
    for version in (2, 3):
        instance = fmu_of("forcing/pushed_oscillator.yaml", version).open(parameters={"m": 2.5})
        x = v = 0.0
        for i in range(1, 201):
            got = instance.get()
            push = 30 - 90 * got["block.x"] - 4 * got["block.v"]  # what a control does
            assert instance.set({"push": push}) == OK
            h = i * 0.02 - instance.t
            assert instance.go_to(i * 0.02)[0] == OK, instance.messages
            x, v = swing(push, h, x, v, m=2.5)
            # 200 starts anew, each to some roundings.
            check_close(instance.get(), {"block.x": x, "block.v": v}, 1e-11, instance.t)
        instance.free()


def an_acceleration_follows_an_input_at_once():
    instance = fmu_of("forcing/pushed_oscillator.yaml", 3).open(events=True)
    for push in (5, 8, -2):
        assert instance.set({"push": push}) == OK
        check_close(instance.get(), {"block.v_dot": push / 2, "block.x": 0}, 1e-15)
    instance.free()


# ---- events

def events_are_those_of_fbd_run():
    for model in ("contact/bouncing_ball.yaml", "hard/stick_slip_belt.yaml", "kinetics/incline.yaml", STEPPED):
        fmu = fmu_of(model, 3)
        until = float(fmu.xml.find("DefaultExperiment").get("stopTime"))
        want = sorted({event["t"] for event in run_json(model)["events"] if event["t"] > 0})
        for step in (until, until / 7):
            instance = fmu.open(events=True, early=True, stop=until)
            got, number = [], 1
            if instance.call("EnterStepMode") != OK:
                raise AssertionError(instance.messages)
            while instance.t < until:
                target = min(number * step, until)
                status, event, terminate, early = instance.go_to(target)
                assert status == OK and not terminate, instance.messages
                assert early == (instance.t < target) and (event or instance.t == target)
                if event:
                    got.append(instance.t)
                    assert instance.handle_event()[1:3] == (False, False)
                number += instance.t >= target
            assert got == want, (model, step, got[:5], want[:5], len(got), len(want))
            instance.free()


def without_early_return_a_step_goes_all_the_way():
    for flags in ({}, {"events": True}, {"early": True}):
        instance = fmu_of("contact/bouncing_ball.yaml", 3).open(**flags)
        if "events" in flags:
            assert instance.call("EnterStepMode") == OK
        assert instance.go_to(1.5) == (OK, False, False, False) and instance.t == 1.5
        instance.free()


def an_event_of_the_file_that_stops_ends_it():
    model = "kinetics/drop_us_from_platform.yaml"
    final = run_json(model)["final"]
    instance = fmu_of(model, 3).open(early=True)
    assert instance.go_to(2) == (OK, False, True, True)
    assert instance.t == final["t"]
    check_close(instance.get(["object.v"]), {"object.v": final["object"]["v"]}, 1e-12)
    saved = instance.save()
    for _ in range(2):  # a state that is restored has ended, too
        with refused(instance, "DoStep", "ended"):
            assert instance.step(0.1)[0] == ERROR
        assert instance.restore(saved) == OK
    instance.forget(saved)
    instance.free()
    instance = fmu_of(model, 2).open()
    assert instance.go_to(2) == (DISCARD, False, True, False) and instance.t == final["t"]
    assert instance.call("Terminate") == OK
    check_close(instance.get(["object.v"]), {"object.v": final["object"]["v"]}, 1e-12)
    instance.free()


def a_run_that_fails_says_why_and_can_be_taken_back():
    for version in (2, 3):
        instance = fmu_of("hard/singular_reached.yaml", version).open()
        assert instance.go_to(0.5)[0] == OK
        saved, before = instance.save(), instance.get()
        with refused(instance, "pull", "infinite"):
            assert instance.go_to(0.9)[0] == ERROR
        assert instance.restore(saved) == OK and instance.get() == before
        assert instance.go_to(0.6)[0] == OK
        instance.forget(saved)
        instance.free()


def a_run_that_loses_energy_ends():
    scene = (MODELS.parent / "tests/faults/energy/potential_shorter_than_steps.yaml").read_text(encoding="utf-8")
    for version in (2, 3):
        instance = fmu_of(scene, version).open()
        with refused(instance, "the residual of its energy is -1,"):
            assert instance.go_to(1)[0] == ERROR
        instance.free()


# ---- times, tolerances

def beyond_the_end_of_the_file_it_goes_on():
    want = run_csv("rotation/damped_pendulum.yaml", "--until", 47, "--every", 47)[-1]
    for version in (2, 3):
        instance = fmu_of("rotation/damped_pendulum.yaml", version).open()
        while instance.t < 47:
            assert instance.go_to(min(47, instance.t + 2.9))[0] == OK, instance.messages
        check_close(instance.get(["pendulum.theta", "pendulum.omega"]),
                    {name: want[name] for name in ("pendulum.theta", "pendulum.omega")}, 1e-8)
        instance.free()


LATE = """fbd: 1
parameters: {F: 3 N, m: 2 kg}
bodies: {b: {mass: m, motion: slide, forces: [applied: {value: F*sin(2*t)}]}}
simulate: {until: 4 s}
"""


def a_start_time_is_when_the_motion_begins():
    for version in (2, 3):
        for start, end in ((0.7, 2), (3, 9), (-5, 1), (0, 3)):
            instance = fmu_of(LATE, version).open(start=start, stop=end)
            assert instance.get(["time", "b.x"]) == {"time": start, "b.x": 0}
            assert instance.go_to(end)[0] == OK, instance.messages
            v = 3 / 4 * (math.cos(2 * start) - math.cos(2 * end))
            x = 3 / 4 * ((end - start) * math.cos(2 * start) - (math.sin(2 * end) - math.sin(2 * start)) / 2)
            check_close(instance.get(), {"b.v": v, "b.x": x}, 1e-9, (start, end))
            with refused(instance, "stop time"):
                assert instance.step(0.1)[0] == ERROR
            instance.free()


def a_tolerance_may_be_tighter_than_that_of_the_file():
    fmu = fmu_of("rotation/simple_pendulum.yaml", 3, "--tolerance", "1e-5")
    exact = run_csv("rotation/simple_pendulum.yaml", "--tolerance", "1e-13", "--until", 4, "--every", 4)[-1]
    errors = []
    for tolerance in (None, 1e-2, 1e-9):
        instance = fmu.open(tolerance=tolerance)
        assert instance.go_to(4)[0] == OK
        errors.append(abs(instance.get()["pendulum.theta"] - exact["pendulum.theta"]))
        instance.free()
    assert errors[0] == errors[1] > 100 * errors[2], errors


# ---- parameters

def parameters_are_those_of_set():
    model = "trees/double_pendulum.yaml"
    for version in (2, 3):
        plain = fmu_of(model, version)
        names = plain.parameters
        assert names
        values = {name: 1.1 * float(plain.variables[name].start) for name in names}
        settings = [part for name, value in values.items() for part in ("--set", f"{name}={value!r}")]
        want = run_csv(model, "--until", 1, "--every", 1, *settings)[-1]
        instance = plain.open(parameters=values)
        assert instance.go_to(1)[0] == OK
        got = instance.get()
        other = fmu_of(model, version, *settings).open()
        assert other.get(names) == values
        assert other.go_to(1)[0] == OK and other.get() == got
        check_close(got, {name: value for name, value in want.items() if name in got}, 1e-9)
        instance.free()
        other.free()


def what_is_defined_by_others_follows_them():
    text = ("fbd: 1\nparameters: {m: 2 kg, w: m*g, h: 2*w}\nbodies: {b: {mass: m, motion: slide, forces: [applied: {value: h}]}}\n"
            "simulate: {until: 1 s}\n")
    for version in (2, 3):
        fmu = fmu_of(text, version)
        assert [fmu.variables[name].causality for name in "mwh"] == ["parameter"] + 2 * ["calculatedParameter"]
        instance = fmu.open(parameters={"m": 5})
        check_close(instance.get(["w", "h", "b.v_dot"]), {"w": 49.05, "h": 98.1, "b.v_dot": 19.62}, 1e-14)
        instance.free()


def a_parameter_that_cannot_be_is_refused_by_its_reason():
    for version in (2, 3):
        instance = fmu_of("forcing/pushed_oscillator.yaml", version).start()
        assert instance.set({"m": -1}) == OK and instance.initialize() == OK
        with refused(instance, "model.yaml", "mass"):
            assert instance.begin() == ERROR
        assert instance.call("Reset") == OK and instance.initialize() == OK and instance.begin() == OK
        assert instance.go_to(1)[0] == OK
        with refused(instance, "fixed"):
            assert instance.set({"m": 3}) == ERROR
        instance.free()


CLAIMS = [they_move_as_fbd_run_says, they_do_so_by_FMI_2, communication_points_change_no_bit,
          works_and_energies_are_those_of_the_ledger, works_go_on_past_changes_of_inputs_and_saved_states,
          inputs_act_as_steps_of_a_table_do, a_control_of_many_steps_is_that_of_the_closed_form,
          an_acceleration_follows_an_input_at_once, events_are_those_of_fbd_run,
          without_early_return_a_step_goes_all_the_way, an_event_of_the_file_that_stops_ends_it,
          a_run_that_fails_says_why_and_can_be_taken_back, a_run_that_loses_energy_ends,
          beyond_the_end_of_the_file_it_goes_on,
          a_start_time_is_when_the_motion_begins, a_tolerance_may_be_tighter_than_that_of_the_file,
          parameters_are_those_of_set, what_is_defined_by_others_follows_them,
          a_parameter_that_cannot_be_is_refused_by_its_reason]

sys.exit(run_claims(CLAIMS))
