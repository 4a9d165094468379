/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The rows of a slot. With u the point P in the frame of the slot, its foot r(s) satisfies e(s) . (u - r(s))
 * = 0, and the distance h = n(s) . (u - r(s)) to the left of the curve has the gradient n there:
 *
 *     g = sigma h - R,   sigma = +1 or -1 on its side, R the radius of a roller
 *
 * As a jet s follows from Newton's method: with s exact, f = e . (u - r) and f_s = -(1 - kappa h), each step
 * s - f / f_s with fixed f_s gains one order in the rates or in the variation, and a jet has three. A
 * straight slot is the curve r = (s, 0).
 */
#include <float.h>

#include "dynamics/constraint_view.h"
#include "expr/curve.h"
#include "numeric/tolerances.h"

/* A point of the curve, with the derivatives for its jets. */
struct foot {
    struct curve_place at;
    double bend2; /* kappa'' */
};

static struct foot foot_at(const struct coupling *coupling, double s, bool varied)
{
    if (!coupling->source->curve) return (struct foot){.at = {.r = {s, 0}, .e = {1, 0}}};
    return (struct foot){curve_at(coupling->source->curve, NULL, s),
                         varied ? curve_slope_rate(coupling->source->curve, NULL, s) : 0};
}

/* The curve along s: r' = e, e' = kappa n, n' = -kappa e. */
static struct jet_vec place_along(const struct foot *foot, struct jet s)
{
    struct vec e = foot->at.e, n = vec_perp(e);
    double k = foot->at.bend, k1 = foot->at.slope;
    struct vec f2 = vec_scale(k, n), f3 = vec_sub(vec_scale(k1, n), vec_scale(k * k, e));
    return (struct jet_vec){jet_apply(s, foot->at.r.x, e.x, f2.x, f3.x),
                            jet_apply(s, foot->at.r.y, e.y, f2.y, f3.y)};
}

static struct jet_vec tangent_along(const struct foot *foot, struct jet s)
{
    struct vec e = foot->at.e, n = vec_perp(e);
    double k = foot->at.bend, k1 = foot->at.slope;
    struct vec f1 = vec_scale(k, n), f2 = vec_sub(vec_scale(k1, n), vec_scale(k * k, e));
    struct vec f3 = vec_sub(vec_scale(foot->bend2 - k * k * k, n), vec_scale(3 * k * k1, e));
    return (struct jet_vec){jet_apply(s, e.x, f1.x, f2.x, f3.x), jet_apply(s, e.y, f1.y, f2.y, f3.y)};
}

/* ---- the foot */

/* Newton's method from a guess; false without convergence. */
static bool foot_near(const struct coupling *coupling, struct vec u, double *s)
{
    enum { most_steps = 40 };
    double last = HUGE_VAL;
    for (int i = 0; i < most_steps; i++) {
        struct foot foot = foot_at(coupling, *s, false);
        struct vec d = vec_sub(u, foot.at.r);
        double slope = 1 - foot.at.bend * vec_dot(vec_perp(foot.at.e), d);
        if (!(slope > 0.05)) return false;
        double step = vec_dot(foot.at.e, d) / slope;
        /* At rounding the steps no longer decrease. */
        if (fabs(step) >= last && last <= negligible_sum * (fabs(*s) + vec_norm(u))) return true;
        *s += step;
        last = fabs(step);
        if (step == 0) return isfinite(*s);
    }
    return false;
}

/* For a free point a local minimum of the distance may no longer be the global one, and the point could cross
 * the nearer part of the curve undetected: find the nearest one on a closed curve. On open curves the ends
 * are watched elsewhere. */
static double nearest_of_all(const struct coupling *coupling, struct vec u, double s)
{
    const struct curve *curve = coupling->source->curve;
    if (coupling->surface < 0 || !curve->closed) return s;
    double other = curve_nearer(curve, u, vec_norm(vec_sub(u, foot_at(coupling, s, false).at.r)));
    return !isnan(other) && foot_near(coupling, u, &other) ? other : s;
}

static double foot_of(const struct coupling *coupling, struct vec u, double guess)
{
    double s = guess;
    if (!coupling->source->curve) return u.x;
    if (foot_near(coupling, u, &s)) return nearest_of_all(coupling, u, s);
    s = curve_near(coupling->source->curve, u);
    double rough = s;
    return foot_near(coupling, u, &s) ? s : rough;
}

/* ---- jets */

/* The frame of the slot as jets, and its point in it. */
struct slot_view {
    struct jet_vec P, x, y, u;
};

static struct slot_view look(const struct view *view, const struct coupling *coupling)
{
    struct slot_view slot = {.P = point_of(view, &coupling->end[0]),
                             .x = turning(view, coupling->end[1].link, coupling->e)};
    struct jet_vec d = jet_vec_sub(slot.P, point_of(view, &coupling->end[1]));
    slot.y = jet_perp(slot.x);
    slot.u = (struct jet_vec){jet_dot(slot.x, d), jet_dot(slot.y, d)};
    return slot;
}

