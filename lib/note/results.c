/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The results of a note: events, the state and the forces at the end, energy. Numbers are those of the JSON of the run.
 */
#include <math.h>
#include <string.h>

#include "base/format.h"
#include "base/number.h"
#include "note/note.h"

enum { most_events = 60, most_switches = 8 };

/* "4.2·10⁻¹⁵ m", "0", or "not known". */
static const char *error_of(struct making *making, double error, const char *unit)
{
    struct text *text = making_begin(making);
    const struct scaled_unit scaled = unit_for(unit, 1, making->options->degrees);
    if (!isfinite(error))
        text_add(text, "not known");
    else if (error == 0)
        text_add(text, "0");
    else {
        number_write(text, error / scaled.size, error_digits);
        text_printf(text, scaled.name[0] == '\xC2' ? "%s" : "\u00a0%s", scaled.name);
    }
    return making_take(making);
}

/* ---- events */

/* The detail of an event with units and powers of ten as elsewhere in the note: `8.9e-07 N*s` as 8.9·10⁻⁷ N·s. */
static const char *detail_of(struct making *making, const char *detail)
{
    struct text *text = making_begin(making);
    for (const char *c = detail; *c;) {
        const size_t length = number_length(c, strlen(c));
        const bool begins = c == detail || strchr(" +-(", c[-1]) != NULL;
        if (begins && length > 0 && memchr(c, 'e', length)) {
            number_write(text, number_value(c, length), note_digits);
            c += length;
        } else if (*c == '*') {
            text_add(text, "·");
            c++;
        } else {
            text_add_bytes(text, c++, 1);
        }
    }
    return making_take(making);
}

static void event_row(struct making *making, struct block *table, const fbd_event *event)
{
    struct document *document = making->document;
    char kind[40];
    format_into(kind, sizeof kind, "%s", fbd_event_kind_name(event->kind));
    for (char *c = kind; *c; c++)
        if (*c == '_') *c = ' ';
    document_cell(document, table, making_value(making, event->t, "s", note_digits + 3));
    document_cell(document, table, isnan(event->t_error) ? "" : error_of(making, event->t_error, "s"));
    document_cell(document, table, event->body[0] ? event->body : "–");
    if (event->kind == FBD_EVENT_USER)
        document_cell(document, table, event->name);
    else
        document_cell(document, table, kind);
    document_cell(document, table,
                  event->kind == FBD_EVENT_USER ? "event of the file" : detail_of(making, event->detail));
}

static void list_events(struct making *making)
{
    static const char *const heads[] = {"Time", "Error", "Body", "Event", "Detail"};
    struct document *document = making->document;
    const size_t count = fbd_simulation_event_count(making->simulation);
    size_t switches = 0, listed = 0, hidden = 0;
    for (size_t i = 0; i < count; i++)
        switches += fbd_simulation_event(making->simulation, i).kind == FBD_EVENT_SWITCH;
    document_heading(document, 3, "Events");
    if (count == 0) {
        document_paragraph(document, "No event occurs.");
        return;
    }
    struct block *table = document_table(document, "events", "rrllw", heads);
    for (size_t i = 0; i < count; i++) {
        const fbd_event event = fbd_simulation_event(making->simulation, i);
        if (event.kind == FBD_EVENT_SWITCH && switches > most_switches) continue;
        if (listed < most_events)
            event_row(making, table, &event), listed++;
        else
            hidden++;
    }
    if (hidden) document_paragraph(document, "%zu more events follow; fbd-run --json lists all.", hidden);
    if (switches > most_switches)
        document_paragraph(document, "Expressions pass from one branch to another at %zu further events.",
                           switches);
}

/* ---- the final state */

static void state_row(struct making *making, struct block *table, const char *name, const char *unit,
                      size_t place)
{
    struct document *document = making->document;
    double value = 0;
    const double error = making->errors ? making->errors[place] : NAN;
    fbd_state_get(making->end, name, &value);
    document_cell(document, table, making_symbol(making, name));
    document_cell(document, table, making_value(making, rounded_off(value, error, 0), unit, note_digits));
    document_cell(document, table, making->errors ? error_of(making, error, unit) : "not estimated");
}

static void list_final(struct making *making)
{
    static const char *const heads[] = {"Coordinate", "Value", "Error"};
    struct document *document = making->document;
    const size_t count = fbd_model_coordinate_count(making->model);
    document_heading(document, 3, "State at the end");
    struct block *table = document_table(document,
                                         arena_printf(&document->arena, "coordinates and rates at t = %s",
                                                      making_value(making, making->t, "s", note_digits)),
                                         "lrr", heads);
    for (size_t i = 0; i < count; i++) {
        const fbd_coordinate coordinate = fbd_model_coordinate(making->model, i);
        state_row(making, table, coordinate.name, coordinate.unit, i);
        state_row(making, table, coordinate.rate_name, coordinate.rate_unit, count + i);
    }
    for (size_t i = 0; i < fbd_model_state_count(making->model); i++) {
        const fbd_own_state state = fbd_model_state(making->model, i);
        state_row(making, table, state.name, state.unit, 2 * count + i);
    }
}

