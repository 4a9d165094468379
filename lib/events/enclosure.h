/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What enclosures of event functions are made from, and those that several kinds need.
 */
#ifndef FBD_EVENTS_ENCLOSURE_H
#define FBD_EVENTS_ENCLOSURE_H

#include "events/watchers.h"

enum { most_enclosed_units = 4 };

struct enclosure_input {
    const struct fbd_state *state;
    const struct stretch *stretch;
    const struct enclosure *y;
    /* Of each unit of switches that are slid on (dynamics/sliding.h), by how much its shares differ from 1/2. */
    struct enclosure shares[most_enclosed_units];
};

/* With what is slid on as shares say; of one such switch at most in a formula. */
struct enclosure enclose_formula(const struct enclosure_input *input, const struct formula *formula);

/* Is the sum of forces in a slot of this body a sum of terms that enclose_slot knows? Forces at points, potentials
 * (whose rates are second derivatives) and forces that joints pass on are not. */
bool enclosure_is_known(const struct fbd_model *model, int body);

/* The sum of a slot of such a body. */
struct enclosure enclose_slot(const struct enclosure_input *input, int body, int slot);

/* The normal force of a friction pair, towards the side on which the surface is. */
struct enclosure enclose_normal_force(const struct enclosure_input *input, int pair);

/* Bounds by the mean value theorem, too. */
struct enclosure enclose_centred(const struct enclosure_input *input, struct enclosure f);

/* The slide on a switch of the formula, when it is the only one; `slides` is their number. */
const struct slide *enclose_filippov(const struct fbd_state *state, const struct formula *formula,
                                     int *slides);

/* The value of a formula with that switch on its upper (1) or lower (-1) branch. */
struct enclosure enclose_branch(const struct enclosure_input *input, const struct formula *formula,
                                const struct slide *slide, int side);

/* Do the shares of all that is slid on have enclosures: affine surfaces of bodies that move by themselves, under
 * forces that are known? And these, in input->shares. */
bool enclosure_has_weights(const struct fbd_state *state);
void enclosure_find_weights(struct enclosure_input *input);

#endif
