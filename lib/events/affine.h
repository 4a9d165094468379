/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Affine: event functions that are f = c + sum_k a_k y_k as long as the modes last.
 *
 * So is the speed of a pair on a surface of constant speed, and what is left to the limit of friction while it sticks
 * under constant loads across, springs and dampers along. Where a step is a polynomial, f is one: its bounds are those of
 * one polynomial instead of a formula of intervals for each, and its zero is found without samples.
 */
#ifndef FBD_EVENTS_AFFINE_H
#define FBD_EVENTS_AFFINE_H

#include "dynamics/state.h"
#include "events/trajectory_poly.h"

enum { affine_most_terms = 4 };

struct watcher;

struct affine {
    bool known;
    double constant;
    double limit,
        roundings; /* f is let go below zero by so many roundings of the limit and of sum |a_k y_k| */
    int count;
    struct {
        int component; /* of y */
        double factor;
    } terms[affine_most_terms];
    /* Over a piece of the course: */
    unsigned long piece; /* its number, 0: none */
    double middle, per;  /* s = (t - middle) per */
    int top;             /* of the powers of s, below zero where the course does not tell */
    int rough;           /* of those that tell enough over long stretches */
    double power[trajectory_most_powers + 1];
    double extent; /* sum of the sizes of terms */
    double doubt, slack;
    double bend,
        rest; /* what |f''| is at most, with d/ds; the share of that which the rough one leaves out */
};

/* What the function of a watcher is in the modes of `state`. */
void affine_find(const struct fbd_state *state, const struct watcher *watcher, struct affine *f);

/* f and its rate at a state that changes by dy. */
double affine_value(const struct affine *f, const double *y, const double *dy, double *rate);

/* f over a stretch of the present piece of the course; false where it is not followed there. */
bool affine_enclose(struct affine *f, const struct trajectory *trajectory, const struct stretch *stretch,
                    struct enclosure *out);

/* Where f passes from above to below zero within [low, high] of the present piece, to rounding; NAN where its sign at the
 * ends does not tell that it does, or the course is not that of the method itself. */
double affine_zero(struct affine *f, const struct trajectory *trajectory, double low, double high);

#endif
