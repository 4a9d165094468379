/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/column_table.h"

#include "dynamics/mass.h"
#include "dynamics/tree.h"
#include "output/display_units.h"
#include "output/equations.h"
#include "output/words.h"

/* ---- definitions: name, unit and entry of part c->part; false if there is no such column */

static const char *inertia_unit(const struct fbd_model *model)
{
    return model->scene->units == unit_si ? "kg" : "slug";
}

/* "body.name.part"; `name` or `part` may be "". */
static bool define(struct run_columns *columns, struct run_column *c, const char *name, const char *part,
                   const char *unit)
{
    const char *body = columns->model->bodies[c->body].name;
    c->name =
        arena_printf(&columns->arena, "%s%s%s%s%s", body, name[0] ? "." : "", name, part[0] ? "." : "", part);
    c->unit = unit;
    return true;
}

static bool define_time(struct run_columns *columns, struct run_column *c)
{
    (void)columns;
    c->name = "t";
    c->unit = "s";
    return true;
}

static bool define_entry(struct run_columns *columns, struct run_column *c, int entry)
{
    const struct display display = display_of_component(columns->model, (size_t)entry, columns->degrees);
    c->entry = entry;
    c->name = display.name;
    c->unit = display.unit;
    c->size = display.size;
    return true;
}

static bool define_coordinate(struct run_columns *columns, struct run_column *c)
{
    const struct model_body *body = &columns->model->bodies[c->body];
    return c->part < body->count && define_entry(columns, c, body->first + c->part);
}

static bool define_rate(struct run_columns *columns, struct run_column *c)
{
    const struct model_body *body = &columns->model->bodies[c->body];
    return c->part < body->count && define_entry(columns, c, body->first_rate + c->part);
}

static bool define_state(struct run_columns *columns, struct run_column *c)
{
    return define_entry(columns, c, 2 * columns->model->plan.n + c->index);
}

static bool define_acceleration(struct run_columns *columns, struct run_column *c)
{
    const struct model_body *body = &columns->model->bodies[c->body];
    if (c->part >= body->count) return false;
    const struct label *label = &columns->model->labels[body->first + c->part];
    c->entry = body->first + c->part;
    return define(columns, c, label->acceleration_name, "", label->acceleration_unit);
}

static bool define_in_equation(struct run_columns *columns, struct run_column *c)
{
    static const char *const of_center[] = {"a_Gx", "a_Gy", "alpha"};
    const struct model_body *body = &columns->model->bodies[c->body];
    if (c->part >= body->count || equation_has_coordinate(body)) return false;
    const bool of_G = body_is_off_center(body) && body->parent == ground_body;
    return define(columns, c,
                  of_G ? of_center[c->part] : equation_acceleration_name(columns->model, body, c->part), "",
                  columns->model->labels[body->first + c->part].acceleration_unit);
}

static bool define_newton(struct run_columns *columns, struct run_column *c)
{
    static const char *const names[] = {"G.ax", "G.ay", "G.alpha"};
    return define(columns, c, names[c->part], "",
                  c->part == 2 ? "rad/s^2" : world_part_unit(columns->model, world_ax));
}

static bool define_moving_axis(struct run_columns *columns, struct run_column *c)
{
    const struct model_body *body = &columns->model->bodies[c->body];
    const bool has_axis = body->joint->has_axis;
    return tree_has_more(body) && define(columns, c, has_axis ? "moving_axis" : "turning_along", "",
                                         has_axis ? moment_unit(columns->model) : force_unit(columns->model));
}

static bool define_mass(struct run_columns *columns, struct run_column *c)
{
    return columns->model->bodies[c->body].varies &&
           define(columns, c, "m", "", inertia_unit(columns->model));
}

static bool define_frame(struct run_columns *columns, struct run_column *c)
{
    static const char *const names[] = {"frame.x", "frame.y", "frame.angle"};
    return define(columns, c, names[c->part], "", c->part == 2 ? "rad" : length_unit(columns->model));
}

