/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impacts at several points at one instant as docs/format.md and holds/impacts.h define them: together, by trying all
 * sets of what opens, sticks and slips; or one after the other, by small steps.
 */
#ifndef FBD_TESTS_IMPACTS_BY_SETS_H
#define FBD_TESTS_IMPACTS_BY_SETS_H

#include <stdbool.h>

#include "impact_by_steps.h"

enum { sets_most = 8, sets_rows = 2 * sets_most };

/* Rows 2 i and 2 i + 1 are the normal and the tangent of point i. */
struct points_by_sets {
    int count;
    bool in_turn;
    double W[sets_rows][sets_rows];
    double mu[sets_most], e[sets_most];
    enum law_by_steps
        law[sets_most]; /* of points together, that of the one with restitution that closes fastest */
};

/* Velocities become those after, and impulses are set. False where there is no answer, or more than one. */
bool impacts_by_sets(const struct points_by_sets *points, double *v, double *P);

#endif
