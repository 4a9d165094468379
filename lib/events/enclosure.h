/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Input of enclosures of event functions, and the enclosures used by several kinds.
 */
#ifndef FBD_EVENTS_ENCLOSURE_H
#define FBD_EVENTS_ENCLOSURE_H

#include "events/watchers.h"

enum { most_enclosed_units = 4 };

struct enclosure_input {
    const struct fbd_state *state;
    const struct stretch *stretch;
    const struct enclosure *y;
    /* For each unit of switches in a Filippov sliding mode (dynamics/sliding.h): the difference of its weight
     * from 1/2. */
    struct enclosure shares[most_enclosed_units];
};

/* Enclosure of a formula, with the weights of a sliding mode; for at most one such switch in the formula. */
struct enclosure enclose_formula(const struct enclosure_input *input, const struct formula *formula);

/* The sum of the forces along a coordinate with a scalar equation (plan.h), without friction. */
struct enclosure enclose_force(const struct enclosure_input *input, int coordinate);

/* The normal force of a friction pair, towards the side of the surface. */
struct enclosure enclose_normal_force(const struct enclosure_input *input, int pair);

/* Tighten f by the bounds of the mean value theorem. */
struct enclosure enclose_centred(const struct enclosure_input *input, struct enclosure f);

/* The sliding mode on a switch of the formula, if it is the only one; `slides` is their number. */
const struct slide *enclose_filippov(const struct fbd_state *state, const struct formula *formula,
                                     int *slides);

/* The value of a formula with that switch on its upper (1) or lower (-1) branch. */
struct enclosure enclose_branch(const struct enclosure_input *input, const struct formula *formula,
                                const struct slide *slide, int side);

/* Do the weights of all sliding modes have enclosures (affine surfaces of bodies without joints or couplings,
 * under forces with enclosures)? The second function sets them in input->shares. */
bool enclosure_has_weights(const struct fbd_state *state);
void enclosure_find_weights(struct enclosure_input *input);

#endif
