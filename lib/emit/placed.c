/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "emit/placed.h"

#include <string.h>

#include "emit/bodies.h"

/* True if `at`, within `text`, is not inside a longer name. */
static bool begins_name(const char *text, const char *at)
{
    char before = at > text ? at[-1] : ' ';
    return !((before >= 'a' && before <= 'z') || (before >= 'A' && before <= 'Z') ||
             (before >= '0' && before <= '9') || before == '_' || before == '>' || before == '.');
}

static bool mentions(const char *text, const char *word)
{
    for (const char *at = strstr(text, word); at; at = strstr(at + 1, word))
        if (begins_name(text, at)) return true;
    return false;
}

/* True if the letter occurs as an argument or operand. */
static bool mentions_argument(const char *lines, char name)
{
    for (const char *at = strchr(lines, name); at; at = strchr(at + 1, name))
        if (at[1] && strchr(",)[- ;*/", at[1]) && begins_name(lines, at)) return true;
    return false;
}

void emit_function(struct text *out, const char *head, const char *arguments, const struct text *lines)
{
    const char *body = lines->data ? lines->data : "";
    bool p = mentions(body, "p->"), c = mentions(body, "c->");
    text_printf(out, "%s(%s)\n{\n", head, arguments);
    if (p) text_add(out, "    const struct parameters *p = &s->p;\n");
    if (c) text_add(out, "    const struct constants *c = &s->c;\n");
    if (mentions(arguments, "*s") && !p && !c && !mentions_argument(body, 's'))
        text_add(out, "    (void)s;\n");
    if (mentions(arguments, "t,") && !mentions_argument(body, 't')) text_add(out, "    (void)t;\n");
    if (mentions(arguments, "*y") && !mentions_argument(body, 'y')) text_add(out, "    (void)y;\n");
    text_add(out, body);
    text_add(out, "}\n\n");
}

static void write_pose(struct emitter *emitter, int b, struct text *lines)
{
    const struct model_body *body = &emitter->model->bodies[b];
    const char *name = emitter->body[b], **q = emitter->coordinate + body->first,
               **v = emitter->rate + body->first;
    const char *origin = "";
    const bool has_axis = body->joint->has_axis;
    if (body->count == 1)
        origin = emit_vector(emitter, emit_join(emitter, name, "origin"), body->origin,
                             (struct emit_origin){body->source->motion.at, has_axis ? "at" : "through",
                                                  DIM_LENGTH, -1});
    if (has_axis)
        text_printf(lines, "    return (struct pose){%s, vec_unit(y[%s]), {0, 0}, y[%s]};\n", origin, q[0],
                    v[0]);
    else if (body->count == 1)
        text_printf(lines,
                    "    return (struct pose){vec_add(%s, vec_scale(y[%s], c->%s.e)), c->%s.e, "
                    "vec_scale(y[%s], c->%s.e), 0};\n",
                    origin, q[0], name, name, v[0], name);
    else if (body->joint->angle < 0)
        text_printf(lines, "    return (struct pose){{y[%s], y[%s]}, {1, 0}, {y[%s], y[%s]}, 0};\n", q[0],
                    q[1], v[0], v[1]);
    else
        text_printf(lines,
                    "    return (struct pose){{y[%s], y[%s]}, vec_unit(y[%s]), {y[%s], y[%s]}, y[%s]};\n",
                    q[0], q[1], q[2], v[0], v[1], v[2]);
}

const char *emit_pose(struct emitter *emitter, int b)
{
    if (emitter->pose[b]) return emitter->pose[b];
    struct text lines = {0};
    write_pose(emitter, b, &lines);
    emitter->pose[b] = emit_name(emitter, emit_join(emitter, "pose_of", emitter->body[b]));
    const char *head = emit_printf(emitter, "/* Where `%s` is and how it moves. */\nstatic struct pose %s",
                                   emitter->body[b], emitter->pose[b]);
    emit_function(&emitter->formulas, head, "const struct scene *s, const double *y", &lines);
    emitter->arena.failed = emitter->arena.failed || lines.failed;
    text_free(&lines);
    return emitter->pose[b];
}

const char *emit_link_force(struct emitter *emitter, const struct model_load *load, const char *reach,
                            const char *velocity)
{
    const struct load *source = load->source;
    if (source->kind == load_spring) {
        const char *k = load_number(emitter, load, "stiffness", source->stiffness, DIM_STIFFNESS);
        const char *free = load_number(emitter, load, "free_length", source->free_length, DIM_LENGTH);
        return emit_printf(emitter, "spring(%s, %s, %s)", k, free, reach);
    }
    if (source->kind == load_actuator)
        return emit_printf(emitter, "vec_scale(-(%s)/vec_norm(%s), %s)",
                           load_formula(emitter, load, "force", &load->value, DIM_FORCE), reach, reach);
    const char *c = load_number(emitter, load, "coefficient", source->coefficient, DIM_DAMPING);
    return emit_printf(emitter, "damper(%s, %s, %s)", c, reach, velocity);
}

