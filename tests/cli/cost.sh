#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# fbd-cost as users and scripts meet it: options, exit codes, rows, files.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
fall=$models/kinetics/falling_with_drag.yaml
program=$FBD_BUILD_ROOT/apps/fbd-cost

run() { # run ARGUMENT...: output and diagnostics apart, exit code kept
    "$program" --budget 0.5 "$@" >out 2>err
}

# ---- options and exit codes
check 'an unknown option is 2' exits 2 run --wrong "$fall"
check 'no file is 2' exits 2 run
check 'two files are 2' exits 2 run "$fall" "$fall"
check 'a budget that is none is 2' exits 2 run --budget soon "$fall"
check 'an end at the start is 2' exits 2 run --until 0 "$fall"
check 'an unknown method is 2' exits 2 run --methods auto,rk99 "$fall"
check 'and the nearest one is named' says 'did you mean' err
check 'an empty name in a list is 2' exits 2 run --methods auto,, "$fall"
check 'a multistep method has no fixed steps: 2' exits 2 run --fixed-steps --methods msadams "$fall"
check 'an unknown quantity is 2' exits 2 run --of ball.y "$fall"
check 'and the nearest one is named' says 'ball\.(x|v)' err
check '--effects draws nothing: 2' exits 2 run --effects --svg - "$fall"
check 'two files at one place are 2' exits 2 run --csv a --json a "$fall"
check 'a wrong file is 3' exits 3 run "$FBD_SOURCE_ROOT/README.md"
check 'an unknown parameter is 3' exits 3 run --set nothing=1 "$fall"
check 'a scene that fails is 1' exits 1 run --budget 60 "$models/hard/singular_reached.yaml"
check 'with its reason' says 'divides by zero' err
check '--help goes to standard output with 0' exits 0 run --help
check 'and nowhere else' is_empty err
check '--version says a version' "$program" --version

# ---- the table
check 'a study ends with 0' exits 0 run --budget 60 --methods auto,rk4,rodas5p --of ball.v "$fall"
check 'and without a word on standard error: progress is for terminals' is_empty err
check 'it says what errors are measured against' says 'exact solution of the file, which the runs confirm' out
check 'one quantity counts' says 'size of each quantity: ball\.v 19\.7 m/s$' out
check 'rows of tolerances' says '^[* ] auto +1e-6 ' out
check 'and of fixed steps' says '^[* ] rk4 +h = ' out
check 'observed orders' says 'observed order [0-9]' out
check 'a front' says '^\* ' out
check 'answers with their options' says '1e-6 costs .* fbd-run --method [a-z0-9]+ --tolerance 1e-' out
"$program" --budget 0.5 --fixed-steps --methods rk4 "$fall" >out
check 'fixed steps only where they are asked for' sh -c '! grep -E "^[* ] rk4 +1e-" out && grep -qE "^[* ] rk4 +h" out'

cat >wrong.yaml <<'END'
fbd: 1
bodies:
  b: {mass: 1 kg, motion: slide, initial: {v: 1 m/s}, exact: {x: "1.001[m/s]*t"}}
simulate: {until: 1 s}
END
check 'a solution of the file that is none is 4' exits 4 run --methods auto wrong.yaml
check 'and is said to be' says 'for b\.x is not that of the scene' err

# ---- data
check 'CSV to standard output leaves the table out' exits 0 run --methods auto,rk4 --csv - "$fall"
check 'so that the first line is the header' sh -c 'head -1 out | grep -q "^method,tolerance,step \[s\],state,error,"'
check 'JSON, CSV and the diagram in one go' exits 0 run --quiet --json c.json --csv c.csv --svg c.svg "$fall"
check 'say the same' python3 - <<'END'
import csv, json
study = json.load(open("c.json"))
rows = list(csv.DictReader(open("c.csv")))
points = [point for series in study["series"] for point in series["points"]]
assert len(points) == len(rows) > 100
for point, row in zip(points, rows):
    assert point["method"] == row["method"] and point["state"] == row["state"]
    assert point["error"] == (float(row["error"]) if row["error"] else None)
    assert (point["state"] == "measured") == (point["seconds"] is not None)
    assert point["state"] == "measured" or point["reason"]
assert study["reference"]["exact"] is True and study["reference"]["complete"] is True
assert [a["target"] for a in study["answers"]][:2] == [1e-3, 1e-6]
END
check 'the diagram is well formed, and its text is text' python3 - <<'END'
import xml.etree.ElementTree as tree
root = tree.parse("c.svg").getroot()
words = " ".join("".join(text.itertext()) for text in root.iter("{http://www.w3.org/2000/svg}text"))
for word in ("Fall with quadratic drag", "dop853", "rk4, fixed h", "floor of the reference", "time of a run"):
    assert word in words, word
END
check 'it reaches to the floor of the reference where no run does' sh -c '"$0" --budget 0.5 --fixed-steps --methods rk1imp --quiet \
    --svg coarse.svg "$1" && grep -q "floor of the reference" coarse.svg' "$program" "$fall"
printf 'fbd: 1\ntitle: "a < b & \\"c\\""\nbodies:\n  b: {mass: 1, motion: slide}\nsimulate: {until: 1}\n' >title.yaml
check 'a title is data' sh -c '"$0" --budget 0.2 --quiet --svg t.svg title.yaml && python3 -c "
import xml.dom.minidom; xml.dom.minidom.parse(\"t.svg\")"' "$program"
check 'a file that cannot be written is an error' exits 1 run --quiet --csv /nowhere/at/all.csv "$fall"

# ---- effects
check 'effects end with 0' exits 0 run --effects --json e.json "$models/kinetics/incline.yaml"
check 'each force is a row' sh -c 'grep -c "left out" out | grep -qx 4'
check 'what cannot be left out says why' says 'block\.normal .*not possible: `friction` needs it' out
check 'and so does the JSON' python3 - <<'END'
import json
effects = {e["name"]: e for e in json.load(open("e.json"))["effects"]}
assert effects["normal"]["change_max"] is None and "needs it" in effects["normal"]["reason"]
assert effects["push"]["change_max"] > 1 and effects["push"]["time"] > 0
END
check 'CSV has a row for each' sh -c '"$0" --budget 0.5 --effects --csv - "$1" | wc -l | grep -qx 5' "$program" "$models/kinetics/incline.yaml"
finish
