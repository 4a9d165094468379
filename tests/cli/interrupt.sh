#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# A run that is interrupted (Ctrl-C, SIGTERM) leaves whole files of what was computed, and no others; progress goes
# to a terminal only.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"

# Runs for hours, if one lets it: a pendulum, and a body at rest whose one step has 1e9 rows.
cat >long.yaml <<'END'
fbd: 1
bodies:
  pendulum:
    shape: rod
    mass: 1 kg
    length: 1 m
    motion: {pivot: {at: [0, 0], point: left}}
    forces: [gravity]
simulate: {until: 1e9 s}
END
cat >rest.yaml <<'END'
fbd: 1
bodies:
  block: {mass: 1 kg, motion: slide, forces: [gravity, normal, friction: {static: 1, kinetic: 1}]}
simulate: {until: 1e6 s}
END

cat >run.py <<'END'
"""Usage: run.py [--terminal] SIGNAL COMMAND...: run it, send the signal once it is under way (it has written
rows, or progress to the terminal), print how it ended."""
import os
import pty
import signal
import subprocess
import sys
import time
from pathlib import Path

arguments = sys.argv[1:]
terminal = arguments[0] == "--terminal"
number, *command = arguments[1:] if terminal else arguments
number = getattr(signal, number)


def under_way():
    return any(path.stat().st_size > 0 for path in Path(".").glob("*.csv.??????"))


printed = b""
if terminal:
    child, master = pty.fork()
    if child == 0:
        os.environ["TERM"] = "xterm"
        os.execvp(command[0], command)
    while b" left" not in printed:  # the whole line: what a terminal has not shown at ^C is lost
        printed += os.read(master, 4096)
    os.write(master, b"\x03")
    try:
        while piece := os.read(master, 4096):
            printed += piece
    except OSError:  # the other end is closed
        pass
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
else:
    run = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    while not under_way():
        time.sleep(0.01)
    run.send_signal(number)
    printed, status = run.communicate()[0], run.returncode
sys.stdout.write(printed.decode())
print("ended with", status)
END

nothing_left_behind() {
    left=$(ls | grep -E '\.(csv|json)\.')
    [ -z "$left" ] || {
        echo "$left"
        return 1
    }
}
same_time() { # the last row is the state of the report
    [ "$(tail -1 out.csv | cut -d, -f1)" = "$(sed -n 's/.*"final": {"t": \([^,]*\),.*/\1/p' out.json)" ]
}
run() {
    rm -f out.csv out.json
    python3 run.py "$@" >printed 2>&1
}

run SIGINT "$FBD_RUN" --csv out.csv --json out.json --every 1e3 long.yaml
check 'Ctrl-C ends a run by that signal: 130 in a shell' says '^ended with -2$' printed
check 'it says where' says '^fbd-run: interrupted at t = [0-9]' printed
check 'the report is there' says '^Accuracy and cost' printed
check 'JSON says so' says '"outcome": "interrupted"' out.json
check 'rows end where the run ended' same_time
check 'and no temporary file stays behind' nothing_left_behind
check 'no progress goes into a pipe' sh -c '! grep -q "s left" printed'

run SIGTERM "$FBD_RUN" --csv out.csv --json out.json --every 1e-3 rest.yaml
check 'SIGTERM does the same, also within a step' says '^ended with -15$' printed
check 'rows end where it was cut' same_time
check 'and no temporary file stays behind then' nothing_left_behind

broken_pipe() { # the reader goes after the first row: code of fbd-run, and what it said
    rm -f out.csv out.json
    { "$FBD_RUN" --csv - --json out.json --every 1e3 long.yaml 2>said || echo $? >code; } | head -1 >first
    [ "$(cat code)" -eq 141 ] && [ ! -s said ] && [ ! -e out.json ]
}
check 'a reader that goes away ends a run by SIGPIPE, without a word and without files' broken_pipe
check 'not even temporary ones' nothing_left_behind
report_unread() { # standard output is a pipe whose reader has gone
    rm -f out.csv
    exits 141 "$FBD_SOURCE_ROOT/tests/tools/to_nobody" "$FBD_RUN" --csv out.csv "$FBD_SOURCE_ROOT/models/kinetics/incline.yaml" &&
        [ -s out.csv ]
}
check 'a report that nobody reads takes no file away' report_unread

run --terminal SIGINT "$FBD_RUN" --csv out.csv --json out.json --every 1e3 long.yaml
check 'a terminal shows progress' says 't = [^ ]* of 1e\+09 s \([0-9]* %\), [^ ]* s simulated per second, .* left' printed
check 'Ctrl-C on it ends the run' says '^ended with -2$' printed
check 'with whole files' same_time

run --terminal SIGINT "$FBD_RUN" --accuracy 1e-3 --json out.json long.yaml
check 'no accuracy is claimed for a run that was cut' says 'requested accuracy .*: NOT known' printed
check 'and none is called reached' sh -c '! grep -q "requested accuracy .*: reached" printed'
finish
