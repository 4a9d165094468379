/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The structure that a run of the scene makes use of, in words.
 */
#ifndef FBD_OUTPUT_EXPLAIN_STRUCTURE_H
#define FBD_OUTPUT_EXPLAIN_STRUCTURE_H

#include "base/text.h"
#include "model/model.h"

/* Write the rest of the section that explain_plan ends with. False when memory is out. */
bool explain_structure(struct text *text, const struct fbd_model *model, const fbd_options *options);

#endif
