#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Plots by gnuplot: only when asked for and found, of the columns that are named; and where drawings go.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
incline=$FBD_SOURCE_ROOT/models/kinetics/incline.yaml

# ---- the script
check 'the script of the plots is written' exits 0 run --quiet --gnuplot plot.gp "$incline"
check 'with coordinates and energies' says "'block.x' noenhanced" plot.gp
check 'it chooses no terminal of its own' sh -c '! grep -q "^set terminal" plot.gp'
check 'columns by name' exits 0 run --quiet --gnuplot - --plot-of block.v,block.friction "$incline"
check 'one plot for each unit' sh -c '[ "$(grep -c "^plot " out)" -eq 2 ]'
check 'an unknown column is 2' exits 2 run --gnuplot other.gp --plot-of block.w "$incline"
check 'and the nearest one is named' says 'did you mean `block\.[vx]`' err
check 'and nothing is written' is_absent other.gp
check 'a list with an empty name is 2' exits 2 run --gnuplot other.gp --plot-of block.v, "$incline"
check 'and so is one with nothing else' exits 2 run --gnuplot other.gp --plot-of '' "$incline"
printf "fbd: 1\ntitle: \"it's 'quoted'\"\nbodies:\n  b: {mass: 1, motion: slide}\nsimulate: {until: 1}\n" >quoted.yaml
check 'quotes in a title' exits 0 run --quiet --gnuplot quoted.gp quoted.yaml
check 'are doubled' says "title 'it''s ''quoted'''" quoted.gp

# ---- the picture
check 'a name without a known ending is 2' exits 2 run --plot plot.txt "$incline"
check 'without gnuplot --plot is 2' exits 2 env PATH=/nowhere "$FBD_RUN" --plot plot.svg "$incline"
check 'and nothing is written then' is_absent plot.svg
if command -v gnuplot >/dev/null; then
    for kind in svg png pdf; do
        check "gnuplot draws $kind" exits 0 run --quiet --plot "plot.$kind" --plot-of block.v,block.friction "$incline"
    done
    check 'the svg is one' says '<svg' plot.svg
    check 'the png is one' says 'PNG' plot.png
    check 'the pdf is one' says '^%PDF' plot.pdf
    check 'a script for a terminal can be run' exits 0 sh -c '"$0" --quiet --gnuplot all.gp "$1" && gnuplot -e "set terminal dumb" all.gp >dumb' "$FBD_RUN" "$incline"
    check 'it plots' says 'block.x' dumb
    check 'a title with quotes is drawn' exits 0 run --quiet --plot quoted.svg quoted.yaml
else
    echo '# gnuplot is not installed: pictures are left out'
fi

# ---- options that do not fit
check '--plot-of alone is 2' exits 2 run --plot-of block.v "$incline"
check '--body without --svg is 2' exits 2 run --body block "$incline"
check 'two outputs to one place are 2' exits 2 run --svg same --html same "$incline"
check '--html without a run is 2' exits 2 run --equations --html page.html "$incline"
check 'the diagram goes to standard output, alone' exits 0 run --svg - "$incline"
check 'as XML' sh -c 'head -c 5 out | grep -q "<?xml" && tail -1 out | grep -qx "</svg>"'
check '--equations --svg makes no run' exits 0 run --equations --svg start.svg "$incline"
check 'a diagram later than the end is 1' exits 1 run --svg late.svg --at 3 --until 3 "$FBD_SOURCE_ROOT/models/hard/singular_reached.yaml"
check 'nothing is written then' is_absent late.svg
check 'no temporary file stays behind' sh -c '[ -z "$(ls | grep -E "\.(svg|png|pdf|gp|html)\.")" ]'
finish
