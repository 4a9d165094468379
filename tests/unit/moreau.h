/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Time stepping of bodies with stops, ropes, contacts and dry friction, which knows no events: Moreau's, with the
 * gaps at the middle of each step and impulses found by projected Gauss and Seidel (Jean, Comput. Methods Appl. Mech.
 * Eng. 177, 1999; Acary and Brogliato, Numerical Methods for Nonsmooth Dynamical Systems, 2008, chapter 10). Of
 * first order, so that half the step says how far it is off.
 */
#ifndef FBD_TESTS_MOREAU_H
#define FBD_TESTS_MOREAU_H

#include <stdbool.h>
#include <stdint.h>

enum { moreau_most = 15, moreau_most_rows = 64 };

/* What one impulse acts along: w . v is the velocity that it works against. */
enum moreau_kind { moreau_equal, moreau_gap, moreau_rub };

struct moreau_row {
    enum moreau_kind kind;
    double w[moreau_most];
    double e;    /* of a gap: its velocity less the aim after is no less than -e times that before */
    double aim;  /* of what rubs: the velocity at which nothing slips; of others: that of what they meet */
    double most; /* of what rubs: the force or moment it is up to, if there is no `normal` */
    double mu;   /* times the impulse of the row `normal` */
    int normal;  /* -1: none */
    double p;    /* the impulse, set */
};

struct moreau_rows {
    int count;
    struct moreau_row row[moreau_most_rows];
};

struct moreau_system {
    int size;
    const void *scene;
    /* Forces at q, v, t, with what is quadratic in v. */
    void (*forces)(const void *scene, double t, const double *q, const double *v, double *f);
    /* b becomes M^-1 b. */
    void (*solve)(const void *scene, const double *q, double *b);
    /* All that is closed at q, in an order of its own that lasts. */
    void (*rows)(const void *scene, double t, const double *q, struct moreau_rows *rows);
    /* Places out of gaps that have closed by the way of a step; NULL: they stay where they are. */
    void (*lift)(const void *scene, double *q);
};

/* From q, v at t = 0 to `until` in `steps` steps. */
void moreau_run(const struct moreau_system *system, double until, int steps, double *q, double *v);

/* Scenes of `usual` seeds from 1 on, or as many and from where variables NAME and NAME_SEED of the environment say: each is
 * to agree, and no more than one in `most` may be too sensitive to say so. */
void moreau_compare(const char *name, int usual, int most, bool (*agrees)(uint64_t seed, bool *sensitive));

#endif
