/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Chains of two and three links by Lagrange's equations, in the angles of the links in the world. With d_i
 * the vector from the O of link i to that of the next, h the mass times the vector to the centre of the last
 * link, in the world, and C_i = d_i . h, X_i = d_i x h, the last row is
 *
 *     I alpha = tau - sum_i (C_i alpha_i + X_i omega_i^2)
 *
 * and eliminates alpha. The inertia of the last link that remains between links i and j is
 *
 *     m d_i . d_j - C_i C_j / I = across d_i . d_j + X_i X_j / I,    across = m I_G / I, I = I_G + h^2 / m:
 *
 * in this form there is no cancellation for a bob on a light cart. A slide on the ground is a row with its
 * direction e for d and a force for the moment.
 */
#include "dynamics/tree_short.h"

#include "base/simd2_sine.h"

static inline double moment_of_forces(const struct tree_link *link, struct vec turn)
{
    return link->sine * turn.y + link->cosine * turn.x;
}

static inline double square(double x)
{
    return x * x;
}

struct tree_pole tree_pole_of(const struct tree_link *links)
{
    const struct tree_link *slide = &links[0], *pole = &links[1];
    return (struct tree_pole){.x = slide->coordinate,
                              .q = pole->coordinate,
                              .along = slide->along + pole->along,
                              .P = vec_dot(pole->moment, slide->e),
                              .Q = vec_cross(pole->moment, slide->e),
                              .sine = pole->sine,
                              .cosine = pole->cosine,
                              .D = pole->inverse_I_O,
                              .mass = slide->mass + pole->across,
                              .force = vec_dot(slide->e, vec_add(slide->force, pole->force))};
}

/* The O of the pole moves along e as the end of a d with k x d = e: C = h x e, X = h . e. */
void tree_pole(const struct tree_pole *pole, double force, double moment, const double *y, const double *v,
               double *a)
{
    struct vec turn = unit_by_sine(pole->along + y[pole->q]);
    double C = pole->Q * turn.x - pole->P * turn.y, X = pole->P * turn.x + pole->Q * turn.y, D = pole->D;
    double u = D * (moment + pole->sine * turn.y + pole->cosine * turn.x);
    double own = (force + pole->force + square(v[pole->q]) * X - C * u) / (pole->mass + D * X * X);
    a[pole->x] = own;
    a[pole->q] = u - D * C * own;
}

void tree_two_pivots(const struct tree_link *links, const struct tree_bare *s, const double *y,
                     const double *v, double *a)
{
    const struct tree_link *first = &links[0], *last = &links[1];
    int q0 = first->coordinate, q1 = last->coordinate;
    double angle = first->along + y[q0];
    struct vec turn0, turn1;
    units_by_sine(angle, angle + last->along + y[q1], &turn0, &turn1);
    struct vec d = vec_turn(turn0, last->at), h = vec_turn(turn1, last->moment);
    double C = vec_dot(d, h), X = vec_cross(d, h), D = last->inverse_I_O;
    double u = D * (s[1].g + moment_of_forces(last, turn1) - square(v[q0]) * X);
    double moment = s[0].g - s[1].g + moment_of_forces(first, turn0) + vec_cross(d, last->force) +
                    square(v[q0] + v[q1]) * X;
    double J = first->I_O + last->across * vec_dot(last->at, last->at) + D * X * X;
    double alpha = (moment - C * u) / J;
    a[q0] = alpha;
    a[q1] = u - D * C * alpha - alpha;
}

void tree_three_pivots(const struct tree_link *links, const struct tree_bare *s, const double *y,
                       const double *v, double *a)
{
    const struct tree_link *first = &links[0], *second = &links[1], *last = &links[2];
    int q0 = first->coordinate, q1 = second->coordinate, q2 = last->coordinate;
    double angle0 = first->along + y[q0], angle1 = angle0 + second->along + y[q1];
    struct vec turn0, turn1;
    units_by_sine(angle0, angle1, &turn0, &turn1);
    struct vec turn2 = unit_by_sine(angle1 + last->along + y[q2]);
    double w0 = v[q0], w1 = w0 + v[q1], w2 = w1 + v[q2];
    double z0 = w0 * w0, z1 = w1 * w1, z2 = w2 * w2;
    struct vec d0 = vec_turn(turn0, second->at), d1 = vec_turn(turn1, last->at);
    struct vec m1 = vec_turn(turn1, second->moment), h = vec_turn(turn2, last->moment);
    double C0 = vec_dot(d0, h), X0 = vec_cross(d0, h), C1 = vec_dot(d1, h), X1 = vec_cross(d1, h);
    double D = last->inverse_I_O, across = last->across, beyond = vec_dot(last->at, last->at);
    double X = vec_cross(d0, m1) + last->mass * vec_cross(d0, d1); /* second link with the mass of the last */
    double u = D * (s[2].g + moment_of_forces(last, turn2) - z0 * X0 - z1 * X1);
    double moment1 = s[1].g - s[2].g + moment_of_forces(second, turn1) + vec_cross(d1, last->force) +
                     z2 * X1 - z0 * X - C1 * u;
    double moment0 = s[0].g - s[1].g + moment_of_forces(first, turn0) +
                     vec_cross(d0, vec_add(second->force, last->force)) + z1 * X + z2 * X0 - C0 * u;
    double J01 = vec_dot(d0, m1) + across * vec_dot(d0, d1) + D * X0 * X1;
    double J00 = first->I_O + (second->mass + across) * vec_dot(second->at, second->at) + D * X0 * X0;
    double J11 = second->I_O + across * beyond + D * X1 * X1, E = 1 / J11;
    double alpha0 = (moment0 * J11 - J01 * moment1) / (J00 * J11 - J01 * J01); /* independent of E */
    double alpha1 = E * (moment1 - J01 * alpha0);
    a[q0] = alpha0;
    a[q1] = alpha1 - alpha0;
    a[q2] = u - D * (C0 * alpha0 + C1 * alpha1) - alpha1;
}
