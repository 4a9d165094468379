/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Selection of contact pairs for the event search of a step, and its resolution.
 */
#include <string.h>

#include "dynamics/contact.h"
#include "dynamics/tree_system.h"
#include "expr/unit.h"
#include "loop/contacts.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* Angular speed of a shape: of its link, unless it is a circle about the link's origin, and of the links that
 * carry it. */
static double turning(const struct run *run, const struct contact_shape *shape)
{
    const struct tree_state *links = run->contacts.trial->tree->links;
    bool round = shape->kind == contact_disc && shape->center.x == 0 && shape->center.y == 0;
    double turn = round ? 0 : fabs(links[shape->link].omega);
    for (int i = run->model->tree->links[shape->link].parent; i > 0; i = run->model->tree->links[i].parent)
        turn = fmax(turn, fabs(links[i].omega));
    return turn;
}

/* Radians per second by rotation, and by shapes that pass each other: an overlap lasts no longer than a displacement by
 * their size. At the place of `trial`. */
static double phase_rate(const struct run *run, int index, double speed)
{
    const struct contact_shape *shapes = run->model->tree->meetings[index].shape;
    const double size = shapes[0].radius + shapes[1].radius;
    const double turn = fmax(turning(run, &shapes[0]), turning(run, &shapes[1])); /* both may turn */
    const bool flat = shapes[1].kind == contact_line; /* the gap of a line is linear in position */
    return 2 * turn + (flat || size <= 0 ? 0 : 2 * speed / size);
}

double run_contact_radians(const struct run *run, double span)
{
    double most = 0;
    if (!tree_has_contacts(run->model->tree)) return 0;
    for (int i = 0; i < run->model->tree->meeting_count; i++)
        if (!run->contacts.asleep[i]) most = fmax(most, run->contacts.phase_rate[i]);
    return most * span;
}

static void place(struct fbd_state *state)
{
    const struct instant at = state_instant(state);
    tree_move(state->model, &at);
}

/* Speeds within a step are about those at its ends; a factor of two, and a check at the end of the step,
 * allow for more. Of both ends the faster one counts: a body may stop at the end, behind one that it has passed. */
void run_wake_contacts(struct run *run, double end)
{
    const double speeds = 2;
    struct contacts_work *work = &run->contacts;
    struct fbd_state *trial = work->trial;
    if (!tree_has_contacts(run->model->tree)) return;
    double span = end - run->step.from;
    state_copy(trial, run->during);
    place(trial);
    for (int i = 0; i < run->model->tree->meeting_count; i++) {
        struct distance at = meeting_distance(run->model, trial->tree, i);
        work->asleep[i] = meeting_is_gone(trial->tree, &run->model->tree->meetings[i]) ||
                          at.apart > speeds * span * at.speed;
        work->phase_rate[i] = phase_rate(run, i, at.speed);
    }
    memcpy(trial->y, run->work.y, plan_size(&run->model->plan) * sizeof *trial->y);
    trial->t = end;
    place(trial);
    for (int i = 0; i < run->model->tree->meeting_count; i++) {
        struct distance at = meeting_distance(run->model, trial->tree, i);
        work->asleep[i] &= meeting_is_gone(trial->tree, &run->model->tree->meetings[i]) ||
                           at.apart > speeds * span * at.speed;
        work->phase_rate[i] = fmax(work->phase_rate[i], phase_rate(run, i, at.speed));
    }
}

/* ---- kinks
 *
 * The gap of two sets of corners is smooth while it belongs to one corner and one side, and has a kink where
 * another pair takes over. Chebyshev series require smooth functions, and could miss a dip between two
 * samples as a corner passes another. So panels end at kinks that could matter. */

/* The gap of a contact pair at a time of the step, and the largest relative speed of its shapes. */
struct look {
    double t, speed;
    struct gap gap;
};

static struct look look_at(struct run *run, int index, int probe, double t)
{
    const struct meeting *meeting = &run->model->tree->meetings[index];
    struct fbd_state *trial = run->contacts.trial;
    if (trial->t != t) {
        switcher_dense(run->stepper, time_dd_at(t), trial->y);
        trial->t = t;
        place(trial);
    }
    const struct instant at = state_instant(trial);
    double speed = meeting_distance(run->model, trial->tree, index).speed;
    for (int k = 0; k < 2; k++)
        speed += fabs(trial->tree->links[meeting->shape[k].link].omega) * meeting->shape[k].radius;
    return (struct look){t, speed, meeting_probe(run->model, &at, index, probe)};
}

