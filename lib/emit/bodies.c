/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The loads on a body outside the tree, and those within the joint of a body in the tree: the terms of the
 * plan (model/plan.c). Constants are summed in `derive`, in the order of the loads; variable terms are in the
 * function of the body.
 */
#include <string.h>

#include "emit/bodies.h"
#include "emit/placed.h"

/* The vector from the origin of the frame, or from the axis, to a point. */
static const char *arm_of(struct body_writer *writer, const char *point)
{
    if (!writer->body->joint->has_axis) return point;
    return emit_printf(writer->emitter, "vec_sub(%s, c->%s.pin)", point, writer->name);
}

/* ---- coefficients of the sums */

static void note_coefficient(struct slot_terms *terms, const char *coefficient)
{
    terms->constant = terms->constant || strcmp(coefficient, "constant") == 0;
    terms->stiffness = terms->stiffness || strcmp(coefficient, "stiffness") == 0;
    terms->damping = terms->damping || strcmp(coefficient, "damping") == 0;
    terms->sine = terms->sine || strcmp(coefficient, "sine") == 0 || strcmp(coefficient, "cosine") == 0;
    terms->quadratic = terms->quadratic || strcmp(coefficient, "quadratic") == 0;
}

void add_term(struct body_writer *writer, int slot, const char *coefficient, const char *value,
              const struct load *load)
{
    struct emitter *emitter = writer->emitter;
    struct slot_terms *terms = &writer->terms[slot];
    if (!terms->name) {
        terms->name =
            emit_constant(emitter, "struct terms", emit_join(emitter, emitter->slot[slot], "terms"));
        terms->loads = load->name;
    } else if (!strstr(terms->loads, load->name)) {
        terms->loads = emit_printf(emitter, "%s, %s", terms->loads, load->name);
    }
    note_coefficient(terms, coefficient);
    text_printf(&emitter->derive, "    c->%s.%s += %s; /* %s */\n", terms->name, coefficient, value,
                load->name);
}

static void add_world_moment(struct body_writer *writer, int slot, const char *arm, const char *force,
                             const struct load *load)
{
    struct emitter *emitter = writer->emitter;
    add_term(writer, slot, "sine", emit_printf(emitter, "-vec_dot(%s, %s)", arm, force), load);
    add_term(writer, slot, "cosine", emit_printf(emitter, "vec_cross(%s, %s)", arm, force), load);
}

/* Add a constant force that turns with a planar body. */
static void add_turning_force(struct body_writer *writer, const char *arm, const char *f,
                              const struct load *load)
{
    struct emitter *emitter = writer->emitter;
    int i = writer->body->first;
    add_term(writer, i, "sine", emit_printf(emitter, "-%s.y", f), load);
    add_term(writer, i, "cosine", emit_printf(emitter, "%s.x", f), load);
    add_term(writer, i + 1, "sine", emit_printf(emitter, "%s.x", f), load);
    add_term(writer, i + 1, "cosine", emit_printf(emitter, "%s.y", f), load);
    add_term(writer, i + 2, "constant", emit_printf(emitter, "vec_cross(%s, %s)", arm, f), load);
}

/* Add a constant force; only the order within a slot matters, since slots are independent. */
static void add_constant_force(struct body_writer *writer, const char *point, const char *value,
                               bool body_frame, const struct load *load)
{
    struct emitter *emitter = writer->emitter;
    const struct model_body *body = writer->body;
    int i = body->first;
    const char *f = emit_name(emitter, emit_printf(emitter, "%s_%s_force", writer->name, load->name));
    text_printf(&emitter->derive, "    const struct vec %s = %s;\n", f, value);
    if (body->joint->path == path_line) {
        const char *e = emit_printf(emitter, "c->%s.e", writer->name);
        const char *world = body_frame ? emit_printf(emitter, "vec_turn(%s, %s)", e, f) : f;
        add_term(writer, i, "constant", emit_printf(emitter, "vec_dot(%s, %s)", world, e), load);
        if (body->normal_slot >= 0)
            add_term(writer, body->normal_slot, "constant",
                     emit_printf(emitter, "vec_dot(%s, c->%s.n)", world, writer->name), load);
        return;
    }
    const char *arm = arm_of(writer, point);
    const bool turns = body->joint->angle >= 0, has_axis = body->joint->has_axis;
    if (turns && body_frame && !has_axis) {
        add_turning_force(writer, arm, f, load);
        return;
    }
    if (turns && body_frame)
        add_term(writer, i, "constant", emit_printf(emitter, "vec_cross(%s, %s)", arm, f), load);
    else if (turns)
        add_world_moment(writer, i + body->joint->angle, arm, f, load);
    if (has_axis) return;
    add_term(writer, i, "constant", emit_printf(emitter, "%s.x", f), load);
    add_term(writer, i + 1, "constant", emit_printf(emitter, "%s.y", f), load);
}

