#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: gallery.py FBD_RUN STATES [--all | MODEL... | --drawn CROSS_CHECK FIRST COUNT]: models of the gallery as C. Each
is compiled without a warning, has the library's accelerations at the start and at random states to 2 ulp, and ends
where fbd-run ends; what is refused is what has loops, contacts, tables or motion along switches. Without --all some are
compiled, and all written. With --drawn the random scenes of `cross_check` with these seeds, as far as they can be
written. Prints TAP."""
import json
import math
import os
import re
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, os.path.join(os.environ["FBD_SOURCE_ROOT"], "tests", "tools"))
import limits  # pylint: disable=wrong-import-position

fbd_run, states, *chosen = sys.argv[1:]
root = Path(os.environ["FBD_SOURCE_ROOT"])
tolerance = "1e-12"
# What is compiled has no sanitizer in it: beside one a third of it is.
EVERY = 3 if os.environ.get("FBD_THOROUGH") == "no" else 1
# One for each thing that is written: all of them are compiled by hand, with --all.
QUICK = """kinetics/incline kinetics/falling_with_drag hard/coupled_friction hard/stribeck_belt hard/oscillating_surface
hard/not_a_number_beyond energy/cubic_spring_potential energy/two_bodies forcing/pulse_train plane/rod_with_jet plane/gust
plane/two_springs_off_axis rotation/bearing_friction rotation/compound_pendulum trees/block_on_wedge
trees/chain_of_ten_rods trees/elastic_pendulum trees/shaken_pendulum trees/cart_and_pendulum hard/quiet_end""".split()
# Switches along which a motion may slide.
SLIDES = {"hard/chatter", "hard/switched_attraction", "hard/zeno_stop"}
# What happens and is undone within a step; friction whose limit falls to zero where nothing pushes.
BLOCK = """fbd: 1
title: A block that rubs
bodies:
  block:
    mass: 2 kg
    motion: slide
    initial: {v: %s}
    forces:
      - gravity
      - normal
      - friction: {%s}
simulate: {until: 10 s}
"""
BLOCKS = {
    "shaken": ("0.6 m/s", "static: 3.15, kinetic: 0.2, surface_speed: \"0.6[m/s]*cos(1500[rad/s]*t)\""),
    "fading": ("0 m/s", "coefficient: \"0.44*max(0, cos(4.9[rad/s]*t))\""),
}
# A spring from a centre of mass to a point of another body, and a damper the other way round.
LEASHED = """fbd: 1
title: Two that are leashed
bodies:
  arm: {mass: 1.4 kg, inertia: 0.6 kg*m^2, center: [0.1 m, -0.4 m], motion: pivot, initial: {theta: 50 deg}, forces: [gravity]}
  dog: {mass: 0.8 kg, inertia: 0.1 kg*m^2, center: [0.2 m, 0.1 m], points: {P: [-0.3 m, 0.2 m]}, motion: {planar: {on: arm}}}
couplings:
  - spring: {between: [arm, dog.P], stiffness: 30 N/m, free_length: 0.2 m}
  - damper: {between: [dog.P, arm], coefficient: 2 N*s/m}
