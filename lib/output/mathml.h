/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Formulas in plain notation (symbols.h) as MathML, for HTML.
 */
#ifndef FBD_OUTPUT_MATHML_H
#define FBD_OUTPUT_MATHML_H

#include "base/text.h"

/* A formula as <math> elements, one for each summand, so that a browser can break the line between them: browsers
 * break no line within an element. `sign`: an operator in front of it, or "". */
void mathml_write(struct text *text, const char *sign, const char *formula);

#endif