static bool define_velocity(struct run_columns *columns, struct run_column *c)
{
    return define(columns, c, c->part == 0 ? "G.vx" : "G.vy", "", world_part_unit(columns->model, world_vx));
}

static bool define_point(struct run_columns *columns, struct run_column *c)
{
    const struct scene *scene = columns->model->scene;
    const enum world_part part = (enum world_part)c->part;
    c->body = scene->output_points[c->index].body;
    c->name =
        arena_printf(&columns->arena, "%s.%s", scene->output_points[c->index].name, world_part_name(part));
    c->unit = world_part_unit(columns->model, part);
    return true;
}

/* Has the arrow this part without `components`? */
static bool has_part(const struct fbd_model *model, int b, const struct arrow *arrow, enum force_part part)
{
    const struct model_body *body = &model->bodies[b];
    const bool own = arrow->load < 0 && arrow_is_of_joint(model, b, arrow);
    const bool given = body->joint->path != path_none || body->joint->prevents_turning; /* its direction */
    if (own && given) return false;
    if (!own && body->count == 1) return part == force_share;
    const bool couples = own ? !body->joint->has_axis : !body->joint->prevents_turning;
    return part != force_share && (part != force_moment || couples);
}

static bool define_force(struct run_columns *columns, struct run_column *c)
{
    static const char *const names[] = {"", "x", "y", "moment"};
    const struct fbd_model *model = columns->model;
    const enum force_part part = (enum force_part)c->part;
    const struct arrow *arrow = &columns->arrows[c->index];
    c->extra = !has_part(model, c->body, arrow, part);
    if (c->extra && part == force_share) return false;
    c->extra &= !columns->components;
    const bool moment =
        part == force_moment || (part == force_share && model->bodies[c->body].joint->has_axis);
    return define(columns, c, arrow->name, names[part], moment ? moment_unit(model) : force_unit(model));
}

static bool define_arrow(struct run_columns *columns, struct run_column *c)
{
    static const char *const names[] = {"fx", "fy", "px", "py", "couple"};
    return define(columns, c, columns->arrows[c->index].name, names[c->part], "");
}

/* Not of reactions of the body's joint, which are no terms of its coordinates' equations. */
static bool define_term(struct run_columns *columns, struct run_column *c)
{
    const struct arrow *arrow = &columns->arrows[c->index];
    return c->part < columns->model->bodies[c->body].count &&
           (arrow->load >= 0 || !arrow_is_of_joint(columns->model, c->body, arrow)) &&
           define(columns, c, arrow->name, "term", "");
}

static bool define_work(struct run_columns *columns, struct run_column *c)
{
    c->entry = diagram_work_column(columns->model, c->body, columns->arrows, (size_t)c->index);
    return c->entry >= 0 &&
           define(columns, c, columns->arrows[c->index].name, "work", energy_unit(columns->model));
}

static bool define_carried_work(struct run_columns *columns, struct run_column *c)
{
    c->entry = columns->model->bodies[c->body].carried;
    return c->entry >= 0 && define(columns, c, "mass", "work", energy_unit(columns->model));
}

static bool define_energy(struct run_columns *columns, struct run_column *c)
{
    static const char *const names[] = {"energy.kinetic", "energy.potential", "energy.work",
                                        "energy.residual"};
    c->name = names[c->part];
    c->unit = energy_unit(columns->model);
    return true;
}

/* ---- the view */

static const struct model_body *body_of(const struct run_column *c, const struct column_view *view)
{
    return &view->state->model->bodies[c->body];
}

static const struct arrow *arrow_of(const struct run_column *c, struct column_view *view)
{
    const struct fbd_state *state = view->state;
    if (view->with_arrows != c->body)
        diagram_fill(state->model, c->body, &view->at, state->slots, view->arrows);
    view->with_arrows = c->body;
    return &view->arrows[c->index];
}

