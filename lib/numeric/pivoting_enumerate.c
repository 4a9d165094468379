/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * All solutions of a block, by the forces of all combinations of modes.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/pivoting_block.h"
#include "numeric/tolerances.h"

struct solutions {
    size_t count, room;
    struct pivoting_row *rows; /* those of the block, once for each solution */
};

/* ---- combinations of modes */

static void reset(struct pivoting_row *row)
{
    row->mode = row->load == load_is_force ? between : at_high;
}

/* The next mode of the row; false after the last one. */
static bool advance(struct pivoting_row *row)
{
    if (row->load != load_is_force) {
        row->mode = -row->mode;
        return row->mode < 0;
    }
    if (pivoting_is_fixed(row)) return false;
    bool low = row->low > -HUGE_VAL, high = row->high < HUGE_VAL;
    row->mode = row->mode == between && low ? at_low : row->mode != at_high && high ? at_high : between;
    return row->mode != between;
}

/* The next combination in the order of counting; false after the last one. */
static bool next_modes(struct pivoting_block *block)
{
    size_t i = 0;
    while (i < block->n && !advance(&block->rows[i])) i++;
    return i < block->n;
}

static double count_of(const struct pivoting_row *row)
{
    if (row->load != load_is_force) return 2;
    return pivoting_is_fixed(row) ? 1 : 1 + (row->low > -HUGE_VAL) + (row->high < HUGE_VAL);
}

static bool is_contact(const struct pivoting_row *row)
{
    return row->load == load_is_force && row->low == 0 && row->high == HUGE_VAL;
}

/* Has the friction no force in any mode as the contact opens? */
static bool rubs_only_on(const struct pivoting_block *block, const struct pivoting_row *row)
{
    return row->of >= 0 && is_contact(&block->rows[row->of]) && row->low == 0 && row->high == 0;
}

/* The number of different combinations: a contact is open, or closed with each mode of its friction. */
static double count_modes(const struct pivoting_block *block)
{
    double all = 1;
    for (size_t i = 0; i < block->n; i++) {
        const struct pivoting_row *row = &block->rows[i];
        double closed = 1;
        if (rubs_only_on(block, row)) continue;
        for (size_t k = 0; k < block->n; k++)
            if (block->rows[k].of == (int)i && rubs_only_on(block, &block->rows[k]))
                closed *= count_of(&block->rows[k]);
        all *= is_contact(row) ? 1 + closed : count_of(row);
    }
    return all;
}

/* Of the modes of friction on open contacts only one is enumerated. */
static bool is_repeated(const struct pivoting_block *block)
{
    for (size_t i = 0; i < block->n; i++) {
        const struct pivoting_row *row = &block->rows[i];
        bool open = rubs_only_on(block, row) && block->rows[row->of].mode == at_low;
        if (open && row->mode != between && !pivoting_is_fixed(row)) return true;
    }
    return false;
}

/* ---- solutions */

static const struct pivoting_row *solution(const struct pivoting_block *block, const struct solutions *all,
                                           size_t which)
{
    return all->rows + which * block->n;
}

static bool is_new(const struct pivoting_block *block, const struct solutions *all)
{
    for (size_t k = 0; k < all->count; k++) {
        bool same = true;
        for (size_t i = 0; same && i < block->n; i++)
            same = block->rows[i].mode == solution(block, all, k)[i].mode;
        if (same) return false;
    }
    return true;
}

/* False when memory is out. */
static bool keep(const struct pivoting_block *block, struct solutions *all)
{
    if (!is_new(block, all)) return true;
    if (all->count == all->room) {
        size_t room = 2 * all->room + 4;
        struct pivoting_row *rows = realloc(all->rows, room * block->n * sizeof *rows);
        if (!rows) return false;
        all->rows = rows;
        all->room = room;
    }
    memcpy(all->rows + all->count++ * block->n, block->rows, block->n * sizeof *all->rows);
    return true;
}

static bool differ(const struct pivoting_block *block, const struct pivoting_row *a,
                   const struct pivoting_row *b)
{
    double level = fmax(pivoting_level(block, a), pivoting_level(block, b));
    level *= pivoting_difference / solved_rounding;
    for (size_t i = 0; i < block->n; i++)
        if (fabs(a[i].w - b[i].w) > level) return true;
    return false;
}

/* Does some row with a loss stick in `more` that slips in `less`, and none conversely? */
static bool sticks_more(const struct pivoting_block *block, const struct pivoting_row *more,
                        const struct pivoting_row *less)
{
    bool longer = false;
    for (size_t i = 0; i < block->n; i++) {
        if (more[i].mode == less[i].mode || more[i].load != load_is_force) continue;
        if (is_contact(&more[i]) || less[i].mode == between) return false;
        longer |= more[i].mode == between && more[i].loss > 0;
    }
    return longer;
}

static bool counts(const struct pivoting_block *block, const struct solutions *all, size_t which)
{
    for (size_t k = 0; k < all->count; k++)
        if (sticks_more(block, solution(block, all, k), solution(block, all, which))) return false;
    return true;
}

/* Find all of them; false when memory is out. */
static bool find_all(struct pivoting_block *block, struct solutions *all, struct pivoting_row *kept)
{
    size_t bytes = block->n * sizeof *kept;
    struct pivoting_row *modes = malloc(bytes + 1);
    bool made = modes;
    block->is_kinetic = true;
    for (size_t i = 0; i < block->n; i++) reset(&block->rows[i]);
    do {
        if (!made || is_repeated(block)) continue;
        memcpy(modes, block->rows, bytes);
        if (pivoting_fit_all(block, kept)) made = keep(block, all);
        memcpy(block->rows, modes, bytes);
    } while (made && next_modes(block));
    block->is_kinetic = false;
    free(modes);
    return made;
}

enum pivoting pivoting_enumerate(struct pivoting_block *block, enum pivoting found, struct pivoting_row *kept)
{
    struct solutions all = {0};
    size_t first = 0;
    if (count_modes(block) > pivoting_most_modes) return found;
    bool made = (found == pivoting_ray || keep(block, &all)) && find_all(block, &all, kept);
    enum pivoting result = !made ? pivoting_no_memory : all.count == 0 ? pivoting_none : pivoting_solved;
    if (found == pivoting_ray)
        while (first + 1 < all.count && !counts(block, &all, first)) first++;
    for (size_t k = 0; result == pivoting_solved && k < all.count; k++)
        if (differ(block, solution(block, &all, k), solution(block, &all, first)) && counts(block, &all, k))
            result = pivoting_several;
    if (all.count > 0) memcpy(block->rows, solution(block, &all, first), block->n * sizeof *block->rows);
    free(all.rows);
    return result;
}
