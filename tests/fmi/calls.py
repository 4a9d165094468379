#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: calls.py [SEEDS]: FMUs under every call that the standard allows, and those that it does not: states saved and
restored, many instances at once. Prints TAP."""
import ctypes as c
import random
import subprocess
import sys
import threading

from fmu import ERROR, OK
from claims_of_fmus import STICKS, check_close, fmu_of, refused, run_claims

SEEDS = int(sys.argv[1]) if sys.argv[1:] else 12
OSCILLATOR = "forcing/pushed_oscillator.yaml"

MODELS = [STICKS, "couplings/rope_pendulum.yaml", "contact/bouncing_ball.yaml", OSCILLATOR]


# ---- saved states

def saved_states_lead_to_the_same_bits():
    for model in MODELS:
        for version in (2, 3):
            fmu = fmu_of(model, version)
            instance, other = fmu.open(), fmu.open()
            saved, seen = [], {}
            for i in range(1, 9):
                if i == 4 and "push" in fmu.inputs:
                    assert instance.set({"push": 7}) == OK
                assert instance.go_to(0.11 * i)[0] == OK, instance.messages
                saved.append(instance.save())
                seen[instance.t] = instance.get()
            for k in (7, 2, 5, 0, 3):
                data = instance.serialize(saved[k])
                for one, state in ((instance, saved[k]), (other, other.deserialize(data))):
                    assert one.restore(state) == OK and one.get() == seen[one.t], (model, k)
                    if k == 3:
                        continue
                    for i in range(k + 1, 8):
                        if i == 3 and "push" in fmu.inputs:
                            assert one.set({"push": 7}) == OK
                        assert one.go_to(0.11 * (i + 1))[0] == OK
                        assert one.get() == seen[one.t], (model, k, i)
                    if one is other:
                        assert one.forget(state) == OK
            for state in saved:
                assert instance.forget(state) == OK
            instance.free()
            other.free()


def a_state_brings_an_instance_back_from_anywhere():
    for version in (2, 3):
        fmu = fmu_of(OSCILLATOR, version)
        instance = fmu.start()
        fresh = instance.save()
        assert instance.initialize() == OK
        begun = instance.save()
        assert instance.set({"push": 4, "m": 3}) == OK and instance.begin() == OK and instance.go_to(1)[0] == OK
        there, values = instance.save(), instance.get()
        assert instance.call("Terminate") == OK
        assert instance.restore(there) == OK and instance.go_to(1.5)[0] == OK
        assert instance.restore(fresh) == OK and instance.initialize() == OK and instance.get(["m"]) == {"m": 2}
        assert instance.restore(begun) == OK and instance.begin() == OK and instance.get(["push"]) == {"push": 5}
        assert instance.call("Reset") == OK and instance.restore(there) == OK and instance.get() == values
        assert instance.step(-1)[0] == ERROR and instance.restore(there) == OK and instance.get() == values
        # An instance of the importer's that is used again for the next state.
        kept = there[0].value
        assert instance.call("Get" + instance.state_name, c.byref(there[0])) == OK and there[0].value
        assert kept and instance.restore(there) == OK and instance.get() == values
        for saved in (fresh, begun, there):
            assert instance.forget(saved) == OK
        instance.free()


def bytes_that_are_no_state_are_refused():
    for version in (2, 3):
        fmu, foreign = fmu_of(OSCILLATOR, version), fmu_of(STICKS, version).open()
        instance = fmu.open()
        assert instance.go_to(0.5)[0] == OK
        saved, values = instance.save(), instance.get()
        data, t = instance.serialize(saved)
        dice = random.Random(version)
        for wrong in (b"", data[:-1], data + b"\0", data[:20], b"x" + data[1:], bytes(len(data))):
            assert instance.deserialize((wrong, t)) is None
        for _ in range(300):
            spoilt = bytearray(data)
            for _ in range(dice.randint(1, 9)):
                spoilt[dice.randrange(len(spoilt))] = dice.randrange(256)
            if bytes(spoilt) != data:
                assert instance.deserialize((bytes(spoilt), t)) is None
        state = foreign.deserialize((data, t))
        with refused(foreign, "another FMU"):
            assert foreign.restore(state) == ERROR
        foreign.forget(state)
        foreign.free()
        assert instance.restore(saved) == OK and instance.get() == values
        instance.forget(saved)
        instance.free()


# ---- the state machine

def sequences(fmu, seed, events):
    """Random calls among those that are allowed; at the end the same motion without them."""
    dice = random.Random(seed)
    instance = fmu.start(events=events, early=events and dice.random() < 0.7)
    phase, history, saved, landed = "instantiated", [], [], set()
    settable = {"instantiated": fmu.parameters + fmu.inputs, "initialization": fmu.parameters + fmu.inputs,
                "step": fmu.inputs, "event": fmu.inputs}
    for _ in range(60):
        moves = ["save", "serialize", "logging"] + (["restore", "forget"] if saved else [])
        moves += {"instantiated": ["initialize"] * 3, "initialization": ["begin"] * 3,
                  "step": ["step"] * 9 + (["enter event"] * 2 if events else []),
                  "event": ["update", "enter step", "enter step"], "terminated": ["reset"]}[phase]
        moves += ["set"] if phase in settable else []
        moves += ["derivative"] if phase != "instantiated" and fmu.has_derivatives else []
        moves += ["terminate"] * (dice.random() < 0.1) if phase in ("step", "event") else []
        move = dice.choice(moves)
        status = OK
        if move == "save":
            saved.append((instance.save(), phase, list(history)))
        elif move == "serialize":
            state = instance.save()
            again = instance.deserialize(instance.serialize(state))
            assert instance.forget(state) == OK and again
            saved.append((again, phase, list(history)))
        elif move == "restore":
            state, phase, before = dice.choice(saved)
            history = list(before)
            status = instance.restore(state)
        elif move == "forget":
            status = instance.forget(saved.pop(dice.randrange(len(saved)))[0])
        elif move == "logging":
            names = [b"logEvents"] if dice.random() < 0.5 else []
            array = (c.c_char_p * 1)(*names) if names else None
            status = instance.call("SetDebugLogging", c.c_int(1) if fmu.version == 2 else c.c_bool(True),
                                   c.c_size_t(len(names)), array)
        elif move == "initialize":
            status, phase = instance.initialize(), "initialization"
        elif move == "begin":
            status, phase = instance.begin(), "event" if events else "step"
        elif move == "set":
            name = dice.choice(settable[phase])
            value = float(fmu.variables[name].start) * dice.uniform(0.8, 1.3)
            history.append((instance.t if phase in ("step", "event") else 0.0, name, value))
            status = instance.set({name: value})
        elif move == "step":
            status, event, terminate, _ = instance.step(dice.choice([0.003, 0.05, 0.21, 0.4]))
            assert not terminate
            landed |= {instance.t} if event else set()
            if event and dice.random() < 0.9:
                assert instance.call("EnterEventMode") == OK
                phase = "event"
        elif move == "enter event":
            status, phase = instance.call("EnterEventMode"), "event"
        elif move == "update":
            status = instance.update()[0]
        elif move == "enter step":
            status, phase = instance.call("EnterStepMode"), "step"
        elif move == "terminate":
            status, phase = instance.call("Terminate"), "terminated"
        elif move == "reset":
            status, phase, history = instance.call("Reset"), "instantiated", []
        elif move == "derivative":
            found = instance.derivative(fmu.outputs, fmu.inputs, [1.0] * len(fmu.inputs))
            status = OK if isinstance(found, list) else found
        assert status == OK, (seed, move, phase, instance.messages[-3:])
        if phase in ("step", "event") and dice.random() < 0.3:
            check_history(fmu, instance, history, instance.t in landed, (seed, move))
    for state, _, _ in saved:
        instance.forget(state)
    instance.free()


def check_history(fmu, instance, history, at_event, what):
    """What an instance is that has been given the same values at the same times, and nothing else. Its events may be a
    rounding later, so where one happens the accelerations may be those before it."""
    plain = fmu.start()
    for t, name, value in history:
        if t == 0 and plain.t == 0 and name in fmu.parameters:
            assert plain.set({name: value}) == OK
    assert plain.initialize() == OK
    assert plain.begin() == OK
    for t, name, value in history:
        if plain.t < t:
            assert plain.go_to(t)[0] == OK
        if name in fmu.inputs:
            assert plain.set({name: value}) == OK
    if plain.t < instance.t:
        assert plain.go_to(instance.t)[0] == OK
    got = instance.get()
    assert isinstance(got, dict), instance.messages
    # Calls between may have made the integration begin anew.
    want = {name: value for name, value in plain.get().items() if not (at_event and name.endswith("_dot"))}
    check_close(got, want, 1e-7, what)
    plain.free()


def every_sequence_that_is_allowed_is_gone_through():
    for seed in range(SEEDS):
        for model in (STICKS, OSCILLATOR):
            sequences(fmu_of(model, 3), seed, seed % 3 > 0)
            sequences(fmu_of(model, 2), seed, False)


def wanted(instance, phase):
    """An instance in this state."""
    if phase == "instantiated":
        return instance
    assert instance.initialize() == OK
    if phase == "initialization":
        return instance
    assert instance.begin() == OK
    if phase == "step" and instance.fmu.version == 3:
        assert instance.call("EnterStepMode") == OK
    if phase == "terminated":
        assert instance.call("Terminate") == OK
    return instance


ANY = {"instantiated", "initialization", "event", "step", "terminated"}
CALLS = {
    "EnterInitializationMode": (lambda one: one.initialize(), {"instantiated"}),
    "ExitInitializationMode": (lambda one: one.begin(), {"initialization"}),
    "EnterEventMode": (lambda one: one.call("EnterEventMode"), {"step"}),
    "EnterStepMode": (lambda one: one.call("EnterStepMode"), {"event"}),
    "UpdateDiscreteStates": (lambda one: one.update()[0], {"event"}),
    "DoStep": (lambda one: one.step(0.1)[0], {"step"}),
    "Terminate": (lambda one: one.call("Terminate"), {"step", "event"}),
    "Reset": (lambda one: one.call("Reset"), ANY),
    "SetDebugLogging": (lambda one: one.call("SetDebugLogging", c.c_int(1), c.c_size_t(0), None), ANY),
    "get": (lambda one: OK if isinstance(one.get(), dict) else ERROR, ANY),
    "set a parameter": (lambda one: one.set({"m": 3}), {"instantiated", "initialization"}),
    "set an input": (lambda one: one.set({"push": 3}), ANY - {"terminated"}),
    "set an output": (lambda one: one.set({"block.x": 3}), set()),
    "derivative": (lambda one: OK if isinstance(one.derivative(["block.v_dot"], ["push"], [1.0]), list) else ERROR,
                   ANY - {"instantiated"}),
    "save": (lambda one: one.forget(one.save()), ANY),
}
ONLY_3 = {"EnterEventMode", "EnterStepMode", "UpdateDiscreteStates"}


def what_a_state_does_not_allow_is_refused_and_ends_it():
    for version in (2, 3):
        fmu = fmu_of(OSCILLATOR, version)
        for phase in sorted(ANY - ({"event"} if version == 2 else set())):
            for name, (call, allowed) in CALLS.items():
                if version == 2 and name in ONLY_3:
                    continue
                instance = wanted(fmu.start(events=True), phase)
                if version == 2 and name == "EnterInitializationMode" and phase != "instantiated":
                    call = lambda one: one.call("EnterInitializationMode")
                if phase in allowed:
                    assert call(instance) == OK, (version, phase, name, instance.messages)
                else:
                    with refused(instance):
                        assert call(instance) == ERROR, (version, phase, name)
                    assert instance.step(0.1)[0] == ERROR
                assert instance.call("Reset") == OK and instance.initialize() == OK
                assert instance.get(["m", "push"]) == {"m": 2, "push": 5}
                instance.free()


def arguments_that_make_no_sense_are_refused():
    nan, infinity = float("nan"), float("inf")
    for version in (2, 3):
        fmu = fmu_of(OSCILLATOR, version)
        none = (c.c_uint32 * 1)(99)
        number = (c.c_double * 1)(1)
        calls = [lambda one: one.step(nan)[0], lambda one: one.step(0.0)[0], lambda one: one.step(-0.1)[0],
                 lambda one: one.step(infinity)[0], lambda one: one.step(0.1, t=0.7)[0],
                 lambda one: one.step(0.1, t=nan)[0],
                 lambda one: one.get_array(none, number), lambda one: one.set_array(none, number),
                 lambda one: one.set({"push": nan}), lambda one: one.set({"push": infinity}),
                 lambda one: one.set({"time": 3}),
                 lambda one: one.get_array(fmu.references(["push"]), (c.c_double * 0).from_address(0)),
                 lambda one: one.set_array(fmu.references(["push"]), (c.c_double * 0).from_address(0)),
                 lambda one: one.derivative(["push"], ["push"], [1.0]),
                 lambda one: one.derivative(["block.v_dot"], ["m"], [1.0]),
                 lambda one: one.call("Get" + one.state_name, None),
                 lambda one: one.call("Set" + one.state_name, None),
                 lambda one: one.call("SetDebugLogging", c.c_int(1), c.c_size_t(1), (c.c_char_p * 1)(b"nonsense"))]
        for number_of, call in enumerate(calls):
            instance = wanted(fmu.start(events=version == 3), "step")
            with refused(instance):
                assert call(instance) == ERROR, (version, number_of)
            instance.free()
        for arguments in ((None, nan), (None, infinity), (None, 5.0, 1.0), (nan, 0.0), (-1.0, 0.0), (2.0, 0.0),
                          (None, 0.0, infinity)):
            instance = fmu.start()
            with refused(instance):
                assert instance.initialize(*arguments) == ERROR, arguments
            instance.free()


def what_cannot_be_made_is_not_and_says_why():
    for version in (2, 3):
        fmu = fmu_of(OSCILLATOR, version)
        nowhere = "/nowhere/resources" if version == 3 else "file:///nowhere/resources"
        for arguments, word in (({"token": "{other}"}, "token"), ({"resources": nowhere}, "nowhere"),
                                ({"resources": ""}, "")):
            instance = fmu.start(**arguments)
            assert not instance.pointer
            assert any(status == 3 and word in text for status, _, text in instance.messages), (arguments, instance.messages)
            assert not fmu.start(logger=False, **arguments).pointer
            quiet = fmu.start(logging=False, **arguments)
            assert not quiet.pointer and not quiet.messages
        quiet = wanted(fmu.start(logging=False, events=True), "step")
        assert quiet.step(-1)[0] == ERROR and not quiet.messages
        quiet.free()
        instance = wanted(fmu.start(logger=False, events=True), "step")
        assert instance.step(-1)[0] == ERROR
        instance.free()
        instance.free()  # of NULL


def functions_without_an_instance_answer_an_error():
    for version in (2, 3):
        fmu = fmu_of(OSCILLATOR, version)
        names = subprocess.run(["nm", "-D", "--defined-only", fmu.binary], stdout=subprocess.PIPE, check=True, text=True)
        count = 0
        for name in (line.split()[2] for line in names.stdout.splitlines()):
            if not name.startswith(f"fmi{version}") or "GetVersion" in name or "TypesPlatform" in name:
                continue
            if "Instantiate" in name:
                continue
            function = getattr(fmu.library, name)
            function.restype = None if "FreeInstance" in name else c.c_int
            answer = function(None, *[c.c_void_p(0)] * 9)
            assert answer in ((None,) if "FreeInstance" in name else (ERROR,)), name
            count += 1
        assert count > 30, count


# ---- many at once

def instances_do_not_know_of_each_other():
    def drive(fmu, push, result, k):
        instance = fmu.open(name=f"number {k}")
        for i in range(1, 30):
            if "push" in fmu.inputs and i % 5 == 0:
                instance.set({"push": push * i})
            instance.go_to(0.03 * i)
        result[k] = instance.get()
        instance.free()

    jobs = [(fmu_of(model, version), push) for model in MODELS for version in (2, 3) for push in (1.0, 2.5)]
    alone, together = {}, {}
    for k, (fmu, push) in enumerate(jobs):
        drive(fmu, push, alone, k)
    threads = [threading.Thread(target=drive, args=(fmu, push, together, k)) for k, (fmu, push) in enumerate(jobs)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert alone == together and len(alone) == len(jobs)
    between = [fmu.open() for fmu, _ in jobs[::2]]
    for i in range(1, 15):
        for one in between:
            assert one.go_to(0.05 * i)[0] == OK
    for one, (fmu, _) in zip(between, jobs[::2]):
        plain = fmu.open()
        assert plain.go_to(one.t)[0] == OK and plain.get() == one.get()
        plain.free()
        one.free()


CLAIMS = [saved_states_lead_to_the_same_bits, a_state_brings_an_instance_back_from_anywhere,
          bytes_that_are_no_state_are_refused, every_sequence_that_is_allowed_is_gone_through,
          what_a_state_does_not_allow_is_refused_and_ends_it, arguments_that_make_no_sense_are_refused,
          what_cannot_be_made_is_not_and_says_why, functions_without_an_instance_answer_an_error,
          instances_do_not_know_of_each_other]

sys.exit(run_claims(CLAIMS))
