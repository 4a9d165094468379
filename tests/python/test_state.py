# SPDX-License-Identifier: GPL-3.0-or-later
"""States: equations, diagrams, linearisation, statics."""
import base64
import json
import math
import re
import xml.dom.minidom

import fbd
import numpy as np
import pytest
from conftest import MODELS, PENDULUM, WRONG_START, fbd_run

m, L, g = 3, 1.06, 9.81  # of the pendulum


def test_equations_have_their_terms_by_name(pendulum):
    equation = pendulum.equations(theta=0.1)["pendulum.theta"]
    assert equation.terms["gravity"] == pytest.approx(-m * g * L * math.sin(0.1), rel=1e-14)
    assert equation.acceleration == pytest.approx(-g / L * math.sin(0.1), rel=1e-14)
    assert (equation.unit, equation.acceleration_unit, equation.inertia_name) == ("N*m", "rad/s^2", "I_O")
    same = pendulum.equations({"pendulum.theta": "0.1 rad"}, omega=2, t=3)["pendulum.theta"]
    assert same.terms == equation.terms


def test_the_text_is_that_of_the_program(pendulum):
    assert str(pendulum.equations(theta="0.3 rad")) in fbd_run("--equations", "--at", "theta=0.3", PENDULUM)
    assert str(pendulum.linearize()) in fbd_run("--linearize", PENDULUM)
    for here, option in ((pendulum.equations(), "--equations"), (pendulum.linearize(), "--linearize")):
        assert json.loads(here.json()) == json.loads(fbd_run(option, "--json", "-", PENDULUM))


def test_terms_add_up_in_every_model():
    seen = 0
    for path in sorted(MODELS.glob("*/*.yaml")):
        for name, equation in fbd.Model(path).equations().items():
            assert name == f"{equation.body}.{equation.coordinate}"
            size = sum(map(abs, equation.terms.values())) + abs(equation.inertia * equation.acceleration)
            assert sum(equation.terms.values()) == pytest.approx(equation.sum, abs=1e-12 * size + 1e-300), (path, name)
            seen += 1
    assert seen > 100


def svg_of(page):
    coded = re.search(r'src="data:image/svg\+xml;base64,([^"]+)"', page)[1]
    svg = base64.b64decode(coded).decode()
    return xml.dom.minidom.parseString(svg).documentElement


def test_a_notebook_shows_diagrams(pendulum):
    for shown in (pendulum, pendulum.state(), pendulum.equations(), pendulum.linearize()):
        assert svg_of(shown._repr_html_()).tagName == "svg"
    svg = pendulum.state(theta="20 deg").svg("pendulum", components=True)
    assert 'id="pendulum-pin-x"' in svg
    with pytest.raises(fbd.Error) as caught:
        pendulum.state().svg("nobody")
    assert caught.value.id == "unknown-body"


def test_states_are_set_by_name(pendulum):
    state = pendulum.state({"pendulum.theta": "90 deg"}, omega=-1.5)
    assert state["pendulum.theta"] == pytest.approx(math.pi / 2, rel=1e-15)
    assert dict(state) == {"t": 0, "pendulum.theta": state["theta"], "pendulum.omega": -1.5}
    assert state.units == {"t": "s", "pendulum.theta": "rad", "pendulum.omega": "rad/s"}
    state["theta"] = np.float64(0.25)
    assert state["pendulum.theta"] == 0.25
    with pytest.raises(fbd.Error) as caught:
        pendulum.equations(theat=1)
    assert caught.value.id == "unknown-coordinate" and "pendulum.theta" in caught.value.hint
    with pytest.raises(fbd.Error):
        state["theta"] = "3 kg"
    with pytest.raises(KeyError):
        state["nothing"]
    assert state["pendulum.theta"] == 0.25


def test_diagrams_list_every_force(pendulum):
    arrows = {arrow.name: arrow for arrow in pendulum.state(theta=0).diagram()["pendulum"]}
    assert arrows["gravity"].fy == pytest.approx(-m * g)
    assert arrows["pin"].fy == pytest.approx(m * g)


def test_linearisation(pendulum):
    linear = pendulum.linearize()
    assert linear.coordinates == ("pendulum.theta",)
    assert linear.states == ("pendulum.theta", "pendulum.omega")
    np.testing.assert_allclose(linear.A, [[0, 1], [-g / L, 0]], rtol=1e-12)
    assert sorted(mode.im for mode in linear.modes) == pytest.approx([-math.sqrt(g / L), math.sqrt(g / L)])
    assert linear.modes[0].eigenvalue == complex(linear.modes[0].re, linear.modes[0].im)
    assert linear.equilibrium == {"pendulum.theta": 0}
    upright = pendulum.linearize(theta="179 deg")
    np.testing.assert_allclose(upright.A, [[0, 1], [g / L, 0]], rtol=1e-12)
    with pytest.raises(ValueError):
        linear.A[0, 0] = 1


def test_statics():
    ladder = fbd.Model(MODELS / "statics/ladder.yaml")
    statics = ladder.statics()
    assert statics.holds and statics.indeterminacy == 0
    friction = [limit for limit in statics.limits if limit.name == "foot.friction"][0]
    assert friction.holds and friction.kind == "friction" and 0 < friction.needed < friction.limit
    sums = [sum(getattr(a, part) for a in statics.diagram["foot"]) for part in ("fx", "fy")]
    assert sums == pytest.approx([0, 0], abs=1e-8)
    assert json.loads(statics.json())
    assert str(statics) in fbd_run("--static", MODELS / "statics/ladder.yaml")


def test_two_force_members():
    truss = fbd.Model(MODELS / "statics/truss.yaml").statics()
    members = {member.name: member for member in truss.members}
    assert len(members) == 7 and all(member.kind == "rod" for member in truss.members)
    assert members["BD"].tension == pytest.approx(-1000 / math.sqrt(3), rel=1e-12)
    assert members["AC"].tension == pytest.approx(500 / math.sqrt(3), rel=1e-12)


def test_statics_of_what_moves_say_what_would_hold_it(pendulum):
    statics = pendulum.statics()
    assert not statics.holds
    assert statics.unbalanced[0].holding == pytest.approx(m * g * L * math.sin(math.pi / 3), rel=1e-9)
    assert pendulum.statics(settle=True).holds


def test_a_state_that_does_not_fit_is_refused():
    bar = fbd.Model(MODELS / "couplings/four_bar.yaml")
    assert bar.state().fit().redundant() == ()
    with pytest.raises(fbd.Error) as caught:
        fbd.Model.parse(WRONG_START).equations()
    assert caught.value.id == "does-not-fit"
