/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweep: a model with many values of its parameters.
 *
 * A sweep has the texts of the caller's plan, the values of its parameters (axes.h) and the rows of a table
 * (batch/rows.h), which several threads or processes make (thread_pool.h).
 */
#ifndef FBD_STUDY_SWEEP_H
#define FBD_STUDY_SWEEP_H

#include "batch/rows.h"
#include "fbd_study.h"
#include "study/axes.h"

struct fbd_sweep {
    struct arena arena;
    char *source; /* the text of the file, owned */
    size_t source_length;
    struct axes axes;
    struct rows *rows;
    struct text header, key;
};

#endif
