/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "loop/companion.h"
#include "numeric/tolerances.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

/* ---- allocation */

/* The method of the companion, unless it switches. */
static const struct method *method_for(const struct fbd_model *model)
{
    return structure_method(model, structure_general);
}

/* Does the main run choose its steps as the companion does? */
static bool is_like(const struct fbd_model *model, const struct run_options *options)
{
    return options->step == 0 && (options->automatic || options->method == method_for(model));
}

/* The tolerance of the companion. A fifth of the tolerance, and so of the error, costs a method of order 8 a
 * quarter more steps. Other methods may have smaller errors at the same tolerance, and most cost more; errors
 * of bsimp hardly depend on the tolerance. At large tolerances errors are not proportional to them. Where
 * rounding is the limit, only the different step sizes matter: they give independent rounding. */
static double tolerance_for(const struct fbd_model *model, const struct run_options *options)
{
    const double fixed = negligible_part, least = evaluation_rounding, other = 4e-14, most = 2e-6;
    if (options->step > 0) return fixed;
    double share = is_like(model, options) ? 0.2 : 0.02;
    if (options->method->implicit && options->method->order > method_for(model)->order) return fixed;
    if (options->tolerance < 2 * least) return other;
    return fmin(fmax(share * options->tolerance, least), most);
}

static double sample_interval(const struct companion *companion)
{
    enum { samples = 500 };
    return fmax(companion->ensemble->options.until / samples, DBL_TRUE_MIN); /* a run may be that short */
}

struct companion *companion_new(const struct fbd_model *model, const struct run_options *options)
{
    struct companion *companion = calloc(1, sizeof *companion);
    size_t size = plan_size(&model->plan);
    struct run_options own = {.until = options->until,
                              .tolerance = tolerance_for(model, options),
                              .method = method_for(model),
                              .automatic = true,
                              .structure = options->structure,
                              .apart = true};
    if (!companion) return NULL;
    companion->model = model;
    companion->follows = is_like(model, options);
    companion->ensemble = ensemble_new(model, &own);
    companion->probe = state_new(model);
    companion->scale = calloc(4 * size + 1, sizeof *companion->scale);
    companion->unknown_from = HUGE_VAL;
    if (!companion->ensemble || !companion->scale || !companion->probe) {
        companion_free(companion);
        return NULL;
    }
    companion->worst = companion->scale + size;
    companion->y = companion->scale + 2 * size;
    companion->next = options->until > 0 ? sample_interval(companion) : HUGE_VAL;
    const double *start = ensemble_state(companion->ensemble)->y;
    for (size_t i = 0; i < size; i++) companion->scale[i] = fabs(start[i]);
    return companion;
}

void companion_free(struct companion *companion)
{
    if (!companion) return;
    ensemble_free(companion->ensemble);
    state_free(companion->probe);
    free(companion->scale);
    free(companion);
}

/* ---- stepping */

/* A method of order 8 makes steps of 0.82 of the length at a fifth of the tolerance, but not in a run of few
 * steps: the first is a guess, they grow by a limited factor, and the last is the remaining time. Steps of
 * equal length have equal errors, which cancel in the difference; so those of the companion are limited to
 * that ratio. A companion that is behind by more than a step of the main run catches up in a few. */
static void keep_apart(struct companion *companion, const struct ensemble *main, double t)
{
    const double share = 0.8, least = 0.25;
    double way = t - companion->ensemble->t;
    for (size_t p = 0; p < main->count; p++) {
        const struct run *run = main->groups[p].run;
        struct run *own = companion->ensemble->groups[p].run;
        bool limited = companion->follows && !run_is_exact(run);
        own->step.most = limited ? fmax(share * (run->state->t - run->step.from), least * way) : 0;
    }
}

bool companion_go(struct companion *companion, const struct ensemble *main, double t)
{
    struct ensemble *own = companion->ensemble;
    if (own->t >= t) return own->outcome != FBD_OUT_OF_MEMORY;
    keep_apart(companion, main, t);
    ensemble_go(own, t, 0, false);
    return own->outcome != FBD_OUT_OF_MEMORY;
}

/* The companion ended before t, by an event that comes a little later in the main run: extrapolate, q + v s +
 * a s^2 / 2. */
static bool go_beyond(struct ensemble *own, double t, struct fbd_state *state)
{
    const double most = 0.1; /* of the elapsed time */
    size_t n = (size_t)own->model->plan.n;
    double s = t - own->t;
    if (own->outcome == FBD_FAILED || own->outcome == FBD_OUT_OF_MEMORY || own->outcome == FBD_INTERRUPTED ||
        !(s <= most * t))
        return false;
    if (!ensemble_look(own, own->t, state)) return false;
    for (size_t i = 0; i < n; i++) {
        state->y[i] += s * (state->y[n + i] + s / 2 * state->a[i]);
        state->y[n + i] += s * state->a[i];
    }
    for (size_t i = 0; i < (size_t)own->model->plan.own; i++) state->y[2 * n + i] += s * state->a[n + i];
    state_set_moment(state, time_dd_at(t));
    state_evaluate(state);
    return true;
}

