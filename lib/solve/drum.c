/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A rope that is wound on a disc comes to an end in two ways: it is unwound, or its free end has come to the
 * disc, where it would turn ever faster. A rope that is hauled in has come to the end of its way. None of
 * these can be passed with the same equations, so that each ends the run by name.
 *
 * What is wound may have gone to nothing and be back within a step: so a step is looked at in parts, and where
 * the rate turns within a part its least is found.
 */
#include <math.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/project.h"
#include "solve/run.h"

struct drum {
    struct run *run;
    int tie, end;
};

static const struct tie *tie_of(const struct drum *drum)
{
    return &drum->run->model->tree->ties[drum->tie];
}

static void look(struct run *run, double t, const double *y)
{
    struct fbd_state *state = run->during;
    memcpy(state->y, y, 2 * (size_t)run->model->plan.n * sizeof *state->y);
    state->t = t;
    state_misfit(state); /* puts the links in their places */
}

/* What is left on the disc within the last step; NAN where that is not known. */
static double left_at(const struct drum *drum, double t, double *rate)
{
    struct run *run = drum->run;
    if (switcher_partial(run->stepper, moment_at(t), run->y, run->f) != 0) return NAN;
    look(run, t, run->y);
    return rope_wound(run->model, run->during->tree, drum->tie, drum->end, rate);
}

/* Used up by more than rounding. */
static bool is_used_up(const struct drum *drum, double left)
{
    const double rounding = 1e-12;
    return left < -rounding * tie_of(drum)->spare[drum->end];
}

/* A time in a stretch at which it is used up, where it may be at its least; NAN where it is not. */
static double used_up_within(const struct drum *drum, double from, double to)
{
    double before = 0, after = 0, rate;
    double left = left_at(drum, from, &before);
    if (is_used_up(drum, left)) return from;
    left = left_at(drum, to, &after);
    if (is_used_up(drum, left)) return to;
    while (before < 0 && after > 0) {
        double middle = from + (to - from) / 2;
        if (!(middle > from && middle < to)) break;
        if (is_used_up(drum, left_at(drum, middle, &rate))) return middle;
        *(rate < 0 ? &from : &to) = middle;
    }
    return NAN;
}

/* The time at which nothing is left: between one at which there is something, and one at which it is used up. */
static double empty_time(const struct drum *drum, double some, double none)
{
    double rate;
    for (;;) {
        double middle = some + (none - some) / 2;
        if (!(middle > some && middle < none)) return some;
        *(is_used_up(drum, left_at(drum, middle, &rate)) ? &none : &some) = middle;
    }
}

static bool is_taut(const struct fbd_state *state, const struct tie *tie)
{
    return state->slip[tie->pair] == stick;
}

static const char *name_of(const struct run *run, const struct tie *tie, int k)
{
    return tie->end[k].body < 0 ? "the ground" : run->model->bodies[tie->end[k].body].name;
}

static const char *disc_of(const struct drum *drum)
{
    const struct tie *tie = tie_of(drum);
    return name_of(drum->run, tie, drum->end == 0 ? 0 : tie->end_count - 1);
}

static void watch_end(const struct drum *drum, struct moment *t)
{
    enum { parts = 8 };
    struct run *run = drum->run;
    double from = run->from, length = (t->t - from) / parts, used = NAN;
    for (int k = 0; k < parts && isnan(used); k++)
        used = used_up_within(drum, from + k * length, k + 1 == parts ? t->t : from + (k + 1) * length);
    if (isnan(used)) {
        switcher_partial(run->stepper, *t, run->y, run->f);
        return;
    }
    *t = moment_at(used > from ? empty_time(drum, from, used) : from);
    switcher_partial(run->stepper, *t, run->y, run->f);
    run_fail(
        run, FBD_BROKEN,
        "at t = %.9g the rope `%s` is all unwound from `%s`. End the run before, by an event, or wind more "
        "on it (`length` of `wound`)",
        t->t, tie_of(drum)->name, disc_of(drum));
}

