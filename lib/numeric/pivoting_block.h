/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One block of a mixed complementarity problem, scaled so that A has a diagonal of ones: x_i is multiplied by the root of
 * A_ii and w_i divided by it. Memory of all blocks is that of the largest.
 */
#ifndef FBD_NUMERIC_PIVOTING_BLOCK_H
#define FBD_NUMERIC_PIVOTING_BLOCK_H

#include <math.h>

#include "numeric/lcp.h"
#include "numeric/pivoting.h"

struct fit;

struct pivoting_block {
    size_t n;
    struct pivoting_row *rows;
    double *A;
    size_t *from;       /* index of each row in the problem */
    double *scale;      /* 1 / sqrt(A_ii) */
    double size;        /* largest |b| of the whole problem, scaled */
    double level;       /* accelerations that are zero, at the present forces */
    size_t beyond;      /* after pivoting_fit: a row that cannot satisfy a limit, or n; */
    int at;             /* the mode of that limit */
    bool basic, coarse; /* as of the problem */
    bool
        is_kinetic; /* all limits have their loss where w is not zero, not only those of rows that slip already */
    struct fit *fit; /* memory of pivoting_modes.c */
};

/* Is x_i prescribed, so that w_i may have any sign? */
static inline bool pivoting_is_fixed(const struct pivoting_row *row)
{
    return row->slips != 0 || (row->low == row->high && row->low_share == row->high_share);
}

/* A limit of the row; a load has one at zero, by the sign that is its mode. */
static inline double pivoting_limit(const struct pivoting_row *row, bool high)
{
    if (row->load == load_is_force) return high ? row->high : row->low;
    return high == (row->mode < 0) ? 0 : high ? HUGE_VAL : -HUGE_VAL;
}

/* The share of the other row in that limit. */
static inline double pivoting_share(const struct pivoting_block *block, const struct pivoting_row *row,
                                    bool high)
{
    double share = high ? row->high_share : row->low_share;
    const struct pivoting_row *of = row->of >= 0 ? &block->rows[row->of] : NULL;
    if (!of || of->load == load_is_force || of->mode >= 0) return share;
    return of->load == load_of_both_sides ? -share : 0;
}

/* The part of its limit that a row at this limit carries. */
static inline double pivoting_part(const struct pivoting_block *block, const struct pivoting_row *row)
{
    return row->slips != 0 || block->is_kinetic ? 1 - row->loss : 1;
}

/* Set x and w of the present modes: the least admissible forces. False where limits or signs of w are violated; x and w
 * are set if only the latter are. */
bool pivoting_fit(struct pivoting_block *block);

/* Set x and w of the present modes without regard to limits: of a basis, which satisfies them but for its round-off. */
void pivoting_guess(struct pivoting_block *block);

/* The same; if these modes are not final, of those that the accelerations have, or else the former forces. `kept` takes n. */
bool pivoting_fit_all(struct pivoting_block *block, struct pivoting_row *kept);

/* Accelerations that are zero, at the forces of these rows. */
double pivoting_level(const struct pivoting_block *block, const struct pivoting_row *rows);

/* Enumerate all modes, if they are not too many; else the result is `found`. The block holds its solution, if any, and then
 * the first one that counts. */
enum pivoting pivoting_enumerate(struct pivoting_block *block, enum pivoting found,
                                 struct pivoting_row *kept);

/* Set the modes of the end of Lemke's path from start `cover` (lcp.h). */
enum lcp pivoting_lemke(struct pivoting_block *block, int cover);

/* Memory of pivoting_fit for blocks of at most `most` rows; NULL when there is none. */
struct fit *pivoting_fit_new(size_t most);
void pivoting_fit_free(struct fit *fit);

#endif
