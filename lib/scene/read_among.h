/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The entries of `contacts` one by one, where `among` stands for all pairs of a list: of all bodies that have an outline and
 * all lines and polygons of the ground, or of those listed. Left out are pairs
 *
 *   of the ground with itself,
 *   that are joined: a body moves on the other one, along the line, or a pin, weld, gear, rack, roll or slot connects them,
 *   of two particles, in `among: all`,
 *   that `between` of another entry names, or an earlier `among` has.
 */
#ifndef FBD_SCENE_READ_AMONG_H
#define FBD_SCENE_READ_AMONG_H

#include "scene/reader.h"

/* One pair: `between` and `name` are NULL where the entry has its own. */
struct contact_pair {
    const struct node *entry, *between;
    const char *name;
};

struct contact_pairs {
    struct contact_pair *pairs;
    size_t count;
};

/* An upper bound of the number of pairs; false after an error: one entry has more than 20,000. */
bool contact_pairs_count(struct reader *reader, const struct node *contacts, size_t *most);

/* List the pairs; room for all of them is there. Couplings were read before, since they join bodies. False after an
 * error: `wrong-type`, `unknown-body`, `conflicting-keys`. */
bool contact_pairs_list(struct reader *reader, const struct node *contacts, struct contact_pairs *list);

#endif
