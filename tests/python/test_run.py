# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs: rows, dense output, events, outcomes."""
import csv
import json
import math

import fbd
import numpy as np
import pandas
import pytest
from conftest import MODELS, PENDULUM, WRONG_START, fbd_run

MOVING = ("hard/stick_slip_belt.yaml", "kinetics/incline.yaml", "couplings/slider_crank.yaml",
          "contact/bouncing_ball.yaml", "plane/projectile_with_drag.yaml", "hard/stiff_springs.yaml")

# A block that is drawn off its surface at t = 1 s, and a force that is infinite there.
LIFTED = """fbd: 1
bodies:
  block:
    mass: 1 kg
    motion: slide
    initial: {v: 1 m/s}
    forces: [gravity, normal, friction: 0.1, applied: {name: crane, value: "9.81[N/s]*t", angle: 90 deg}]
simulate: {until: 2 s}
"""
SINGULAR = """fbd: 1
bodies:
  block:
    mass: 1 kg
    motion: slide
    forces: [applied: {name: pull, value: "1[N*s]/(1[s] - t)"}]
simulate: {until: 2 s}
"""


def rows_of(*arguments):
    """The CSV of the program: heads, and numbers with inf where an error is not known."""
    rows = list(csv.reader(fbd_run("--quiet", "--csv", "-", *arguments).splitlines()))
    return rows[0], np.array([[float(field) if field else math.inf for field in row] for row in rows[1:]])


@pytest.mark.parametrize("path", MOVING)
@pytest.mark.parametrize("ledger", [False, True])
@pytest.mark.parametrize("error_bars", [False, True])
def test_columns_are_those_of_the_csv_to_the_last_bit(path, ledger, error_bars):
    options = ["--ledger"] * ledger + ["--error-bars"] * error_bars
    heads, rows = rows_of(*options, MODELS / path)
    run = fbd.Model(MODELS / path).run(ledger=ledger, error_bars=error_bars)
    assert [f"{name} [{run.units[name]}]" for name in run.columns] == heads
    np.testing.assert_array_equal(run.rows, rows)
    for i, name in enumerate(run):
        np.testing.assert_array_equal(run[name], rows[:, i])


def test_columns_are_the_librarys_own_memory(pendulum):
    run = pendulum.run()
    theta, address = run["pendulum.theta"], run["pendulum.theta"].__array_interface__["data"][0]
    assert run["pendulum.theta"].__array_interface__["data"][0] == address
    assert np.shares_memory(theta, run.rows)
    with pytest.raises(ValueError):
        theta[0] = 1
    kept = theta.copy()
    del run
    for _ in range(50):
        pendulum.run()
    np.testing.assert_array_equal(theta, kept)


def test_pandas(pendulum):
    run = pendulum.run(ledger=True)
    frame = run.to_pandas()
    assert frame.index.name == "t" and list(frame.columns) == list(run.columns[1:])
    assert frame.attrs["units"]["pendulum.omega"] == "rad/s"
    frame["pendulum.theta"] *= 180 / math.pi
    assert frame["pendulum.theta"].iloc[0] == pytest.approx(60)
    assert run["pendulum.theta"][0] == pytest.approx(math.pi / 3)
    frame.iloc[0, 0] = 1
    same = pandas.DataFrame(dict(run))
    np.testing.assert_array_equal(same["energy.kinetic"], run["energy.kinetic"])


def test_the_period_is_that_of_the_elliptic_integral(pendulum):
    """T = 2 pi sqrt(L/g) / agm(1, cos(theta0/2)): Gauss."""
    a, b = 1.0, math.cos(math.radians(30))
    for _ in range(8):
        a, b = (a + b) / 2, math.sqrt(a * b)
    period = 2 * math.pi * math.sqrt(1.06 / 9.81) / a
    run = pendulum.run(accuracy=1e-11)
    bottoms = [event.t for event in run.events if event.name == "bottom"]
    assert bottoms[2] - bottoms[0] == pytest.approx(period, rel=1e-10)
    assert run.stats.error_estimate <= 1e-11 and run.stats.accuracy == 1e-11
    event = run.events[0]
    assert (event.kind, event.body) == ("user", "") and 0 <= event.t_error < 1e-9


