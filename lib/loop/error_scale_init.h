/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FBD_LOOP_ERROR_SCALE_INIT_H
#define FBD_LOOP_ERROR_SCALE_INIT_H

#include "dynamics/instant.h"

struct run;

/* Rates of change of accelerations and rates of user states: along the motion, or by time alone (the effect
 * of a rounding of time). `along` has plan_rates entries. */
void roundoff_changes(struct run *run, const struct instant *at, bool by_time, double *along);

/* Set error floors for components that are zero at a start; run->roundoff.along is then the derivative by
 * time alone. */
void error_scale_init(struct run *run);

#endif
