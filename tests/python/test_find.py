# SPDX-License-Identifier: GPL-3.0-or-later
"""At which value: the answers of fbd-run --find."""
import json
import math
import os
import subprocess
from pathlib import Path

import fbd
import pytest
from conftest import INCLINE

LOOP = Path(INCLINE).parent.parent / "tracks/loop_the_loop.yaml"
LADDER = Path(INCLINE).parent.parent / "statics/ladder.yaml"


def test_answers_are_those_of_the_program():
    question = "h = 2..3 m: car lifts"
    found = fbd.Model(LOOP).find(question)
    said = subprocess.run([os.environ["FBD_RUN"], "--find", question, "--json", "-", LOOP], stdout=subprocess.PIPE,
                          check=True).stdout.decode()
    assert found.json() == said
    only, = found
    assert json.loads(said)["solutions"][0]["value"] == only.value
    assert abs(only.value - 2.5) <= only.error < 1e-8
    assert (only.kind, only.below, only.above) == ("change", "car contact_lost", "")
    assert (found.parameter, found.unit, found.low, found.high, found.scan) == ("h", "m", 2, 3, 33)
    assert "h = 2.5 m" in str(found) and repr(found) == "<fbd.Found: h = [2.5] m>"


def test_parameters_of_the_model_hold(incline):
    slides = fbd.Model(INCLINE, f1=0, v0=0, mu_k=0.1).find("phi = 1..60 deg: block slips")
    assert abs(slides[0].value - math.degrees(math.atan(0.5))) <= slides[0].error < 1e-6
    assert len(fbd.Model(INCLINE, phi="10 deg").find("phi: block.x = 0.7 m")) == 1  # its own value does not count
    assert len(incline.find("mu_k = 0.1..0.5: block.x = 100 m")) == 0


def test_statics():
    found = fbd.Model(LADDER).find("mu = 0.1..1", statics=True)
    assert found[0].closed_form and abs(found[0].value - 0.33414384119) < 1e-10


def test_gaps_are_told(incline):
    found = incline.find("mu_k = -0.1..0.4: block.x = 1 m")
    assert found.failed == len(found.gaps) > 0
    assert found.gaps[0].failed and found.gaps[0].status == "wrong" and "zero or above" in found.gaps[0].reason


def test_what_is_wrong_is_raised(incline):
    with pytest.raises(fbd.Error, match="did you mean `mu_[sk]`") as caught:
        incline.find("mu_q = 0..1: block slips")
    assert caught.value.id == "unknown-parameter"
    with pytest.raises(TypeError):
        incline.find(3)
    with pytest.raises(fbd.Error):
        incline.find("mu_k = 0.1..0.5", runs=2)


def test_it_can_be_stopped(incline):
    with pytest.raises(fbd.Error, match="stopped"):
        incline.find("mu_k = 0.1..0.5: block.x = 1 m", runs=1000000, progress=lambda now: True)

    def give_up(now):
        raise KeyError("enough")

    with pytest.raises(KeyError):
        incline.find("mu_k = 0.1..0.5: block.x = 1 m", runs=1000000, progress=give_up)
