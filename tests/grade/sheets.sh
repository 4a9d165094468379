#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Every model as a key: its sheet can be read and does not pass; what is refused; the examples.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
models="$FBD_SOURCE_ROOT/models"
examples="$FBD_SOURCE_ROOT/examples/grading"
cd "$scratch" || exit 1
every=1
if [ "${FBD_THOROUGH-}" = no ]; then every=18; fi
keys=$(ls "$models"/*/*.yaml | awk "NR % $every == 0")

sheets_are_models() {
    cp "$models"/data/*.csv .
    for model in $keys; do
        "$FBD_RUN" --handout --student 'a "name"' "$model" >sheet.yaml || { echo "$model: no sheet"; return 1; }
        ! grep -E '^    (hand|forces|moments): .*[a-z]' sheet.yaml || { echo "$model: tells the key"; return 1; }
        "$FBD_RUN" --check sheet.yaml >checked 2>&1
        [ $? -ne 3 ] || { echo "$model: its sheet is wrong"; cat checked; return 1; }
        exits 4 "$FBD_RUN" --quiet --grade "$model" sheet.yaml || { echo "$model: its sheet passes"; return 1; }
    done
}

says() { # says PATTERN COMMAND...: exits 2 and says so
    pattern=$1
    shift
    exits 2 "$@" >said 2>&1
    grep -E -- "$pattern" said || { cat said; return 1; }
}

check 'every sheet is a model that does not pass, without forces and derivations' sheets_are_models

cp "$examples/key.yaml" .
sed -e 's/value: P,/value: -P,/' -e '/^    hand:/d' key.yaml >answer.yaml
check 'values are drawn for each student' test "$("$FBD_RUN" --handout --student anna key.yaml | grep ' L: ')" != \
    "$("$FBD_RUN" --handout --student boris key.yaml | grep ' L: ')"
check 'and are the same again' test "$("$FBD_RUN" --handout --student anna key.yaml)" = "$("$FBD_RUN" --handout --student anna key.yaml)"
check 'digits are those that were asked for' sh -c \
    '! "$FBD_RUN" --handout --student anna key.yaml | grep -E "  (L|m|beta): [0-9.]*[0-9][0-9.]*[0-9][0-9.]*[0-9]"'
check 'a value from outside stands on the sheet' sh -c \
    '"$FBD_RUN" --handout --student anna --set "L=1.75 m" --set "m=2[kg]+1[kg]" key.yaml | tee set.yaml | grep -q "^  L: 1.75 m" && grep -q "m: .2\[kg\]+1" set.yaml'
cat >weight.yaml <<'END'
fbd: 1
parameters: {m: 5 kg}
bodies: {block: {mass: m, motion: {particle: {}}, forces: [gravity]}}
grading: {draw: {m: [1 kg, 9 kg]}}
END
sed 's/\[gravity\]/[applied: {name: W, value: 29.43 N, angle: -90 deg}]/' weight.yaml >heavy.yaml
check 'answers are graded with values from outside' exits 0 "$FBD_RUN" --quiet --grade weight.yaml --set m=3kg heavy.yaml
check 'and with no others' exits 4 "$FBD_RUN" --quiet --grade weight.yaml --set m=3.2kg heavy.yaml
check 'nor with those drawn' exits 4 "$FBD_RUN" --quiet --grade weight.yaml heavy.yaml
check 'an unknown name is 3' exits 3 "$FBD_RUN" --handout --student anna --set nothing=1 key.yaml
check 'so is a value of another unit' exits 3 "$FBD_RUN" --grade key.yaml --set "L=2 kg" answer.yaml
check 'an answer that does not pass is 4' exits 4 "$FBD_RUN" --grade key.yaml answer.yaml
check 'a missing one too' exits 4 "$FBD_RUN" --grade key.yaml nowhere.yaml
: >empty.yaml
printf '\n \n' >blank.yaml
printf 'fbd: 1\nbodies: {rod: {mass: 1 kg\n' >broken.yaml
printf '[1, 2]\n' >list.yaml
mkdir folder.yaml
for answer in empty blank broken list folder; do
    check "$answer.yaml too" exits 4 "$FBD_RUN" --grade key.yaml $answer.yaml
    check "$answer.yaml has no points" test "$("$FBD_RUN" --grade key.yaml --quiet --csv - $answer.yaml | tail -1)" = \
        "$answer,$answer.yaml,0,5,0,no"
done
check 'one that passes beside one that is missing is 4' exits 4 "$FBD_RUN" --grade key.yaml key.yaml nowhere.yaml
check 'one that passes is 0' exits 0 "$FBD_RUN" --grade key.yaml --student key key.yaml
check 'a key that is wrong is 3' exits 3 "$FBD_RUN" --grade broken.yaml answer.yaml
check 'a key without anything to grade is 3' exits 3 "$FBD_RUN" --grade list.yaml answer.yaml
cp answer.yaml before.yaml
check 'no answer is written over' says 'over' "$FBD_RUN" --grade key.yaml --csv answer.yaml answer.yaml
check 'nor the key' says 'over' "$FBD_RUN" --grade key.yaml --json ./key.yaml answer.yaml
check 'the answer is as it was' same before.yaml answer.yaml
check 'no answer: usage' says 'no answer' "$FBD_RUN" --grade key.yaml
check 'a sheet needs a name' says 'student' "$FBD_RUN" --handout key.yaml
check 'a name for many: usage' says 'one answer' "$FBD_RUN" --grade key.yaml --student anna answer.yaml key.yaml
check 'options of runs: usage' says 'go --set' "$FBD_RUN" --grade key.yaml --until 3 answer.yaml
check '--details alone: usage' says 'go with --grade' "$FBD_RUN" --details key.yaml
check 'what students see does not name the key' sh -c \
    '! "$FBD_RUN" --grade key.yaml --json - nowhere.yaml answer.yaml | grep -E "gravity.*missing|beta|\"output\""'

cat >tables.yaml <<'END'
fbd: 1
tables: {push: /etc/passwd}
bodies:
  rod: {mass: 1 kg, motion: {particle: {}}, forces: [gravity, applied: {name: f, fx: push(t), fy: 0}]}
END
check 'an answer reads no files' sh -c 'FBD=$("$FBD_RUN" --grade key.yaml tables.yaml 2>&1); ! printf "%s" "$FBD" | grep root:'

mkdir submissions
cp answer.yaml submissions/boris.yaml
cp key.yaml submissions/anna.yaml
: >submissions/clara.yaml
PATH="$(dirname "$FBD_RUN"):$PATH"
export PATH
check 'the loop over a folder' exits 4 "$examples/grade-folder" key.yaml submissions
check 'writes the points of all' test "$(wc -l <submissions/points.csv)" -eq 4
check 'and a text for each' grep -q 'points' submissions/boris.txt
mkdir -p grade/tests grade/student grade/data
cp key.yaml grade/tests/key.yaml
cp answer.yaml grade/student/answer.yaml
echo '{"variant_seed": "17"}' >grade/data/data.json
check 'the grader for PrairieLearn' env GRADE="$scratch/grade" "$examples/prairielearn-run"
check 'writes its results' python3 -c '
import json
it = json.load(open("grade/results/results.json"))
assert it["gradable"] and 0 < it["score"] < 1 and it["student"] == "17"
assert all({"name", "points", "max_points", "message"} <= set(one) for one in it["tests"])'
rm grade/student/answer.yaml
check 'also where nothing was submitted' env GRADE="$scratch/grade" "$examples/prairielearn-run"
check 'without points' python3 -c '
import json
it = json.load(open("grade/results/results.json"))
assert not it["gradable"] and it["score"] == 0'
finish
