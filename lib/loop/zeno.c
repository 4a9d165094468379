/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Zeno limits of bounces: when bounces are below the tolerance the series is summed, and the body rests.
 */
#include <stdlib.h>
#include <string.h>

#include "dynamics/contact.h"
#include "dynamics/impulse.h"
#include "dynamics/tree_system.h"
#include "loop/contacts.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* Speeds after an impact below this share of those before it are rounding. */
static const double leaving_rounding = undecided_part;

/* The acceleration of a coupling's gap with only the surfaces that stay closed: without those that the impact has just
 * opened (a box that falls flat bounces on all its corners, and one of a row may leave the next as well) and
 * without its own; by evaluating a trial state in these modes. */
static double acceleration_of(struct run *run, int coupling)
{
    const struct contacts_work *work = &run->contacts;
    struct fbd_state *state = work->trial;
    const struct tree *tree = run->model->tree;
    state_copy(state, run->state);
    state->slip[tree->couplings[coupling].surface] = slip_plus;
    for (int i = 0; i < work->struck; i++) {
        const struct striker *striker = &work->strikers[i];
        bool leaves = striker->contact && contacts_part(run, i);
        if (leaves) state->slip[tree->couplings[striker->coupling].surface] = slip_plus;
    }
    for (int k = 0; k < work->twin_count; k++) {
        int own = work->twins[k].coupling, point = work->twins[k].point;
        bool leaves = work->strikers[point].coupling == coupling || contacts_part(run, point);
        if (leaves) state->slip[tree->couplings[own].surface] = slip_plus;
    }
    state_evaluate(state);
    return state->tree->rows[run->model->tree->couplings[coupling].first_row].g.x2;
}

/* Is the restitution of a contact pair independent of speed? */
static bool has_constant_restitution(const struct run *run, int meeting)
{
    int index = run->model->tree->meetings[meeting].constraint;
    const struct expr *expr = run->model->scene->constraints[index].contact.restitution.expr;
    return !expr || expr_is_constant(expr);
}

/* The sum of the intervals after an impact with separation speed v at acceleration -a: 2 v / a, then the same
 * with e v, and so on. */
static double sum_of_bounces(struct run *run, int meeting, double v, double a)
{
    enum { most_terms = 1000000 };
    double sum = 0;
    for (int k = 0; k < most_terms; k++) {
        double interval = 2 * v / a, e = contacts_restitution(run, meeting, v);
        if (e < 0) return NAN;
        if (has_constant_restitution(run, meeting)) return interval / (1 - e);
        sum += interval;
        if (interval <= round_off(1, sum)) return sum;
        v *= e;
    }
    return HUGE_VAL;
}

/* The remaining time of rocking from corner to corner and back: the last four impacts give two intervals, and
 * their ratio. */
static double sum_of_rocking(const struct bounces *bounces)
{
    if (bounces->count < 4) return HUGE_VAL;
    const double *t = bounces->t;
    double last = t[0] - t[1], before = t[1] - t[2], first = t[2] - t[3];
    double ratio = last / first;
    return ratio > 0 && ratio < 1 ? ratio * (last + before) / (1 - ratio) : HUGE_VAL;
}

/* The remaining time of bounces of one point, from their last intervals: where accelerations vary, as other
 * contacts slip and stick at each bounce, no single one determines it. */
static double sum_of_intervals(const struct bounces *bounces)
{
    if (bounces->count < 4) return HUGE_VAL;
    const double *t = bounces->t;
    double last = t[0] - t[1], before = t[1] - t[2], first = t[2] - t[3];
    return last < before && before < first ? last * last / (before - last) : HUGE_VAL;
}

/* Bounces below the tolerance that do not end: changes of stick and slip at each of them, or after a plastic
 * impact, may lift the point again by as much (chatter, and reverse chatter, of Nordmark, Dankowicz and
 * Champneys, IMA Journal of Applied Mathematics 76, 2011). Their heights are below the rounding of positions,
 * and rest is a solution, too: after `many` bounces the point is set to rest. If an impact leaves no
 * separation speed, as a plastic one, the approach speed is used: impacts of a disc that comes and goes are
 * far apart, and no series. */
enum { many = 20 };

