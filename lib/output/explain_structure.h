/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Describe the structure that a run of the scene exploits.
 */
#ifndef FBD_OUTPUT_EXPLAIN_STRUCTURE_H
#define FBD_OUTPUT_EXPLAIN_STRUCTURE_H

#include "base/text.h"
#include "model/model.h"

/* Write the rest of the last section of explain_plan. False when memory is out. */
bool explain_structure(struct text *text, const struct fbd_model *model, const fbd_options *options);

#endif
