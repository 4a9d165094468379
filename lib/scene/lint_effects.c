/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Warnings of entries without effect: a force across a slide without a surface, the weight of a long body on a pivot
 * at its centre, lines of the ground that nothing uses. The intended effect has other keys.
 */
#include "scene/reader.h"

/* Angle of an applied force of constant direction in the world from the line of the slide of `body`; else 0. */
static double angle_from_slide(const struct body *body, const struct load *load)
{
    if (load->kind != load_applied || load->toward || load->reaction || load->body_frame) return 0;
    if (!load->angle.expr || !expr_is_constant(load->angle.expr)) return 0;
    return expr_value(load->angle.expr) - body->motion.along;
}

static bool is_plain_slide(const struct body *body)
{
    if (body->motion.kind != motion_slide || body->motion.parent != ground_body) return false;
    for (size_t i = 0; i < body->load_count; i++)
        if (body->loads[i].kind == load_normal) return false;
    return true;
}

static void note_across(struct reader *reader, size_t b)
{
    const double right_angle = 1e-12; /* of the cosine: rounding of an angle */
    const struct body *body = &reader->scene->bodies[b];
    const double degrees = body->motion.along * 180 / acos(-1);
    if (!is_plain_slide(body)) return;
    for (size_t i = 0; i < body->load_count; i++) {
        const struct load *load = &body->loads[i];
        if (fabs(cos(angle_from_slide(body, load))) > right_angle) continue;
        diag_add(
            reader->errors, FBD_WARNING, "across-slide", load->angle.at,
            diag_hint(reader->errors,
                      "an angle is one of the world; a force along the slide has none, or `angle: %.6g deg`",
                      degrees),
            "`%s` acts across the slide of `%s`, which takes all of it", load->name, body->name);
    }
}

static bool weighs(const struct body *body)
{
    for (size_t i = 0; i < body->load_count; i++)
        if (body->loads[i].kind == load_gravity) return true;
    return false;
}

/* True if the weight is the only force of a body; moments may act beside it. */
static bool only_weighs(const struct body *body)
{
    for (size_t i = 0; i < body->load_count; i++)
        if (body->loads[i].kind != load_gravity && body->loads[i].kind < moment_applied) return false;
    return weighs(body);
}

/* True for a rod or prism on a pivot whose point on the body the file does not give: the centre. */
static bool is_on_its_centre(const struct reader *reader, size_t b)
{
    const struct body *body = &reader->scene->bodies[b];
    if (body->motion.kind != motion_pivot || reader->drafts[b].motion_keys.point || body->part_count != 1)
        return false;
    const struct vec G = body_centre_of_mass(body);
    const bool is_long = body->parts[0].shape == shape_rod || body->parts[0].shape == shape_prism;
    return is_long && G.x == body->motion.point.x && G.y == body->motion.point.y;
}

static void note_through_axis(struct reader *reader, size_t b)
{
    const struct body *body = &reader->scene->bodies[b];
    if (vec_norm(reader->scene->gravity) == 0 || !only_weighs(body) || !is_on_its_centre(reader, b)) return;
    diag_add(reader->errors, FBD_WARNING, "through-axis", body->motion.at,
             "a pendulum needs the point of the body on the pivot, as `point: [0, 0.5 m]` or `point: left`; "
             "where the centre is meant, write `point: G`",
             "the pivot of `%s` is at its centre of mass: its weight has no moment", body->name);
}

/* True if a body that can fall has weight. */
static bool falls(const struct scene *scene)
{
    for (size_t b = 0; b < scene->body_count; b++) {
        const enum motion_kind kind = scene->bodies[b].motion.kind;
        if ((kind == motion_planar || kind == motion_particle) && weighs(&scene->bodies[b])) return true;
    }
    return false;
}

/* Of files that use none of their lines, with bodies that can fall. */
static void note_unused_lines(struct reader *reader)
{
    const size_t count = reader->lines && reader->ground_lines ? reader->lines->count : 0;
    for (size_t i = 0; i < count; i++)
        if (reader->ground_lines[i].used) return;
    if (count == 0 || !falls(reader->scene)) return;
    const char *name = reader->lines->pairs[0].key;
    diag_add(reader->errors, FBD_WARNING, "unused-line", reader->ground_lines[0].at,
             diag_hint(reader->errors,
                       "a body that shall touch it needs `contacts: [{between: [BODY, ground.%s]}]`", name),
             "nothing uses the line `%s`: bodies pass through it", name);
}

void lint_effects_note(struct reader *reader)
{
    const bool free = reader->scene->constraint_count == 0 && reader->scene->force_coupling_count == 0;
    for (size_t b = 0; free && b < reader->scene->body_count; b++) {
        note_across(reader, b);
        note_through_axis(reader, b);
    }
    if (free) note_unused_lines(reader);
}
