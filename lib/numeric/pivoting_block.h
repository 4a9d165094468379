/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One block of a mixed complementarity problem, scaled so that A has a diagonal of ones: x_i is multiplied by the root of
 * A_ii and w_i divided by it. Memory of all blocks is that of the largest.
 */
#ifndef FBD_NUMERIC_PIVOTING_BLOCK_H
#define FBD_NUMERIC_PIVOTING_BLOCK_H

#include "numeric/lcp.h"
#include "numeric/pivoting.h"

struct fit;

struct pivoting_block {
    size_t n;
    struct pivoting_row *rows;
    double *A;
    size_t *from;    /* index of each row in the problem */
    double *scale;   /* 1 / sqrt(A_ii) */
    double size;     /* largest |b| of the whole problem, scaled */
    double level;    /* accelerations that are zero, at the present forces */
    size_t beyond;   /* after pivoting_fit: a row that cannot satisfy a limit, or n; */
    int at;          /* the mode of that limit */
    struct fit *fit; /* memory of pivoting_modes.c */
};

/* Is x_i prescribed, so that w_i may have any sign? */
static inline bool pivoting_is_fixed(const struct pivoting_row *row)
{
    return row->low == row->high && row->low_share == row->high_share;
}

/* Set x and w of the present modes: the least admissible forces. False where limits or signs of w are violated; x and w
 * are set if only the latter are. */
bool pivoting_fit(struct pivoting_block *block);

/* Set x and w of the present modes without regard to limits: of a basis, which satisfies them but for its round-off. */
void pivoting_guess(struct pivoting_block *block);

/* Set the modes of the end of Lemke's path from start `cover` (lcp.h). */
enum lcp pivoting_lemke(struct pivoting_block *block, int cover);

/* Memory of pivoting_fit for blocks of at most `most` rows; NULL when there is none. */
struct fit *pivoting_fit_new(size_t most);
void pivoting_fit_free(struct fit *fit);

#endif
