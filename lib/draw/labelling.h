/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Labelling: placement of the labels of a drawing, so that they do not overlap and, if possible, do not cover
 * lines.
 *
 * Each label has candidate positions around its anchor, near ones first; each position has a cost (overlaps,
 * distance). The labels are placed one after another, repeatedly, until none moves: a descent that
 * terminates, since every move lowers the sum of costs. The result is deterministic.
 */
#ifndef FBD_DRAW_LABELLING_H
#define FBD_DRAW_LABELLING_H

#include "base/arena.h"
#include "draw/svg.h"

struct label_place {
    const char *text;
    struct vec anchor; /* the labelled point */
    struct vec toward; /* unit vector of the preferred direction, or zero: any direction */
    double gap;        /* the least distance from the anchor to the text */
    struct vec size;
    struct vec center; /* the result */
    bool leader;       /* far from the anchor: draw a line to it */
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

/* Add a line that labels should not cover. */
void labelling_avoid(struct labelling *labelling, struct vec from, struct vec to, double cost);

/* The sum of the costs of the lines that a segment crosses or nearly touches. */
double labelling_crossed(const struct labelling *labelling, struct vec from, struct vec to);

/* Choose all centres. Returns false when memory ran out while the labels were added. */
bool labelling_solve(struct labelling *labelling);

/* The end of a label's leader: the point of its rectangle nearest to its anchor. */
struct vec labelling_leader(const struct label_place *label);

/* The rectangle covered by a label. */
struct box labelling_box(const struct label_place *label);

#endif
