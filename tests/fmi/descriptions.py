#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Usage: descriptions.py: what is in an FMU, and what fbd-run --fmu refuses. Prints TAP."""
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
import zipfile
from pathlib import Path

from fmu import OK, RUN, Fmu, make_fmu
from claims_of_fmus import FOLDER, MODELS, STICKS, check_close, close, fmu_of, place, run_claims, run_csv

NAMED = """fbd: 1
title: "Names & <signs> that \\"XML\\" minds: größer"
units: US
parameters: {w: 64.4 lbf, m: w/g, alpha: 30 deg, n: 3}
inputs: {push: {value: 2 lbf, description: "<to> the \\"right\\" & back"}}
bodies:
  sled: {mass: m, motion: {slide: {along: alpha}}, forces: [gravity, applied: {value: n*push}]}
  wheel:
    motion: {pivot: {at: [0, 0]}}
    inertia: {about: G, value: 2 slug*ft^2}
    mass: 1 slug
    moments: [applied: {value: "push*1[ft]"}]
simulate: {until: 2 s}
"""
# FMI 3.0.2, appendix: fmi3Functions.h; FMI 2.0.5: fmi2Functions.h.
TYPES = ["Float32", "Float64", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64", "Boolean", "String",
         "Binary", "Clock", "IntervalDecimal", "IntervalFraction", "ShiftDecimal", "ShiftFraction", "ContinuousStates", "FMUState"]
FUNCTIONS_3 = {"fmi3" + name for name in """
    GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation InstantiateScheduledExecution FreeInstance
    EnterInitializationMode ExitInitializationMode EnterEventMode Terminate Reset GetNumberOfVariableDependencies
    GetVariableDependencies FreeFMUState SerializedFMUStateSize SerializeFMUState DeserializeFMUState
    GetDirectionalDerivative GetAdjointDerivative EnterConfigurationMode ExitConfigurationMode EvaluateDiscreteStates
    UpdateDiscreteStates EnterContinuousTimeMode CompletedIntegratorStep SetTime GetContinuousStateDerivatives
    GetEventIndicators GetNominalsOfContinuousStates GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode
    GetOutputDerivatives DoStep ActivateModelPartition""".split() + [way + kind for kind in TYPES for way in ("Get", "Set")]}
FUNCTIONS_2 = {"fmi2" + name for name in """
    GetTypesPlatform GetVersion SetDebugLogging Instantiate FreeInstance SetupExperiment EnterInitializationMode
    ExitInitializationMode Terminate Reset GetReal GetInteger GetBoolean GetString SetReal SetInteger SetBoolean SetString
    GetFMUstate SetFMUstate FreeFMUstate SerializedFMUstateSize SerializeFMUstate DeSerializeFMUstate
    GetDirectionalDerivative SetRealInputDerivatives GetRealOutputDerivatives DoStep CancelStep GetStatus GetRealStatus
    GetIntegerStatus GetBooleanStatus GetStringStatus EnterEventMode NewDiscreteStates EnterContinuousTimeMode
    CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStates GetDerivatives GetEventIndicators
    GetNominalsOfContinuousStates""".split()}


