/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A line of a derivation evaluated at one state, for the suspects (hand_suspects.h).
 */
#ifndef FBD_OUTPUT_HAND_LOOK_H
#define FBD_OUTPUT_HAND_LOOK_H

#include "output/hand_suspects.h"

/* Left less right. */
double look_line(const struct suspects_look *look);

const struct model_body *look_body(const struct suspects_look *look);

/* The force of this body that a letter denotes; NULL for a sum, or another body's. */
const struct hand_force *look_force(const struct suspects_look *look, const struct letter *letter,
                                    double *sign);

/* True for a coordinate of the point of application. */
bool look_is_place(const struct hand_force *force);

/* Contribution of a force at a point, and a couple, to an equation of the body: a component, or the moment. */
double look_part(const struct suspects_look *look, struct vec F, struct vec point, double couple,
                 int equation);
double look_term(const struct suspects_look *look, const struct arrow *arrow, int equation);

/* The coefficient of a force of this value in an equation. */
double look_coefficient(const struct suspects_look *look, const struct hand_force *force, double value,
                        int equation);

/* True if the angular acceleration, if it is in the line, has its coefficient of the equation times `factor`
 * (0: unknown). */
bool look_inertia_fits(const struct suspects_look *look, int equation, double factor);

#endif
