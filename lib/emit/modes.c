/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The functions of a scene for the run: projection onto its modes, arguments of switches and events, and
 * tables of names.
 */
#include "emit/bodies.h"
#include "emit/live.h"

static void close_text(struct emitter *emitter, struct text *lines)
{
    emitter->arena.failed = emitter->arena.failed || lines->failed;
    text_free(lines);
}

struct emit_origin drive_origin(const struct emitter *emitter, const struct mode *mode)
{
    const struct model_body *body = &emitter->model->bodies[mode->body];
    const struct coordinate *coordinate = &emitter->model->scene->coordinates[body->first];
    return (struct emit_origin){body->source->motion.at, coordinate->name, coordinate->dim, -1};
}

/* ---- velocities of sticking and driven coordinates */

static void write_complete(struct emitter *emitter)
{
    struct text lines = {0};
    if (emit_has_places(emitter)) text_add(&lines, "    write_places(s, t, y);\n");
    emit_function(&emitter->rest, "/* The state with all that is a function of it. */\nstatic void complete",
                  "const struct scene *s, double t, double *y", &lines);
    close_text(emitter, &lines);
}

static void write_hold(struct emitter *emitter)
{
    const struct plan *plan = &emitter->model->plan;
    struct text lines = {0};
    text_add(&lines, "    complete(s, t, y);\n");
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = mode_of(emitter, pair);
        const char *q = emitter->coordinate[mode->coordinate], *v = emitter->rate[mode->coordinate];
        if (mode->kind == mode_drive && mode->position.expr) {
            const char *owner = emitter->load[mode->load];
            const char *motion = emit_slope(emitter, &mode->position, emit_join(emitter, owner, "position"),
                                            0, drive_origin(emitter, mode));
            text_printf(&lines, "    y[%s] = %s.v;\n", q, motion);
        }
        text_printf(&lines, "    if (s->slip[%s] == 0) y[%s] = surface_speed(s, t, y, %s);\n",
                    emitter->pair[pair], v, emitter->pair[pair]);
    }
    if (plan->mode_count > 0) text_add(&lines, "    complete(s, t, y);\n");
    emit_function(&emitter->rest,
                  "/* Pairs that stick have the velocity of their surface, exactly. */\nstatic void hold",
                  "const struct scene *s, double t, double *y", &lines);
    close_text(emitter, &lines);
}

/* ---- switches */

static const char *watched_value(struct emitter *emitter, const struct emit_switch *watched)
{
    const char *a = watched->a, *b = watched->b;
    const char *u = a;
    unsigned op = watched->instr->op;
    if (op_is_by_difference(op)) u = emit_printf(emitter, "(%s) - (%s)", a, b);
    if (op_is_by_quotient(op)) u = emit_printf(emitter, "(%s)/(%s)", a, b);
    if (op == op_square) u = emit_printf(emitter, "2*(%s)", a);
    return watched->condition ? emit_printf(emitter, "%s ? %s : NAN", watched->condition, u) : u;
}

static const char *switch_kind(unsigned op)
{
    if (op == op_relay) return "by_relay";
    if (op_is_by_sign(op)) return "by_sign";
    if (op == op_levels) return "by_level";
    return op == op_ceil ? "by_ceil" : op == op_round ? "by_round" : "by_floor";
}

/* The branch of a switch at equality. */
static int branch_at_zero(unsigned op)
{
    if (op == op_sign || op == op_equal) return 0;
    return op == op_max || op == op_less_equal || op == op_greater ? -1 : 1;
}

static void write_switches(struct emitter *emitter)
{
    const struct plan *plan = &emitter->model->plan;
    struct text lines = {0}, kinds = {0}, zeros = {0};
    text_add(&lines, "    switch (k) {\n");
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct kink *kink = &plan->kinks[i];
        struct emit_switch *watched = ARENA_ARRAY(&emitter->arena, kink->count, struct emit_switch);
        if (!watched ||
            !emit_switches(emitter, emit_live(emitter, kink->formula.expr), kink->formula.branch, watched))
            break;
        for (size_t k = 0; k < kink->count; k++) {
            const char *name = emitter->branch[(size_t)kink->formula.branch + k];
            unsigned op = watched[k].instr->op;
            text_printf(&lines, "    case %s: return %s;\n", name, watched_value(emitter, &watched[k]));
            text_printf(&kinds, "    [%s] = %s,\n", name, switch_kind(op));
            text_printf(&zeros, "    [%s] = %d,\n", name, branch_at_zero(op));
        }
    }
    text_add(&lines, "    default: return 1;\n    }\n");
    struct text *out = &emitter->rest;
    text_printf(out,
                "enum { by_sign, by_floor, by_ceil, by_round, by_level, by_relay };\n"
                "enum { most_levels = %d };\n"
                "static const int switch_kind[branches] = {\n%s};\n"
                "static const int branch_at_zero[branches] = {\n%s};\n\n",
                most_levels, kinds.data ? kinds.data : "    0\n", zeros.data ? zeros.data : "    0\n");
    emit_function(out,
                  "/* The function that a switch watches; NAN in the side of an `if` that is not taken. "
                  "*/\nstatic double watched",
                  "const struct scene *s, double t, const double *y, int k", &lines);
    close_text(emitter, &lines);
    close_text(emitter, &kinds);
    close_text(emitter, &zeros);
}

/* ---- events of the file */

static void quote(struct text *text, const char *words)
{
    text_add(text, "\"");
    emit_comment(text, words); /* comment rules suffice: names are letters, digits and _ */
    text_add(text, "\"");
}

