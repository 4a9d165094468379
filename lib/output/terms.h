/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a term is, in a few symbols: the remark beside its value.
 */
#ifndef FBD_OUTPUT_TERMS_H
#define FBD_OUTPUT_TERMS_H

#include "dynamics/state.h"

enum { term_remark_size = 160 };

/* Remark for the term of load `index` in equation `part` of its body: "-m g sin(along)", "N = 16.99 N acts
 * across", "slips: -mu_k N", ... */
void term_remark(struct fbd_state *state, int index, int part, char remark[static term_remark_size]);

/* "sticks" or "slips" for a body with dry friction, else "". */
const char *term_mode(const struct fbd_state *state, int body);

#endif