static bool is_crowd(struct bounces *bounces, double speed, double unseen)
{
    double interval = bounces->t[0] - bounces->t[1];
    bool seen = bounces->count < 2 || speed * interval > unseen;
    bounces->unseen = seen ? 0 : bounces->unseen + 1;
    return bounces->unseen >= many;
}

/* The remaining time of rocking with plastic impacts: the series of the last impacts where they are
 * geometric, and else the one low bounce `next`. */
static double sum_of_plastic_rocking(const struct bounces *bounces, double next, bool nothing)
{
    const double alike = 0.01; /* relative change of the ratio from bounce to bounce of a low series */
    const double *t = bounces->t;
    if (bounces->count < 5) return nothing ? next : HUGE_VAL; /* five impacts are needed */
    double ratio = (t[0] - t[1]) / (t[2] - t[3]), before = (t[1] - t[2]) / (t[3] - t[4]);
    double all = sum_of_rocking(bounces);
    return fabs(ratio - before) <= alike * before ? all : fmin(all, next);
}

static void remember(struct bounces *bounces, double t, int feature)
{
    for (int k = 4; k > 0; k--) bounces->t[k] = bounces->t[k - 1];
    bounces->t[0] = t;
    bounces->feature = feature;
    bounces->count++;
}

/* The largest separation speed of a contact pair's features after an impact. */
static double leaving_speed(const struct run *run, int meeting, int count)
{
    const double *v = run->contacts.v;
    double most = 0;
    for (int i = 0; i < count; i++, v += 2)
        if (run->model->tree->couplings[run->contacts.strikers[i].coupling].meeting == meeting)
            most = fmax(most, *v);
    return most;
}

/* ---- ropes that become slack by impacts on a surface, and lift the body again when they become taut */

/* The largest speed with which ropes, and surfaces without restitution, open by the last impact. */
static double slackening_speed(const struct run *run, int count)
{
    const struct contacts_work *work = &run->contacts;
    double most = 0;
    for (int i = 0; i < count; i++)
        if (!work->strikers[i].contact) most = fmax(most, work->v[(ptrdiff_t)2 * i]);
    return most;
}

static void note_return(struct bounces *bounces, double t)
{
    enum { most = sizeof bounces->returned / sizeof bounces->returned[0] };
    for (int k = most - 1; k > 0; k--) bounces->returned[k] = bounces->returned[k - 1];
    bounces->returned[0] = t;
    if (bounces->returns < most) bounces->returns++;
}

/* The limit of a geometric series through t[2], t[1], t[0]; HUGE_VAL without one. */
static double end_of_three(const double t[3])
{
    double last = t[0] - t[1], ratio = last / (t[1] - t[2]);
    return ratio > 0 && ratio < 1 ? t[0] + ratio * last / (1 - ratio) : HUGE_VAL;
}

/* The limit of returns at decreasing intervals. The last intervals are affected by the rounding of positions
 * over speeds, the first ones are not yet geometric where accelerations vary: so the limit is used on which
 * three returns and the three before agree best. */
static double end_of_returns(const struct bounces *bounces)
{
    double best = HUGE_VAL, apart = HUGE_VAL;
    for (int k = 0; k + 4 <= bounces->returns; k++) {
        double end = end_of_three(bounces->returned + k), before = end_of_three(bounces->returned + k + 1);
        if (!(fabs(end - before) < apart) || end < bounces->returned[0]) continue;
        apart = fabs(end - before);
        best = end;
    }
    return best;
}

/* In a crowd ropes that open by less than the tolerance stay closed, too. */
static void keep_ropes(struct run *run, const struct bounces *bounces, double unseen, int count)
{
    struct contacts_work *work = &run->contacts;
    double interval = bounces->t[0] - bounces->t[1];
    for (int i = 0; i < count; i++)
        work->strikers[i].stays |=
            !work->strikers[i].contact && work->v[(ptrdiff_t)2 * i] * interval <= unseen;
}

