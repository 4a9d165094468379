/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Limits of couplings: a rope wound on a disc is unwound, or its free end has reached the disc, where it
 * would turn ever faster; one that is hauled in has no length left; the point of a slot has reached its end.
 * The same equations are not valid beyond, so each of these ends the run with a message.
 *
 * The remaining room may vanish and return within a step: so a step is searched in parts, and where the rate
 * changes its sign within a part the minimum is found.
 */
#include <math.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/project.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

struct end {
    struct run *run;
    int coupling, end;
    bool piece; /* the straight piece after point `end`, not an end */
};

static const struct coupling *coupling_of(const struct end *end)
{
    return &end->run->model->tree->couplings[end->coupling];
}

static void look(struct run *run, double t, const double *y)
{
    struct fbd_state *state = run->during;
    memcpy(state->y, y, 2 * (size_t)run->model->plan.n * sizeof *state->y);
    state->t = t;
    state_misfit(state); /* updates the positions of the links */
}

/* The room before the limit, for the links set by look(). */
static struct room room_of(const struct end *end)
{
    const struct tree_work *work = end->run->during->tree;
    return end->piece ? rope_piece(end->run->model, work, end->coupling, end->end)
                      : coupling_room(end->run->model, work, end->coupling, end->end);
}

/* The same at a time within the last step; NAN where it is not available. */
static struct room room_at(const struct end *end, double t)
{
    struct run *run = end->run;
    if (switcher_partial(run->stepper, time_dd_at(t), run->work.y, run->work.f) != 0)
        return (struct room){NAN, NAN, 0};
    look(run, t, run->work.y);
    return room_of(end);
}

/* Is the room negative by more than rounding? */
static bool is_used_up(struct room room)
{
    return room.left < -negligible_sum * room.size;
}

/* A time in an interval at which the room is used up, tested near its minimum; NAN if there is none. */
static double used_up_within(const struct end *end, double from, double to)
{
    struct room before = room_at(end, from), after = room_at(end, to);
    if (is_used_up(before)) return from;
    if (is_used_up(after)) return to;
    while (before.rate < 0 && after.rate > 0) {
        double middle = from + (to - from) / 2;
        if (!(middle > from && middle < to)) break;
        struct room room = room_at(end, middle);
        if (is_used_up(room)) return middle;
        *(room.rate < 0 ? &from : &to) = middle;
    }
    return NAN;
}

/* The time at which the room vanishes, by bisection between a time with room and one without. */
static double empty_time(const struct end *end, double some, double none)
{
    for (;;) {
        double middle = some + (none - some) / 2;
        if (!(middle > some && middle < none)) return some;
        *(is_used_up(room_at(end, middle)) ? &none : &some) = middle;
    }
}

/* Other couplings than ropes are always taut, except for a point off its slot. */
static bool is_taut(const struct fbd_state *state, const struct coupling *coupling)
{
    if (slot_is_open(coupling, state->slip)) return false;
    return coupling->kind != constraint_rope || coupling->pair < 0 || state->slip[coupling->pair] == stick;
}

static const char *name_of(const struct run *run, const struct coupling *coupling, int k)
{
    return coupling->end[k].body < 0 ? "the ground" : run->model->bodies[coupling->end[k].body].name;
}

static void fail_at_end(const struct end *end, double t, bool gets_taut)
{
    struct run *run = end->run;
    const struct coupling *coupling = coupling_of(end);
    if (coupling->kind == constraint_slot || coupling->kind == constraint_groove)
        run_fail(run, FBD_BROKEN,
                 "at t = %.9g the point in the slot `%s` reaches the end of the slot. Make it longer, or end "
                 "the run earlier by an event",
                 t, coupling->name);
    else
        run_fail(
            run, FBD_BROKEN,
            "at t = %.9g the rope `%s` %s all unwound from `%s`. End the run before, by an event, or wind "
            "more on it (`length` of `wound`)",
            t, coupling->name, gets_taut ? "gets taut where it is" : "is",
            name_of(run, coupling, end->end == 0 ? 0 : coupling->end_count - 1));
}

/* Is the room large in a part of a step, by the dense output? Where the rate changes its sign the room is
 * assumed to lie above its tangents at both ends. */
