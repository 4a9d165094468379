#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Models as keys (every sixth; each with FBD_DRAWS): their sheets can be read and do not pass; what is refused.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
models="$FBD_SOURCE_ROOT/models"
examples="$FBD_SOURCE_ROOT/examples/grading"
cd "$scratch" || exit 1
every=6
if [ "${FBD_THOROUGH-}" = no ]; then every=24; fi
if [ -n "${FBD_DRAWS-}" ]; then every=1; fi
keys=$(ls "$models"/*/*.yaml | awk "NR % $every == 0")

sheets_are_models() {
    cp "$models"/data/*.csv .
    for model in $keys; do
        "$FBD_RUN" --handout --student 'a "name"' "$model" >sheet.yaml || { echo "$model: no sheet"; return 1; }
        ! grep -E '^    (hand|forces|moments): *[^ ]|^      - ' sheet.yaml || { echo "$model: tells the key"; return 1; }
        "$FBD_RUN" --check sheet.yaml >checked 2>&1
        [ $? -ne 3 ] || { echo "$model: its sheet is wrong"; cat checked; return 1; }
        exits 4 "$FBD_RUN" --quiet --grade "$model" sheet.yaml || { echo "$model: its sheet passes"; return 1; }
    done
}

solutions_pass() {
    for model in $(echo "$keys" | awk 'NR % 3 == 1'); do
        "$FBD_RUN" --handout --solution --student anna "$model" >solution.yaml 2>said || { cat said; return 1; }
        exits 0 "$FBD_RUN" --quiet --grade "$model" --student anna solution.yaml 2>said ||
            { echo "$model: its solution does not pass"; "$FBD_RUN" --details --grade "$model" --student anna solution.yaml; return 1; }
    done
}

says() { # says PATTERN COMMAND...: exits 2 and says so
    pattern=$1
    shift
    exits 2 "$@" >said 2>&1
    grep -E -- "$pattern" said || { cat said; return 1; }
}

check 'every sheet is a model that does not pass, without forces and derivations' sheets_are_models

check 'every solution gets all points' solutions_pass

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
        "$answer,$answer.yaml,0,5,0,no,0,0,0,0,0,0,0,0,0,0,0,0,0,$([ $answer = broken ] && echo 1,0,0 || echo 0,0,1)"
done
check 'one that passes beside one that is missing is 4' exits 4 "$FBD_RUN" --grade key.yaml key.yaml nowhere.yaml
check 'one that passes is 0' exits 0 "$FBD_RUN" --grade key.yaml --student key key.yaml
check 'a key that is wrong is 3' exits 3 "$FBD_RUN" --grade broken.yaml answer.yaml
check 'a key without anything to grade is 3' exits 3 "$FBD_RUN" --grade list.yaml answer.yaml
asks_for_reactions() { # asks_for_reactions OPTION...: the warning of the key beam.yaml
    "$FBD_RUN" "$@" >/dev/null 2>said && [ "$(grep -c 'key-differs' said)" -eq 1 ] && grep -q '`A` on `beam`' said
}
sed 's/^bodies:/grading: {pass: 0.5}\nbodies:/' "$FBD_SOURCE_ROOT/tests/grade/cases/beam_key.yaml" >beam.yaml
check 'a key that does not say which reactions are drawn is warned of where it is handed out' asks_for_reactions --handout --student anna beam.yaml
check 'and where it is checked' asks_for_reactions --check beam.yaml
check 'by standard input too' asks_for_reactions --check - <beam.yaml
sed 's/^grading.*//' beam.yaml >model.yaml
check 'a model that says nothing of grading is no key' sh -c '"$FBD_RUN" --check model.yaml 2>said && ! grep -q . said'
printf 'fbd: 1\nbodies: {b: {mass: 1, motion: slide}}\ngrading: {pass: 0.5}\nsimulate: {until: 1}\n' >bare.yaml
check 'a key without points is 3 where it is checked' exits 3 "$FBD_RUN" --check bare.yaml
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

check 'a sheet is a page to draw on, which for an exam has nothing of the key' sh -c \
    '"$FBD_RUN" --handout --student anna --page sheet.html --exam key.yaml && grep -q "Sheet of anna" sheet.html && ! grep -E "P\*L|pull" sheet.html'
check 'a page without --handout: usage' says 'go with --handout' "$FBD_RUN" --page sheet.html key.yaml
check 'of grading: usage' says 'go with --handout' "$FBD_RUN" --grade key.yaml --page sheet.html answer.yaml
check '--exam without a page: usage' says 'goes with --handout and --page' "$FBD_RUN" --handout --student anna --exam key.yaml
check 'a solution to draw on: usage' says 'to be drawn on' "$FBD_RUN" --handout --student anna --solution --page sheet.html key.yaml
check 'a page is not written over the key' says 'over' "$FBD_RUN" --handout --student anna --page ./key.yaml key.yaml
check 'a page that cannot be written is 1' exits 1 "$FBD_RUN" --handout --student anna --page nowhere/sheet.html --exam key.yaml
check 'and says so' says 'cannot write `nowhere/sheet.html`' "$FBD_RUN" --handout --student anna --page nowhere/sheet.html --exam key.yaml
check 'a page may go to standard output' sh -c \
    '"$FBD_RUN" --handout --student anna --page - --exam key.yaml | cmp - sheet.html'
check 'a page needs a name' says 'student' "$FBD_RUN" --handout --page sheet.html key.yaml
check 'a page of a key without bodies is 3' exits 3 "$FBD_RUN" --handout --student anna --page none.html list.yaml
check 'and nothing is written of it' test ! -e none.html

cat >tables.yaml <<'END'
fbd: 1
tables: {push: /etc/passwd}
bodies:
  rod: {mass: 1 kg, motion: {particle: {}}, forces: [gravity, applied: {name: f, fx: push(t), fy: 0}]}
END
check 'an answer reads no files' sh -c 'FBD=$("$FBD_RUN" --grade key.yaml tables.yaml 2>&1); ! printf "%s" "$FBD" | grep root:'
check 'nor names one' sh -c '"$FBD_RUN" --grade key.yaml tables.yaml | grep -q "line 2: \`push\`: an answer reads no files"'
sed 's,push: /etc/passwd,push: {file: /etc/passwd},' tables.yaml >mapped.yaml
check 'in a mapping either' sh -c '"$FBD_RUN" --grade key.yaml mapped.yaml | grep -q "line 2: \`push\`: an answer reads no files"'
printf 't,f\n0,1\n1,2\n' >push.csv
sed -e 's,passwd,push.csv,; s,/etc/,,' tables.yaml >table_key.yaml
check 'but that of the sheet' exits 0 "$FBD_RUN" --quiet --grade table_key.yaml --student a table_key.yaml

finish
