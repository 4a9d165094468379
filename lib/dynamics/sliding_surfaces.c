/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The switches for which sliding is to be decided, and their grouping into surfaces: by their gradients, and
 * by couplings that make speeds proportional.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/project.h"
#include "dynamics/sliding_question.h"
#include "dynamics/world_refs.h"
#include "numeric/tolerances.h"

/* ---- surfaces */

double asked_passing_speed(const struct question *q, const struct asked *asked)
{
    const struct fbd_state *state = q->state;
    const struct kink *kink = &state->model->plan.kinks[asked->kink];
    const struct instant at = state_instant(state);
    if (!kink_watches_places(kink, asked->part) || asked->ended || asked->left) return 0;
    double size = 0, w = sliding_surface(state->sliding, state->model, &at, kink, asked->part);
    size_t n = (size_t)state->model->plan.n;
    for (size_t i = 0; i < n; i++) size += fabs(asked_slope(q, asked, 1 + n + i) * state->y[n + i]);
    return fabs(w) > solved_rounding * size ? w : 0;
}

/* ---- the list */

/* A switch that is crossed with a speed is no rest position; if there are too many switches of positions,
 * only those in a sliding mode are listed. */
static bool is_asked(const struct question *q, const struct decided *decided, const struct kink *kink,
                     int part)
{
    const struct sliding *s = q->state->sliding;
    int branch = kink->formula.branch + part;
    if (isnan(s->u[part])) return false; /* in the unevaluated side of an `if` */
    if (q->without_places && kink_watches_places(kink, part) && s->slide_at[branch] == 0) return false;
    return s->slide_at[branch] > 0 || s->left[branch] || s->ended[branch] ||
           (decided && decided->branches[branch]) || fabs(s->u[part]) <= s->rounding[part];
}

bool question_gather(struct question *q, const struct decided *decided)
{
    struct fbd_state *state = q->state;
    struct sliding *s = state->sliding;
    const struct plan *plan = &state->model->plan;
    const struct instant given = state_instant(state), at = instant_extend(state->model, &given);
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        if (!kink->slides) continue;
        expr_switchings(kink->formula.expr, at.t, at.y, 0, NULL, at.branch + kink->formula.branch, s->u,
                        s->rate, s->rounding);
        for (int part = 0; part < (int)kink->count; part++) {
            int branch = kink->formula.branch + part;
            if (!expr_switch_jumps(kink->formula.expr, (size_t)part) ||
                expr_switch_is_time(kink->formula.expr, (size_t)part) || !is_asked(q, decided, kink, part))
                continue;
            const struct asked asked = {(int)i, part, branch, -1, 1, s->left[branch], s->ended[branch]};
            if (s->slide_at[branch] == 0 && asked_passing_speed(q, &asked) != 0) continue;
            if (q->count == most_asked) return false;
            q->list[q->count++] = asked;
        }
    }
    return true;
}

static bool has_couplings(const struct question *q)
{
    const struct tree *tree = q->state->model->tree;
    return tree->coupling_count > 0;
}

/* Project unit velocities in the present modes. False when memory is out. */
static bool find_coupled(struct question *q)
{
    size_t n = (size_t)q->state->model->plan.n;
    if (!has_couplings(q)) return true;
    if (!q->coupled) q->coupled = calloc(n * n, sizeof *q->coupled);
    if (q->coupled)
        state_find_ways(q->state, q->coupled);
    else
        q->state->holds.found = holds_no_memory;
    return q->coupled;
}

/* Entry i of the gradient of a surface, with time, coordinates, rates: along the projection of one of these
 * onto the couplings. */
static double slope_of(const struct question *q, const struct asked *asked, size_t i)
{
    size_t n = (size_t)q->state->model->plan.n, size = plan_size(&q->state->model->plan);
    double *dy = q->state->sliding->flow;
    if (!q->ways || i == 0 || i > 2 * n) return asked_slope(q, asked, i);
    size_t k = i - 1;
    memset(dy, 0, size * sizeof *dy);
    memcpy(dy + (k < n ? 0 : n), q->ways + k % n * n, n * sizeof *dy);
    return asked_rate(q, asked, 0, dy);
}

