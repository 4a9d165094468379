/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Division of a scene into islands.
 *
 * Two bodies belong to one island when an expression of a force on one reads a coordinate of the other, when
 * one moves on the other, when a coupling joins them, or when a user event reads both: the connected
 * components of that graph. The equations of motion of an island contain no coordinate of another one, so
 * each may be integrated independently.
 */
#ifndef FBD_LOOP_ISLANDS_H
#define FBD_LOOP_ISLANDS_H

#include "model/group.h"

struct islands {
    size_t count;                 /* islands, in the order of their first bodies */
    struct selection *selections; /* count */
    int *memory;
};

/* Divide the scene of a model; an event that reads no coordinate belongs to the first island. False when
 * memory is out. Call islands_free in any case. */
bool islands_make(struct islands *division, const struct fbd_model *model);
void islands_free(struct islands *division);

#endif
