/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The impact at one point, with friction, in small steps of its normal impulse, which are cut where something
 * changes: what compression and restitution ask for is looked at on the way (Routh, Elementary Rigid Dynamics,
 * 1897, art. 193), and no case is told from another before.
 */
#ifndef FBD_TESTS_IMPACT_BY_STEPS_H
#define FBD_TESTS_IMPACT_BY_STEPS_H

enum law_by_steps { steps_stronge, steps_poisson, steps_newton, steps_moreau };

struct point_by_steps {
    double W[3]; /* nn, nt, tt of the inverse of its mass */
    double mu, e;
    enum law_by_steps law;
};

/* Velocities along normal and tangent become those after; their impulses are set. */
void impact_by_steps(const struct point_by_steps *point, double *v, double *P);

#endif
