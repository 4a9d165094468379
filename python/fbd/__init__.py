# SPDX-License-Identifier: GPL-3.0-or-later
"""fbd: free-body diagrams that run.

>>> import fbd
>>> model = fbd.Model("pendulum.yaml", theta0="60 deg")
>>> run = model.run(accuracy=1e-9)
>>> run["pendulum.theta"], run.units["pendulum.theta"]
>>> run.to_pandas().plot()

The module calls the C library libfbd and computes nothing by itself; names are those of fbd.h. docs/python.md is
the manual.
"""
from ._cost import Cost, CostPoint, Effect, Effects
from ._binding import lib as _lib
from ._find import Found, Gap, Solution
from ._fit import Fit, Fitted
from ._library import taken as _taken
from ._library import text_at as _text_at
from ._grade import Finding, Grade, Key
from ._inputs import Now
from ._linear import Linearization, Transfer
from ._model import Model, check
from ._notes import AccuracyNotReached, Error, Fix, Note, RunFailed, Warning
from ._records import (Arrow, Coordinate, Drift, Energy, Equation, Event, HandCheck, Inertia, Limit, Member, Mode, Parameter, Progress,
                       Stats, Unbalanced)
from ._run import Run
from ._section import Cut, Section
from ._simulation import Simulation
from ._state import Equations, State, Statics
from ._sweep import SweepTable
from ._testing import assert_derivation
from ._widget import Sliders

__version__: str = _text_at(_lib.fbd_version())

# Without `Warning`, which would take the place of Python's own.
__all__ = [
    "AccuracyNotReached", "Arrow", "Coordinate", "Cost", "CostPoint", "Cut", "Drift", "Effect", "Effects", "Energy",
    "Equation", "Equations", "Error", "Event", "Finding", "Fit", "Fitted", "Fix", "Found", "Gap", "Grade", "HandCheck", "Inertia", "Key", "Limit", "Linearization", "Member", "Mode", "Model",
    "Note", "Now", "Parameter", "Progress", "Run", "RunFailed", "Section", "Simulation", "Sliders", "Solution", "State", "Statics", "Stats", "SweepTable", "Transfer", "Unbalanced",
    "assert_derivation", "check", "schema",
]

for _name in [*__all__, "Warning"]:
    if isinstance(globals().get(_name), type):
        globals()[_name].__module__ = __name__  # what a traceback and a pickle call it


def schema() -> str:
    """The model language as JSON Schema, as text."""
    return _taken(_lib.fbd_schema())