/* ---- applied forces */

/* slot += scale * value */
static void add_formula(struct body_writer *writer, int slot, const char *scale,
                        const struct formula *formula, const char *value, const struct load *load)
{
    struct emitter *emitter = writer->emitter;
    const char *product = scale ? emit_printf(emitter, "%s*%s", scale, value) : value;
    if (formula_is_constant(formula))
        add_term(writer, slot, "constant", product, load);
    else
        text_printf(&writer->lines, "    f[%s] += %s; /* %s */\n", emitter->slot[slot], product, load->name);
}

/* A constant factor, stored among the constants. */
static const char *scale_of(struct body_writer *writer, const char *suffix, const char *value,
                            const struct load *load)
{
    struct emitter *emitter = writer->emitter;
    const char *wanted = emit_printf(emitter, "%s_%s_%s", writer->name, load->name, suffix);
    const char *name = emit_constant(emitter, "double", wanted);
    text_printf(&emitter->derive, "    c->%s = %s;\n", name, value);
    return emit_printf(emitter, "c->%s", name);
}

/* Add a force at a point with variable direction or arm. */
static void add_force_at_point(struct body_writer *writer, const char *point, bool body_frame,
                               const char *value, const char *direction, const struct load *load)
{
    struct emitter *emitter = writer->emitter;
    const char *turned =
        body_frame ? emit_printf(emitter, "vec_turn(pose.rotation, %s)", direction) : direction;
    text_printf(&writer->points, "    add_at(&sum, &pose, %s, vec_scale(%s, %s)); /* %s */\n",
                arm_of(writer, point), value, turned, load->name);
}

struct directed {
    const struct formula *formula;
    const char *value, *point;
    struct vec d;
    const char *direction; /* d as a C expression */
    bool body_frame;
    bool turns; /* the direction is a parameter */
};

static void add_varying_force(struct body_writer *writer, const struct directed *force,
                              const struct load *load, bool at_origin)
{
    struct emitter *emitter = writer->emitter;
    const struct model_body *body = writer->body;
    int i = body->first;
    const char *d = force->direction;
    const bool turns = body->joint->angle >= 0;
    if (body->joint->path == path_line) {
        const char *e = emit_printf(emitter, "c->%s.e", writer->name);
        const char *world = force->body_frame ? emit_printf(emitter, "vec_turn(%s, %s)", e, d) : d;
        add_formula(writer, i,
                    scale_of(writer, "along", emit_printf(emitter, "vec_dot(%s, %s)", world, e), load),
                    force->formula, force->value, load);
        if (body->normal_slot < 0) return;
        const char *across = emit_printf(emitter, "vec_dot(%s, c->%s.n)", world, writer->name);
        add_formula(writer, body->normal_slot, scale_of(writer, "across", across, load), force->formula,
                    force->value, load);
    } else if (body->joint->has_axis && force->body_frame) {
        const char *lever = emit_printf(emitter, "vec_cross(%s, %s)", arm_of(writer, force->point), d);
        add_formula(writer, i, scale_of(writer, "arm", lever, load), force->formula, force->value, load);
    } else if (!turns || (!body->joint->has_axis && !force->body_frame && at_origin)) {
        if (force->turns || force->d.x != 0)
            add_formula(writer, i, scale_of(writer, "x", emit_printf(emitter, "%s.x", d), load),
                        force->formula, force->value, load);
        if (force->turns || force->d.y != 0)
            add_formula(writer, i + 1, scale_of(writer, "y", emit_printf(emitter, "%s.y", d), load),
                        force->formula, force->value, load);
    } else {
        const char *angle = emit_printf(emitter, "atan2(%s.y, %s.x)", d, d);
        const char *unit = emit_printf(emitter, "vec_unit(%s)", scale_of(writer, "angle", angle, load));
        add_force_at_point(writer, force->point, force->body_frame, force->value, unit, load);
    }
}

