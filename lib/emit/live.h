/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parameters of the file that stay parameters of the program: see live.c.
 */
#ifndef FBD_EMIT_LIVE_H
#define FBD_EMIT_LIVE_H

#include "emit/emit.h"
#include "scene/node.h"

/* Read the file once more. False when memory is out; close it all the same. */
bool emit_live_open(struct emitter *emitter);
void emit_live_close(struct emitter *emitter);

/* The expression of a number of the file by parameters where that gives it to the bit, else its digits. */
const char *emit_live_number(struct emitter *emitter, double value, struct emit_origin origin);

/* The value behind a key of an entry, or NULL. */
const struct node *emit_live_find(const struct emitter *emitter, struct emit_origin origin);

/* A pair [x, y] likewise, NULL where it has to be digits. */
const char *emit_live_vector(struct emitter *emitter, const struct node *node, struct vec value);

/* The value of a pair; false where it cannot be read here. */
bool emit_live_pair(struct emitter *emitter, const struct node *node, struct vec *value);

/* A point of body b is digits, so what its rods are made of is part of other numbers. */
void emit_live_spoil_body(struct emitter *emitter, int b);

/* Look for the formula of `given` with parameters as variables; emit_live then gives it, else `given`. */
void emit_live_formula(struct emitter *emitter, const struct expr *given, struct emit_origin origin);
const struct expr *emit_live(const struct emitter *emitter, const struct expr *given);

void emit_live_event(struct emitter *emitter, const struct user_event *event);

/* The magnitude of gravity, NULL where it does not pull straight down. */
const char *emit_live_gravity(struct emitter *emitter);
struct emit_origin emit_live_start(const struct emitter *emitter, struct pos body, const char *key);

/* Is a slot beyond those of the model, and its C: a member of the parameters, or a mass. */
bool emit_is_live(const struct emitter *emitter, int slot);
const char *emit_live_variable(struct emitter *emitter, int slot);

/* When all is written: false where parameters had to be given up, which makes what is written wrong. */
bool emit_live_settled(struct emitter *emitter);

#endif
