#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# fbd-sweep as a user meets it: tables, exit codes, what a kill leaves and how it is gone on with, ranks.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"
program=$FBD_BUILD_ROOT/apps/fbd-sweep
incline=$FBD_SOURCE_ROOT/models/kinetics/incline.yaml

rows() { # rows NUMBER FILE: so many, besides the header
    [ "$(wc -l <"$2")" -eq $(($1 + 1)) ] || {
        wc -l "$2"
        return 1
    }
}

# ---- tables
check 'a sweep that ends well is 0' exits 0 run --vary 'phi=0:60 deg:3' --vary v0=1,2 "$incline"
check 'and has a row for each run' rows 6 out
check 'under a header with names and units' \
    says '^run,phi \[deg\],v0 \[m/s\],t \[s\],block.x \[m\],block.v \[m/s\],events,status,reason$' out
check 'a pipe sees no progress' is_empty err
check 'a question in the place of outputs is 0' exits 0 run --vary mu_s=0.2,0.5 --set mu_k=0.1 --set v0=0 --set f1=0 --find 'phi=1..60 deg: block slips' "$incline"
check 'and has the value, its error and their number' says '^run,mu_s,phi \[deg\],error \[deg\],solutions,runs,status,reason$' out
check 'for each run' says '^1,0.2,11.309932474[0-9]*,' out
check 'and the next' says '^2,0.5,26.56505117[0-9]*,[0-9.e-]+,1,[0-9]+,done,$' out
check 'a limit of statics' exits 0 run --vary 'phi=50:70 deg:3' --static --find 'mu = 0.1..1' "$FBD_SOURCE_ROOT/models/statics/ladder.yaml"
check 'has the same table for any number of threads' sh -c '"$0" --quiet --jobs 3 --vary "phi=50:70 deg:3" --static --find "mu = 0.1..1" "$1" | cmp - out' "$program" "$FBD_SOURCE_ROOT/models/statics/ladder.yaml"
check 'no value is an empty one' exits 0 run --vary mu_s=0.2,0.5 --find 'phi=1..2 deg: block.x = 900 m' --runs 3 "$incline"
check 'of no solutions' says '^1,0.2,,,0,[0-9]+,done,$' out
check 'a wrong value is a row' exits 1 run --vary mu_k=0.3,-1 --find 'phi=1..60 deg: block.x = 0.7 m' "$incline"
check 'with its reason' says '^2,-1,,,,,wrong,.*must be zero or above' out
check 'a wrong question is 2' exits 2 run --vary mu_s=0.2,0.5 --find 'phi=1..60 deg: block slides' "$incline"
check 'outputs do not go with a question' exits 2 run --vary mu_s=0.2,0.5 --find 'phi=1..60 deg: block slips' --output t "$incline"
check 'statics go with one' exits 2 run --vary mu_s=0.2,0.5 --static "$incline"
check 'a run that cannot be is a row and 1' exits 1 run --vary mu_k=-0.2,0.3 "$incline"
check 'with its reason' says '^1,-0.2,,,,,wrong,.*`kinetic` must be zero or above' out
check 'and the others are made' says '^2,0.3,3,0.908.*,done,$' out
check 'and counted' says '1 of 2 runs did not succeed' err
check '--quiet says nothing of it' exits 1 run --quiet --vary mu_k=-0.2,0.3 "$incline"
check 'at all' is_empty err

same_as_run() { # same_as_run PARAMETER VALUE...: final x and v, digit by digit as fbd-run has them
    name=$1
    shift
    for value; do
        "$program" --vary "$name=$value" --output x,v "$incline" | sed -n 's/^1,[^,]*,\([^,]*\),\([^,]*\),.*/\1 \2/p' >swept
        "$FBD_RUN" --set "$name=$value" --csv - "$incline" | sed -n '$s/^3,\([^,]*\),\([^,]*\)$/\1 \2/p' >alone
        [ -s alone ] && cmp swept alone || return 1
    done
}
check 'a row has the digits of fbd-run --set' same_as_run mu_k 0.1 0.37 0.60000000000000009
check 'with units, too' same_as_run phi '10 deg' '0.3 rad' 0.7
check 'and where the model is folded differently' same_as_run f1 0 '50 N' '-1 lbf'

