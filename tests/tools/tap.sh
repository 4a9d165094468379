# SPDX-License-Identifier: GPL-3.0-or-later
#
# TAP for shell tests. Include it, make claims, finish:
#
#     . "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
#     check 'a model without faults passes' "$FBD_RUN" --check model.yaml
#     check 'a missing file is a usage error' exits 2 "$FBD_RUN" nowhere.yaml
#     finish
#
# $scratch is a directory that goes away at the end. A claim that fails shows what its command printed.

tap_count=0
tap_failed=0
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
trap 'exit 1' INT TERM

# check CLAIM COMMAND [ARGUMENT...]: the claim holds when the command exits 0.
check() {
    tap_claim=$1
    shift
    tap_count=$((tap_count + 1))
    if "$@" >"$scratch/.output" 2>&1; then
        printf 'ok %d - %s\n' "$tap_count" "$tap_claim"
    else
        tap_failed=$((tap_failed + 1))
        printf 'not ok %d - %s\n' "$tap_count" "$tap_claim"
        sed 's/^/# /' "$scratch/.output"
    fi
}

# exits CODE COMMAND [ARGUMENT...]: succeeds when the command ends with that code.
exits() {
    tap_wanted=$1
    shift
    tap_code=0
    "$@" || tap_code=$?
    [ "$tap_code" -eq "$tap_wanted" ] || {
        printf 'exit code %d instead of %d\n' "$tap_code" "$tap_wanted"
        return 1
    }
}

# same EXPECTED ACTUAL: succeeds when two files are equal, shows the difference otherwise.
same() {
    diff -u "$1" "$2"
}

# finish: print the plan, and end the script with its verdict.
finish() {
    printf '1..%d\n' "$tap_count"
    [ "$tap_failed" -eq 0 ]
    exit
}