@pytest.mark.parametrize("path", MOVING)
def test_at_gives_the_rows_in_any_order(path):
    model = fbd.Model(MODELS / path)
    run = model.run()
    picks = np.random.default_rng(1).permutation(len(run.rows))[:60]
    one_by_one = [run.at(run.t[i]) for i in picks[:6]]
    for i, state in zip([*picks[:6], *picks], [*one_by_one, *run.at(run.t[picks])]):
        for name in state:
            if name in run:
                assert state[name] == run[name][i], (path, name, run.t[i])
    assert dict(run.end) == dict(run.at(run.t_end))


def test_at_is_dense_output_and_not_a_line_between_rows(pendulum):
    few, many = pendulum.run(every=5), pendulum.run(every=0.37)
    for t in (0.37, 4.44, 9.99):
        assert few.at(t)["theta"] == many.at(t)["theta"]
    assert few.at(0.37)["theta"] == many["pendulum.theta"][list(many.t).index(0.37)]
    with pytest.raises(ValueError):
        few.at(10.001)
    with pytest.raises(ValueError):
        few.at([1, -1e-9])


def test_at_follows_the_run_that_reached_its_accuracy():
    text = PENDULUM.read_text().replace("until: 10 s", "until: 10 s\n  step: 0.1 s")
    run = fbd.Model.parse(text).run(accuracy=1e-10)
    for i in (3, 200, 400):
        assert run.at(run.t[i])["theta"] == run["pendulum.theta"][i]


def test_stick_and_slip(incline):
    run = incline.run()
    assert [event.kind for event in run.events] == ["stick"]
    stick = run.events[0]
    assert stick.body == "block" and stick.name == "friction" and "holds" in stick.detail
    assert run.at(stick.t)["block.v"] == 0 and run.end["block.v"] == 0
    assert run.at(stick.t - 1e-3)["block.v"] > 0
    assert incline.run(until=0.1).events == ()


def test_energy_works_and_errors(incline):
    run = incline.run(error_bars=True, ledger=True)
    energy = run.energy
    assert energy.work == pytest.approx(run.work("block", "friction") + run.work("block", "push"), rel=1e-12)
    assert abs(energy.residual) < 1e-9 and run.work("block", "friction") < 0
    assert run.energy_error.kinetic >= 0
    assert 0 <= run.error("block.x") < 1e-8 and run.work_error("block", "friction") < 1e-6
    assert math.isnan(incline.run().error("block.x"))
    with pytest.raises(KeyError):
        run.work("block", "nothing")


def test_report_and_json_are_those_of_the_program(incline):
    run = incline.run()
    here, there = json.loads(run.json()), json.loads(fbd_run("--quiet", "--json", "-", MODELS / "kinetics/incline.yaml"))
    for part in ("final", "events", "forces", "energy"):
        assert here[part] == there[part]
    assert run.report().splitlines()[:12] == fbd_run(MODELS / "kinetics/incline.yaml").splitlines()[:12]


def test_the_page_is_one_document_in_a_frame(incline):
    import html
    import re

    run = incline.run(error_bars=True)
    page = run.html()
    assert page.startswith("<!DOCTYPE html>") and page.rstrip().endswith("</html>")
    shown = run._repr_html_()
    assert html.unescape(re.search(r'srcdoc="([^"]*)"', shown)[1]).startswith("<!DOCTYPE html>")
    assert shown.count("<iframe") == 1
    assert run.gnuplot("a.svg", "block.v").count("plot ") >= 1
    with pytest.raises(fbd.Error) as caught:
        run.gnuplot(None, "block.w")
    assert caught.value.id == "unknown-column"


def test_a_run_that_fails_is_raised_with_its_rows():
    with pytest.raises(fbd.RunFailed) as caught:
        fbd.Model.parse(SINGULAR).run()
    run = caught.value.run
    assert run.outcome == "failed" and run.reason and run.reason in str(caught.value)
    assert run.t[-1] == pytest.approx(1, abs=0.01) and np.isfinite(run.rows).all()
    assert "failed" in repr(run) and run._repr_html_().startswith("<pre>")


