# SPDX-License-Identifier: GPL-3.0-or-later
"""What tests of FMUs share: FMUs made of models and of scenes, runs of fbd-run beside them, and claims as TAP."""
import contextlib
import csv
import io
import json
import os
import subprocess
import sys
import tempfile
import traceback
import unittest
from pathlib import Path

from fmu import RUN, Fmu, make_fmu

MODELS = Path(os.environ["FBD_SOURCE_ROOT"]) / "models"
FOLDER = tempfile.TemporaryDirectory(prefix="fbd-fmi-")
made = {}

# What sticks, swings and remembers.
STICKS = """fbd: 1
parameters: {m: 1.2 kg, k: 60 N/m, v0: 0.4 m/s}
inputs: {push: 3 N, c: 0.2 N*s/m}
bodies:
  block:
    mass: m
    motion: slide
    initial: {v: v0}
    forces: [gravity, normal, friction: {static: 0.4, kinetic: 0.3}, spring: {stiffness: k}, applied: {name: air, value: -c*v}]
  bob:
    motion: {pivot: {on: block, at: G}}
    parts: {bob: {shape: point, mass: 0.3 kg, center: [0, -0.5 m]}}
    initial: {theta: 70 deg}
    forces: [gravity, applied: {name: motor, value: "push + 1[N]*sin(3*t) - 0.4[N]*hysteresis(theta, -0.2[rad], 0.3[rad])", angle: 0 deg, at: [0, -0.5 m]}]
simulate: {until: 4 s}
"""


def written(text):
    """A scene as a file."""
    path = Path(FOLDER.name) / f"scene_{abs(hash(text))}.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def place(model):
    """A path below models/, or the text of a scene."""
    return written(model) if "\n" in model else MODELS / model


def fmu_of(model, version, *arguments):
    """The unpacked FMU of a model or scene; made once."""
    key = (model, version, arguments)
    if key not in made:
        target = Path(FOLDER.name) / f"{len(made)}.fmu"
        make_fmu(place(model), target, "--fmu-version", version, *arguments)
        # A folder that a URI has to escape.
        made[key] = Fmu(target, Path(FOLDER.name) / f"un packed %{len(made)} ä")
    return made[key]


def run_json(model, *arguments):
    done = subprocess.run([RUN, "--quiet", "--json", "-", *map(str, arguments), str(place(model))],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    return json.loads(done.stdout)


def run_csv(model, *arguments):
    """Rows of fbd-run by name, without those of times that stand there twice (an event, and what it left)."""
    done = subprocess.run([RUN, "--quiet", "--csv", "-", *map(str, arguments), str(place(model))],
                          stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    table = list(csv.reader(io.StringIO(done.stdout.decode())))
    names = [column.split(" ")[0] for column in table[0]]
    rows = [dict(zip(names, map(float, row))) for row in table[1:]]
    times = [row["t"] for row in rows]
    return [row for row in rows if times.count(row["t"]) == 1]


def close(got, want, size, tolerance):
    """NaN is close to nothing."""
    return abs(got - want) <= tolerance * size


def check_close(got, want, tolerance, what=""):
    """Values by name."""
    for name, value in want.items():
        assert close(got[name], value, 1 + abs(value), tolerance), (what, name, got[name], value, got[name] - value)


@contextlib.contextmanager
def refused(instance, *words):
    """What is done inside is answered by a message of an error with these words."""
    before = len(instance.messages)
    yield
    fresh = instance.messages[before:]
    assert any(status == 3 and all(word in text for word in words) for status, _, text in fresh), (words, fresh)


def judge(claim):
    """Its word in TAP, and notes."""
    try:
        claim()
    except unittest.SkipTest as reason:
        return "ok", f" # SKIP {reason}", ""
    except Exception:  # pylint: disable=broad-except
        return "not ok", "", traceback.format_exc()
    return "ok", "", ""


def run_claims(claims, silent=True):
    """Each claim is a function whose name says it. With `silent` it is the last one that FMUs have printed nothing."""
    real = os.dup(1)
    with tempfile.TemporaryFile() as printed:
        os.dup2(printed.fileno(), 1)
        os.dup2(printed.fileno(), 2)
        lines = []
        for claim in claims:
            lines.append((claim.__name__.replace("_", " "), *judge(claim)))
        sys.stdout.flush()
        printed.seek(0)
        said = printed.read().decode(errors="replace")
    if silent:
        lines.append(("nothing is printed", "not ok" if said else "ok", "", said))
    for number, (words, verdict, skipped, notes) in enumerate(lines, 1):
        notes = "".join(f"# {line}\n" for line in notes.splitlines())
        os.write(real, f"{notes}{verdict} {number} - {words}{skipped}\n".encode())
    os.write(real, f"1..{len(lines)}\n".encode())
    FOLDER.cleanup()
    return any(verdict != "ok" for _, verdict, _, _ in lines)
