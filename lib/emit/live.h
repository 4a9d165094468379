/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parameters of the file that become parameters of the program: see live.c.
 */
#ifndef FBD_EMIT_LIVE_H
#define FBD_EMIT_LIVE_H

#include "document/node.h"
#include "emit/emit.h"

/* Read the file once more. Returns false when memory is out; close it also then. */
bool emit_live_open(struct emitter *emitter);
void emit_live_close(struct emitter *emitter);

/* The expression of a number by parameters if its value is bitwise equal, else its digits. */
const char *emit_live_number(struct emitter *emitter, double value, struct emit_origin origin);

/* The value of a key of an entry, or NULL. */
const struct node *emit_live_find(const struct emitter *emitter, struct emit_origin origin);

/* The same for a pair [x, y]; NULL if it must be digits. */
const char *emit_live_vector(struct emitter *emitter, const struct node *node, struct vec value);

/* Evaluate a pair; returns false if it cannot be read here. */
bool emit_live_pair(struct emitter *emitter, const struct node *node, struct vec *value);

/* Mark the texts of the rods of body b as contained in other numbers, because one of its points is written by
 * digits. */
void emit_live_spoil_body(struct emitter *emitter, int b);

/* Find the formula of `given` with parameters as variables; emit_live returns it, or `given` if there is
 * none. */
void emit_live_formula(struct emitter *emitter, const struct expr *given, struct emit_origin origin);
const struct expr *emit_live(const struct emitter *emitter, const struct expr *given);

void emit_live_event(struct emitter *emitter, const struct user_event *event);

/* The magnitude of gravity; NULL if gravity does not point straight down. */
const char *emit_live_gravity(struct emitter *emitter);
struct emit_origin emit_live_start(const struct emitter *emitter, struct pos body, const char *key);

/* True for a slot beyond those of the model; and its C expression: a member of the parameters, or a mass. */
bool emit_is_live(const struct emitter *emitter, int slot);
const char *emit_live_variable(struct emitter *emitter, int slot);

/* Call after writing: returns false if further parameters had to be fixed, so that the text is invalid. */
bool emit_live_settled(struct emitter *emitter);

#endif
