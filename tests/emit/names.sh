#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Usage: names.sh FBD-RUN. Names and titles of a file cannot break out of the C that is written, and nothing is half
# written.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"
run=$1

compiles() { # compiles FILE.c
    ${CC:-cc} -std=c17 -trigraphs -O0 -Wall -Wextra -Wpedantic -Werror "$1" -o "$1.out" -lgsl -lgslcblas -lm
}

# Bodies, loads, parameters and events that are words of C, of its headers, and of the program itself.
cat >"$scratch/words.yaml" <<'END'
fbd: 1
title: "*/ int main(void) { return 7; } /* ??/ \\ \u202e // % \" é"
parameters: {int: 2 kg, EOF: 3 N, M_PI: 0.5, p: 1 m/s, y0: 0.1 m, linux: 2 N*s/m, scene: 4 N/m}
bodies:
  double:
    mass: int
    motion: slide
    initial: {v: p}
    forces:
      - gravity
      - normal
      - friction: M_PI
      - applied: {name: for, value: "EOF*sin(3[rad/s]*t)"}
      - spring: {name: vec_add, stiffness: scene, neutral: y0}
  main:
    mass: 1 kg
    motion: {slide: {on: double}}
    forces: [{damper: {name: double_x, coefficient: linux}}]
  _G: {mass: 1 kg, motion: particle, forces: [gravity, {applied: {name: EXIT_FAILURE, value: [EOF, "EOF*x/(1[m])"]}}]}
  errno: {mass: 1 kg, motion: particle}
simulate:
  until: 0.5 s
  events: [{name: break, when: double.x = 0.05}, {name: printf, when: _G.y < -1}]
END
check 'a file of words of C is written' "$run" --emit-c "$scratch/words.c" "$scratch/words.yaml"
check 'and compiles without a warning' compiles "$scratch/words.c"
check 'and runs' "$scratch/words.c.out"
"$run" --emit-c - "$scratch/words.yaml" >"$scratch/again.c"
check 'twice the same' same "$scratch/words.c" "$scratch/again.c"

cp "$FBD_SOURCE_ROOT/models/couplings/gear_pair.yaml" "$scratch/gear_pair.yaml"
echo kept >"$scratch/kept.c"
check 'what is refused exits 3' exits 3 "$run" --emit-c "$scratch/kept.c" "$scratch/gear_pair.yaml"
check 'and leaves the file as it was' grep -qx kept "$scratch/kept.c"
check 'a folder that is not there exits 1' exits 1 "$run" --emit-c "$scratch/nowhere/o.c" "$scratch/words.yaml"
check 'a model is not written over' exits 2 "$run" --emit-c "$scratch/words.yaml" "$scratch/words.yaml"
check 'a method would count for nothing' exits 2 "$run" --method rk4 --emit-c - "$scratch/words.yaml"
check 'and so would rows' exits 2 "$run" --csv - --emit-c o.c "$scratch/words.yaml"
sed '/until/d' "$scratch/words.yaml" >"$scratch/endless.yaml"
check 'without an end it exits 3' exits 3 "$run" --emit-c - "$scratch/endless.yaml"
finish
