/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Smoothness of motions prescribed by tables. An infinite force is detected during the run; a jump of the
 * force is valid, but seldom intended with measured points.
 */
#include "expr/table.h"
#include "scene/reader.h"

/* Number of derivatives that are continuous at all points between the ends, at most 2. */
static int smoothness(const struct table *table)
{
    int least = 2;
    for (size_t k = 1; k + 1 < table->count && least > 0; k++) {
        int here = table_smoothness(table, (double)k);
        if (here < least) least = here;
    }
    return least;
}

void smoothness_note(struct reader *reader, struct pos at, const char *what, const struct expr *expr)
{
    for (size_t k = 0; k < expr_switches(expr); k++) {
        const struct table *table = expr_switch_table(expr, k);
        int smooth = table ? smoothness(table) : 2;
        if (smooth == 2) continue;
        diag_add(reader->errors, FBD_WARNING, "rough-motion", at,
                 "`interpolation: cubic` has a continuous acceleration",
                 smooth == 1 ? "the acceleration of `%s` jumps at points of the table `%s`, and so does the "
                               "force of its drive"
                             : "the velocity of `%s` jumps at points of the table `%s`: no force does that",
                 what, table->name);
        return;
    }
}