static void write_events(struct emitter *emitter)
{
    const struct plan *plan = &emitter->model->plan;
    struct text lines = {0}, names = {0}, directions = {0}, stops = {0}, *out = &emitter->rest;
    text_add(&lines, "    switch (k) {\n");
    for (size_t k = 0; k < plan->watch_count; k++) {
        const struct watch *watch = &plan->watches[k];
        const char *owner = emit_join(emitter, "event", watch->source->name);
        struct emit_origin origin = {watch->source->at, "when", expr_dim(watch->source->left), -1};
        emit_live_event(emitter, watch->source);
        const char *left = emit_formula(emitter, &watch->left, emit_join(emitter, owner, "left"), origin);
        const char *right = watch->source->right ? emit_formula(emitter, &watch->right,
                                                                emit_join(emitter, owner, "right"), origin)
                                                 : "0";
        text_printf(&lines, "    case %zu: return %s - %s;\n", k, left, right);
        text_add(&names, k ? ", " : "");
        quote(&names, watch->source->name);
        text_printf(&directions, "%s%d", k ? ", " : "", watch->source->direction);
        text_printf(&stops, "%s%d", k ? ", " : "", watch->source->stop ? 1 : 0);
    }
    text_add(&lines, "    default: return 1;\n    }\n");
    text_printf(out, "static const char *const event_name[events] = {%s};\n",
                names.data ? names.data : "\"\"");
    text_printf(out, "static const int event_direction[events] = {%s}; /* 1 rising, -1 falling, 0 both */\n",
                directions.data ? directions.data : "0");
    text_printf(out, "static const int event_stops[events] = {%s};\n\n", stops.data ? stops.data : "0");
    emit_function(out, "/* An event happens where this passes zero. */\nstatic double event_value",
                  "const struct scene *s, double t, const double *y, int k", &lines);
    close_text(emitter, &lines);
    close_text(emitter, &names);
    close_text(emitter, &directions);
    close_text(emitter, &stops);
}

/* ---- tables of pairs and surfaces */

static void write_table(struct emitter *emitter, const char *name, const char *value(struct emitter *, int))
{
    text_printf(&emitter->rest, "static const int %s[pairs] = {", name);
    for (int pair = 0; pair < (int)emitter->model->plan.mode_count; pair++)
        text_printf(&emitter->rest, "%s, ", value(emitter, pair));
    text_add(&emitter->rest, "};\n");
}

static const char *pair_coordinate(struct emitter *emitter, int pair)
{
    return emitter->coordinate[mode_of(emitter, pair)->coordinate];
}

static const char *pair_normal(struct emitter *emitter, int pair)
{
    int slot = mode_of(emitter, pair)->normal_slot;
    return slot < 0 ? "-1" : emitter->slot[slot];
}

static const char *pair_hold(struct emitter *emitter, int pair)
{
    const struct mode *mode = mode_of(emitter, pair);
    return emitter->slot[mode->kind == mode_single ? mode->coordinate : mode->hold_slot];
}

static const char *pair_drive(struct emitter *emitter, int pair)
{
    return mode_of(emitter, pair)->kind == mode_drive ? "1" : "0";
}

static const char *pair_guide(struct emitter *emitter, int pair)
{
    return mode_of(emitter, pair)->two_sided ? "1" : "0";
}

static void write_pairs(struct emitter *emitter)
{
    const struct plan *plan = &emitter->model->plan;
    struct text *out = &emitter->rest;
    write_table(emitter, "coordinate_of", pair_coordinate);
    write_table(emitter, "normal_of", pair_normal);
    write_table(emitter, "hold_of", pair_hold);
    write_table(emitter, "is_drive", pair_drive);
    write_table(emitter, "is_guide", pair_guide);
    text_add(out, "static const char *const pair_name[pairs] = {");
    for (size_t i = 0; i < plan->mode_count; i++) {
        quote(out, emitter->model->bodies[plan->modes[i].body].name);
        text_add(out, ", ");
    }
    text_add(out, "};\n\n");
}

/* Write the table of one-sided surfaces, and the tolerance of negative normal forces. */
static void write_surfaces(struct emitter *emitter)
{
    const struct plan *plan = &emitter->model->plan;
    struct text *out = &emitter->rest;
    text_add(out, "static const int surface_of[surfaces] = {");
    double most = 0;
    for (size_t i = 0; i < plan->contact_count; i++) {
        text_printf(out, "%s, ", emitter->slot[plan->contacts[i].slot]);
        most = fmax(most, emitter->model->bodies[plan->contacts[i].body].inertia.mass);
    }
    text_printf(out, "};\nstatic const double press_slack = %s;\n\n",
                emit_number(emitter, 1e-13 * most * vec_norm(emitter->model->scene->gravity)));
}

void emit_modes(struct emitter *emitter)
{
    const struct plan *plan = &emitter->model->plan;
    write_complete(emitter);
    if (emit_watches(emitter) == 0) return;
    write_hold(emitter);
    if (plan->mode_count > 0) write_pairs(emitter);
    if (plan->contact_count > 0) write_surfaces(emitter);
    if (plan->branches > 0) write_switches(emitter);
    if (plan->watch_count > 0) write_events(emitter);
}

int emit_watches(const struct emitter *emitter)
{
    const struct plan *plan = &emitter->model->plan;
    return (int)(2 * plan->mode_count + plan->contact_count + plan->watch_count) + plan->branches;
}
