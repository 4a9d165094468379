/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random decks that move, with what lies, leans and slides on them, as models and for the time stepping of moreau.h: a
 * deck is driven or free, on a slide or pivot of the ground, on a body that moves itself, or hangs on rods.
 */
#ifndef FBD_TESTS_DECKS_H
#define FBD_TESTS_DECKS_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "moreau.h"
#include "random_numbers.h"
#include "stepped.h"
#include "written.h"

enum { deck_most_bodies = 5, deck_most_contacts = 10 };
static const double deck_g = 10; /* m/s^2 */

struct wave { /* A sin(w t + phase) + B */
    double A, w, phase, B;
};

double wave_at(const struct wave *wave, double t);
double wave_rate(const struct wave *wave, double t);
double wave_bend(const struct wave *wave, double t);

enum deck_shape { deck_point, deck_disc, deck_box };

struct piece {
    enum deck_shape shape;
    double at[2]; /* of its centre, in the frame of its body */
    double r, half[2];
    double m;
};

enum deck_motion { deck_planar, deck_slide, deck_pivot };

struct deck_body { /* its frame is here as it lies in the world at the start, turned by start[2] */
    int pieces;
    struct piece piece[2];
    double m, I, G[2];
    enum deck_motion motion;
    int on; /* -1: the ground */
    double start[3], speed[3];
    double along;             /* of a slide, in the world at the start */
    double point[2], axis[2]; /* of a pivot, in the frame and in the world at the start */
    double x0;                /* coordinate of a slide or pivot at the start; speed[0] is its rate */
    bool driven;
    struct wave drive;
    double spring, neutral, damper;
    double rub; /* of a pivot [N m], or the coefficient of a slide */
    bool has_stops;
    double stop[2];
    struct wave push[3];
};

struct deck_contact {
    int body, other; /* -1: the floor */
    double mu;
};

struct deck_rod {
    int body;
    double point[2], end[2], length; /* in the frame; in the world */
};

struct deck_scene {
    int count, contacts, rods;
    struct deck_body body[deck_most_bodies];
    struct deck_contact contact[deck_most_contacts];
    struct deck_rod rod[2];
    double floor, tilt, e; /* of the floor: its height at x = 0 and slope */
    double until;
    double h; /* of the stepping */
};

/* Of a struct deck_scene, as stepped.h takes them. */
void deck_draw(uint64_t seed, void *scene);
void deck_write(const void *scene, struct written *text);

/* How the frame that the model has is turned against that of `struct deck_body`: on a slide it lies along the line. */
double deck_turned(const struct deck_body *body);

/* Velocity of the point at p of a body at the start, and the angular velocity. */
void deck_twist(const struct deck_scene *scene, int i, const double *p, double *twist);

/* By time stepping, with coordinates and rates as the model names them. */
struct stepped_values deck_step(void *scene, int steps);

#endif