/* The number of events of a run up to and including the time t. */
static size_t events_until(const struct run *run, double t)
{
    size_t count = run->log.count;
    while (count > 0 && run->log.events[count - 1].t > t) count--;
    return count;
}

static void carry_over(const struct companion *companion, const struct ensemble *main, double t,
                       struct fbd_state *state)
{
    bool carried = false;
    for (size_t p = 0; p < main->count; p++) {
        const struct run *run = main->groups[p].run, *own = companion->ensemble->groups[p].run;
        bool event = run->state->t == t && run->log.count > 0 && run->log.events[run->log.count - 1].t == t;
        if (!event || events_until(own, t) >= run->log.count) continue;
        ensemble_pass_on(main, p, state);
        carried = true;
    }
    if (carried) state_evaluate(state);
}

bool companion_look(struct companion *companion, const struct ensemble *main, double t, bool after_event,
                    struct fbd_state *state)
{
    struct ensemble *own = companion->ensemble;
    bool there = own->t >= t && (own->t > t || own->outcome != FBD_FAILED);
    if (!(there ? ensemble_look(own, t, state) : go_beyond(own, t, state))) return false;
    if (after_event) carry_over(companion, main, t, state);
    return true;
}

/* ---- accumulated errors */

/* Update the sizes of the components up to t. */
static void note_sizes(struct companion *companion, const struct ensemble *main, const double *y)
{
    size_t size = plan_size(&companion->model->plan);
    for (size_t i = 0; i < size; i++) companion->scale[i] = fmax(companion->scale[i], fabs(y[i]));
    for (size_t p = 0; p < main->count; p++) {
        const struct group *group = &main->groups[p];
        size_t own = plan_size(&group->model->plan);
        const double *most = group->run->recent.anchor + own;
        for (size_t i = 0; i < own; i++) {
            double *scale = &companion->scale[group_component(companion->model, group, i)];
            *scale = fmax(*scale, most[i]);
        }
    }
}

/* Number of sample intervals until the next sample: at least four samples in a step where possible, and not
 * many more. A method may have to repeat a step for each dense output, which would dominate a run of a few
 * long steps; measured: with one or two samples in a step the largest error is too low. Steps of an exact
 * method are sampled at their ends only. The next step may be short, so the sample is not beyond its begin. */
static long stride(const struct companion *companion, const struct ensemble *main, double t)
{
    enum { least = 4 };
    double every = sample_interval(companion), shortest = HUGE_VAL, end = HUGE_VAL;
    for (size_t p = 0; p < main->count; p++) {
        const struct run *run = main->groups[p].run;
        bool looked_into = run->state->t > run->step.from && !run_is_exact(run);
        if (!looked_into) continue;
        shortest = fmin(shortest, run->state->t - run->step.from);
        end = fmin(end, run->state->t);
    }
    double longest = main->options.until / every, here = fmin(shortest / least, end - t + every);
    return (long)fmax(1, floor(fmin(here / every, longest)));
}

static void plan_next(struct companion *companion, const struct ensemble *main, double t)
{
    double every = sample_interval(companion);
    if (t != companion->next) return;
    companion->samples += stride(companion, main, t);
    companion->next = every * (double)(companion->samples + 1);
    if (companion->next > main->options.until) companion->next = HUGE_VAL;
}

/* Measured on motions without any other error (parabolas, sticking bodies), whose true errors are 1/2 to 8
 * eps of their size. */
static double floor_of(double size)
{
    return round_off(3, size);
}

double companion_error(const struct companion *companion, size_t i, double main, double other)
{
    bool exact = main == 0 && other == 0; /* at rest, or sticking */
    return exact ? 0 : fabs(main - other) + floor_of(fmax(companion->scale[i], fabs(main)));
}

/* The companion's coordinates at t; false when there are none. At an event, and at the end of the main run,
 * they are those of companion_look, since it may have ended by an event. */
static bool coordinates(struct companion *companion, const struct ensemble *main, double t, double *y)
{
    struct ensemble *own = companion->ensemble;
    bool event = main->t == t && main->event_count > 0 && main->events[main->event_count - 1].t == t;
    if (!event && own->t >= t && own->outcome != FBD_FAILED) return ensemble_coordinates(own, t, y);
    struct fbd_state *state = companion->probe;
    if (!companion_look(companion, main, t, event, state)) return false;
    memcpy(y, state->y, plan_size(&companion->model->plan) * sizeof *y);
    return true;
}

void companion_lose(struct companion *companion, double t)
{
    companion->unknown_from = fmin(companion->unknown_from, t);
}

