/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Event functions that are f = c + sum_k a_k y_k while the modes last.
 *
 * Examples are the gap of a disc or a point at a line of the ground, the distance to a stop, the speed of a pair
 * on a surface of constant speed, and the distance to the friction limit while it sticks, with constant normal
 * loads and tangential springs and dampers. Where a step is a
 * polynomial, f is one: its bounds are those of one polynomial instead of a formula of intervals, and its
 * zero is found without samples.
 */
#ifndef FBD_EVENTS_AFFINE_H
#define FBD_EVENTS_AFFINE_H

#include "dynamics/state.h"
#include "events/trajectory_poly.h"

enum { affine_most_terms = 4 };

struct watcher;
struct watchers;

struct affine {
    bool known;
    double constant;
    double limit, roundings; /* f may be negative by so many roundings of the limit and of sum |a_k y_k| */
    int count;
    struct {
        int component; /* of y */
        double factor;
    } terms[affine_most_terms];
    /* Over a piece of the trajectory: */
    unsigned long piece; /* its number, 0: none */
    double middle, per;  /* s = (t - middle) per */
    int top;             /* highest power of s, below zero where the trajectory is not followed */
    int rough;           /* highest power that suffices over long stretches */
    double power[trajectory_most_powers + 1];
    double extent; /* sum of the sizes of terms */
    double doubt, slack;
    double bend, rest; /* bound of |f''|, with d/ds; the part of it outside the rough polynomial */
};

/* Set f to the function of a watcher in the modes of `state`. */
void affine_find(const struct watchers *watchers, const struct fbd_state *state,
                 const struct watcher *watcher, struct affine *f);

/* Is the gap of a contact pair affine in all modes? Flags the components of y that it reads in `used`, or NULL. */
bool affine_mark_gap(const struct fbd_model *model, int index, bool *used);

/* The ranges of f, for motions within the ranges y. */
struct enclosure affine_over(const struct affine *f, const struct enclosure *y);

/* f and its rate at a state with the derivative dy. */
double affine_value(const struct affine *f, const double *y, const double *dy, double *rate);

/* Enclose f over a stretch of the present piece of the trajectory; false where it is not followed. */
bool affine_enclose(struct affine *f, const struct trajectory *trajectory, const struct stretch *stretch,
                    struct enclosure *out);

/* The time at which f becomes negative within [low, high] of the present piece, to rounding; NAN if f does
 * not change sign between the ends, or the trajectory is not that of the method itself. */
double affine_zero(struct affine *f, const struct trajectory *trajectory, double low, double high);

#endif