static double piece_at(struct run *run, int index, int k, double t, double *rate)
{
    if (switcher_partial(run->stepper, moment_at(t), run->y, run->f) != 0) return NAN;
    look(run, t, run->y);
    return rope_piece(run->model, run->during->tree, index, k, rate);
}

/* Where a piece is at its shortest within the last step: it may go through nothing and grow again, beyond the rim. */
static double shortest_at(struct run *run, int index, int k, double little, double to)
{
    double from = run->from, before = 0, after = 0, rate;
    piece_at(run, index, k, from, &before);
    piece_at(run, index, k, to, &after);
    while (before < 0 && after > 0) {
        double middle = from + (to - from) / 2;
        if (!(middle > from && middle < to)) break;
        double left = piece_at(run, index, k, middle, &rate);
        if (rate < 0 && left <= little) return middle; /* while it has a direction */
        *(rate < 0 ? &from : &to) = middle;
    }
    return to;
}

/* A millionth of the disc is left of a straight piece, or a thousandth of the rope that is hauled in, about whose end
 * a load turns ever faster. */
static void watch_piece(struct run *run, int index, int k, struct moment *t)
{
    const struct tie *tie = &run->model->tree->ties[index];
    const double little = tie->reels ? 1e-3 : 1e-6;
    double rate, when = shortest_at(run, index, k, little, t->t), left = piece_at(run, index, k, when, &rate);
    if (left > little) { /* a number that is none has gone beyond */
        switcher_partial(run->stepper, *t, run->y, run->f);
        return;
    }
    *t = moment_at(when);
    run_fail(
        run, FBD_BROKEN,
        "at t = %.9g the rope `%s` is at an end of its way: there is nothing left between `%s` and `%s`. End "
        "the run before, by an event",
        t->t, tie->name, name_of(run, tie, k), name_of(run, tie, k + 1));
}

/* A rope that rubs has become straight, and comes off its drum. */
static void watch_wrap(struct run *run, int index, struct moment t)
{
    const struct tie *tie = &run->model->tree->ties[index];
    look(run, t.t, run->y);
    const struct instant at = state_instant(run->during);
    if (capstan_wrap(run->model, &at, index, false, NULL) >= 0) return;
    run_fail(run, FBD_BROKEN,
             "by t = %.9g the rope `%s` has come off its drum: its two sides have become one straight line. "
             "End the "
             "run before, by an event",
             t.t, tie->name);
}

void run_watch_drums(struct run *run, struct moment *t)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; tree && i < tree->tie_count; i++) {
        const struct tie *tie = &tree->ties[i];
        if (tie->kind == constraint_capstan && run->during->slip[tie->surface] == stick) {
            watch_wrap(run, i, *t);
            for (int k = 0; k < 2; k++) watch_piece(run, i, k, t);
        }
        bool winds = tie->wound[0] != 0 || tie->wound[1] != 0;
        if (tie->kind != constraint_rope || !(winds || tie->reels) || !is_taut(run->during, tie)) continue;
        for (int end = 0; end < 2; end++)
            if (tie->wound[end] != 0 && isfinite(tie->spare[end])) watch_end(&(struct drum){run, i, end}, t);
        for (int k = 0; k + 1 < tie->end_count; k++) watch_piece(run, i, k, t);
    }
}

void run_check_drums(struct run *run)
{
    const struct tree *tree = run->model->tree;
    double rate;
    for (int i = 0; tree && i < tree->tie_count && run->outcome == FBD_GOING; i++) {
        const struct tie *tie = &tree->ties[i];
        if (tie->kind != constraint_rope || !is_taut(run->state, tie)) continue;
        for (int end = 0; end < 2; end++) {
            struct drum drum = {run, i, end};
            if (tie->wound[end] == 0 || !isfinite(tie->spare[end])) continue;
            look(run, run->state->t, run->state->y);
            if (!is_used_up(&drum, rope_wound(run->model, run->during->tree, i, end, &rate))) continue;
            run_fail(
                run, FBD_BROKEN,
                "at t = %.9g the rope `%s` gets taut where it is all unwound from `%s`. End the run before, "
                "by an event, or wind more on it (`length` of `wound`)",
                run_time(run), tie->name, disc_of(&drum));
        }
    }
}
