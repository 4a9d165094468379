/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Names of section forces, where an output or an equation names one:
 *
 *     M(beam, 0.4 m)         at a distance from the first end, of numbers and parameters: `M(beam, L/2)`
 *     V(beam, load)          at a named point of the body
 *     V(beam, load, behind)  behind a load there; else before it, and at the first end behind it
 *     N(0.4 m)               in a scene of one body
 */
#ifndef FBD_SECTION_NAME_H
#define FBD_SECTION_NAME_H

#include "section/section.h"

/* The symbols N, V, M. */
extern const char *const section_symbols[section_forces];

struct section_name {
    enum section_force force;
    int body;
    const char *place; /* it may depend on the parameters of a model */
    bool behind;
    const char *title; /* without a comma: `M(beam 0.4 m)` */
};

/* Has the text the form of such a name? */
bool section_is_name(const char *text);

/* Read it; false with a note: `bad-place`, `unknown-body`, `no-section` for a body that is not straight, or those of an
 * expression. A place beyond the ends is refused where its value is asked for, since both depend on the parameters. Texts are
 * in the arena. */
bool section_name_read(const struct fbd_model *model, struct arena *arena, const char *text,
                       struct section_name *name, fbd_errors *errors);

/* The value at an evaluated state, of this or another model of the file; NAN with a note. */
double section_name_value(const struct section_name *name, const struct fbd_state *state, bool at_rest,
                          fbd_errors *errors);

/* The number of a body; -1 with a note. */
int section_body(const struct fbd_model *model, const char *name, fbd_errors *errors);

/* Is the body straight, with a section at x? False with a note, on the place at `at`. */
bool section_exists(const struct fbd_model *model, int body, double x, struct pos at, fbd_errors *errors);

/* The distance of a place from the first end, of numbers and parameters, or a named point; NAN with a note. */
double section_place(const fbd_section *section, const char *text, fbd_errors *errors);

#endif