def fails(code, *arguments, words=""):
    done = subprocess.run([RUN, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    said = done.stderr.decode()
    assert done.returncode == code and words in said and said, (arguments, done.returncode, said)
    assert not done.stdout


def an_archive_has_its_files():
    for version in (2, 3):
        fmu = fmu_of("data/measured_push.yaml", version)
        machine = "linux64" if version == 2 else f"{os.uname().machine}-linux"
        assert set(fmu.names) == {"modelDescription.xml", f"binaries/{machine}/{fmu.identifier}.so", "resources/model.yaml",
                                  "resources/settings", "resources/tables/F", "documentation/index.html",
                                  *(f"documentation/licenses/{name}.txt" for name in ("license", "gpl-3.0", "libyaml"))}
        source = MODELS / "data/measured_push"
        inside = Path(fmu.resources)
        assert (inside / "model.yaml").read_bytes() == source.with_suffix(".yaml").read_bytes()
        assert (inside / "tables/F").read_bytes() == source.with_suffix(".csv").read_bytes()
        license_text = (inside / "../documentation/licenses/license.txt").read_text(encoding="utf-8")
        assert "GPL-3.0-or-later" in license_text and fmu.xml.get("license") == "GPL-3.0-or-later"
        text = (inside / "../documentation/licenses/gpl-3.0.txt").read_bytes()
        assert text == (MODELS / "../LICENSE").read_bytes() and b"GNU GENERAL PUBLIC LICENSE" in text
        again = Path(FOLDER.name) / "again.fmu"
        for target in (again, "-"):
            with open(Path(FOLDER.name) / "stdout", "wb") as out:
                subprocess.run([RUN, "--fmu", target, "--fmu-version", str(version), place("data/measured_push.yaml")],
                               stdout=out, check=True)
        assert (Path(FOLDER.name) / "stdout").read_bytes() == again.read_bytes()
        with zipfile.ZipFile(again) as archive:
            assert archive.testzip() is None and all(one.extract_version <= 20 for one in archive.infolist())
            deflated = [one for one in archive.infolist() if one.compress_type == zipfile.ZIP_DEFLATED]
            assert [one.filename[:9] for one in deflated] == ["binaries/"]
            assert deflated[0].compress_size < 0.6 * deflated[0].file_size


def the_binary_shows_the_functions_of_the_standard_and_needs_the_C_library():
    binary = fmu_of(NAMED, 3).binary
    said = subprocess.run(["nm", "-D", "--defined-only", binary], stdout=subprocess.PIPE, check=True, text=True).stdout
    assert {line.split()[2] for line in said.splitlines()} == FUNCTIONS_2 | FUNCTIONS_3
    said = subprocess.run(["nm", "-D", "--undefined-only", binary], stdout=subprocess.PIPE, check=True, text=True).stdout
    needs = {tuple(map(int, version.split("."))) for version in re.findall(r"@GLIBC_([\d.]+)", said)}
    if os.uname().machine == "x86_64":
        assert needs and max(needs) <= (2, 28), (max(needs), "it asks for a newer C library than it needs")
    said = subprocess.run(["readelf", "-d", binary], stdout=subprocess.PIPE, check=True, text=True).stdout
    assert set(re.findall(r"NEEDED.*\[(\w+)", said)) <= {"libc", "libm", "ld"}, said
    assert "RPATH" not in said and "RUNPATH" not in said and "TEXTREL" not in said


def variables_are_those_of_the_model():
    for version in (2, 3):
        fmu = fmu_of(NAMED, version)
        found = {name: (one.causality, one.unit) for name, one in fmu.variables.items()}
        want = {
            "time": ("independent", "s"), "w": ("parameter", "lbf"), "m": ("calculatedParameter", "slug"),
            "alpha": ("parameter", ""), "n": ("parameter", ""), "push": ("input", "lbf"),
            "sled.x": ("output", "ft"), "sled.v": ("output", "ft/s"), "sled.v_dot": ("output", "ft/s^2"),
            "wheel.theta": ("output", "rad"), "wheel.omega": ("output", "rad/s"), "wheel.omega_dot": ("output", "rad/s^2"),
            "sled.gravity": ("local", "lbf"), "sled.applied": ("local", "lbf"), "wheel.applied": ("local", "lbf*ft"),
            "wheel.pin.x": ("local", "lbf"), "wheel.pin.y": ("local", "lbf"),
            "energy.kinetic": ("local", "ft*lbf"), "energy.potential": ("local", "ft*lbf")}
        assert found == want, found
        assert fmu.variables["push"].description == '<to> the "right" & back'
        assert fmu.xml.get("description") == 'Names & <signs> that "XML" minds: größer'
        starts = {name: float(one.start) for name, one in fmu.variables.items() if one.start}
        assert set(starts) == {"w", "alpha", "n", "push"} and close(starts["alpha"], 0.5235987755982988, 1, 0)
        instance = fmu.open()
        assert instance.get(list(starts)) == starts
        instance.free()


BASES = {"kg", "m", "s", "rad"}
FACTORS = {"lbf": 4.4482216152605, "slug": 14.593902937206364, "ft": 0.3048, "ft/s": 0.3048, "ft/s^2": 0.3048, "lbf*ft": 1.3558179483314003, "ft*lbf": 1.3558179483314003}


def units_have_their_dimension_and_size():
    for version in (2, 3):
        fmu = fmu_of(NAMED, version)
        units = {one.get("name"): one.find("BaseUnit").attrib for one in fmu.xml.find("UnitDefinitions")}
        shown = {one.get("name"): one.find("DisplayUnit").attrib for one in fmu.xml.find("UnitDefinitions")
                 if one.find("DisplayUnit") is not None}
        assert {name: one["name"] for name, one in shown.items()} == {"rad": "deg", "rad/s": "deg/s", "rad/s^2": "deg/s^2"}
        assert all(close(math.radians(float(one["factor"])), 1, 1, 1e-15) for one in shown.values())
        assert {one.display for one in fmu.variables.values() if one.unit.startswith("rad")} == {"deg", "deg/s", "deg/s^2"}
        assert set(units) == {one.unit for one in fmu.variables.values()} - {""}
        dimension = {name: {k: int(v) for k, v in base.items() if k in BASES} for name, base in units.items()}
        assert dimension["lbf"] == {"kg": 1, "m": 1, "s": -2} and dimension["rad/s^2"] == {"rad": 1, "s": -2}
        assert dimension["ft/s"] == {"m": 1, "s": -1} and dimension["slug"] == {"kg": 1}
        for name, base in units.items():
            want = FACTORS.get(name, 1)
            assert close(float(base.get("factor", 1)), want, want, 1e-12), (name, base)


TWICE = """fbd: 1
parameters: {time: 2 N}
bodies: {block: {mass: 1 kg, motion: slide, forces: [applied: time]}}
simulate: {until: 1 s}
"""


def the_structure_lists_what_the_standard_asks_for():
    for version in (2, 3):
        for model in (NAMED, "trees/double_pendulum.yaml", "couplings/driven_slider_crank.yaml"):
            fmu = fmu_of(model, version)
            listed = {"outputs": [], "derivatives": [], "initial": []}
            order = list(fmu.variables)
            by_reference = {one.reference: name for name, one in fmu.variables.items()}
            assert len(by_reference) == len(order)
            for element in fmu.xml.find("ModelStructure").iter():
                reference, index = element.get("valueReference"), element.get("index")
                if reference is None and index is None:
                    group = element.tag
                    continue
                name = by_reference[int(reference)] if version == 3 else order[int(index) - 1]
                kind = {"Output": "outputs", "Outputs": "outputs", "ContinuousStateDerivative": "derivatives",
                        "Derivatives": "derivatives", "InitialUnknown": "initial", "InitialUnknowns": "initial"}[
                            element.tag if version == 3 else group]
                listed[kind].append(name)
            calculated = [one.name for one in fmu.variables.values() if one.causality == "calculatedParameter"]
            assert listed["outputs"] == fmu.outputs
            assert sorted(listed["initial"]) == sorted(fmu.outputs + calculated)
            rates = [one.name for one in fmu.variables.values() if one.derivative]
            assert listed["derivatives"] == rates and fmu.xml.find("ModelExchange") is not None
            for name in rates:
                number = int(fmu.variables[name].derivative)
                state = by_reference[number] if version == 3 else order[number - 1]
                assert state.split(".")[0] == name.split(".")[0] and fmu.variables[state].unit + "/s" in (
                    fmu.variables[name].unit, fmu.variables[name].unit.replace("/s^2", "/s/s"))


def forces_are_variables_and_outputs_where_they_are_chosen():
    """By the names and values of a CSV with ledger, at the start and on the way, in both interfaces."""
    chosen = ["block.friction", "bob.pin.x", "bob.gravity"]
    for version in (2, 3):
        fmu = fmu_of(STICKS, version, "--fmu-outputs", ",".join(chosen))
        assert sorted(fmu.outputs[-3:]) == sorted(chosen) and not fmu.has_derivatives
        rows = run_csv(STICKS, "--ledger", "--every", 0.5, "--until", 1)
        local = [one.name for one in fmu.variables.values() if one.causality == "local" and "indicator" not in one.name]
        names = [name for name in rows[0] if name in fmu.variables]
        assert set(local) | set(chosen) <= set(names) and "block.normal" in local
        assert all(name in names or name.endswith(".work") or name.startswith("energy.") or name == "t" for name in rows[0])
        for exchange in (False, True):
            instance = fmu.open(exchange=exchange)
            check_close(instance.get(names), {name: rows[0][name] for name in names}, 1e-9)
            instance.free()
        instance = fmu.open()
        assert instance.go_to(1)[0] == OK
        check_close(instance.get(names), {name: rows[-1][name] for name in names}, 1e-7)
        instance.free()
    fails(2, "--fmu", Path(FOLDER.name) / "wrong.fmu", "--fmu-outputs", "block.fiction", place(STICKS), words="block.friction")
    fails(1, "--fmu", Path(FOLDER.name) / "twice.fmu", place(TWICE), words="`time`")
    fails(2, "--fmu-outputs", "block.friction", place(STICKS), words="--fmu")


def tokens_tell_models_apart():
    plain, other = fmu_of(NAMED, 3), fmu_of(NAMED, 3, "--set", "n=4")
    assert plain.token == fmu_of(NAMED, 2).token and plain.token != other.token
    assert re.fullmatch(r"\{[0-9A-F]{8}(-[0-9A-F]{4}){3}-[0-9A-F]{12}\}", plain.token)
    instance = other.open()
    assert instance.get(["n"]) == {"n": 4}
    instance.free()


def settings_go_along():
    arguments = ["--set", "w=10 lbf", "--set", "alpha=-20 deg", "--until", "0.75", "--tolerance", "1e-7", "--method", "rk8pd",
                 "--no-structure"]
    fmu = fmu_of(NAMED, 3, *arguments)
    experiment = fmu.xml.find("DefaultExperiment").attrib
    assert experiment == {"startTime": "0", "stopTime": "0.75", "tolerance": "1e-07"} or float(experiment["tolerance"]) == 1e-7
    assert float(experiment["stopTime"]) == 0.75
    assert float(fmu.variables["w"].start) == 10 and close(float(fmu.variables["alpha"].start), -0.3490658503988659, 1, 0)
    done = subprocess.run([RUN, "--quiet", "--csv", "-", "--every", "0.75", *arguments, place(NAMED)],
                          stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines()[-1].split(",")
    instance = fmu.open()
    assert instance.go_to(0.75)[0] == OK
    got = instance.get(["sled.x", "sled.v", "wheel.theta", "wheel.omega"])
    assert list(got.values()) == list(map(float, done[1:])), (got, done)
    instance.free()


def an_FMU_is_moved_and_its_table_goes_along():
    source = Path(FOLDER.name) / "source"
    shutil.copytree(MODELS / "data", source)
    target = Path(FOLDER.name) / "moved.fmu"
    other = source / "other.csv"
    other.write_text("t [ms],F [N]\n0,0\n10,100\n20,0\n", encoding="utf-8")
    subprocess.run([RUN, "--fmu", target, "--set", f"F={other}", source / "measured_push.yaml"], check=True)
    shutil.rmtree(source)
    instance = Fmu(target, Path(FOLDER.name) / "moved").open()
    assert instance.go_to(0.2)[0] == OK, instance.messages
    assert close(instance.get(["block.v"])["block.v"], 1 / 3, 1, 1e-9)
    instance.free()


def what_makes_no_sense_is_refused():
    model, target = place("forcing/pushed_oscillator.yaml"), Path(FOLDER.name) / "wrong.fmu"
    for arguments in (["--fmu-version", "1"], ["--fmu-version", "three"], ["--csv", "o.csv"], ["--accuracy", "1e-6"],
                      ["--error-bars"], ["--svg", "o.svg"], ["--at", "1"], ["--check"], ["--ledger"], ["--method", "nonsense"],
                      ["--until", "-1"], ["--tolerance", "2"]):
        fails(2, "--fmu", target, *arguments, model)
    fails(2, "--fmu-version", "2", model, words="--fmu")
    fails(2, "--fmu", model, model)
    fails(1, "--fmu", "/nowhere/o.fmu", model, words="cannot write")
    fails(3, "--fmu", target, "--set", "m=-1", model)
    fails(3, "--fmu", target, "--set", "nothing=3", model)
    fails(1, "--fmu", target, place("fbd: 1\nground: {lines: {floor: {through: [0, 0], along: 0 deg}}}\nbodies:\n  a: "
                                    "{shape: sphere, mass: 1 kg, radius: 1 m, motion: planar, initial: {y: 0.2 m}}\n"
                                    "contacts: [{between: [a, ground.floor]}]\nsimulate: {until: 1 s}\n"))
    assert not target.exists()


def sources_on_request_are_whole():
    """Each header that one includes is there, each file that the description lists, and only once."""
    tool = Path(os.environ["FBD_SOURCE_ROOT"]) / "packaging/fmu-sources"
    for version in (2, 3):
        path = make_fmu(place(NAMED), f"{FOLDER.name}/sources{version}.fmu", "--fmu-version", version)
        subprocess.run([tool, path], check=True)
        with zipfile.ZipFile(path) as archive:
            names = set(archive.namelist())
            root = ElementTree.fromstring(archive.read("sources/buildDescription.xml" if version == 3 else "modelDescription.xml"))
            texts = {name: archive.read(name).decode() for name in names if name.endswith((".c", ".h"))}
        listed = [element.get("name") for element in root.iter("SourceFile" if version == 3 else "File")]
        interfaces = 2 if version == 2 else 1
        assert sorted(listed) == sorted(interfaces * [name.removeprefix("sources/") for name in names if name.endswith(".c")])
        for name, text in texts.items():
            for header in re.findall(r'^#include "([^"]+)"', text, re.MULTILINE):
                assert "sources/" + header in names, (name, header)
        assert Fmu(path, f"{FOLDER.name}/with{version}").open().go_to(0.1)[0] == OK
        done = subprocess.run([tool, path], stderr=subprocess.PIPE, check=False, text=True)
        assert done.returncode == 1 and "already" in done.stderr


def binaries_of_other_machines_are_added():
    """Another FMU of the same model, as if made on another machine."""
    tool = Path(os.environ["FBD_SOURCE_ROOT"]) / "packaging/fmu-binaries"
    one, other, third = (make_fmu(place(scene), f"{FOLDER.name}/{name}.fmu")
                         for name, scene in (("one", NAMED), ("other", NAMED), ("third", NAMED + "# changed\n")))
    elsewhere = f"{FOLDER.name}/elsewhere.fmu"
    with zipfile.ZipFile(other) as archive, zipfile.ZipFile(elsewhere, "w") as moved:
        for name in archive.namelist():
            moved.writestr(name.replace("-linux", "-plan9"), archive.read(name))
    subprocess.run([tool, one, elsewhere], check=True)
    fmu = Fmu(one, f"{FOLDER.name}/of_two")
    assert len([name for name in fmu.names if name.startswith("binaries/")]) == 2 and len(set(fmu.names)) == len(fmu.names)
    assert fmu.open().go_to(0.1)[0] == OK
    done = subprocess.run([tool, one, third], stderr=subprocess.PIPE, check=False, text=True)
    assert done.returncode == 1 and "another model" in done.stderr


CLAIMS = [an_archive_has_its_files, the_binary_shows_the_functions_of_the_standard_and_needs_the_C_library,
          variables_are_those_of_the_model, units_have_their_dimension_and_size,
          the_structure_lists_what_the_standard_asks_for, forces_are_variables_and_outputs_where_they_are_chosen, tokens_tell_models_apart, settings_go_along,
          an_FMU_is_moved_and_its_table_goes_along, sources_on_request_are_whole, binaries_of_other_machines_are_added,
          what_makes_no_sense_is_refused]

sys.exit(run_claims(CLAIMS))