static bool has_plenty(const struct end *end, struct room before, struct room after, double length)
{
    const double share = 0.01, tolerances = 100; /* errors of dense output are some tens of them */
    double least = fmax(share, tolerances * end->run->options.tolerance) * after.size;
    if (!(before.left > least && after.left > least)) return false;
    bool turns = before.rate < 0 && after.rate > 0;
    return !turns || fmax(before.left + before.rate * length, after.left - after.rate * length) > least;
}

/* The same for all parts of the last step, by dense output. */
static bool is_far(const struct end *end, double from, double length, int parts)
{
    struct run *run = end->run;
    struct room before = {0};
    if (run->options.step > 0) return false; /* unknown accuracy */
    for (int k = 0; k <= parts; k++) {
        if (switcher_dense(run->stepper, time_dd_at(from + k * length), run->work.aside) != 0) return false;
        look(run, from + k * length, run->work.aside);
        struct room room = room_of(end);
        if (k > 0 && !has_plenty(end, before, room, length)) return false;
        before = room;
    }
    return true;
}

static void watch_end(const struct end *end, struct time_dd *t)
{
    enum { parts = 8 };
    struct run *run = end->run;
    double from = run->step.from, length = (t->t - from) / parts, used = NAN;
    if (!isfinite(room_of(end).size) || is_far(end, from, length, parts)) return;
    for (int k = 0; k < parts && isnan(used); k++)
        used = used_up_within(end, from + k * length, k + 1 == parts ? t->t : from + (k + 1) * length);
    if (!isnan(used)) *t = time_dd_at(used > from ? empty_time(end, from, used) : from);
    switcher_partial(run->stepper, *t, run->work.y, run->work.f);
    if (!isnan(used)) fail_at_end(end, t->t, false);
}

/* The time at which a piece is shortest within the last step: it may vanish and grow again, beyond the rim. */
static double shortest_at(const struct end *piece, double little, double to)
{
    enum { parts = 8 };
    double from = piece->run->step.from;
    double before = room_at(piece, from).rate, after = room_at(piece, to).rate;
    if (before < 0 && after > 0 && is_far(piece, from, (to - from) / parts, parts)) return to;
    while (before < 0 && after > 0) {
        double middle = from + (to - from) / 2;
        if (!(middle > from && middle < to)) break;
        struct room room = room_at(piece, middle);
        if (room.rate < 0 && room.left <= little * room.size) return middle; /* it still has a direction */
        *(room.rate < 0 ? &from : &to) = middle;
    }
    return to;
}

/* End the run where a straight piece becomes too short: a millionth of the disc, a thousandth of a rope that
 * is hauled in, about whose end a load turns ever faster, or 1e-9 of a rope between points. */
static void watch_piece(const struct end *piece, struct time_dd *t)
{
    struct run *run = piece->run;
    const struct coupling *coupling = coupling_of(piece);
    const bool at_rim = coupling->end[piece->end].radius > 0 || coupling->end[piece->end + 1].radius > 0;
    const double little = coupling->reels ? 1e-3 : at_rim ? distinct_part : undecided_part;
    double when = shortest_at(piece, little, t->t);
    struct room room = room_at(piece, when);
    if (room.left > little * room.size || room.rate > 0) { /* NAN is beyond */
        switcher_partial(run->stepper, *t, run->work.y, run->work.f);
        return;
    }
    *t = time_dd_at(when);
    run_fail(
        run, FBD_BROKEN,
        "at t = %.9g the rope `%s` has no length left between `%s` and `%s`. End the run earlier by an event",
        t->t, coupling->name, name_of(run, coupling, piece->end), name_of(run, coupling, piece->end + 1));
}

/* Check pieces between points of a taut rope of constant length: one becomes shorter as another becomes
 * longer. The ends of the step show which of them have to be searched within it. A piece that ends on a rim
 * passes through zero length where its other end passes the point of tangency, and the motion goes on. */
