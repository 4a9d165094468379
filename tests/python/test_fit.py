# SPDX-License-Identifier: GPL-3.0-or-later
"""Parameters from measured data: the answers of fbd-run --fit."""
import os
import subprocess

import fbd
import numpy as np
import pytest

BLOCK = """
fbd: 1
parameters: {v0: 1 m/s, F: 2 N, m: 2 kg}
bodies:
  block: {mass: m, motion: slide, initial: {v: v0}, forces: [applied: {name: push, value: F}]}
simulate: {until: 1 s}
"""
T = np.linspace(0.1, 3, 30)
X = 3 * T + T**2 + 0.01 * np.cos(40 * T)


def test_it_is_a_linear_regression():
    fit = fbd.Model.parse(BLOCK).fit({"t": T, "block.x": X}, ["v0", "F"])
    matrix = np.stack([T, T**2 / 4], axis=1)
    (v0, F), squares = np.linalg.lstsq(matrix, X, rcond=None)[:2]
    covariance = np.linalg.inv(matrix.T @ matrix) * squares[0] / 28
    np.testing.assert_allclose([fit["v0"].value, fit["F"].value], [v0, F], rtol=1e-6)
    np.testing.assert_allclose([fit["v0"].error, fit["F"].error], np.sqrt(np.diag(covariance)), rtol=1e-5)
    np.testing.assert_allclose(fit.squares, squares[0], rtol=1e-5)
    assert fit["F"].low < F < fit["F"].high and fit["F"].unit == "N" and list(fit) == ["v0", "F"]
    assert fit.freedom == 28 and fit.values_count == 30 and fit.unit == "m" and fit.correlations.shape == (2, 2)
    assert "v0" in repr(fit) and "95 %" in str(fit) and "'block.x [m]'" in fit.gnuplot()


def test_it_is_that_of_the_program(tmp_path):
    data, model = tmp_path / "data.csv", tmp_path / "model.yaml"
    data.write_text("t,block.x\n" + "".join(f"{t!r},{x!r}\n" for t, x in zip(T.tolist(), X.tolist())))
    model.write_text(BLOCK)
    said = subprocess.run([os.environ["FBD_RUN"], "--fit", data, "--parameters", "v0,F", "--json", "-", model],
                          stdout=subprocess.PIPE, check=True).stdout.decode()
    assert fbd.Model(model).fit(data, ["v0", "F"]).json() == said


def test_empty_cells_are_nan():
    with_gaps = X.copy()
    with_gaps[3] = np.nan
    assert fbd.Model.parse(BLOCK).fit({"t": T, "block.x": with_gaps}, ["v0", "F"]).values_count == 29


def test_what_is_not_determined_is_a_warning():
    with pytest.warns(fbd.Warning, match="do not determine `F`, `m`"):
        fit = fbd.Model.parse(BLOCK).fit({"t": T, "block.x": X})
    assert np.isinf(fit["m"].error) and np.isfinite(fit["v0"].error)


def test_what_is_wrong_is_raised(tmp_path):
    model = fbd.Model.parse(BLOCK)
    with pytest.raises(fbd.Error) as caught:
        model.fit({"t": T, "block.q": X})
    assert (caught.value.id, caught.value.line, caught.value.column) == ("unknown-column", 1, 6)
    with pytest.raises(ValueError, match="one length"):
        model.fit({"t": T, "block.x": X[1:]})
    with pytest.raises(FileNotFoundError):
        model.fit(tmp_path / "nowhere.csv")
    long = np.linspace(0.01, 1000, 100000)
    with pytest.raises(fbd.Error, match="stopped"):
        model.fit({"t": long, "block.x": np.sin(long)}, ["v0", "F"], progress=lambda now: True)
