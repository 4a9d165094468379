#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Messages that once misled: what they say is so.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
faults=$FBD_SOURCE_ROOT/tests/cli/messages
incline=$models/kinetics/incline.yaml

never() { # never PATTERN FILE
    ! grep -aE -- "$1" "$2"
}

check 'an end before the start is a mistake of usage' exits 2 run --until -1 "$incline"
check 'for which the file is not blamed' says '^error: the end time lies before the start' err
check 'a tolerance of the command line neither' exits 2 run --tolerance 0.5 "$incline"
check '(the tolerance)' says '^error: the tolerance must be' err
sed 's/until: *[^,}]*/until: -1 s/' "$incline" >ends.yaml
check 'an end in the file has its place there' exits 3 run ends.yaml
check '(the place)' says '^ends.yaml:[0-9]+:[0-9]+: error' err

check 'what rolls and would be pulled leaves' exits 0 run "$faults/roll_pulls.yaml"
check 'of which `two_sided` is no cure: a roll has no such key' never two_sided err
check 'and it is the normal force that is lost' says 'lift_off +wall leaves its line' out
sed 's/- gravity/- gravity\n      - applied: {name: lift, value: "10[N\/s]*t", angle: 90 deg}/' "$incline" >lifted.yaml
check 'a normal force of the file' exits 1 run lifted.yaml
check 'may be declared two_sided' says 'two_sided' err

check 'a rope that reaches its pulley ends the run' exits 1 run "$faults/weight_reaches_pulley.yaml"
check 'and is named' says 'a rope reaches its pulley: `cord` has no way from `up` to `pulley`' err
check 'no expression is blamed' never domain err

long_run() { # a pendulum that passes its lowest point every second
    exits 0 run --quiet --until 1e12 "$faults/events_for_ever.yaml" || {
        cat err
        return 1
    }
}
check 'events a second apart do not chatter, however far the end is' long_run

# Holds that depend on each other: whatever is made of them, it is told as it is.
tied() {
    "$program" "$faults/two_feet.yaml" >out 2>err
    "$program" --set P=20.5 "$faults/two_feet.yaml" >>out 2>>err
    "$program" "$faults/locked_friction.yaml" >>out 2>>err
    [ -s out ]
}
check 'friction that depends on other friction' tied
check 'is not said to lack memory' never 'out of memory' err
check 'nor to lack a declaration that it has' never 'declare it as `friction`' err
check 'nor to hold with more than its limit' never '[0-9]{3}(\.[0-9]*)? % of its static limit' out
check 'at times that are times' never '^ +t = [0-9.]+e-[0-9]{3} s +[a-z]' out
check 'in reasons, too' never 'at t = [0-9.]+e-[0-9]{3} (the|no|events)' err
finish
