# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebooks of python/examples are run, and what they show is looked at."""
import base64
import html
import re

import limits
import nbclient
import nbformat
import pytest
from conftest import SOURCE

NOTEBOOKS = sorted((SOURCE / "python/examples").glob("*.ipynb"))


def run(path):
    notebook = nbformat.read(path, as_version=4)
    assert not any(cell.get("outputs") for cell in notebook.cells), "outputs belong in nobody's repository"
    nbclient.NotebookClient(notebook, timeout=int(limits.WAIT), kernel_name="python3",
                            resources={"metadata": {"path": str(path.parent)}}).execute()
    return notebook


def shown(notebook, kind):
    """All outputs of a kind, as texts."""
    return [output["data"][kind] for cell in notebook.cells for output in cell.get("outputs", [])
            if kind in output.get("data", {})]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=[path.stem for path in NOTEBOOKS])
def test_notebook(path):
    notebook = run(path)
    pages = shown(notebook, "text/html")
    diagrams = [base64.b64decode(code).decode() for page in pages
                for code in re.findall(r'data:image/svg\+xml;base64,([^"]+)', page)]
    assert diagrams and all("<svg" in diagram for diagram in diagrams)
    frames = [html.unescape(frame) for page in pages for frame in re.findall(r'<iframe srcdoc="([^"]*)"', page)]
    assert frames and all(frame.startswith("<!DOCTYPE html>") for frame in frames)
    assert any("<table" in page and "dataframe" in page for page in pages), "no table by pandas"
    # Each notebook says in its last cell what it must have found.
    assert shown(notebook, "text/plain")[-1] == "'all as expected'"
