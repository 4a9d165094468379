/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impact of rigid bodies at one point, with dry friction, in closed form.
 *
 * In the time of an impact nothing moves and no other force counts, so velocities change with the normal
 * impulse p alone. With W the answer of both bodies to unit impulses at the point (the inverse of its mass),
 *
 *     dv_n = (W_nn + W_nt f) dp,   dv_t = (W_nt + W_tt f) dp,   f = d tau / dp
 *
 * where f = -mu sign(v_t) while the point slips, and f = -W_nt / W_tt, within mu, while it sticks. So the way
 * of (v_n, v_t) is a line that breaks where v_t reaches zero: there it sticks, or slips back, or, where the
 * tangent pulls that much, on (Routh's diagram: Routh, Elementary Rigid Dynamics, 1897, art. 193).
 * Compression ends where v_n = 0; restitution where
 *
 *     stronge   the normal impulse has given back e^2 of the work that compression took (Stronge, Impact
 *               Mechanics, section 3.3.3): with any friction no energy is made
 *     poisson   the normal impulse is 1 + e times that of compression
 *     newton    v_n = -e v_n before: with friction that may take more energy than there was
 *
 * One law asks for nothing within the impact:
 *
 *     moreau    v_n = -e v_n before, and the impulse of friction is that of the velocity after, -mu p sign(v_t),
 *               or within mu p where v_t = 0 then (Moreau, Unilateral Contact and Dry Friction in Finite
 *               Freedom Dynamics, 1988), as in simulators that step over impacts. It differs from newton where
 *               the point slips back.
 *
 * What one coordinate moves, against what gives no way - a rod on a pivot and the ground, or what a drive moves - has W of rank
 * one: (v_n, v_t) stays on a line, which friction that holds cannot leave. At rest on the ground both come to nothing
 * at once, and nothing is given back where friction locks it; on what moves on no impulse may end the approach (jams).
 */
#ifndef FBD_HOLDS_IMPACT_H
#define FBD_HOLDS_IMPACT_H

#include <stdbool.h>

enum impact_law { impact_stronge, impact_poisson, impact_newton, impact_moreau };

/* Does the law prescribe the normal velocity after? */
static inline bool impact_by_velocity(enum impact_law law)
{
    return law == impact_newton || law == impact_moreau;
}

/* The point: W as [nn, nt, tt], and its laws. */
struct impact_point {
    double W[3];
    double mu, e;
    enum impact_law law;
};

/* What the tangent does in the impact, last. */
enum impact_slip {
    impact_slips,
    impact_sticks,
    impact_reverses,
    impact_jams /* no impulse does what the law says: there is none */
};

struct impact {
    double p, tau;      /* impulses along the normal and the tangent */
    double v_n, v_t;    /* after */
    double work;        /* of both on the bodies: the change of kinetic energy */
    double compression; /* impulse at the end of compression */
    enum impact_slip slip;
};

/* The impact with v_n < 0 before; with v_n >= 0 there is none, and nothing changes. */
struct impact impact_at_point(const struct impact_point *point, double v_n, double v_t);

#endif
