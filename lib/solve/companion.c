/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/companion.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* ---- making and freeing */

/* How much more accurate the companion is asked to be. A fifth of the tolerance, and so of the error, costs a
 * method of order 8 a quarter more steps. Methods that it is not like may have smaller errors at the same
 * tolerance, and most cost more; bsimp makes errors that have little to do with the tolerance.
 * Large tolerances are proportional to nothing. Where rounding sets the limit, steps of another size are what
 * matters: they round anew. */
static double tolerance_for(const struct run_options *options)
{
    const double fixed = 1e-13, least = 1e-14, other = 4e-14, most = 2e-6;
    if (options->step > 0) return fixed;
    bool like = options->automatic || options->method == method_at(0);
    double share = like ? 0.2 : 0.02;
    if (options->method->implicit && options->method->order > method_at(0)->order) return fixed;
    if (options->tolerance < 2 * least) return other;
    return fmin(fmax(share * options->tolerance, least), most);
}

struct companion *companion_new(const struct fbd_model *model, const struct run_options *options)
{
    struct companion *companion = calloc(1, sizeof *companion);
    size_t n = (size_t)model->plan.n;
    struct run_options own = {.until = options->until,
                              .tolerance = tolerance_for(options),
                              .method = method_at(0),
                              .automatic = true};
    if (!companion) return NULL;
    companion->model = model;
    companion->run = run_new(model, &own);
    companion->probe = state_new(model);
    companion->scale = calloc(8 * n + 1, sizeof *companion->scale);
    companion->unknown_from = HUGE_VAL;
    if (!companion->run || !companion->scale || !companion->probe) {
        companion_free(companion);
        return NULL;
    }
    companion->worst = companion->scale + 2 * n;
    companion->y = companion->scale + 4 * n;
    for (size_t i = 0; i < 2 * n; i++) companion->scale[i] = fabs(companion->run->state->y[i]);
    return companion;
}

void companion_free(struct companion *companion)
{
    if (!companion) return;
    run_free(companion->run);
    state_free(companion->probe);
    free(companion->scale);
    free(companion);
}

/* ---- going along */

bool companion_behind(const struct companion *companion, double t)
{
    return companion->run->outcome == FBD_GOING && companion->run->state->t < t;
}

/* It ended before t: an event has stopped it that comes a little later in the first run. Go on as it was
 * going there, q + v s + a s^2 / 2. */
static bool go_beyond(const struct run *own, double t, struct fbd_state *state)
{
    const double most = 0.1; /* of the time so far */
    size_t n = (size_t)own->model->plan.n;
    double end = own->state->t, s = t - end;
    if (own->outcome == FBD_FAILED || own->outcome == FBD_OUT_OF_MEMORY || !(s <= most * t)) return false;
    state_copy(state, own->state);
    state_evaluate(state);
    for (size_t i = 0; i < n; i++) {
        state->y[i] += s * (state->y[n + i] + s / 2 * state->a[i]);
        state->y[n + i] += s * state->a[i];
    }
    state->t = t;
    state_evaluate(state);
    return true;
}

/* Events of a run up to and including the time t. */
static size_t events_until(const struct run *run, double t)
{
    size_t count = run->event_count;
    while (count > 0 && run->events[count - 1].t > t) count--;
    return count;
}

static void carry_over(const struct run *main, struct fbd_state *state)
{
    const struct plan *plan = &main->model->plan;
    for (size_t i = 0; i < 2 * (size_t)plan->n; i++) state->y[i] += main->state->y[i] - main->y[i];
    memcpy(state->branch, main->state->branch, (size_t)plan->branches * sizeof *state->branch);
    memcpy(state->slip, main->state->slip, plan->friction_count * sizeof *state->slip);
    memcpy(state->pull, main->state->pull, plan->friction_count * sizeof *state->pull);
    state_evaluate(state);
}

bool companion_look(struct companion *companion, const struct run *main, double t, bool after_event,
                    struct fbd_state *state)
{
    struct run *own = companion->run;
    bool there = own->state->t == t && own->outcome != FBD_FAILED;
    if (there) {
        state_copy(state, own->state);
        state_evaluate(state);
    } else if (own->state->t < t) {
        if (!go_beyond(own, t, state)) return false;
    } else if (!(t >= own->from) || !run_look(own, t, state)) {
        return false;
    }
    if (after_event && events_until(own, t) < main->event_count) carry_over(main, state);
    return true;
}

/* ---- what is kept of the errors */

void companion_note(struct companion *companion, const struct run *main)
{
    size_t n = (size_t)companion->model->plan.n;
    for (size_t i = 0; i < 2 * n; i++)
        companion->scale[i] = fmax(companion->scale[i], fabs(main->state->y[i]));
}

double companion_next(const struct companion *companion, const struct run *main, double t)
{
    enum { samples = 200, most = 4 };
    double every = companion->run->options.until / samples, end = main->state->t, stride = 1;
    /* Methods that redo a step for each look into it. */
    if (main->options.method->implicit) stride = fmax(1, ceil((end - main->from) / (most * every)));
    double next = every * stride * (floor(t / (every * stride)) + 1);
    if (next > t && next < end) return next;
    return t < end && main->outcome != FBD_GOING ? end : HUGE_VAL;
}

