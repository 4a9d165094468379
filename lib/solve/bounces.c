/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bounces without end: when they are too low to be seen the series is summed up, and what bounces rests.
 */
#include <float.h>
#include <string.h>

#include "dynamics/contact.h"
#include "dynamics/energy.h"
#include "dynamics/impulse.h"
#include "dynamics/project.h"
#include "dynamics/tree_system.h"
#include "solve/contacts.h"
#include "solve/run.h"

static const struct tree *tree_of(const struct run *run)
{
    return run->model->tree;
}

/* The gap's acceleration where only the surfaces that stay closed act; by a trial of the modes as they are.
 */
static double acceleration_of(struct run *run, int tie, int feature)
{
    struct fbd_state *state = run->contacts.trial;
    state_copy(state, run->state);
    tie_set_feature(run->model, state->tree, tie, feature);
    state->slip[tree_of(run)->ties[tie].surface] = slip_plus;
    state_evaluate(state);
    return state->tree->rows[tree_of(run)->ties[tie].first_row].g.x2;
}

/* Is the restitution of a meeting the same at all speeds? */
static bool has_constant_restitution(const struct run *run, int meeting)
{
    int index = tree_of(run)->meetings[meeting].constraint;
    const struct expr *expr = run->model->scene->constraints[index].contact.restitution.expr;
    return !expr || expr_is_constant(expr);
}

/* The sum of the intervals that are still to come after an impact from which the surface is left with v at
 * the acceleration -a: 2 v / a, and so on with e v. */
static double sum_of_bounces(struct run *run, int meeting, double v, double a)
{
    enum { most_terms = 1000000 };
    double sum = 0;
    for (int k = 0; k < most_terms; k++) {
        double interval = 2 * v / a, e = contacts_restitution(run, meeting, v);
        if (e < 0) return NAN;
        if (has_constant_restitution(run, meeting)) return interval / (1 - e);
        sum += interval;
        if (interval <= DBL_EPSILON * sum) return sum;
        v *= e;
    }
    return HUGE_VAL;
}

/* The sum of intervals of which the last four impacts show two, from corner to corner and back, and their
 * ratio. */
static double sum_of_rocking(const struct bounces *bounces)
{
    if (bounces->count < 4) return HUGE_VAL;
    const double *t = bounces->t;
    double last = t[0] - t[1], before = t[1] - t[2], first = t[2] - t[3];
    double ratio = last / first;
    return ratio > 0 && ratio < 1 ? ratio * (last + before) / (1 - ratio) : HUGE_VAL;
}

static void remember(struct bounces *bounces, double t, int feature)
{
    for (int k = 3; k > 0; k--) bounces->t[k] = bounces->t[k - 1];
    bounces->t[0] = t;
    bounces->feature = feature;
    bounces->count++;
}

/* The largest speed with which a meeting's features open after an impact. */
static double leaving_speed(const struct run *run, int meeting, int count)
{
    const double *v = run->contacts.v;
    double most = 0;
    for (int i = 0; i < count; i++, v += 2)
        if (tree_of(run)->ties[run->contacts.strikers[i].tie].meeting == meeting) most = fmax(most, *v);
    return most;
}

/* Bounces that nobody sees: 1e-10 of the scene, a hundred times what counts as touching. */
static const double low_share = 100;

/* The impacts of striker i's meeting: do they end soon, in bounces that nobody sees? Then when. */
static double end_of_series(struct run *run, int i, int count)
{
    const struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    int index = tree_of(run)->ties[striker->tie].meeting,
        feature = run->state->tree->ties[striker->tie].feature;
    struct bounces *bounces = &run->contacts.bounces[index];
    double v = work->v[(ptrdiff_t)2 * i],
           unseen = low_share * meeting_near(run->model, run->state->tree, index);
    bool same = bounces->feature == feature && bounces->count > 0;
    remember(bounces, run->state->t, feature);
    double interval = bounces->t[0] - bounces->t[1], rise, left;
    if (same && v > 0) {
        double a = -acceleration_of(run, striker->tie, feature);
        if (!(a > 0)) return HUGE_VAL;
        rise = v * v / (2 * a);
        if (rise > unseen || bounces->count < 3) return HUGE_VAL;
        left = sum_of_bounces(run, index, v, a);
    } else {
        rise = leaving_speed(run, index, count) * interval;
        if (bounces->count < 4 || rise > unseen) return HUGE_VAL;
        left = sum_of_rocking(bounces);
    }
    return run->state->t + left;
}

