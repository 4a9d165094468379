#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Outputs never go over the model or over each other, however a path is spelled; files that are there keep their
# modes and their links.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
sweep=$FBD_BUILD_ROOT/apps/fbd-sweep
cost=$FBD_BUILD_ROOT/apps/fbd-cost
cp "$models/kinetics/incline.yaml" m.yaml
cp m.yaml before.yaml
mkdir sub elsewhere
touch names names.after out err
ln -s m.yaml soft.yaml
ln -s soft.yaml softer.yaml
ln -s .. sub/up
ln m.yaml hard.yaml
ln -s new.json dangling.json
ln -s m.yaml table.csv.part.key
ln m.yaml held.part

refused() { # refused PROGRAM ARGUMENT...: exit 2, nothing written, the model as it was
    ls >names
    "$@" >out 2>err
    code=$?
    ls >names.after
    [ $code -eq 2 ] && [ ! -s out ] && cmp m.yaml before.yaml && same names names.after && says '^fbd-[a-z]*: ' err
}
for spelling in m.yaml ./m.yaml sub/../m.yaml sub/up/m.yaml soft.yaml softer.yaml hard.yaml "$scratch/m.yaml" //"$scratch"//m.yaml; do
    for option in --csv --json --svg --html --plot --gnuplot; do
        # A plot goes by the end of its name.
        [ "$option" = --plot ] || check "fbd-run $option over the model, as $spelling" refused "$program" $option "$spelling" m.yaml
    done
    for option in --csv --json --svg; do
        check "fbd-cost $option over the model, as $spelling" refused "$cost" --budget 1 $option "$spelling" m.yaml
    done
    check "fbd-sweep --csv over the model, as $spelling" refused "$sweep" --vary mu_k=1 --csv "$spelling" m.yaml
    check "and --resume over it" refused "$sweep" --vary mu_k=1 --resume --csv "$spelling" m.yaml
    check "the model by another name, as $spelling" refused "$program" --json m.yaml "$spelling"
done
cp m.yaml m.svg
check 'a plot over the model' refused "$program" --plot ./m.svg m.svg
check 'a page without a run, too' refused "$program" --equations --svg m.svg m.svg
check 'and statics' refused "$program" --static --json soft.yaml m.yaml
check 'the partial table over the model' refused "$sweep" --vary mu_k=1 --csv held m.yaml
check 'its key over the model' refused "$sweep" --vary mu_k=1 --csv table.csv m.yaml

from_stdin() { # from_stdin PROGRAM ARGUMENT...: the model is standard input
    refused "$@" - <m.yaml
}
check 'the model on standard input is not written over' from_stdin "$program" --json m.yaml
check 'by fbd-cost' from_stdin "$cost" --csv soft.yaml
check 'by fbd-sweep' from_stdin "$sweep" --vary mu_k=1 --csv ./m.yaml
appended() { # appended PROGRAM ARGUMENT...: standard output is the model
    "$@" >>m.yaml 2>err
    [ $? -eq 2 ] && cmp m.yaml before.yaml
}
check 'a report is not appended to its model' appended "$program" m.yaml
check 'nor data' appended "$program" --csv - m.yaml
check 'nor a table' appended "$sweep" --vary mu_k=1 m.yaml
check 'nor that of fbd-cost' appended "$cost" --budget 1 m.yaml

# ---- two outputs
: >there.csv
ln -s there.csv there.json
ln there.csv there.svg
check 'two outputs to one file that is not there' refused "$program" --csv a --json ./a m.yaml
check 'through a folder' refused "$program" --csv a --json sub/up/a m.yaml
check 'by its whole path' refused "$program" --csv a --html "$scratch/a" m.yaml
check 'by a link to what is not there' refused "$program" --csv dangling.json --json new.json m.yaml
check 'by a soft link' refused "$program" --csv there.csv --json there.json m.yaml
check 'by a hard link' refused "$program" --csv there.csv --svg there.svg m.yaml
check 'two to standard output' refused "$program" --csv - --json - m.yaml
check 'by another name' refused "$program" --csv - --json /dev/stdout m.yaml
check 'by a number' refused "$program" --csv /dev/fd/1 --json - m.yaml
check 'of fbd-cost' refused "$cost" --csv there.csv --json there.json m.yaml
check 'of fbd-cost to standard output' refused "$cost" --csv - --json /dev/stdout m.yaml
report_and_data() {
    "$program" --csv both m.yaml >>both 2>err
    [ $? -eq 2 ] && [ ! -s both ]
}
check 'the report and data to one file' report_and_data
check '/dev/null takes any number' exits 0 run --csv /dev/null --json /dev/null m.yaml
check 'files of one name in two folders are two' exits 0 run --quiet --csv a --json sub/a m.yaml
check 'and both are written' test -s a -a -s sub/a

