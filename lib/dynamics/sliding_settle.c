/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Which switches are in a sliding mode: decided with the modes, at the start and after each event.
 *
 * Candidates are switches at which the motion is: those in a sliding mode, those just crossed, and those
 * whose u is zero within rounding. Each may take a branch, from whose side u' must not lead back, or slide,
 * with a weight between 0 and 1. If the modes chosen without them are consistent, they are final: a switch is
 * crossed. Else all choices are tried, one digit for each surface, and the consistent one is taken. Choices
 * with the same accelerations count as one.
 */
#include <stdlib.h>
#include <string.h>

#include "dynamics/sliding_question.h"
#include "dynamics/tree_driven.h"
#include "dynamics/world_refs.h"
#include "numeric/tolerances.h"

/* ---- is a choice consistent? */

/* The scale of the rate of a surface, with which its zero is compared. */
static double size_of_rate(const struct question *q, const struct asked *asked)
{
    const struct fbd_state *state = q->state;
    size_t n = (size_t)state->model->plan.n;
    double size = fabs(asked_slope(q, asked, 0));
    for (size_t i = 0; i < n; i++) {
        size += fabs(asked_slope(q, asked, 1 + i) * state->y[n + i]);
        size += fabs(asked_slope(q, asked, 1 + n + i)) * q->most;
    }
    for (size_t i = 0; i < (size_t)state->model->plan.own; i++)
        size += fabs(asked_slope(q, asked, 1 + 2 * n + i) * state->a[n + i]);
    return size;
}

/* Accelerations, including those that couplings compensate and that friction could cause: the scale of their
 * rounding. */
static void take_sizes(struct question *q)
{
    struct fbd_state *state = q->state;
    const struct plan *plan = &state->model->plan;
    const struct instant at = state_instant(state);
    for (int i = 0; i < plan->n; i++) q->most = fmax(q->most, fabs(state->a[i]));
    if (q->count > 0 && tree_joins(state->model->tree))
        q->most = fmax(q->most, tree_coupled_acceleration(state));
    if (q->count == 0 || plan->mode_count == 0) return;
    force_balance(state->model, &at, state->scratch);
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (mode->kind != mode_single) continue;
        double limit = friction_at(state->model, pair, &at, state->scratch).limit / mode->inertia;
        if (isfinite(limit)) q->most = fmax(q->most, limit);
    }
}

static bool agrees(struct question *q)
{
    struct fbd_state *state = q->state;
    struct sliding *s = state->sliding;
    size_t n = (size_t)state->model->plan.n;
    take_sizes(q);
    for (int i = 0; i < q->count; i++) {
        const struct asked *asked = &q->list[i];
        int slide = s->slide_at[asked->branch], branch = state->branch[asked->branch];
        double speed = asked_passing_speed(q, asked);
        if (speed != 0) {
            if (slide > 0 || branch * speed <= 0) return false;
            continue;
        }
        if (slide > 0) {
            double share = s->slides[slide - 1].share;
            if (s->failed || !(share >= -solved_rounding && share <= 1 + solved_rounding)) return false;
            bool held = s->held[s->slides[slide - 1].unit] != not_held;
            if (held && asked_parted(q->state, asked) != 0) return false;
            if (!asked_is_joined(q, asked)) return false;
            continue;
        }
        double zero = solved_rounding * size_of_rate(q, asked), *flow = s->flow;
        memcpy(flow, state->y + n, n * sizeof *flow);
        memcpy(flow + n, state->a, plan_rates(&state->model->plan) * sizeof *flow);
        double rate = asked_rate(q, asked, 1, flow);
        if (branch == 0 ? fabs(rate) > zero : branch * rate < -zero) return false;
    }
    return true;
}

/* Is a sign zero, as it is before any motion? Then the smallest force would change it. */
static bool is_undecided(const struct question *q)
{
    for (int i = 0; i < q->count; i++) {
        const struct asked *asked = &q->list[i];
        bool slides = q->state->sliding->slide_at[asked->branch] > 0;
        if (q->state->branch[asked->branch] == 0 || (!slides && !asked->left && asked_is_held(q, asked)))
            return true;
    }
    return false;
}

