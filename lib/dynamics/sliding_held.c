/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches beside dry friction on the same coordinate, or on a proportional one by couplings: the switch
 * provides the holding force first, and friction the remaining part.
 */
#include <math.h>
#include <string.h>

#include "dynamics/friction.h"
#include "dynamics/sliding_question.h"
#include "dynamics/world_refs.h"
#include "numeric/tolerances.h"

double asked_rate(const struct question *q, const struct asked *asked, double dt, const double *dy)
{
    const struct fbd_model *model = q->state->model;
    const struct instant at = state_instant(q->state);
    return sliding_surface_rate(q->state->sliding, model, &at, &model->plan.kinks[asked->kink], asked->part,
                                dt, dy);
}

double asked_slope(const struct question *q, const struct asked *asked, size_t i)
{
    double *dy = q->state->sliding->flow;
    size_t size = plan_size(&q->state->model->plan);
    memset(dy, 0, size * sizeof *dy);
    if (i > 0) dy[i - 1] = 1;
    return asked_rate(q, asked, i == 0, dy);
}

int asked_parted(const struct fbd_state *state, const struct asked *asked)
{
    const struct instant at = state_instant(state);
    return sliding_parted(state->model, &at, &state->model->plan.kinks[asked->kink], asked->part);
}

/* The dry friction of a coordinate at rest on its surface; -1 without one. */
static int friction_at_rest(const struct question *q, int coordinate)
{
    const struct instant at = state_instant(q->state);
    return sliding_rest(q->state->sliding, q->state->model, &at, coordinate);
}

bool asked_is_held(const struct question *q, const struct asked *asked)
{
    bool any = false;
    size_t n = (size_t)q->state->model->plan.n;
    if (kink_watches_places(&q->state->model->plan.kinks[asked->kink], asked->part)) return false;
    for (size_t i = 0; i < n; i++) {
        if (asked_slope(q, asked, 1 + n + i) == 0) continue;
        if (friction_at_rest(q, (int)i) < 0) return false;
        any = true;
    }
    return any;
}

/* Set friction on the coordinates of a switch to stick, or with `slips` mark it undecided. */
static void leave_friction(const struct question *q, const struct asked *asked, bool *slips)
{
    const struct plan *plan = &q->state->model->plan;
    const struct instant at = state_instant(q->state);
    size_t n = (size_t)plan->n;
    for (size_t i = 0; i < n; i++) {
        if (asked_slope(q, asked, 1 + n + i) == 0) continue;
        for (int pair = 0; pair < (int)plan->mode_count; pair++) {
            if (!sliding_is_friction_of(q->state->sliding, &plan->modes[pair], (int)i)) continue;
            if (slip_velocity(q->state->model, pair, &at) != 0) continue;
            if (slips)
                slips[pair] = false;
            else
                q->state->slip[pair] = stick;
        }
    }
}

void question_take_rest(const struct question *q, const struct asked *asked)
{
    size_t n = (size_t)q->state->model->plan.n;
    for (size_t i = 0; i < n; i++) {
        int pair = asked_slope(q, asked, 1 + n + i) == 0 ? -1 : friction_at_rest(q, (int)i);
        if (pair >= 0 && mode_of(q->state, pair)->coordinate != (int)i) q->state->y[n + i] = 0;
    }
}

/* Set friction to slip if its surface moves off the switch, which holds its coordinate. */
static void part_friction(const struct question *q, const struct asked *asked)
{
    size_t n = (size_t)q->state->model->plan.n;
    int side = asked_parted(q->state, asked);
    for (size_t i = 0; i < n && side != 0; i++) {
        double a = asked_slope(q, asked, 1 + n + i);
        int pair = a == 0 ? -1 : friction_at_rest(q, (int)i);
        if (pair >= 0)
            q->state->sliding->aside[pair] = q->state->slip[pair] = a * side > 0 ? slip_minus : slip_plus;
    }
}

