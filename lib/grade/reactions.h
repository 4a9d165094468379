/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reactions: forces of couplings, contacts and guides, in the diagram of the key and in that of an answer.
 *
 * A reaction is compared at one state, the start (or where it is zero there, the first state where it is not). An entry
 * of an answer without a magnitude is compared by its line of action and sense, one with a value by that. The diagram may
 * have components for one reaction, or one force for reactions at one point or of one contact.
 */
#ifndef FBD_GRADE_REACTIONS_H
#define FBD_GRADE_REACTIONS_H

#include "fbd_grade.h"
#include "grade/compare.h"

/* Which of them have to be drawn: found once for the key (false when memory is out), and then taken from it. */
bool reactions_note_asked(struct fbd_key *key, size_t b, const struct sides *sides);
void reactions_take_asked(const struct fbd_key *key, size_t b, struct sides *sides);

/* True if it is zero at all compared states. */
bool reaction_is_nothing(const struct sides *sides, const struct item *key);

enum { most_components = 3, most_support = 4 };

/* Some reactions of the key (or normal forces and friction that it lists) and the answer's entries for them. */
struct support {
    size_t key_count, count;
    struct item *key[most_support], *parts[most_components];
};

/* A kind of match: reactions one by one or several together; drawn by this number of forces, with a direction
 * or without. */
struct search {
    bool together;
    size_t parts;
    bool free;
};

/* All correct supports; some have reactions or forces in common. */
enum { most_supports = 160 };

struct supports {
    size_t count;
    struct support all[most_supports];
};

void supports_find(const struct sides *sides, const struct search *search, struct supports *found);

/* True if they have a reaction or a force in common. */
bool supports_meet(const struct support *a, const struct support *b);

/* The finding about one wrongly drawn reaction, and that reaction. */
struct misdrawn {
    struct item *key, *item, *other; /* `other`: a component that is right, or NULL */
    enum relation relation;
    int rank;
};

/* The likeliest of those with a rank below `below`; false when there is none. */
bool reactions_closest(struct sides *sides, int below, struct misdrawn *found);

/* True for an asked reaction for which only this item is drawn, with the wrong sense. */
bool reaction_is_reversed(struct sides *sides, const struct item *item);

/* True if this is drawn for a reaction that is zero, or for the zero component of one that is right. */
bool is_of_nothing(struct sides *sides, const struct item *item);

/* The values of the unknowns that make up these reactions, by force, for the derivations. */
void support_solve(const struct sides *sides, const struct support *support, double values[most_components]);

#endif
