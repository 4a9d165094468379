# SPDX-License-Identifier: GPL-3.0-or-later
"""Models: what is in them, what is wrong with them, derivations."""
import copy
import math
import os
import pickle
import subprocess
import warnings
from pathlib import Path

import fbd
import numpy as np
import pytest
from conftest import INCLINE, MODELS, PENDULUM, SOURCE, fbd_run


def test_the_version_is_that_of_the_program():
    assert fbd_run("--version").split()[-1] == fbd.__version__
    assert f"version: '{fbd.__version__}'" in (SOURCE / "meson.build").read_text()


def test_a_model_says_what_is_in_it(pendulum):
    assert pendulum.title == "Simple pendulum"
    assert pendulum.bodies == ("pendulum",)
    assert pendulum.coordinates == (
        fbd.Coordinate("pendulum.theta", "rad", "pendulum.omega", "rad/s", "pendulum"),)
    inertia = pendulum.inertia("pendulum")
    assert inertia.mass == 3 and inertia.G == (0, -1.06)
    assert inertia.I_O == pytest.approx(3 * 1.06**2, rel=1e-15)
    assert pendulum.source == PENDULUM.read_text()
    assert "gravity" in pendulum.explain(method="rk8pd")


def test_parameters_are_texts_with_units_or_numbers():
    degrees, radians = fbd.Model(PENDULUM, theta0="60 deg"), fbd.Model(PENDULUM, theta0=math.pi / 3)
    assert degrees.state()["theta"] == pytest.approx(math.pi / 3, rel=1e-15)
    for value in (0.1 + 0.2, np.float64(1e-5), np.float32(0.1), 2, np.int64(-1), -1.5e-7):
        assert fbd.Model(PENDULUM, theta0=value).state()["pendulum.theta"] == float(value)
    assert radians.state().t == 0


def test_a_text_is_a_model_too(pendulum):
    again = fbd.Model.parse(pendulum.source, "mine.yaml", theta0=1)
    assert again.state()["theta"] == 1
    with pytest.raises(fbd.Error) as caught:
        fbd.Model.parse("fbd: 1\nbodies: {a: {mass: 1 kg, motion: slide, forces: [gravty]}}", "mine.yaml")
    assert (caught.value.file, caught.value.line, caught.value.id) == ("mine.yaml", 2, "unknown-kind")


def test_every_wrong_file_says_what_it_is_expected_to_say(monkeypatch):
    """As tests/bad has it: `# expect: line:column kind id: message`, then how a hint begins."""
    monkeypatch.chdir(SOURCE)
    seen = 0
    for path in sorted(Path("tests/bad").glob("*.yaml")):
        lines = path.read_bytes().decode("utf-8", "replace").splitlines()
        expected = [line.split(None, 4)[2:] for line in lines if line.startswith("# expect: ")]
        if not any(kind == "error" for _, kind, _ in expected):
            continue
        with warnings.catch_warnings(), pytest.raises(fbd.Error) as caught:
            warnings.simplefilter("ignore")
            fbd.Model(path)
        notes = caught.value.notes
        told = [[f"{n.line}:{n.column}", n.severity] for n in notes]
        assert told == [e[:2] for e in expected], path
        hints = [line.removeprefix("# hint: ") for line in lines if line.startswith("# hint: ")]
        assert all(any((n.hint or "").startswith(hint) for n in notes) for hint in hints), path
        error = [n for n in notes if n.severity == "error"][0]
        assert (caught.value.line, caught.value.column, caught.value.hint) == (error.line, error.column, error.hint)
        seen += 1
    assert seen > 150


def test_errors_say_what_the_program_says():
    path = SOURCE / "tests/bad/many_mistakes.yaml"
    said = subprocess.run([os.environ["FBD_RUN"], path], stderr=subprocess.PIPE, check=False).stderr.decode()
    with pytest.raises(fbd.Error) as caught:
        fbd.Model(path)
    assert str(caught.value) + "\n" == said
    assert len(caught.value.notes) > 5


def test_errors_can_be_carried_to_other_processes():
    with pytest.raises(fbd.Error) as caught:
        fbd.Model(PENDULUM, lenth=1, bob=2)
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is fbd.Error and again.notes == caught.value.notes and again.hint == "did you mean `length`?"


def test_warnings_are_of_the_line_that_called():
    text = PENDULUM.read_text().replace("parameters:\n", "parameters:\n  spare: 1 kg\n")
    with pytest.warns(fbd.Warning) as caught:
        fbd.Model.parse(text, "mine.yaml")
    assert caught[0].filename == __file__
    assert caught[0].message.line == text[: text.index("spare")].count("\n") + 1
    assert caught[0].message.notes[0].severity == "warning"
    assert issubclass(fbd.Warning, UserWarning)
    assert "Warning" not in fbd.__all__


def test_derivations_agree_or_say_why_not(tmp_path):
    check = fbd.Model(INCLINE).check_hand(seed=7)
    assert check == 0 and "agrees" in check.text and "seed 7" in check.text
    text = INCLINE.read_text()
    slip = tmp_path / "slip.yaml"
    assert "- m*g*sin(phi)" in text
    slip.write_text(text.replace("- m*g*sin(phi)", "+ m*g*sin(phi)", 1))
    fbd.assert_derivation(INCLINE)
    fbd.assert_derivation(fbd.Model(INCLINE))
    fbd.assert_derivation(str(INCLINE), phi="20 deg")
    with pytest.raises(AssertionError, match="the term `gravity` has the wrong sign"):
        fbd.assert_derivation(slip)
    assert fbd.Model(slip).check_hand() == 1
    with pytest.raises(AssertionError, match="no body carries"):
        fbd.assert_derivation(MODELS / "contact/dominoes.yaml")
    with pytest.raises(fbd.Error):
        fbd.assert_derivation(SOURCE / "tests/bad/mass_is_zero.yaml")


def test_a_copy_of_a_model_is_whole(pendulum):
    for way in (lambda model: pickle.loads(pickle.dumps(model)), copy.deepcopy):
        assert way(pendulum).source == pendulum.source


def test_the_schema_is_json():
    import json

    assert json.loads(fbd.schema())["properties"]["bodies"]
