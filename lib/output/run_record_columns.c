/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The columns of a record, and the numbers of one row: both in the same order.
 */
#include "dynamics/mass.h"
#include "dynamics/tree.h"
#include "output/equations.h"
#include "output/force_columns.h"
#include "output/run_record.h"
#include "output/words.h"

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

/* Define the columns of a body's equations that are neither forces nor accelerations of coordinates
 * (output/equations.c). */
static void define_equations(struct record *record, int b)
{
    static const char *const of_center[] = {"a_Gx", "a_Gy", "alpha"};
    static const char *const of_world[] = {"ax", "ay", "alpha"};
    const struct fbd_model *model = record->model;
    const struct model_body *body = &model->bodies[b];
    const struct label *labels = model->labels + body->first;
    struct record_of_body *columns = &record->bodies[b];
    const char *linear = model->scene->units == unit_si ? "m/s^2" : "ft/s^2";
    bool off_center = body->kind == motion_planar && body->parent == ground_body;
    columns->equation = columns->acceleration;
    columns->mass = -1;
    columns->moving_axis = -1;
    if (!equation_has_coordinate(body)) columns->equation = (int)record->column_count;
    for (int k = 0; k < body->count && k < most_coordinates_of_a_body && !equation_has_coordinate(body); k++)
        define(record, record_acceleration, b,
               name_of(record, body, off_center ? of_center[k] : equation_acceleration_name(model, body, k),
                       ""),
               labels[k].acceleration_unit);
    columns->newton = (int)record->column_count;
    for (int k = 0; k < 3; k++)
        define(record, record_acceleration, b, name_of(record, body, "G.", of_world[k]),
               k == 2 ? "rad/s^2" : linear);
    bool track = body->kind == motion_track;
    if (tree_has_more(body))
        columns->moving_axis =
            define(record, record_term, b, name_of(record, body, track ? "turning_along" : "moving_axis", ""),
                   track ? force_unit(model) : moment_unit(model));
    if (body->varies)
        columns->mass = define(record, record_term, b, name_of(record, body, "m", ""),
                               model->scene->units == unit_si ? "kg" : "slug");
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
    define_equations(record, b);
    columns->pose = define(record, record_pose, b, name_of(record, body, "frame", ".x"), length_unit(model));
    define(record, record_pose, b, name_of(record, body, "frame", ".y"), length_unit(model));
    define(record, record_pose, b, name_of(record, body, "frame", ".angle"), "rad");
    const char *speed = model->scene->units == unit_si ? "m/s" : "ft/s";
    define(record, record_rate, b, name_of(record, body, "G", ".vx"), speed);
    define(record, record_rate, b, name_of(record, body, "G", ".vy"), speed);
}

/* Define the columns of a force and its components; the first `force_count` of them are those of the CSV. */
static void define_force(struct record *record, int b, const struct arrow *source,
                         struct record_of_arrow *arrow)
{
    const struct fbd_model *model = record->model;
    enum force_part parts[force_parts];
    arrow->force = (int)record->column_count;
    arrow->force_count = (int)force_columns(model, b, source, record->components, parts);
    size_t count = force_columns(model, b, source, true, parts);
    for (size_t k = 0; k < count; k++) {
        const char *part = force_part_name(parts[k]);
        int column = define(record, record_force, b,
                            name_of(record, &model->bodies[b], arrow->name,
                                    part[0] ? arena_printf(&record->arena, ".%s", part) : ""),
                            force_part_unit(model, b, parts[k]));
        if (parts[k] == force_x) arrow->components = column;
    }
}

/* False for reactions of the body's joint, which are not terms of its coordinates' equations. */
static bool has_term(const struct fbd_model *model, int b, const struct arrow *arrow)
{
    return arrow->load >= 0 || !arrow_is_of_joint(model, b, arrow);
}

