/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Warnings of surfaces: a vertical line with `side: up`, and a surface without a normal force, where friction
 * is zero.
 */
#include "scene/reader.h"
#include "scene/start_angle.h"

/* True if a force may act across a slide in the direction `along`. */
static bool acts_across(const struct scene *scene, const struct load *load, double along)
{
    const struct law *law = load_law(load);
    return law->across && law->across(load, scene->gravity, along);
}

static const struct load *normal_of(const struct body *body)
{
    if (motion_joint(&body->motion)->path != path_line) return NULL;
    for (size_t i = 0; i < body->load_count; i++)
        if (body->loads[i].kind == load_normal && !body->loads[i].two_sided) return &body->loads[i];
    return NULL;
}

/* True if a slide moves along the lines of all bodies that carry it, so that none of them exerts a normal
 * force. */
static bool is_carried_along(const struct scene *scene, size_t b)
{
    const double parallel = 1e-12;
    const struct motion *motion = &scene->bodies[b].motion;
    double turned = 0; /* angle from the line of the carrier */
    if (motion_joint(motion)->path != path_line) return false;
    while (motion->parent != ground_body) {
        turned += motion->along;
        motion = &scene->bodies[motion->parent].motion;
        const struct joint_type *joint = motion_joint(motion);
        if (joint->count == 0) continue;
        if (joint->path != path_line || fabs(sin(turned)) > parallel) return false;
    }
    return true;
}

/* Mark bodies on whose surface others may exert a normal force: the parent moves across it, they carry a
 * body, or they have couplings. */
static void mark_joined(const struct scene *scene, bool *joined)
{
    for (size_t b = 0; b < scene->body_count; b++) {
        int parent = scene->bodies[b].motion.parent;
        if (parent == ground_body) continue;
        joined[parent] = true;
        if (!is_carried_along(scene, b)) joined[b] = true;
    }
    for (size_t c = 0; c < scene->force_coupling_count; c++)
        for (int end = 0; end < 2; end++)
            if (scene->force_couplings[c].body[end] >= 0) joined[scene->force_couplings[c].body[end]] = true;
    for (size_t c = 0; c < scene->constraint_count; c++)
        for (int end = 0; end < scene->constraints[c].end_count; end++)
            if (scene->constraints[c].body[end] >= 0) joined[scene->constraints[c].body[end]] = true;
}

/* A hint, with the value of `along` of a level line if `along` counts from the line of a carrier that is not
 * level, as on a lift. */
static const char *with_carrier(struct reader *reader, size_t b, const char *hint)
{
    const double level = 1e-12;
    const struct scene *scene = reader->scene;
    int parent = scene->bodies[b].motion.parent;
    double turned = start_angle(scene, parent);
    if (parent == ground_body || fabs(sin(turned)) < level) return hint;
    double degrees = turned * 180 / acos(-1);
    return diag_hint(
        reader->errors,
        "%s; `along` counts from the x axis of `%s`, which is at %.6g deg: level is `along: %.6g deg`", hint,
        scene->bodies[parent].name, degrees, -degrees);
}

/* Warn of `side: up` on a vertical line. A two-sided guide has no side. */
static void note_no_side_up(struct reader *reader, size_t b, const struct load *normal)
{
    const double upright = 1e-12; /* same limit as in model/compile.c, where the side is chosen */
    if (normal->side != side_up || fabs(vec_unit(start_angle(reader->scene, (int)b)).x) > upright) return;
    diag_add(reader->errors, FBD_WARNING, "no-side-up", normal->at,
             with_carrier(reader, b,
                          "write `normal: {side: left}` or `normal: {side: right}`, as seen along +x"),
             "no side of a vertical line is up: the surface is taken to push to the left of +x");
}

bool lint_friction_note(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    for (size_t b = 0; b < scene->body_count; b++) {
        const struct body *body = &scene->bodies[b];
        const struct load *normal = normal_of(body);
        if (normal) note_no_side_up(reader, b, normal);
    }
    if (vec_norm(scene->gravity) == 0) return true; /* intended */
    bool *joined = ARENA_ARRAY(reader->arena, scene->body_count, bool);
    if (!joined) return false;
    mark_joined(scene, joined);
    for (size_t b = 0; b < scene->body_count; b++) {
        const struct body *body = &scene->bodies[b];
        const struct load *normal = normal_of(body);
        bool pressed = !normal || joined[b];
        for (size_t i = 0; !pressed && i < body->load_count; i++)
            pressed = acts_across(scene, &body->loads[i], start_angle(scene, (int)b));
        bool weighs = false;
        for (size_t i = 0; i < body->load_count; i++) weighs |= body->loads[i].kind == load_gravity;
        if (!pressed)
            diag_add(reader->errors, FBD_WARNING, "nothing-presses", normal->at,
                     weighs ? with_carrier(reader, b, "gravity acts along this line; list a force across it")
                            : "list a force that does, such as `gravity`; forces that are not listed are not "
                              "simulated",
                     "no force presses `%s` on its surface: `%s` is zero, and so is friction", body->name,
                     normal->name);
    }
    return true;
}
