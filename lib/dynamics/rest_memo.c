/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/rest_memo.h"

#include <stdlib.h>
#include <string.h>

#include "numeric/tolerances.h"

struct part_memo {
    double *matrix; /* the decomposed matrix */
    struct qr qr;
};

struct rest_memo {
    struct part_memo *parts;
    int count;
};

/* Entry of part `which`; NULL when memory is out. */
static struct part_memo *part_of(struct rest_memo **memo, int which)
{
    if (!*memo) *memo = calloc(1, sizeof **memo);
    if (!*memo) return NULL;
    if (which >= (*memo)->count) {
        struct part_memo *parts = realloc((*memo)->parts, (size_t)(which + 1) * sizeof *parts);
        if (!parts) return NULL;
        (*memo)->parts = parts;
        for (; (*memo)->count <= which; (*memo)->count++) parts[(*memo)->count] = (struct part_memo){0};
    }
    return &(*memo)->parts[which];
}

const struct qr *rest_memo_qr(struct rest_memo **memo, int which, size_t rows, size_t cols, const double *a)
{
    struct part_memo *part = part_of(memo, which);
    const size_t bytes = rows * cols * sizeof *a;
    if (!part) return NULL;
    if (part->matrix && part->qr.rows == rows && part->qr.cols == cols && memcmp(part->matrix, a, bytes) == 0)
        return &part->qr;
    free(part->matrix);
    qr_free(&part->qr);
    part->matrix = malloc(bytes + 1);
    if (part->matrix) memcpy(part->matrix, a, bytes);
    if (part->matrix && qr_decompose(&part->qr, rows, cols, a, solved_rounding)) return &part->qr;
    free(part->matrix);
    part->matrix = NULL;
    return NULL;
}

void rest_memo_free(struct rest_memo *memo)
{
    for (int i = 0; memo && i < memo->count; i++) {
        free(memo->parts[i].matrix);
        qr_free(&memo->parts[i].qr);
    }
    if (memo) free(memo->parts);
    free(memo);
}
