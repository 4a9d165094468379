#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The manual pages and --help speak of the same options.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"

same_options() { # same_options PROGRAM
    "$FBD_BUILD_ROOT/apps/$1" --help | grep -oE -- '--[a-z][a-z-]*' | sort -u >"$scratch/help"
    sed -n 's/^\.It Fl -\([a-z-]*\).*/--\1/p' "$FBD_SOURCE_ROOT/docs/man/$1.1" | sort -u >"$scratch/manual"
    [ -s "$scratch/help" ] && same "$scratch/help" "$scratch/manual"
}

for program in fbd-run fbd-cost fbd-sweep; do
    check "the manual page of $program has the options of --help" same_options "$program"
done

server_options() { # server_options PROGRAM: as its parser has them
    sed -n 's/.*add_argument("\(--[a-z-]*\)".*/\1/p' "$FBD_SOURCE_ROOT/python/fbd/${1#fbd-}.py" | { cat; echo --help; } | sort -u >"$scratch/help"
    sed -n 's/^\.It Fl -\([a-z-]*\).*/--\1/p' "$FBD_SOURCE_ROOT/docs/man/$1.1" | sort -u >"$scratch/manual"
    same "$scratch/help" "$scratch/manual"
}

for program in fbd-mcp fbd-lsp; do
    check "the manual page of $program has its options" server_options "$program"
done
finish
