/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * JSON: one object for a run (see docs/output.md for its contract).
 */

#include "dynamics/diagram.h"
#include "dynamics/mass.h"
#include "fbd_export.h"
#include "fbd_study.h"
#include "output/couplings.h"
#include "output/display_units.h"
#include "output/equations.h"
#include "output/words.h"
#include "output/world.h"
#include "record/result.h"

static void member(struct text *text, const char *name, double value, bool last)
{
    text_json_key(text, name);
    text_json_number(text, value);
    if (!last) text_add(text, ", ");
}

/* A file with the hash of its text. */
static void write_hashed(struct text *text, const char *file, const char *digits)
{
    text_add(text, "\"file\": ");
    text_json_string(text, file ? file : "");
    text_printf(text, ", \"sha256\": \"%s\"", digits);
}

/* Write the origin of the result: program, model file and data files with their hashes, values of the parameters. */
static void write_origin(struct text *text, const struct fbd_model *model)
{
    const struct scene *scene = model->scene;
    char digits[sha256_size];
    const char *between = "";
    sha256_text(model->source, model->source_length, digits);
    text_add(text, "  \"version\": \"" FBD_VERSION "\",\n  \"model\": {");
    write_hashed(text, scene->file, digits);
    text_add(text, ", \"data\": [");
    for (size_t i = 0; i < scene->table_count; i++) {
        const struct scene_table *table = &scene->tables[i];
        if (!table->path || !table->shared) continue;
        text_printf(text, "%s{\"table\": ", between);
        text_json_string(text, table->name);
        text_add(text, ", ");
        write_hashed(text, table->path, table->shared->sha256);
        text_add(text, "}");
        between = ", ";
    }
    text_add(text, "]},\n  \"parameters\": {");
    for (size_t i = 0; i < scene->parameter_count; i++)
        member(text, scene->parameters[i].name,
               scene->parameters[i].call.function ? (double)NAN : scene->parameters[i].value,
               i + 1 == scene->parameter_count);
    text_add(text, "},\n");
}

static const char *outcome_name(fbd_outcome outcome)
{
    switch (outcome) {
    case FBD_GOING: return "going";
    case FBD_DONE: return "done";
    case FBD_STOPPED: return "stopped";
    case FBD_BROKEN: return "broken";
    case FBD_FAILED: return "failed";
    case FBD_OUT_OF_MEMORY: return "out of memory";
    case FBD_INTERRUPTED: return "interrupted";
    }
    return "";
}

/* Component i of y in display units, or its error bar. */
static void component(struct text *text, const fbd_result *result, const struct fbd_state *state,
                      struct bars *bars, size_t i, const char *name, bool last)
{
    const double value = bars ? bars_component(bars, state, i) : state->y[i];
    member(text, name, value / display_of_component(state->model, i, result->degrees).size, last);
}

/* Write the coordinates and rates of each body, then the user states; or their error bars. */
static void write_components(struct text *text, const fbd_result *result, const struct fbd_state *state,
                             struct bars *bars, const char *before)
{
    const struct fbd_model *model = state->model;
    const size_t own = plan_own_place(&model->plan);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        text_add(text, b ? ",\n    " : before);
        text_json_key(text, body->name);
        text_add(text, "{");
        for (int k = 0; k < 2 * body->count; k++) {
            const bool rate = k >= body->count;
            const int i = k % body->count, place = (rate ? body->first_rate : body->first) + i;
            const struct coordinate *c = &model->scene->coordinates[body->first + i];
            component(text, result, state, bars, (size_t)place, rate ? c->rate_name : c->name,
                      k + 1 == 2 * body->count);
        }
        text_add(text, "}");
    }
    if (model->plan.own == 0) return;
    text_add(text, ",\n    ");
    text_json_key(text, "states");
    text_add(text, "{");
    for (int i = 0; i < model->plan.own; i++)
        component(text, result, state, bars, own + (size_t)i, model->scene->own[i].name,
                  i + 1 == model->plan.own);
    text_add(text, "}");
}

static void write_final(struct text *text, const fbd_result *result, const struct fbd_state *state)
{
    text_add(text, "  \"final\": {");
    member(text, "t", state->t, true);
    write_components(text, result, state, NULL, ",\n    ");
    text_add(text, "\n  },\n");
}