/* Is the gap too large to close within the interval, at 1.5 times the speeds of its ends? */
static bool stays_apart(const struct look *a, const struct look *b)
{
    const double speeds = 1.5;
    return a->gap.x + b->gap.x > speeds * fmax(a->speed, b->speed) * (b->t - a->t);
}

/* Has the gap a kink between a and b (the last one computed), larger than the touching tolerance? */
static bool bends(struct run *run, int index, const struct look *a, const struct look *b)
{
    const struct tree_work *work = run->contacts.trial->tree;
    if (a->gap.feature == b->gap.feature) return false;
    struct gap before = feature_gap(run->model, work, index, a->gap.feature);
    return fabs(before.rate - b->gap.rate) * (b->t - a->t) > meeting_near(run->model, work, index);
}

static double bend_between(struct run *run, int index, int probe, struct look a, struct look b)
{
    double least = fmax(distinct_part * (b.t - a.t), round_off(4, fabs(b.t)));
    while (b.t - a.t > least) {
        struct look middle = look_at(run, index, probe, a.t + (b.t - a.t) / 2);
        if (bends(run, index, &a, &middle))
            b = middle;
        else
            a = middle;
    }
    return b.t;
}

/* Shapes that approach and separate again between a and b: they may have overlapped in between. */
static bool may_dip(const struct look *a, const struct look *b)
{
    return a->gap.x > 0 && b->gap.x > 0 && a->gap.rate < 0 && b->gap.rate > 0;
}

/* A time at which they overlap, found on the way to the smallest gap; the end of the interval where there is
 * none. */
static double dip_between(struct run *run, int index, int probe, struct look a, struct look b)
{
    const double share = distinct_part, end = b.t;
    double least = fmax(share * (b.t - a.t), round_off(4, fabs(b.t)));
    while (b.t - a.t > least && !stays_apart(&a, &b)) {
        struct look middle = look_at(run, index, probe, a.t + (b.t - a.t) / 2);
        if (middle.gap.x <= 0) return middle.t;
        if (middle.gap.rate < 0)
            a = middle;
        else
            b = middle;
    }
    return end;
}

/* The first relevant kink or dip in (from, to], else `to`. A corner may pass within the interval with the
 * same side at both ends: so quarters are checked. */
static double until_bend(struct run *run, int index, int probe, double from, double to)
{
    enum { pieces = 4 };
    struct look a = look_at(run, index, probe, from), end = look_at(run, index, probe, to);
    for (int k = 1; k <= pieces && !stays_apart(&a, &end); k++) {
        struct look b = k == pieces ? end : look_at(run, index, probe, from + k * (to - from) / pieces);
        look_at(run, index, probe, b.t);
        bool near = !stays_apart(&a, &b);
        if (near && bends(run, index, &a, &b)) return bend_between(run, index, probe, a, b);
        double dip = near && may_dip(&a, &b) ? dip_between(run, index, probe, a, b) : b.t;
        if (dip < b.t) return dip;
        a = b;
    }
    return to;
}

/* The number of gaps with kinks or sharp curvature as one shape passes the other. */
static int bending_probes(const struct run *run, int index)
{
    const struct meeting *meeting = &run->model->tree->meetings[index];
    bool smooth = meeting->stop != 0 || meeting->shape[1].kind == contact_line;
    if (smooth || run->contacts.asleep[index]) return 0;
    return meeting->thin ? meeting->probes : 1;
}

double run_contact_bend(struct run *run, double from, double to)
{
    for (int i = 0; tree_has_contacts(run->model->tree) && i < run->model->tree->meeting_count; i++)
        for (int probe = 0; probe < bending_probes(run, i); probe++) to = until_bend(run, i, probe, from, to);
    return to;
}

/* Does the overlap of a pair not increase? Contacts that have just opened separate from rest, to rounding. */
static bool parts(const struct run *run, const struct instant *at, int index)
{
    const double rounding = solved_rounding,
                 of_all = negligible_part; /* relative to the present speeds, and to the largest of the run */
    const struct meeting *meeting = &run->model->tree->meetings[index];
    double least = HUGE_VAL, speed = meeting_speed(run->state->tree, meeting);
    for (int probe = 0; probe < meeting->probes; probe++) {
        struct gap gap = meeting_probe(run->model, at, index, probe);
        if (gap.x < 0) least = fmin(least, gap.rate);
    }
    return least >= -fmax(rounding * speed, of_all * run->contacts.speed);
}

static double reach_of(double near, double deep)
{
    return deep > near && deep <= contacts_late * near ? 1.001 * deep : near;
}

