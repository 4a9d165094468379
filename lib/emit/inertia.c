/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Masses, centres of mass and moments of inertia, summed as in model/inertia.c, and the directions of slides.
 */
#include <math.h>
#include <string.h>

#include "emit/bodies.h"
#include "emit/live.h"
#include "model/inertia.h"
#include "scene/start_angle.h"

static const char *number_of(struct emitter *emitter, const struct part *part, const char *owner,
                             const char *key, double value, struct dim dim)
{
    return emit_parameter(emitter, emit_join(emitter, owner, key), value,
                          (struct emit_origin){part->at, key, dim, -1});
}

/* ---- rods: their ends have names */

static size_t part_index(const struct emitter *emitter, int b, const struct part *part)
{
    size_t index = 0;
    for (int k = 0; k < b; k++) index += emitter->model->bodies[k].source->part_count;
    return index + (size_t)(part - emitter->model->bodies[b].source->parts);
}

static struct emit_origin origin_in(const struct part *part, const char *key, int b)
{
    return (struct emit_origin){part->at, key, DIM_LENGTH, b};
}

/* Write a rod by its ends, or by its length, direction and centre. */
static void write_rod(struct emitter *emitter, const struct part *part, const char *owner, int b)
{
    const char *name = emit_constant(emitter, "struct rod", emit_join(emitter, owner, "ends"));
    const struct node *from = emit_live_find(emitter, origin_in(part, "from", b));
    const struct node *to = emit_live_find(emitter, origin_in(part, "to", b));
    struct text *out = &emitter->derive;
    emitter->rods[part_index(emitter, b, part)] = name;
    if (from && to) {
        struct vec ends[2];
        if (!emit_live_pair(emitter, from, &ends[0]) || !emit_live_pair(emitter, to, &ends[1])) {
            emitter->rods[part_index(emitter, b, part)] = NULL; /* written by digits */
            return;
        }
        const char *a =
            emit_vector(emitter, emit_join(emitter, owner, "from"), ends[0], origin_in(part, "from", b));
        const char *z =
            emit_vector(emitter, emit_join(emitter, owner, "to"), ends[1], origin_in(part, "to", b));
        text_printf(out, "    c->%s = rod_between(%s, %s);\n", name, a, z);
        return;
    }
    const char *length = number_of(emitter, part, owner, "length", part->length, DIM_LENGTH);
    const char *angle = number_of(emitter, part, owner, "angle", part->angle, DIM_NONE);
    const char *center =
        emit_vector(emitter, emit_join(emitter, owner, "center"), part->center, origin_in(part, "center", b));
    text_printf(out, "    c->%s = rod_along(%s, %s, %s);\n", name, length, angle, center);
}

const char *emit_rod_end(struct emitter *emitter, int b, const char *word, struct vec value)
{
    const struct body *source = emitter->model->bodies[b].source;
    for (size_t i = 0; i < source->part_count; i++) {
        const struct part *part = &source->parts[i];
        const char *rod = emitter->rods[part_index(emitter, b, part)];
        const char *prefix = part->name ? emit_printf(emitter, "%s.", part->name) : "";
        struct vec half = vec_scale(part->length / 2, vec_unit(part->angle));
        struct vec left = vec_sub(part->center, half), right = vec_add(part->center, half);
        if (!rod) continue;
        if (strcmp(word, emit_printf(emitter, "%sleft", prefix)) == 0 && value.x == left.x &&
            value.y == left.y)
            return emit_printf(emitter, "c->%s.left", rod);
        if (strcmp(word, emit_printf(emitter, "%sright", prefix)) == 0 && value.x == right.x &&
            value.y == right.y)
            return emit_printf(emitter, "c->%s.right", rod);
    }
    return NULL;
}

/* The centre of a part in the frame of its body. */
static const char *center_of(struct emitter *emitter, const struct part *part, const char *owner, int b)
{
    const char *rod = emitter->rods[part_index(emitter, b, part)];
    struct part plain = *part; /* the centre of a polygon has no key */
    plain.at = (struct pos){0, 0};
    if (part->shape == shape_polygon) part = &plain;
    if (rod) return emit_printf(emitter, "c->%s.center", rod);
    return emit_vector(emitter, emit_join(emitter, owner, "center"), part->center,
                       origin_in(part, "center", b));
}

/* ---- moments of inertia of shapes about their centres */

static const char *hollow(struct emitter *emitter, const struct part *part, const char *owner, const char *m)
{
    const char *R = number_of(emitter, part, owner, "outer_radius", part->radius, DIM_LENGTH);
    const char *r = number_of(emitter, part, owner, "inner_radius", part->inner_radius, DIM_LENGTH);
    const char *both = emit_printf(emitter, "(square(%s) + square(%s))", R, r);
    if (part->axis == 'x') return emit_printf(emitter, "%s*%s/2", m, both);
    const char *L = number_of(emitter, part, owner, "length", part->length, DIM_LENGTH);
    return emit_printf(emitter, "%s*(3*%s + square(%s))/12", m, both, L);
}

