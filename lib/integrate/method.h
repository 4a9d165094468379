/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Table of the integration methods by name.
 */
#ifndef FBD_INTEGRATE_METHOD_H
#define FBD_INTEGRATE_METHOD_H

#include <gsl/gsl_odeiv2.h>
#include <stdbool.h>
#include <stddef.h>

/* For more states the dense algebra of the stiff method costs more than it could save. */
enum { method_most_stiff_states = 200 };

struct method {
    const char *name;
    const char *description; /* one line without a full stop */
    const gsl_odeiv2_step_type *const *type;
    int order;          /* of the result; the highest one of a method of variable order */
    int estimate_order; /* its error estimate is O(h^estimate_order); 0: present order + 1 */
    bool implicit;      /* requires the Jacobian */
    bool multistep;     /* uses earlier steps: cannot redo part of a step, must be reset after an event */
    bool needs_driver;  /* reads the error level of a driver's control */
    double stable;      /* stable for h lambda in [-stable, 0]; 0: implicit, or estimated (rk8pd, dop853) */
    double by_time;     /* as in struct step_law: for methods that lose their order where forces are stiff */
    bool exact;         /* dense output agrees with parts of a step, and a first step may have any length */
};

/* Method number `index` in the order of preference; NULL beyond the last one. Number 0 is the default. */
const struct method *method_at(size_t index);

/* The method called `name`, or NULL. */
const struct method *method_find(const char *name);

#endif