/* The frame of the body, and the motion of its G in view->G. */
static const struct pose *pose_of(const struct run_column *c, struct column_view *view)
{
    const struct model_body *body = body_of(c, view);
    if (view->with_pose != c->body) {
        view->pose = body_pose(body, &view->at);
        view->G = point_motion(body, &view->pose, body->inertia.G);
    }
    view->with_pose = c->body;
    return &view->pose;
}

/* ---- values of the `count` columns of one kind, body and index from c on */

static void time_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    (void)c, (void)count;
    values[0] = view->state->t;
}

static void entry_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    const double *y = view->state->y;
    for (const struct run_column *end = c + count; c < end; c++) *values++ = y[c->entry] / c->size;
}

static void acceleration_values(const struct run_column *c, int count, struct column_view *view,
                                double *values)
{
    for (int k = 0; k < count; k++) values[k] = view->state->a[c[k].entry];
}

static void in_equation_values(const struct run_column *c, int count, struct column_view *view,
                               double *values)
{
    const struct model_body *body = body_of(c, view);
    for (int k = 0; k < count; k++)
        values[k] = equation_acceleration(body, &view->at, view->state->a, c[k].part);
}

static void newton_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    const struct model_body *body = body_of(c, view);
    const struct vec a_G = mass_center_acceleration(body, &view->at);
    const double all[] = {a_G.x, a_G.y, body_angular_acceleration(body, &view->at)};
    for (int k = 0; k < count; k++) values[k] = all[c[k].part];
}

static void moving_axis_values(const struct run_column *c, int count, struct column_view *view,
                               double *values)
{
    (void)count;
    values[0] = tree_more(body_of(c, view), &view->at);
}

static void mass_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    (void)count;
    values[0] = body_mass(body_of(c, view), &view->at);
}

static void frame_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    const struct vec origin = pose_of(c, view)->origin;
    const double all[] = {origin.x, origin.y, body_angle(body_of(c, view), &view->at)};
    for (int k = 0; k < count; k++) values[k] = all[c[k].part];
}

static void velocity_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    pose_of(c, view);
    for (int k = 0; k < count; k++) values[k] = c[k].part == 0 ? view->G.v.x : view->G.v.y;
}

static void point_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    double all[world_parts];
    const struct fbd_model *model = view->state->model;
    const bool listed = c->index >= 0;
    const struct vec point = listed ? model->output_points[c->index] : world_point(model, c->body, c->point);
    world_values(view->state, c->body, point, all);
    for (int k = 0; k < count; k++) values[k] = all[c[k].part];
}

static void section_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    struct diag_call call;
    (void)count;
    values[0] = section_name_value(c->section, view->state, view->at_rest, diag_begin(&call, view->errors));
    diag_end(&call);
}

/* The component along the motion, of `normal` the normal force. */
static double share_of(const struct run_column *c, const struct arrow *arrow, const struct column_view *view)
{
    const struct fbd_model *model = view->state->model;
    const bool normal = arrow->load >= 0 && arrow_is_of_joint(model, c->body, arrow);
    if (!normal) return arrow->share[0];
    return vec_dot(arrow->force, surface_normal(model, body_of(c, view), &view->at));
}

static void force_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    const struct arrow *arrow = arrow_of(c, view);
    for (int k = 0; k < count; k++) {
        switch ((enum force_part)c[k].part) {
        case force_x: values[k] = arrow->force.x; break;
        case force_y: values[k] = arrow->force.y; break;
        case force_moment:
            pose_of(c, view);
            values[k] = arrow_moment(arrow, view->G.p);
            break;
        default: values[k] = share_of(c, arrow, view);
        }
    }
}

static void arrow_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    const struct arrow *arrow = arrow_of(c, view);
    const struct pose *pose = pose_of(c, view);
    const struct vec arm = vec_sub(arrow->point, pose->origin);
    const double all[] = {arrow->force.x, arrow->force.y, vec_dot(arm, pose->rotation),
                          vec_dot(arm, vec_perp(pose->rotation)), arrow->couple};
    for (int k = 0; k < count; k++) values[k] = all[c[k].part];
}

