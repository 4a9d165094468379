/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FBD_LOOP_ERROR_SCALE_INIT_H
#define FBD_LOOP_ERROR_SCALE_INIT_H

#include "dynamics/instant.h"

struct run;

/* Is coordinate k of a body an angle? */
static inline bool coordinate_turns(const struct model_body *body, int k)
{
    return body->kind == motion_pivot || k == 2;
}

/* How fast the accelerations change: along the motion, or by the time alone, which is what its rounding does to them.
 * `along` has plan_rates entries: the rates of states change likewise. */
void roundoff_changes(struct run *run, const struct instant *at, bool by_time, double *along);

/* Floors for the errors of what is zero at a start; run->roundoff.along is that by the time alone. */
void error_scale_init(struct run *run);

#endif