/* The limit of such a series, if ropes open by less than the tolerance; they then stay closed. */
static double end_of_tugs(struct run *run, const struct bounces *bounces, double unseen, int count)
{
    double leaving = slackening_speed(run, count), end = end_of_returns(bounces);
    if (leaving == 0 || leaving * (bounces->returned[0] - bounces->returned[1]) > unseen) return HUGE_VAL;
    for (int i = 0; i < count && end < HUGE_VAL; i++)
        run->contacts.strikers[i].stays = !run->contacts.strikers[i].contact;
    return end;
}

/* Does any contact open by the impact of impact constraint i, by more than rounding? */
static bool any_leaves(const struct run *run, int i, int count)
{
    const struct contacts_work *work = &run->contacts;
    const double *v = work->v;
    for (int k = 0; k < count; k++, v += 2)
        if (work->strikers[k].contact && *v > -leaving_rounding * work->strikers[i].v_n) return true;
    return false;
}

/* Does any contact open by the impact for a bounce below the tolerance? Contacts that separate as slowly, but
 * do not return, do not count. */
static bool any_hops(struct run *run, int count)
{
    const struct contacts_work *work = &run->contacts;
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &work->strikers[i];
        if (!striker->contact || !contacts_part(run, i)) continue;
        double v = work->v[(ptrdiff_t)2 * i], a = -acceleration_of(run, striker->coupling),
               unseen = zeno_height * meeting_near(run->model, run->state->tree,
                                                   run->model->tree->couplings[striker->coupling].meeting);
        if (a > 0 && v * v <= 2 * a * unseen) return true;
    }
    return false;
}

/* Is the next bounce far higher than the tolerance, by the mean acceleration since the last impact? Then its own
 * acceleration is not evaluated; an error delays the end of the series by a bounce. */
static bool is_high(const struct bounces *bounces, double approach, double leaving, double unseen)
{
    const double far = 1e3;
    double interval = bounces->t[0] - bounces->t[1];
    return bounces->count > 1 && leaving * leaving * interval > far * 4 * approach * unseen;
}

/* The time at which the impacts of impact constraint i's pair end, if their bounces are below the tolerance;
 * else HUGE_VAL. */
static double end_of_series(struct run *run, int i, int count)
{
    const struct contacts_work *work = &run->contacts;
    const struct striker *striker = &work->strikers[i];
    int index = run->model->tree->couplings[striker->coupling].meeting,
        feature = run->state->tree->couplings[striker->coupling].feature;
    struct bounces *bounces = &run->contacts.bounces[index];
    double v = work->v[(ptrdiff_t)2 * i], leaving = leaving_speed(run, index, count),
           unseen = zeno_height * meeting_near(run->model, run->state->tree, index);
    bool same = bounces->feature == feature && bounces->count > 0;
    if (bounces->is_closed) note_return(bounces, run->state->t);
    remember(bounces, run->state->t, feature);
    bounces->is_closed = !any_leaves(run, i, count);
    bool stops = bounces->is_closed || leaving <= -leaving_rounding * striker->v_n;
    bool crowd = is_crowd(bounces, stops ? -striker->v_n : leaving, unseen);
    if (bounces->is_closed && !crowd) return end_of_tugs(run, bounces, unseen, count);
    bool far = same && !bounces->is_closed && bounces->unseen == 0;
    if (far && is_high(bounces, -striker->v_n, leaving, unseen)) return HUGE_VAL;
    double a = -acceleration_of(run, striker->coupling), left = HUGE_VAL;
    bool low = a > 0 && leaving * leaving <= 2 * a * unseen;
    bounces->slow = a > 0 ? sqrt(2 * a * unseen) : leaving;
    if (bounces->is_closed) return run->state->t; /* in a crowd */
    if (!low && bounces->unseen < 3) return HUGE_VAL;
    if (leaving == 0 && !any_hops(run, count)) return HUGE_VAL; /* it rests, and others separate */
    if (same && v > 0) {
        left = low ? sum_of_bounces(run, index, v, a) : sum_of_intervals(bounces);
    } else if (low && !(v > 0)) {
        bool nothing = zeno_height * leaving * leaving <= 2 * a * unseen;
        left = sum_of_plastic_rocking(bounces, 2 * leaving / a, nothing);
    } else {
        left = sum_of_rocking(bounces);
        if (low) left = fmin(left, sum_of_bounces(run, index, v, a));
    }
    if (crowd && !(left < HUGE_VAL)) left = 0;
    if (crowd) keep_ropes(run, bounces, unseen, count);
    double tugs = end_of_tugs(run, bounces, unseen, count);
    return tugs < HUGE_VAL ? tugs : run->state->t + left;
}

