/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Projection onto the constraints: positions so that g = 0, then velocities so that g' = 0, with the smallest
 * change in the sense of the mass matrix (Hairer and Wanner, Solving Ordinary Differential Equations II,
 * section VII.2).
 */
#ifndef FBD_DYNAMICS_PROJECT_H
#define FBD_DYNAMICS_PROJECT_H

#include "dynamics/state.h"

struct misfit {
    double position, velocity; /* the largest |g| and |g'|; angles and lengths alike */
    int row, velocity_row;     /* where; -1 without rows */
};

/* How far the state is from its constraints. */
struct misfit state_misfit(struct fbd_state *state);

/* By how much the accelerations of an evaluated state miss a constraint, g'', and where: the largest, as a
 * share of the largest acceleration that there is or that the forces could give to all bodies together.
 * Rounding, unless masses are so far apart that the system of the multipliers cannot be solved. 0 and -1
 * without rows. */
double state_acceleration_misfit(const struct fbd_state *state, int *row);

/* Is the state at rest where its couplings have no slope, and do the accelerations set out on a way that they
 * do not allow, seen to the second order? A point between two rods in one line, loaded across, cannot move,
 * and no finite force holds it; four bars in one line might go on in two ways, each with its own
 * accelerations. The worst row, or -1. The state has been evaluated; `other` is written over. */
int state_locked_row(const struct fbd_state *state, struct fbd_state *other);

/* Is there no way to move, for good? There are as many independent rows as coordinates, which hold at all times and in
 * the only modes that there are: J v = 0 leaves v = 0. Evaluates the state. */
bool state_is_fixed(struct fbd_state *state);

/* The state's positions alone, as they are with the modes of the state. */
bool state_project_position(struct fbd_state *state);

/* What the state keeps of its start: lengths that are not given, how gears mesh. */
void state_start_constraints(struct fbd_state *state);

/* Project. With `assemble` only the coordinates of bodies that the scene marks so move, else all. False when
 * that does not converge: the best state that was found stays. */
bool state_project(struct fbd_state *state, bool assemble);

/* Bring the end of a step back, which is off by its error: where rows have a slope. Near a singular position
 * they have hardly any, and making them fit would throw the state about by more than it is off. */
void state_return(struct fbd_state *state);

/* The same, and what was and is left; the links stand where the state is then. */
struct closing {
    struct misfit off, left;
    double energy[2]; /* kinetic, of jointed bodies, before and after */
};

struct closing state_close(struct fbd_state *state);

/* The same for y[2n] within a step, in the modes of the instant. */
void return_to_constraints(const struct fbd_model *model, const struct instant *at, double *y);

/* The state's velocities alone. */
bool state_project_velocity(struct fbd_state *state, bool assemble);

/* ways[n x n], row by row: what couplings in the modes of the state leave of a velocity of each coordinate alone. Evaluates
 * the state. */
void state_find_ways(struct fbd_state *state, double *ways);

#endif
