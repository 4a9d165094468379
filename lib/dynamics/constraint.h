/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Constraints at an instant: for each row g(q) = 0 its value, rate and acceleration along the motion, and the
 * forces that a multiplier of one means for the links.
 *
 *   pin    g = (p_A - p_B) . x, then . y
 *   rod    g = |p_A - p_B| - L
 *   gear   g = r_1 (theta_1 - phi) + r_2 (theta_2 - phi), phi the angle of the line of centres; r_2 < 0 for a
 *          ring round the first
 *   rope   g = sum of the straight pieces + s_1 R_1 (psi_1 - theta_1) + s_2 R_2 (theta_2 - psi_2) - L, with psi
 *          the angle of the piece that leaves or reaches a pulley, s = +1 when it runs counter-clockwise there;
 *          also where it begins or ends wound on a disc; L may be a function of t
 *   belt   g = (g_1 - g_2) / 2 of its strands, as ropes from disc 1 to disc 2 and back; and g_1 + g_2, where the axes
 *          move
 *   capstan (a rope that rubs on a drum)  g = (L - g_1 - g_2) / 2 and (g_1 - g_2) / 2 of its strands: their multipliers
 *          are T_1 + T_2 and T_2 - T_1, and T_1 / T_2 <= exp(mu beta) is |T_2 - T_1| <= tanh(mu beta / 2) (T_1 + T_2)
 *   slot   g = n . (P - r), r = r(s) the foot of P on the curve, e(s) . (P - r) = 0; on one side of it, a roller has
 *          -+n . (P - r) - R
 *   roll   g = n . (C - P) - R, and the rack's row
 *   contact, at a side: as roll, with the side's outward normal; of two circles:
 *          g = |C_1 - C_2| - R_1 - R_2, and R_1 (phi - theta_1) + R_2 (phi - theta_2) along them, phi the
 *          angle of the line of centres
 *   rack   g = e . (C - P) + s R (theta_C - theta_P), n = s k x e pointing to the side of the circle
 *
 * The rates are J v, the forces J^T: every row's ports do the work lambda g'.
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

/* Has the force a moment about its link, now or a moment later? If not, how the link has turned, and how fast it turns,
 * is nothing to it: the normal of a disc on a drum points to the centres of both. */
bool port_turns(const struct port *port);

struct row {
    struct jet g;
    double lambda; /* the multiplier, when solved */
    int port_count;
    bool redundant; /* it says nothing that the rows before it do not say */
    bool weak;      /* or may say nothing new */
    /* Behind all that is asked of rows that take no part. */
    struct port ports[2 * most_constraint_ends];
};

/* What a coupling keeps of the start: zero of its rows, side of the line or of the way round the pulleys, and the
 * angle that others are counted from. */
struct coupling_state {
    double zero;
    int side[2];
    double psi[2];    /* of a rope: the directions of its first and last piece at the start */
    double turned[2]; /* and how far they have turned since, by constraints_follow */
    double laid[2]; /* what the first and the last disc of a rope add to its way at the start; of a belt: its
                         rows */
    double foot;    /* slot: the length along it, by constraints_follow */
    int feature;    /* contact: at which it is; no_feature while it is open */
};

enum { no_feature = -1 };

/* Set what the couplings keep, from where the links are. */
void constraints_start(const struct fbd_model *model, const struct instant *at);

/* What the couplings keep of their start is that of `from`, a state of the same scene or of one that has these couplings and
 * others. */
void couplings_keep(struct fbd_state *state, const struct fbd_state *from);

/* Note how far the pieces of ropes have turned, where the links are: a rope may wind itself round a pulley
 * any number of times, and an angle by itself does not tell how often. From there on they may turn by less
 * than half a turn before it is noted again. */
void constraints_follow(const struct fbd_model *model, struct tree_work *work);

/* Are all couplings such as have no end: no rope that gets slack or is unwound, no slot that is left, no surface? */
bool couplings_go_on(const struct tree *tree);

/* The points that follow curves have been moved by a projection: where they are on them now. What winds has its place
 * from the motion alone. */
void slots_follow(const struct fbd_model *model, struct tree_work *work);

/* Put coupling `index`, of a contact, to a feature of its meeting (or to none), as the links are. */
void coupling_set_feature(const struct fbd_model *model, struct tree_work *work, int index, int feature);

/* The velocity of a rolling or rubbing body's point of contact against its line, and its acceleration; after
 * accelerations() at the instant. A velocity within rounding of zero is zero. */