/* Write the points under `output` of the file. */
static void write_points(struct text *text, const struct fbd_model *model, const struct fbd_state *state)
{
    const struct scene *scene = model->scene;
    if (scene->output_point_count == 0) return;
    text_add(text, "  \"points\": {");
    for (size_t i = 0; i < scene->output_point_count; i++) {
        double values[world_parts];
        world_values(state, scene->output_points[i].body, model->output_points[i], values);
        text_add(text, i ? ",\n    " : "\n    ");
        text_json_key(text, scene->output_points[i].name);
        text_add(text, "{");
        for (int part = 0; part < world_parts; part++)
            member(text, world_part_name((enum world_part)part), values[part], part + 1 == world_parts);
        text_add(text, "}");
    }
    text_add(text, "\n  },\n");
}

/* As `final`, without the time. */
static void write_final_errors(struct text *text, const fbd_result *result)
{
    const fbd_simulation *simulation = result->simulation;
    if (!simulation->bars) return;
    text_add(text, "  \"final_error\": {");
    write_components(text, result, ensemble_state(simulation->ensemble), simulation->bars, "\n    ");
    text_add(text, "\n  },\n");
}

/* Behind a literal. */
static inline void number_behind(struct text *text, const char *literal, double value)
{
    text_literal(text, literal);
    text_json_number(text, value);
}

static inline void string_behind(struct text *text, const char *literal, const char *value)
{
    text_literal(text, literal);
    text_json_string(text, value);
}

/* Write each of its velocities before and after. */
static void write_impact(struct text *text, const struct impact_record *impact)
{
    number_behind(text, ", \"normal_impulse\": ", impact->p);
    number_behind(text, ", \"friction_impulse\": ", impact->tau);
    number_behind(text, ", \"work\": ", impact->work);
    number_behind(text, ", \"normal_velocity\": [", impact->v_n[0]);
    number_behind(text, ", ", impact->v_n[1]);
    number_behind(text, "], \"tangential_velocity\": [", impact->v_t[0]);
    number_behind(text, ", ", impact->v_t[1]);
    text_literal(text, "]");
}

static bool is_impact(fbd_event_kind kind)
{
    return kind == FBD_EVENT_IMPACT || kind == FBD_EVENT_JAM || kind == FBD_EVENT_ROPE_TAUT ||
           kind == FBD_EVENT_LANDING;
}

static void write_events(struct text *text, const fbd_simulation *simulation)
{
    const struct ensemble *run = simulation->ensemble;
    text_add(text, "  \"events\": [");
    for (size_t i = 0; i < run->event_count; i++) {
        const struct run_event *event = &run->events[i];
        char detail[event_detail_size];
        event_detail(run->model, event, detail, sizeof detail);
        number_behind(text, i ? ",\n    {\"t\": " : "\n    {\"t\": ", event->t);
        if (simulation->bars) number_behind(text, ", \"t_error\": ", simulation->event_errors[i]);
        string_behind(text, ", \"body\": ", event_body(run->model, event));
        string_behind(text, ", \"kind\": ", fbd_event_kind_name(event->kind));
        string_behind(text, ", \"name\": ", event_name(run->model, event));
        if (is_impact(event->kind)) write_impact(text, &event->impact);
        if (event->kind == FBD_EVENT_REST) number_behind(text, ", \"impacts\": ", event->limit);
        string_behind(text, ", \"detail\": ", detail);
        text_literal(text, "}");
    }
    text_add(text, run->event_count ? "\n  ],\n" : "],\n");
}

/* The friction of a rolling body or of a slot with an arrow of this name; NULL for any other force. */
static const struct coupling *rolling_friction(const struct fbd_model *model, int body, const char *name)
{
    for (int i = 0; i < model->tree->coupling_count; i++) {
        const struct coupling *coupling = &model->tree->couplings[i];
        const bool rubs = coupling->kind == constraint_roll || coupling->kind == constraint_groove;
        for (int k = 0; rubs && k < coupling->end_count; k++)
            if (coupling->end[k].body == body && coupling->end[k].name[1] == name) return coupling;
    }
    return NULL;
}

/* Write whether friction sticks, and its limit. */
static void write_friction(struct text *text, struct fbd_state *state, int body, const struct arrow *arrow)
{
    const struct fbd_model *model = state->model;
    const struct coupling *coupling = rolling_friction(model, body, arrow->name);
    int own = model->bodies[body].friction, pair = coupling ? coupling->pair : own;
    if (coupling && pair < 0) text_add(text, ", \"mode\": \"stick\""); /* it never slips */
    if (pair < 0 || (!coupling && arrow->load != model->plan.modes[own].load)) return;
    struct instant at = state_instant(state);
    state_balance_of(state, body, state->scratch);
    struct friction_values values = friction_at(model, pair, &at, state->scratch);
    text_printf(text, ", \"mode\": \"%s\", ", state->slip[pair] == stick ? "stick" : "slip");
    double share = fabs(values.force) / values.limit; /* not finite if the limit is almost zero */
    member(text, "limit", values.limit, false);
    member(text, "utilisation", isfinite(share) ? share : NAN, false);
    member(text, "margin", isfinite(share) ? share : NAN, true); /* deprecated alias */
}