/* ---- all choices */

/* Set choice number `choice`: a digit for each surface, 0 slides, 1 and 2 its sides. False if it slides where
 * the weight is at its end, or where the surface is crossed. */
static bool choose(struct question *q, const struct decided *decided, int choice)
{
    struct fbd_state *state = q->state;
    struct sliding *s = state->sliding;
    int digit[most_units] = {0};
    bool lands = false, ends = false;
    for (int unit = 0; unit < q->units; unit++, choice /= 3) digit[unit] = choice % 3;
    for (int j = 0; j < s->count; j++) s->slide_at[s->slides[j].branch] = 0;
    memset(s->aside, 0, state->model->plan.mode_count * sizeof *s->aside);
    sliding_drop(s);
    for (int i = 0; i < state->model->plan.branches; i++) s->keep[i] = decided && decided->branches[i];
    for (int i = 0; i < q->plain_count; i++) s->keep[q->plain[i]] = false;
    for (int i = 0; i < q->count; i++) {
        const struct asked *asked = &q->list[i];
        int side = (digit[asked->unit] == 2) == q->back[asked->unit] ? 1 : -1;
        if (digit[asked->unit] == 0 && (q->left[asked->unit] || asked_passing_speed(q, asked) != 0))
            return false;
        state->branch[asked->branch] = side * asked->side;
        s->keep[asked->branch] = true;
        if (digit[asked->unit] > 0) continue;
        const struct kink *kink = &state->model->plan.kinks[asked->kink];
        lands |= asked->ended || !kink_watches_places(kink, asked->part);
        ends |= asked->ended;
        sliding_add(s, kink, asked->kink, asked->part, asked->unit, asked->side);
    }
    if (s->count > 0) sliding_number(s);
    if (lands) sliding_project(state, !ends); /* before the decision of friction */
    for (int i = 0; i < q->count; i++) {
        if (!asked_is_held(q, &q->list[i])) continue;
        question_take_rest(q, &q->list[i]);
        if (digit[q->list[i].unit] == 0) question_hold_friction(q, &q->list[i]);
    }
    return true;
}

static bool same_accelerations(const struct question *q, const double *a)
{
    for (int i = 0; i < q->state->model->plan.n; i++)
        if (fabs(q->state->a[i] - a[i]) > pivoting_difference * q->most) return false;
    return true;
}

/* Record to which side the weights exceed their range if all surfaces slide: of two branches that differ by
 * friction only, the one on that side is tried first, as it needs the least friction. */
static void note_sides(struct question *q)
{
    const struct sliding *s = q->state->sliding;
    for (int unit = 0; unit < q->units; unit++) q->back[unit] = !s->failed && s->delta[unit] < 0;
}

/* Do all switches keep their branches? */
static bool keeps_sides(const struct question *q)
{
    const struct sliding *s = q->state->sliding;
    for (int i = 0; i < q->count; i++) {
        int branch = q->list[i].branch;
        if (s->slide_at[branch] > 0 || q->state->branch[branch] != s->kept[branch]) return false;
    }
    return true;
}

/* Find the consistent choice: its number, -1 when there is none, -2 when there are several. */
static int find_choice(struct question *q, const struct decided *decided,
                       bool (*settle)(struct fbd_state *state, const struct decided *decided))
{
    struct fbd_state *state = q->state;
    const double *a = state->sliding->best;
    int choices = 1, found = -1;
    for (int unit = 0; unit < q->units; unit++) choices *= 3;
    question_keep_modes(state, false);
    for (int choice = 0; choice < choices; choice++) {
        question_keep_modes(state, true);
        if (!choose(q, decided, choice) || !settle(state, decided)) continue;
        bool agreed = agrees(q);
        if (choice == 0 && !agreed) note_sides(q);
        if (agreed && found >= 0 && !same_accelerations(q, a)) return -2;
        if (!agreed || found >= 0) continue;
        found = choice;
        memcpy(state->sliding->best, state->a, (size_t)state->model->plan.n * sizeof *a);
    }
    question_keep_modes(state, true);
    return found;
}

