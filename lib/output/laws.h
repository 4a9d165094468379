/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The law of a term: what it is in the symbols of a textbook, true at every state. Report, LaTeX and page have it from
 * here.
 *
 *     m g_x, m g_y   components of the weight, where gravity has both; else m g with its sign
 *     along          the angle of a slide; r_x, r_y: from the axis O of a pivot to G; L = |OG|
 *     (..)_x         the component of a vector along the x axis of the equation; v, w: velocities of the body and the wind
 *     a_Ox, a_Oy     acceleration of the axis of a body on a body
 *     u_x            velocity of the mass that leaves or comes, relative to the body
 */
#ifndef FBD_OUTPUT_LAWS_H
#define FBD_OUTPUT_LAWS_H

#include "output/equations.h"

/* The names of the mass, the slope of a slide, and |OG|. */
struct law_names {
    const char *mass, *along, *L;
};

/* "-m g sin(along)", "-k (x - x0)"; nothing for a term that has no law of such symbols, or is zero by it. Of a body that is
 * cut free the weight alone has one. */
void law_write(struct text *text, const struct fbd_model *model, const struct equation *equation, size_t term,
               const struct law_names *names);

/* Is it one of the loads that the body itself lists? */
bool body_lists(const struct fbd_model *model, int body, int load);

#endif