static void add_directed(struct body_writer *writer, const struct model_load *load, struct directed force)
{
    struct vec arm = vec_sub(load->point, writer->body->pin);
    if (formula_is_constant(force.formula))
        add_constant_force(writer, force.point,
                           emit_printf(writer->emitter, "vec_scale(%s, %s)", force.value, force.direction),
                           force.body_frame, load->source);
    else
        add_varying_force(writer, &force, load->source, arm.x == 0 && arm.y == 0);
}

static void add_component(struct body_writer *writer, const struct model_load *load, const char *point,
                          bool vertical)
{
    bool frame = load->source->kind == load_applied && load->source->body_frame;
    const struct formula *formula = vertical ? &load->fy : &load->fx;
    const char *value = load_formula(writer->emitter, load, vertical ? "fy" : "fx", formula, DIM_FORCE);
    add_directed(writer, load,
                 (struct directed){formula, value, point, vertical ? (struct vec){0, 1} : (struct vec){1, 0},
                                   vertical ? "((struct vec){0, 1})" : "((struct vec){1, 0})", frame, false});
}

static void add_couple(struct body_writer *writer, const struct model_load *load)
{
    const struct model_body *body = writer->body;
    if (body->joint->angle < 0) return;
    const char *value = load_formula(writer->emitter, load, "couple", &load->couple, DIM_MOMENT);
    add_formula(writer, body->first + body->joint->angle, NULL, &load->couple, value, load->source);
}

static void add_applied(struct body_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const struct load *source = load->source;
    const char *point = load_point(emitter, load, writer->name);
    if (source->fx.expr || source->fy.expr) {
        add_component(writer, load, point, false);
        add_component(writer, load, point, true);
    } else if (!source->angle.expr) {
        add_formula(writer, writer->body->first, NULL, &load->value,
                    load_formula(emitter, load, "value", &load->value, DIM_FORCE), source);
    } else {
        const char *angle = load_formula(emitter, load, "angle", &load->angle, DIM_NONE);
        const char *value = load_formula(emitter, load, "value", &load->value, DIM_FORCE);
        const char *unit = emit_printf(emitter, "vec_unit(%s)", angle);
        if (formula_is_constant(&load->angle))
            add_directed(writer, load,
                         (struct directed){&load->value, value, point, vec_unit(load->angle.constant), unit,
                                           source->body_frame, true});
        else
            add_force_at_point(writer, point, source->body_frame, value, unit, source);
    }
    if (load_is_placed(source)) add_couple(writer, load);
}

/* ---- springs, dampers, drag */

static void add_spring(struct body_writer *writer, const struct model_load *load, int slot)
{
    struct emitter *emitter = writer->emitter;
    const struct load *source = load->source;
    bool angle = source->kind == moment_spring || source->kind == moment_damper;
    if (source->kind == load_spring || source->kind == moment_spring) {
        const char *k =
            load_number(emitter, load, "stiffness", source->stiffness, angle ? DIM_MOMENT : DIM_STIFFNESS);
        const char *relaxed =
            load_number(emitter, load, "neutral", source->free_length, angle ? DIM_NONE : DIM_LENGTH);
        add_term(writer, slot, "stiffness", k, source);
        add_term(writer, slot, "constant", emit_printf(emitter, "%s*%s", k, relaxed), source);
    } else {
        const char *damping = load_number(emitter, load, "coefficient", source->coefficient,
                                          angle ? DIM_ANGULAR_DAMPING : DIM_DAMPING);
        add_term(writer, slot, "damping", damping, source);
    }
}

static void add_linked(struct body_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const char *anchor = load_anchor(emitter, load);
    const char *arm = arm_of(writer, load_point(emitter, load, writer->name));
    text_printf(&writer->points, "    at = point_of(&pose, %s);\n    add_at(&sum, &pose, %s, %s); /* %s */\n",
                arm, arm,
                emit_link_force(emitter, load, emit_printf(emitter, "vec_sub(at.p, %s)", anchor), "at.v"),
                load->source->name);
}

