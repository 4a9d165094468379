/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The terms of symbolic equations that are zero in the present modes, in words: N_2 = f_2 = 0 while out of contact.
 */
#ifndef FBD_OUTPUT_IDLE_LINES_H
#define FBD_OUTPUT_IDLE_LINES_H

#include "output/formulas.h"

enum idle { idle_contact, idle_rope, idle_before, idle_after, idle_kinds };

struct idle_line {
    const char *symbols; /* N_2 = f_2 = 0 */
    const char *when;    /* while out of contact */
};

/* The lines of body b; returns their number. symbols is NULL when memory is out. */
int idle_lines(struct formulas *formulas, int b, struct idle_line lines[static idle_kinds]);

#endif
