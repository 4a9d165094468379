#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What a file, a path or a word of the command line holds never reaches a terminal raw, and never breaks what
# programs read.
set -u
. "$FBD_SOURCE_ROOT/tests/cli/program.sh"

nasty() {
    python3 "$FBD_SOURCE_ROOT/tests/cli/nasty.py" "$1" "$FBD_BUILD_ROOT/apps"
}
check 'titles: every output of fbd-run shows them escaped, and is well formed' nasty titles
check 'titles: so does every output of fbd-cost' nasty studies
check 'paths: in diagnostics, and in tables' nasty paths
check 'words of the command line' nasty words
check 'names, keys, units and expressions of a file' nasty files

# ---- on a terminal
printf 'fbd: 1\ntitle: "\\e]0;pwned\\a\\e[31mred"\nbodies: {b: {mass: 2 kg, motion: slide}}\nsimulate: {until: 1 s}\n' >escape.yaml
on_terminal() {
    TERM=xterm python3 -c 'import pty, sys
pty.spawn(sys.argv[1:])' "$program" escape.yaml </dev/null >out
    says 'x1b]0;pwned.x07.x1b\[31mred' out && ! grep -q "$(printf '\033')[]0[]" out
}
check 'a title on a terminal' on_terminal
finish