static void watch_shortening(struct run *run, int index, struct time_dd *t)
{
    const struct coupling *coupling = &run->model->tree->couplings[index];
    const double length = t->t - run->step.from;
    for (int k = 0; k + 1 < coupling->end_count && run->end.outcome == FBD_GOING; k++) {
        const struct end piece = {run, index, k, true};
        if (coupling->end[k].radius > 0 || coupling->end[k + 1].radius > 0) continue;
        look(run, run->step.from, run->state->y);
        const struct room before = room_of(&piece);
        look(run, t->t, run->work.y);
        if (!has_plenty(&piece, before, room_of(&piece), length)) watch_piece(&piece, t);
    }
}

/* End the run where a rope with friction on a drum has become straight. */
static void watch_wrap(struct run *run, int index, struct time_dd t)
{
    const struct coupling *coupling = &run->model->tree->couplings[index];
    look(run, t.t, run->work.y);
    const struct instant at = state_instant(run->during);
    if (capstan_wrap(run->model, &at, index, false, NULL) >= 0) return;
    run_fail(run, FBD_BROKEN,
             "by t = %.9g the rope `%s` has come off its drum: its two sides have become one straight line. "
             "End the "
             "run before, by an event",
             t.t, coupling->name);
}

static void watch_coupling(struct run *run, int i, struct time_dd *t)
{
    const struct coupling *coupling = &run->model->tree->couplings[i];
    const struct fbd_state *state = run->during;
    bool rubs = coupling->kind == constraint_capstan && state->slip[coupling->surface] == stick;
    bool winds = coupling->wound[0] != 0 || coupling->wound[1] != 0;
    bool hauls = coupling->kind == constraint_rope && (winds || coupling->reels) && is_taut(state, coupling);
    for (int end = 0; end < 2 && is_taut(state, coupling); end++)
        watch_end(&(struct end){run, i, end, false}, t);
    if (rubs) watch_wrap(run, i, *t);
    for (int k = 0; (rubs || hauls) && k + 1 < coupling->end_count; k++)
        watch_piece(&(struct end){run, i, k, true}, t);
    if (coupling->kind == constraint_rope && !hauls && is_taut(state, coupling)) watch_shortening(run, i, t);
}

/* ---- a point off its slot passes an end of it */

/* The room in the slot, plus half of slot_rounding, the uncertainty of being within. */
static struct room way_at(const struct end *end, double t)
{
    struct room room = room_at(end, t);
    room.left += slot_rounding / 2 * room.size;
    return room;
}

/* A time in an interval at which the point is on the other side of the end than at `from`; NAN if there is
 * none. */
static double passed_within(const struct end *end, int side, double from, double to)
{
    double before = side * way_at(end, from).rate;
    const struct room there = way_at(end, to);
    double after = side * there.rate;
    if (side * there.left < 0) return to;
    while (before < 0 && after > 0) {
        double middle = from + (to - from) / 2;
        if (!(middle > from && middle < to)) break;
        struct room room = way_at(end, middle);
        if (side * room.left < 0) return middle;
        *(side * room.rate < 0 ? &from : &to) = middle;
    }
    return NAN;
}

/* By bisection, the last time on the same side; or the first on the other side if that is at the begin of the
 * step. */
static double passing_time(const struct end *end, int side, double not_yet, double passed)
{
    for (;;) {
        double middle = not_yet + (passed - not_yet) / 2;
        if (!(middle > not_yet && middle < passed)) return not_yet > end->run->step.from ? not_yet : passed;
        *(side * way_at(end, middle).left < 0 ? &passed : &not_yet) = middle;
    }
}

/* Beyond the end the gap is a different function, so one step ends just before, and the next one just behind.
 * A return from behind the slot ends the run. */
static void watch_passing(const struct end *end, struct time_dd *t)
{
    enum { parts = 8 };
    struct run *run = end->run;
    const double from = run->step.from, length = (t->t - from) / parts;
    const struct row *row = &run->during->tree->rows[coupling_of(end)->first_row];
    double passed = NAN;
    if (is_far(end, from, length, parts)) return;
    const int side = way_at(end, from).left < 0 ? -1 : 1;
    for (int k = 0; k < parts && isnan(passed); k++)
        passed = passed_within(end, side, from + k * length, k + 1 == parts ? t->t : from + (k + 1) * length);
    if (!isnan(passed)) {
        *t = time_dd_at(passing_time(end, side, from, passed));
        way_at(end, t->t);
        if (side < 0 && row->g.x < 0)
            run_fail(run, FBD_BROKEN,
                     "at t = %.9g the point of the slot `%s` returns behind it. Make it longer, or end the "
                     "run earlier by an event",
                     t->t, coupling_of(end)->name);
    }
    switcher_partial(run->stepper, *t, run->work.y, run->work.f);
}

