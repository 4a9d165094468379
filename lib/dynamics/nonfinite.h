/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Is every number of a state finite? What is not has a name, which is said: the quantity and its body.
 */
#ifndef FBD_DYNAMICS_NONFINITE_H
#define FBD_DYNAMICS_NONFINITE_H

#include "base/diag.h"
#include "dynamics/state.h"

enum finite { finite_all, finite_not, finite_no_memory };

/* The first number that is not finite. */
struct nonfinite {
    char what[240]; /* "the force `pull` on `block`" */
    double value;
    struct pos at; /* of what it belongs to, in the file */
};

/* Look at an evaluated state: coordinates and rates, what is given to act on the bodies (before what follows
 * from it: accelerations, reactions), and their energies. */
enum finite nonfinite_check(const struct fbd_state *state, struct nonfinite *found);

/* Why a number may not be finite, as the end of a sentence. */
const char *nonfinite_reason(double value);

/* Note a number that is not finite; true when it is one. */
bool nonfinite_note(struct nonfinite *found, double value, struct pos at, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

#endif
