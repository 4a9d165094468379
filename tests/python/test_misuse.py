# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever is passed, Python goes on: what cannot be meant raises, and nothing crashes."""
import inspect
import math
import time
import warnings

import fbd
import numpy as np
import pytest
from conftest import MODELS, PENDULUM

NONSENSE = [None, True, -1, 0, 2**31, 2**64, 10**400, -1e308, math.nan, math.inf, -math.inf, 1j, "", "\0", "a\0b",
            "é", "\ud800", "t", "x" * 5000, "nan", "1e999 deg", b"x", b"", object(), [], [None], [math.nan], ["\0"], {}, {"": 1}, {1: 2},
            (1, 2), np.array([1.0, 2.0]), np.nan, range(3), lambda: None, int, Exception(), ...]

# What says what is wrong.
SAID = (TypeError, ValueError, KeyError, OverflowError, OSError, fbd.Error)


def end_at_once(progress):
    return True


def attempts(function, first=()):
    """Nonsense for each argument in turn, alone and by its name."""
    parameters = list(inspect.signature(function).parameters.values())
    for value in NONSENSE:
        yield first and (value,) or (value,), {}
        for parameter in parameters:
            if parameter.kind in (parameter.KEYWORD_ONLY, parameter.POSITIONAL_OR_KEYWORD):
                yield first, {parameter.name: value}
            if parameter.kind == parameter.VAR_KEYWORD:
                yield first, {"nothing": value}
                yield first, {"theta0": value}


def endure(function, first=(), **fixed):
    """Only those complaints; how often it was refused, and how often done."""
    refused = done = 0
    for arguments, named in attempts(function, first):
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                function(*arguments, **{**fixed, **named})
            done += 1
        except SAID as error:
            assert str(error) or error.args, (function, arguments, named)
            refused += 1
    return refused, done


def test_models_and_texts():
    for function, first in ((fbd.Model, (PENDULUM,)), (fbd.Model.parse, (PENDULUM.read_text(), "a.yaml")),
                            (fbd.assert_derivation, (PENDULUM,))):
        refused, _ = endure(function, first)
        assert refused > len(NONSENSE)


def test_methods_of_a_model(pendulum):
    for function, first in ((pendulum.inertia, ()), (pendulum.state, ()), (pendulum.equations, ()),
                            (pendulum.linearize, ()), (pendulum.statics, ()), (pendulum.check_hand, ()),
                            (pendulum.explain, ())):
        refused, done = endure(function, first)
        assert refused > 10, function


def test_runs(pendulum):
    refused, done = endure(pendulum.run, progress=end_at_once)
    assert refused > 100


def test_sweeps(pendulum):
    begin = time.monotonic()

    def give_up(*counts):
        nonlocal begin
        if time.monotonic() > begin + 0.2:
            begin = time.monotonic()
            raise KeyError("a sweep without end")

    refused, done = endure(pendulum.sweep, ("theta0=0.1,0.2",), until=0.1, progress=give_up)
    assert refused > 50


def test_studies(pendulum):
    endure(lambda methods=(), quantities=(), until=0.1: pendulum.cost(
        methods=methods, quantities=quantities, until=until if until != -1e308 else 0.1, budget=0.02))


def test_what_a_run_is_asked_for(pendulum):
    run = pendulum.run(error_bars=True)
    for function in (run.__getitem__, run.at, run.work, run.error, run.gnuplot, lambda load: run.work("pendulum", load),
                     lambda load: run.work_error("pendulum", load)):
        refused, _ = endure(function)
        assert refused > 5, function


def test_what_a_state_is_asked_for(pendulum):
    state = pendulum.state()
    for function in (state.__getitem__, lambda value=0: state.__setitem__("theta", value), state.svg,
                     lambda name="t": state.__setitem__(name, 1.0)):
        refused, _ = endure(function)
        assert refused > 10, function
    assert all(map(math.isfinite, state.values()))


def test_objects_cannot_be_made_of_nothing(pendulum):
    for kind in (fbd.Run, fbd.State, fbd.Equations, fbd.Linearization, fbd.Statics, fbd.Cost, fbd.Effects):
        for value in NONSENSE:
            with pytest.raises((TypeError, AttributeError, ValueError)):
                kind(value)
    half = fbd.Model.__new__(fbd.Model)
    with pytest.raises(AttributeError):
        half.run()
    with pytest.raises(AttributeError):
        fbd.Run.__new__(fbd.Run).at(0)


def test_a_file_that_cannot_be_read_is_said(tmp_path):
    for path in (tmp_path, tmp_path / "nowhere.yaml"):
        with pytest.raises(fbd.Error) as caught:
            fbd.Model(path)
        assert caught.value.id == "cannot-read" and caught.value.file == str(path)


def test_parts_outlive_the_whole():
    """What was taken from an object holds what it needs."""
    import gc

    parts = []
    infinite_at_rest = ("constant_power", "flywheel_drive")
    with_statics = [path for path in sorted(MODELS.glob("*/*.yaml")) if path.stem not in infinite_at_rest]
    for path in with_statics[::7]:
        model = fbd.Model(path)
        run = model.run(until=0.01, progress=lambda progress: None)
        parts += [run["t"], run.end, run.events, model.equations(), run.stats]
        cycle = {"model": model, "run": run, "state": run.at(0)}
        cycle["self"] = cycle
        del model, run, cycle
    gc.collect()
    assert all(repr(part) for part in parts)
    assert all(part.statics() for part in parts if isinstance(part, fbd.State) and len(part) == 3)
