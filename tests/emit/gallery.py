#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: gallery.py FBD_RUN STATES [MODEL...]: each model of the gallery as C. It is compiled without a warning, has
the library's accelerations at the start and at random states to 2 ulp, and ends where fbd-run ends."""
import json
import math
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

fbd_run, states = sys.argv[1:3]
root = Path(os.environ["FBD_SOURCE_ROOT"])
tolerance = "1e-12"
flags = ["-std=c17", os.environ.get("EMIT_OPTIMIZE", "-O1"), "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic",
         "-Werror"]
compiler = os.environ.get("CC", "cc").split()


def run(command, **more):
    return subprocess.run(command, capture_output=True, text=True, timeout=120, **more)


def ulps(a, b):
    if a == b:
        return 0.0
    return abs(a - b) / math.ulp(max(abs(a), abs(b)))


def accelerations(model, program):
    """The largest difference, in ulp of the largest acceleration and of each."""
    lines = run([states, str(model), "20"]).stdout.splitlines()
    asked, wanted = lines[::2], lines[1::2]
    got = run([program, "at"], input="\n".join(asked) + "\n")
    answers = got.stdout.splitlines()
    if len(answers) != len(asked):
        return [f"{len(answers)} answers to {len(asked)} states: {got.stderr.strip()[:200]}"]
    worst, where = 0.0, ""
    for state, right, answer in zip(asked, wanted, answers):
        for a, b in zip(map(float, right.split()), map(float, answer.split())):
            difference = ulps(a, b)
            if not difference <= worst:
                worst, where = difference, f"at {state}: {right} and {answer}"
    return [f"{worst:.3g} ulp {where}"] if not worst <= 2 else []


def numbers(final, prefix=""):
    for key, value in final.items():
        if isinstance(value, dict):
            yield from numbers(value, f"{prefix}{key}.")
        else:
            yield prefix + key, value


def ends(model, program):
    right = run([fbd_run, "--tolerance", tolerance, "--json", "-", str(model)])
    got = run([program])
    if (right.returncode == 0) != (got.returncode == 0):
        return [f"fbd-run ends with {right.returncode}, the program with {got.returncode}: {got.stderr.strip()[:200]}"]
    result = json.loads(right.stdout)
    if right.returncode:
        result["final"] = {"t": result["final"]["t"]}
    own = {line.rsplit(" [", 1)[0]: float(line.rsplit(" ", 1)[1]) for line in got.stdout.splitlines() if "] " in line}
    faults = []
    for name, value in numbers(result["final"]):
        if value is None or name not in own:
            faults.append(f"no {name}")
        elif not abs(own[name] - value) <= 1e-6 * max(1, abs(value)):
            faults.append(f"{name} {value} and {own[name]}")
    return faults


def one(model, folder):
    name = str(model.relative_to(root / "models"))
    source, program = folder / (model.stem + model.parent.name + ".c"), folder / (model.stem + model.parent.name)
    written = run([fbd_run, "--tolerance", tolerance, "--emit-c", str(source), str(model)])
    if written.returncode == 3:
        return name, "refused", [line for line in written.stderr.splitlines() if "error" in line][:1]
    if written.returncode:
        return name, "failed", [written.stderr]
    built = run(compiler + flags + [str(source), "-o", str(program), "-lgsl", "-lgslcblas", "-lm"])
    if built.returncode:
        return name, "failed", [built.stderr[:600]]
    try:
        faults = accelerations(model, str(program)) + ends(model, str(program))
    except subprocess.TimeoutExpired as late:
        faults = [str(late)[-80:]]
    return name, "failed" if faults else "taken", faults


models = [Path(name) for name in sys.argv[3:]] or sorted((root / "models").rglob("*.yaml"))
with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
    counts = {}
    for name, verdict, faults in pool.map(lambda model: one(model.resolve(), Path(folder)), models):
        counts[verdict] = counts.get(verdict, 0) + 1
        if verdict != "taken":
            print(f"# {name}: {verdict}", *faults, sep="\n#   ")
print(counts)
