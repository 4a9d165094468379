# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the tests of the programs share, beside tests/tools/tap.sh: $program (fbd-run, if nothing else is said) is
# run in the scratch directory, with its output in `out` and its diagnostics in `err`.
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
models=$FBD_SOURCE_ROOT/models
program=$FBD_RUN
cd "$scratch" || exit 1

run() { # run ARGUMENT...: exit code kept
    "$program" "$@" >out 2>err
}

says() { # says PATTERN FILE
    grep -aE -- "$1" "$2" && return 0
    cat "$2"
    return 1
}

is_empty() { # is_empty FILE: nothing was printed there
    [ ! -s "$1" ] || {
        cat "$1"
        return 1
    }
}

is_absent() {
    [ ! -e "$1" ]
}