model_from_standard_input() {
    "$program" --vary mu_k=0.2,0.3 "$incline" >one && "$program" --vary mu_k=0.2,0.3 - <"$incline" | same one -
}
check 'the model may come from standard input' model_from_standard_input
check '--set holds for all runs' exits 0 run --set f1=50 --vary mu_k=0.1,0.2 "$incline"
check '(it goes up)' says '^2,0.2,3,[1-9][0-9]' out
check '--until, --method and --tolerance are those of fbd-run' \
    exits 0 run --until 1 --method rkf45 --tolerance 1e-6 --vary mu_k=0.1 "$incline"
check '(until)' says '^1,0.1,1,' out

# A block that slides with constant acceleration takes one exact step for each piece; the general method takes more.
steps() { # steps OPTION...: what a run of the incline takes
    "$program" "$@" --vary mu_k=0.3 --output steps "$incline" | sed -n 's/^1,0.3,\([0-9]*\),.*/\1/p'
}
more_steps() {
    [ "$(steps --no-structure)" -gt "$(steps)" ]
}
check '--no-structure takes the general method' more_steps

sed 's/^simulate: *{until: \([^,}]*\).*/simulate: {until: \1, accuracy: 1e-9}/' "$incline" >accurate.yaml
check 'an accuracy in the file keeps nobody from sweeping' exits 0 run --vary mu_k=0.3 accurate.yaml
check 'but is said not to be used' says 'warning: the `accuracy` of the file is not used by a sweep \[accuracy-not-used\]' err
check 'unless a tolerance is given' exits 0 run --vary mu_k=0.3 --tolerance 1e-9 accurate.yaml
check '(nothing is said)' is_empty err

terminal() { # terminal COMMAND ARGUMENT...: what it shows on a terminal
    TERM=xterm python3 -c 'import pty, sys
pty.spawn(sys.argv[1:])' "$@" </dev/null >out
}
shown=400
if [ "${FBD_THOROUGH-}" = no ]; then shown=100; fi
on_a_terminal() {
    terminal "$program" --vary mu_k=0.1:0.6:$shown --tolerance 1e-3 --method rkf45 --step 5e-4 --jobs 1 \
        --csv shown.csv "$incline"
    rows $shown shown.csv && says "[0-9]+ of $shown runs \\([0-9]+ %\\), [0-9.e+]+ runs/s, [0-9]+ s left" out
}
check 'a terminal sees how far it is and how long it will take' on_a_terminal
check '--quiet shows nothing there' terminal "$program" --quiet --vary mu_k=0.1:0.2:2 --csv hidden.csv "$incline"
check '(nothing)' is_empty out

# ---- usage
check 'no --vary is 2' exits 2 run "$incline"
check 'no model is 2' exits 2 run --vary mu_k=1
check 'an unknown option is 2' exits 2 run --wrong --vary mu_k=1 "$incline"
check 'values that are none are 2' exits 2 run --vary mu_k=1:2 "$incline"
check 'no threads are 2' exits 2 run --jobs 0 --vary mu_k=1 "$incline"
check 'what is no parameter is 2' exits 2 run --vary v=1:2:3 "$incline"
check 'with what to write instead' says 'only parameters vary' err
check 'set and varied is 2' exits 2 run --set mu_k=1 --vary mu_k=1:2:3 "$incline"
check 'an unknown output is 2' exits 2 run --vary mu_k=1 --output block.y "$incline"
check 'an unknown method is 2' exits 2 run --vary mu_k=1 --method rk99 "$incline"
check '--resume without a file is 2' exits 2 run --vary mu_k=1 --resume "$incline"
check 'a file that is not there is 3' exits 3 run --vary mu_k=1 nowhere.yaml
check 'a wrong file is 3' exits 3 run --vary mu_k=1 "$FBD_SOURCE_ROOT/README.md"
check 'a place that cannot be written is 1' exits 1 run --vary mu_k=1 --csv nowhere/table.csv "$incline"
check 'nothing was written for any of these' is_empty out
if [ -w /dev/full ]; then
    check 'a full disk is 1' exits 1 run --vary mu_k=0.1:0.2:10 --csv /dev/full "$incline"
    check 'and said' says 'cannot write' err
