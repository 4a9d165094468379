# SPDX-License-Identifier: GPL-3.0-or-later
"""Sliders by ipywidgets, without a browser: moved by the program, and shown in a notebook that is executed."""
import sys

import fbd
import pytest

INCLINE = """
fbd: 1
parameters:
  phi: {value: 30 deg, range: [5 deg, 60 deg]}
  m: {value: 2 kg, range: [1 kg, 3 kg]}
  mu: 0.2
bodies:
  block:
    mass: m
    motion: {slide: {along: phi}}
    forces: [gravity, normal, friction: {kinetic: mu, static: mu}]
simulate: {until: 1 s}
"""


def test_without_ipywidgets_the_error_names_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    with pytest.raises(ImportError, match="python3-ipywidgets"):
        fbd.Model.parse(INCLINE).sliders()


def test_a_slider_runs_the_model_again():
    pytest.importorskip("ipywidgets")
    model = fbd.Model.parse(INCLINE, m="1.5 kg")
    sliders = model.sliders(lambda now: now.run())
    assert sliders.values == {"phi": model.parameters["phi"].value, "m": 1.5}
    before = sliders.shown["block.v"][-1]
    sliders.widget.children[0].value = 0.7
    assert sliders.values["phi"] == 0.7
    wanted = fbd.Model.parse(INCLINE, m=1.5, phi=0.7).run()["block.v"][-1]
    assert sliders.shown["block.v"][-1] == wanted != before
    assert sliders.model.parameters["phi"].value == 0.7
    assert "iframe" in sliders.widget.children[-1].value or "<pre" in sliders.widget.children[-1].value


def test_what_is_shown_is_chosen():
    pytest.importorskip("ipywidgets")
    sliders = fbd.Model.parse(INCLINE).sliders(lambda now: now.state())
    assert "svg" in sliders.widget.children[-1].value
    sliders = fbd.Model.parse(INCLINE).sliders(lambda now: now.parameters["m"].value)
    assert sliders.widget.children[-1].value == "<pre>2.0</pre>"
    assert repr(sliders) == "<fbd.Sliders phi = 0.523599, m = 2>"


def test_a_file_without_ranges_has_no_sliders():
    pytest.importorskip("ipywidgets")
    with pytest.raises(fbd.Error) as raised:
        fbd.Model.parse(INCLINE.replace(", range: [5 deg, 60 deg]", "").replace(", range: [1 kg, 3 kg]", "")).sliders()
    assert raised.value.id == "no-range"


def test_a_notebook_shows_them():
    pytest.importorskip("ipywidgets")
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    cells = ["import fbd", f"fbd.Model.parse({INCLINE!r}).sliders(lambda now: now.state())"]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(cell) for cell in cells])
    client = nbclient.NotebookClient(notebook, timeout=None, kernel_name="python3")
    client.comm_open_handlers = {}  # Debian's nbclient 0.7 does not read the messages of its ipywidgets 6
    client.execute()
    assert any("application/vnd.jupyter.widget-view+json" in output.get("data", {}) for output in notebook.cells[1].outputs)
