/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Slots: a point of one body on a straight line or on a curve of another one, such as the pin of a crank in a
 * yoke, or a follower on its cam.
 */
#include <string.h>

#include "expr/curve.h"
#include "scene/couplings.h"
#include "scene/fields.h"
#include "scene/values.h"

static bool refuse(struct reader *reader, struct pos at, const char *id, const char *what, const char *hint)
{
    diag_add(reader->errors, FBD_ERROR, id, at, hint, "%s", what);
    return false;
}

/* ---- straight slots */

static bool read_end(struct reader *reader, const struct node *node, const char *key, double *end)
{
    return !node || value_number(reader, node, key, a_length, 0, end);
}

static bool read_line(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    constraint->along = keys->along;
    constraint->from = -HUGE_VAL;
    constraint->to = HUGE_VAL;
    if (keys->closed)
        return refuse(reader, constraint->at, "not-here", "a straight slot cannot be `closed`",
                      "give its curve: `x` and `y` of p, or `y` of x");
    if (!read_end(reader, keys->from, "from", &constraint->from) ||
        !read_end(reader, keys->to, "to", &constraint->to))
        return false;
    return constraint->from < constraint->to ||
           refuse(reader, keys->to->at, "out-of-range", "`to` must be above `from`", NULL);
}

/* ---- curved slots */

/* Check by samples that a roller is smaller than the radius of curvature on its side: 1 - kappa h > 0 at its
 * distance h to the left. */
static bool roller_fits(struct reader *reader, const struct constraint *constraint)
{
    enum { samples_of_a_panel = 16 };
    const struct curve *curve = constraint->curve;
    double h = constraint->presses * constraint->radius[0];
    int count = samples_of_a_panel * curve->panel_count;
    for (int i = 0; h != 0 && i <= count; i++) {
        double s = curve->start + curve->length * i / count, bend = curve_at(curve, NULL, s).bend;
        if (bend * h < 1) continue;
        diag_add(reader->errors, FBD_ERROR, "bad-track", constraint->at,
                 "take a smaller roller, or a wider bend",
                 "the roller does not fit into the bend at %.6g, whose radius is %.6g",
                 curve_parameter(curve, s), fabs(1 / bend));
        return false;
    }
    return true;
}

static bool read_curve(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    const struct curve_keys own = {.x = keys->x,
                                   .y = keys->y,
                                   .from = keys->from,
                                   .to = keys->to,
                                   .closed = keys->closed,
                                   .body = ground_body,
                                   .what = "a slot",
                                   .name = "the curve of the slot",
                                   .label = "slot"};
    if (!keys->y || !keys->from || !keys->to)
        return refuse(reader, constraint->at, "missing-key", "the curve of a slot needs `y`, `from` and `to`",
                      "write `y` of x, or `x` and `y` of p, and the range of that");
    if (keys->along != 0)
        return refuse(reader, constraint->at, "conflicting-keys", "`along` is of a straight slot",
                      "turn the curve itself");
    constraint->curve = curve_read(reader, &own);
    if (!constraint->curve) return false;
    constraint->from = constraint->curve->closed ? -HUGE_VAL : constraint->curve->start;
    constraint->to =
        constraint->curve->closed ? HUGE_VAL : constraint->curve->start + constraint->curve->length;
    if (!constraint->curve->kinked) return roller_fits(reader, constraint);
    diag_add(reader->errors, FBD_ERROR, "bad-track", keys->y->at,
             "let the curvature grow from one to the other (a table: `interpolation: cubic`)",
             "the curvature of the slot jumps at %.6g, and with it every acceleration",
             constraint->curve->kink);
    return false;
}

bool slot_read(struct reader *reader, const struct coupling_keys *keys, struct constraint *constraint)
{
    if (!coupling_ends_read(reader, keys->between, "between", 2, 2, constraint)) return false;
    if (!strchr(keys->between->items[1]->text, '.')) /* without a point: the origin of its frame */
        constraint->point[1] = (struct point){.kind = point_fixed, .at = constraint->at};
    constraint->presses = keys->side;
    constraint->radius[0] = keys->radius;
    if (keys->radius > 0 && keys->side == 0)
        return refuse(reader, constraint->at, "missing-key", "a roller needs the `side` on which it lies",
                      "add `side: left` or `side: right` of growing length, or let the curve be that of its "
                      "centre");
    if (keys->mu_k.expr && keys->radius > 0)
        return refuse(reader, constraint->at, "conflicting-keys", "a roller does not rub",
                      "leave out its `radius`, or the coefficients of friction");
    if (keys->mu_k.expr) constraint->kind = constraint_groove;
    constraint->mu_s = keys->mu_s;
    constraint->mu_k = keys->mu_k;
    return keys->y || keys->x ? read_curve(reader, keys, constraint) : read_line(reader, keys, constraint);
}