static void add_drag(struct body_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const struct load *source = load->source;
    const struct model_body *body = writer->body;
    const char *point = load_point(emitter, load, writer->name);
    int i = body->first;
    if (load_has_wind(source)) {
        add_component(writer, load, point, false);
        add_component(writer, load, point, true);
    }
    if (!load_drags_still_air(source)) return;
    bool at_origin = load->point.x == 0 && load->point.y == 0;
    bool simple = source->quadratic == 0 && (body->joint->angle < 0 || at_origin);
    const char *c = load_number(emitter, load, "linear", source->linear, DIM_DAMPING);
    if (body->count == 1) {
        const char *r =
            body->joint->has_axis ? emit_printf(emitter, "*vec_norm(%s)", arm_of(writer, point)) : "";
        add_term(writer, i, "damping", emit_printf(emitter, "%s%s%s", c, r, r), source);
        if (source->quadratic == 0) return;
        const char *k = load_number(emitter, load, "quadratic", source->quadratic, DIM_QUADRATIC_DRAG);
        add_term(writer, i, "quadratic", emit_printf(emitter, "%s%s%s%s", k, r, r, r), source);
    } else if (simple) {
        add_term(writer, i, "damping", c, source);
        add_term(writer, i + 1, "damping", c, source);
    } else {
        const char *k = load_number(emitter, load, "quadratic", source->quadratic, DIM_QUADRATIC_DRAG);
        const char *arm = arm_of(writer, point);
        text_printf(
            &writer->points,
            "    at = point_of(&pose, %s);\n    add_at(&sum, &pose, %s, drag(%s, %s, at.v)); /* %s */\n", arm,
            arm, c, k, source->name);
    }
}

static void add_potential(struct body_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    if (formula_is_constant(&load->potential)) return;
    const int *slots;
    size_t count = expr_variables(load->potential.expr, &slots);
    for (size_t k = 0; k < count; k++) {
        int coordinate = slots[k] - 1;
        const struct model_body *body = writer->body;
        if (coordinate < body->first || coordinate >= body->first + body->count) continue;
        const char *owner = emitter->load[load - emitter->model->loads];
        const char *V = emit_slope(emitter, &load->potential, emit_join(emitter, owner, "V"), slots[k],
                                   load_origin(load, "V", DIM_MOMENT));
        text_printf(&writer->lines, "    f[%s] -= %s.d; /* %s: -dV/d%s */\n", emitter->slot[coordinate], V,
                    load->source->name, emitter->model->scene->coordinates[coordinate].name);
    }
}

/* ---- by kind */

static void add_own_load(struct body_writer *writer, const struct model_load *load)
{
    struct emitter *emitter = writer->emitter;
    const struct model_body *body = writer->body;
    int last = body->first + body->count - 1;
    switch (load->source->kind) {
    case load_gravity:
        add_constant_force(writer, emit_printf(emitter, "c->%s.G", writer->name),
                           emit_printf(emitter, "vec_scale(c->%s.mass, c->gravity)", writer->name), false,
                           load->source);
        break;
    case load_applied: add_applied(writer, load); break;
    case load_spring:
    case load_damper:
        if (load->linked)
            add_linked(writer, load);
        else
            add_spring(writer, load, body->first);
        break;
    case load_drag: add_drag(writer, load); break;
    case load_potential:
    case moment_potential: add_potential(writer, load); break;
    case moment_applied:
        add_formula(writer, last, NULL, &load->value,
                    load_formula(emitter, load, "value", &load->value, DIM_MOMENT), load->source);
        break;
    case moment_spring:
    case moment_damper: add_spring(writer, load, last); break;
    default: break; /* normal forces and friction: see modes.c */
    }
}

/* Add a load that acts within the joint of a body; other loads are applied to its link (tree.c). */
static void add_joint_load(struct body_writer *writer, const struct model_load *load)
{
    const struct model_body *body = writer->body;
    int last = body->first + body->count - 1;
    switch (load->source->kind) {
    case load_potential:
    case moment_potential: add_potential(writer, load); break;
    case load_spring:
    case load_damper:
        if (!load->linked) add_spring(writer, load, body->first);
        break;
    case moment_spring:
    case moment_damper: add_spring(writer, load, last); break;
    default: break;
    }
}

/* ---- the function of a body */