/* `other` is the same arrow of the companion; the work is that of load `account`. */
static void write_force_error(struct text *text, struct bars *bars, const struct model_body *body,
                              const struct arrow *arrow, const struct arrow *other, double moment,
                              int account, double work)
{
    const struct instant other_at = state_instant(bars->state);
    double other_moment = arrow_moment(other, moment_center(body, &other_at));
    text_add(text, ", \"error\": {");
    member(text, "fx", bars_difference(bars, arrow->force.x, other->force.x), false);
    member(text, "fy", bars_difference(bars, arrow->force.y, other->force.y), false);
    member(text, "moment", bars_difference(bars, moment, other_moment), false);
    member(text, "power", bars_difference(bars, arrow->power, other->power), false);
    member(text, "work", account >= 0 ? bars_work(bars, (size_t)account, work) : 0, true);
    text_add(text, "}");
}

static void write_body_forces(struct text *text, fbd_result *result, struct fbd_state *state, int b)
{
    struct ledger *ledger = &result->ledger;
    const struct fbd_model *model = ledger->model;
    const struct model_body *body = &model->bodies[b];
    struct bars *bars = result->simulation->bars;
    struct instant at = state_instant(state);
    struct vec about = moment_center(body, &at);
    struct pose pose = body_pose(body, &at);
    size_t count = diagram_fill(model, b, &at, state->slots, ledger->arrows);
    const struct arrow *others = bars ? bars_diagram(bars, b) : NULL;
    for (size_t i = 0; i < count; i++) {
        const struct arrow *arrow = &ledger->arrows[i];
        double moment = arrow_moment(arrow, about);
        int account = diagram_account(model, b, ledger->arrows, i);
        double work = account >= 0 ? ledger_work(ledger, state, (size_t)account, ledger->work) : 0;
        text_add(text, i ? ",\n      " : "\n      ");
        text_json_key(text, arrow->name);
        text_add(text, "{");
        member(text, "fx", arrow->force.x, false);
        member(text, "fy", arrow->force.y, false);
        member(text, "x", arrow->point.x, false);
        member(text, "y", arrow->point.y, false);
        member(text, "moment", moment, false);
        member(text, "moment_G", arrow_moment(arrow, point_motion(body, &pose, body->inertia.G).p), false);
        member(text, "moment_O", arrow_moment(arrow, pose.origin), false);
        member(text, "power", arrow->power, false);
        member(text, "work", work, true);
        write_friction(text, state, b, arrow);
        if (bars) write_force_error(text, bars, body, arrow, &others[i], moment, account, work);
        text_add(text, "}");
    }
    if (body->carried >= 0) {
        text_add(text, count > 0 ? ",\n      \"mass\": {" : "\n      \"mass\": {");
        static const char *const none[] = {"fx", "fy", "moment", "moment_G", "moment_O"};
        for (int i = 0; i < 5; i++) member(text, none[i], 0, false);
        member(text, "x", point_motion(body, &pose, body->inertia.G).p.x, false);
        member(text, "y", point_motion(body, &pose, body->inertia.G).p.y, false);
        member(text, "power", body_carried_power(model, body, &at), false);
        member(text, "work", ledger_work(ledger, state, (size_t)body->carried, ledger->work), true);
        text_add(text, "}");
    }
    if (count > 0 || body->carried >= 0) text_add(text, "\n    ");
}

static void write_forces(struct text *text, fbd_result *result, struct fbd_state *state)
{
    const struct fbd_model *model = result->ledger.model;
    text_add(text, "  \"forces\": {");
    for (size_t b = 0; b < model->body_count; b++) {
        text_add(text, b ? ",\n    " : "\n    ");
        text_json_key(text, model->bodies[b].name);
        text_add(text, "{");
        write_body_forces(text, result, state, (int)b);
        text_add(text, "}");
    }
    text_add(text, "\n  },\n");
}

