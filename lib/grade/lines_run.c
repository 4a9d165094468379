/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Compare one equation of a derivation with the mechanics of its scene.
 *
 * Two lines of energy or momentum are equivalent when the derivatives of left - right by the velocities are proportional at
 * all times, with one factor. That distinguishes energy from momentum, and a balance from an identity, independently of a
 * common factor.
 */
#include <math.h>
#include <string.h>

#include "grade/lines.h"

bool line_compare(struct lines *lines, const struct node *root, int body, double spread, double tolerance,
                  struct line *line)
{
    struct arena *arena = &lines->grade->arena;
    fbd_errors *errors = fbd_errors_new();
    const struct node *alone = lines_alone(lines, root, body, lines->index);
    fbd_model_free(lines->alone);
    lines->alone = NULL;
    if (alone && errors) lines->alone = lines_try(lines, alone, true, false, errors);
    fbd_errors_free(errors);
    if (!fbd_checker_compare(lines->checker, lines->alone, (size_t)body, 0, spread, tolerance, &line->is))
        return false;
    double *slopes = ARENA_ARRAY(arena, line->is.slope_count + 1, double);
    if (!slopes) return false;
    if (line->is.slope_count > 0) memcpy(slopes, line->is.slopes, line->is.slope_count * sizeof *slopes);
    line->is.slopes = slopes;
    return true;
}

bool lines_of_run_agree(const fbd_comparison *a, const fbd_comparison *b)
{
    double product = 0, first = 0, second = 0;
    if (!a->of_run || !b->of_run) return !a->of_run && !b->of_run;
    for (size_t i = 0; a->slope_count == b->slope_count && i < a->slope_count; i++) {
        product += a->slopes[i] * b->slopes[i];
        first += a->slopes[i] * a->slopes[i];
        second += b->slopes[i] * b->slopes[i];
    }
    return first > 0 && second > 0 && fabs(product) >= (1 - 1e-8) * sqrt(first * second);
}
