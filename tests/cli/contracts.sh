#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What scripts rely on: exit codes, where things are written, CSV and JSON.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
incline=$models/kinetics/incline.yaml

# ---- exit codes
sed 's/initial: {assemble: true}/initial: {theta: -40 deg}/' "$models/couplings/slider_crank.yaml" >apart.yaml
check 'a start that does not fit its couplings is 1' exits 1 run --quiet apart.yaml
check 'and so are its equations' exits 1 run --equations apart.yaml
check 'which say what is off' says 'does not fit: `wrist` is off by' err
check 'bodies that find their place do so for equations, too' \
    exits 0 run --equations --at crank.theta=1.2 "$models/couplings/slider_crank.yaml"
check 'a run that ends as planned is 0' exits 0 run "$incline"
check 'diagnostics are empty then' is_empty err
check 'an unknown option is 2' exits 2 run --wrong "$incline"
check 'no file is 2' exits 2 run
check 'two files are 2' exits 2 run "$incline" "$incline"
check '--at without anything to look at is 2' exits 2 run --at 1 "$incline"
check 'a number that is none is 2' exits 2 run --until soon "$incline"
check 'a time with the unit of a mass is 2' exits 2 run --until '5 kg' "$incline"
check 'a step may have a unit' exits 0 run --step '10 ms' --method rkf45 "$incline"
check 'a step with the unit of a mass is 2' exits 2 run --step '5 kg' "$incline"
check 'an unknown method is 2' exits 2 run --method rk99 "$incline"
check 'and the nearest one is named' says 'did you mean' err
check 'an end before the start is 2' exits 2 run --until -1 "$incline"
check 'a file that is not there is 3' exits 3 run nowhere.yaml
check 'a wrong file is 3' exits 3 run "$FBD_SOURCE_ROOT/README.md"
check 'an unknown parameter is 3' exits 3 run --set nothing=1 "$incline"
check 'a directory is 3' exits 3 run "$models"

cat >lost.yaml <<'END'
fbd: 1
bodies:
  block:
    mass: 2 kg
    motion: slide
    initial: {v: 1 m/s}
    forces:
      - gravity
      - normal
      - applied: {name: lift, value: '10[N/s]*t', angle: 90 deg}
simulate: {until: 5 s}
END
check 'a lost contact is 1' exits 1 run --csv lost.csv --json lost.json lost.yaml
check 'with its time, body and reason' says 't = 1\.962 `block` leaves its surface' err
check 'and the rows up to there are kept' says '^1\.962[0-9]*,1\.962' lost.csv
check 'and the event is in the JSON' says '"kind": "contact_lost"' lost.json

cat >root.yaml <<'END'
fbd: 1
bodies:
  block: {mass: 2 kg, motion: slide, forces: [{applied: {value: "3[N]*sqrt(4 - t/1[s])"}}]}
simulate: {until: 5 s}
END
check 'a force that is not finite is 1' exits 1 run --csv root.csv root.yaml
check 'with its time and body' says 'force on `block` is not finite at t = 4' err

cat >differs.yaml <<'END'
fbd: 1
bodies:
  block: {mass: 2 kg, motion: slide, forces: [{applied: {value: 3 N}}], hand: "m*v_dot = -3[N]"}
simulate: {until: 1 s}
END
check 'a hand derivation that differs is 4' exits 4 run --check-hand differs.yaml
check 'and the term is named' says 'term `applied` has the wrong sign' out
sed 's/m\*v_dot/m/' differs.yaml >misread.yaml
check 'one that cannot be read is 3' exits 3 run --check misread.yaml
check 'but a run does not read it' exits 0 run --quiet --until 1 misread.yaml
sed 's/bodies:/parameters: {p: 1 N}\nbodies:/; s/-3\[N\]/p/' differs.yaml >named.yaml
check 'nor warns of what it names' exits 0 run --quiet --until 1 named.yaml
check 'and says nothing' is_empty err
sed 's/bodies:/parameters: {p: 1 N}\nbodies:/' misread.yaml >unused.yaml
check 'a file with other notes is read as a whole' exits 3 run --quiet --until 1 unused.yaml

# ---- where things are written
check '--help goes to standard output with 0' exits 0 run --help
check 'and nowhere else' is_empty err
check '--version says a version' "$FBD_RUN" --version
check 'CSV to standard output leaves the report out' exits 0 run --csv - "$incline"
check 'so that the first line is the header' sh -c 'head -1 out | grep -qx "t \[s\],block.x \[m\],block.v \[m/s\]"'
check 'there are 500 intervals, and the event' sh -c '[ "$(wc -l <out)" -eq 503 ]'
check 'every column is there in every row' awk -F, 'NF != 3 { exit 1 }' out
check '--every sets the interval' exits 0 run --csv - --every 0.5 "$incline"
check 'rows at multiples of it, at the event, and at the end' \
    sh -c 'cut -d, -f1 out | tail -n +2 | tr "\n" " " | grep -E "^0 0\.45093424971163[0-9]* 0\.5 1 1\.5 2 2\.5 3 $"'
