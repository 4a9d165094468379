/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One loop with one freedom: three links, pivots and slides of the ground in one chain or in two, closed by a pin.
 * Slider-cranks and four-bars are such trees, however their links are numbered.
 *
 * In the angles of the links in the world the closing of the loop and the energy are sums over the links, of which each
 * has a vector b that turns with it, k x b what the pin is moved by as the link turns:
 *
 *     g' = sum omega_j k x b_j = 0,   g'' = sum (alpha_j k x b_j - omega_j^2 b_j) = 0
 *
 * The motion that is left free is N = (b_1 x b_2, b_2 x b_0, b_0 x b_1); along it the pin does no work, so that
 * multipliers are not needed (Lagrange's equations on the null space: Bayo and Ledesma, Nonlinear Dynamics 9, 1996, 113).
 * A slide goes along e as the end of a b would that does not turn, with k x b = e.
 *
 * All is counted in units in which the inertia of each link, with what hangs on it, is 1: then |N|^2 says whether the
 * rows of the pin are independent.
 */
#ifndef FBD_DYNAMICS_TREE_LOOP_H
#define FBD_DYNAMICS_TREE_LOOP_H

#include "dynamics/instant.h"

struct tree_loop_link {
    int coordinate;
    bool turns;      /* else it is a slide */
    double along;    /* beyond the angle of the link before */
    struct vec b, S; /* in its frame: see above; static moment, with all behind at the O of the next */
    double sine,
        cosine;     /* sine sin(angle) + cosine cos(angle): the moment of constant forces, with all behind */
    double steady;  /* constant moments, or forces along a slide */
    bool passes_on; /* the moment in the joint of the next acts on it as well */
    double unit;    /* of its acceleration: 1 / sqrt(inertia) */
    double inverse_unit;
};

struct tree_loop {
    const struct tree *tree;
    struct tree_loop_link *of[4]; /* of a link of the tree */
    bool chain;                   /* all three in one; else the third stands by itself */
    double least;                 /* |N|^2 below which the rows count as dependent */
    struct vec gap;               /* what of g does not move */
    double size;                  /* of what it is a sum of */
    struct tree_loop_link links[3];
};

/* Is the scene such a loop and nothing beside it? Then its constants. */
bool tree_loop_find(const struct fbd_model *model, struct tree_loop *loop);

/* Does nothing in it vary but by where it is and how it moves? */
bool tree_loop_is_steady(const struct fbd_model *model);

/* What acts along the links beside constant forces, by the forces in the joints (joint_forces); in units of the links. */
void tree_loop_forces(const struct tree_loop *loop, const struct instant *at, const double *slots, double *f);

/* Accelerations a[3] at y, v under f[3]. False near singular positions, and where the inertias are too far apart: then a
 * is not written. */
bool tree_loop_rates(const struct tree_loop *loop, const double *f, const double *y, const double *v,
                     double *a);

/* What the pin is off by, and how fast, and the kinetic energy of the links. */
struct tree_loop_sight {
    struct vec off, rate;
    double energy;
};

struct tree_loop_closing {
    struct tree_loop_sight before, after;
    struct vec turn[4]; /* of the links of the tree that turn, after */
};

/* Bring y[6] back to the pin, positions and then velocities, with the least change in the sense of the mass matrix, as
 * return_to_constraints does (tree_loop_return.c). False where that has to: y is as it was. */
bool tree_loop_return(const struct tree_loop *loop, double *y);

/* The same, and what was and is to be seen there. */
bool tree_loop_close(const struct tree_loop *loop, double *y, struct tree_loop_closing *closing);

#endif
