# SPDX-License-Identifier: GPL-3.0-or-later
"""The program under test, and what it writes."""
import csv
import json
import os
import subprocess
from pathlib import Path

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
MODELS = SOURCE / "models"
RUN = os.environ["FBD_RUN"]


def run(*arguments, code=0):
    done = subprocess.run([RUN, *map(str, arguments)], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    assert code is None or done.returncode == code, f"exit code {done.returncode}: {done.stderr.decode()}"
    return done.stdout.decode()


def table(*arguments):
    """The CSV with its ledger: a list of {name without unit: value}."""
    rows = csv.reader(run("--csv", "-", "--ledger", *arguments).splitlines())
    names = [name.split(" [")[0] for name in next(rows)]
    return [dict(zip(names, map(float, row))) for row in rows]


def result(*arguments):
    return json.loads(run("--json", "-", *arguments))


def many_bodies(model):
    """Writes a scene of 200 rods that swing, each about its own axis."""
    lines = ["fbd: 1", "title: Many", "bodies:"]
    for i in range(200):
        lines.append(f"  b{i}: {{shape: rod, mass: 1 kg, length: 0.5 m, motion: {{pivot: {{at: [{i % 20}, {i // 20}], "
                     f"point: left}}}}, initial: {{theta: {i} deg}}, forces: [gravity]}}")
    model.write_text("\n".join(lines + ["simulate: {until: 10 s}"]), encoding="utf-8")
