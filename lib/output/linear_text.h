/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Texts of linearisations and of linear systems.
 */
#ifndef FBD_OUTPUT_LINEAR_TEXT_H
#define FBD_OUTPUT_LINEAR_TEXT_H

#include "base/text.h"
#include "rest/linear_system.h"

/* A linearisation as text, and the members of its JSON object without its braces. */
void linear_write_text(struct text *text, const struct fbd_linearization *linear);
void linear_write_json(struct text *text, const struct fbd_linearization *linear);

/* A matrix as a member of a JSON object, with a comma behind it. */
void linear_write_json_matrix(struct text *text, const char *name, const double *values, size_t rows,
                              size_t columns);

/* A matrix as text, row by row. */
void linear_write_rows(struct text *text, const double *values, size_t rows, size_t columns);

/* The unit of an output divided by that of an input: "m/N", "rad/(N*m)", "1/N"; "1" for a pure number. */
void linear_write_unit(struct text *text, const char *output, const char *input);

#endif