simulate: {until: 1 s}
"""
flags = ["-std=c17", "-O1", "-ffp-contract=off", "-Wall", "-Wextra", "-Wpedantic",
         "-Werror"]
compiler = os.environ.get("CC", "cc").split()


def run(command, **more):
    return limits.run(command, 120, capture_output=True, text=True, **more)


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
    bound = max(1e-6, 1e-9 * result["final"]["t"])  # errors of a period add up
    for name, value in numbers(result["final"]):
        if value is None or name not in own:
            faults.append(f"no {name}")
        elif not abs(own[name] - value) <= bound * max(1, abs(value)):
            faults.append(f"{name} {value} and {own[name]}")
    return faults


def write(model, folder):
    """The program of a model, or the reasons why there is none."""
    gallery = root / "models"
    name = str(model.relative_to(gallery).with_suffix("")) if gallery in model.parents else model.stem
    source = folder / (name.replace("/", "_") + ".c")
    done = run([fbd_run, "--tolerance", tolerance, "--emit-c", str(source), str(model)])
    reasons = [line for line in done.stderr.splitlines() if "[cannot-emit]" in line]
    if done.returncode == 0:
        return name, source, []
    refused = done.returncode == 3 and reasons and not source.exists()
    return name, None, reasons if refused else [f"exit code {done.returncode}: {done.stderr}"]


def missing(name, text):
    """What of a model is not written, as its text has it; "" for one that is taken."""
    new = re.search(r"^(states|inputs):|\b(track|distributed|thrust): ", text, re.MULTILINE)
    if new:
        return new[1] or new[2]
    if re.search(r"{.*\b(from|until): [^,}]*[<>]", re.split(r"\n(?:couplings|simulate):", text)[0]):
        return "begins or ends"
    if re.search(r"\b(value|fx|fy): .*\.(v_dot|omega_dot|ax|ay)\b", text):
        return "names its acceleration"
    if re.search(r"\bfriction: {.*\bbearing: ", text):
        return "friction that depends on the reaction"
    couplings = text.partition("\ncouplings:")[2].partition("\nsimulate:")[0].partition("\ncontacts:")[0]
    if "plane_friction:" in couplings:
        return "friction on a plane"
    kind = re.search(r"\b(pin|weld|rod|rope|belt|gear|rack|ratio|roll|slot):", couplings)
    if kind and "around:" in couplings:
        return "a drum"
    if kind:
        return kind[1] if kind[1] != "roll" else "rolling"
    if "\ncontacts:" in text:
        return "contacts"
    if re.search(r"\bmass: 0(?= kg|$)", text, re.MULTILINE):
        return "without mass"
    if "\ntables:" in text:
        return "tables"
    return "along a switch" if name in SLIDES else ""


def compare(name, source, model):
    program = source.with_suffix("")
    built = run(compiler + flags + [str(source), "-o", str(program), "-lgsl", "-lgslcblas", "-lm"])
    if built.returncode:
        return [built.stderr[:2000]]
    return accelerations(model, str(program)) + ends(model, str(program))


def parameters_of(text):
    block = text.partition("\nparameters:")[2].partition("\nbodies:")[0]
    return set(re.findall(r"(\w+):", block))


def start_of(program):
    return run([program, "rows"]).stdout.splitlines()[1:2]


def vary(name, source, model):
    """The program with other values of its parameters against that of the file with these values."""
    text, settings, other = source.read_text(encoding="utf-8"), [], []
    known = parameters_of(model.read_text(encoding="utf-8"))
    begin, end = text.index("static void set_parameters("), text.index("static void derive(")
    setting = text[begin:end]
    for parameter, value in re.findall(r"    p->(\w+) = (-?[\d.e+-]+);\n", setting):
        if parameter not in known:
            continue
        changed = float(value) * 1.0625 or 0.015625
        settings += ["--set", f"{parameter}={changed!r}"]
        setting = setting.replace(f"    p->{parameter} = {value};\n", f"    p->{parameter} = {changed!r};\n")
    if not settings:
        return []
    edited, given = source.with_name("edited_" + source.name), source.with_name("given_" + source.name)
    edited.write_text(text[:begin] + setting + text[end:], encoding="utf-8")
    done = run([fbd_run, "--tolerance", tolerance, *settings, "--emit-c", str(given), str(model)])
    if done.returncode:
        return []  # no scene of its own
    for file in (edited, given):
        built = run(compiler + flags + [str(file), "-o", str(file.with_suffix("")), "-lgsl", "-lgslcblas", "-lm"])
        if built.returncode:
            return [built.stderr[:2000]]
    asked = "\n".join(run([states, str(model), "20"]).stdout.splitlines()[::2]) + "\n"
    answers = [(run([str(file.with_suffix("")), "at"], input=asked).stdout, start_of(str(file.with_suffix(""))))
               for file in (edited, given)]
    for edited_line, given_line in zip(answers[0][0].splitlines(), answers[1][0].splitlines()):
        if edited_line != given_line:
            other = [f"{' '.join(settings)}: {given_line} and {edited_line}"]
    if answers[0][1] != answers[1][1]:
        other.append(f"starts at {answers[1][1]} and {answers[0][1]}")
    return other


count = bad = 0


def claim(fact, words, details=()):
    global count, bad
    count += 1
    bad += not fact
    print(f"{'ok' if fact else 'not ok'} {count} - {words}")
    for line in () if fact else "\n".join(details).splitlines():
        print(f"#   {line}")


def draw(cross_check, first, number, folder):
    """Random scenes, each a file that its seed names."""
    models = []
    for seed in range(first, first + number):
        text = run([cross_check, "--show", str(seed)]).stdout
        if not missing("", text):
            models.append(folder / f"scene_{seed}.yaml")
            models[-1].write_text(text, encoding="utf-8")
    return models


def own_scenes(folder):
    """What random scenes have not, each a file."""
    texts = {name: BLOCK % numbers for name, numbers in BLOCKS.items()} | {"leashed": LEASHED}
    for name, text in texts.items():
        (folder / f"{name}.yaml").write_text(text, encoding="utf-8")
    return [folder / f"{name}.yaml" for name in texts]


def compare_all(pool, compared, varied):
    compared, varied = compared[::EVERY], varied[::EVERY]
    for (name, _, _), faults in zip(compared, pool.map(lambda each: compare(*each), compared)):
        claim(not faults, f"{name} as C: accelerations and end", faults)
    for (name, _, _), faults in zip(varied, pool.map(lambda each: vary(*each), varied)):
        claim(not faults, f"{name} as C with other values of its parameters", faults)


def check_drawn(folder, pool, cross_check, first, number):
    own = own_scenes(folder)
    models = draw(cross_check, int(first), int(number), folder) + own
    compared = [(*entry[:2], model) for model in models for entry in [write(model, folder)] if entry[1]]
    drawn = len(compared) - len(own)
    claim(drawn * 20 >= int(number), f"{drawn} of {number} random scenes are written")
    compare_all(pool, compared, compared[::4])


def check_models(folder, pool):
    models = sorted((root / "models").rglob("*.yaml"))
    if chosen and chosen != ["--all"]:
        models = [Path(name).resolve() for name in chosen]
    taken = 0
    written = list(pool.map(lambda model: write(model, folder), models))
    compared = []
    for (name, source, reasons), model in zip(written, models):
        lacks = missing(name, model.read_text(encoding="utf-8"))
        taken += source is not None
        if lacks:
            claim(source is None and any(lacks in reason for reason in reasons), f"{name} is refused: {lacks}", reasons)
        elif source is None:
            claim(False, f"{name} is written", reasons)
        elif chosen or name in QUICK:
            compared.append((name, source, model))
    compare_all(pool, compared, compared if chosen else compared[::4])
    print(f"# {taken} of {len(models)} models are written")


def main():
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as pool:
        if chosen[:1] == ["--drawn"]:
            cross_check, first, number = chosen[1:]
            check_drawn(Path(folder), pool, cross_check, first, int(number) * int(os.environ.get("FBD_DRAWS", "1")))
        else:
            check_models(Path(folder), pool)
    print(f"1..{count}")
    sys.exit(bad > 0)


main()
