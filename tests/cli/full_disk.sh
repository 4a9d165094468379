#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Whatever goes to standard output and does not arrive there, since the disk is full, the stream is closed or
# nobody reads any more, is no success.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
apps=$(dirname "$FBD_RUN")
incline=$models/kinetics/incline.yaml
truss=$models/statics/truss.yaml

cat >lines <<END
fbd-run --help
fbd-run --version
fbd-run $incline
fbd-run --csv - $incline
fbd-run --json - $incline
fbd-run --html - $incline
fbd-run --gnuplot - $incline
fbd-run --svg - $incline
fbd-run --equations $incline
fbd-run --equations --svg - $incline
fbd-run --linearize $models/vibration/hanging_spring.yaml
fbd-run --linearize --svg - $models/vibration/hanging_spring.yaml
fbd-run --static $truss
fbd-run --static --json - $truss
fbd-run --explain $incline
fbd-run --check-hand $incline
fbd-cost --help
fbd-cost --version
fbd-cost --budget 0.1 --methods dop853 --until 0.1 $incline
fbd-cost --budget 0.1 --methods dop853 --until 0.1 --csv - $incline
fbd-cost --budget 0.1 --methods dop853 --until 0.1 --json - $incline
fbd-cost --budget 0.1 --methods dop853 --until 0.1 --svg - $incline
fbd-cost --effects --budget 0.1 --until 0.1 $incline
fbd-sweep --help
fbd-sweep --version
fbd-sweep --vary mu_s=0.1:0.6:3 --jobs 2 $incline
END

to_full_disk() {
    "$apps/$@" >/dev/full 2>err
}

to_closed_stream() {
    "$apps/$@" >&- 2>err
}

to_nobody() { # where the signal is ignored, an error is reported
    "$FBD_SOURCE_ROOT/tests/tools/to_nobody" --ignored "$apps/$@" 2>err
}

one_line_says() { # one_line_says PATTERN
    [ "$(wc -l <err)" -eq 1 ] && says "$1" err
}

fails() { # fails WAY REASON ARGUMENT...
    way=$1 reason=$2
    shift 2
    exits 1 "$way" "$@" && one_line_says "^$1: cannot write .*(standard output|.-.): $reason"
}

while read -r line; do
    name=$(echo "$line" | sed "s,$models/,,")
    check "$name: to a full disk" fails to_full_disk 'No space left on device' $line
    check "$name: to a closed stream" fails to_closed_stream 'Bad file descriptor' $line
done <lines
check 'to a closed pipe, with SIGPIPE ignored' fails to_nobody 'Broken pipe' fbd-run "$incline"
check 'so with --help' fails to_nobody 'Broken pipe' fbd-run --help
check 'and of a sweep' fails to_nobody 'Broken pipe' fbd-sweep --vary mu_s=0.1:0.6:3 "$incline"
by_the_signal() {
    exits 141 "$FBD_SOURCE_ROOT/tests/tools/to_nobody" "$FBD_RUN" "$incline" 2>err && [ ! -s err ]
}
check 'the signal ends it without a word' by_the_signal

# ---- what is opened first does not become standard output or standard error
check 'a file is not printed into when standard output is closed' exits 1 to_closed_stream fbd-run --csv o.csv "$incline"
run --csv whole.csv "$incline"
check 'nor when standard error is' sh -c '"$FBD_RUN" --quiet --csv o.csv "$0" 2>&- && cmp o.csv whole.csv' "$incline"
check 'a wrong file is wrong all the same' sh -c '"$FBD_RUN" --csv o.csv "$FBD_SOURCE_ROOT/README.md" 2>&-; [ $? -eq 3 ]'
check 'without standard input and output, too' \
    sh -c '"$FBD_RUN" --quiet --csv o.csv "$0" <&- >&- && cmp o.csv whole.csv' "$incline"
check 'a model on a closed standard input cannot be read' \
    sh -c '"$FBD_RUN" - <&- 2>err; [ $? -eq 3 ] && grep -q "Bad file descriptor" err'
finish