static void define_arrow(struct record *record, int b, size_t index, struct record_of_arrow *arrow)
{
    static const char *const parts[] = {".fx", ".fy", ".px", ".py", ".couple"};
    const struct model_body *body = &record->model->bodies[b];
    define_force(record, b, &record->arrows[index], arrow);
    arrow->arrow = (int)record->column_count;
    for (int i = 0; i < 5; i++)
        define(record, record_arrow, b, name_of(record, body, arrow->name, parts[i]), "");
    arrow->term = arrow->work = -1;
    if (has_term(record->model, b, &record->arrows[index])) {
        arrow->term = (int)record->column_count;
        for (int k = 0; k < body->count; k++)
            define(record, record_term, b, name_of(record, body, arrow->name, ".term"), "");
    }
    if (diagram_work_column(record->model, b, record->arrows, index) >= 0)
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
    for (size_t b = 0; b < model->body_count; b++) most += 25 + 14 * diagram_arrows(model, (int)b);
    record->columns = ARENA_ARRAY(&record->arena, most, struct record_column);
    record->bodies = ARENA_ARRAY(&record->arena, model->body_count, struct record_of_body);
    if (!record->columns || !record->bodies) return false;
    for (size_t b = 0; b < model->body_count; b++) {
        define_motion(record, (int)b);
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

/* Fill the columns of define_equations. */
static double *fill_equations(double *out, const struct record_of_body *columns,
                              const struct model_body *body, const struct instant *at, const double *a)
{
    if (columns->equation != columns->acceleration)
        for (int k = 0; k < body->count; k++) *out++ = equation_acceleration(body, at, a, k);
    struct vec a_G = mass_center_acceleration(body, at, a);
    *out++ = a_G.x;
    *out++ = a_G.y;
    *out++ = body_angular_acceleration(body, at, a);
    if (columns->moving_axis >= 0) *out++ = tree_more(body, at);
    if (columns->mass >= 0) *out++ = body_mass(body, at);
    return out;
}

static double *fill_motion(double *out, const struct record_of_body *columns, const struct model_body *body,
                           const struct fbd_state *state, const struct instant *at, const struct pose *pose)
{
    for (int k = 0; k < body->count; k++) *out++ = state->y[body->first + k];
    for (int k = 0; k < body->count; k++) *out++ = state->y[body->first_rate + k];
    for (int k = 0; k < body->count; k++) *out++ = state->a[body->first + k];
    out = fill_equations(out, columns, body, at, state->a);
    *out++ = pose->origin.x;
    *out++ = pose->origin.y;
    *out++ = body_angle(body, at);
    struct vec v = point_motion(body, pose, body->inertia.G).v;
    *out++ = v.x;
    *out++ = v.y;
    return out;
}

static double *fill_arrow(struct record *record, double *out, int b, const struct fbd_state *state,
                          const struct pose *pose, size_t index, bool energies)
{
    const struct fbd_model *model = record->model;
    const struct model_body *body = &model->bodies[b];
    const struct arrow *arrow = &record->arrows[index];
    const struct instant at = state_instant(state);
    struct vec G = point_motion(body, pose, body->inertia.G).p;
    enum force_part parts[force_parts];
    size_t columns = force_columns(model, b, arrow, true, parts);
    for (size_t k = 0; k < columns; k++) *out++ = force_part_value(model, b, &at, arrow, parts[k]);
    struct vec arm = vec_sub(arrow->point, pose->origin), r = pose->rotation;
    *out++ = arrow->force.x;
    *out++ = arrow->force.y;
    *out++ = vec_dot(arm, r);
    *out++ = vec_dot(arm, vec_perp(r));
    *out++ = arrow->couple;
    if (has_term(model, b, arrow))
        for (int k = 0; k < body->count; k++) *out++ = equation_term(body, arrow, k, G);
    int load = diagram_work_column(model, b, record->arrows, index);
    if (load >= 0) *out++ = energies ? ledger_work(record->ledger, state, (size_t)load, record->work) : NAN;
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
        out = fill_motion(out, &record->bodies[b], body, state, &at, &pose);
        size_t count = diagram_fill(model, (int)b, &at, state->a, state->slots, record->arrows);
        for (size_t i = 0; i < count; i++) out = fill_arrow(record, out, (int)b, state, &pose, i, energies);
    }
    fbd_energy energy = {NAN, NAN, NAN, NAN, NAN, NAN};
    if (energies) energy = ledger_energy(record->ledger, state, record->work);
    *out++ = energy.kinetic;
    *out++ = energy.potential;
    *out++ = energy.work;
    *out++ = energy.residual;
    for (int i = 0; i < model->plan.own; i++) *out++ = state->y[2 * model->plan.n + i];
}
