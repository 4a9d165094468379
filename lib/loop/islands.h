/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Division of a scene into groups that know nothing of each other.
 *
 * Two bodies belong together when an expression of a force on one reads a coordinate of the other, when one
 * moves on the other, when a coupling joins them, or when a user event
 * reads both: the connected components of that graph. The equations
 * of motion of a group contain no coordinate of another one, so the solution of the whole is that of its
 * groups side by side, and each may be integrated by itself.
 */
#ifndef FBD_LOOP_ISLANDS_H
#define FBD_LOOP_ISLANDS_H

#include "model/group.h"

struct islands {
    size_t count;                 /* groups, in the order of their first bodies */
    struct selection *selections; /* count */
    int *group_of_body, *group_of_event, *group_of_coupling, *group_of_constraint, *group_of_absolute;
    int *memory;
};

/* Divide the scene of a model; an event that reads no coordinate goes with the first group. False when memory
 * is out. To be freed with islands_free in any case. */
bool islands_make(struct islands *division, const struct fbd_model *model);
void islands_free(struct islands *division);

#endif
