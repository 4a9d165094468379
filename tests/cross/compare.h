/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One scene by the library and by the independent assembly.
 */
#ifndef CROSS_COMPARE_H
#define CROSS_COMPARE_H

#include "absolute.h"

enum verdict {
    agrees,
    refused, /* the library does not take it */
    forces_differ,
    accelerations_differ,
    terms_differ, /* an equation's sum is not inertia times acceleration */
    run_failed,
    states_differ,
    verdict_count,
};

struct outcome {
    enum verdict verdict;
    char what[400];
    double error, size; /* of what differs; size: what it is measured against */
    bool ran, broke_off, sensitive;
    double until;
    double worst_acceleration, worst_force, worst_state; /* relative, of what agrees */
};

/* `until`: 0 for no run. `absolute`: settled at its start; it is moved. */
void scene_compare(const struct scene *scene, struct absolute *absolute, double until,
                   struct outcome *outcome);

/* As in scene_compare, of a state of the library where `absolute` stands now. */
const char *verdict_name(enum verdict verdict);

#endif