/* ---- forces */

static const char *with_error(struct making *making, double value, double error, double size, double unit)
{
    struct text *text = making_begin(making);
    number_write(text, rounded_off(value, error, size) / unit, force_digits);
    return making_take(making);
}

static void list_forces_on(struct making *making, size_t body)
{
    struct document *document = making->document;
    struct arena *arena = &document->arena;
    const fbd_units units = fbd_model_units(making->model);
    fbd_arrow *arrows;
    const size_t room = making_arrows(making, making->end, body, &arrows);
    fbd_arrow *errors = ARENA_ARRAY(arena, room + 1, fbd_arrow);
    double size = 0, couple_size = 0;
    if (!errors || room == 0) return;
    const bool bars = making->errors != NULL;
    if (bars && fbd_result_force_errors(making->result, body, errors, room) == 0) arena->failed = true;
    for (size_t i = 0; i < room; i++) {
        size = fmax(size, hypot(arrows[i].fx, arrows[i].fy));
        couple_size = fmax(couple_size, fabs(arrows[i].couple));
    }
    const struct scaled_unit force = unit_for(units.force, size, false),
                             couple = unit_for(units.moment, couple_size, false);
    const char *const heads[] = {"Force",
                                 arena_printf(arena, "Fx [%s]", force.name),
                                 arena_printf(arena, "Fy [%s]", force.name),
                                 arena_printf(arena, "Couple [%s]", couple.name),
                                 "Largest error",
                                 "Work"};
    struct block *table = document_table(document,
                                         arena_printf(arena, "forces on %s at the end",
                                                      fbd_model_body_name(making->model, body)),
                                         "lrrrrr", heads);
    for (size_t i = 0; i < room; i++) {
        const fbd_arrow *e = &errors[i], *arrow = &arrows[i];
        const double largest = bars ? fmax(e->fx, e->fy) : NAN,
                     work = fbd_result_work(making->result, fbd_model_body_name(making->model, body),
                                            arrow->name);
        document_cell(document, table, arrow->name);
        document_cell(document, table, with_error(making, arrow->fx, bars ? e->fx : NAN, size, force.size));
        document_cell(document, table, with_error(making, arrow->fy, bars ? e->fy : NAN, size, force.size));
        document_cell(document, table,
                      with_error(making, arrow->couple, bars ? e->couple : NAN, couple_size, couple.size));
        document_cell(document, table,
                      !bars                              ? "not estimated"
                      : arrow->fx == 0 && arrow->fy == 0 ? error_of(making, e->couple, units.moment)
                                                         : error_of(making, largest, units.force));
        document_cell(document, table,
                      isfinite(work) ? making_value(making, work, units.energy, force_digits) : "–");
    }
}

static void list_forces(struct making *making)
{
    const size_t count = fbd_model_body_count(making->model);
    document_heading(making->document, 3, "Forces at the end");
    document_paragraph(making->document,
                       "In the axes of the ground, with their work since the start; the work of a "
                       "reaction between two bodies is zero, or stands with the force of the file.");
    for (size_t b = 0; b < count && b < most_drawn_bodies; b++) list_forces_on(making, b);
    if (count > most_drawn_bodies)
        document_paragraph(making->document, "Those of %zu more bodies: fbd-run --json.",
                           count - most_drawn_bodies);
}

/* ---- energy */

static void energy_row(struct making *making, struct block *table, const char *name, double first,
                       double last, double error)
{
    const char *unit = fbd_model_units(making->model).energy;
    struct document *document = making->document;
    document_cell(document, table, name);
    document_cell(document, table, making_value(making, first, unit, note_digits));
    document_cell(document, table, making_value(making, rounded_off(last, error, 0), unit, note_digits));
    document_cell(document, table, isnan(error) ? "not estimated" : error_of(making, error, unit));
}

static void list_energy(struct making *making)
{
    static const char *const heads[] = {"Energy", "At the start", "At the end", "Error"};
    const fbd_energy energy = fbd_result_energy(making->result),
                     error = fbd_result_energy_error(making->result);
    document_heading(making->document, 3, "Energy");
    struct block *table =
        document_table(making->document, "energies, and the work of forces without a potential", "lrrr",
                       heads);
    energy_row(making, table, "kinetic", energy.initial_kinetic, energy.kinetic, error.kinetic);
    energy_row(making, table, "potential", energy.initial_potential, energy.potential, error.potential);
    if (isfinite(energy.work)) energy_row(making, table, "work of the others", 0, energy.work, error.work);
}

void note_results(struct making *making)
{
    document_heading(making->document, 2, "Results");
    if (making->errors)
        document_paragraph(making->document, "Errors are estimates, by comparison with a more accurate run.");
    list_events(making);
    list_final(making);
    list_forces(making);
    list_energy(making);
}