/* ---- positions in the world */

const char emit_new_links[] = "    struct links l = {0};\n    l.ground.turn = (struct vec){1, 0};\n";

static const char *placed(struct emitter *emitter, const struct model_absolute *absolute, const char *pose,
                          const char *point)
{
    const char *at = emit_printf(emitter, "point_of(&%s, %s)", pose, point);
    switch (absolute->kind) {
    case absolute_x: return emit_printf(emitter, "%s.p.x", at);
    case absolute_y: return emit_printf(emitter, "%s.p.y", at);
    case absolute_vx: return emit_printf(emitter, "%s.v.x", at);
    case absolute_vy: return emit_printf(emitter, "%s.v.y", at);
    case absolute_angle_dot: return emit_printf(emitter, "%s.omega", pose);
    default: return "0";
    }
}

/* The angle of the frame of a body. */
static const char *angle_of(struct emitter *emitter, const struct model_absolute *absolute, const char *link)
{
    const struct model_body *body = &emitter->model->bodies[absolute->body];
    const char *name = emitter->body[absolute->body];
    if (!body->alone) return emit_printf(emitter, "l.%s.angle + c->%s.place.angle", link, name);
    if (body->joint->path == path_line) return emit_printf(emitter, "c->%s.along", name);
    if (body->joint->angle < 0) return "0";
    return emit_printf(emitter, "y[%s]", emitter->coordinate[body->first + body->joint->angle]);
}

static const char *slip_of(struct emitter *emitter, const struct model_absolute *absolute)
{
    if (absolute->pair < 0) return "0";
    const struct mode *mode = &emitter->model->plan.modes[absolute->pair];
    const char *slip = emit_printf(emitter, "s->slip[%s]", emitter->pair[absolute->pair]);
    const char *speed = emit_printf(emitter, "%s*(y[%s] - surface_speed(s, t, y, %s))", slip,
                                    emitter->rate[mode->coordinate], emitter->pair[absolute->pair]);
    if (absolute->even) speed = emit_printf(emitter, "fabs(%s)", speed);
    return emit_printf(emitter, "%s == 0 ? 0 : %s", slip, speed);
}

static const char *one_place(struct emitter *emitter, size_t k, struct text *lines)
{
    const struct model_absolute *absolute = &emitter->model->absolutes[k];
    const struct model_body *body = &emitter->model->bodies[absolute->body];
    const char *name = emitter->body[absolute->body];
    if (absolute->kind == absolute_slip) return slip_of(emitter, absolute);
    const struct absolute *source = &emitter->model->scene->absolutes[k];
    const char *link = !body->alone ? emitter->body[emitter->model->tree->links[body->place.link].body] : "";
    if (absolute->kind == absolute_angle) return angle_of(emitter, absolute, link);
    const char *point = source->point.kind == point_fixed
                            ? emit_vector(emitter, emit_join(emitter, name, "point"), absolute->point,
                                          (struct emit_origin){{0, 0}, "", DIM_LENGTH, absolute->body})
                            : emit_printf(emitter, "c->%s.G", name);
    if (body->joint->has_axis) point = emit_printf(emitter, "vec_sub(%s, c->%s.pin)", point, name);
    const char *pose = emit_printf(emitter, "%s_pose", name);
    if (!lines->data || !strstr(lines->data, emit_printf(emitter, "struct pose %s =", pose))) {
        const char *call = body->alone ? emit_printf(emitter, "%s(s, y)", emit_pose(emitter, absolute->body))
                           : body->count == 0
                               ? emit_printf(emitter, "pose_of_weld(&l.%s, &c->%s.place)", link, name)
                               : emit_printf(emitter, "pose_of_link(&l.%s)", link);
        text_printf(lines, "    const struct pose %s = %s;\n", pose, call);
    }
    return placed(emitter, absolute, pose, point);
}

void emit_places(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    struct text lines = {0}, values = {0};
    bool jointed = false;
    for (size_t k = 0; k < model->absolute_count; k++)
        if (emitter->used[k] && model->absolutes[k].kind != absolute_slip &&
            !model->bodies[model->absolutes[k].body].alone)
            jointed = true;
    if (jointed) text_printf(&lines, "%s    move_links(s, y, &l);\n", emit_new_links);
    for (size_t k = 0; k < model->absolute_count; k++)
        if (emitter->used[k])
            text_printf(&values, "    y[%s] = %s;\n", emitter->place[k], one_place(emitter, k, &lines));
    if (values.length > 0) {
        text_add(&lines, values.data);
        emit_function(&emitter->links,
                      "/* Places in the world that expressions name, behind the coordinates and rates. */\n"
                      "static void write_places",
                      "const struct scene *s, double t, double *y", &lines);
    }
    emitter->arena.failed = emitter->arena.failed || lines.failed || values.failed;
    text_free(&lines);
    text_free(&values);
}
