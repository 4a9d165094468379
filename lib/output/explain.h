/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The plan in words, in two parts: what is simulated and what is not (explain.c), and how (explain_plan.c).
 */
#ifndef FBD_OUTPUT_EXPLAIN_H
#define FBD_OUTPUT_EXPLAIN_H

#include "base/text.h"
#include "dynamics/rates.h"

/* The right-hand side with its rows at the start, events, structure. `rates` are in the modes of the
 * start. */
void explain_plan(struct text *text, const struct fbd_model *model, const struct rates *rates);

#endif
