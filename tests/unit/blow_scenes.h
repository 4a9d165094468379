/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random bodies that strike two or three things at one instant: how all lies and moves at the blow, and the model of the
 * flights that lead there.
 */
#ifndef FBD_TESTS_BLOW_SCENES_H
#define FBD_TESTS_BLOW_SCENES_H

#include <stdbool.h>
#include <stdint.h>

#include "impacts_by_sets.h"
#include "written.h"

/* Gravity where a scene falls [m/s^2]. */
static const double blow_gravity = 10;

enum { most_corners = 6, most_touches = 3, most_bodies = 1 + most_touches };

/* q and v are those of centres of mass and angles, at the blow. */
struct blow_body {
    double m, I, radius, q[3], v[3];
};

/* Where the first body touches something: a corner of it, or its rim; and what, of which body, 0 for the ground. */
struct blow_touch {
    int corner, other;
    double normal[2], radius; /* towards the first body; of the other one */
    double arm[2][2];         /* from the centres of mass of both bodies */
    double e, mu;
    enum law_by_steps law;
};

struct blow_scene {
    int bodies, touches, corners;
    bool falls, in_turn, flat;
    int grazes; /* the first of its touches lasts already, without a press */
    double when, radius, corner[most_corners][2], turned[most_corners][2]; /* as it is at the blow */
    struct blow_body body[most_bodies];
    struct blow_touch touch[most_touches];
    const char *kind;
    struct written text;
};

/* Draw one from a seed, with its model in `text`. */
void blow_draw(uint64_t seed, struct blow_scene *scene);

/* Of row 0, the normal, or 1, the tangent of a touch: what it is of the velocities of a body. */
void blow_row(const struct blow_touch *touch, int row, int body, double J[3]);

/* The speed of a touch along row 0 or 1, at the blow [m/s]. */
double blow_speed(const struct blow_scene *scene, int touch, int row);

#endif
