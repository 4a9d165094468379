/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Statics of a scene as text: is it in equilibrium, which loads would balance it, and the table of each body.
 */
#include <string.h>

#include "fbd_study.h"
#include "output/display_units.h"
#include "output/equations.h"
#include "output/words.h"
#include "rest/statics.h"

enum { digits = 9 };

/* A difference at round-off level is written as 0. */
static double without_rounding(const struct fbd_statics *statics, double value, double size)
{
    return fabs(value) <= 1e-12 * size * statics->force ? 0 : value;
}

/* ---- equilibrium */

static void write_names(struct text *text, const struct fbd_statics *statics)
{
    enum { most_named = 12 };
    size_t count = statics->undetermined_count;
    for (size_t i = 0; i < count && i < most_named; i++)
        text_printf(text, "%s%s", i ? ", " : "", statics->undetermined[i]);
    if (count > most_named) text_printf(text, " and %zu more", count - most_named);
    text_add(text, "\n");
}

static void write_determinacy(struct text *text, const struct fbd_statics *statics)
{
    if (statics->indeterminacy > 0) {
        text_printf(
            text,
            "  statically indeterminate to degree %zu: of all reactions that balance, those of the least "
            "sum of squares\n  not determined: ",
            statics->indeterminacy);
        write_names(text, statics);
    } else {
        text_add(text, "  statically determinate\n");
    }
    if (statics->mobility > 0)
        text_printf(text, "  it can move in %zu way%s, along which the loads balance\n", statics->mobility,
                    statics->mobility == 1 ? "" : "s");
}

/* ---- no equilibrium */

static void write_unbalanced(struct text *text, const struct fbd_statics *statics)
{
    if (statics->unbalanced_count == 0) return;
    const char *many = statics->unbalanced[0].alone ? "any one of these" : "these together";
    text_printf(text, "  it moves; %s would hold it:\n", statics->unbalanced_count > 1 ? many : "this");
    for (size_t i = 0; i < statics->unbalanced_count; i++) {
        const fbd_unbalanced *one = &statics->unbalanced[i];
        text_printf(text, "    %s", one->coordinate);
        text_pad(text, 24);
        text_add(text, one->holding < 0 ? "" : " ");
        text_number(text, one->holding, digits);
        text_printf(text, " %s\n", one->unit);
    }
}

/* Another closed feature of the same shapes: `floor.normal_2` beside `floor.normal`. */
static const char *held_beside(const struct fbd_statics *statics, const fbd_limit *limit)
{
    const char *normal = strstr(limit->name, ".normal");
    size_t length = normal ? (size_t)(normal - limit->name) + strlen(".normal") : 0;
    for (size_t i = 0; normal && i < statics->limit_count; i++) {
        const fbd_limit *other = &statics->limits[i];
        bool same = other->kind == FBD_LIMIT_NORMAL && strncmp(other->name, limit->name, length) == 0;
        if (same && other != limit && other->holds && other->needed > 0) return other->name;
    }
    return NULL;
}

static void write_broken(struct text *text, const struct fbd_statics *statics, const fbd_limit *limit)
{
    text_printf(text, "  `%s` ", limit->name);
    if (limit->kind == FBD_LIMIT_FRICTION) {
        text_add(text, "would have to hold ");
        text_number(text, limit->needed, digits);
        text_add(text, " of at most ");
        text_number(text, limit->limit, digits);
        text_printf(text, " %s: it slips\n", limit->unit);
        return;
    }
    text_printf(text, "would have to %s with ", limit->kind == FBD_LIMIT_ROPE ? "push" : "pull");
    text_number(text, -limit->needed, digits);
    text_printf(text, " %s", limit->unit);
    const char *beside = held_beside(statics, limit);
    if (beside) text_printf(text, ": it opens there, and tips over `%s`", beside);
    text_add(text, "\n");
}

/* Write the coordinates that differ from those of the file. */
static void write_place(struct text *text, const struct fbd_statics *statics)
{
    enum { most_listed = 40 };
    const struct fbd_model *model = statics->model;
    int listed = 0;
    for (int i = 0; i < model->plan.n; i++) {
        const struct display display = display_of_component(model, (size_t)i, statics->state->degrees);
        double q = statics->state->y[i], initial = model->scene->coordinates[i].initial;
        bool angle = model->scene->coordinates[i].angle;
        double size = angle ? 1 : statics->length; /* a radian */
        if (fabs(q - initial) <= 1e-12 * fmax(size, fabs(initial))) continue;
        if (listed++ >= most_listed) continue;
        text_printf(text, listed == 1 ? "Where %s = " : "      %s = ", display.name);
        text_number(text, q / display.size, digits);
        text_printf(text, " %s (in the file ", display.unit);
        text_number(text, initial / display.size, digits);
        text_add(text, ")\n");
    }
    if (listed > most_listed) text_printf(text, "      and %d others\n", listed - most_listed);
}