def test_a_start_that_cannot_be_is_raised_with_its_place():
    with pytest.raises(fbd.RunFailed) as caught:
        fbd.Model.parse(WRONG_START, "four_bar.yaml").run()
    assert caught.value.id == "does-not-fit" and caught.value.file == "four_bar.yaml" and caught.value.line > 0


def test_a_lost_contact_is_told_and_the_run_is_there():
    model = fbd.Model.parse(LIFTED)
    with pytest.warns(fbd.Warning, match="block") as caught:
        run = model.run()
    assert caught[0].filename == __file__
    assert run.outcome == "broken" and run.t_end == pytest.approx(1, rel=1e-9)
    assert run.events[-1].kind == "contact_lost"


def test_an_event_of_the_file_may_stop_it():
    text = PENDULUM.read_text().replace('when: "theta = 0"', 'when: "theta = 0", stop: true')
    run = fbd.Model.parse(text).run()
    assert run.outcome == "stopped" and run.end["theta"] == pytest.approx(0, abs=1e-9)
    assert run.t_end == run.events[-1].t == run.t[-1]


def test_an_accuracy_that_is_not_reached_is_raised(pendulum):
    with pytest.raises(fbd.AccuracyNotReached) as caught:
        pendulum.run(accuracy=1e-17)
    assert caught.value.run.outcome == "done" and "1e-17" in str(caught.value)


def test_progress_is_told_and_may_end_the_run(pendulum):
    seen = []
    run = pendulum.run(until=1e4, every=1e2, progress=seen.append)
    assert run.outcome == "done" and seen and all(a.t < b.t for a, b in zip(seen, seen[1:]))
    assert seen[0].until == 1e4 and seen[0].steps > 0
    plain = pendulum.run(until=1e4, every=1e2)
    np.testing.assert_array_equal(run.rows, plain.rows)
    run = pendulum.run(until=1e9, every=1e7, progress=lambda progress: True)
    assert run.outcome == "interrupted" and 0 < run.t_end < 1e9
    assert run.at(run.t_end / 2).t == run.t_end / 2

    def burst(progress):
        raise LookupError("mine")

    with pytest.raises(LookupError, match="mine"):
        pendulum.run(until=1e9, every=1e7, progress=burst)


def test_what_is_wrong_with_options_is_said(pendulum):
    with pytest.raises(fbd.Error) as caught:
        pendulum.run(method="rk9")
    assert caught.value.id == "unknown-method"
    with pytest.raises(fbd.Error):
        pendulum.run(accuracy=1e-6, tolerance=1e-6)
    for wrong in ({"tolerance": 0}, {"step": -1}, {"until": math.nan}, {"accuracy": 0.0}, {"every": 0}):
        with pytest.raises(ValueError):
            pendulum.run(**wrong)
    with pytest.raises(KeyError, match="did you mean `pendulum.theta`"):
        pendulum.run()["pendulum.tetha"]


def test_methods_and_steps(pendulum):
    exact = pendulum.run(accuracy=1e-11).end["theta"]
    for options in ({"method": "rk8pd"}, {"method": "rk4", "step": 1e-3}, {"structure": False}):
        assert pendulum.run(**options).end["theta"] == pytest.approx(exact, abs=1e-7)


def test_what_accuracy_and_effects_cost(pendulum):
    cost = pendulum.cost(budget=0.3, methods=["rk8pd", "auto"])
    assert {point.method for point in cost.points} == {"rk8pd", "auto"}
    best = cost.cheapest(1e-6)
    assert best.error <= 1e-6 and best.stats.steps > 0 and cost.reference
    assert cost._repr_html_().startswith("<img") and cost.csv() and json.loads(cost.json())
    effects = pendulum.effects(budget=0.3)
    assert any(effect.name == "gravity" for effect in effects.effects) and str(effects)
