/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Common declarations of the files that write the forces on bodies.
 */
#ifndef FBD_EMIT_BODIES_H
#define FBD_EMIT_BODIES_H

#include "emit/emit.h"

/* The coefficients of a slot's sum that occur, and the loads that contribute to them. */
struct slot_terms {
    const char *name; /* its struct terms among the constants; NULL if none */
    bool constant, stiffness, damping, sine, quadratic;
    const char *loads;
};

/* The texts of one body. */
struct body_writer {
    struct emitter *emitter;
    int b;
    const struct model_body *body;
    const char *name;
    struct slot_terms *terms; /* plan.slots */
    struct text lines;        /* formulas and potentials */
    struct text points;       /* forces at points */
};

/* Add a value to a coefficient of the sum of a slot, in derive. */
void add_term(struct body_writer *writer, int slot, const char *coefficient, const char *value,
              const struct load *load);

/* The point of a load in the frame of its body. */
const char *load_point(struct emitter *emitter, const struct model_load *load, const char *body);

/* The other end of a spring or damper: in the frame of `load->partner`, or of the world. */
const char *load_anchor(struct emitter *emitter, const struct model_load *load);

/* The position of one of its texts in the file. */
struct emit_origin load_origin(const struct model_load *load, const char *key, struct dim dim);

/* Write a number of a load; or one of its formulas. */
const char *load_number(struct emitter *emitter, const struct model_load *load, const char *key, double value,
                        struct dim dim);
const char *load_formula(struct emitter *emitter, const struct model_load *load, const char *key,
                         const struct formula *formula, struct dim dim);

static inline const struct mode *mode_of(const struct emitter *emitter, int pair)
{
    return &emitter->model->plan.modes[pair];
}

/* The position of a body's prescribed motion in the file. */
struct emit_origin drive_origin(const struct emitter *emitter, const struct mode *mode);

/* Write a function around its lines, with a cast to void for each unused argument. */
void emit_function(struct text *out, const char *head, const char *arguments, const struct text *lines);

#endif