static const char *prism(struct emitter *emitter, const struct part *part, const char *owner, const char *m)
{
    static const char *const keys[] = {"a", "b", "c"};
    const char *sides[2];
    int count = 0;
    for (int k = 0; k < 3; k++)
        if (part->axis != "xyz"[k])
            sides[count++] = number_of(emitter, part, owner, keys[k], part->side[k], DIM_LENGTH);
    return emit_printf(emitter, "%s*(square(%s) + square(%s))/12", m, sides[0], sides[1]);
}

static const char *cylinder(struct emitter *emitter, const struct part *part, const char *owner,
                            const char *m)
{
    const char *R = number_of(emitter, part, owner, "radius", part->radius, DIM_LENGTH);
    if (part->axis == 'x') return emit_printf(emitter, "%s*square(%s)/2", m, R);
    const char *L = number_of(emitter, part, owner, "length", part->length, DIM_LENGTH);
    return emit_printf(emitter, "%s*(3*square(%s) + square(%s))/12", m, R, L);
}

static const char *given(struct emitter *emitter, const struct part *part, const char *owner, const char *m,
                         int b)
{
    struct vec pivot = emitter->model->bodies[b].source->motion.point;
    const char *I;
    if (part->gyration > 0) {
        const char *k = number_of(emitter, part, owner, "radius_of_gyration", part->gyration, DIM_LENGTH);
        I = emit_printf(emitter, "%s*square(%s)", m, k);
    } else {
        I = number_of(emitter, part, owner, "inertia", part->inertia, DIM_INERTIA);
    }
    if (part->about.kind != point_fixed && !part->about_pivot) return I;
    struct vec from = vec_sub(part->about_pivot ? pivot : part->about.where, part->center);
    const char *d = emit_vector(emitter, emit_join(emitter, owner, "about"), from,
                                (struct emit_origin){{0, 0}, "", DIM_LENGTH, b});
    const char *square = emit_printf(emitter, "vec_dot(%s, %s)", d, d);
    return emit_printf(emitter, "%s - %s*%s", I, m, square);
}

/* The square of its radius of gyration is a number, since the corners are no parameters. */
static const char *polygon(struct emitter *emitter, const struct part *part, const char *owner, const char *m)
{
    const struct part unit = {.shape = shape_polygon,
                              .mass = 1,
                              .center = part->center,
                              .corner_count = part->corner_count,
                              .corners = part->corners};
    const double k = sqrt(inertia_of_parts(&unit, 1, part->center).I_G);
    struct part plain = *part;
    plain.at = (struct pos){0, 0};
    return emit_printf(emitter, "%s*square(%s)", m,
                       number_of(emitter, &plain, owner, "radius_of_gyration", k, DIM_LENGTH));
}

static const char *shape_inertia(struct emitter *emitter, const struct part *part, const char *owner,
                                 const char *m, int b)
{
    const char *size, *rod = emitter->rods[part_index(emitter, b, part)];
    struct part plain;
    switch (part->shape) {
    case shape_point: return "0";
    case shape_rod:
        if (part->axis == 'x') return "0";
        if (rod) return emit_printf(emitter, "%s*square(c->%s.length)/12", m, rod);
        plain = *part; /* not a parameter: the names of the rod's ends depend on the length too */
        plain.at = (struct pos){0, 0};
        size = number_of(emitter, &plain, owner, "length", part->length, DIM_LENGTH);
        return emit_printf(emitter, "%s*square(%s)/12", m, size);
    case shape_sphere:
        size = number_of(emitter, part, owner, "radius", part->radius, DIM_LENGTH);
        return emit_printf(emitter, "2*%s*square(%s)/5", m, size);
    case shape_ring:
        size = number_of(emitter, part, owner, "radius", part->radius, DIM_LENGTH);
        return emit_printf(emitter, part->axis == 'x' ? "%s*square(%s)" : "%s*square(%s)/2", m, size);
    case shape_cylinder: return cylinder(emitter, part, owner, m);
    case shape_hollow_cylinder: return hollow(emitter, part, owner, m);
    case shape_prism: return prism(emitter, part, owner, m);
    case shape_polygon: return polygon(emitter, part, owner, m);
    case shape_given: return given(emitter, part, owner, m, b);
    }
    return "0";
}

/* Write a single part, whose centre is used without rounding. */
static void one_part(struct emitter *emitter, const struct part *part, const char *body, int b)
{
    struct text *out = &emitter->derive;
    bool rod = part->shape == shape_rod && emit_tells_points(emitter, b);
    const char *m = number_of(emitter, part, body, "mass", part->mass, DIM_MASS);
    text_printf(out, "    c->%s.mass = %s;\n", body, m);
    if (rod) write_rod(emitter, part, body, b);
    if (rod || part->center.x != 0 || part->center.y != 0)
        text_printf(out, "    c->%s.G = %s;\n", body, center_of(emitter, part, body, b));
    const char *I = shape_inertia(emitter, part, body, m, b);
    if (*I != '0') text_printf(out, "    c->%s.I_G = %s;\n", body, I);
}

