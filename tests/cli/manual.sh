#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# The manual page and --help speak of the same options.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"

same_options() {
    "$FBD_RUN" --help | grep -oE -- '--[a-z][a-z-]*' | sort -u >"$scratch/help"
    sed -n 's/^\.It Fl -\([a-z-]*\).*/--\1/p' "$FBD_SOURCE_ROOT/docs/man/fbd-run.1" | sort -u >"$scratch/manual"
    [ -s "$scratch/help" ] && same "$scratch/help" "$scratch/manual"
}

check 'the manual page has the options of --help' same_options
finish