/* Measured on motions without any other error (parabolas, sticking bodies), whose true errors are 1/2 to 8
 * eps of their size. */
double companion_floor(const struct companion *companion, size_t i)
{
    return 3 * DBL_EPSILON * companion->scale[i];
}

double companion_error(const struct companion *companion, size_t i, double main, double other)
{
    bool exact = main == 0 && other == 0; /* at rest, or sticking: known to be so */
    return exact ? 0 : fabs(main - other) + companion_floor(companion, i);
}

/* The companion's coordinates at t; false when there are none. At the end of the first run they are those of
 * companion_look, since it may have ended by an event. */
static bool coordinates(struct companion *companion, const struct run *main, double t, double *y)
{
    struct run *own = companion->run;
    if (t != main->state->t && own->state->t > t) return t >= own->from && run_coordinates(own, t, y);
    struct fbd_state *state = companion->probe;
    bool event = main->event_count > 0 && main->events[main->event_count - 1].t == t;
    if (!companion_look(companion, main, t, event, state)) return false;
    memcpy(y, state->y, 2 * (size_t)companion->model->plan.n * sizeof *y);
    return true;
}

void companion_lose(struct companion *companion, double t)
{
    companion->unknown_from = fmin(companion->unknown_from, t);
}

void companion_sample(struct companion *companion, struct run *main, double t)
{
    size_t n = (size_t)companion->model->plan.n;
    double *mine = companion->y, *other = mine + 2 * n;
    if (!run_coordinates(main, t, mine) || !coordinates(companion, main, t, other)) {
        companion_lose(companion, t);
        return;
    }
    for (size_t i = 0; i < 2 * n; i++) {
        double error = fabs(mine[i] - other[i]);
        companion->worst[i] = fmax(companion->worst[i], isfinite(error) ? error : HUGE_VAL);
    }
}

/* Sizes below which a component is not asked to be accurate for itself: a thousandth of its fellows of the
 * same body and kind (y of a body that moves along x), and for a rate what moves its coordinate by a
 * thousandth of its size in the whole run (a body in balance but for roundings). */
static double size_of(const struct companion *companion, size_t i)
{
    const double share = 1e-3;
    const struct scene *scene = companion->model->scene;
    size_t n = (size_t)companion->model->plan.n, q = i % n;
    const double *scale = companion->scale, *kind = scale + (i - q);
    double size = scale[i], duration = companion->run->options.until;
    for (size_t k = 0; k < n; k++)
        if (scene->coordinates[k].body == scene->coordinates[q].body &&
            scene->coordinates[k].angle == scene->coordinates[q].angle)
            size = fmax(size, share * kind[k]);
    return i >= n && duration > 0 ? fmax(size, share * scale[q] / duration) : size;
}

double companion_global(const struct companion *companion)
{
    size_t n = (size_t)companion->model->plan.n;
    double worst = 0;
    if (companion->unknown_from < HUGE_VAL) return HUGE_VAL;
    for (size_t i = 0; i < 2 * n; i++) {
        double size = size_of(companion, i), error = companion->worst[i] + companion_floor(companion, i);
        if (error > 0) worst = fmax(worst, error / size);
    }
    return worst;
}

/* ---- events */

static bool alike(const struct run_event *a, const struct run_event *b)
{
    return a->kind == b->kind && a->body == b->body && a->load == b->load && a->watch == b->watch;
}

/* The first event of `run` like this one, from `index` on; event_count when there is none. */
static size_t next_alike(const struct run *run, const struct run_event *event, size_t index)
{
    while (index < run->event_count && !alike(&run->events[index], event)) index++;
    return index;
}

/* The time of an event at the very end of a run is known to rounding; the other run may not have come to
 * it. */
static double error_at_the_end(const struct companion *companion, double t)
{
    const double near = 1e-9;
    double until = companion->run->options.until;
    return until - t <= near * until ? until - t + 4 * DBL_EPSILON * until : HUGE_VAL;
}

void companion_event_errors(const struct companion *companion, const struct run *main, double *errors)
{
    const struct run *own = companion->run;
    for (size_t i = 0; i < main->event_count; i++) errors[i] = NAN;
    for (size_t first = 0; first < main->event_count; first++) {
        if (!isnan(errors[first])) continue;
        /* All events like this one, in pairs. Where the partner is nearer to another event of the sequence,
         * the sequences differ, and from there on nothing is known. */
        size_t k = next_alike(own, &main->events[first], 0), next;
        double before = -HUGE_VAL;
        bool known = true;
        for (size_t i = first; i < main->event_count; i = next) {
            next = next_alike(main, &main->events[first], i + 1);
            double t = main->events[i].t, error = HUGE_VAL;
            double after = next < main->event_count ? main->events[next].t : HUGE_VAL;
            if (known && k < own->event_count)
                error = fabs(t - own->events[k].t) + 2 * DBL_EPSILON * t;
            else if (known)
                error = error_at_the_end(companion, t);
            double gap = fmin(t - before, after - t);
            if (gap > 0 && error > gap / 2 + 8 * DBL_EPSILON * t) known = false;
            errors[i] = known ? error : HUGE_VAL;
            if (k < own->event_count) k = next_alike(own, &main->events[first], k + 1);
            before = t;
        }
    }
}
