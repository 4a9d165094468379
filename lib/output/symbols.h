/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Symbols: the textbook letters of the forces of the scene: m g, N, mu_k N, T_1, R_2.
 *
 * A force and its opposite on another body have one symbol. It denotes the force on the body in whose joint
 * or list it is, of a coupling that on the first of its bodies. A rope that passes over corners has one
 * symbol for its pulls, and `F` for its force at a point of a body that it passes over. Letters shared by
 * several forces are numbered in the order of the bodies; so are masses if there are several bodies. A force
 * with a name in the file (an applied force) keeps that name.
 *
 * In plain text: factors separated by blanks, an index after `_`, Greek letters by name.
 */
#ifndef FBD_OUTPUT_SYMBOLS_H
#define FBD_OUTPUT_SYMBOLS_H

#include "base/arena.h"
#include "base/text.h"
#include "dynamics/diagram.h"
#include "dynamics/state.h"

struct force_symbol {
    const char *text;     /* N, T_1, m g */
    const char *slipping; /* mu_k N while it slips; else NULL */
    bool moment;          /* it is a pure moment at all times */
    bool opposite;        /* the arrow is minus the force of the symbol */
    const char *letter;   /* N of N_1 */
    int joint;            /* the body in whose joint it acts, or -1 */
};

/* The coupling of a named force on body b: its index, its end there, and which of two forces it is; false for
 * none. */
struct coupling_place {
    int coupling, end, part, strand;
};
bool coupling_of_force(const struct fbd_model *model, int b, const char *name, struct coupling_place *place);

/* The class of the drawing of an arrow on body b by its name and load (-1 for none): that of its law, "friction" along the
 * surface of a contact or roll, else "reaction". */
const char *drawing_of_force(const struct fbd_model *model, int b, const char *name, int load);

/* The symbols of each body's arrows, in the order of diagram_fill: symbols[body][arrow]. NULL when memory is out. */
const struct force_symbol *const *symbols_of_forces(const struct fbd_state *state, struct arena *arena);

/* The symbol in the present state. */
const char *symbol_now(const struct force_symbol *symbol);

/* The mass of a body: the parameter that the file gives as its mass ("M", "m_cart"), else "m", with several bodies "m_2". */
const char *symbol_of_mass(const struct fbd_model *model, int body, struct arena *arena);

/* The symbol as printed in a drawing: mg, μₖN, T₁. */
const char *symbol_printed(const char *symbol, struct arena *arena);

/* The symbol as LaTeX; \mathit for more than one letter. */
void symbol_write_latex(struct text *text, const char *symbol);

#endif
