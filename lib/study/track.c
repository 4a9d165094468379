/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/track.h"

#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "fbd_view.h"
#include "study/stopwatch.h"

fbd_options setting_options(const struct setting *setting, double until)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = setting->method;
    options.tolerance = setting->tolerance;
    options.step = setting->step;
    options.until = until;
    options.automatic_step = setting->automatic;
    return options;
}

size_t quantity_count(const fbd_model *model)
{
    return 2 * fbd_model_coordinate_count(model) + fbd_model_state_count(model);
}

double grid_time(const struct grid *grid, size_t index)
{
    if (index + 1 == grid->count) return grid->until;
    return grid->until * ((double)index / (double)(grid->count - 1));
}

bool track_ended(const struct track *track)
{
    return track->outcome == FBD_DONE || track->outcome == FBD_STOPPED;
}

/* Store the quantities of a state; `packed` is scratch of size + 1 numbers. */
static void store(const struct track *track, const fbd_state *state, double *packed, double *quantities)
{
    fbd_state_pack(state, packed, track->size + 1); /* the time, then the quantities */
    memcpy(quantities, packed + 1, track->size * sizeof *quantities);
}

/* Where a run is sampled. */
struct sampling {
    fbd_simulation *simulation;
    const struct grid *grid;
    fbd_state *state;
    double *packed; /* scratch */
};

/* Sample the grid times in the last step. */
static bool look(struct track *track, const struct sampling *sampling)
{
    fbd_simulation *simulation = sampling->simulation;
    const struct grid *grid = sampling->grid;
    double from, to;
    fbd_simulation_interval(simulation, &from, &to);
    for (; track->reached < grid->count; track->reached++) {
        double t = grid_time(grid, track->reached);
        if (t > to) break;
        if (!fbd_simulation_state(simulation, t, sampling->state)) return false;
        store(track, sampling->state, sampling->packed, track->y + track->reached * track->size);
    }
    return true;
}

static bool run_through(struct track *track, const struct sampling *sampling, double most_seconds)
{
    enum { steps_between_looks_at_the_clock = 64 };
    struct stopwatch watch = stopwatch_start();
    bool seen = look(track, sampling);
    for (unsigned long step = 1; seen; step++) {
        track->outcome = fbd_simulation_advance(sampling->simulation);
        seen = look(track, sampling);
        if (track->outcome != FBD_GOING) break;
        if (step % steps_between_looks_at_the_clock == 0 && stopwatch_seconds(&watch) > most_seconds) break;
    }
    track->seconds = stopwatch_seconds(&watch);
    return seen;
}

static bool keep_events(struct track *track, fbd_simulation *simulation, struct arena *arena)
{
    track->event_count = fbd_simulation_event_count(simulation);
    track->events = ARENA_ARRAY(arena, track->event_count + 1, struct track_event);
    if (!track->events) return false;
    for (size_t i = 0; i < track->event_count; i++) {
        fbd_event event = fbd_simulation_event(simulation, i);
        track->events[i] = (struct track_event){event.t, event.kind, event.body, event.name};
    }
    return true;
}

static bool make(struct track *track, fbd_simulation *simulation, const struct grid *grid, fbd_state *state,
                 double most_seconds, struct arena *arena)
{
    track->y = ARENA_ARRAY(arena, grid->count * track->size + 1, double);
    track->end = ARENA_ARRAY(arena, track->size + 1, double);
    double *packed = ARENA_ARRAY(arena, track->size + 1, double);
    if (!track->y || !track->end || !packed) return false;
    const struct sampling sampling = {simulation, grid, state, packed};
    bool seen = run_through(track, &sampling, most_seconds);
    double from, to;
    fbd_simulation_interval(simulation, &from, &to);
    track->t_end = to;
    if (fbd_simulation_state(simulation, to, state)) store(track, state, packed, track->end);
    const char *reason = fbd_simulation_reason(simulation);
    if (!seen && !reason[0]) reason = "the dense output of a step cannot be had";
    if (!seen) /* a simulation that has ended returns its outcome again */
        track->outcome =
            fbd_simulation_advance(simulation) == FBD_OUT_OF_MEMORY ? FBD_OUT_OF_MEMORY : FBD_FAILED;
    track->reason = arena_text(arena, reason, strlen(reason));
    track->stats = fbd_simulation_stats(simulation);
    return track->outcome != FBD_OUT_OF_MEMORY && track->reason && keep_events(track, simulation, arena);
}

bool track_make(struct track *track, const fbd_model *model, const struct setting *setting,
                const struct grid *grid, double most_seconds, struct arena *arena, fbd_errors *errors)
{
    fbd_options options = setting_options(setting, grid->until);
    *track = (struct track){.size = quantity_count(model)};
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    if (!simulation) return false;
    fbd_state *state = fbd_state_new(model);
    bool done = state && make(track, simulation, grid, state, most_seconds, arena);
    fbd_state_free(state);
    fbd_simulation_free(simulation);
    if (!done) diag_out_of_memory(errors);
    return done;
}

double tracks_differ(const struct track *a, const struct track *b, const double *scale, size_t first,
                     size_t count, size_t *worst)
{
    double largest = 0;
    for (size_t k = first; k < count; k++) {
        for (size_t i = 0; i < a->size; i++) {
            if (!(scale[i] > 0)) continue;
            double difference = fabs(a->y[k * a->size + i] - b->y[k * a->size + i]) / scale[i];
            if (difference <= largest) continue;
            largest = difference;
            if (worst) *worst = i;
            if (isnan(difference)) return difference;
        }
    }
    return largest;
}
