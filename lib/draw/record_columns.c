/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The columns of a record, and the numbers of one row: both in the same order.
 */
#include "draw/record.h"
#include "dynamics/tree.h"
#include "output/equations.h"

/* ---- definitions */

static int define(struct record *record, enum record_kind kind, int body, const char *name, const char *unit)
{
    if (!name) record->failed = true;
    record->columns[record->column_count] = (struct record_column){.name = name,
                                                                   .unit = unit,
                                                                   .kind = kind,
                                                                   .body = body,
                                                                   .is_constant = true,
                                                                   .least = HUGE_VAL,
                                                                   .greatest = -HUGE_VAL};
    return (int)record->column_count++;
}

static const char *name_of(struct record *record, const struct model_body *body, const char *name,
                           const char *suffix)
{
    return arena_printf(&record->arena, "%s.%s%s", body->name, name, suffix);
}

static void define_motion(struct record *record, int b)
{
    const struct fbd_model *model = record->model;
    const struct model_body *body = &model->bodies[b];
    struct record_of_body *columns = &record->bodies[b];
    const struct label *labels = model->labels + body->first;
    columns->coordinate = (int)record->column_count;
    for (int k = 0; k < body->count; k++)
        define(record, record_coordinate, b, labels[k].name, labels[k].unit);
    columns->rate = (int)record->column_count;
    for (int k = 0; k < body->count; k++)
        define(record, record_rate, b, labels[k].rate_name, labels[k].rate_unit);
    columns->acceleration = (int)record->column_count;
    for (int k = 0; k < body->count; k++)
        define(record, record_acceleration, b, name_of(record, body, labels[k].acceleration_name, ""),
               labels[k].acceleration_unit);
    columns->pose = define(record, record_pose, b, name_of(record, body, "frame", ".x"), length_unit(model));
    define(record, record_pose, b, name_of(record, body, "frame", ".y"), length_unit(model));
    define(record, record_pose, b, name_of(record, body, "frame", ".angle"), "rad");
    const char *speed = model->scene->units == unit_si ? "m/s" : "ft/s";
    define(record, record_rate, b, name_of(record, body, "G", ".vx"), speed);
    define(record, record_rate, b, name_of(record, body, "G", ".vy"), speed);
}

static bool is_jointed(const struct model_body *body)
{
    return body->place.link > 0;
}

/* What the equations of a jointed body have beside its forces (output/equations_tree.c). */
static void define_newton(struct record *record, int b)
{
    const struct fbd_model *model = record->model;
    const struct model_body *body = &model->bodies[b];
    struct record_of_body *columns = &record->bodies[b];
    const char *linear = model->scene->units == unit_si ? "m/s^2" : "ft/s^2";
    columns->newton = columns->moving_axis = -1;
    if (!is_jointed(body)) return;
    columns->newton = define(record, record_acceleration, b, name_of(record, body, "a_Gx", ""), linear);
    define(record, record_acceleration, b, name_of(record, body, "a_Gy", ""), linear);
    define(record, record_acceleration, b, name_of(record, body, "alpha", ""), "rad/s^2");
    bool track = body->kind == motion_track;
    if (body->kind == motion_slide || track)
        define(record, record_acceleration, b, name_of(record, body, track ? "a_s" : "a_x", ""), linear);
    if (tree_has_more(body))
        columns->moving_axis =
            define(record, record_term, b, name_of(record, body, track ? "turning_along" : "moving_axis", ""),
                   track ? force_unit(model) : moment_unit(model));
}

/* The columns that the CSV has for a force: see docs/output.md. */
static void define_force(struct record *record, int b, struct record_of_arrow *arrow)
{
    const struct model_body *body = &record->model->bodies[b];
    const char *force = force_unit(record->model), *moment = moment_unit(record->model);
    arrow->force = (int)record->column_count;
    if (!is_jointed(body) && body->count == 1 && arrow->load >= 0) {
        define(record, record_force, b, name_of(record, body, arrow->name, ""),
               body->kind == motion_pivot ? moment : force);
    } else {
        define(record, record_force, b, name_of(record, body, arrow->name, ".x"), force);
        define(record, record_force, b, name_of(record, body, arrow->name, ".y"), force);
        if (is_jointed(body) || body->kind == motion_planar)
            define(record, record_force, b, name_of(record, body, arrow->name, ".moment"), moment);
    }
    arrow->force_count = (int)record->column_count - arrow->force;
}

/* Reactions stand in the equations of jointed bodies: some are those of others. */
static bool has_term(const struct model_body *body, int load)
{
    return load >= 0 || is_jointed(body);
}

static void define_arrow(struct record *record, int b, size_t index, struct record_of_arrow *arrow)
{
    static const char *const parts[] = {".fx", ".fy", ".px", ".py", ".couple"};
    const struct model_body *body = &record->model->bodies[b];
    define_force(record, b, arrow);
    arrow->arrow = (int)record->column_count;
    for (int i = 0; i < 5; i++)
        define(record, record_arrow, b, name_of(record, body, arrow->name, parts[i]), "");
    arrow->term = arrow->work = -1;
    if (has_term(body, arrow->load)) {
        arrow->term = (int)record->column_count;
        for (int k = 0; k < body->count; k++)
            define(record, record_term, b, name_of(record, body, arrow->name, ".term"), "");
    }
    if (index < (size_t)body->load_count)
        arrow->work = define(record, record_work, b, name_of(record, body, arrow->name, ".work"),
                             energy_unit(record->model));
}

