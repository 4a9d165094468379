/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Numerical comparison of hand derivations with the assembled equations.
 *
 * A true equation holds at every state and for every value of the parameters. So it is evaluated at random
 * ones: t, coordinates and rates are drawn, and the parameters of the file are changed by up to 30 %, which
 * distinguishes sin from cos at 45 degrees and a forgotten mass of 1 kg from a right answer. A state is
 * admissible where all forces are finite and no surface has a tensile normal force.
 *
 * The equation is linear in the acceleration: left - right = A (a - a_hand). With the inertia I of the
 * coordinate, I (a - a_hand) is the error of the equation as a force or moment, whatever it was divided by.
 * It is zero to rounding, or it is compared with the named terms to find the wrong one.
 */
#ifndef FBD_OUTPUT_HAND_H
#define FBD_OUTPUT_HAND_H

#include <gsl/gsl_rng.h>

#include "base/text.h"
#include "dynamics/diagram.h"
#include "dynamics/modes.h"
#include "output/hand_run.h"

enum {
    most_samples = 512,
    most_terms = 40,
    hand_others = 1 << hand_slots,
    hand_named_forces = 2 << hand_slots
};

/* The unknowns of an equation (hand_form_at). */
enum { hand_unknowns = 32, hand_unknown_force = most_coordinates_of_a_body + 1 };

/* Factors that are often forgotten in derivations, at a state. Those that do not apply are NAN. */
enum hand_factor {
    factor_cos_angle, /* of the coordinate theta */
    factor_sin_angle,
    factor_cos_along, /* of a slide */
    factor_sin_along,
    factor_L,
    factor_m,
    factor_g,
    factor_sign, /* of the rate */
    factor_rate,
    factor_coordinate,
    hand_factors,
};

/* The evaluation of one equation at one admissible state. */
struct hand_sample {
    int slip;               /* of the body's friction; 0 without */
    double lack;            /* I (a - a_hand), or left - right when no acceleration is in it */
    double size;            /* sum of the magnitudes of the terms */
    double mechanics;       /* the same of the assembly alone, where the equation has one acceleration */
    double coefficient;     /* of the acceleration in the equation */
    double I, a, a_hand;    /* inertia and accelerations; I = 0 when no acceleration is in the equation */
    double I_G, m_L2, L;    /* of a pivot */
    double gravity_swapped; /* the term of gravity with sine and cosine exchanged */
    double terms[most_terms];
    double summands[most_summands]; /* of the equation, as forces, to be compared with the terms */
    double factors[hand_factors];
    double t, q[most_coordinates_of_a_body], v[most_coordinates_of_a_body];
    double left, right;
    bool open; /* it depends on a load distribution that the equations do not determine */
};

struct hand_check {
    const struct fbd_model *model;
    int body, index;
    int part;                    /* coordinate of its acceleration, -1 for none */
    unsigned says;               /* bit k: hand slot k is in it; hand_others, hand_named_forces */
    unsigned long long unknowns; /* bit k: on unknown k, see hand_form_at */
    int open_body;               /* body of an indeterminate force in it, */
    char open_force[128];        /* empty where it is the normal force of a surface */
    bool no_memory;
    char elsewhere[64];       /* the actual moment point of a true line that states another one; else "" */
    struct document document; /* source of the drawn states, */
    double spread;
    gsl_rng *rng;
    size_t count;
    struct hand_sample *samples;     /* most_samples */
    bool accelerates[most_summands]; /* this summand is (part of) the left side I a */
    struct hand_run run;             /* of the model, made for the first line of a run */
};

struct hand_named;

/* Sample the equation at random states of the model and of eleven variants whose parameters differ by up to
 * `spread`. False when memory is out. */
bool hand_take_samples(struct hand_check *check, const struct document *document, gsl_rng *rng,
                       double spread);

/* Visit one admissible state: `y` has hand_room entries; `first`: of its model. Return false to stop. */
typedef bool hand_visit(void *context, struct fbd_state *state, const struct hand_named *named, double *y,
                        bool first);

/* Draw states of check->model and of eleven others, as above, and visit each. False when memory is out. */
bool hand_each_state(const struct hand_check *check, gsl_rng *rng, hand_visit *visit, void *context);

/* Variables of a derivation of body b: the state and the further names of enum hand_slot. */
size_t hand_room(const struct fbd_model *model);
void hand_extend(const struct fbd_state *state, int b, const struct hand_named *named, double *y);

/* True if a line depends on a load distribution that the equations do not determine. `size`: sum of the
 * magnitudes of its terms. Then check->open_force is set (hand_unique.c). */
bool hand_is_open(struct hand_check *check, const struct hand *hand, const struct hand_named *named,
                  struct fbd_state *state, double size);

/* Check all derivations of a document against `model`, compiled from it; write a text on each and count those
 * that differ. False when memory is out. */
bool hand_check_document(const struct fbd_model *model, struct document *document, unsigned seed,
                         struct text *text, size_t *differing);

/* Left minus right of one equation at a state; *size: the sum of absolute terms; `form`: as of hand_form_at,
 * or NULL. NAN when memory is out. */
double hand_lack_at(const struct fbd_state *state, int body, int index, double *size, double *form);

/* The coefficients of an equation on body b at a state: d(left - right) / d(unknown k). Unknowns are the
 * accelerations of its coordinates, those of others together, and each component of a force or couple of a
 * diagram (with all normal forces for N). If there are too many, several share an entry (hand_form.c). `y`:
 * as extended. */
void hand_form_at(const struct fbd_state *state, int b, int index, const struct hand_named *named,
                  const double *y, double form[hand_unknowns]);

/* Write in which term the samples of slip `slip` differ from the assembly, or that no single term explains
 * it. */
void hand_diagnose(const struct hand_check *check, int slip, struct text *text);

/* Name the summands of a line that are zero at all samples, where there are several: the line would hold with any of their
 * factors and signs. */
void hand_say_zeros(const struct hand_check *check, struct text *text);

/* Write by which slip of the pen a line differs: the first that explains all states of slip `slip`
 * (hand_blame.c). Returns false if none does. */
bool hand_blame(const struct hand_check *check, int slip, struct text *text);

/* Set check->elsewhere of a line that states its moment point. False when memory is out. */
bool hand_find_point(struct hand_check *check);

/* As hand_diagnose, by comparing the equation's own summands with the terms one by one; false if that is
 * inconclusive. */
bool hand_match(const struct hand_check *check, int slip, struct text *text);

#endif
