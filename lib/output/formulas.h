/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Formulas: an assembled equation in the symbols of the scene (symbols.h), as one writes it by hand,
 * "m v_dot = -m g sin(phi) - mu_k N + push".
 *
 * A term that is a law of a textbook stands as that law (laws.h); an angle of a slide that a parameter of the file has the
 * value of is called by that parameter. What is none keeps its symbol. By itself a symbol is the size of the force, with the
 * sign that derivations by hand give it (hand_forces.h): a normal force presses, friction acts against +x, a rope pulls. So
 * it stands where the force acts along one line at all times; else with the axis of which it is the component, R_1x,
 * where a symbol stands for one vector, and the body that feels the opposite has a minus sign. M_G(R_1) is a moment that has no arm (moments.h).
 * What is zero at all times is left out.
 */
#ifndef FBD_OUTPUT_FORMULAS_H
#define FBD_OUTPUT_FORMULAS_H

#include "output/equations.h"
#include "output/samples.h"
#include "output/symbols.h"

struct formulas {
    struct arena arena;
    struct fbd_state *state;
    const struct force_symbol *const *symbols;
    struct samples samples;
    bool slipping; /* friction that slips now is mu_k N */
};

/* Are there bodies whose equations, cut free, are written in symbols: joined ones, with `components` all? Numbering takes the
 * square of the bodies, and nobody reads that of a hundred. */
bool equations_cut_free(const struct fbd_model *model, bool components);

/* Are all equations of body b in symbols, reactions and all? */
bool body_is_cut_free(const struct fbd_model *model, int b, bool components);

/* Is the equation of body b one that is written in symbols? Of a body cut free those of its coordinates where it moves on the
 * ground, and besides the sums of forces along x and y of the world and of moments about G that are none of these. Of other
 * bodies those of their coordinates. */
bool equation_is_written(const struct fbd_model *model, int b, bool cut_free, int part, bool components);

/* So, unless all of it is zero. */
bool equation_in_symbols(const struct fbd_model *model, const struct equation *equation, bool components);

/* The same of that in direction `part` of a body cut free; `all` may be NULL. */
bool newton_in_symbols(const struct fbd_model *model, const fbd_equations *all, int b, int part,
                       bool components);

/* False when memory is out; to be ended in any case. */
bool formulas_begin(struct formulas *formulas, struct fbd_state *state);
void formulas_end(struct formulas *formulas);

/* The symbol of a body's own quantity: I_O, or I_O2 where there are several bodies; L, L_2. NULL when memory is out. */
const char *symbol_of_body(struct formulas *formulas, const char *name, int body);

/* A slope: the parameter that has its value, else in degrees. */
const char *slope_of(struct formulas *formulas, struct vec e);

/* A sum and one term more, which may have a minus sign; "" is zero. NULL when memory is out, or one of them is. */
const char *formula_add(struct formulas *formulas, const char *sum, const char *term);

/* The right side of an equation, "-m g sin(phi) + push"; and its left side, "m v_dot". NULL when memory is out. */
const char *formula_right(struct formulas *formulas, const struct equation *equation);
const char *formula_left(struct formulas *formulas, const struct equation *equation);

/* Both sides, "m v_dot = -m g sin(phi) + push". */
const char *formula_line(struct formulas *formulas, const struct equation *equation);

/* One term, by its name, as it stands at every time: friction as `f` whether it slips or holds, reactions by their
 * components; a force that stays on the line of the slide is its component along x by its symbol alone, as a moment is
 * counter-clockwise. NULL when memory is out; "" for a moment in an equation of forces. */
const char *formula_term(struct formulas *formulas, const struct equation *equation, const char *name);

#endif
