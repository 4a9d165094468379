/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of diagram forces in derivations by hand.
 *
 * Each arrow of the diagram of a body is referred to by its name and a component, `wrist.x`, `clamp.moment`:
 * the force on this body. The name alone, or its letter in symbols (N, f, T_1), is the magnitude of a force
 * whose direction is known: the same number on both bodies. It is positive
 *
 *     of a rope, a belt, a rod, a spring or damper between points   when it pulls
 *     of a normal force                                             when it presses
 *     of friction     against +x of the motion; on a surface, to the left of an observer standing on it: against
 *                     a motion to the right
 *     of all other forces on a slide or a track                     along +x of it
 *     of a moment                                                   counter-clockwise, of friction clockwise
 *
 * `wrist.at.x` and `wrist.at.y` are its point of application in the world.
 *
 * A letter with a component, `R_x`, `R_2x`, is that of the force of that symbol (symbols.h). A letter without
 * its number is accepted where the body has one such force.
 */
#ifndef FBD_OUTPUT_HAND_FORCES_H
#define FBD_OUTPUT_HAND_FORCES_H

#include "dynamics/diagram.h"
#include "output/symbols.h"

struct hand_force {
    struct force_name name;
    size_t arrow; /* of its body */
    enum hand_force_part {
        hand_force_x,
        hand_force_y,
        hand_force_couple,
        hand_force_at_x, /* point of application */
        hand_force_at_y,
        hand_force_size,
    } part;
    double sign;
    const struct force_symbol *symbol;
};

struct hand_forces {
    size_t count;
    struct hand_force *list; /* in the order of bodies and arrows, letters after the names of each */
};

/* List all names of a model, in the arena; false when memory is out. */
bool hand_forces_make(const struct fbd_model *model, struct arena *arena, struct hand_forces *forces);

/* The value, given the arrows of its body (diagram_fill). */
double hand_force_value(const struct fbd_model *model, const struct hand_force *force,
                        const struct instant *at, const struct arrow *arrows);

/* The forces that derivations of a scene name. */
struct hand_named {
    struct hand_sum {
        size_t count; /* 0 for other absolutes than forces */
        const struct hand_force **forces;
        double *signs;
    } * of;               /* of each absolute of the model */
    struct arrow *arrows; /* diagram_most_arrows */
    double *
        sizes; /* of each absolute: of the forces of its body, or the acceleration due to them; scale of its rounding error */
};

/* Find them, in the arena; false when memory is out. */
bool hand_named_find(const struct fbd_model *model, struct arena *arena, struct hand_named *named);

/* True for those forces, and for section forces, accelerations and inertias that only derivations name. */
bool hand_writes(enum absolute_kind kind);

/* Write the value of each to the entry of its absolute. */
void hand_named_write(const struct fbd_state *state, const struct hand_named *named, double *places);

/* Magnitude of a hand slot due to the forces on body b, as `sizes` of names: of its accelerations, else 0. */
double hand_slot_size(const struct fbd_state *state, int b, int slot, const struct hand_named *named);

/* The rate of name k if it is a work or an impulse. */
double hand_named_rate(const struct fbd_state *state, const struct hand_named *named, size_t k);

/* Give a document the names of a model's forces, in the arena: derivations are then read with them directly.
 * False when memory is out. */
bool hand_forces_list(const struct fbd_model *model, struct arena *arena, struct document *document);

/* Read a document and compile it, as scene_make and model_compile do. Derivations that name forces are read
 * in a second pass, when these are known. */
struct fbd_model *hands_compile(const struct document *document, const struct override *overrides,
                                size_t count, fbd_errors *errors);

#endif
