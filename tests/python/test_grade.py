# SPDX-License-Identifier: GPL-3.0-or-later
"""Grading: the sheets and findings of fbd-run --grade."""
import json
import os
import subprocess

import fbd
import pytest
from conftest import SOURCE, fbd_run

KEY = SOURCE / "examples/grading/key.yaml"
RIGHT = ("[gravity, applied: {name: pull, value: P, angle: beta, at: right}, "
         "applied: {name: R, value: unknown, angle: unknown, at: left}]")


def graded(answer, *options):
    """What the program says; an answer that does not pass is its exit code 4."""
    command = [os.environ["FBD_RUN"], "--grade", KEY, "--student", "anna", *options, answer]
    return subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False).stdout


def test_sheets_and_findings(tmp_path):
    key, answer = fbd.Key(KEY), tmp_path / "answer.yaml"
    sheet = key.handout("anna")
    assert sheet == fbd_run("--handout", "--student", "anna", KEY)
    assert key.solution("anna") == fbd_run("--handout", "--solution", "--student", "anna", KEY)
    answer.write_text(sheet.replace("forces:\n", "forces: " + RIGHT + "\n"))
    half = key.grade(answer, "anna")
    assert 0 < half.points < half.most and not half.passed
    assert {finding.kind for finding in half.findings} == {"right", "missing"}
    assert sum(finding.most for finding in half.findings) == half.most
    assert half.text() in graded(answer) and half.text(details=True) in graded(answer, "--details")
    assert json.loads(half.json())["points"] == half.points
    hand = 'hand: ["I_O*theta_ddot = -m*g*L/2*cos(theta) + P*L*sin(beta - theta)"]'
    answer.write_text(answer.read_text().replace("    hand:\n", "    " + hand + "\n"))
    whole = key.grade(answer, "anna")
    assert whole.passed and whole.points == whole.most
    answer.write_text(sheet)
    assert key.grade(answer, "anna").points == 0
    absent = key.grade(tmp_path / "absent.yaml")
    assert absent.findings[0].kind == "no_submission" and absent._repr_html_().startswith("<pre>")


def test_sheets_to_draw_on():
    key = fbd.Key(KEY)
    exam = key.page("anna", exam=True)
    assert exam == fbd_run("--handout", "--student", "anna", "--page", "-", "--exam", KEY)
    assert "Sheet of anna" in exam and "pull" not in exam
    try:
        assert "pull" in key.page("anna")  # the key, by which it checks
    except fbd.Error as error:
        assert error.id == "no-live"


def test_keys_and_answers_as_texts(tmp_path):
    key = fbd.Key.parse(KEY.read_text(), L="1.2 m", m=2)
    sheet = key.handout("anna")
    assert "L: 1.2 m" in sheet and "\n  m: 2" in sheet
    answer = sheet.replace("forces:\n", "forces: " + RIGHT + "\n", 1)
    graded_text = key.grade(text=answer, student="anna")
    (tmp_path / "answer.yaml").write_text(answer)
    graded_file = key.grade(tmp_path / "answer.yaml", "anna")
    assert 0 < graded_text.points == graded_file.points
    assert graded_text.findings == graded_file.findings
    assert key.grade(text="", student="anna").findings[0].kind == "no_submission"
    for wrong in ({}, {"text": answer}, {"path": "a.yaml", "text": answer, "student": "anna"}):
        with pytest.raises(TypeError):
            key.grade(**wrong)
    with pytest.raises(fbd.Error):
        fbd.Key.parse("fbd: 1\nbodies: 3\n")
    with pytest.raises(fbd.Error):
        fbd.Key.parse(KEY.read_text(), nothing=1)


def test_what_is_no_key_is_said(tmp_path):
    (tmp_path / "empty.yaml").write_text("fbd: 1\nbodies: {a: {mass: 1 kg, motion: slide}}\nsimulate: {until: 1 s}\n")
    with pytest.raises(fbd.Error) as caught:
        fbd.Key(tmp_path / "empty.yaml")
    assert caught.value.id == "nothing-to-grade"
    for wrong in (None, 1, "\0", object()):
        with pytest.raises((TypeError, ValueError)):
            fbd.Key(wrong)
        with pytest.raises((TypeError, ValueError)):
            fbd.Key(KEY).handout(wrong)
        with pytest.raises((TypeError, ValueError)):
            fbd.Key(KEY).page(wrong, exam=True)
        with pytest.raises((TypeError, ValueError)):
            fbd.Key(KEY).grade(wrong)


@pytest.mark.filterwarnings("ignore::fbd.Warning")
def test_a_drawn_reaction_is_named_in_hints():
    cases = SOURCE / "tests/grade/cases"
    grade = fbd.Key(cases / "atwood_key.yaml").grade(cases / "atwood_answer_tension_reversed.yaml")
    said = grade.text(details=True)
    assert "`T + m1*g = m1*a`" in said and "the summand `m1*g` has the wrong sign" in said
    assert "[N]" not in said and grade.points == 6


@pytest.mark.filterwarnings("ignore::fbd.Warning")
def test_each_reaction_counts_by_itself():
    cases = SOURCE / "tests/grade/cases"
    key, text = fbd.Key(cases / "hoist_key.yaml"), (cases / "hoist_answer_system.yaml").read_text()
    assert key.grade(text=text, student="anna").points == 8
    for line, said in {"T + f = m*a": "the summand `f` has the wrong sign", "T = m*a": "`friction` is missing",
                       "N - f = m*a": "wrong reaction: `N` stands where `T` belongs",
                       "2*T - f = m*a": "the summand `2*T` is right with the factor 0.5"}.items():
        grade = key.grade(text=text.replace("T - f = m*a", line), student="anna")
        assert grade.points == 7 and said in grade.text(details=True)
