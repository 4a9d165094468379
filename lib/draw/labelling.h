/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Labelling: where the labels of a drawing go, so that none lies on another and, where it can be had, none on
 * a line either.
 *
 * Each label has candidate places around its anchor, near ones first; each place has a cost (what it covers,
 * how far it is). The labels choose in turn, and again with all others in place, until none would move: a
 * descent that ends, since every move lowers the sum. Nothing is random.
 */
#ifndef FBD_DRAW_LABELLING_H
#define FBD_DRAW_LABELLING_H

#include "base/arena.h"
#include "draw/svg.h"

struct label_place {
    const char *text;
    struct vec anchor; /* what it belongs to */
    struct vec toward; /* unit vector where it is wanted, or zero: anywhere around */
    double gap;        /* the least distance from the anchor to the text */
    struct vec size;
    struct vec center; /* the result */
    bool leader;       /* it went so far that a line should lead to it */
};

struct obstacle {
    struct vec from, to;
    double cost; /* of covering it */
};

struct labelling {
    struct arena *arena;
    struct label_place *labels;
    struct obstacle *obstacles;
    size_t label_count, label_room, obstacle_count, obstacle_room;
};

/* Add a label of font size `size`; returns its index. `text` must outlive the labelling. */
size_t labelling_add(struct labelling *labelling, const char *text, double size, struct vec anchor,
                     struct vec toward, double gap);

/* A line that labels should not cover. */
void labelling_avoid(struct labelling *labelling, struct vec from, struct vec to, double cost);

/* Choose all centres. False when memory ran out while the labels were added. */
bool labelling_solve(struct labelling *labelling);

/* The point of the label's rectangle nearest to its anchor, where its leader ends. */
struct vec labelling_leader(const struct label_place *label);

/* The rectangle that a label covers. */
struct box labelling_box(const struct label_place *label);

#endif