static void term_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    const struct arrow *arrow = arrow_of(c, view);
    pose_of(c, view);
    for (int k = 0; k < count; k++) values[k] = equation_term(body_of(c, view), arrow, c[k].part, view->G.p);
}

static void work_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    (void)count;
    values[0] = view->ledger ? ledger_work(view->ledger, view->state, (size_t)c->entry, view->work) : NAN;
}

static void energy_values(const struct run_column *c, int count, struct column_view *view, double *values)
{
    fbd_energy energy = {NAN, NAN, NAN, NAN, NAN, NAN};
    if (view->ledger) energy = ledger_energy(view->ledger, view->state, view->work);
    const double all[] = {energy.kinetic, energy.potential, energy.work, energy.residual};
    for (int k = 0; k < count; k++) values[k] = all[c[k].part];
}

/* ---- errors of a value, `other` being that of the companion */

static double entry_error(const struct run_column *c, const struct column_view *view, const struct bars *bars,
                          double value, double other)
{
    (void)value, (void)other;
    return bars_component(bars, view->state, (size_t)c->entry) / c->size;
}

static double difference(const struct run_column *c, const struct column_view *view, const struct bars *bars,
                         double value, double other)
{
    (void)c, (void)view;
    return bars_difference(bars, value, other);
}

static double energy_error(const struct run_column *c, const struct column_view *view,
                           const struct bars *bars, double value, double other)
{
    const bool residual = c->part == 3;
    return residual ? bars_residual(bars, value) : difference(c, view, bars, value, other);
}

/* ---- the table */

enum {
    csv = column_in_csv,
    ledger = column_in_ledger,
    page = column_in_page,
    sweep = column_in_sweep,
    all = csv | page | sweep
};

const struct column_row column_rows[column_kinds] = {
    /* clang-format off */
    [column_time] = {of_run, csv | sweep, quantity_own, 1, define_time, time_values, NULL},
    [column_coordinate] = {of_body, all, quantity_coordinate, 3, define_coordinate, entry_values, entry_error},
    [column_rate] = {of_body, all, quantity_rate, 3, define_rate, entry_values, entry_error},
    [column_acceleration] = {of_body, page, quantity_acceleration, 3, define_acceleration, acceleration_values, difference},
    [column_in_equation] = {of_body, page, quantity_acceleration, 3, define_in_equation, in_equation_values, difference},
    [column_newton] = {of_body, page, quantity_acceleration, 3, define_newton, newton_values, difference},
    [column_moving_axis] = {of_body, page, quantity_term, 1, define_moving_axis, moving_axis_values, difference},
    [column_mass] = {of_body, page, quantity_term, 1, define_mass, mass_values, difference},
    [column_frame] = {of_body, page, quantity_pose, 3, define_frame, frame_values, difference},
    [column_velocity] = {of_body, page, quantity_rate, 2, define_velocity, velocity_values, difference},
    [column_state] = {of_state, all, quantity_own, 1, define_state, entry_values, entry_error},
    [column_point] = {of_point, csv, quantity_own, world_parts, define_point, point_values, difference},
    [column_section] = {of_body, 0, quantity_force, 1, NULL, section_values, NULL},
    [column_force] = {of_arrow, ledger | page, quantity_force, force_parts, define_force, force_values, difference},
    [column_arrow] = {of_arrow, page, quantity_arrow, 5, define_arrow, arrow_values, difference},
    [column_term] = {of_arrow, page, quantity_term, 3, define_term, term_values, difference},
    [column_work] = {of_arrow, ledger | page, quantity_work, 1, define_work, work_values, difference},
    [column_carried_work] = {of_works, ledger, quantity_work, 1, define_carried_work, work_values, difference},
    [column_energy] = {of_energy, ledger | page | sweep, quantity_energy, 4, define_energy, energy_values, energy_error},
    /* clang-format on */
};