static void write_sums(struct body_writer *writer, struct text *lines)
{
    struct emitter *emitter = writer->emitter;
    const struct plan *plan = &emitter->model->plan;
    const struct model_body *body = writer->body;
    const char *angle = body->count > 0 ? emitter->coordinate[body->first + body->count - 1] : "";
    for (int slot = 0; slot < plan->slots; slot++) {
        const struct slot_terms *terms = &writer->terms[slot];
        const char *name = emitter->slot[slot];
        if (!terms->name) continue;
        text_printf(lines, "    /* %s */\n", terms->loads);
        bool affine = terms->constant || terms->stiffness || terms->damping;
        if (affine) text_printf(lines, "    f[%s] += c->%s.constant", name, terms->name);
        if (terms->stiffness) text_printf(lines, " - c->%s.stiffness*y[%s]", terms->name, name);
        if (terms->damping) text_printf(lines, " - c->%s.damping*y[%s]", terms->name, emitter->rate[slot]);
        if (affine) text_add(lines, ";\n");
        if (terms->sine)
            text_printf(lines, "    f[%s] += c->%s.sine*sin(y[%s]) + c->%s.cosine*cos(y[%s]);\n", name,
                        terms->name, angle, terms->name, angle);
        if (terms->quadratic)
            text_printf(lines, "    f[%s] -= c->%s.quadratic*fabs(y[%s])*y[%s];\n", name, terms->name,
                        emitter->rate[slot], emitter->rate[slot]);
    }
}

static void write_points(struct body_writer *writer, struct text *lines)
{
    struct emitter *emitter = writer->emitter;
    const struct model_body *body = writer->body;
    if (writer->points.length == 0) return;
    text_printf(lines, "    const struct pose pose = %s(s, y);\n    struct resultant sum = {{0, 0}, 0};\n",
                emit_pose(emitter, writer->b));
    if (strstr(writer->points.data, "at = ")) text_add(lines, "    struct motion at;\n");
    text_add(lines, writer->points.data);
    if (body->joint->path == path_line) {
        text_printf(lines, "    f[%s] += vec_dot(sum.f, c->%s.e);\n", emitter->slot[body->first],
                    writer->name);
        if (body->normal_slot >= 0)
            text_printf(lines, "    f[%s] += vec_dot(sum.f, c->%s.n);\n", emitter->slot[body->normal_slot],
                        writer->name);
        return;
    }
    const int angle = body->joint->angle;
    if (angle >= 0) text_printf(lines, "    f[%s] += sum.moment;\n", emitter->slot[body->first + angle]);
    if (body->joint->has_axis) return;
    text_printf(lines, "    f[%s] += sum.f.x;\n    f[%s] += sum.f.y;\n", emitter->slot[body->first],
                emitter->slot[body->first + 1]);
}

static void write_body(struct body_writer *writer)
{
    struct emitter *emitter = writer->emitter;
    struct text lines = {0};
    write_sums(writer, &lines);
    if (writer->lines.length > 0) text_add(&lines, writer->lines.data);
    write_points(writer, &lines);
    if (lines.length > 0) {
        const char *name = emit_name(emitter, emit_join(emitter, "forces_on", writer->name));
        const char *head =
            emit_printf(emitter, "/* The forces on `%s`, beside dry friction and joints. */\nstatic void %s",
                        writer->name, name);
        emitter->forces_on[writer->b] = name;
        emit_function(&emitter->forces, head, "const struct scene *s, double t, const double *y, double *f",
                      &lines);
    }
    emitter->arena.failed = emitter->arena.failed || lines.failed;
    text_free(&lines);
}

void emit_bodies(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct body_writer writer = {emitter, (int)b, body, emitter->body[b], NULL, {0}, {0}};
        writer.terms = ARENA_ARRAY(&emitter->arena, (size_t)model->plan.slots, struct slot_terms);
        for (int i = 0; writer.terms && i < body->load_count; i++) {
            const struct model_load *load = &model->loads[body->first_load + i];
            if (!body->alone)
                add_joint_load(&writer, load);
            else
                add_own_load(&writer, load);
        }
        if (writer.terms) write_body(&writer);
        emitter->arena.failed = emitter->arena.failed || writer.lines.failed || writer.points.failed;
        text_free(&writer.lines);
        text_free(&writer.points);
    }
}
