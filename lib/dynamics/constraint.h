/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Constraints at an instant: for each row g(q) = 0 its value, rate and acceleration along the motion, and the
 * forces of its multiplier on the links.
 *
 *   pin    g = (p_A - p_B) . x, then . y
 *   weld   the same with the place in B where A was at the start, and g = r (theta_A - theta_B) - g_0
 *   rod    g = |p_A - p_B| - L
 *   gear   g = r_1 (theta_1 - phi) + r_2 (theta_2 - phi), phi the angle of the line of centres; r_2 < 0 for a
 *          ring round the first
 *   rope   g = sum of the straight pieces + s_1 R_1 (psi_1 - theta_1) + s_2 R_2 (theta_2 - psi_2) - L, with psi
 *          the angle of the piece that leaves or reaches a pulley, s = +1 when it runs counter-clockwise there;
 *          also for an end wound on a disc; L may be a function of t
 *   belt   g = (g_1 - g_2) / 2 of its strands, as ropes from disc 1 to disc 2 and back; and g_1 + g_2, if the
 *          axes move
 *   capstan (a rope with friction on a drum)  g = (L - g_1 - g_2) / 2 and (g_1 - g_2) / 2 of its strands: the
 *          multipliers are T_1 + T_2 and T_2 - T_1, and T_1 / T_2 <= exp(mu beta) is
 *          |T_2 - T_1| <= tanh(mu beta / 2) (T_1 + T_2)
 *   slot   g = n . (P - r), r = r(s) the foot of P on the curve, e(s) . (P - r) = 0; for a one-sided slot with
 *          a roller -+n . (P - r) - R
 *   ratio  g = sum c_i q_i of coordinates q_i in joints, c_i a length where q_i is an angle; its multiplier acts on
 *          each body by the generalized force c_i, and by the opposite on the body below, so that it acts on no
 *          other joint
 *   roll   g = n . (C - P) - R, and the rack's row
 *   rolling resistance  g = theta_C - theta_P; its multiplier is a moment
 *   contact, at a side: as roll, with the side's outward normal; of two circles:
 *          g = |C_1 - C_2| - R_1 - R_2, and R_1 (phi - theta_1) + R_2 (phi - theta_2) along them, phi the
 *          angle of the line of centres
 *   A surface that moves with the speed s(t) along the tangent: g' has -s, and g is 0; sticking is a constraint of
 *          velocities.
 *   plane  no g: e . u and (k x e) . u are its rates, see plane_friction.h
 *   rack   g = e . (C - P) + s R (theta_C - theta_P), n = s k x e pointing to the side of the circle
 *
 * The rates are J v, the forces J^T: the ports of a row have the power lambda g'.
 */
#ifndef FBD_DYNAMICS_CONSTRAINT_H
#define FBD_DYNAMICS_CONSTRAINT_H

#include "dynamics/jet.h"
#include "dynamics/tree.h"

/* The force of a unit multiplier on one link, at `arm` from its O, and its variation. */
struct port {
    int link, end; /* number of the end in its coupling */
    struct vec arm, force;
    struct vec d_arm, d_force;
};

/* Has the force a moment about its link, or will it have one? If not, angle and angular velocity of the link
 * do not affect it: the normal of a disc on a drum passes through both centres. */
bool port_turns(const struct port *port);

struct row {
    struct jet g;
    double lambda;  /* the multiplier, when solved */
    double surface; /* the speed of a moving surface that is subtracted in the rate of its tangential row */
    int port_count;
    bool redundant; /* linearly dependent on the rows before it */
    bool weak;      /* possibly dependent */
    /* Last, behind the members that are read for inactive rows too. */
    struct port ports[2 * most_constraint_ends];
};

/* The references of a coupling from its start: zero of its rows, side of the line or sense round the pulleys,
 * and the angle from which others are counted. */
struct coupling_state {
    double zero;
    int side[2];
    double psi[2];    /* of a rope: the directions of its first and last piece at the start */
    double turned[2]; /* and their rotation since, by constraints_follow */
    double laid[2];   /* at the start: wound length on the end discs; belt: its rows; weld: end 0 in link 1 */
    double foot;      /* slot: the arc length of its point, by constraints_follow */
    struct vec e, n;  /* plane friction: direction of its first row; of its force while it slips; */
    double nu, soft,
        across;  /* the speeds nu, nu after the start and, across e, that of round-off (plane_friction.h), */
    double slow; /* and that below which errors of the run turn the velocity; */
    bool gently; /* it begins to slip without an acceleration of its own */
    int feature; /* contact: its feature; no_feature while it is open */
};

enum { no_feature = -1 };

/* Has it ended, or not begun? Then its rows are empty. */
static inline bool coupling_is_gone(const struct tree_work *work, const struct coupling *coupling)
{
    return !is_there(work, coupling->source->lifetime.number);
}

/* Set the references of the couplings from the positions of the links. */
void constraints_start(const struct fbd_model *model, const struct instant *at);

/* Let coupling `index` begin at the positions of the links, with references from there. */
void coupling_begin(const struct fbd_model *model, const struct instant *at, int index);

/* Copy the references of the couplings from `from`, a state of the same scene or of one whose couplings
 * include these. */
void couplings_keep(struct fbd_state *state, const struct fbd_state *from);

/* Record the rotation of the pieces of ropes at the positions of the links: a rope may wind round a pulley
 * any number of times, which an angle does not show. Between calls they may turn by less than half a turn. */
void constraints_follow(const struct fbd_model *model, struct tree_work *work);