/* Close the meeting for good, as its bounces do in the end; its event comes with that end. */
bool contacts_end_bounces(struct run *run, int count)
{
    bool ended = false;
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &run->contacts.strikers[i];
        if (striker->rope || striker->v_n >= 0) continue;
        int index = tree_of(run)->ties[striker->tie].meeting;
        double end = end_of_series(run, i, count);
        if (!(end < HUGE_VAL)) continue;
        run->contacts.bounces[index].rests_from = end;
        ended = true;
    }
    return ended;
}

static double kinetic(struct fbd_state *state)
{
    struct instant at = state_instant(state);
    double sum = 0;
    tree_move(state->model, &at);
    for (size_t b = 0; b < state->model->body_count; b++)
        sum += kinetic_energy(&state->model->bodies[b], &at);
    return sum;
}

/* A meeting whose series is summed up. */
static int last_at_rest(const struct run *run)
{
    int last = 0;
    for (int i = 0; i < tree_of(run)->meeting_count; i++)
        if (run->contacts.bounces[i].rests_from < HUGE_VAL) last = i;
    return last;
}

/* What bounces too low to be seen is put on its surface, and its speed from there taken away: what is left of
 * the series does the same, and its impulses are those of the weight in that time. */
int contacts_settle_down(struct run *run)
{
    const struct tree *tree = tree_of(run);
    struct contacts_work *work = &run->contacts;
    bool *was_touching = work->touching;
    const double wide = 10 * low_share; /* a corner that is about to come down */
    for (int i = 0; i < tree->tie_count; i++)
        was_touching[i] = run->state->tree->ties[i].feature != no_feature;
    for (int i = 0; i < tree->meeting_count; i++) {
        double near = meeting_near(run->model, run->state->tree, i);
        contacts_find_touching(run, i, work->bounces[i].rests_from < HUGE_VAL ? wide * near : near);
    }
    for (int i = 0; i < tree->tie_count; i++) {
        const struct tie *tie = &tree->ties[i];
        if (tie->kind != constraint_contact || tie->pair < 0) continue;
        /* What comes down now holds nothing along its surface; what has stuck sticks. */
        if (!was_touching[i]) run->state->slip[tie->pair] = slip_plus;
    }
    double before = kinetic(run->state);
    state_project(run->state, false);
    impulse_look(run->state);
    int count = contacts_find_strikers(run), last = last_at_rest(run);
    run->impact_work[tree->ties[tree->meetings[last].first_tie].load] += kinetic(run->state) - before;
    for (int i = 0; i < count; i++) {
        double *v = work->v + (ptrdiff_t)2 * i;
        v[0] = 0;
        v[1] = work->strikers[i].v_t;
    }
    return count;
}

/* ---- their end */

double run_next_rest(const struct run *run)
{
    double next = HUGE_VAL;
    int count = tree_of(run) ? tree_of(run)->meeting_count : 0;
    for (int i = 0; i < count; i++) next = fmin(next, run->contacts.bounces[i].rests_from);
    return next;
}

void run_note_rests(struct run *run)
{
    const struct tree *tree = tree_of(run);
    int count = tree ? tree->meeting_count : 0;
    for (int i = 0; i < count; i++) {
        struct bounces *bounces = &run->contacts.bounces[i];
        if (bounces->rests_from > run->state->t) continue;
        const struct tie *tie = &tree->ties[tree->meetings[i].first_tie];
        struct run_event *event = run_note(run, FBD_EVENT_REST, tie->end[0].body, tie->load, -1);
        if (event) event->limit = bounces->count;
        *bounces = (struct bounces){.feature = -1, .rests_from = HUGE_VAL};
    }
}