static void many_parts(struct emitter *emitter, const char *body, int b)
{
    const struct body *source = emitter->model->bodies[b].source;
    struct text *out = &emitter->derive;
    text_printf(out, "    struct vec %s_moment = {0, 0}; /* of the masses about the origin of its frame */\n",
                body);
    const char **m = ARENA_ARRAY(&emitter->arena, source->part_count, const char *);
    const char **center = ARENA_ARRAY(&emitter->arena, source->part_count, const char *);
    if (!m || !center) return;
    for (size_t i = 0; i < source->part_count; i++) {
        const struct part *part = &source->parts[i];
        const char *owner = emit_join(emitter, body, part->name);
        /* The masses of a planar body determine whether its equations are coupled, so they are no parameters. */
        struct part plain = *part;
        const struct joint_type *joint = motion_joint(&source->motion);
        if (joint->angle >= 0 && !joint->has_axis) plain.at = (struct pos){0, 0};
        m[i] = number_of(emitter, &plain, owner, "mass", part->mass, DIM_MASS);
        if (part->shape == shape_rod && emit_tells_points(emitter, b)) write_rod(emitter, part, owner, b);
        center[i] = center_of(emitter, part, owner, b);
        text_printf(out, "    c->%s.mass += %s;\n    %s_moment = vec_add(%s_moment, vec_scale(%s, %s));\n",
                    body, m[i], body, body, m[i], center[i]);
    }
    text_printf(out, "    c->%s.G = vec_scale(1/c->%s.mass, %s_moment);\n", body, body, body);
    for (size_t i = 0; i < source->part_count; i++) {
        const struct part *part = &source->parts[i];
        const char *owner = emit_join(emitter, body, part->name);
        const char *I = shape_inertia(emitter, part, owner, m[i], b);
        text_printf(out, "    c->%s.I_G += %s + %s*vec_square(vec_sub(%s, c->%s.G)); /* %s */\n", body, I,
                    m[i], center[i], body, part->name);
    }
}

/* The angle of the frame of a slide's parent at the start, with the angles of slides as parameters. */
static const char *carrier_angle(struct emitter *emitter, const struct fbd_model *model, int carrier)
{
    double turned = start_angle(model->scene, carrier);
    const char *text = "";
    for (int b = carrier; b != ground_body; b = model->bodies[b].parent) {
        if (model->bodies[b].joint->path != path_line) continue;
        turned -= model->bodies[b].source->motion.along;
        text = emit_printf(emitter, " + c->%s.along%s", emitter->body[b], text);
    }
    return emit_printf(emitter, "%s%s", emit_number(emitter, turned), text);
}

static void slide(struct emitter *emitter, const struct model_body *body, const char *name)
{
    struct text *out = &emitter->derive;
    const struct motion *motion = &body->source->motion;
    const char *along = emit_parameter(emitter, emit_join(emitter, name, "along"), motion->along,
                                       (struct emit_origin){motion->at, "along", DIM_NONE, -1});
    text_printf(out, "    c->%s.along = %s;\n", name, along);
    text_printf(out, "    c->%s.e = vec_unit(c->%s.along); /* along the slide, and across it */\n", name,
                name);
}

/* Write the direction of the normal force; requires the directions of all slides. */
static void side_of_slide(struct emitter *emitter, const struct model_body *body, const char *name)
{
    struct text *out = &emitter->derive;
    enum normal_side side = side_up;
    for (size_t i = 0; i < body->source->load_count; i++)
        if (body->source->loads[i].kind == load_normal) side = body->source->loads[i].side;
    text_printf(out, "    c->%s.n = ", name);
    if (side == side_up)
        text_printf(out, "vec_upward(vec_perp(c->%s.e), %s);\n", name,
                    carrier_angle(emitter, emitter->model, body->parent));
    else
        text_printf(out, side == side_right ? "vec_scale(-1, vec_perp(c->%s.e));\n" : "vec_perp(c->%s.e);\n",
                    name);
}

void emit_inertias(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        const struct body *source = body->source;
        const char *name = emitter->body[b];
        text_printf(&emitter->constants, "    struct body %s;\n", name);
        text_printf(&emitter->derive, "\n    /* %s */\n", name);
        if (source->part_count == 1)
            one_part(emitter, &source->parts[0], name, (int)b);
        else
            many_parts(emitter, name, (int)b);
        if (body->joint->path == path_line) slide(emitter, body, name);
        if (!body->joint->has_axis) continue;
        text_printf(&emitter->derive, "    c->%s.pin = %s;\n", name,
                    emit_vector(emitter, emit_join(emitter, name, "point"), body->pin,
                                (struct emit_origin){source->motion.at, "point", DIM_LENGTH, (int)b}));
        if (!body->alone) continue;
        text_printf(&emitter->derive,
                    "    c->%s.I_O = c->%s.I_G + c->%s.mass*vec_square(vec_sub(c->%s.G, c->%s.pin));\n", name,
                    name, name, name, name);
    }
    for (size_t b = 0; b < model->body_count; b++)
        if (model->bodies[b].joint->path == path_line)
            side_of_slide(emitter, &model->bodies[b], emitter->body[b]);
}