void sliding_keep_rest(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    struct sliding *s = state->sliding;
    const struct question q = {.state = state};
    const struct instant at = state_instant(state);
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        for (int part = 0; kink->slides && part < (int)kink->count; part++) {
            int branch = kink->formula.branch + part;
            if (!kink_watches_places(kink, part) || state->branch[branch] == 0 || s->keep[branch]) continue;
            const struct asked asked = {(int)i, part, branch, -1, 1, false, false};
            double u = sliding_watched(s, state->model, &at, kink, part);
            s->keep[branch] = fabs(u) <= s->rounding[part] && asked_passing_speed(&q, &asked) == 0;
        }
    }
}

/* With surfaces joined by couplings, then with separate ones, as when a rope becomes slack. */
static int find_choice_of(struct question *q, const struct decided *decided,
                          bool (*settle)(struct fbd_state *state, const struct decided *decided))
{
    if (!question_find_fewest_surfaces(q)) return -1;
    int choice = find_choice(q, decided, settle), fewest = q->units;
    if (choice >= 0 || !q->coupled) return choice;
    question_find_surfaces(q, false);
    return q->units == fewest || q->units > most_units ? choice : find_choice(q, decided, settle);
}

static bool settle_switches(struct question *q, const struct decided *decided, bool settled,
                            bool (*settle)(struct fbd_state *state, const struct decided *decided))
{
    struct fbd_state *state = q->state;
    struct sliding *s = state->sliding;
    bool asked = question_gather(q, decided) && question_join(q);
    if (!asked) asked = question_gather_without_places(q, decided);
    memset(s->left, 0, (size_t)state->model->plan.branches * sizeof *s->left);
    memset(s->ended, 0, (size_t)state->model->plan.branches * sizeof *s->ended);
    if (asked && !question_find_coordinates(q)) return false;
    if (asked && question_leave_repelling(q, decided)) settled = settle(state, decided);
    bool fine = asked && (q->count == 0 || (settled && agrees(q)));
    if (fine && !is_undecided(q)) return settled;
    if (asked && !question_find_fewest_surfaces(q)) return false;
    if (q->units > most_units && fine) return settled;
    if (q->units > most_units && !q->without_places && question_gather_without_places(q, decided)) {
        if (q->count == 0) return settled;
        if (!question_find_fewest_surfaces(q)) return false;
    }
    s->blamed = q->count > 0 ? q->list[0].kink : -1;
    if (!asked || q->units > most_units) {
        s->why = "too many switches are at zero at once";
        return false;
    }
    struct decided open;
    const struct decided *given = decided;
    if (given) open = question_without_shared(q, given), decided = &open;
    int choice = find_choice_of(q, decided, settle);
    /* A weight that just touches its end may turn back. */
    for (int i = 0; choice == -1 && i < q->count; i++) q->list[i].left = false;
    if (choice == -1) choice = find_choice_of(q, decided, settle);
    if (state->holds.found == holds_no_memory) return false;
    if (choice < 0 && fine) return settle(state, given);
    if (choice >= 0)
        return choose(q, decided, choice) && settle(state, fine && keeps_sides(q) ? given : decided);
    s->why = choice == -1
                 ? "neither a branch nor a combination of both agrees with the motion that follows from it"
                 : "several branches or combinations agree with the motions that follow from them";
    return false;
}

bool sliding_settle(struct fbd_state *state, const struct decided *decided, bool settled,
                    bool (*settle)(struct fbd_state *state, const struct decided *decided))
{
    struct question q = {.state = state};
    state->sliding->why = NULL;
    if (state->holds.found == holds_no_memory) return false;
    bool agreed = settle_switches(&q, decided, settled, settle);
    free(q.coupled);
    return agreed;
}
