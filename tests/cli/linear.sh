#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What a chain of rods costs grows with their number, counted in instructions by valgrind: not in time, which
# a busy machine would decide.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"

command -v valgrind >/dev/null || {
    echo '1..0 # SKIP valgrind is not installed'
    exit 0
}

# chain N: its scene in $scratch/chainN.yaml.
chain() {
    awk -v n="$1" 'BEGIN {
        print "fbd: 1\nbodies:"
        for (i = 1; i <= n; i++) {
            printf "  rod%d:\n    shape: rod\n    mass: 1 kg\n    from: [0, 0]\n    to: [0, -0.2 m]\n", i
            print "    forces: [gravity]"
            if (i == 1) print "    motion: pivot"
            else printf "    motion: {pivot: {on: rod%d, at: right, point: left}}\n", i - 1
        }
    }' >"$scratch/chain$1.yaml"
}

# instructions N ARGUMENT...: of fbd-run on the chain of N rods.
instructions() {
    n=$1
    shift
    valgrind --tool=callgrind --callgrind-out-file="$scratch/counts" "$FBD_RUN" "$@" "$scratch/chain$n.yaml" \
        >/dev/null 2>&1 || return 1
    sed -n 's/^summary: *//p' "$scratch/counts"
}

# grows_linearly ARGUMENT...: 256 more rods cost twice what 128 more cost, to a twentieth.
grows_linearly() {
    few=$(instructions 128 "$@") && some=$(instructions 256 "$@") && many=$(instructions 512 "$@") || return 1
    echo "instructions for 128, 256 and 512 rods: $few $some $many"
    awk -v a="$few" -v b="$some" -v c="$many" 'BEGIN {
        ratio = (c - b) / (b - a)
        print "increments are in the ratio " ratio
        exit !(ratio > 1.9 && ratio < 2.1)
    }'
}

# The chain hangs at rest, so that every length takes the same number of steps.
for n in 128 256 512; do chain $n; done
check 'reading and checking a chain takes instructions in proportion to its rods' grows_linearly --check
check 'and so does a whole run' grows_linearly --method dop853 --until 1
finish
