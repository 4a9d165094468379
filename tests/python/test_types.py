# SPDX-License-Identifier: GPL-3.0-or-later
"""The type hints are right, where mypy is there to say so."""
import importlib.util
import subprocess
import sys
from pathlib import Path

import fbd
import pytest

USE = """
import fbd
model = fbd.Model("pendulum.yaml", theta0="60 deg")
run = model.run(accuracy=1e-9)
reveal_type(run["pendulum.theta"])
reveal_type(model.equations(theta=1)["pendulum.theta"].terms["gravity"])
reveal_type(run.at(1.0))
reveal_type(run.at([1.0, 2.0]))
model.run(methd="auto")
"""


@pytest.mark.skipif(not importlib.util.find_spec("mypy"), reason="mypy is not installed")
def test_hints_hold_for_the_module_and_for_its_users(tmp_path):
    package = Path(fbd.__file__).parent
    assert (package / "py.typed").exists()
    mypy = [sys.executable, "-m", "mypy", "--cache-dir", str(tmp_path / "cache")]
    done = subprocess.run([*mypy, "--strict", "-p", "fbd"], cwd=package.parent, stdout=subprocess.PIPE, text=True,
                          check=False)
    assert done.returncode == 0, done.stdout
    (tmp_path / "use.py").write_text(USE)
    said = subprocess.run([*mypy, "use.py"], cwd=tmp_path, stdout=subprocess.PIPE, text=True, check=False).stdout
    errors = [line for line in said.splitlines() if ": error:" in line]
    assert len(errors) == 1 and "methd" in errors[0], said
    for kind in ("numpy.ndarray[", "builtins.float", "State\"", "list[fbd._state.State]"):
        assert kind in said, said


def test_everything_public_is_documented():
    for name in [*fbd.__all__, "Warning"]:
        thing = getattr(fbd, name)
        assert thing.__doc__, name
        if isinstance(thing, type) and name not in ("HandCheck", "Note"):
            for part, value in vars(thing).items():
                if not part.startswith("_") and (callable(value) or isinstance(value, property)):
                    assert (value.fget if isinstance(value, property) else value).__doc__, f"{name}.{part}"
