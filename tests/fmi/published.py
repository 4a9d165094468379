#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: published.py: FMUs of all models against what is published of the standard, and driven by FMPy. None of that is
part of this project, nor this of `make test`; what is not there is skipped. FBD_FMI_3 and FBD_FMI_2 name folders with `headers` and `schema` of the
standard (github.com/modelica/fmi-standard, v3.0.2 and v2.0.5), PYTHONPATH may lead to FMPy. Prints TAP."""
import os
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

from fmu import Fmu, OK, make_fmu
from claims_of_fmus import FOLDER, MODELS, close, run_claims, run_csv, run_json

SOURCES = Path(os.environ["FBD_SOURCE_ROOT"]) / "lib"
# Runs that fail, as they should.
FAILING = {"not_a_number_beyond.yaml", "singular_reached.yaml"}


def published(version):
    place = os.environ.get(f"FBD_FMI_{version}")
    if not place:
        raise unittest.SkipTest(f"FBD_FMI_{version} names no folder of the standard")
    return Path(place)


def models():
    return [path for path in sorted(MODELS.rglob("*.yaml")) if path.name not in FAILING]


def the_binary_compiles_with_the_published_headers():
    include = [word for version in (2, 3) for word in ("-I", published(version) / "headers")]
    for source in sorted((SOURCES / "fmi").glob("fmi[23]*.c")):
        subprocess.run([*os.environ.get("CC", "cc").split(), "-std=c17", "-D_POSIX_C_SOURCE=200809L", "-DFBD_FMI_HEADERS",
                        "-DFBD_VERSION=\"\"", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", "-I", SOURCES, *include,
                        source], check=True)


def validate(version):
    schema = published(version) / "schema" / f"fmi{version}ModelDescription.xsd"
    with tempfile.TemporaryDirectory() as folder:
        files = []
        for number, model in enumerate(models()):
            fmu = make_fmu(model, f"{folder}/{number}.fmu", "--fmu-version", version)
            with zipfile.ZipFile(fmu) as archive:
                files.append(f"{folder}/{number}.xml")
                Path(files[-1]).write_bytes(archive.read("modelDescription.xml"))
            os.remove(fmu)
        subprocess.run(["xmllint", "--noout", "--schema", schema, *files], check=True)


def descriptions_are_valid_by_the_schema_of_FMI_3():
    validate(3)


def descriptions_are_valid_by_the_schema_of_FMI_2():
    validate(2)


def built(version, folder):
    """The binary of an FMU compiled from its sources alone."""
    path = make_fmu(MODELS / "kinetics/incline.yaml", f"{folder}/one{version}.fmu", "--fmu-version", version)
    subprocess.run([SOURCES.parent / "packaging/fmu-sources", path], check=True)
    fmu = Fmu(path, f"{folder}/unpacked{version}", load=False)
    sources = Path(fmu.folder) / "sources"
    if version == 3:
        names = [one.get("name") for one in ElementTree.parse(sources / "buildDescription.xml").iter("SourceFile")]
    else:
        names = [one.get("name") for one in fmu.co_simulation.iter("File")]
    os.remove(fmu.binary)
    subprocess.run([*os.environ.get("CC", "cc").split(), "-std=c17", "-w", "-fPIC", "-fvisibility=hidden", "-ffp-contract=off", "-shared",
                    "-I.", *names, "-o", fmu.binary, "-lgsl", "-lgslcblas", "-lyaml", "-lm", "-Wl,-z,defs"], cwd=sources, check=True)
    return fmu


def sources_of_an_FMU_make_its_binary():
    rows = run_csv("kinetics/incline.yaml", "--every", 0.3)
    for version in (2, 3):
        with tempfile.TemporaryDirectory() as folder:
            fmu = built(version, folder)
            if version == 3:
                schema = published(3) / "schema" / "fmi3BuildDescription.xsd"
                subprocess.run(["xmllint", "--noout", "--schema", schema, f"{fmu.folder}/sources/buildDescription.xml"], check=True)
            else:
                schema = published(2) / "schema" / "fmi2ModelDescription.xsd"
                subprocess.run(["xmllint", "--noout", "--schema", schema, f"{fmu.folder}/modelDescription.xml"], check=True)
            fmu.load()
            instance = fmu.open()
            for row in rows[1:]:
                assert instance.go_to(row["t"])[0] == OK
                got = instance.get()
                assert all(close(got[name], row[name], 1, 1e-12) for name in set(got) & set(row)), (got, row)
            instance.free()


def compare(result, rows, events, until):
    """Where both have a row at the same time, to the rounding of times; at an event one may have the state before it."""
    size = {name: max(abs(row[name]) for row in rows) + 1e-300 for name in rows[0]}
    times, compared = list(result["time"]), 0
    for row in rows:
        found = [k for k, t in enumerate(times) if abs(t - row["t"]) <= 1e-12 * until]
        if len(found) != 1:
            continue
        event = any(abs(t - row["t"]) <= 1e-12 * until for t in events)
        compared += 1
        for name in set(result.dtype.names) & set(row):
            assert event or close(result[name][found[0]], row[name], size[name], 1e-9), (row["t"], name, result[name], row[name])
    assert compared > 5, compared


def imported():
    try:
        import fmpy  # pylint: disable=import-outside-toplevel
        import fmpy.validation  # pylint: disable=import-outside-toplevel
        import lark  # pylint: disable=import-outside-toplevel,unused-import
    except ImportError as error:
        raise unittest.SkipTest(f"FMPy is not installed: {error}") from error
    return fmpy


def drive(version):
    fmpy = imported()
    for model in models():
        path = make_fmu(model, str(Path(FOLDER.name) / "one.fmu"), "--fmu-version", version)
        problems = fmpy.validation.validate_fmu(path)
        assert not problems, (model, problems)
        until = float(fmpy.read_model_description(path).defaultExperiment.stopTime)
        result = fmpy.simulate_fmu(path, fmi_type="CoSimulation", stop_time=until, output_interval=until / 20)
        events = [event["t"] for event in run_json(str(model))["events"]]
        compare(result, run_csv(str(model), "--every", repr(until / 20)), events, until)


def FMPy_drives_FMI_3():
    drive(3)


def FMPy_drives_FMI_2():
    drive(2)


def FMPy_integrates_by_model_exchange():
    """By its forward Euler, which is all Python: its errors fall with the step, past friction, impacts and a rope too."""
    fmpy = imported()
    for model, until in (("kinetics/incline.yaml", 3), ("contact/bouncing_ball.yaml", 1.5), ("trees/double_pendulum.yaml", 0.5),
                         ("hard/stick_slip_belt.yaml", 2), ("couplings/rope_pendulum.yaml", 1), ("couplings/four_bar.yaml", 0.5)):
        want = run_csv(model, "--until", until, "--every", until)[-1]
        for version in (2, 3):
            path = make_fmu(MODELS / model, str(Path(FOLDER.name) / "one.fmu"), "--fmu-version", version)
            errors = []
            for steps in (400, 1600):
                result = fmpy.simulate_fmu(path, fmi_type="ModelExchange", solver="Euler", stop_time=until,
                                           step_size=until / steps, output_interval=until / steps)
                assert close(result["time"][-1], until, until, 1e-12)
                errors.append(max(abs(result[name][-1] - want[name]) for name in set(result.dtype.names) & set(want)))
            assert errors[1] < errors[0] / 3, (model, version, errors)


CLAIMS = [the_binary_compiles_with_the_published_headers, descriptions_are_valid_by_the_schema_of_FMI_3,
          descriptions_are_valid_by_the_schema_of_FMI_2, sources_of_an_FMU_make_its_binary, FMPy_drives_FMI_3, FMPy_drives_FMI_2, FMPy_integrates_by_model_exchange]

sys.exit(run_claims(CLAIMS, silent=False))