/* The ratio of the speeds of j and i if couplings make them proportional, else 0. */
static double coupled_ratio(const struct question *q, int i, int j)
{
    int n = q->state->model->plan.n;
    double ii = 0, jj = 0, ij = 0;
    for (int k = 0; k < n; k++) {
        double x = q->coupled[k * n + i], y = q->coupled[k * n + j];
        ii += x * x;
        jj += y * y;
        ij += x * y;
    }
    bool moves = ii > solved_rounding * solved_rounding && jj > solved_rounding * solved_rounding;
    return moves && ij * ij >= (1 - solved_rounding) * ii * jj ? ij / ii : 0;
}

bool question_find_coordinates(struct question *q)
{
    struct sliding *s = q->state->sliding;
    const struct plan *plan = &q->state->model->plan;
    bool coupled = q->count > 0 && plan->mode_count > 0 && has_couplings(q);
    if (coupled && !find_coupled(q)) return false;
    for (int j = 0; j < plan->n; j++) {
        s->with[j] = j;
        s->as_fast[j] = 1;
        for (int i = 0; coupled && i < j && s->with[j] == j; i++) {
            double ratio = s->with[i] == i ? coupled_ratio(q, i, j) : 0;
            if (ratio == 0) continue;
            s->with[j] = i;
            s->as_fast[j] = ratio;
        }
    }
    return true;
}

/* The ratio of the gradients of b and a if they are parallel, so that both have one surface; else 0. Also 0
 * if couplings prevent all motion of a. */
static double ratio_of(const struct question *q, const struct asked *a, const struct asked *b)
{
    size_t size = plan_size(&q->state->model->plan);
    double aa = 0, bb = 0, ab = 0, alone = 0;
    for (size_t i = 0; i <= size; i++) {
        double x = slope_of(q, a, i), y = slope_of(q, b, i), own = q->ways ? asked_slope(q, a, i) : 0;
        aa += x * x;
        bb += y * y;
        ab += x * y;
        alone += own * own;
    }
    bool moves = aa > solved_rounding * solved_rounding * alone;
    return moves && ab * ab >= (1 - solved_rounding) * aa * bb && ab != 0 ? ab / aa : 0;
}

/* At u = 0 and w = 0 of the switch that comes to rest, is another switch, whose gradient is `ratio` times
 * that of w, at zero too? sign(v - 3) is not, nor is sign(x - 1). */
static bool comes_along(const struct question *q, const struct asked *ended, const struct asked *other,
                        double ratio)
{
    const struct fbd_state *state = q->state;
    const struct kink *kinks = state->model->plan.kinks, *kink = &kinks[other->kink];
    const struct instant at = state_instant(state);
    size_t n = (size_t)state->model->plan.n;
    bool places = kink_watches_places(kink, other->part);
    double size = 0, u = sliding_watched(state->sliding, state->model, &at, kink, other->part),
           rest = places
                      ? sliding_watched(state->sliding, state->model, &at, &kinks[ended->kink], ended->part)
                      : sliding_surface(state->sliding, state->model, &at, &kinks[ended->kink], ended->part);
    for (size_t i = 0; i < n; i++)
        size += fabs(asked_slope(q, other, 1 + n + i) * state->y[places ? i : n + i]);
    return fabs(u - ratio * rest) <= undecided_part * size;
}

static bool is_listed(const struct question *q, int branch)
{
    for (int i = 0; i < q->count; i++)
        if (q->list[i].branch == branch) return true;
    return false;
}

/* Is a switch of speeds at zero when all speeds are, as sign(v)? */
static bool is_zero_at_rest(const struct question *q, const struct asked *asked)
{
    struct sliding *s = q->state->sliding;
    const struct fbd_model *model = q->state->model;
    size_t n = (size_t)model->plan.n;
    const struct kink *kink = &model->plan.kinks[asked->kink];
    if (kink_watches_places(kink, asked->part)) return false;
    struct instant at = state_instant(q->state);
    memcpy(s->shifted, at.y, plan_size(&model->plan) * sizeof *s->shifted);
    memset(s->shifted + n, 0, n * sizeof *s->shifted);
    at.y = s->shifted;
    return fabs(sliding_watched(s, model, &at, kink, asked->part)) <= s->rounding[asked->part];
}

