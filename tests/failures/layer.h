/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A layer between a program and the C library that makes one call fail: the k-th allocation, or the k-th call
 * that opens, reads, writes or moves a file. It is preloaded (LD_PRELOAD) into the programs as they are
 * installed, so what is tested is what users run, with GSL and libyaml as the system has them.
 *
 * The program is loaded once. Before main it waits, and is forked for each run that is asked for, which costs
 * a tenth of starting it anew. What is asked of a run and what it tells of itself stand in a page that the
 * driver (fail_each.c) and all runs share, so that a run that dies has told all the same.
 */
#ifndef FBD_TESTS_FAILURES_LAYER_H
#define FBD_TESTS_FAILURES_LAYER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

enum layer_kind { layer_memory, layer_files, layer_kinds };

struct layer_page {
    /* what is asked of a run */
    enum layer_kind kind;
    long at;   /* which call fails, from 1; 0: none */
    bool stay; /* and all after it: memory, or the disk, stays out */

    /* what it tells */
    long calls[layer_kinds]; /* how many calls could have failed */
    long refused;            /* how many have */
    char what[32];           /* the first of them */
    long lost;         /* blocks of memory that nobody has freed at the end; -1: it did not come to its end */
    char lost_by[128]; /* who has asked for one of them */
};

/* The environment of the program: the descriptor of the page, and those of the pipes on which runs are asked
 * for (one byte each) and answered (the status of waitpid, an int). */
#define LAYER_PAGE   "LAYER_PAGE"
#define LAYER_ASK    "LAYER_ASK"
#define LAYER_ANSWER "LAYER_ANSWER"

enum { layer_seconds = 60 }; /* of processor time: a run that takes longer hangs */

/* ---- between the files of the layer */

/* Is this call to fail? `caller` is where it comes from, or NULL. */
bool layer_refuses(enum layer_kind kind, const char *what, const void *caller);

/* From now on calls count; what has been allocated before is not asked back. */
void layer_memory_begin(void);

/* At the end: who has asked for the first block from `*place` on that is left, or NULL; *place moves behind it. */
const void *layer_memory_left(long *place);

/* Standard input and output are as able to fail as any file. */
void layer_files_begin(void);

#endif
