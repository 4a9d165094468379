# SPDX-License-Identifier: GPL-3.0-or-later
"""TAP for pytest, and what all tests use."""
import os
import subprocess
from pathlib import Path

import fbd
import pytest

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
MODELS = SOURCE / "models"
PENDULUM = MODELS / "rotation/simple_pendulum.yaml"
INCLINE = MODELS / "kinetics/incline.yaml"

# Bodies that do not fit their couplings, and are not told to find their place.
WRONG_START = (MODELS / "couplings/four_bar.yaml").read_text().replace(", assemble: true", "").replace(
    "assemble: true", "theta: 10 deg")


class Tap:
    """A line for each test, with what a failed one says."""

    def __init__(self, number):
        self.stream = os.fdopen(number, "w", buffering=1, encoding="utf-8", errors="backslashreplace")
        self.count = 0

    def pytest_runtest_logreport(self, report):
        if report.when != "call" and report.passed:
            return
        self.count += 1
        name = report.nodeid.rpartition("::")[2].removeprefix("test_").replace("_", " ")
        skip = f" # SKIP {report.longrepr[2]}" if report.skipped and isinstance(report.longrepr, tuple) else ""
        self.stream.write(f"{'not ok' if report.failed else 'ok'} {self.count} - {name}{skip}\n")
        if report.failed:
            self.stream.write("".join(f"# {line}\n" for line in report.longreprtext.splitlines()))

    def pytest_collectreport(self, report):
        if report.failed:
            self.count += 1
            self.stream.write(f"not ok {self.count} - {report.nodeid}\n")
            self.stream.write("".join(f"# {line}\n" for line in report.longreprtext.splitlines()))

    def pytest_sessionfinish(self):
        self.stream.write(f"1..{self.count}\n")

    def pytest_unconfigure(self):
        self.stream.close()


def pytest_configure(config):
    if "FBD_TAP" in os.environ:
        config.pluginmanager.register(Tap(int(os.environ["FBD_TAP"])))


def fbd_run(*arguments):
    """What fbd-run prints."""
    done = subprocess.run([os.environ["FBD_RUN"], *map(str, arguments)], stdout=subprocess.PIPE, check=True)
    return done.stdout.decode()


@pytest.fixture(scope="session")
def pendulum():
    return fbd.Model(PENDULUM)


@pytest.fixture(scope="session")
def incline():
    return fbd.Model(INCLINE)
