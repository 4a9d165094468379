# SPDX-License-Identifier: GPL-3.0-or-later
#
# Read by tests in sh, after tap.sh: run fbd-run, and look at its texts and its JSON. In $scratch.
cd "$scratch" || exit 1

run() { # run ARGUMENT...: output and diagnostics apart, exit code kept
    "$FBD_RUN" "$@" >out 2>err
}

says() { # says PATTERN FILE
    grep -E -- "$1" "$2" && return 0
    cat "$2"
    return 1
}

# json EXPRESSION: of the object `it`, printed to out; `of` has its parameters by name
json() {
    python3 -c "import json, sys; it = json.load(open('out'))
of = {p['name']: p for p in it.get('parameters', []) if 'name' in p}
sys.exit(not ($1))"
}