void companion_sample(struct companion *companion, struct ensemble *main, double t)
{
    size_t size = plan_size(&companion->model->plan);
    double *mine = companion->y, *other = mine + size;
    if (ensemble_coordinates(main, t, mine)) {
        note_sizes(companion, main, mine);
        bool known = coordinates(companion, main, t, other);
        if (!known) companion_lose(companion, t);
        for (size_t i = 0; known && i < size; i++) {
            double error = fabs(mine[i] - other[i]);
            companion->worst[i] = fmax(companion->worst[i], isfinite(error) ? error : HUGE_VAL);
        }
    }
    plan_next(companion, main, t);
}

/* Lower bounds of the size of a component: a thousandth of the other components of the same body and kind (y
 * of a body that moves along x), and for a rate the value that moves its coordinate by a thousandth of its
 * size in the whole run (a body in equilibrium but for rounding). */
static double size_of(const struct companion *companion, size_t i)
{
    const double share = 1e-3;
    const struct scene *scene = companion->model->scene;
    size_t n = (size_t)companion->model->plan.n, q = i % n;
    const double *scale = companion->scale, *kind = scale + (i - q);
    double size = scale[i], duration = companion->ensemble->options.until;
    if (i >= 2 * n) return size; /* a user state */
    for (size_t k = 0; k < n; k++)
        if (scene->coordinates[k].body == scene->coordinates[q].body &&
            scene->coordinates[k].angle == scene->coordinates[q].angle)
            size = fmax(size, share * kind[k]);
    return i >= n && duration > 0 ? fmax(size, share * scale[q] / duration) : size;
}

double companion_global(const struct companion *companion)
{
    size_t count = plan_size(&companion->model->plan);
    double worst = 0;
    if (companion->unknown_from < HUGE_VAL) return HUGE_VAL;
    for (size_t i = 0; i < count; i++) {
        double size = size_of(companion, i), error = companion->worst[i] + floor_of(companion->scale[i]);
        if (error > 0) worst = fmax(worst, error / size);
    }
    return worst;
}

/* ---- events */

/* Has an island of the main run had more events than that of the companion? */
static bool lacks_events(const struct ensemble *own, const struct ensemble *main)
{
    for (size_t p = 0; p < main->count; p++)
        if (events_until(own->groups[p].run, own->t) < events_until(main->groups[p].run, main->t))
            return true;
    return false;
}

bool companion_come_to_events(struct companion *companion, const struct ensemble *main)
{
    const double most = 1.1; /* a later event is a different one */
    struct ensemble *own = companion->ensemble;
    double limit = most * main->t;
    for (size_t p = 0; p < own->count; p++) own->groups[p].run->step.most = 0;
    while (own->outcome == FBD_GOING && own->t < limit && lacks_events(own, main))
        ensemble_go(own, limit, 0, true);
    return own->outcome != FBD_OUT_OF_MEMORY;
}

/* Index of the first event of `run` like this one, from `index` on; event_count when there is none. */
static size_t next_alike(const struct ensemble *run, const struct run_event *event, size_t index)
{
    while (index < run->event_count && !events_are_alike(&run->events[index], event)) index++;
    return index;
}

/* The time of an event at the very end of a run is exact to rounding; the other run may end before it. */
static double error_at_the_end(const struct companion *companion, double t)
{
    double until = companion->ensemble->options.until;
    return until - t <= undecided_part * until ? until - t + round_off(4, until) : HUGE_VAL;
}

void companion_event_errors(const struct companion *companion, const struct ensemble *main, double *errors)
{
    const struct ensemble *own = companion->ensemble;
    for (size_t i = 0; i < main->event_count; i++) errors[i] = NAN;
    for (size_t first = 0; first < main->event_count; first++) {
        if (!isnan(errors[first])) continue;
        /* Pair all events like this one. Where the partner is nearer to another event of the sequence, the
         * sequences differ, and there is no estimate from there on. */
        size_t k = next_alike(own, &main->events[first], 0), next;
        double before = -HUGE_VAL;
        bool known = true;
        for (size_t i = first; i < main->event_count; i = next) {
            next = next_alike(main, &main->events[first], i + 1);
            double t = main->events[i].t, error = HUGE_VAL;
            double after = next < main->event_count ? main->events[next].t : HUGE_VAL;
            if (known && k < own->event_count)
                error = fabs(t - own->events[k].t) + round_off(2, t);
            else if (known)
                error = error_at_the_end(companion, t);
            double gap = fmin(t - before, after - t);
            if (gap > 0 && error > gap / 2 + round_off(8, t)) known = false;
            errors[i] = known ? error + main->events[i].delay : HUGE_VAL;
            if (k < own->event_count) k = next_alike(own, &main->events[first], k + 1);
            before = t;
        }
    }
}
