/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Check the bodies of welds. A weld of a particle is a pin at the particle, so that this is its first end; two
 * particles have no angle to keep. The force of a weld between two bodies that are one already, by their motion or
 * by another weld, would not be determined; those that begin or end may act at different times. Welds that close a
 * loop of several bodies are redundant couplings as others, and share their forces.
 */
#include "model/builder.h"

static bool is_particle(const struct fbd_model *model, int body)
{
    return body != ground_body && model->bodies[body].kind == motion_particle;
}

/* Where body b is welded on another one by its motion, that one; else b. */
static int bearer(const struct fbd_model *model, int b)
{
    while (b != ground_body && model->bodies[b].kind == motion_weld) b = model->bodies[b].parent;
    return b;
}

static bool is_always(const struct constraint *source)
{
    return source->kind == constraint_weld && source->lifetime.number == 0;
}

/* The weld before it in the file that joins the same bodies always, or NULL. */
static const struct constraint *same_before(const struct fbd_model *model, const struct constraint *source)
{
    const int a = bearer(model, source->body[0]), b = bearer(model, source->body[1]);
    for (const struct constraint *other = model->scene->constraints; is_always(source) && other < source;
         other++) {
        const int c = bearer(model, other->body[0]), d = bearer(model, other->body[1]);
        if (is_always(other) && ((a == c && b == d) || (a == d && b == c))) return other;
    }
    return NULL;
}

static void check(struct builder *builder, const struct constraint *source)
{
    const struct fbd_model *model = builder->model;
    const bool first = is_particle(model, source->body[0]), second = is_particle(model, source->body[1]);
    const struct constraint *other = same_before(model, source);
    if (first && second)
        diag_add(builder->errors, FBD_ERROR, "conflicting-keys", source->at,
                 "write `pin` for particles at one place, `rod` for a constant distance",
                 "the weld `%s` joins two particles, which have no angle", source->name);
    else if (second)
        diag_add(builder->errors, FBD_ERROR, "conflicting-keys", source->at,
                 "name the particle first in `between`: the force acts there",
                 "the second body of the weld `%s` is a particle", source->name);
    else if (bearer(model, source->body[0]) == bearer(model, source->body[1]))
        diag_add(builder->errors, FBD_ERROR, "conflicting-keys", source->at,
                 "leave it out: its force would not be determined",
                 "the weld `%s` joins bodies that are fixed to each other by their `motion`", source->name);
    else if (other)
        diag_add(builder->errors, FBD_ERROR, "conflicting-keys", source->at,
                 "leave it out: its force would not be determined",
                 "the weld `%s` joins bodies that the weld `%s` joins already", source->name, other->name);
}

void welds_check(struct builder *builder)
{
    const struct scene *scene = builder->model->scene;
    for (size_t i = 0; i < scene->constraint_count; i++)
        if (scene->constraints[i].kind == constraint_weld) check(builder, &scene->constraints[i]);
}