/* The length along the slot, at its point. */
static struct jet length_of(const struct coupling *coupling, const struct slot_view *slot,
                            const struct foot *foot, double at)
{
    enum { orders = 3 };
    struct vec d = vec_sub(jet_value(slot->u), foot->at.r);
    double slope = 1 - foot->at.bend * vec_dot(vec_perp(foot->at.e), d);
    struct jet s = jet_constant(at);
    if (!coupling->source->curve) return slot->u.x;
    for (int i = 0; i < orders; i++) {
        struct jet_vec off = jet_vec_sub(slot->u, place_along(foot, s));
        struct jet f = jet_dot(tangent_along(foot, s), off);
        s = jet_add(s, jet_scale(1 / slope, f));
        s.x = at; /* exact up to rounding */
    }
    return s;
}

/* The friction row: g = s - s_0, constant while it sticks. On the curve (h = 0) its rate is the velocity of
 * the point along it. */
static void row_along(const struct view *view, const struct coupling *coupling,
                      const struct coupling_state *state, const struct slot_view *slot,
                      const struct foot *foot, struct jet s, struct row *row)
{
    const struct curve *curve = coupling->source->curve;
    const double period = curve && curve->closed ? curve->length : 0;
    struct jet_vec e = tangent_along(foot, s), along = jet_vec_times(e.x, slot->x),
                   across = jet_vec_times(e.y, slot->y);
    struct jet_vec world = {jet_add(along.x, across.x), jet_add(along.y, across.y)};
    start_row(row, nearest(jet_sub(s, jet_constant(state->zero)), period));
    add_port(view, row, coupling, 0, slot->P, world);
    add_port(view, row, coupling, 1, slot->P, negative(world));
}

void slot_row(const struct view *view, const struct coupling *coupling, const struct coupling_state *state,
              struct row *row)
{
    struct slot_view slot = look(view, coupling);
    double at = foot_of(coupling, jet_value(slot.u), state->foot),
           sigma = coupling->source->presses < 0 ? -1 : 1;
    struct foot foot = foot_at(coupling, at, view->varied);
    struct jet s = length_of(coupling, &slot, &foot, at);
    struct jet_vec n = jet_vec_times(jet_constant(sigma), jet_perp(tangent_along(&foot, s)));
    struct jet_vec off = jet_vec_sub(slot.u, place_along(&foot, s));
    struct jet g = jet_sub(jet_dot(n, off), jet_constant(coupling->end[0].radius));
    struct jet_vec along = jet_vec_times(n.x, slot.x), across = jet_vec_times(n.y, slot.y);
    struct jet_vec world = {jet_add(along.x, across.x), jet_add(along.y, across.y)};
    start_row(row, g);
    add_port(view, row, coupling, 0, slot.P, world);
    add_port(view, row, coupling, 1, slot.P, negative(world));
    if (coupling->row_count > 1) row_along(view, coupling, state, &slot, &foot, s, &row[1]);
}

/* ---- references from the start */

void slot_start(const struct view *view, const struct coupling *coupling, struct coupling_state *state,
                struct row *row)
{
    struct vec u = jet_value(look(view, coupling).u);
    if (coupling->source->curve) state->foot = foot_of(coupling, u, curve_near(coupling->source->curve, u));
    if (coupling->row_count > 1) zero_start(view, coupling, state, row);
}

void slot_follow(const struct view *view, const struct coupling *coupling, struct coupling_state *state)
{
    state->foot = foot_of(coupling, jet_value(look(view, coupling).u), state->foot);
}

void slots_follow(const struct fbd_model *model, struct tree_work *work)
{
    const struct view view = {model, model->tree, work, false, NULL, NULL};
    for (int i = 0; i < model->tree->coupling_count; i++)
        if (model->tree->couplings[i].source->curve)
            slot_follow(&view, &model->tree->couplings[i], &work->couplings[i]);
}

/* The size of a slot is the larger magnitude of its ends. */
struct room slot_room(const struct view *view, const struct coupling *coupling,
                      const struct coupling_state *state, int end)
{
    double from = coupling->source->from, to = coupling->source->to;
    if (!isfinite(end == 0 ? from : to)) return (struct room){HUGE_VAL, 0, HUGE_VAL};
    struct slot_view slot = look(view, coupling);
    double at = foot_of(coupling, jet_value(slot.u), state->foot);
    struct foot foot = foot_at(coupling, at, false);
    struct jet s = length_of(coupling, &slot, &foot, at);
    double size = fmax(isfinite(from) ? fabs(from) : 0, isfinite(to) ? fabs(to) : 0);
    return end == 0 ? (struct room){s.x - from, s.x1, size} : (struct room){to - s.x, -s.x1, size};
}

struct slot_size slot_size(const struct fbd_model *model, const struct tree_work *work, int index)
{
    const double pi = 3.14159265358979323846;
    const struct view view = {model, model->tree, (struct tree_work *)work, false, NULL, NULL};
    const struct coupling *coupling = &model->tree->couplings[index];
    if (coupling->kind != constraint_slot && coupling->kind != constraint_groove)
        return (struct slot_size){0, HUGE_VAL};
    const struct curve *curve = coupling->source->curve;
    return (struct slot_size){vec_norm(jet_value(look(&view, coupling).u)),
                              curve ? curve->length / (2 * pi) : HUGE_VAL};
}
