/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The plan in words, in two parts: the simulated and neglected effects (explain.c), and the method
 * (explain_plan.c).
 */
#ifndef FBD_OUTPUT_EXPLAIN_H
#define FBD_OUTPUT_EXPLAIN_H

#include "base/text.h"
#include "dynamics/rates.h"

/* Write the right-hand side with its rows at the start, events, structure. `rates` are in the modes of the
 * start. */
void explain_plan(struct text *text, const struct fbd_model *model, const struct rates *rates);

#endif
