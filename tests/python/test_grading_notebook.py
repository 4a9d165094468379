# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebook for nbgrader in examples/grading: its last cell returns the points of the answer."""
import ast
import shutil

import nbformat
import pytest
from conftest import SOURCE
from test_grade import RIGHT

EXAMPLES = SOURCE / "examples/grading"
HAND = '["I_O*theta_ddot = -m*g*L/2*cos(theta) + P*L*sin(beta - theta)"]'


def points(answer, cell):
    """What nbgrader takes: the value of the last line of the cell."""
    tree = ast.parse(cell.source)
    names = {"answer": answer}
    last = ast.Expression(tree.body.pop().value)
    exec(compile(tree, "cell", "exec"), names)
    return eval(compile(last, "cell", "eval"), names)


def test_points_of_the_notebook(tmp_path, monkeypatch, capsys):
    notebook = nbformat.read(EXAMPLES / "jupyter/rod.ipynb", as_version=4)
    nbformat.validate(notebook)
    names = {}
    exec(notebook.cells[1].source, names)
    sheet, cell = names["answer"], notebook.cells[-1]
    marks = cell.metadata["nbgrader"]
    assert marks["grade"] and marks["locked"] and not marks["solution"] and marks["schema_version"] == 3
    shutil.copy(EXAMPLES / "key.yaml", tmp_path)
    monkeypatch.chdir(tmp_path)
    forces = sheet.replace("forces: []", "forces: " + RIGHT)
    assert points(forces.replace("hand: []", "hand: " + HAND), cell) == marks["points"]
    assert points(forces, cell) == 3
    assert points(sheet, cell) == points("", cell) == 0
    assert "the sheet" in capsys.readouterr().out
    with pytest.raises(AssertionError):
        points(None, cell)
    hidden = cell.source.split("### BEGIN HIDDEN TESTS")[1]
    assert "key.yaml" in hidden and hidden.rstrip().endswith("### END HIDDEN TESTS")
