#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The report of many bodies, and angles in degrees.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
pendulum=$models/rotation/simple_pendulum.yaml

# ---- many bodies: blocks that fall side by side, from heights and with masses of their own
blocks() { # blocks COUNT [TICKS]: on stdout; block i weighs i kg and starts with i m/s
    printf 'fbd: 1\nbodies:\n'
    i=1
    while [ $i -le "$1" ]; do
        printf '  b%d: {mass: %d kg, motion: particle, initial: {vx: %d m/s}, forces: [gravity]}\n' $i $i $i
        i=$((i + 1))
    done
    printf 'simulate:\n  until: 2 s\n  events: [{name: tick, when: "sin(%s[1/s]*t) = 0"}]\n' "${2:-1}"
}
blocks 12 >few.yaml
blocks 13 40 >many.yaml
check 'twelve bodies are reported in full' exits 0 run few.yaml
check '(equations)' says '^Equations at t' out
check '(forces)' says '^Forces at the end' out
check 'and --full changes nothing' sh -c "'$program' --full few.yaml | sed '/ ms$/d' >full; sed '/ ms$/d' out | cmp - full"
check 'thirteen in short' exits 0 run many.yaml
short_lines() { [ "$(wc -l <out)" -lt 50 ]; }
check '(some lines)' short_lines
check '(their number)' says '^13 bodies, 26 coordinates, 13 forces and moments$' out
# sin(40 t) passes zero at k pi / 40 up to t = 2: k = 1 to 25, the last at 25 pi/40
check '(events by their kinds)' says '^  tick +25, t = 0\.0785398163 to 1\.96349541 s$' out
# sum of i = 91, sum of i^2 = 819: the centre of mass moves at 819/91 = 9 m/s, and falls g t^2/2
check '(totals)' says '^  t = 2 s +mass 91 kg, at \(18, -19\.62\) m, v \(9, -19\.62\) m/s$' out
check '(first bodies)' says '^  b4 +x = 8 m' out
check '(last bodies)' says '^  b10 +x = 20 m' out
check '(and no others)' sh -c '! grep "^  b5 " out'
check '(the largest force, 13 kg g)' says '^  gravity on b13 +\(0, -127\.53\) N$' out
check '(the energy)' says '^  residual ' out
check '(and what is left out)' says 'Left out: the equations at the start, each event, 5 final states.*--full' out
check '--full has all' exits 0 run --full many.yaml
check '(equations)' says '^Equations at t' out
check '(each body)' says '^  b7 +x = 14 m' out
check '--full without a report is a mistake' exits 2 run --full --quiet many.yaml
check 'as it is without a run' exits 2 run --full --equations many.yaml

