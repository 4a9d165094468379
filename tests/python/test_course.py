# SPDX-License-Identifier: GPL-3.0-or-later
"""The course: each lesson has a page, a model with derivations that can be graded, and a notebook whose cells run. The commands
of the pages are run by tests/tools/run_docs."""
import re

import fbd
import nbformat
import pytest
from conftest import SOURCE

COURSE = SOURCE / "docs/course"
LESSONS = re.findall(r"^\| \d+\. \[[^]]*\]\((\w+)\.md\) \|.*\((\S+\.yaml)\) \|$", (COURSE / "README.md").read_text(encoding="utf-8"), re.MULTILINE)


def test_every_lesson_is_listed():
    assert len(LESSONS) == 13
    names = [name for name, _ in LESSONS]
    assert sorted(path.stem for path in COURSE.glob("*.md")) == sorted([*names, "README"])
    assert sorted(path.stem for path in COURSE.glob("*.ipynb")) == sorted(names)
    for name, after in zip(names, [*names[1:], "README"]):
        page = (COURSE / f"{name}.md").read_text(encoding="utf-8")
        assert "## By hand" in page and f"]({name}.ipynb)" in page and f"]({after}.md)" in page.splitlines()[-1]


@pytest.mark.parametrize("name, model", LESSONS)
def test_sheet(name, model, tmp_path):
    """With the grading of the model, or of the page."""
    path, page = COURSE / model, (COURSE / f"{name}.md").read_text(encoding="utf-8")
    text = path.read_text(encoding="utf-8")
    if "\ngrading:" not in text:
        text += re.search(r"^grading: .*\n", page, re.MULTILINE)[0]
    (tmp_path / path.name).write_text(text, encoding="utf-8")
    key = fbd.Key(tmp_path / path.name)
    for student in ("anna", "boris"):
        graded = key.grade(text=key.solution(student), student=student)
        assert graded.passed and graded.points == graded.most
        assert any("equation" in finding.message for finding in graded.findings)
        assert key.grade(text=key.handout(student), student=student).points == 0
    assert fbd.Model(path).check_hand() == 0


@pytest.mark.parametrize("name", [name for name, _ in LESSONS])
def test_notebook(name, monkeypatch):
    notebook = nbformat.read(COURSE / f"{name}.ipynb", as_version=4)
    nbformat.validate(notebook)
    assert not any(cell.get("outputs") for cell in notebook.cells), "outputs belong in nobody's repository"
    cells = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    assert any("### BEGIN SOLUTION" in cell for cell in cells) and cells[-1] == '"all as expected"'
    monkeypatch.chdir(COURSE)
    names = {}
    for cell in cells:
        exec(compile(cell, f"{name}.ipynb", "exec"), names)
