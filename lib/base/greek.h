/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Greek letters by their names, as in formulas and names of files.
 */
#ifndef FBD_BASE_GREEK_H
#define FBD_BASE_GREEK_H

#include <stddef.h>

/* The letter "θ" of the name "theta", of that length; NULL for another name. */
const char *greek_letter(const char *name, size_t length);

#endif
