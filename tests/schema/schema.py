#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The schema that fbd-run --schema writes: every model of the project is valid by it, every model that is wrong in its
structure is not, by two validators: python3-jsonschema, and ajv, by which editors see it. Prints TAP. Needs python3-yaml
and python3-jsonschema; without them the tests are skipped, and without node-ajv those by ajv are."""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import jsonschema
    import yaml
except ImportError as missing:
    print(f"1..0 # SKIP {missing.name} is not installed")
    sys.exit(0)

SOURCE = Path(os.environ["FBD_SOURCE_ROOT"])
RUN = os.environ["FBD_RUN"]

# What a schema can see. The rest takes units, expressions or the names of a file.
STRUCTURAL = {"unknown-key", "missing-key", "unknown-choice", "unknown-kind", "wrong-type", "missing-value", "conflicting-keys",
              "not-here"}

# Of these ids, what it cannot see, with the reason.
BEYOND = {
    "grading_reactions_some.yaml": "one of two words, or a list",
    "applied_without_angle.yaml": "needed unless the body slides or `value` is a pair",
    "distributed_without_direction.yaml": "needed unless the body slides",
    "cylinder_lying_without_length.yaml": "needed for this axis",
    "actuator_force_to_the_ground.yaml": "needed for a force only",
    "actuator_from_the_ground.yaml": "which end is the ground",
    "actuator_of_one_end.yaml": "how many ends it has",
    "actuator_on_a_particle.yaml": "how the body moves",
    "efficiency_of_a_planet.yaml": "how the body moves",
    "ratio_many.yaml": "on which bodies its bodies move",
    "ratio_redundant.yaml": "several ratios together",
    "ratio_without_motion.yaml": "several ratios together",
    "weld_ends.yaml": "how the bodies move, and several welds together",
    "actuator_turns_nothing.yaml": "how the bodies move",
    "surface_speed_of_a_motion.yaml": "a name in an expression",
    "surface_speed_that_jumps.yaml": "a function in an expression",
    "surface_speed_without_friction.yaml": "needed beside `surface_speed`",
    "reaction_in_a_force.yaml": "a name in an expression",
    "reaction_of_a_later_body.yaml": "a name in an expression",
    "reaction_of_a_pin_in_a_force.yaml": "a name in an expression",
    "until_of_a_belt.yaml": "what the kind of coupling allows",
    "plane_without_normal.yaml": "needed unless the plane is horizontal",
    "plane_of_varying_mass.yaml": "whether an expression varies",
    "plane_of_the_ground.yaml": "a word where names of bodies stand",
    "plane_on_a_particle.yaml": "how the body moves",
    "plane_with_open_weight.yaml": "two places of the file",
    "plane_at_list_of_names.yaml": "which words are names of points",
    "plane_points_names.yaml": "names",
    "plane_under_a_load.yaml": "two places of the file",
    "plane_on_each_other.yaml": "two places of the file",
    "plane_with_four_points.yaml": "the unknowns of equilibrium",
    "plane_points_of_a_particle.yaml": "how the body moves",
    "plane_that_tips.yaml": "the centre of mass",
    "plane_off_line.yaml": "the centre of mass",
    "plane_outside_the_triangle.yaml": "the centre of mass",
    "plane_points_in_line.yaml": "places of points",
    "plane_points_static.yaml": "two points of one body",
    "plane_static_and_linked.yaml": "several bodies together",
    "plane_and_static_bearing.yaml": "several frictions together",
    "plane_with_gravity.yaml": "needed in a vertical plane",
    "plane_with_directed_gravity.yaml": "needed in a vertical plane",
    "belt_without_tension.yaml": "needed where the axes keep their distance",
    "slot_roller_without_side.yaml": "needed beside `radius`",
    "slot_roller_that_rubs.yaml": "what excludes `radius`",
    "slot_without_range.yaml": "needed for a curve",
    "slot_curve_and_along.yaml": "of a straight slot, which is one without `y`",
    "slot_straight_closed.yaml": "of a curve, which is one with `y`",
    "slot_of_time.yaml": "its expression is read by fbd alone",
    "wound_without_radius.yaml": "needed unless the body is a disc",
    "spring_without_end.yaml": "needed unless the body slides",
    "around_no_drum.yaml": "how many places the rope has",
    "belt_with_two_tensions.yaml": "whether axes move",
    "mass_of_a_rate.yaml": "a name in an expression",
    "thrust_of_constant_mass.yaml": "whether an expression varies",
    "thrust_velocity_one_number.yaml": "one number is right on a slide",
    "thrust_without_angle.yaml": "needed unless the body slides",
    "distance_without_toward.yaml": "a name in an expression",
    "event_direction_against_sign.yaml": "a sign in an expression",
    "every_twice.yaml": "two places of the file",
    "inertia_about_no_pivot.yaml": "a word that the motion allows",
    "input_as_length.yaml": "a name in an expression",
    "input_drives.yaml": "a name in an expression",
    "output_points_twice.yaml": "two places of the file",
    "power_on_a_body.yaml": "what `on` says beside it",
    "rope_length_of_a_motion.yaml": "a name in an expression",
    "slip_outside_friction.yaml": "a name in an expression",
    "state_in_a_potential.yaml": "a name in an expression",
    "track_of_time.yaml": "a name in an expression",
    "track_start_by_another.yaml": "a name in an expression",
    "track_that_does_not_turn.yaml": "two places of the file",
    "wound_on_no_end.yaml": "names of the file",
}


class Loader(yaml.SafeLoader):
    """YAML 1.2 as editors read it: `no`, `on` and `010` are words, and only true and false are truth values."""


Loader.yaml_implicit_resolvers = {}
Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile("^(true|True|TRUE|false|False|FALSE)$"), list("tTfF"))
Loader.add_implicit_resolver("tag:yaml.org,2002:null", re.compile("^(~|null|Null|NULL|)$"), ["~", "n", "N", ""])
Loader.add_implicit_resolver("tag:yaml.org,2002:float",
                             re.compile(r"^[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?$"), list("-+0123456789."))


def load(path):
    return yaml.load(path.read_text(encoding="utf-8"), Loader)


def errors_of(validator, path):
    return list(validator.iter_errors(load(path)))


def documents(paths):
    """(path, document) of each file that is YAML and can be said in JSON."""
    for path in paths:
        try:
            document = load(path)
            json.dumps(document, allow_nan=False)
        except (ValueError, TypeError, yaml.YAMLError, RecursionError):
            continue
        yield path, document


def empty_lists(schema, place="#"):
    """Where a keyword that needs a member has none: validators refuse such a schema whole."""
    if isinstance(schema, dict):
        for key, value in schema.items():
            if key in ("enum", "anyOf", "allOf", "oneOf") and isinstance(value, list) and not value:
                yield f"{place}/{key}"
    for key, value in schema.items() if isinstance(schema, dict) else enumerate(schema) if isinstance(schema, list) else ():
        yield from empty_lists(value, f"{place}/{key}")


def by_ajv(text, checked):
    """What ajv says of each document, or None where it is not installed."""
    with tempfile.NamedTemporaryFile(suffix=".json") as file:
        file.write(text)
        file.flush()
        environment = {**os.environ, "NODE_PATH": os.environ.get("NODE_PATH", "/usr/share/nodejs")}
        try:
            done = subprocess.run(["node", SOURCE / "tests/schema/ajv.js", file.name], env=environment, check=False,
                                  input=json.dumps([document for _, document in checked]).encode(), capture_output=True)
        except FileNotFoundError:
            return None
    if done.returncode == 77:
        return None
    assert done.returncode == 0, done.stderr.decode()
    return json.loads(done.stdout)


def wrong_files():
    """The files of tests/bad whose first fault is one of structure."""
    for path in sorted((SOURCE / "tests/bad").glob("*.yaml")):
        expected = re.findall(r"^# expect: \S+ error ([a-z-]+): (.*)$", path.read_text(encoding="latin-1"),
                              re.MULTILINE)
        if expected and expected[0][0] in STRUCTURAL and path.name not in BEYOND:
            yield path, expected[0]


def check(number, name, faults):
    for fault in faults:
        print(f"# {fault}")
    print(f"{'not ' if faults else ''}ok {number} - {name}")


def main():
    text = subprocess.run([RUN, "--schema"], stdout=subprocess.PIPE, check=True).stdout
    schema = json.loads(text)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    print("1..6")
    print(f"# {len(text)} bytes")

    models = sorted((SOURCE / "models").rglob("*.yaml"))
    faults = [f"{path.relative_to(SOURCE)}: {error.message[:200]}"
              for path in models for error in errors_of(validator, path)[:1]]
    check(1, f"{len(models)} models are valid", faults if models else ["there are none"])

    wrong = list(wrong_files())
    faults = [f"{path.name}: {expected[0]}: {expected[1]}" for path, expected in wrong
              if not errors_of(validator, path)]
    check(2, f"{len(wrong)} files that are wrong in their structure are not", faults if len(wrong) > 40 else ["too few"])

    undocumented = [f"{name}: {key}" for name, definition in schema["definitions"].items()
                    for key, value in definition.get("properties", {}).items()
                    if not value.get("description") and "$ref" not in value]
    undocumented += [name for name, definition in schema["definitions"].items()
                     if "_" in name and not definition.get("description")]
    check(3, "keys, forces, motions and couplings have descriptions", undocumented)
    defaults = {key: text.decode().count(f'"default": {key}') for key in ('"up"', '"world"', "0,", "1,")}
    check(4, "and defaults where these are values", [key for key, count in defaults.items() if not count])

    check(5, "no list of alternatives is empty", list(empty_lists(schema)))
    checked = list(documents(models + sorted((SOURCE / "tests/bad").glob("*.yaml"))))
    said = by_ajv(text, checked)
    if said is None:
        print("ok 6 # SKIP node-ajv is not installed")
        return
    faults = [f"{path.name}: {error}" for (path, document), error in zip(checked, said)
              if (error is None) != validator.is_valid(document)]
    check(6, f"ajv takes the schema, and agrees on {len(checked)} files", faults if len(said) == len(checked) else ["lost"])


if __name__ == "__main__":
    main()
