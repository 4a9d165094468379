#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# --error-bars and --accuracy as a user meets them: columns, keys, the report, exit codes.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
belt=$models/hard/stick_slip_belt.yaml
pendulum=$models/rotation/simple_pendulum.yaml

# ---- error bars
run --csv plain.csv --ledger --quiet "$belt"
check 'error bars are an option of a run' exits 0 run --csv bars.csv --ledger --error-bars --quiet "$belt"
check 'each column but t has one beside it, none is negative, and the others are the same to the last bit' python3 - <<'END'
import csv
bars = list(csv.reader(open("bars.csv", encoding="utf-8")))
plain = list(csv.reader(open("plain.csv", encoding="utf-8")))
assert bars[0][1::2] == plain[0][1:] and bars[0][0] == "t [s]"
assert bars[0][2::2] == [name.replace(" [", " ± [") for name in plain[0][1:]], bars[0]
assert [[row[0]] + row[1::2] for row in bars] == plain
assert all(float(cell) >= 0 for row in bars[1:] for cell in row[2::2])
assert any(float(cell) > 0 for row in bars[1:] for cell in row[2::2])
END
check 'JSON has an error for each number' python3 - "$FBD_RUN" "$belt" <<'END'
import json, subprocess, sys
def run(*options):
    return json.loads(subprocess.run([sys.argv[1], "--json", "-", *options, sys.argv[2]], capture_output=True, check=True).stdout)
result, plain = run("--error-bars"), run()
assert result["final"] == plain["final"]
assert set(result["final_error"]["block"]) == {"x", "v"}
assert all(e["t_error"] > 0 for e in result["events"]) and len(result["events"]) == 101
assert set(result["forces"]["block"]["friction"]["error"]) == {"fx", "fy", "moment", "power", "work"}
assert set(result["energy_error"]) == {"kinetic", "potential", "work", "residual"}
assert 0 < result["stats"]["error_estimate"] < 1e-8
assert plain["stats"]["error_estimate"] is None and "final_error" not in plain
END
check 'the delay of a breakaway, whose force passes its limit by rounding, is in its error: 1.4715 s by hand' python3 - "$FBD_RUN" "$models/contact/push_slide_or_tip.yaml" <<'END'
import json, subprocess, sys
for options in ([], ["--method", "dop853", "--tolerance", "1e-14"]):
    out = subprocess.run([sys.argv[1], "--json", "-", "--error-bars", *options, sys.argv[2]], capture_output=True, check=True).stdout
    breakaway = [e for e in json.loads(out)["events"] if e["kind"] == "breakaway"]
    assert breakaway and all(abs(e["t"] - 1.4715) <= e["t_error"] < 1e-9 for e in breakaway), breakaway
END
check 'the report has them' run --error-bars "$belt"
check 'at the end' says 'x = 0\.[0-9]+ ± [0-9.]+e-[0-9]+ m ' out
check 'at events' says 't = 0\.1962 ± [0-9.]+e-[0-9]+ s +block +breakaway' out
check 'in energies' says 'kinetic .* ± [0-9.]+e-[0-9]+ +J' out
check 'and says what they cost' says 'global error about .* the estimate took [0-9]+ steps' out
check 'where there is no run they are 2' exits 2 run --error-bars --check "$belt"

# Henon and Heiles' potential at an energy of nearly 1/6, where nearly all motions are chaotic (Astron. J. 69
# (1964) 73).
cat >chaos.yaml <<'END'
fbd: 1
bodies:
  star:
    mass: 1 kg
    motion: particle
    initial: {x: 0, y: 0, vx: 0.49 m/s, vy: 0.3 m/s}
    forces: [potential: {V: "0.5*1[N/m]*(x^2 + y^2) + 1[N/m^2]*(x^2*y - y^3/3)"}]
simulate: {until: 1000 s}
END
run --error-bars chaos.yaml
check 'a chaotic motion is recognised' says 'two runs of different accuracy part' out

# ---- accuracy
check 'an accuracy is delivered' exits 0 run --accuracy 1e-10 --json - "$pendulum"
check 'and the estimate says so' python3 - <<'END'
import json
stats = json.load(open("out"))["stats"]
assert stats["accuracy"] == 1e-10 and 0 < stats["error_estimate"] <= 1e-10 and stats["runs"] >= 1
END
run --accuracy 1e-10 "$pendulum"
check 'the report says what it cost' says 'requested accuracy 1e-10: reached, with [0-9]+ run' out
check 'the method is kept' exits 0 run --accuracy 1e-7 --method rkf45 "$pendulum"
check 'as it was given' says 'rkf45 at tolerance' out
check 'an accuracy below rounding is 5' exits 5 run --accuracy 1e-16 --csv best.csv "$pendulum"
check 'with the reason' says 'the accuracy 1e-16 was not reached: .* is the best of [0-9]+ runs' err
check 'the report says it' says 'NOT reached' out
check 'and the best run is written, whole' \
    sh -c '[ "$(grep -c "^t \[s\]" best.csv)" -eq 1 ] && [ "$(tail -1 best.csv | cut -d, -f1)" = 10 ]'
check 'accuracy and tolerance are 2' exits 2 run --accuracy 1e-8 --tolerance 1e-8 "$pendulum"
check 'with a hint' says 'give either an accuracy, or a tolerance or step' err
check 'accuracy and step are 2' exits 2 run --accuracy 1e-8 --step 0.1 "$pendulum"
check 'a large accuracy is 2' exits 2 run --accuracy 1 "$pendulum"
check 'the state at a time is had accurately, too' exits 0 run --accuracy 1e-9 --equations --at 5 "$pendulum"
sed 's/until: 10 s/accuracy: 1e-9\n  until: 10 s/' "$pendulum" >file.yaml
check 'a file may ask for an accuracy' exits 0 run file.yaml
check 'which is delivered' says 'requested accuracy 1e-09: reached' out
check 'an option stands before the file' exits 0 run --tolerance 1e-4 file.yaml
check 'and then there is no accuracy to be reached' says 'tolerance 0.0001' out
finish