double coupling_slip_velocity(const struct fbd_model *model, const struct instant *at, int coupling);

/* What of it counts as zero. */
double coupling_slip_rounding(const struct fbd_model *model, const struct instant *at, int coupling);
struct slip_rate {
    double value, variation;
};

/* The velocity alone, from where the links are and how they move; `varied`: and how it varies with them. */
struct slip_rate coupling_slip(const struct fbd_model *model, const struct instant *at, int index,
                               bool varied);

double coupling_slip_acceleration(const struct fbd_model *model, const struct instant *at, int coupling);

/* What is one-sided: how it is, after accelerations() at the instant. The excess is that of a rope's way over
 * its length, or how far what rolls is within its line; it never is more than zero. */
struct one_sided {
    double excess, rate, acceleration; /* and how it changes */
    double force;                      /* tension, or normal force */
    double rounding;                   /* of the excess */
    double near;  /* what the place of an event leaves of it, against the size of rope and scene */
    double speed; /* that the rate is made of */
    double slack; /* of the force: a force that is zero throughout is rounding, which opens nothing */
    double
        turning; /* the largest angular velocity there, or that of swinging so far [rad/s]: times the slack, that of
                          its rate */
    bool touches;      /* just closed to rounding, in length and rate */
    bool parts, meets; /* it opens, closes with a speed that is not rounding */
};
struct one_sided one_sided_at(const struct fbd_model *model, const struct instant *at, int pair);

/* The first place of a rope's way after which it has none to the next: a point on or within the rim of the
 * pulley beside it, or two pulleys between which it crosses and which overlap; -1 without one. */
int rope_blocked_at(const struct fbd_model *model, const struct tree_work *work, int index);

/* The first piece of a taut rope that has no length, both its ends at `where`, and so no direction; -1 without one. */
int rope_shrunk_at(const struct fbd_model *model, const struct tree_work *work, int index, struct vec *where);

/* What is left before a coupling comes to its end 0 or 1, and how fast that grows: of a rope on the disc there that it is
 * wound on, of a slot for its point. `size`: what its rounding is measured against, HUGE_VAL where there is no end. After
 * constraints_evaluate(). */
struct room {
    double left, rate, size;
};
struct room coupling_room(const struct fbd_model *model, const struct tree_work *work, int index, int end);

/* Is a slot that only presses open: does its point fly? It has passed an end where less than minus this share of the
 * slot's size is left. */
static const double slot_rounding = 6e-12;
bool slot_is_open(const struct coupling *coupling, const int *slip);

/* How far the point of a slot is from the origin of its frame, and the radius of a circle as long as its curve, HUGE_VAL
 * where it is straight; 0 and HUGE_VAL of what is no slot. After constraints_evaluate(). */
struct slot_size {
    double reach, radius;
};
struct slot_size slot_size(const struct fbd_model *model, const struct tree_work *work, int index);

/* The straight piece of a rope after place k, beside the discs there (without one, what the rope is long). */
struct room rope_piece(const struct fbd_model *model, const struct tree_work *work, int index, int k);

/* The tensions of the strands of a belt, as its rows have them. */
void belt_tensions(const struct fbd_model *model, const struct tree_work *work, int index, double tension[2]);

/* A rope that rubs on a drum: the angle by which it lies on it [rad], and its variation along that of the links, when
 * `varied`. */
double capstan_wrap(const struct fbd_model *model, const struct instant *at, int index, bool varied,
                    double *variation);

/* The tensions of its strands. */
void capstan_tensions(const struct fbd_model *model, const struct tree_work *work, int index,
                      double tension[2]);

/* How fast the length of a rope grows by itself. */
struct fbd_state;
double rope_reel_rate(const struct fbd_state *state, int index);

/* Does the rope of a coupling go on beyond the pulley at its end, as the next coupling? */
bool rope_goes_on(const struct tree *tree, int index);

/* The angle by which such a rope lies on the pulley, from where one piece reaches it to where the next leaves
 * it [rad]; negative where it would have to pull the pulley along. Modulo a turn, between -pi and pi. */
double rope_wrap(const struct fbd_model *model, const struct tree_work *work, int index);

/* A body that has slipped rolls, or sticks, on from where it is. */
void coupling_rezero(const struct fbd_model *model, struct tree_work *work, int coupling);

/* Evaluate all rows where the links are, with A their accelerations. With `along` (else NULL), along the
 * variation of the links and of the time as well. */
void constraints_evaluate(const struct fbd_model *model, const struct instant *at,
                          const struct direction *along);

#endif