void run_watch_slots(struct run *run, struct time_dd *t)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        if (!slot_is_open(&tree->couplings[i], run->during->slip) ||
            coupling_is_gone(run->during->tree, &tree->couplings[i]))
            continue;
        for (int k = 0; k < 2 && run->end.outcome == FBD_GOING; k++) {
            const struct end end = {run, i, k, false};
            if (isfinite(coupling_room(run->model, run->during->tree, i, k).size)) watch_passing(&end, t);
        }
    }
}

/* ---- return of a point to its slot, of a slack rope to its full length */

/* The gap, a bound of its rate, and the longest interval in which it is a smooth function: rotation by at
 * most one radian, and displacement by at most a quarter of the radius of a curve. */
struct flight {
    double apart, speed, longest;
};

static bool is_slack(const struct fbd_state *state, const struct coupling *coupling)
{
    return coupling->kind == constraint_rope && coupling->pair >= 0 && state->slip[coupling->pair] != stick;
}

/* At time t within the last step. */
static bool flight_at(struct run *run, int index, double t, struct flight *flight)
{
    const struct coupling *coupling = &run->model->tree->couplings[index];
    if (switcher_dense(run->stepper, time_dd_at(t), run->work.aside) != 0) return false;
    look(run, t, run->work.aside);
    const struct instant at = state_instant(run->during);
    struct one_sided now =
        one_sided_at(run->model, &at, is_slack(run->during, coupling) ? coupling->pair : coupling->surface);
    struct slot_size size = slot_size(run->model, run->during->tree, index);
    flight->apart = -now.excess;
    flight->speed =
        2 * (coupling->end_count > 1 ? coupling->end_count - 1 : 1) * (now.speed + now.turning * size.reach);
    flight->longest = fmin(1 / now.turning, size.radius / (4 * flight->speed));
    return true;
}

/* The gap has a kink where another part of the slot becomes the nearest, and may vanish and grow again in
 * passing a cam, or as a crank turns that pulls a rope. So the interval is one in which the gap stays open,
 * or else a short one. */
static double until_near(struct run *run, int index, double from, double to)
{
    const double speeds = 1.5;
    struct flight a, b;
    if (!flight_at(run, index, from, &a)) return to;
    for (;;) {
        double span = to - from, middle = from + span / 2;
        if (!flight_at(run, index, to, &b)) return to;
        bool stays = a.apart + b.apart > speeds * fmax(a.speed, b.speed) * span;
        if (stays || !(span > fmin(a.longest, b.longest)) || !(middle > from && middle < to)) return to;
        to = middle;
    }
}

double run_flights(struct run *run, double from, double to)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *coupling = &tree->couplings[i];
        if (coupling_is_gone(run->during->tree, coupling)) continue;
        if (slot_is_open(coupling, run->during->slip) || is_slack(run->during, coupling))
            to = until_near(run, i, from, to);
    }
    return to;
}

/* ---- all couplings */

void run_watch_ends(struct run *run, struct time_dd *t)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->coupling_count && run->end.outcome == FBD_GOING; i++)
        if (!coupling_is_gone(run->during->tree, &tree->couplings[i])) watch_coupling(run, i, t);
}

void run_check_ends(struct run *run)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->coupling_count && run->end.outcome == FBD_GOING; i++) {
        if (tree->couplings[i].kind != constraint_rope || !is_taut(run->state, &tree->couplings[i])) continue;
        for (int k = 0; k < 2; k++) {
            struct end end = {run, i, k, false};
            if (!isfinite(room_of(&end).size)) continue;
            look(run, run->state->t, run->state->y);
            if (is_used_up(room_of(&end))) fail_at_end(&end, run_time(run), true);
        }
    }
}
