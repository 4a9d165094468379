/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * An equation between outputs of a run (row_columns.h), as `ball.x = 12 m` or `max(ball.y) - R = 2*R`.
 *
 * It is an expression of the language whose names are outputs: coordinates, rates and points at the end of the
 * run, extremes, times and numbers of events, energies, works, parameters. Each of them becomes a column of
 * the rows, and the equation is evaluated from their values; so it has the values of a table of fbd-sweep.
 */
#ifndef FBD_BATCH_ROW_FORMULA_H
#define FBD_BATCH_ROW_FORMULA_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "base/diag.h"

struct rows;
struct row_formula;

/* Find the outputs that a text names; columns of these names are required. NULL with a note in `errors`
 * (`bad-find`) if it is no equation, or memory is out. Memory comes from `arena`. */
struct row_formula *row_formula_read(struct arena *arena, const char *text, fbd_errors *errors);
const char *const *row_formula_outputs(const struct row_formula *formula, size_t *count);

/* Compile it for rows prepared with these outputs. Returns false with notes in `errors`, those of an
 * expression. */
bool row_formula_compile(struct row_formula *formula, const struct rows *rows, fbd_errors *errors);

/* Left side minus right side [*unit], from the values of the columns; NAN where one has no value. */
double row_formula_value(const struct row_formula *formula, const double *values);
const char *row_formula_unit(const struct row_formula *formula);

/* Does it name times of events and quantities at events only, which a run has that ends early, too? */
bool row_formula_of_events(const struct row_formula *formula);

#endif
