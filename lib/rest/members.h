/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Members of trusses and frames: a link that is loaded at two points only carries one force, along
 * the line of both points.
 *
 *   rod, rope   by its multiplier (rest_tension)
 *   body        its forces act at two points A and B, without a couple, and equilibrium gives F_A = -F_B along AB:
 *               the tension is F_B . (B - A)/|B - A|. Each point has a reaction, of a joint, a coupling or a contact;
 *               a body with weight has a third point, G, and a distributed load acts along its line.
 */
#ifndef FBD_REST_MEMBERS_H
#define FBD_REST_MEMBERS_H

#include "rest/statics.h"

/* List the members into statics->members, after the diagrams. Returns false when memory is out. */
bool rest_find_members(struct fbd_statics *statics);

#endif
