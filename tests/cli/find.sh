#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# fbd-run --find: exit codes, text and JSON.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
. "$FBD_SOURCE_ROOT/tests/tools/answers.sh"
models="$FBD_SOURCE_ROOT/models"

loop="$models/tracks/loop_the_loop.yaml"
check 'a value that is found is 0' exits 0 run --find 'h = 2..3 m: car lifts' "$loop"
check 'without a diagnostic' test ! -s err
check 'with its error' says '^  h = 2\.5 m   \+- [0-9.]+e-1[0-9]$' out
check 'and both sides' says '^      below   car contact_lost$' out
check 'and the resolution of the scan' says 'at distances of 0\.03125 m: of two values closer than that both may be missed' out
check 'no value is 1' exits 1 run --find 'h: car lifts' "$loop"
check 'and said' says 'no such value in this range' out
check 'with a coarser scan' exits 0 run --find 'h = 2..3 m: car lifts' --runs 3 "$loop"
check 'which is said' says ', 3 of them at distances of 0\.5 m' out
check 'JSON in place of the text' exits 0 run --find 'h = 2..3 m: car lifts' --json - "$loop"
check 'is one object' json 'it["parameter"] == "h" and it["unit"] == "m" and it["scan"] == 33 and it["gaps"] == []'
check 'with the value' json 'abs(it["solutions"][0]["value"] - 2.5) <= it["solutions"][0]["error"] < 1e-8'
check 'JSON to a file leaves the text' exits 0 run --find 'h = 2..3 m: car lifts' --json a.json "$loop"
check 'which is there' says '^  h = 2\.5 m' out
check '--quiet leaves it out' exits 0 run --quiet --find 'h = 2..3 m: car lifts' "$loop"
check 'where only the exit code speaks' test ! -s out

bump='fbd: 1
parameters: {v0: 5 m/s}
bodies:
  car: {mass: 2 kg, motion: {track: {x: "2[m]*sin(p)", y: "2[m]*cos(p)", from: -80 deg, to: 80 deg}}, initial: {p: 0, v: v0}, forces: [gravity, normal]}
simulate: {until: 1 s}'
echo "$bump" >bump.yaml
check 'a run that does not start ends with 1' exits 1 run bump.yaml
check 'and its reason alone' sh -c '! grep -q accurate err'

check 'statics have a closed form' exits 0 run --static --find 'mu = 0.1..1' "$models/statics/ladder.yaml"
check 'which is said' says '^  mu = 0\.33414384119   \(closed form: the margin is linear\)$' out
check 'of a limit too' exits 0 run --static --find 'mu = 0.1..1: foot.friction' "$models/statics/ladder.yaml"
check 'with its margin on both sides' says '^      margin from -[0-9.]+ to [0-9.]+$' out

block="$models/kinetics/incline.yaml"
check 'runs that fail are 1' exits 1 run --find 'mu_k = -0.1..0.4: block.x = 1 m' "$block"
check 'and counted' says 'runs of the search did not succeed' err
check 'and named with their reason' says '^  -0\.1   wrong: .*must be zero or above' out
check 'beside the value' says '^  mu_k = 0\.[0-9]+   \+- ' out

check 'an unknown parameter is 2' exits 2 run --find 'mu_q = 0..1: block slips' "$block"
check 'with the nearest' says 'did you mean `mu_[sk]`' err
check 'a missing range is 2' exits 2 run --find 'mu_s: block slips' "$block"
check 'and said' says 'the file gives no `range` for the parameter `mu_s`.*\[bad-find\]' err
check 'a quantity that is none is 2' exits 2 run --find 'phi: block.q = 1 m' "$block"
check 'and named' says '^--find: error: a run has no quantity `block\.q`.*\[unknown-output\]' err
check 'a wrong unit is 2' exits 2 run --find 'phi: block.x = 1 s' "$block"
check '--csv does not go with it' exits 2 run --find 'phi: block.x = 1 m' --csv a.csv "$block"
check 'a plot neither' exits 2 run --find 'phi: block.x = 1 m' --gnuplot a.gp "$block"
check '--linearize neither' exits 2 run --find 'phi: block.x = 1 m' --linearize "$block"
check '--runs goes with --find' exits 2 run --runs 5 "$block"
check 'and is a number' exits 2 run --find 'phi: block.x = 1 m' --runs 2 "$block"
check 'a wrong file is 3' exits 3 sh -c 'echo "fbd: 1" | "$FBD_RUN" --find "mu: block slips" -'
check 'a model from standard input' exits 0 sh -c '"$FBD_RUN" --find "phi: block.x = 0.7 m" - <"$1"' sh "$block"

finish
