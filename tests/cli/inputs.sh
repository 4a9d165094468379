#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What is read: plain files, standard input and what is open already. A pipe, socket or device by its name ends at once.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
programs=$(dirname "$FBD_RUN")
incline=$models/kinetics/incline.yaml
mkfifo pipe
mkdir folder

refused() {
    exits "$1" "$programs/$2" $3 2>err
    says 'cannot read' err
}
for file in pipe folder /dev/zero; do
    check "a model: $file" refused 3 fbd-run "--check $file"
    check "a key: $file" refused 3 fbd-run "--grade $file $incline"
    check "a sweep: $file" refused 3 fbd-sweep "--vary mu=0,1 $file"
    check "what methods cost: $file" refused 3 fbd-cost "$file"
    printf 'fbd: 1\ntables: {f: {file: %s}}\nbodies: {b: {mass: 1, motion: slide, forces: [applied: f(t)]}}\n' $file >m.yaml
    check "a table: $file" refused 3 fbd-run "--check m.yaml"
done
check 'an answer' refused 1 fbd-run "--grade $incline pipe"
check 'with what to do' says 'is read as standard input' err

check 'standard input' exits 0 run --check - <"$incline"
check 'from a pipe' sh -c "cat '$incline' | '$FBD_RUN' --check -"
check 'by its path' sh -c "cat '$incline' | '$FBD_RUN' --check /dev/stdin"
other_number() {
    mkfifo open
    cat "$incline" >open &
    exits 0 run --check /dev/fd/5 5<open
}
check 'a pipe that is open, as of <(...) in a shell' other_number
check 'an answer from standard input' sh -c "'$FBD_RUN' --grade '$incline' - <'$incline' >graded; grep -q points graded"
finish
