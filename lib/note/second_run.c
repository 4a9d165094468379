/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The run once more, by a method of another family and at a hundredth of the tolerance, without the structure of the
 * forces: it shares no step with the first one. Where the first run was stiff, the second one is made by `rodas5p`
 * throughout, since an explicit method would not come to the end. A budget of steps ends a run that takes far longer.
 */
#include <math.h>
#include <string.h>

#include "note/note.h"

enum { free_steps = 20000, steps_per_step = 100, kinds = FBD_EVENT_FORCE_BEGINS + 1 };

static const double tightening = 100, least_tolerance = 1e-13;

static const char *other_method(const struct making *making)
{
    if (making->stats.stiff_steps > 0 && strcmp(making->stats.method, "rodas5p") != 0) return "rodas5p";
    const bool usual =
        strcmp(making->stats.method, "dop853") != 0 && fbd_model_state_count(making->model) == 0;
    return usual ? "dop853" : "rk8pd";
}

/* Beyond the end by a millionth where an event ended the first run, so that it ends the second one too. */
static double end_time(const struct making *making)
{
    const double margin = 1e-6;
    return fbd_result_outcome(making->result) == FBD_DONE ? making->t
                                                          : making->t + margin * fabs(making->t) + 1e-9;
}

/* ---- comparison */

/* The largest magnitude of a coordinate or rate in the rows of the first run. */
static double magnitude(const struct making *making, const char *name)
{
    const fbd_table *table = &making->table;
    double largest = 0;
    for (size_t c = 0; c < table->columns; c++) {
        if (strcmp(table->heads[c].name, name) != 0) continue;
        const bool degrees = strncmp(table->heads[c].unit, "deg", 3) == 0;
        for (size_t r = 0; r < table->rows; r++)
            largest = fmax(largest, fabs(table->values[r * table->columns + c]));
        return degrees ? largest * 3.14159265358979323846 / 180 : largest;
    }
    return largest;
}

static void compare(struct making *making, struct second_run *second, fbd_state *other, const char *name,
                    double floor)
{
    double a = 0, b = 0;
    fbd_state_get(making->end, name, &a);
    fbd_state_get(other, name, &b);
    const double size = fmax(magnitude(making, name), floor),
                 difference = size > 0 ? fabs(a - b) / size : fabs(a - b);
    if (isfinite(second->difference) && difference <= second->difference) return;
    second->difference = difference;
    second->worst = name;
}

/* The size of a quantity counts as at least a thousandth of the largest one of its unit. */
static double floor_of(const struct making *making, const char *unit, bool rate)
{
    double largest = 0;
    for (size_t i = 0; i < fbd_model_coordinate_count(making->model); i++) {
        const fbd_coordinate c = fbd_model_coordinate(making->model, i);
        if (strcmp(rate ? c.rate_unit : c.unit, unit) == 0)
            largest = fmax(largest, magnitude(making, rate ? c.rate_name : c.name));
    }
    return 1e-3 * largest;
}

static void compare_states(struct making *making, struct second_run *second, fbd_state *other)
{
    for (size_t i = 0; i < fbd_model_coordinate_count(making->model); i++) {
        const fbd_coordinate c = fbd_model_coordinate(making->model, i);
        compare(making, second, other, c.name, floor_of(making, c.unit, false));
        compare(making, second, other, c.rate_name, floor_of(making, c.rate_unit, true));
    }
}

/* Branches of expressions are no events of the motion: one method may see a switch that another one passes. */
static bool counts(fbd_event_kind kind)
{
    return kind != FBD_EVENT_SWITCH && kind != FBD_EVENT_SLIDING && kind != FBD_EVENT_SLIDING_ENDS;
}

/* The next event that counts, from `index`. */
static bool next_event(fbd_simulation *simulation, size_t *index, fbd_event *event)
{
    while (*index < fbd_simulation_event_count(simulation)) {
        *event = fbd_simulation_event(simulation, (*index)++);
        if (counts(event->kind)) return true;
    }
    return false;
}

/* Events at one time may be listed in another order, so each kind is counted. */
static void compare_events(struct making *making, struct second_run *second, fbd_simulation *other)
{
    long balance[kinds] = {0};
    size_t a = 0, b = 0;
    fbd_event first, again;
    double largest = NAN;
    for (;;) {
        const bool more = next_event(making->simulation, &a, &first), also = next_event(other, &b, &again);
        if (more) balance[first.kind]++;
        if (also) balance[again.kind]--;
        if (more && also) largest = fmax(largest, fabs(first.t - again.t));
        if (!more && !also) break;
    }
    second->same_events = true;
    for (int kind = 0; kind < kinds; kind++) second->same_events = second->same_events && balance[kind] == 0;
    second->event_difference = second->same_events ? largest : NAN;
}

/* ---- the run */

/* Advance to the end; false when the caller ended it. */
static bool advance(struct making *making, struct second_run *second, fbd_simulation *simulation)
{
    const unsigned long most = free_steps + steps_per_step * making->stats.steps;
    fbd_outcome outcome = FBD_GOING;
    double from = 0, to = 0;
    while (outcome == FBD_GOING) {
        const fbd_progress progress = {"run", .share = to / fmax(making->t, 1e-300), .t = to,
                                       .until = making->t};
        const fbd_note_options *options = making->options;
        if (options->progress && options->progress(options->progress_context, &progress) != 0) return false;
        outcome = fbd_simulation_advance(simulation);
        fbd_simulation_interval(simulation, &from, &to);
        if (fbd_simulation_stats(simulation).steps <= most) continue;
        second->reason = arena_printf(&making->document->arena, "it takes more than %lu steps", most);
        return true;
    }
    if (outcome == FBD_OUT_OF_MEMORY) making->document->arena.failed = true;
    if (outcome == FBD_FAILED)
        second->reason = arena_printf(&making->document->arena, "%s", fbd_simulation_reason(simulation));
    return true;
}

static void compare_runs(struct making *making, struct second_run *second, fbd_simulation *simulation)
{
    double from, to;
    fbd_state *other = fbd_state_new(making->model);
    fbd_simulation_interval(simulation, &from, &to);
    if (other && fbd_simulation_state(simulation, to, other))
        compare_states(making, second, other);
    else
        making->document->arena.failed = true;
    compare_events(making, second, simulation);
    fbd_state_free(other);
}

bool second_run(struct making *making, struct second_run *second)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    *second = (struct second_run){.method = other_method(making),
                                  .tolerance = fmax(making->stats.tolerance / tightening, least_tolerance),
                                  .difference = NAN};
    options.method = second->method;
    options.tolerance = second->tolerance;
    options.until = end_time(making);
    options.no_structure = options.automatic_step = true;
    fbd_errors *others = fbd_errors_new();
    fbd_simulation *simulation = others ? fbd_simulation_new(making->model, &options, others) : NULL;
    bool going = true;
    if (simulation)
        going = advance(making, second, simulation);
    else if (others)
        second->reason = arena_printf(&making->document->arena, "%s", fbd_errors_get(others, 0).message);
    if (simulation && going && !second->reason) compare_runs(making, second, simulation);
    fbd_simulation_free(simulation);
    making_end_list(making, others);
    return going && !making->document->arena.failed;
}
