/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Model texts of random trees: every kind of joint and of load, for tests of what must hold for all of them.
 */
#ifndef FBD_TESTS_RANDOM_TREES_H
#define FBD_TESTS_RANDOM_TREES_H

#include "random_numbers.h"

#include <stdbool.h>

struct random_tree {
    int bodies;
    bool conservative; /* gravity and springs alone */
    bool friction;     /* two-sided guides with dry friction, and dry bearings */
    int loops;         /* rods and ropes that close loops */
    bool pivots;       /* every joint is a pivot */
};

/* The text of a tree; release it with free(). */
char *random_tree_text(struct random_numbers *numbers, const struct random_tree *tree);

#endif
