/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the files that write the forces on bodies share.
 */
#ifndef FBD_EMIT_BODIES_H
#define FBD_EMIT_BODIES_H

#include "emit/emit.h"

/* Which coefficients the sum of a slot has, and what is in them. */
struct slot_terms {
    const char *name; /* of its struct terms among the constants; NULL without one */
    bool constant, stiffness, damping, sine, quadratic;
    const char *loads;
};

/* What is written of one body. */
struct body_writer {
    struct emitter *emitter;
    int b;
    const struct model_body *body;
    const char *name;
    struct slot_terms *terms; /* plan.slots */
    struct text lines;        /* formulas and potentials */
    struct text points;       /* forces at points */
};

/* Add to a coefficient of the sum of a slot, in derive. */
void add_term(struct body_writer *writer, int slot, const char *coefficient, const char *value,
              const struct load *load);

/* The point of a load in the frame of its body. */
const char *load_point(struct emitter *emitter, const struct model_load *load, const char *body);

/* The other end of a spring or damper: in the frame of `load->partner`, or of the world. */
const char *load_anchor(struct emitter *emitter, const struct model_load *load);

/* Where one of its texts stands. */
struct emit_origin load_origin(const struct model_load *load, const char *key, struct dim dim);

/* A number of a load, and one of its formulas. */
const char *load_number(struct emitter *emitter, const struct model_load *load, const char *key, double value,
                        struct dim dim);
const char *load_formula(struct emitter *emitter, const struct model_load *load, const char *key,
                         const struct formula *formula, struct dim dim);

static inline const struct mode *mode_of(const struct emitter *emitter, int pair)
{
    return &emitter->model->plan.modes[pair];
}

/* Where the file says how a body is driven. */
struct emit_origin drive_origin(const struct emitter *emitter, const struct mode *mode);

/* A function of the program around its lines: what of its arguments they do not use is said so. */
void emit_function(struct text *out, const char *head, const char *arguments, const struct text *lines);

#endif
