/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The law of a term in textbook symbols, valid at every state; used by report, LaTeX and page.
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

/* Write "-m g sin(along)", "-k (x - x0)", "-k x" where x0 = 0; writes no text for a term that has no such law or is zero by it.
 * For a body cut free, only the weight has one. */
void law_write(struct text *text, const struct fbd_model *model, const struct equation *equation, size_t term,
               const struct law_names *names);

/* True for a load that the body itself lists. */
bool body_lists(const struct fbd_model *model, int body, int load);

#endif