# ---- degrees
degrees() { # degrees COLUMN FILE FACTOR: that number of the last row, times FACTOR
    tail -n 1 "$2" | cut -d, -f"$1" | awk -v f="$3" '{printf "%.9f", $1*f}'
}
same_motion() {
    "$program" --csv rad.csv --quiet "$pendulum" && "$program" --degrees --csv deg.csv --quiet "$pendulum" &&
        [ "$(degrees 2 deg.csv 1)" = "$(degrees 2 rad.csv 57.29577951308232)" ] &&
        [ "$(degrees 3 deg.csv 1)" = "$(degrees 3 rad.csv 57.29577951308232)" ]
}
check '--degrees shows angles and rates of CSV in degrees' same_motion
check '(its header says so)' says '^t \[s\],pendulum\.theta \[deg\],pendulum\.omega \[deg/s\]$' deg.csv
check '(the start is 60 deg, to rounding)' says '^0,(60|59.99999999999999),0$' deg.csv
check 'the report has them' exits 0 run --degrees "$pendulum"
check '(theta)' says '^  pendulum +theta = -59\.8488635 deg +omega = 11\.7772049 deg/s$' out
check '(equations hold in radians)' says '^    omega_dot +-8\.01482001 +rad/s\^2$' out
check 'JSON has them' exits 0 run --degrees --json - "$pendulum"
check '(and says so)' says '"angles": "deg"' out
check '(theta)' says '"theta": -59\.84886' out
check 'error bars have them' exits 0 run --degrees --error-bars --csv - "$pendulum"
check '(in the header)' says 'pendulum\.theta ± \[deg\],pendulum\.omega \[deg/s\],pendulum\.omega ± \[deg/s\]' out
check 'lengths stay' exits 0 run --degrees --csv - "$models/kinetics/incline.yaml"
check '(as they are)' says '^t \[s\],block\.x \[m\],block\.v \[m/s\]$' out
check 'a plain number of --at is one of degrees' exits 0 run --degrees --equations --at theta=30 "$pendulum"
cp out plain
check '(30 deg)' sh -c "'$program' --equations --at 'theta=30 deg' '$pendulum' | cmp - plain"
check 'with a unit it is what it says' sh -c "'$program' --degrees --equations --at 'theta=0.5235987755982988 rad' '$pendulum' | cmp - plain"
check 'and a rate one of degrees in a second' exits 0 run --degrees --svg out.svg --at theta=10 --at omega=30 --quiet "$pendulum"
check '--equations has coordinates in degrees' exits 0 run --degrees --equations --json - --at theta=30 --at omega=90 "$pendulum"
check '(as it says)' says '"angles": "deg"' out
check '(theta and omega)' says '"coordinates": \{"pendulum.theta": (30|29\.9999999999999[0-9]*|30\.0000000000000[0-9]*), "pendulum.omega": 90\}' out
check '(terms hold in radians)' says '"name": "omega_dot", "value": -4.62735849' out
degrees_of() { # degrees_of ARGUMENT...: the first coordinate in JSON, with and without --degrees, is one angle
    "$program" "$@" --json rad.json --quiet; "$program" --degrees "$@" --json deg.json --quiet # 1 where it does not balance
    value() { sed -n 's/.*"\(coordinates\|equilibrium\)": {"[^"]*": \([^,}]*\).*/\2/p' "$1"; }
    grep -q '"angles": "deg"' deg.json && ! grep -q '"angles"' rad.json &&
        awk -v d="$(value deg.json)" -v r="$(value rad.json)" 'BEGIN {x = r*57.29577951308232 - d; exit !(d*d > 1 && x*x < 1e-20*d*d)}'
}
check '--static has its place in degrees' degrees_of --static --at 'theta=0.3 rad' "$pendulum"
check '--linearize its equilibrium' degrees_of --linearize --at 'theta=3 rad' "$pendulum"
check '(in the text as well)' exits 0 run --degrees --linearize --at 'theta=190' "$pendulum"
check '(180 deg)' says '^  pendulum\.theta = 180 deg$' out
check '(frequencies are in rad/s)' says 'time constant|rad/s' out
check '--gnuplot plots them' exits 0 run --quiet --degrees --gnuplot - --plot-of pendulum.theta,pendulum.omega,energy.kinetic "$pendulum"
check '(axes)' says "^set ylabel 'pendulum\.theta \[deg\]'" out
check '(rates)' says "^set ylabel 'pendulum\.omega \[deg/s\]'" out
check '(numbers)' says '^0 60 0 0$' out
check 'a page knows' exits 0 run --quiet --degrees --html page.html "$pendulum"
check '(that they are shown so)' sh -c 'grep -q "\"angles\":\"deg\"" page.html'
check 'where no angle is written it is a mistake' exits 2 run --degrees --check "$pendulum"
check '(as with --explain)' exits 2 run --degrees --explain "$pendulum"

# ---- a name that is longer than its column stands apart from its number, and that from its unit
printf 'fbd: 1\nbodies:\n  a_block_of_long_name:\n    mass: 0.123456789 kg\n    motion: slide\n    forces:\n' >long.yaml
printf '      - applied: {name: the_force_that_pushes_it, value: -0.0123456789 N}\nsimulate: {until: 1 s}\n' >>long.yaml
check 'long names are equations, too' exits 0 run long.yaml
check '(force)' says '^    the_force_that_pushes_it +-0\.0123456789 N$' out
check '(state)' says '^  a_block_of_long_name +x = [-0-9.]+ m +v = [-0-9.]+ m/s$' out

# ---- a mass that flows is kg/s, a damper N*s/m, as the file has them
flow() { # flow UNIT: a tank that loses mass, and a damper
    printf 'fbd: 1\nparameters: {b: 0.1 %s, c: 3 N*s/m}\nbodies:\n' "$1"
    printf '  tank: {mass: "2[kg] - b*t", motion: slide, forces: [damper: c]}\nsimulate: {until: 1 s}\n'
}
flow kg/s >flow.yaml
check 'a flow of mass is shown in kg/s' exits 0 run flow.yaml
check '(the flow)' says '^  b +=  ?0\.1 kg/s$' out
check '(the damper)' says '^  c +=  ?3 N\*s/m$' out
check 'also where it is set by a bare number' exits 0 run --set b=0.2 flow.yaml
check '(the flow)' says '^  b +=  ?0\.2 kg/s$' out
program=$FBD_BUILD_ROOT/apps/fbd-sweep
check 'sweeps have them' exits 0 run --quiet --degrees --vary 'theta0=30,60 deg' --output 'theta,max(omega),t' "$pendulum"
check '(header)' says '^run,theta0[^,]*,pendulum\.theta \[deg\],max\(pendulum\.omega\) \[deg/s\],t \[s\],' out
check '(values)' says '^2,[^,]*,-59\.8488634' out
finish