check 'a file that cannot be written is an error' exits 1 run --csv /nowhere/at/all.csv "$incline"
echo before >kept.csv
check 'a wrong model leaves an old file alone' exits 3 run --csv kept.csv --set nothing=1 "$incline"
check 'to the letter' sh -c '[ "$(cat kept.csv)" = before ]'
check 'no temporary file stays behind' sh -c '[ -z "$(ls | grep "csv\.")" ]'
check 'a model on standard input' sh -c '"$FBD_RUN" --quiet - <"$0"' "$incline"

# ---- JSON
check 'JSON is well formed' sh -c '"$FBD_RUN" --json - "$0" | python3 -m json.tool' "$incline"
check 'names of the contract' python3 - "$FBD_RUN" "$incline" <<'END'
import json, subprocess, sys
result = json.loads(subprocess.run([sys.argv[1], "--json", "-", sys.argv[2]], capture_output=True, check=True).stdout)
assert result["final"]["block"] == {"x": result["final"]["block"]["x"], "v": 0}
assert set(result["events"][0]) >= {"t", "body", "kind", "detail"}
assert set(result["forces"]["block"]["friction"]) >= {"fx", "fy", "moment", "power", "work"}
assert set(result["energy"]) >= {"kinetic", "potential", "work", "residual"}
assert set(result["stats"]) >= {"method", "tolerance", "steps", "rejected", "rhs", "jacobians", "events", "seconds", "error_estimate"}
assert abs(result["forces"]["block"]["friction"]["limit"] - 8.495709211125343) < 1e-12
END
printf 'fbd: 1\ntitle: "quote \\" slash \\\\ and \\t tab"\nbodies:\n  b: {mass: 1, motion: slide}\nsimulate: {until: 1}\n' >title.yaml
check 'each force has its moment about G and about O: they differ by the arm from O to G' python3 - "$FBD_RUN" "$models" <<'END'
import json, math, subprocess, sys
models = sys.argv[2]
def run(model, *more):
    command = [sys.argv[1], "--json", "-", *more, models + "/" + model]
    return json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
result = run("couplings/slider_crank.yaml")
theta = result["final"]["crank"]["theta"]
x, y = 0.1 * math.cos(theta), 0.1 * math.sin(theta)
forces = result["forces"]["crank"]
assert set(forces) == {"gravity", "drive", "connecting_rod.pin", "pin"}, forces
for force in forces.values():
    arm = x * force["fy"] - y * force["fx"]
    assert abs(force["moment_O"] - force["moment_G"] - arm) < 1e-9, force
    assert force["moment_O"] == force["moment"]
rolls = run("couplings/disc_on_incline.yaml")["forces"]["ball"]["tread.friction"]
slips = run("couplings/disc_on_incline.yaml", "--set", "mu=0.1")["forces"]["ball"]["tread.friction"]
assert rolls["mode"] == "stick" and abs(rolls["utilisation"] - math.tan(math.pi / 6) / 3 / 0.5) < 1e-9, rolls
assert slips["mode"] == "slip" and abs(slips["margin"] - 1) < 1e-12, slips
END
check 'a title is data' sh -c '"$FBD_RUN" --json - title.yaml | python3 -m json.tool'

# ---- the same bits
run --csv coarse.csv --every 1 "$incline"
run --csv fine.csv --every 0.001 --ledger "$incline"
check 'the output interval and the ledger change nothing' \
    sh -c '[ "$(tail -1 coarse.csv)" = "$(tail -1 fine.csv | cut -d, -f1-3)" ]'
check 'a comma locale changes nothing' sh -c 'LC_ALL=de_DE.UTF-8 "$FBD_RUN" --csv - --every 1 "$0" | cmp - coarse.csv' "$incline"

# ---- the origin of a CSV
run --csv traced.csv --origin --every 1 --set phi='20 deg' "$incline"
check 'the comment lines of --origin have the version, the hash of the model and the parameters' \
    sh -c 'sha256sum "$0" | cut -d" " -f1 | grep -qF -f - traced.csv && grep -qx "# fbd [0-9.]*" traced.csv && grep -q "^# parameters: phi = 0.349[0-9]*, f1 = 5 N" traced.csv' "$incline"
run --csv plain.csv --every 1 --set phi='20 deg' "$incline"
check 'the lines behind them are the same' sh -c 'grep -v "^#" traced.csv | cmp - plain.csv'
check 'without a CSV --origin is refused' exits 2 run --origin "$incline"
finish