static void write_verdict(struct text *text, const struct fbd_statics *statics)
{
    write_place(text, statics);
    text_add(text, "Statics at t = ");
    text_number(text, statics->state->t, digits);
    if (fbd_statics_holds(statics)) {
        text_add(text, " s: in equilibrium\n");
        write_determinacy(text, statics);
        return;
    }
    text_add(text, " s: NOT in equilibrium\n");
    write_unbalanced(text, statics);
    if (statics->unbalanced_count > 0) return; /* loads of limits depend on how it is balanced */
    bool opens = false;
    for (size_t i = 0; i < statics->limit_count; i++)
        opens |= statics->limits[i].kind == FBD_LIMIT_NORMAL && !statics->limits[i].holds;
    for (size_t i = 0; i < statics->limit_count; i++) {
        const fbd_limit *limit = &statics->limits[i];
        bool of_nothing = limit->kind == FBD_LIMIT_FRICTION && limit->limit == 0 && opens;
        if (!limit->holds && !of_nothing) write_broken(text, statics, limit);
    }
    if (statics->indeterminacy > 0)
        text_add(
            text,
            "  (with the reactions of the least sum of squares; no others are within the limits either)\n");
}

/* ---- tables */

static void write_row(struct text *text, const struct fbd_statics *statics, const char *name,
                      struct vec force, double moment, bool turns)
{
    const double values[3] = {without_rounding(statics, force.x, 1), without_rounding(statics, force.y, 1),
                              without_rounding(statics, moment, statics->length)};
    text_printf(text, "    %s ", name);
    for (size_t k = 0; k < (turns ? 3U : 2U); k++) {
        text_pad(text, 26 + 18 * k);
        text_add(text, values[k] < 0 ? "" : " ");
        text_number(text, values[k], digits);
    }
    text_add(text, "\n");
}

static void write_body(struct text *text, const struct fbd_statics *statics, size_t b)
{
    const struct fbd_model *model = statics->model;
    const struct model_body *body = &model->bodies[b];
    const struct rest_diagram *diagram = &statics->diagrams[b];
    struct instant at = state_instant(statics->state);
    struct pose pose = body_pose(body, &at);
    struct vec G = point_motion(body, &pose, body->inertia.G).p, sum = {0, 0};
    double moment = 0;
    bool turns = rest_turns(body);
    text_printf(text, "\n  %s", body->name);
    text_pad(text, 27);
    text_printf(text, "fx [%s]", force_unit(model));
    text_pad(text, 45);
    text_printf(text, "fy [%s]", force_unit(model));
    if (turns) {
        text_pad(text, 63);
        text_printf(text, "moment about G [%s]", moment_unit(model));
    }
    text_add(text, "\n");
    for (size_t i = 0; i < diagram->count; i++) {
        const struct arrow *arrow = &diagram->arrows[i];
        double own = arrow_moment(arrow, G);
        sum = vec_add(sum, arrow->force);
        moment += own;
        write_row(text, statics, arrow->name, arrow->force, own, turns);
    }
    write_row(text, statics, "sum", sum, moment, turns);
}

static void write_members(struct text *text, const struct fbd_statics *statics)
{
    if (statics->member_count > 0) text_add(text, "\nTwo-force members\n");
    for (size_t i = 0; i < statics->member_count; i++) {
        double tension = without_rounding(statics, statics->members[i].tension, 1);
        text_printf(text, "  %s", statics->members[i].name);
        text_pad(text, 27);
        text_number(text, fabs(tension), digits);
        text_printf(text, " %s%s\n", force_unit(statics->model),
                    tension > 0   ? " tension"
                    : tension < 0 ? " compression"
                                  : "");
    }
}

static void write_limits(struct text *text, const struct fbd_statics *statics)
{
    bool any = false;
    for (size_t i = 0; i < statics->limit_count; i++) {
        const fbd_limit *limit = &statics->limits[i];
        if (limit->kind != FBD_LIMIT_FRICTION) continue;
        text_add(text, any ? "" : "\nFriction\n");
        any = true;
        text_printf(text, "  %s holds ", limit->name);
        double needed = without_rounding(statics, limit->needed, 1);
        text_number(text, needed, digits);
        text_add(text, " of at most ");
        text_number(text, limit->limit, digits);
        text_printf(text, " %s", limit->unit);
        if (limit->limit > 0) text_printf(text, " (%.3g %%)", 100 * (needed / limit->limit));
        text_add(text, "\n");
    }
}

char *fbd_statics_text(const fbd_statics *statics)
{
    if (!statics) return NULL;
    struct text text = {0};
    text_heading(&text, statics->model->scene->title);
    write_verdict(&text, statics);
    if (fbd_statics_holds(statics)) {
        for (size_t b = 0; b < statics->model->body_count; b++) write_body(&text, statics, b);
        write_members(&text, statics);
        write_limits(&text, statics);
    }
    if (text.failed) text_free(&text);
    return text.data;
}
