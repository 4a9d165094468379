#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The systems of the chapter as a user runs them: what is printed is what was derived. Numbers from the reference cases A01 to A08 (closed
# forms), as many digits as the report shows.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
models="$FBD_SOURCE_ROOT/models"

# prints PATTERN ARGUMENT...: succeeds when fbd-run exits 0 and a line of its output matches.
prints() {
    pattern=$1
    shift
    "$FBD_RUN" "$@" >"$scratch/out" 2>&1 || return 1
    grep -E -- "$pattern" "$scratch/out" && return 0
    cat "$scratch/out"
    return 1
}

# prints_not PATTERN ARGUMENT...
prints_not() {
    pattern=$1
    shift
    "$FBD_RUN" "$@" >"$scratch/out" 2>&1 || return 1
    ! grep -E -- "$pattern" "$scratch/out"
}

# counts N PATTERN ARGUMENT...: exactly N lines match.
counts() {
    wanted=$1
    pattern=$2
    shift 2
    "$FBD_RUN" "$@" >"$scratch/out" 2>&1
    [ "$(grep -cE -- "$pattern" "$scratch/out")" -eq "$wanted" ] && return 0
    cat "$scratch/out"
    return 1
}

drop=$models/kinetics/drop_us.yaml
check 'the dropped object reaches the platform at 1.114556 s' prints '^  t = 1\.1145564[0-9]* s .*user' "$drop"
check 'with 35.88872 ft/s' prints 'v = -35\.8887169 ft/s' "$drop"
check 'and so it does with x from the platform' prints 'v = -35\.8887169 ft/s' "$models/kinetics/drop_us_from_platform.yaml"

incline=$models/kinetics/incline.yaml
check 'with f1 = 50 N the block accelerates by 15.8471' prints 'v_dot +15\.8471454' --equations --set f1=50 "$incline"
check 'and is never at rest' prints 'Events: none' --set f1=50 "$incline"
check 'with f1 = 5 N it decelerates by 6.65286' prints 'v_dot +-6\.6528546' --equations --set f1=5 "$incline"
check 'it comes to rest at 0.450934 s' prints '^  t = 0\.45093425 s +block +stick' --set f1=5 "$incline"
check 'friction then holds with 4.81 N, of 8.4957 N' prints '\+4\.81 N, 56\.6 % of its static limit 8\.49571 N' --set f1=5 "$incline"
check 'and it stays for good' prints 'v = 0 m/s +\(sticks, at 56\.6 % of the limit\)' --set f1=5 --until 1000 "$incline"
check 'with less friction it slides back down' prints 'reversal' "$models/kinetics/incline_slides_back.yaml"
check 'and is below its start after that' prints 'x = -.*v = -' --until 2 "$models/kinetics/incline_slides_back.yaml"

ramp=$models/kinetics/ramp_breakaway.yaml
check 'the ramp breaks away at 2.943 s' prints '^  t = 2\.943 s +block +breakaway' "$ramp"
check 'exactly once' counts 1 breakaway "$ramp"

check 'a time may have a unit' prints 'Final state at t = 0.25 s' --until '250 ms' "$models/rotation/fixed_axis.yaml"
check 'also the time to look at' prints 'Equations at t = 0.2 s' --equations --at 200ms "$models/rotation/fixed_axis.yaml"
check 'the moment works M theta' prints 'drive .* work 146\.938776 J|work 146\.938776 J' --until 4 "$models/rotation/fixed_axis.yaml"
check 'which is I omega^2 / 2' prints 'kinetic +0 +146\.938776' --until 4 "$models/rotation/fixed_axis.yaml"

pendulum=$models/rotation/compound_pendulum.yaml
check 'the pendulum has its I_O and L' prints 'I_O = 3\.64178667 kg\*m\^2, m = 3\.8 kg, L = \|OG\| = 0\.942105263 m' --equations "$pendulum"
check 'its moment is -m g L sin(theta)' prints 'gravity +-30\.414639 +N\*m +-m g L sin\(theta\)' --equations "$pendulum"
check 'its small oscillations have sqrt(m g L / I_O)' prints 'w0 = 3\.10540871 rad/s' --linearize "$pendulum"
check 'its period from 60 deg is 2.17137326 s' prints '^  t = 2\.17137326 s .*top' "$pendulum"
check 'upright it is unstable' prints 'unstable: grows' --linearize --at 'theta=179 deg' "$pendulum"

number=0
for model in $(ls "$models"/*/*.yaml | grep -v /hard/); do # the hard ones have tests of their own, and some must fail
    check "$(basename "$model") runs" "$FBD_RUN" --quiet "$model"
    number=$((number + 1))
    if [ "${FBD_THOROUGH-}" = no ] && [ $((number % 4)) -ne 0 ]; then continue; fi
    check "$(basename "$model") agrees with its hand derivation" "$FBD_RUN" --check-hand "$model"
done
finish
