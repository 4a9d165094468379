/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One scene by the library and by the independent assembly.
 */
#ifndef CROSS_COMPARE_H
#define CROSS_COMPARE_H

#include "absolute.h"
#include "fbd.h"

enum verdict {
    agrees,
    refused, /* the library does not take it */
    forces_differ,
    accelerations_differ,
    terms_differ, /* an equation's sum is not inertia times acceleration */
    run_failed,
    states_differ,
    run_verdicts,
    statics_differ = run_verdicts, /* rest.h */
    linearizations_differ,
    verdict_count,
};

enum { most_arrows = 200 }; /* of a body */

struct outcome {
    enum verdict verdict;
    char what[400];
    double error, size; /* of what differs; size: what it is measured against */
    bool ran, broke_off, sensitive;
    bool pulsed; /* the library has gone over pulses that are shorter than its steps */
    bool jammed; /* it ended where friction leaves no normal force, by both */
    double until;
    double worst_acceleration, worst_force, worst_state; /* relative, of what agrees */
};

/* `until`: 0 for no run. `absolute`: settled at its start; it is moved. */
void scene_compare(const struct scene *scene, struct absolute *absolute, double until,
                   struct outcome *outcome);

/* What a difference of 1e-9 at the start becomes by then: where it grows a thousandfold nothing is asked. */
bool scene_is_sensitive(const struct absolute *start, const struct absolute *end, double until);

/* The library's part, by its public interface; failures go into `outcome`. */
fbd_model *library_model(const struct scene *scene, double until, struct outcome *outcome);
fbd_result *library_run(const fbd_model *model, double until, fbd_simulation **simulation,
                        struct outcome *outcome);
bool state_value(const fbd_state *state, int i, double *z); /* number i of those of the scene */
bool library_state(const struct scene *scene, const fbd_state *state, double *q, double *v);
double library_change(fbd_simulation *simulation);

/* The first thing that differs is kept. */
__attribute__((format(printf, 3, 4))) void outcome_fail(struct outcome *outcome, enum verdict verdict,
                                                        const char *format, ...);

/* The forces on a body against the wrenches of the independent assembly. */
void compare_arrows(const struct absolute *absolute, int b, const fbd_arrow *arrows, size_t count,
                    struct outcome *outcome);

const char *verdict_name(enum verdict verdict);

#endif
