/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Symbols of formulas as printed: Greek letters by their names, indices behind `_`, products by a blank: `mu_k N` is μₖN.
 */
#ifndef FBD_BASE_PRINTED_H
#define FBD_BASE_PRINTED_H

#include "base/text.h"

/* The letter "θ" of the name "theta", of that length; NULL for another name. */
const char *greek_letter(const char *name, size_t length);

/* Append the symbol with Greek letters, and indices as far as there are characters for them. */
void text_symbol(struct text *text, const char *symbol);

/* Append the symbol with Greek letters, and each index in braces: "mu_k N" as "μ_{k}N". A drawing sets these lower. */
void text_symbol_indexed(struct text *text, const char *symbol);

#endif
