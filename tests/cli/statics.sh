#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# fbd-run --static: exit codes, text and JSON.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
. "$FBD_SOURCE_ROOT/tests/tools/answers.sh"
models="$FBD_SOURCE_ROOT/models"

check 'a scene that rests is 0' exits 0 run --static "$models/statics/beam.yaml"
check 'without a diagnostic' test ! -s err
check 'with a sum for each body' says '^    sum  *0  *0  *0$' out
check 'a scene that moves is 1' exits 1 run --static "$models/rotation/compound_pendulum.yaml"
check 'and says what would hold it' says '^    pendulum\.theta .* N\*m' out
check '--at looks at it elsewhere' exits 0 run --static --at theta=0 "$models/rotation/compound_pendulum.yaml"
check 'friction beyond its limit is 1' exits 1 run --static --set mu=0.3 "$models/statics/ladder.yaml"
check 'and named' says '`foot\.friction` would have to hold .* it slips' out
check 'what is indeterminate is 0' exits 0 run --static "$models/statics/beam_on_three_supports.yaml"
check 'with a warning' says 'warning: statically indeterminate to degree 1.*\[indeterminate\]' err

check 'JSON in place of the text' exits 0 run --static --json - "$models/statics/truss.yaml"
check 'is one object with the verdict' json 'it["equilibrium"] and it["indeterminacy"] == 0 and it["mobility"] == 0'
check 'with forces by body and name' json 'abs(it["forces"]["E"]["normal"]["fy"] - 500) < 1e-9'
check 'with members' json '[abs(e["tension"] - 577.350269189626) < 1e-9 for e in it["members"] if e["name"] == "BC"] == [True]'
check 'with sums' json 'all(abs(b["fx"]) + abs(b["fy"]) < 1e-9 for b in it["balance"].values())'
check 'JSON to a file leaves the text' exits 0 run --static --json a.json "$models/statics/beam.yaml"
check 'which is there' says 'in equilibrium' out
check 'but not with --quiet' exits 0 run --static --quiet "$models/statics/beam.yaml"
check 'where only the exit code speaks' test ! -s out
check 'JSON of a scene that moves is 1' exits 1 run --static --json - "$models/couplings/slider_crank.yaml"
check 'and says what would hold it' json 'not it["equilibrium"] and it["mobility"] == 1 and it["unbalanced"][0]["alone"]'

cat >off.yaml <<'END'
fbd: 1
ground: {points: {B: [4.1, 0]}}
bodies:
  beam: {shape: rod, mass: 10 kg, length: 4 m, motion: {pivot: {point: left}}, forces: [gravity]}
couplings:
  - pin: {name: B, between: [beam.right, ground.B]}
END
check 'a scene that does not fit its couplings is 1' exits 1 run --static off.yaml
check 'with its place in the file' says '^off\.yaml:6:[0-9]+: error: .*`B` is off by 0\.1.*\[does-not-fit\]' err

check '--settle goes to where it rests' exits 0 run --static --settle --json - "$models/trees/elastic_pendulum.yaml"
check 'which is there' json 'abs(it["coordinates"]["bob.y"] + 0.9 + 0.5*9.81/40) < 1e-9 and it["mobility"] == 3'
check 'what falls for ever is 1' exits 1 run --static --settle "$models/kinetics/drop_us.yaml"
check 'and says so' says '\[no-equilibrium\]' err
check 'dry friction has no one place' exits 1 run --static --settle "$models/kinetics/incline.yaml"
check 'with its place in the file' says 'incline\.yaml:[0-9]+:[0-9]+: error: .*\[sticks\]' err
check '--settle goes with --static' exits 2 run --settle "$models/kinetics/incline.yaml"

check 'two things at a time are 2' exits 2 run --static --equations "$models/statics/beam.yaml"
check 'CSV belongs to a run' exits 2 run --static --csv a.csv "$models/statics/beam.yaml"
check 'and so do pictures' exits 2 run --static --html a.html "$models/statics/beam.yaml"
check 'a coordinate that is not there is 2' exits 2 run --static --at beam.z=1 "$models/statics/beam.yaml"
finish
