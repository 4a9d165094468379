#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# fbd-run --fit: a damped pendulum measured with noise of a fixed seed; exit codes, text and JSON.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
. "$FBD_SOURCE_ROOT/tests/tools/answers.sh"

cat >pendulum.yaml <<'END'
fbd: 1
parameters: {L: 1 m, c: 0.5 N*m*s/rad, start: 1}
bodies:
  pendulum:
    motion: {pivot: {at: [0, 0]}}
    parts:
      rod: {shape: rod, mass: 0.5 kg, from: [0, 0], to: [0, -L]}
      bob: {shape: point, mass: 2 kg, center: [0, -L]}
    initial: {theta: start}
    forces: [gravity]
    moments: [damper: {name: bearing, coefficient: c}]
simulate: {until: 10 s}
END
"$FBD_RUN" --quiet --csv exact.csv --every 0.1 pendulum.yaml
python3 - <<'END'
import csv, random
noise = random.Random(1)
rows = list(csv.reader(open("exact.csv")))
names = ["t [s]", "pendulum.theta [rad]", "pendulum.omega [rad/s]"]
places = [rows[0].index(name) for name in names]
with open("angle.csv", "w") as angle, open("both.csv", "w") as both:
    print("t [s],pendulum.theta [rad]", file=angle)
    print("t [s],pendulum.theta [rad],pendulum.theta +-,pendulum.omega [rad/s],pendulum.omega +- [rad/s]", file=both)
    for row in rows[1:]:
        t, theta, omega = (float(row[i]) for i in places)
        theta += noise.gauss(0, 0.01)
        print(f"{t},{theta:.6f}", file=angle)
        print(f"{t},{theta:.6f},0.01,{omega + noise.gauss(0, 0.05):.6f},0.05", file=both)
END

sed "s/forces: \[gravity\]/forces: [gravity, {applied: {name: wind, value: ['1[N*s^3]\/(t - 5)^3', 0]}}]/" pendulum.yaml >blows_up.yaml
far="--set L=1.2 --set c=0.1 --set start=0.8"
within='all(of[n]["low"] < v < of[n]["high"] for n, v in {"L": 1, "c": 0.5, "start": 1}.items())'
check 'a fit is 0' exits 0 run --fit angle.csv $far pendulum.yaml
check 'without a diagnostic' test ! -s err
check 'with an error for each parameter' says '^  c  *= 0\.[0-9]+ N\*m\*s  *\+- 0\.00[0-9]+  *95 %: 0\.[0-9]+ to 0\.[0-9]+$' out
check 'and correlations' says '^  start  *L -?0\.[0-9]+  *c -?0\.[0-9]+$' out
check 'JSON in place of the text' exits 0 run --fit angle.csv --json - $far pendulum.yaml
check 'has the true values within its intervals' json "$within"
check 'which are narrow' json 'all(p["error"] < 0.005 for p in it["parameters"])'
check 'and the noise' json '0.008 < it["deviation"] < 0.012 and it["unit"] == "rad" and it["freedom"] == 98'
check 'two quantities with their deviations' exits 0 run --fit both.csv --json - $far pendulum.yaml
check 'have the true values within the intervals too' json "$within"
check 'and squares of about one for each' json 'it["weighted"] and 0.8 < it["deviation"] < 1.2 and it["values"] == 202'
check 'the plot as a script' exits 0 run --fit both.csv --gnuplot - $far pendulum.yaml
check 'has a plot for each quantity' sh -c '[ "$(grep -c "^plot " out)" -eq 2 ]'
check 'of the data with their deviations and the run' says 'measured2 with yerrorbars .* .measured.$' out
check 'in the place of the text' sh -c '! grep -q Correlations out'
if command -v gnuplot >/dev/null; then
    check 'the plot as a picture' exits 0 run --fit angle.csv --plot fit.svg pendulum.yaml
    check 'is one' says '<svg' fit.svg
    check 'a place that is none is 1' exits 1 run --fit angle.csv --plot nowhere/fit.svg pendulum.yaml
fi
check 'columns of a run do not go with it' exits 2 run --fit angle.csv --gnuplot a.gp --plot-of pendulum.theta pendulum.yaml
check 'a note neither' exits 2 run --fit angle.csv --note a.html pendulum.yaml
check 'one parameter alone' exits 0 run --fit angle.csv --parameters c --json - pendulum.yaml
check 'is the only one' json 'list(of) == ["c"] and abs(of["c"]["value"] - 0.5) < 3*of["c"]["error"]'

sed 's/mass: 2 kg/mass: m/; s/parameters: {/parameters: {m: 2 kg, /; s/mass: 0.5 kg/mass: m\/4/' pendulum.yaml >mass.yaml
check 'a parameter that is not determined is 1' exits 1 run --fit angle.csv --parameters m,c mass.yaml
check 'and named' says 'warning: the data do not determine `m`, `c` \[not-determined\]' err
check 'with an unknown error' says '^  m .* \+- unknown ' out
printf 't,pendulum.theta\n0,1\n0.1,one\n' >wrong.csv
check 'wrong data are 2' exits 2 run --fit wrong.csv pendulum.yaml
check 'with line and column' says '^wrong\.csv:3:5: error: `one` is no number \[bad-data\]$' err
check 'a missing file is 2' exits 2 run --fit nowhere.csv pendulum.yaml
check 'and named' says 'cannot read `nowhere\.csv`' err
check 'an unknown parameter is 2' exits 2 run --fit angle.csv --parameters d pendulum.yaml
check 'a wrong method is 2' exits 2 run --fit angle.csv --method euler pendulum.yaml
check 'where runs fail it is 1' exits 1 run --fit angle.csv --set start=0 blows_up.yaml
check 'with the reason' says 'no run with the parameters of the start: .*\[no-fit\]' err
check '--parameters goes with --fit' exits 2 run --parameters c pendulum.yaml
check '--until does not' exits 2 run --fit angle.csv --until 2 pendulum.yaml
check '--find neither' exits 2 run --fit angle.csv --find 'c = 0..1' pendulum.yaml


{ sed -n 1p angle.csv; echo '# the pendulum of the second bench'; sed 1d angle.csv; echo '# end'; } | sed '1i # measured, not computed' >commented.csv
"$FBD_RUN" --fit angle.csv --parameters L --json - pendulum.yaml >plain.json
check 'comment lines of the data are passed over' \
    sh -c '"$FBD_RUN" --fit commented.csv --parameters L --json - pendulum.yaml | sed s/commented.csv/angle.csv/ | cmp - plain.json'
finish
