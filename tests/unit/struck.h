/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies that strike at several points at one instant, for tests that solve their impacts.
 */
#ifndef FBD_TESTS_STRUCK_H
#define FBD_TESTS_STRUCK_H

#include <stdbool.h>

#include "holds/impacts.h"

enum { most_bodies = 6, most_points = 2 * most_bodies, most_unknowns = 2 * most_points };

/* Bodies of mass and inertia 1/w, and the rows of points as velocities of them. */
struct scene {
    int coordinates, points;
    double w[3 * most_bodies], J[most_unknowns][3 * most_bodies], W[most_unknowns * most_unknowns];
    double v[3 * most_bodies]; /* of the coordinates */
    struct impacts_point laws[most_points];
};

/* The test fails where they are further apart. */
void struck_check(double actual, double expected, double tolerance);

/* W of its rows. */
void struck_set_answers(struct scene *scene);

/* Its kinetic energy [J], and the velocity along a row. */
double struck_energy(const struct scene *scene);
double struck_speed(const struct scene *scene, int row);

/* What `strike` has found: impacts that were taken one after the other instead, so far, and whether the last has several
 * solutions. */
extern long struck_in_turn;
extern bool struck_several;

/* Solve, and give the coordinates their velocities. Laws of velocities, and impacts that are asked for one after the
 * other, are never taken in turn instead. `v`, `P`: of 2 rows a point; `work` [J]. */
enum impacts_end strike(struct scene *scene, enum impact_law law, bool one_after_the_other, double *v,
                        double *P, double *work);

#endif
