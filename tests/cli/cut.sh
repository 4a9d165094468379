#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# fbd-run --cut: exit codes, text, JSON and drawing.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
. "$FBD_SOURCE_ROOT/tests/tools/answers.sh"
models="$FBD_SOURCE_ROOT/models"

beam="$models/statics/beam.yaml"
check 'a beam at rest is 0' exits 0 run --static --cut beam "$beam"
check 'without a diagnostic' test ! -s err
check 'with both sides of a load' says '^  1 +0 +274\.05 +298\.575 +before P$' out
check 'and the other' says '^  1 +0 +-25\.95 +298\.575 +behind P$' out
check 'and its extremes' says '^  greatest M +298\.575 N\*m +at x = 1 m$' out
check 'one place' exits 0 run --static --cut beam='120 cm' "$beam"
check 'is one row' says '^  1\.2 +0 +-35\.76 +292\.404$' out
check 'without extremes' sh -c '! grep -q greatest out'
check 'a point is a place' exits 0 run --static --cut beam=load "$beam"
check 'with two sides' says 'behind P$' out
check 'JSON in place of the text' exits 0 run --static --cut beam --json - "$beam"
check 'is one object' json 'it["body"] == "beam" and it["at_rest"] and it["length"] == 4 and it["units"]["M"] == "N*m"'
check 'with extremes' json 'abs(it["extremes"]["M"]["greatest"]["value"] - 298.575) < 1e-9 and abs(it["extremes"]["M"]["greatest"]["x"] - 1) < 1e-9'
check 'with the steps' json '[j["name"] for j in it["jumps"]] == ["A", "P", "B"]'
check 'a drawing' exits 0 run --quiet --static --cut beam --svg beam.svg "$beam"
check 'has three diagrams' sh -c 'grep -c "<g id=\"section-" beam.svg | grep -qx 3'

sed '0,/^    mass: .*/s//    mass: 0 kg/' "$beam" >light.yaml
check 'a beam without mass' exits 0 run --static --cut beam light.yaml
check 'bears its load alone: P a b/L' says '^  greatest M +225 N\*m +at x = 1 m$' out

chimney="$models/rotation/falling_chimney.yaml"
check 'a motion at a time' exits 0 run --cut chimney --at 2s "$chimney"
check 'is bent most at a third' says '^  greatest M +17325\.5642 N\*m +at x = 6\.66666667 m$' out
check 'or at coordinates' exits 0 run --cut chimney --at 'theta=60 deg' "$chimney"
check 'is m g L cos/27' says '^  greatest M +18166\.6667 N\*m' out
check 'without --at the start' exits 0 run --cut chimney "$chimney"
check 'which moves, and so does not rest' exits 1 run --static --cut chimney "$chimney"
check 'by name' says 'not in equilibrium.*\[no-balance\]' err

check 'another body is a mistake' exits 2 run --cut baem "$beam"
check 'with the right one' says 'did you mean .beam.' err
check 'a place beyond the end too' exits 2 run --cut beam='5 m' "$beam"
check 'by name' says '\[bad-place\]' err
check 'a place that is no length' exits 2 run --cut beam='5 kg' "$beam"
check 'a disc has no sections' exits 1 run --cut ball "$models/couplings/rolling_on_incline.yaml"
check '--cut goes without --csv' exits 2 run --cut beam --csv - "$beam"
check 'and --equations' exits 2 run --cut beam --equations "$beam"
check 'and --body' exits 2 run --cut beam --svg a.svg --body beam "$beam"
finish