fi

# ---- kills: a sweep of about a second, wherever it is cut
count=1000 cases=$((40 * ${FBD_DRAWS:-1}))
if [ "${FBD_THOROUGH-}" = no ]; then count=150 cases=8; fi # a sanitizer takes as much longer
slowly="--vary mu_k=0.1:0.6:$count --tolerance 1e-3 --method rkf45 --step 5e-4"
# shellcheck disable=SC2086
slow() {
    "$program" $slowly "$@" "$incline"
}
slow >whole.csv

written() {
    [ ! -e table.csv.part ] && echo 0 || wc -l <table.csv.part
}

# shellcheck disable=SC2086
killed() { # killed SIGNAL CODE: start or go on, and kill it after some rows; once more where it was done before
    before=$(written)
    rm -rf at_first
    mkdir at_first
    [ "$before" -eq 0 ] || cp table.csv.part table.csv.part.key at_first
    for _ in 1 2 3 4 5 6 7 8 9 10; do
        "$program" $slowly --jobs 2 --csv table.csv --resume "$incline" 2>err &
        process=$!
        while [ "$(written)" -le $((before + 20)) ] && kill -0 $process 2>/dev/null; do
            sleep 0.02
        done
        kill "-$1" $process 2>/dev/null
        wait $process
        code=$?
        [ $code -eq 0 ] || break
        rm -f table.csv
        [ "$before" -eq 0 ] || cp at_first/* .
    done
    [ $code -eq "$2" ] && [ ! -e table.csv ] && [ -s table.csv.part ]
}
first_rows() { # what is there is the beginning of the whole
    head -c "$(wc -c <table.csv.part)" whole.csv | cmp - table.csv.part
}
check 'SIGKILL leaves a partial table' killed KILL 137
check 'SIGTERM ends it with 128 and its number' killed TERM 143
check 'which says how to go on' says "ended by a signal after [0-9]+ of $count runs; go on with --resume" err
check 'what it leaves are the first rows, whole' first_rows
printf '99,0.1,torn' >>table.csv.part
check 'a torn line is dropped: killed again' killed KILL 137
check 'a table that is not whole is not overwritten' exits 2 slow --csv table.csv
check 'another sweep does not go on with it' \
    exits 2 run --vary "mu_k=0.1:0.5:$count" --csv table.csv --resume "$incline"
check 'and says what differs' says "there .vary mu_k=0.1:0.6:$count., here .vary mu_k=0.1:0.5:$count." err
check 'nor does one without structure' exits 2 slow --no-structure --csv table.csv --resume
sed 's/mass: 2 kg/mass: 3 kg/' "$incline" >other.yaml
# shellcheck disable=SC2086
check 'nor does another model' exits 2 "$program" $slowly --csv table.csv --resume other.yaml

damaged() {
    cp table.csv.part bad.csv.part
    cp table.csv.part.key bad.csv.part.key
    printf '\n7,0.1,3,0,0,0,done,\n' >>bad.csv.part
    slow --csv bad.csv --resume 2>err
}
check 'nor does it go on with what is damaged' exits 2 damaged
check 'and says where' says 'is damaged behind row [0-9]+' err
flipped_digit() { # another digit in the fifth row: the table has no sign of it but the checksum
    for place in table.csv.part table.csv.part.key; do cp $place flipped.csv${place#table.csv}; done
    sed -i '6s/\(.*\)[0-8],/\19,/' flipped.csv.part
    ! cmp -s flipped.csv.part table.csv.part && exits 2 slow --csv flipped.csv --resume 2>err && says 'damaged behind row 4: keep its first 5 lines' err
}
check 'nor with a digit that was changed' flipped_digit
cut_there() {
    head -n 5 flipped.csv.part >kept && mv kept flipped.csv.part && slow --csv flipped.csv --resume && same whole.csv flipped.csv
}
check 'but with the lines that are said to be right' cut_there
check 'the rest is made' exits 0 slow --csv table.csv --resume
check 'no row is lost or repeated' same whole.csv table.csv
check 'and nothing lies around' is_absent table.csv.part
check 'not even its key' is_absent table.csv.part.key

# ---- damage: a sweep that is cut by a limit of the size of files, with one byte changed anywhere
check 'whatever byte is changed, a partial table is refused or becomes the whole' python3 - "$program" "$incline" "$cases" <<'END'
import os, random, resource, shutil, subprocess, sys
program, model, cases = sys.argv[1:]
sweep = [program, "--quiet", "--vary", "mu_k=0.1:0.6:40", "--jobs", "1", "--csv", "d.csv"]
def run(*more, **how):
    return subprocess.run([*sweep, *more, model], stderr=subprocess.PIPE, text=True, **how)
run()
whole = open("d.csv", "rb").read()
os.remove("d.csv")
limit = len(whole) // 2
run(preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)))
names = ["d.csv.part", "d.csv.part.key"]
rest = {name: open(name, "rb").read() for name in names}
assert 500 < len(rest[names[0]]) <= limit and whole.startswith(rest[names[0]])
seed = random.randrange(1 << 32)
print("seed", seed)
dice = random.Random(seed)
def change(data, kind, least):
    at = dice.randrange(least, len(data))
    new = bytes([data[at] ^ 1 << dice.randrange(8)])
    return (data[:at], data[:at] + new + data[at + 1:], data[:at] + data[at + 1:], data[:at] + new + data[at:],
            data[:at] + data[data.find(b"\n", at) + 1:])[kind]
ends = {}
for case in range(int(cases)): # all kinds in turn; the first is a row that is torn, which is made anew
    name, kind = names[case // 5 % 2], case % 5
    for other in names: open(other, "wb").write(rest[other])
    open(name, "wb").write(change(rest[name], kind, whole.index(b"\n") + 1 if case == 0 else 0))
    there = open(name, "rb").read()
    done = run("--resume")
    if done.returncode == 2:
        assert done.stderr.startswith("fbd-sweep: `d.csv.part` ") and done.stderr.count("\n") == 1, done.stderr
        assert open(name, "rb").read() == there and not os.path.exists("d.csv"), case
    else:
        assert done.returncode == 0 and open("d.csv", "rb").read() == whole, (case, name, done)
        os.remove("d.csv")
    ends[done.returncode] = ends.get(done.returncode, 0) + 1
print(ends)
assert min(ends.get(0, 0), ends.get(2, 0)) > int(cases) // 30
END

# ---- ranks
if ! command -v mpirun >/dev/null || ! "$program" --vary mu_k=1 "$incline" >/dev/null; then
    echo '# no mpirun here: no ranks'
elif ! ldd "$program" 2>/dev/null | grep -q libmpi; then
    echo '# built without MPI: no ranks'
else
    runs=$((count * 7 / 10 + 1))
    ranks() { # ranks NUMBER ARGUMENT...
        number=$1
        shift
        OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 \
            mpirun --oversubscribe -n "$number" "$program" "$@" >out 2>err
    }
    same_by_ranks() {
        ranks "$1" --vary "mu_k=-0.1:0.6:$runs" --vary v0=1,2,3 --output final,energy,steps "$incline"
        same wanted out
    }
    "$program" --jobs 1 --vary "mu_k=-0.1:0.6:$runs" --vary v0=1,2,3 --output final,energy,steps "$incline" >wanted
    for number in 1 2 4; do
        check "$number ranks write the table of one process" same_by_ranks "$number"
    done
    check 'runs that fail are 1 there, too' says 'runs did not succeed' err
    check 'threads of ranks as well' exits 0 ranks 2 --jobs 2 --vary "mu_k=0.1:0.6:$runs" --csv ranks.csv "$incline"
    "$program" --vary "mu_k=0.1:0.6:$runs" "$incline" >wanted
    check 'write that table' same wanted ranks.csv
    check 'a mistake of usage is said once' exits 2 ranks 4 --vary mu_k=1:2 "$incline"
    check '(once)' test "$(grep -c bad-vary err)" -eq 1
    check 'a wrong file is 3 there, too' exits 3 ranks 2 --vary mu_k=1 nowhere.yaml
fi
finish
