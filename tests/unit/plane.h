/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random scenes in the plane, as models and for the time stepping of moreau.h.
 */
#ifndef FBD_TESTS_PLANE_H
#define FBD_TESTS_PLANE_H

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

enum { most_bodies = 3 };
static const double plane_g = 10; /* m/s^2 */

struct push { /* A sin(w t + phase) + B */
    double A, w, phase, B;
};

struct body { /* of all kinds; lengths in m, masses in kg */
    double m, r, I;
    double q[3], v[3]; /* start */
    struct push push[3];
    bool has_min, has_max;
    double min, max, e;
    double spring, neutral, damper;
    double rub, rub_speed; /* a bearing [N m, rad/s], or a coefficient and a speed of the surface */
    bool lists_zero;       /* friction is listed though rub = 0 */
    double through[2], along;
    int on;
    bool point; /* a particle */
};

struct rope {
    int body, other; /* -1: none */
    double at[2], length;
};

struct scene {
    int count, ropes, kind;
    struct body body[most_bodies];
    struct rope rope[4];
    double slope, mu, e, mu_pair, e_pair, wall[2];
    bool has_wall[2], pairs;
    double until;
};

bool chance(struct random_numbers *numbers, double share);
struct push draw_push(struct random_numbers *numbers, double size);
double push_at(const struct push *push, double t);
void add_push(struct written *text, const struct push *push);

/* Stops of its first coordinate, at its start or within `size` of it. Laws of restitution differ where an impact is not of
 * one point alone, and without friction: `plastic` then. */
void draw_stops(struct random_numbers *numbers, struct body *body, double size, bool plastic);
void add_stops(struct written *text, const struct body *body);

/* A row more, without a normal. */
struct moreau_row *row_of(struct moreau_rows *rows, enum moreau_kind kind);

/* Ropes that are taut at q, of bodies with three coordinates each. */
void rope_rows(const struct scene *scene, const double *q, struct moreau_rows *rows);

struct kind {
    const char *name;
    void (*draw)(struct random_numbers *numbers, struct scene *scene);
    void (*write)(const struct scene *scene, struct written *text);
    void (*forces)(const void *scene, double t, const double *q, const double *v, double *f);
    void (*solve)(const void *scene, const double *q, double *b);
    void (*rows)(const void *scene, double t, const double *q, struct moreau_rows *rows);
    int size; /* coordinates of the stepping for each body */
    void (*start)(const struct scene *scene, double *q, double *v);
    /* What the model calls its coordinates and rates, from those of the stepping. */
    void (*name_values)(const struct scene *scene, const double *q, const double *v,
                        struct stepped_values *named);
};

extern const struct kind plane_links, plane_discs, plane_weights, plane_stack;

#endif
