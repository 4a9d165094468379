/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Symbols: the letters that a textbook gives to the forces of a scene: m g, N, mu_k N, T_1, R_2.
 *
 * A force and its opposite on another body have one symbol. It stands for the force on the body whose joint or list it is
 * in, of a coupling for that on the first of its bodies. A rope that turns corners has one symbol for its pulls, and `F` for
 * its force where it goes round a point of a body. Letters that stand for several forces are numbered in the order of
 * the bodies; so are masses where there are several bodies. A force with a name in the file (an applied force)
 * keeps that name.
 *
 * Written plainly: factors apart by blanks, an index behind `_`, Greek letters by name.
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
    bool moment;          /* it is a moment at all times, and no force */
    bool opposite;        /* the arrow is minus that for which it stands */
    const char *letter;   /* N of N_1 */
    int joint;            /* the body in whose joint it acts, or -1 */
};

/* The coupling whose force on body b is called so: its index, its end there, and which of two forces it is; false for none. */
struct coupling_place {
    int coupling, end, part, strand;
};
bool coupling_of_force(const struct fbd_model *model, int b, const char *name, struct coupling_place *place);

/* The symbols of each body's arrows, in the order of diagram_fill: symbols[body][arrow]. NULL when memory is out. */
const struct force_symbol *const *symbols_of_forces(const struct fbd_state *state, struct arena *arena);

/* As a diagram of this state has it. */
const char *symbol_now(const struct force_symbol *symbol);

/* The mass of a body: "m", "m_2". */
const char *symbol_of_mass(const struct fbd_model *model, int body, struct arena *arena);

/* As it is printed in a drawing: mg, μₖN, T₁. */
const char *symbol_printed(const char *symbol, struct arena *arena);

/* As LaTeX; \mathit for what is longer than a letter. */
void symbol_write_latex(struct text *text, const char *symbol);

#endif