void contacts_note_depths(struct run *run)
{
    const struct fbd_state *state = run->state;
    const struct instant at = state_instant(run->state);
    for (int i = 0; i < run->model->tree->meeting_count; i++) {
        double deep = meeting_depth(run->model, &at, i), near = meeting_near(run->model, state->tree, i);
        double reach = reach_of(near, deep);
        int features[2];
        bool beyond = deep > meeting_rounding(run->model, state->tree, i); /* rounding is always accepted */
        bool leaves = beyond && deep <= contacts_late * near && parts(run, &at, i);
        bool over_an_end =
            deep > 0 && deep <= reach && meeting_touching(run->model, state->tree, i, reach, features) == 0;
        run->contacts.deep[i] = leaves || over_an_end ? deep : 0;
    }
}

/* Shapes that overlap without an event: the projection of other couplings has moved them by less than the
 * touching tolerance. For those that separate the depth is recorded; returns whether there are others. */
static bool projected_in(struct run *run)
{
    struct contacts_work *work = &run->contacts;
    const struct instant at = state_instant(run->state);
    bool in = false;
    for (int i = 0; i < run->model->tree->meeting_count; i++) {
        if (work->asleep[i]) continue;
        double deep = meeting_depth(run->model, &at, i);
        if (deep <= work->deep[i] + meeting_rounding(run->model, run->state->tree, i)) continue;
        if (!parts(run, &at, i)) {
            in = true;
            continue;
        }
        work->deep[i] = deep;
        run->step.restart |= affine_mark_gap(run->model, i, NULL); /* its constant term is another */
    }
    return in;
}

/* The number of points at which the shapes of a contact pair touch. */
static int count_touching(const struct run *run, int index)
{
    const struct tree_work *work = run->state->tree;
    double near = meeting_near(run->model, work, index);
    int features[2], count = meeting_touching(run->model, work, index, near, features);
    if (count < 2) return count;
    struct vec a = feature_place(run->model, work, index, features[0]),
               b = feature_place(run->model, work, index, features[1]);
    return vec_norm(vec_sub(a, b)) <= contacts_same * near ? 1 : 2;
}

static int count_closed(const struct run *run, int index)
{
    const struct meeting *meeting = &run->model->tree->meetings[index];
    const struct instant at = state_instant(run->state);
    int closed = 0;
    for (int k = 0; k < meeting->coupling_count; k++)
        closed += coupling_is_closed(run->model, &at, meeting->first_coupling + k);
    return closed;
}

/* Features that touch without an approach, as a corner that slides over a joint of level tiles: no gap had a
 * zero. Those that touched before and were left open are ignored. */
static bool come_to_touch(struct run *run)
{
    struct contacts_work *work = &run->contacts;
    bool come = false;
    for (int i = 0; i < run->model->tree->meeting_count; i++) {
        if (work->asleep[i] || run->model->tree->meetings[i].stop != 0) continue;
        int touching = count_touching(run, i);
        come |= touching > work->touched[i] && touching > count_closed(run, i);
        work->touched[i] = touching;
    }
    return come;
}

void contacts_note_touching(struct run *run)
{
    for (int i = 0; i < run->model->tree->meeting_count; i++)
        run->contacts.touched[i] = run->model->tree->meetings[i].stop != 0 ? 0 : count_touching(run, i);
}

bool run_overlaps(struct run *run, double end)
{
    struct fbd_state *trial = run->contacts.trial;
    double depth;
    if (!tree_has_contacts(run->model->tree) || run->end.outcome != FBD_GOING) return false;
    state_copy(trial, run->during);
    memcpy(trial->y, run->work.y, plan_size(&run->model->plan) * sizeof *trial->y);
    trial->t = end;
    return contacts_overlap(trial, &depth) >= 0;
}

void run_check_overlap(struct run *run)
{
    double depth;
    if (!tree_has_contacts(run->model->tree) || run->end.outcome != FBD_GOING) return;
    int meeting = contacts_overlap(run->state, &depth);
    if (meeting < 0) {
        run->contacts.due |= come_to_touch(run) || (run->projected && projected_in(run));
        return;
    }
    char unit[24];
    unit_name(DIM_LENGTH, run->model->scene->units, unit, sizeof unit);
    run_fail(run, FBD_FAILED,
             "at t = %.9g the shapes of the contact `%s` are in each other by %.3g %s: the instant at which "
             "they met was "
             "missed. Try a smaller tolerance or step",
             run_time(run),
             run->model->scene->constraints[run->model->tree->meetings[meeting].constraint].name, depth,
             unit);
}

double contacts_reach(const struct run *run, int index)
{
    const struct instant at = state_instant(run->state);
    double near = meeting_near(run->model, run->state->tree, index);
    return reach_of(near, meeting_depth(run->model, &at, index));
}