/* Close pairs whose series end; their events are logged at the limit. */
bool zeno_end_bounces(struct run *run, int count)
{
    bool ended = false;
    run->contacts.struck = count;
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &run->contacts.strikers[i];
        if (!striker->contact || striker->v_n >= 0) continue;
        int index = run->model->tree->couplings[striker->coupling].meeting;
        const struct bounces *bounces = &run->contacts.bounces[index];
        if (bounces->count > 0 && bounces->t[0] == run->state->t)
            continue; /* another corner of the same shapes */
        double end = end_of_series(run, i, count);
        if (!(end < HUGE_VAL)) continue;
        run->contacts.bounces[index].rests_from = end;
        ended = true;
    }
    if (!ended || zeno_rest_is_harmless(run, count)) return ended;
    for (int i = 0; i < count; i++) {
        const struct striker *striker = &run->contacts.strikers[i];
        if (striker->contact && striker->v_n < 0)
            run->contacts.bounces[run->model->tree->couplings[striker->coupling].meeting].rests_from =
                HUGE_VAL;
    }
    return false;
}

/* The opening below which a constraint stays closed. */
static double unseen_of(const struct run *run, const struct striker *striker)
{
    const double nobody_sees = undecided_part; /* of a rope */
    const struct instant at = state_instant(run->state);
    if (striker->rope) return nobody_sees * run->state->tree->couplings[striker->coupling].zero;
    return one_sided_at(run->model, &at, run->model->tree->couplings[striker->coupling].surface).near;
}

/* Do ropes become taut at decreasing intervals? Compared over two of them, as intervals alternate. */
static bool hurries(const struct bounces *tugs)
{
    const double *t = tugs->returned;
    return tugs->returns >= 5 && t[0] - t[2] < t[2] - t[4];
}

void zeno_end_rope_impacts(struct run *run, int count)
{
    struct contacts_work *work = &run->contacts;
    double leaving = slackening_speed(run, count), unseen = HUGE_VAL;
    const double *t = work->tugs.returned;
    double speed = 0;
    note_return(&work->tugs, run->state->t);
    remember(&work->tugs, run->state->t, 0);
    for (int i = 0; i < count; i++)
        if (!work->strikers[i].contact) unseen = fmin(unseen, unseen_of(run, &work->strikers[i]));
    for (int i = 0; i < count; i++) speed = fmax(speed, -work->strikers[i].v_n);
    is_crowd(&work->tugs, speed, unseen);
    if (leaving == 0 || !hurries(&work->tugs) || leaving * (t[0] - t[2]) > unseen) return;
    for (int i = 0; i < count; i++) work->strikers[i].stays = !work->strikers[i].contact;
    zeno_apply_remaining(run, count, 0);
}

double zeno_rope_limit(const struct run *run)
{
    const struct bounces *tugs = &run->contacts.tugs;
    return tugs->unseen >= many ? tugs->t[0] - tugs->t[1] : 0;
}

/* ---- Zeno limits */

double zeno_next_rest(const struct run *run)
{
    double next = HUGE_VAL;
    int count = run->model->tree->meeting_count;
    for (int i = 0; i < count; i++) next = fmin(next, run->contacts.bounces[i].rests_from);
    return next;
}

void zeno_log_rests(struct run *run)
{
    const struct tree *tree = run->model->tree;
    int count = tree->meeting_count;
    for (int i = 0; i < count; i++) {
        struct bounces *bounces = &run->contacts.bounces[i];
        if (bounces->rests_from > run->state->t) continue;
        const struct coupling *coupling = &tree->couplings[tree->meetings[i].first_coupling];
        struct run_event *event = log_event(run, FBD_EVENT_REST, coupling->end[0].body, coupling->load, -1);
        if (event) event->limit = bounces->count;
        bounces->count = bounces->unseen = 0;
        bounces->feature = -1;
        bounces->rests_from = HUGE_VAL;
        bounces->is_closed = true;
    }
}
