/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files that generate couplings share.
 */
#ifndef CROSS_GENERATE_PARTS_H
#define CROSS_GENERATE_PARTS_H

#include "generate.h"
#include "variants.h"

/* generate_couplings.c */
struct coupling *add_coupling(struct scene *scene, enum coupling_kind kind);

/* Bodies alone at their start. */
void start(struct absolute *absolute, const struct scene *scene);

struct vec2 world_of(const struct absolute *absolute, int b, struct vec2 point);

/* A point of body b that is at a place in the world. */
struct vec2 local_of(const struct absolute *absolute, int b, struct vec2 world);

struct end random_end(struct random *random, struct scene *scene, int b);

/* Another body than `b`, or the ground. */
int other_than(struct random *random, const struct scene *scene, int b);

struct vec2 end_world(const struct absolute *absolute, const struct end *end);

/* Perhaps, where the taste is for it. */
void add_friction(struct random *random, struct coupling *coupling, const struct taste *taste);

void add_roll(struct random *random, struct scene *scene, const struct taste *taste);

/* generate_ropes.c */
void add_rope(struct random *random, struct scene *scene);
void add_capstan(struct random *random, struct scene *scene);
void add_spool(struct random *random, struct scene *scene, const struct taste *taste);
void add_steps(struct random *random, struct scene *scene);

/* generate_slots.c */
void add_slot(struct random *random, struct scene *scene, const struct taste *taste);

#endif
