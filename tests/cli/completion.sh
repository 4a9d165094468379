#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
#
# What the programs say for shells: scripts that these accept and that name every option, and hints for misspelled ones.
set -u
. "$FBD_SOURCE_ROOT/tests/tools/tap.sh"

names_every_option() { # names_every_option PROGRAM SHELL
    "$FBD_BUILD_ROOT/apps/$1" --completion "$2" >"$scratch/script" || return 1
    "$FBD_BUILD_ROOT/apps/$1" --help | grep -oE -- '--[a-z][a-z-]*' | sort -u | sed 's/^--//' | while read -r option; do
        grep -qE -- "(--|-l )$option([^a-z-]|$)" "$scratch/script" || {
            echo "$option is missing"
            return 1
        }
    done
}

bash_completes() {
    bash -c 'eval "$("$1" --completion bash)"
        COMP_WORDS=(fbd-run --acc); COMP_CWORD=1; _fbd_run
        [ "${COMPREPLY[*]}" = --accuracy ] || exit 1
        COMP_WORDS=(fbd-run --completion z); COMP_CWORD=2; _fbd_run
        [ "${COMPREPLY[*]}" = zsh ]' - "$FBD_RUN"
}

bash_completes_names() {
    bash -c 'eval "$("$1" --completion bash)"
        PATH=$(dirname "$1"):$PATH model=$2
        offers() { # offers EXPECTED WORD...
            expected=$1; shift
            COMP_WORDS=(fbd-run "$@"); COMP_CWORD=$#; _fbd_run
            [ "${COMPREPLY[*]}" = "$expected" ] || { echo "${COMPREPLY[*]} instead of $expected"; exit 1; }
        }
        offers "mu_s= mu_k=" "$model" --set mu_
        offers block "$model" --body b
        offers block.friction "$model" --without block.f
        offers "rk8pd" --method rk8
        offers "2 3" --fmu-version ""
        offers "block.friction block.friction.work" "$model" --fmu-outputs block.f
        offers "$model" --fmu "${model%ml}"
        offers "$model" --grade "${model%ml}"
        offers "" nothing.yaml --set m
        offers "" --body b' - "$FBD_RUN" "$FBD_SOURCE_ROOT/models/kinetics/incline.yaml"
}

names() { # names EXPECTED KIND MODEL: on one line, without messages
    [ "$("$FBD_RUN" --completion "$2" "$3" 2>&1 | tr '\n' ' ')" = "$1" ]
}

hint() { # hint EXPECTED ARGUMENT...
    expected=$1
    shift
    "$FBD_RUN" "$@" 2>"$scratch/errors"
    [ $? -eq 2 ] && grep -qF -- "$expected" "$scratch/errors" || {
        cat "$scratch/errors"
        return 1
    }
}

short_help() {
    "$FBD_RUN" -h >"$scratch/short" && "$FBD_RUN" --help >"$scratch/long" && cmp "$scratch/short" "$scratch/long"
}

for program in fbd-run fbd-cost fbd-sweep; do
    for shell in bash zsh fish; do
        check "$program completes in $shell" names_every_option "$program" "$shell"
    done
done
check 'bash takes the script' bash_completes
check 'and names of the model behind options' bash_completes_names
check 'effects are those of --without' names 'block.gravity block.normal block.friction block.push ' effects \
    "$FBD_SOURCE_ROOT/models/kinetics/incline.yaml"
check 'a wrong model has no names' names '' parameters "$FBD_SOURCE_ROOT/tests/bad/axis_unknown.yaml"
check 'a slip is answered' hint 'did you mean --accuracy?' --acuracy 1e-6 model.yaml
check 'exchanged letters are answered' hint 'did you mean --until?' --untli 1 model.yaml
check 'what is nothing like an option is said so' hint 'unknown option' --frobnicate model.yaml
check 'a value that is missing is said so' hint '--until wants a value' model.yaml --until
check 'there is no such shell' hint 'bash, zsh or fish' --completion csh
check '-h is --help' short_help
finish
