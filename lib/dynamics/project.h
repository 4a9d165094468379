/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Projection onto the constraints: positions so that g = 0, then velocities so that g' = 0, with the smallest
 * change in the norm of the mass matrix (Hairer and Wanner, Solving Ordinary Differential Equations II,
 * section VII.2).
 */
#ifndef FBD_DYNAMICS_PROJECT_H
#define FBD_DYNAMICS_PROJECT_H

#include "dynamics/state.h"

struct misfit {
    double position, velocity; /* the largest |g| and |g'|; angles and lengths alike */
    int row;                   /* of the position; -1 without rows */
};

/* The residuals of the constraints at the state. */
struct misfit state_misfit(struct fbd_state *state);

/* The largest residual g'' of the accelerations of an evaluated state, and its row, relative to the largest
 * acceleration that occurs or that the forces could give to all bodies together. It is rounding, unless
 * masses differ so much that the system of the multipliers cannot be solved. 0 and -1 without rows. */
double state_acceleration_misfit(const struct fbd_state *state, int *row);

/* Find the worst row that locks a state at rest to second order, where the slopes of its couplings vanish and
 * the accelerations violate them; -1 if none. A point between two rods in one line, loaded across, cannot
 * move, and no finite force holds it; four bars in one line have two possible motions, each with its own
 * accelerations. The state has been evaluated; `other` is overwritten. */
int state_locked_row(const struct fbd_state *state, struct fbd_state *other);

/* Is the scene immovable for all times? There are as many independent rows as coordinates, always active and
 * in the only modes: J v = 0 implies v = 0. Evaluates the state. */
bool state_is_fixed(struct fbd_state *state);

/* Project the positions of the state only, in its modes. */
bool state_project_position(struct fbd_state *state);

/* Set the references of couplings from the start: lengths that are not given, mesh of gears. */
void state_start_constraints(struct fbd_state *state);

/* Project positions and velocities. With `assemble` only the coordinates of bodies that the scene marks for
 * assembly, else all. Returns false without convergence: the best state found remains. */
bool state_project(struct fbd_state *state, bool assemble);

/* Project the end of a step, which has its error, along rows with a slope. Near a singular position their
 * slopes nearly vanish, and satisfying them would change the state by more than its error. */
void state_return(struct fbd_state *state);

/* The same, with the residuals before and after; the links are at the final state. */
struct closing {
    struct misfit off, left;
    double energy[2]; /* kinetic, of jointed bodies, before and after */
};

struct closing state_close(struct fbd_state *state);

/* The same for y[2n] within a step, in the modes of the instant. */
void return_to_constraints(const struct fbd_model *model, const struct instant *at, double *y);

/* Project the velocities of the state only. */
bool state_project_velocity(struct fbd_state *state, bool assemble);

/* ways[n x n], row by row: the projection of a unit velocity of each coordinate onto the couplings in the
 * modes of the state. Evaluates the state. */
void state_find_ways(struct fbd_state *state, double *ways);

#endif