/* Newton and Euler for each jointed body: the sums of its diagram beside m a and I alpha. */
static void write_balances(struct text *text, fbd_result *result, struct fbd_state *state)
{
    const struct fbd_model *model = result->ledger.model;
    struct instant at = state_instant(state);
    bool first = true;
    if (!tree_joins(model->tree)) return;
    text_add(text, "  \"balance\": {");
    for (size_t b = 0; b < model->body_count; b++) {
        if (model->bodies[b].alone) continue;
        size_t count = diagram_fill(model, (int)b, &at, state->slots, result->ledger.arrows);
        struct balance balance = balance_of(&model->bodies[b], &at, result->ledger.arrows, count);
        text_add(text, first ? "\n    " : ",\n    ");
        first = false;
        text_json_key(text, model->bodies[b].name);
        text_add(text, "{");
        member(text, "fx", balance.force.x, false);
        member(text, "fy", balance.force.y, false);
        member(text, "moment_G", balance.moment, false);
        member(text, "m_ax", balance.m_a.x, false);
        member(text, "m_ay", balance.m_a.y, false);
        member(text, "I_alpha", balance.I_alpha, false);
        member(text, "residual", balance.residual, true);
        text_add(text, "}");
    }
    text_add(text, "\n  },\n");
}

static void write_energy(struct text *text, fbd_result *result)
{
    fbd_energy energy = fbd_result_energy(result);
    text_add(text, "  \"energy\": {");
    member(text, "kinetic", energy.kinetic, false);
    member(text, "potential", energy.potential, false);
    member(text, "work", energy.work, false);
    member(text, "residual", energy.residual, false);
    double explained = fbd_result_residual_explained(result); /* infinite for steps of fixed size */
    if (isfinite(explained)) member(text, "residual_explained", explained, false);
    member(text, "initial_kinetic", energy.initial_kinetic, false);
    member(text, "initial_potential", energy.initial_potential, true);
    text_add(text, "},\n");
    if (!result->simulation->bars) return;
    fbd_energy error = fbd_result_energy_error(result);
    text_add(text, "  \"energy_error\": {");
    member(text, "kinetic", error.kinetic, false);
    member(text, "potential", error.potential, false);
    member(text, "work", error.work, false);
    member(text, "residual", error.residual, true);
    text_add(text, "},\n");
}

static void write_stats(struct text *text, const fbd_simulation *simulation)
{
    fbd_stats stats = fbd_simulation_stats(simulation);
    text_add(text, "  \"stats\": {\"method\": ");
    text_json_string(text, stats.method);
    text_add(text, ", ");
    member(text, "tolerance", stats.tolerance, false);
    text_printf(text,
                "\"steps\": %lu, \"rejected\": %lu, \"rhs\": %lu, \"jacobians\": %lu, \"events\": %lu, "
                "\"stiff_steps\": %lu, ",
                stats.steps, stats.rejected, stats.rhs, stats.jacobians, stats.events, stats.stiff_steps);
    text_printf(text, "\"groups\": %zu, \"constant\": %zu, \"linear\": %zu, \"velocity_free\": %zu, ",
                stats.groups, stats.constant, stats.linear, stats.velocity_free);
    member(text, "seconds", stats.seconds, false);
    member(text, "error_estimate", stats.error_estimate, true);
    if (simulation->bars) {
        text_printf(text, ", \"companion_steps\": %lu, \"companion_rhs\": %lu, \"runs\": %lu, ",
                    stats.companion_steps, stats.companion_rhs, stats.runs);
        member(text, "seconds_spent", stats.seconds_spent, true);
    }
    if (stats.accuracy > 0) {
        text_add(text, ", ");
        member(text, "accuracy", stats.accuracy, true);
    }
    text_add(text, "}\n");
}

char *fbd_result_json(fbd_result *result)
{
    if (!result) return NULL;
    fbd_simulation *simulation = result->simulation;
    struct ensemble *run = simulation->ensemble;
    struct fbd_state *end = ensemble_state(run);
    const struct fbd_model *model = run->model;
    struct text text = {0};
    text_add(&text, "{\n  \"title\": ");
    text_json_string(&text, model->scene->title);
    text_printf(&text, ",\n  \"units\": \"%s\",\n%s  \"outcome\": \"%s\",\n  \"reason\": ",
                model->scene->units == unit_si ? "SI" : "US",
                result->degrees ? "  \"angles\": \"deg\",\n" : "", outcome_name(run->outcome));
    text_json_string(&text, run->reason);
    text_add(&text, ",\n");
    write_origin(&text, model);
    state_ready(end);
    write_final(&text, result, end);
    write_points(&text, model, end);
    write_final_errors(&text, result);
    write_events(&text, simulation);
    write_forces(&text, result, end);
    write_balances(&text, result, end);
    write_energy(&text, result);
    couplings_json(&text, result);
    write_stats(&text, simulation);
    text_add(&text, "}\n");
    if (text.failed) text_free(&text);
    return text.data;
}
