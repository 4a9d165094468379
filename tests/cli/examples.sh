#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The models that fbd-run contains: the list, each of them byte for byte, near names, and completion.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"

lists_all() {
    run --examples || return 1
    for file in "$models"/*/*.yaml; do
        title=$(sed -n 's/^title: //p' "$file" | head -n 1)
        grep -qE "^  ([a-z]+/)?$(basename "$file" .yaml) " out && grep -qF "  $title" out || {
            echo "$file is missing"
            return 1
        }
    done
    (cd "$models" && ls) >topics
    grep -E '^[a-z]+$' out | same topics -
}

prints_all() {
    for file in "$models"/*/*; do
        name=${file#"$models"/}
        run --example "${name%.yaml}" && cmp out "$file" && is_empty err || return 1
    done
}

names_are_unique() { # those that the shell completes
    "$program" --completion examples >names
    [ "$(wc -l <names)" -eq "$(ls "$models"/*/* | wc -l)" ] && sort names | uniq -d | same /dev/null - && run --example "$(head -n 1 names)"
}

refuses() { # refuses PATTERN ARGUMENT...: exit 2, nothing on standard output
    pattern=$1
    shift
    exits 2 run "$@" && is_empty out && says "$pattern" err
}

runs_alone() { # in an empty folder, with nothing but the program
    mkdir alone && cp "$program" alone/fbd && cd alone || return 1
    ./fbd --example incline >incline.yaml && ./fbd --quiet incline.yaml
    code=$?
    cd ..
    return $code
}

bash_completes() {
    bash -c 'eval "$("$1" --completion bash)"
        PATH=$(dirname "$1"):$PATH
        COMP_WORDS=(fbd-run --example incl); COMP_CWORD=2; _fbd_run
        echo "${COMPREPLY[*]}"
        [ "${COMPREPLY[*]}" = "incline incline_slides_back" ]' - "$program"
}

check '--examples lists every model with its title, by topic' lists_all
check '--example prints every file of the folder byte for byte' prints_all
check 'every name that the shell completes stands for one file' names_are_unique
check 'a name may end in .yaml' run --example incline.yaml
check 'a model runs from the program alone' runs_alone
check 'a slip is answered with near names' refuses 'no example is called `inclin`: did you mean .*incline' --example inclin
check 'a part of a name is answered' refuses 'did you mean .*double_pendulum' --example pendulum
check 'an unlike name is refused' refuses 'no example is called `xyzxyz`$' --example xyzxyz
check 'a name of two topics names both' refuses 'contact/ladder, statics/ladder' --example ladder
check 'a wrong topic is no example' refuses 'did you mean .*, incline,' --example statics/incline
check 'a name longer than any' refuses 'no example' --example "$(printf '%0200d' 0)"
check 'without a name' refuses 'wants a value' --example
check 'beside a model' refuses 'stand alone' --examples "$models/kinetics/incline.yaml"
check 'beside another option' refuses 'stand alone' --quiet --examples
check 'both at once' refuses 'only one of' --examples --example incline
check 'bash completes the names' bash_completes
finish