struct decided question_without_shared(const struct question *q, const struct decided *decided)
{
    struct sliding *s = q->state->sliding;
    struct decided rest = *decided;
    rest.slips = s->slips;
    memcpy(s->slips, decided->slips, q->state->model->plan.mode_count * sizeof *s->slips);
    for (int i = 0; i < q->count; i++)
        if (asked_is_held(q, &q->list[i])) leave_friction(q, &q->list[i], s->slips);
    return rest;
}

void question_keep_modes(const struct fbd_state *state, bool back)
{
    const struct plan *plan = &state->model->plan;
    struct sliding *s = state->sliding;
    size_t branches = (size_t)plan->branches, pairs = plan->mode_count;
    int *parts[] = {state->branch, state->slip, state->pull}, *kept = s->kept;
    const size_t sizes[] = {branches, pairs, pairs};
    for (int k = 0; k < 3; k++) {
        memcpy(back ? parts[k] : kept, back ? kept : parts[k], sizes[k] * sizeof *kept);
        kept += sizes[k];
    }
    memcpy(back ? state->y : s->kept_y, back ? s->kept_y : state->y, plan_size(plan) * sizeof *state->y);
}

void question_hold_friction(const struct question *q, const struct asked *asked)
{
    leave_friction(q, asked, NULL);
    part_friction(q, asked);
}

/* The difference of the driving forces towards the upper side of the surface, on the upper minus on the lower
 * branch, with sticking friction; `size`: the sum of their magnitudes. */
static double pushed_away(const struct question *q, const struct asked *asked, double *size)
{
    struct fbd_state *state = q->state;
    size_t n = (size_t)state->model->plan.n;
    const struct sliding *s = state->sliding;
    double *slots = state_scratch(state).slots, sum = 0;
    *size = 0;
    question_keep_modes(state, false);
    leave_friction(q, asked, NULL);
    for (int side = -1; side <= 1; side += 2) {
        state->branch[asked->branch] = side;
        state_evaluate_unshared(state);
        const struct instant at = state_instant(state);
        force_balance(state->model, &at, slots);
        for (size_t i = 0; i < n; i++) {
            double a = asked_slope(q, asked, 1 + n + i);
            int pair = a == 0 ? -1 : friction_at_rest(q, (int)i);
            double push = pair < 0 ? 0 : a * slots[mode_of(state, pair)->hold_slot];
            if (pair >= 0) push *= s->as_fast[mode_of(state, pair)->coordinate] / s->as_fast[i];
            sum += side * push;
            *size += fabs(push);
        }
    }
    question_keep_modes(state, true);
    state_evaluate_unshared(state);
    return sum;
}

/* Set friction at rest to stick, unless slipping has just been decided. */
static void rest_on(const struct question *q, const struct asked *asked, const struct decided *decided)
{
    size_t n = (size_t)q->state->model->plan.n;
    for (size_t i = 0; i < n; i++) {
        int pair = asked_slope(q, asked, 1 + n + i) == 0 ? -1 : friction_at_rest(q, (int)i);
        if (pair >= 0 && !(decided && decided->slips[pair])) q->state->slip[pair] = stick;
    }
}

bool question_leave_repelling(struct question *q, const struct decided *decided)
{
    struct sliding *s = q->state->sliding;
    int kept = 0;
    for (int i = 0; i < q->count; i++) {
        const struct asked asked = q->list[i];
        double size;
        bool repels = s->slide_at[asked.branch] == 0 && !asked.left && !asked.ended &&
                      asked_is_held(q, &asked) && pushed_away(q, &asked, &size) > negligible_sum * size;
        if (!repels) {
            q->list[kept++] = asked;
            continue;
        }
        q->plain[q->plain_count++] = asked.branch;
        s->keep[asked.branch] = false;
        rest_on(q, &asked, decided);
    }
    q->count = kept;
    return q->plain_count > 0;
}
