/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The remark beside the value of a term: its law (laws.h) or a few words.
 */
#ifndef FBD_OUTPUT_TERMS_H
#define FBD_OUTPUT_TERMS_H

#include "output/equations.h"

enum { term_remark_size = 160 };

/* Remark for a term of an equation: "-m g sin(along)", "N = 16.99 N acts across", "slips: -mu_k N", ...;
 * empty for loads listed by other bodies, and for a body cut free. False when memory is out. */
bool equation_remark(struct fbd_state *state, const struct equation *equation, size_t term,
                     char remark[static term_remark_size]);

/* "sticks" or "slips" for a body with dry friction, else "". */
const char *term_mode(const struct fbd_state *state, int body);

#endif
