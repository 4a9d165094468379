/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What enclosures of event functions are made from, and those that several kinds need.
 */
#ifndef FBD_EVENTS_OUTLOOK_H
#define FBD_EVENTS_OUTLOOK_H

#include "events/watchers.h"

enum { most_enclosed_units = 4 };

struct outlook {
    const struct fbd_state *state;
    const struct stretch *stretch;
    const struct enclosure *y;
    /* Of each unit of switches that are slid on (dynamics/sliding.h), by how much its shares differ from 1/2. */
    struct enclosure shares[most_enclosed_units];
};

/* With what is slid on as shares say; of one such switch at most in a formula. */
struct enclosure outlook_formula(const struct outlook *outlook, const struct formula *formula);

/* Is the sum of forces in a slot of this body a sum of terms that outlook_slot knows? Forces at points, potentials
 * (whose rates are second derivatives) and forces that joints pass on are not. */
bool outlook_knows(const struct fbd_model *model, int body);

/* The sum of a slot of such a body. */
struct enclosure outlook_slot(const struct outlook *outlook, int body, int slot);

/* The normal force of a friction pair, towards the side on which the surface is. */
struct enclosure outlook_press(const struct outlook *outlook, int pair);

/* Bounds by the mean value theorem, too. */
struct enclosure outlook_centred(const struct outlook *outlook, struct enclosure f);

/* The slide on a switch of the formula, when it is the only one; `slides` is their number. */
const struct slide *outlook_slide(const struct fbd_state *state, const struct formula *formula, int *slides);

/* The value of a formula with that switch on its upper (1) or lower (-1) branch. */
struct enclosure outlook_branch(const struct outlook *outlook, const struct formula *formula,
                                const struct slide *slide, int side);

/* Do the shares of all that is slid on have enclosures: affine surfaces of bodies that move by themselves, under
 * forces that are known? And these, in outlook->shares. */
bool outlook_knows_shares(const struct fbd_state *state);
void outlook_find_shares(struct outlook *outlook);

#endif
