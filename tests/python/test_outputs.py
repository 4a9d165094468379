# SPDX-License-Identifier: GPL-3.0-or-later
"""Outputs that the programs have too, and copies for other processes."""
import pickle
import zipfile

import fbd
import numpy as np
import pytest
from conftest import MODELS, PENDULUM


def test_times_may_have_a_unit():
    model = fbd.Model(PENDULUM)
    run = model.run(until="2000 ms", every="0.5 s")
    assert run.t_end == 2
    np.testing.assert_array_equal(run.rows, model.run(until=2, every=0.5).rows)
    with pytest.raises(fbd.Error):
        model.run(until="2 m")


def test_models_and_runs_can_be_pickled():
    model = fbd.Model(PENDULUM, theta0="50 deg")
    copy = pickle.loads(pickle.dumps(model))
    assert copy.source == model.source and repr(copy.parameters) == repr(model.parameters)
    run = model.run(until=1, ledger=True)
    again = pickle.loads(pickle.dumps(run))
    np.testing.assert_array_equal(again.rows, run.rows)
    assert again.columns == run.columns and repr(again.events) == repr(run.events)
    with pytest.raises(TypeError):
        pickle.dumps(model.run(until=1e9, every=1e7, progress=lambda progress: True))


def test_a_table_can_be_pickled_and_shown():
    table = fbd.Model(PENDULUM).sweep("theta0=10:50 deg:3", "time(bottom)")
    copy = pickle.loads(pickle.dumps(table))
    assert copy.units == table.units and list(copy["theta0"]) == [10, 30, 50]
    page = table._repr_html_()
    assert page.count("<tr>") == 4 and "<th>theta0 [deg]</th>" in page and "3 runs" in page


def test_a_scene_becomes_a_c_program():
    assert "int main(" in fbd.Model(PENDULUM).emit_c(until="1 s")


def test_a_scene_becomes_an_fmu(tmp_path):
    model = fbd.Model(MODELS / "forcing/pushed_oscillator.yaml")
    try:
        model.fmu(tmp_path / "pushed.fmu", version=2, outputs=["block.spring"])
    except fbd.Error as error:
        assert error.id == "no-fmu"
        pytest.skip(error.message)
    archive = zipfile.ZipFile(tmp_path / "pushed.fmu")
    lines = archive.read("modelDescription.xml").decode().splitlines()
    assert [line for line in lines if 'name="block.spring"' in line and 'causality="output"' in line]
    names = archive.namelist()
    assert "modelDescription.xml" in names and "resources/model.yaml" in names


def test_the_system_is_drawn():
    assert "<svg" in fbd.Model(PENDULUM).state().svg(system=True)


def test_a_beam_is_cut():
    """A rod between a pin and a vertical rod under its weight W: M = W x (L - x)/(2 L)."""
    text = ("fbd: 1\nbodies:\n  beam: {shape: rod, mass: 12 kg, from: [0, 0], to: [2 m, 0], motion: {pivot: {point: left}}, "
            "forces: [gravity]}\ncouplings: [rod: {between: [beam.right, ground.hook]}]\n"
            "ground: {points: {hook: [2 m, 1 m]}}\n")
    section = fbd.Model.parse(text).section("beam", at_rest=True)
    weight = 12 * 9.81
    assert section.length == pytest.approx(2)
    assert section.at(1).M == pytest.approx(weight * 2 / 8, rel=1e-12)
    assert section.at("50 cm").V == pytest.approx(weight / 4, rel=1e-12)
    assert section.extremes["M"][1] == pytest.approx((1, weight / 4), rel=1e-9)
    assert "<svg" in section.svg and "extremes" in section.json()
    with pytest.raises(ValueError):
        section.at(3)
    with pytest.raises(fbd.Error):
        section.at("nowhere")


def test_section_forces_are_outputs_and_quantities():
    model = fbd.Model(MODELS / "statics/beam.yaml")
    table = model.sweep("P=100:300 N:2", "M(beam, load),V(beam, load, behind)")
    np.testing.assert_allclose(table["M(beam load)"], [148.575, 298.575], rtol=1e-12)
    assert table.units["V(beam load behind)"] == "N"
    found = model.find("P = 0..2000 N: M(beam, L/2) = 500 N*m", statics=True)
    assert found[0].value == pytest.approx(803.8, abs=1e-8)
