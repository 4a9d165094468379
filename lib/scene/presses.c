/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A surface that nothing presses on: friction there is zero, and whoever listed `normal` and not the weight should
 * know.
 */
#include "scene/reader.h"

/* Does a force act across a slide in the direction `along`, as far as can be told? */
static bool acts_across(const struct scene *scene, const struct load *load, double along)
{
    const struct law *law = load_law(load);
    return law->across && law->across(load, scene->gravity, along);
}

static const struct load *normal_of(const struct body *body)
{
    for (size_t i = 0; i < body->load_count; i++)
        if (body->loads[i].kind == load_normal && !body->loads[i].two_sided) return &body->loads[i];
    return NULL;
}

/* Mark the bodies that others may press on their surface: they move on another one, carry one, or are joined. */
static void mark_joined(const struct scene *scene, bool *joined)
{
    for (size_t b = 0; b < scene->body_count; b++) {
        int parent = scene->bodies[b].motion.parent;
        if (parent != ground_body) joined[b] = joined[parent] = true;
    }
    for (size_t c = 0; c < scene->coupling_count; c++)
        for (int end = 0; end < 2; end++)
            if (scene->couplings[c].body[end] >= 0) joined[scene->couplings[c].body[end]] = true;
    for (size_t c = 0; c < scene->constraint_count; c++)
        for (int end = 0; end < scene->constraints[c].end_count; end++)
            if (scene->constraints[c].body[end] >= 0) joined[scene->constraints[c].body[end]] = true;
}

bool presses_note(struct reader *reader)
{
    const struct scene *scene = reader->scene;
    if (vec_norm(scene->gravity) == 0) return true; /* said on purpose */
    bool *joined = ARENA_ARRAY(reader->arena, scene->body_count, bool);
    if (!joined) return false;
    mark_joined(scene, joined);
    for (size_t b = 0; b < scene->body_count; b++) {
        const struct body *body = &scene->bodies[b];
        const struct load *normal = body->motion.kind == motion_slide ? normal_of(body) : NULL;
        bool pressed = !normal || joined[b];
        for (size_t i = 0; !pressed && i < body->load_count; i++)
            pressed = acts_across(scene, &body->loads[i], body->motion.along);
        if (!pressed)
            diag_add(reader->errors, FBD_WARNING, "nothing-presses", normal->at,
                     "list what does, as `gravity`; what is not listed does not exist",
                     "nothing presses `%s` on its surface: `%s` is zero, and so is friction", body->name,
                     normal->name);
    }
    return true;
}