/* Does a switch of the speed come to rest with one at its Zeno limit, though it is not zero yet? */
static bool comes_to_rest(struct question *q, const struct asked *ended, const struct asked *other)
{
    q->ways = q->coupled;
    double ratio = ratio_of(q, ended, other);
    q->ways = NULL;
    return ratio != 0 && comes_along(q, ended, other, ratio);
}

/* Does a switch come to rest with another to which a coupling makes its speed proportional, a rounding off
 * zero? */
static bool rests_with(struct question *q, const struct asked *rests, const struct asked *other)
{
    if (!has_couplings(q) || !is_zero_at_rest(q, other) || !is_zero_at_rest(q, rests)) return false;
    if (!q->coupled && !find_coupled(q)) return false;
    q->ways = q->coupled;
    double ratio = ratio_of(q, rests, other);
    q->ways = NULL;
    return ratio != 0;
}

bool question_join(struct question *q)
{
    const struct plan *plan = &q->state->model->plan;
    int ended = 0, count = q->count;
    while (ended < count && !q->list[ended].ended) ended++;
    if (ended < count && !find_coupled(q)) return false;
    for (size_t i = 0; i < plan->kink_count && count > 0; i++) {
        const struct kink *kink = &plan->kinks[i];
        for (int part = 0; kink->slides && part < (int)kink->count; part++) {
            struct asked asked = {(int)i, part, kink->formula.branch + part, -1, 1, false, false};
            if (!expr_switch_jumps(kink->formula.expr, (size_t)part) || is_listed(q, asked.branch)) continue;
            asked.ended = ended < count && comes_to_rest(q, &q->list[ended], &asked);
            bool joins = asked.ended;
            for (int j = 0; j < count && !joins; j++) joins = rests_with(q, &q->list[j], &asked);
            if (!joins) continue;
            if (q->count == most_asked) return false;
            q->list[q->count++] = asked;
        }
    }
    return true;
}

/* A surface has been left if all its switches have, by their own gradients: one that a coupling has just
 * joined has not. */
static void find_left(struct question *q)
{
    for (int unit = 0; unit < q->units; unit++) q->left[unit] = true;
    for (int i = 0; i < q->count; i++) {
        bool left = false;
        for (int j = 0; j < q->count && !left; j++)
            left = q->list[j].left && (i == j || ratio_of(q, &q->list[i], &q->list[j]) != 0);
        q->left[q->list[i].unit] &= left;
    }
}

void question_find_surfaces(struct question *q, bool coupled)
{
    q->units = 0;
    q->ways = coupled ? q->coupled : NULL;
    for (int i = 0; i < q->count; i++) {
        struct asked *asked = &q->list[i];
        asked->unit = -1;
        asked->side = 1;
        for (int j = 0; j < i && asked->unit < 0; j++) {
            double ratio = ratio_of(q, &q->list[j], asked);
            if (ratio == 0) continue;
            asked->unit = q->list[j].unit;
            asked->side = ratio > 0 ? q->list[j].side : -q->list[j].side;
        }
        if (asked->unit < 0) asked->unit = q->units++;
    }
    q->ways = NULL;
    find_left(q);
}

bool question_find_fewest_surfaces(struct question *q)
{
    bool couples = q->count > 1 && has_couplings(q);
    if (couples && !find_coupled(q)) return false;
    question_find_surfaces(q, couples);
    return true;
}

bool question_gather_without_places(struct question *q, const struct decided *decided)
{
    *q = (struct question){.state = q->state, .without_places = true, .most = q->most, .coupled = q->coupled};
    return question_gather(q, decided);
}

/* The weight of a surface is that of its first switch. Is a switch that a coupling joined to it still of that
 * surface? No longer if a rope has become slack. */
bool asked_is_joined(struct question *q, const struct asked *asked)
{
    const struct sliding *s = q->state->sliding;
    int unit = s->slides[s->slide_at[asked->branch] - 1].unit, first = 0, other = 0;
    while (s->slides[first].unit != unit) first++;
    while (q->list[other].branch != s->slides[first].branch) other++;
    if (!has_couplings(q) || ratio_of(q, &q->list[other], asked) != 0) return true;
    if (!find_coupled(q)) return false;
    q->ways = q->coupled;
    double ratio = ratio_of(q, &q->list[other], asked);
    q->ways = NULL;
    return ratio != 0;
}
