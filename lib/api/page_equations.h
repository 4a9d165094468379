/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The members of the data of a page about its bodies: their equations, by symbols, and the bodies themselves.
 */
#ifndef FBD_API_PAGE_EQUATIONS_H
#define FBD_API_PAGE_EQUATIONS_H

#include "output/formulas.h"
#include "output/run_record.h"

/* The equations of the start, for their symbols. */
struct symbolic {
    struct formulas formulas;
    fbd_equations *equations;
    const struct equation *now; /* the equation being written, or NULL */
    size_t written;             /* of the body */
};

bool symbolic_begin(struct symbolic *symbolic, const fbd_state *start);
void symbolic_end(struct symbolic *symbolic);

/* The members `equations` and `kinematics` of a body. */
void page_equations_write(struct text *text, struct symbolic *symbolic, const struct record *record, int b);

/* A body of the list `bodies`. */
void page_body_write(struct text *text, struct symbolic *symbolic, const struct record *record, size_t b);

#endif