static bool define_arrows(struct record *record, int b, struct fbd_state *state)
{
    const struct fbd_model *model = record->model;
    struct record_of_body *columns = &record->bodies[b];
    struct instant at = state_instant(state);
    columns->arrow_count = diagram_fill(model, b, &at, state->a, state->slots, record->arrows);
    columns->arrows = ARENA_ARRAY(&record->arena, columns->arrow_count, struct record_of_arrow);
    for (size_t i = 0; columns->arrows && i < columns->arrow_count; i++) {
        columns->arrows[i].name = record->arrows[i].name;
        columns->arrows[i].load = record->arrows[i].load;
        define_arrow(record, b, i, &columns->arrows[i]);
    }
    return columns->arrows != NULL || columns->arrow_count == 0;
}

bool record_define(struct record *record, struct fbd_state *start)
{
    const struct fbd_model *model = record->model;
    size_t most = 4 + (size_t)model->plan.own;
    for (size_t b = 0; b < model->body_count; b++) most += 20 + 13 * diagram_arrows(model, (int)b);
    record->columns = ARENA_ARRAY(&record->arena, most, struct record_column);
    record->bodies = ARENA_ARRAY(&record->arena, model->body_count, struct record_of_body);
    if (!record->columns || !record->bodies) return false;
    for (size_t b = 0; b < model->body_count; b++) {
        define_motion(record, (int)b);
        define_newton(record, (int)b);
        if (!define_arrows(record, (int)b, start)) return false;
    }
    const char *energy = energy_unit(model);
    record->energy = define(record, record_energy, -1, "energy.kinetic", energy);
    define(record, record_energy, -1, "energy.potential", energy);
    define(record, record_energy, -1, "energy.work", energy);
    define(record, record_energy, -1, "energy.residual", energy);
    for (int i = 0; i < model->plan.own; i++)
        define(record, record_own, -1, model->own_labels[i].name, model->own_labels[i].unit);
    return !record->failed && !record->arena.failed;
}

/* ---- one row */

static double *fill_motion(double *out, const struct model_body *body, const struct fbd_state *state,
                           const struct instant *at, const struct pose *pose)
{
    for (int k = 0; k < body->count; k++) *out++ = state->y[body->first + k];
    for (int k = 0; k < body->count; k++) *out++ = state->y[body->first_rate + k];
    for (int k = 0; k < body->count; k++)
        *out++ = is_jointed(body) ? state->a[body->first + k] : equation_acceleration(body, state, k);
    *out++ = pose->origin.x;
    *out++ = pose->origin.y;
    *out++ = body_angle(body, at);
    struct vec v = point_motion(body, pose, body->inertia.G).v;
    *out++ = v.x;
    *out++ = v.y;
    return out;
}

static double *fill_newton(double *out, const struct model_body *body, const struct instant *at)
{
    if (!is_jointed(body)) return out;
    const struct tree_state *link = &at->tree->links[body->place.link];
    struct vec a = tree_mass_center_acceleration(body, at);
    *out++ = a.x;
    *out++ = a.y;
    *out++ = tree_angular_acceleration(body, at);
    if (body->kind == motion_slide || body->kind == motion_track) *out++ = vec_dot(link->e, a);
    if (tree_has_more(body)) *out++ = tree_more(body, at);
    return out;
}

/* The columns of define_force. */
static double *fill_force(double *out, const struct model_body *body, const struct load *source,
                          const struct arrow *arrow, struct vec G)
{
    if (!is_jointed(body) && body->count == 1 && source) {
        *out++ = source->kind == load_normal ? vec_dot(arrow->force, body->n) : arrow->share[0];
        return out;
    }
    *out++ = arrow->force.x;
    *out++ = arrow->force.y;
    if (is_jointed(body))
        *out++ = arrow_moment(arrow, G);
    else if (body->kind == motion_planar)
        *out++ = arrow->share[2];
    return out;
}

static double *fill_arrow(struct record *record, double *out, const struct model_body *body,
                          const struct fbd_state *state, const struct pose *pose, size_t index, bool energies)
{
    const struct arrow *arrow = &record->arrows[index];
    const struct load *source = arrow->load >= 0 ? record->model->loads[arrow->load].source : NULL;
    struct vec G = point_motion(body, pose, body->inertia.G).p;
    out = fill_force(out, body, source, arrow, G);
    struct vec arm = vec_sub(arrow->point, pose->origin), r = pose->rotation;
    *out++ = arrow->force.x;
    *out++ = arrow->force.y;
    *out++ = vec_dot(arm, r);
    *out++ = vec_dot(arm, vec_perp(r));
    *out++ = arrow->couple;
    if (has_term(body, arrow->load))
        for (int k = 0; k < body->count; k++)
            *out++ = is_jointed(body) ? arrow->share[k] : equation_term(body, arrow, k, G);
    if (index < (size_t)body->load_count)
        *out++ = energies ? ledger_work(record->ledger, state, (size_t)arrow->load, record->work) : NAN;
    return out;
}

void record_fill(struct record *record, struct fbd_state *state, bool energies)
{
    const struct fbd_model *model = record->model;
    struct instant at = state_instant(state);
    double *out = record->values;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct pose pose = body_pose(body, &at);
        out = fill_motion(out, body, state, &at, &pose);
        out = fill_newton(out, body, &at);
        size_t count = diagram_fill(model, (int)b, &at, state->a, state->slots, record->arrows);
        for (size_t i = 0; i < count; i++) out = fill_arrow(record, out, body, state, &pose, i, energies);
    }
    fbd_energy energy = {NAN, NAN, NAN, NAN, NAN, NAN};
    if (energies) energy = ledger_energy(record->ledger, state, record->work);
    *out++ = energy.kinetic;
    *out++ = energy.potential;
    *out++ = energy.work;
    *out++ = energy.residual;
    for (int i = 0; i < model->plan.own; i++) *out++ = state->y[2 * model->plan.n + i];
}
