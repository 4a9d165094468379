/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One loop with one degree of freedom: three links, pivots and slides of the ground in one chain or in two,
 * closed by a pin. Slider-cranks and four-bars are such trees, for any numbering of their links.
 *
 * In the angles of the links in the world the closure and the energy are sums over the links, each with a
 * vector b that turns with it and k x b the derivative of the pin's position with respect to its angle:
 *
 *     g' = sum omega_j k x b_j = 0,   g'' = sum (alpha_j k x b_j - omega_j^2 b_j) = 0
 *
 * The free motion is N = (b_1 x b_2, b_2 x b_0, b_0 x b_1); along it the pin does no work, so that
 * multipliers are not needed (Lagrange's equations on the null space: Bayo and Ledesma, Nonlinear Dynamics 9,
 * 1996, 113). A slide moves along e as the end of a b with k x b = e that does not turn.
 *
 * Units are such that the inertia of each link, with the masses behind it, is 1: then |N|^2 shows whether the
 * rows of the pin are independent.
 */
#ifndef FBD_DYNAMICS_TREE_LOOP_H
#define FBD_DYNAMICS_TREE_LOOP_H

#include "dynamics/instant.h"

struct tree_loop_link {
    int coordinate;
    bool turns;      /* else it is a slide */
    double along;    /* added to the angle of the link before */
    struct vec b, S; /* in its frame: see above; static moment, with all masses behind at the O of the next */
    double sine,
        cosine;     /* sine sin(angle) + cosine cos(angle): moment of constant forces, with those behind */
    double steady;  /* constant moments, or forces along a slide */
    bool passes_on; /* the moment in the joint of the next link acts on it as well */
    double unit;    /* of its acceleration: 1 / sqrt(inertia) */
    double inverse_unit;
};

struct tree_loop {
    const struct tree *tree;
    struct tree_loop_link *of[4]; /* of a link of the tree */
    bool chain;                   /* all three in one; else the third is a chain of its own */
    double least;                 /* |N|^2 below which the rows count as dependent */
    struct vec gap;               /* the constant part of g */
    double size;                  /* the scale of g */
    struct tree_loop_link links[3];
};

/* Does the scene have as many links and rows as such a loop? */
bool tree_loop_may_be(const struct fbd_model *model);

/* Is the whole scene such a loop? Then set its constants. */
bool tree_loop_find(const struct fbd_model *model, struct tree_loop *loop);

/* Do its loads depend on positions and velocities of the links only by constant forces? */
bool tree_loop_is_steady(const struct fbd_model *model);

/* The loads along the links beside constant forces, from the forces in the joints (joint_forces); in units of
 * the links. */
void tree_loop_forces(const struct tree_loop *loop, const struct instant *at, const double *slots, double *f);

/* Compute the accelerations a[3] at y, v under f[3]. False near singular positions, and if the inertias
 * differ too much: then a is not written. */
bool tree_loop_rates(const struct tree_loop *loop, const double *f, const double *y, const double *v,
                     double *a);

/* The position and velocity errors of the pin, and the kinetic energy of the links. */
struct tree_loop_sight {
    struct vec off, rate;
    double energy;
};

struct tree_loop_closing {
    struct tree_loop_sight before, after;
    struct vec turn[4]; /* of the turning links of the tree, after */
};

/* Project y[6] onto the pin, positions and then velocities, with the least change in the norm of the mass
 * matrix, as return_to_constraints does (tree_loop_return.c). False where that function is needed: y is
 * unchanged. */
bool tree_loop_return(const struct tree_loop *loop, double *y);

/* The same, with the errors and energies before and after. */
bool tree_loop_close(const struct tree_loop *loop, double *y, struct tree_loop_closing *closing);

#endif
