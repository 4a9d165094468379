/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The texts of the file whose expressions the program contains, and the parameters that occur in other texts.
 */
#ifndef FBD_EMIT_LIVE_TEXTS_H
#define FBD_EMIT_LIVE_TEXTS_H

#include "emit/live.h"

struct live_pair {
    const struct expr *given, *live;
    const struct live_pair *before;
};

struct live_node {
    const struct node *node;
    const struct live_node *before;
};

struct live {
    struct document document;
    int first;         /* slot of the first parameter; then that of g, then masses of bodies */
    bool *used;        /* by parameter; then g */
    const char **name; /* members of struct parameters */
    bool *defined;
    double *y; /* values of all slots from 1 on */
    int slots;
    const struct live_pair *pairs;
    const struct live_node *taken, *spoilt;
    bool pulls_down; /* gravity is given by its magnitude */
};

/* The node at a position of the file: the value of the key there, or the value itself. */
const struct node *texts_find_at(const struct node *node, struct pos at);

/* The text of a number or formula, or NULL. */
const struct node *texts_find(const struct live *live, struct emit_origin origin);

/* Mark a text as taken over; or as also used in another number. */
void texts_take(struct emitter *emitter, const struct node *node);
void texts_spoil(struct emitter *emitter, const struct node *node);
void texts_spoil_all(struct emitter *emitter, const struct node *node);

#endif
