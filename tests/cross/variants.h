/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The same scene said in another way: its answers have to be the same, but for how they are said.
 */
#ifndef CROSS_VARIANTS_H
#define CROSS_VARIANTS_H

#include <math.h>

#include "random.h"
#include "scene.h"

enum variant {
    variant_mirrored, /* in the x axis */
    variant_turned,   /* with its gravity */
    variant_moved,    /* by 1e6 m */
    variant_units,    /* SI in US units, and back */
    variant_order,    /* of bodies and couplings */
    variant_split,    /* a part of a body welded to it */
    variant_later,    /* taken up at a later time */
    variant_count
};

/* How a place in the world is said there: mirrored (y by -1), turned, moved, in other units. */
struct view {
    double mirror, angle, length, force;
    struct vec2 shift;
    int changed; /* body whose own forces are shared out between two, or -1 */
};

const char *variant_name(enum variant variant);

/* False where the scene has nothing to be said in that way. `later`: by how much time is shifted; the state
 * is the caller's to set. */
bool scene_vary(const struct scene *scene, enum variant variant, struct random *random, double later,
                struct scene *other, struct view *view);

/* variants_bodies.c */
void vary_order(const struct scene *scene, struct random *random, struct scene *other);
bool vary_split(struct scene *scene, struct random *random, struct view *view);

/* variants_units.c */
void scale_formula(struct formula *formula, double factor);
void vary_units(struct scene *scene, double l, double f);

static inline struct vec2 turned(struct vec2 p, double angle)
{
    double c = cos(angle), s = sin(angle);
    return (struct vec2){c * p.x - s * p.y, s * p.x + c * p.y};
}

#endif
