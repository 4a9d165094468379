/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Formulas: an assembled equation in the symbols of the scene (symbols.h), as written by hand, "m v_dot = -m
 * g sin(phi) - mu_k N + push".
 *
 * A term with a textbook law is written as that law (laws.h); the angle of a slide is named after the
 * parameter of the file with its value. Any other term is written by its symbol. A symbol alone is the size
 * of the force, with the sign of derivations by hand (hand_forces.h): a normal force is positive in
 * compression, friction against +x, a rope in tension. It is written so where the force acts along one line
 * at all times; else with the axis of the component, R_1x, where a symbol represents one vector, and the body
 * with the opposite force has a minus sign. M_G(R_1) is a moment that has no arm (moments.h). Terms that are
 * zero at all times are omitted.
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
    bool slipping; /* slipping friction is written as mu_k N */
};

/* True if there are bodies whose free-body equations are written in symbols: joined ones, with `components`
 * all. False for scenes of many bodies, as numbering takes the square of their number. */
bool equations_cut_free(const struct fbd_model *model, bool components);

/* True if all equations of body b, including reactions, are written in symbols. */
bool body_is_cut_free(const struct fbd_model *model, int b, bool components);

/* True if this equation of body b is written in symbols. Of a body cut free: those of its coordinates if it
 * moves on the ground, and the sums of forces along x and y of the world and of moments about G that are not
 * among these. Of other bodies: those of their coordinates. */
bool equation_is_written(const struct fbd_model *model, int b, bool cut_free, int part, bool components);

/* The same, but false if all terms are zero. */
bool equation_in_symbols(const struct fbd_model *model, const struct equation *equation, bool components);

/* The same for the equation in direction `part` of a body cut free; `all` may be NULL. */
bool newton_in_symbols(const struct fbd_model *model, const fbd_equations *all, int b, int part,
                       bool components);

/* False when memory is out; call formulas_end in any case. */
bool formulas_begin(struct formulas *formulas, struct fbd_state *state);
void formulas_end(struct formulas *formulas);

/* The symbol of a body's own quantity: I_O, or I_O2 where there are several bodies; L, L_2. NULL when memory is out. */
const char *symbol_of_body(struct formulas *formulas, const char *name, int body);

/* A slope: the parameter that has its value, else in degrees. */
const char *slope_of(struct formulas *formulas, struct vec e);

/* Append a term, which may have a minus sign, to a sum; "" is zero. NULL when memory is out, or if one of
 * them is. */
const char *formula_add(struct formulas *formulas, const char *sum, const char *term);

/* The right side of an equation, "-m g sin(phi) + push"; and its left side, "m v_dot". NULL when memory is out. */
const char *formula_right(struct formulas *formulas, const struct equation *equation);
const char *formula_left(struct formulas *formulas, const struct equation *equation);

/* Both sides, "m v_dot = -m g sin(phi) + push". */
const char *formula_line(struct formulas *formulas, const struct equation *equation);

/* One term, by its name, valid at every time: friction as `f` in both modes, reactions by their components. A
 * force that stays on the line of the slide is its component along x, by its symbol alone; a moment is
 * counter-clockwise. NULL when memory is out; "" for a moment in an equation of forces. */
const char *formula_term(struct formulas *formulas, const struct equation *equation, const char *name);

#endif
