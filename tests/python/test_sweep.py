# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps: the rows of fbd-sweep as a structured array."""
import csv
import os
import subprocess

import fbd
import numpy as np
import pytest
from conftest import INCLINE


def test_rows_are_those_of_the_program(incline):
    texts = ["phi=10:30 deg:3", "mu_k=uniform(0.3,0.5):4"]
    outputs = "block.x,max(block.v),time(stick),count(stick),steps"
    table = incline.sweep(texts, outputs, seed=3)
    program = os.environ["FBD_RUN"].replace("fbd-run", "fbd-sweep")
    vary = [word for text in texts for word in ("--vary", text)]
    said = subprocess.run([program, *vary, "--output", outputs, "--seed", "3", INCLINE], stdout=subprocess.PIPE,
                          check=True).stdout.decode()
    rows = list(csv.reader(said.splitlines()))
    assert len(table) == len(rows) - 1 == 12
    for place, name in enumerate(table.dtype.names):
        for row, value in zip(rows[1:], table[name]):
            text = row[place]
            assert value == text if table.dtype[name].kind == "U" else value == float(text or "nan") or not text
    assert table.units["phi"] == "deg" and table.units["max(block.v)"] == "m/s"
    assert table.dtype["run"] == np.int64 and table.dtype["events"] == np.float64
    np.testing.assert_array_equal(table, incline.sweep(texts, outputs, seed=3, jobs=1))


def test_values_may_be_arrays(incline):
    values = np.linspace(0.1, 0.4, 4)
    table = incline.sweep({"mu_k": values, "f1": ["5 N", "10 N"]}, ["block.x"])
    assert table.shape == (8,)
    np.testing.assert_array_equal(np.unique(table["mu_k"]), values)
    side = incline.sweep({"mu_k": values, "f1": [1, 2, 3, 4]}, zip=True)
    np.testing.assert_array_equal(side["f1"], [1, 2, 3, 4])
    alone = fbd.Model(INCLINE, mu_k=float(values[2]), f1="10 N").run()
    row = table[(table["mu_k"] == values[2]) & (table["f1"] == 10)]
    assert row["block.x"][0] == alone.end["block.x"]


def test_parameters_of_the_model_hold_unless_they_vary():
    model = fbd.Model(INCLINE, f1="20 N", mu_k=0.25)
    table = model.sweep("mu_k=0.25,0.3", "block.x")
    assert table["block.x"][0] == model.run().end["block.x"]


def test_pandas(incline):
    table = incline.sweep("mu_k=0.1:0.4:4", "block.x,time(breakaway)")
    frame = table.to_pandas()
    assert frame.index.name == "run" and list(frame["block.x"]) == list(table["block.x"])
    assert frame["time(breakaway)"].isna().all() and frame.attrs["units"]["block.x"] == "m"
    assert set(frame["status"]) == {"done"}


def test_runs_that_fail_are_told(incline):
    with pytest.warns(fbd.Warning, match="1 of 2 runs"):
        table = incline.sweep("mu_k=0.3,-0.2", "block.x")
    assert table["status"][0] == "done" and np.isnan(table["events"][1]) and table["status"][1] == "wrong" and table["reason"][1]


def test_what_is_wrong_is_said(incline):
    for vary, outputs, id in (("q=1,2", (), "unknown-parameter"), ("mu_k=", (), "bad-vary"),
                              ("mu_k=0.1", "block.z", "unknown-output")):
        with pytest.raises(fbd.Error) as caught:
            incline.sweep(vary, outputs)
        assert caught.value.id == id
    with pytest.raises((TypeError, ValueError)):
        incline.sweep({"mu_k": [float("nan")]})


def test_data_files_are_found_wherever_python_has_gone(tmp_path, monkeypatch):
    (tmp_path / "push.csv").write_text("t [s],f [N]\n0,0\n1,2\n2,2\n")
    (tmp_path / "pushed.yaml").write_text("""fbd: 1
parameters: {m: 1 kg}
tables: {push: {file: push.csv, x: "t [s]", y: "f [N]"}}
bodies:
  block: {mass: m, motion: slide, forces: [applied: {name: push, value: push(t)}]}
simulate: {until: 1 s}
""")
    monkeypatch.chdir(tmp_path)
    models = fbd.Model("pushed.yaml"), fbd.Model.parse((tmp_path / "pushed.yaml").read_text(), "mine.yaml")
    monkeypatch.chdir("/")
    for model in models:
        table = model.sweep({"m": [1, 2]}, "block.v")
        np.testing.assert_allclose(table["block.v"], [1, 0.5], rtol=1e-12)


def test_progress(pendulum):
    seen = []
    pendulum.sweep("theta0=uniform(0.1,1):3000", "pendulum.theta", progress=lambda *counts: seen.append(counts))
    assert seen and all(runs == 3000 for _, runs in seen)
    assert all(a[0] <= b[0] for a, b in zip(seen, seen[1:])) and seen[-1][0] > 0


def test_questions_in_place_of_outputs(incline):
    table = fbd.Model(INCLINE, mu_k=0.1, v0=0, f1=0).sweep({"mu_s": [0.2, 0.5]}, find="phi = 1..60 deg: block slips", runs=9)
    assert table.units == {"phi": "deg", "error": "deg"} and list(table["solutions"]) == [1, 1]
    alone = incline.find("phi = 1..60 deg: block slips", runs=9)  # with the mu_s of the file
    assert alone.scan == 9 and table.dtype.names == ("run", "mu_s", "phi", "error", "solutions", "runs", "status", "reason")
    np.testing.assert_array_less(np.abs(table["phi"] - np.degrees(np.arctan([0.2, 0.5]))), table["error"])
    with pytest.raises(fbd.Error, match="place of outputs"):
        incline.sweep({"mu_s": [0.2, 0.5]}, "t", find="phi = 1..60 deg: block slips")
