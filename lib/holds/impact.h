/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impact of rigid bodies at one point, with dry friction, in closed form.
 *
 * During an impact positions do not change and finite forces are negligible, so velocities change with the
 * normal impulse p alone. With W the response of both bodies to unit impulses at the point (the inverse
 * effective mass),
 *
 *     dv_n = (W_nn + W_nt f) dp,   dv_t = (W_nt + W_tt f) dp,   f = d tau / dp
 *
 * where f = -mu sign(v_t) while the point slips, and f = -W_nt / W_tt, within mu, while it sticks. So the
 * path of (v_n, v_t) is a line with a corner where v_t reaches zero: there it sticks, reverses its slip, or,
 * where the coupling W_nt is too large, slips on (Routh's diagram: Routh, Elementary Rigid Dynamics, 1897,
 * art. 193). Compression ends where v_n = 0; restitution where
 *
 *     stronge   the normal impulse has returned e^2 of the work of compression (Stronge, Impact
 *               Mechanics, section 3.3.3): no energy is gained with any friction
 *     poisson   the normal impulse is 1 + e times that of compression
 *     newton    v_n = -e v_n before: with friction that may gain energy
 *
 * One law does not resolve the phases of the impact:
 *
 *     moreau    v_n = -e v_n before, and the impulse of friction is that of the velocity after, -mu p sign(v_t),
 *               or within mu p where v_t = 0 then (Moreau, Unilateral Contact and Dry Friction in Finite
 *               Freedom Dynamics, 1988), as in time-stepping simulators. It differs from newton where
 *               the slip reverses.
 *
 * If one coordinate moves against an immovable body - a rod on a pivot and the ground, or a driven body - W
 * has rank one: (v_n, v_t) stays on a line, which sticking friction cannot leave. Against the ground both
 * vanish at the same time, without restitution where friction locks the point; against a moving body possibly
 * no impulse ends the approach (jams).
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

/* The tangential motion at the end of the impact. */
enum impact_slip {
    impact_slips,
    impact_sticks,
    impact_reverses,
    impact_jams /* no impulse satisfies the law */
};

struct impact {
    double p, tau;      /* impulses along the normal and the tangent */
    double v_n, v_t;    /* after */
    double work;        /* of both on the bodies: the change of kinetic energy */
    double compression; /* impulse at the end of compression */
    enum impact_slip slip;
};

/* The impact with v_n < 0 before; with v_n >= 0 there is no impact, and velocities are unchanged. */
struct impact impact_at_point(const struct impact_point *point, double v_n, double v_t);

#endif