/* Are all couplings without an end: no rope that becomes slack or unwinds, no slot with ends, no surface? */
bool couplings_go_on(const struct tree *tree);

/* After a projection: find the points on the curves of slots again. Wound lengths follow from the motion
 * only. */
void slots_follow(const struct fbd_model *model, struct tree_work *work);

/* Set coupling `index`, of a contact, to a feature of its contact pair (or to none), at the positions of the
 * links. */
void coupling_set_feature(const struct fbd_model *model, const struct instant *at, int index, int feature);

/* The velocity of the contact point of a rolling or sliding body along its line, and its acceleration; after
 * accelerations() at the instant. A velocity within rounding of zero is zero. */
double coupling_slip_velocity(const struct fbd_model *model, const struct instant *at, int coupling);

/* The rounding of that velocity. */
double coupling_slip_rounding(const struct fbd_model *model, const struct instant *at, int coupling);
struct slip_rate {
    double value, variation;
};

/* The velocity from positions and velocities of the links, and its variation along a direction, or NULL. */
struct slip_rate coupling_slip(const struct fbd_model *model, const struct instant *at, int index,
                               const struct direction *along);

double coupling_slip_acceleration(const struct fbd_model *model, const struct instant *at, int coupling);

/* A rope, surface or contact after accelerations() at the instant. The excess is the length of a rope's path
 * minus its own length, or the penetration; it never is more than zero. */
struct one_sided {
    double excess, rate, acceleration; /* of the excess */
    double force;                      /* tension, or normal force */
    double rounding;                   /* of the excess */
    double near;       /* the tolerance of the excess at an event, from the size of rope and scene */
    double speed;      /* the scale of the rate */
    double slack;      /* of the force: smaller forces are rounding, and do not open it */
    double turning;    /* largest angular velocity [rad/s]: times slack, that of the force's rate */
    bool touches;      /* closed within rounding, in length and rate */
    bool parts, meets; /* it opens, closes with more than a rounding of speed */
};
struct one_sided one_sided_at(const struct fbd_model *model, const struct instant *at, int pair);

/* The first place of a rope's path without a piece to the next: a point on or within the rim of the
 * neighbouring pulley, or two overlapping pulleys between which it crosses; -1 without one. */
int rope_blocked_at(const struct fbd_model *model, const struct tree_work *work, int index);

/* The first piece of a taut rope with zero length, both ends at `where`, so that it has no direction; -1
 * without one. */
int rope_shrunk_at(const struct fbd_model *model, const struct tree_work *work, int index, struct vec *where);

/* The distance of a coupling from its end 0 or 1, and its rate: the length wound on the disc there, or the
 * distance of a slot's point from the end. `size`: the scale of its rounding, HUGE_VAL if there is no end.
 * After constraints_evaluate(). */
struct room {
    double left, rate, size;
};
struct room coupling_room(const struct fbd_model *model, const struct tree_work *work, int index, int end);

/* Is a one-sided slot open, its point in free flight? The point is beyond an end if `left` is less than minus
 * slot_rounding times the slot's size. */
static const double slot_rounding = 6e-12;
bool slot_is_open(const struct coupling *coupling, const int *slip);

/* The distance of a slot's point from the origin of its frame, and the radius of a circle of the length of
 * its curve, HUGE_VAL if it is straight; 0 and HUGE_VAL for other couplings. After constraints_evaluate(). */
struct slot_size {
    double reach, radius;
};
struct slot_size slot_size(const struct fbd_model *model, const struct tree_work *work, int index);

/* The straight piece of a rope after place k; `size` is the radius of the discs there, or the length of the
 * rope. */
struct room rope_piece(const struct fbd_model *model, const struct tree_work *work, int index, int k);

/* The tensions of the strands of a belt, from the multipliers of its rows. */
void belt_tensions(const struct fbd_model *model, const struct tree_work *work, int index, double tension[2]);

/* The wrap angle of a capstan rope on its drum [rad], and its variation along that of the links, when
 * `varied`. */
double capstan_wrap(const struct fbd_model *model, const struct instant *at, int index, bool varied,
                    double *variation);

/* The tensions of its strands. */
void capstan_tensions(const struct fbd_model *model, const struct tree_work *work, int index,
                      double tension[2]);

/* The rate at which a reel lengthens the rope. */
struct fbd_state;
double rope_reel_rate(const struct fbd_state *state, int index);

/* Does the rope of a coupling continue beyond the pulley at its end, as the next coupling? */
bool rope_goes_on(const struct tree *tree, int index);

/* The wrap angle of such a rope on the pulley, from the piece before to the piece behind [rad]; negative
 * where the rope would have to pull the pulley. Modulo a turn, between -pi and pi. */
double rope_wrap(const struct fbd_model *model, const struct tree_work *work, int index);

/* Reset the zero of the row along the surface, as a slipping body begins to stick or roll where it is. */
void coupling_rezero(const struct fbd_model *model, struct tree_work *work, int coupling);

/* Set work->acting: contacts that are open in the modes of the instant have no rows in its system. */
void constraints_select(const struct tree *tree, const struct instant *at);

/* Evaluate the rows of the acting couplings, for accelerations alone. */
void constraints_evaluate_acting(const struct fbd_model *model, const struct instant *at);

/* Evaluate all rows at the positions of the links, with A their accelerations; with `along` (else NULL) also
 * their variations with links and time. */
void constraints_evaluate(const struct fbd_model *model, const struct instant *at,
                          const struct direction *along);

#endif