# ---- what is there keeps its mode, its owner and its links
mode() {
    stat -c %a "$1"
}
keeps_mode() { # keeps_mode MODE COMMAND...: of the file `kept`
    printf 'before\n' >kept
    chmod "$1" kept
    want=$1
    shift
    "$@" >out 2>err && [ "$(mode kept)" = "$want" ] && ! grep -q before kept
}
for m in 600 640 644 666 755; do
    check "mode $m is kept by --json" keeps_mode $m "$program" --quiet --json kept m.yaml
    check "by --csv" keeps_mode $m "$program" --quiet --csv kept m.yaml
    check "by --svg" keeps_mode $m "$program" --quiet --svg kept m.yaml
    check "by a sweep" keeps_mode $m "$sweep" --quiet --vary mu_k=0.3 --csv kept m.yaml
done
new_mode() {
    (umask 027 && "$program" --quiet --json fresh m.yaml) && [ "$(mode fresh)" = 640 ]
}
check 'a new file has the mode that the mask leaves' new_mode
keeps_link() { # keeps_link COMMAND...: `link` points to elsewhere/target
    printf 'before\n' >elsewhere/target
    chmod 604 elsewhere/target
    ln -sf elsewhere/target link
    "$@" >out 2>err && [ -L link ] && [ "$(readlink link)" = elsewhere/target ] && [ "$(mode elsewhere/target)" = 604 ] &&
        ! grep -q before elsewhere/target && [ "$(ls elsewhere)" = target ]
}
check 'a link stays a link: --json' keeps_link "$program" --quiet --json link m.yaml
check '--csv' keeps_link "$program" --quiet --csv link m.yaml
check 'of fbd-cost' keeps_link "$cost" --quiet --budget 0.2 --csv link m.yaml
check 'of a sweep' keeps_link "$sweep" --quiet --vary mu_k=0.3 --csv link m.yaml
dangles() {
    rm -f new.json && run --quiet --json dangling.json m.yaml && [ -L dangling.json ] && [ -s new.json ]
}
check 'a link to nothing makes what it points to' dangles
ln -s circle circle
check 'a link in a circle is 1' exits 1 run --json circle m.yaml
check 'and said' says 'cannot write `circle`' err
failed_whole() {
    printf 'before\n' >elsewhere/target
    ln -sf elsewhere/target link
    exits 1 run --quiet --json link --set mu_k=nope m.yaml || exits 3 run --quiet --json link --set mu_k=nope m.yaml
    grep -q before elsewhere/target && [ "$(ls elsewhere)" = target ]
}
check 'a run that fails leaves what a link points to alone' failed_whole
if [ "$(id -u)" -eq 0 ]; then
    keeps_owner() {
        printf 'before\n' >kept && chown 12345:54321 kept && chmod 640 kept
        run --quiet --json kept m.yaml && [ "$(stat -c %u:%g:%a kept)" = 12345:54321:640 ]
    }
    check 'the owner is kept where the system lets us' keeps_owner
else
    echo '# not root: owners cannot be given away, and are not tested'
    keeps_unwritable() {
        printf 'before\n' >kept && chmod 444 kept
        exits 1 run --quiet --json kept m.yaml && grep -q before kept
    }
    check 'what was made unwritable stays' keeps_unwritable
fi

# ---- what cannot be replaced is written straight
straight() { # straight PATH: standard output goes on where it was
    { echo first && "$program" --csv "$1" --every 1 m.yaml && echo last; } >gathered
    head -1 gathered | grep -qx first && tail -1 gathered | grep -qx last && [ "$(wc -l <gathered)" -eq 8 ]
}
check '/dev/stdout is written straight, and takes the place of the report' straight /dev/stdout
check 'and /dev/fd/1' straight /dev/fd/1
check 'and -' straight -
straight_sweep() {
    { echo first && "$sweep" --vary mu_k=0.3 --csv /dev/stdout m.yaml && echo last; } >gathered
    [ "$(wc -l <gathered)" -eq 4 ]
}
check 'by a sweep, too' straight_sweep
other_number() {
    { echo first >&5 && "$program" --quiet --csv /dev/fd/5 --every 1 m.yaml && echo last >&5; } 5>gathered
    [ "$(wc -l <gathered)" -eq 8 ]
}
check 'a number of an open file' other_number
check 'a number of none is 1' exits 1 run --csv /dev/fd/77 m.yaml
through_pipe() {
    mkfifo pipe
    cat pipe >piped &
    run --quiet --csv pipe --every 1 m.yaml
    wait $!
    [ -p pipe ] && [ "$(wc -l <piped)" -eq 6 ]
}
check 'a pipe is written and stays a pipe' through_pipe
check 'nothing lies around' sh -c '! ls | grep -E "[.][A-Za-z0-9]{6}$"'
finish
