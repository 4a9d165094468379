/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sliding on a switch (A. F. Filippov, Differential Equations with Discontinuous Righthand Sides, 1988).
 *
 * Where the forces on both sides of a switch drive the motion back to it, u < 0 with u' > 0 and u > 0 with u'
 * < 0, it goes on along u = 0: each formula with the switch takes a convex combination of its two branches,
 *
 *     F = (1 - s) F(-) + s F(+),   0 <= s <= 1,
 *
 * with the share s that keeps u' = 0. That is Coulomb's law for -F sign(v), and the equivalent control of a
 * sliding mode -F sign(x + c v). It ends when s reaches 0 or 1, where one branch alone goes on from u = 0.
 *
 * The shares follow from the accelerations: c_j = u_j' along the motion is zero for all j at once. For forces
 * that enter linearly c is affine in the shares, and one step of Newton's method is exact. Switches with one
 * surface, as two forces with sign(v), are a unit: their shares are as far from 1/2 as each other, each to
 * the side that helps, so that their forces are shared in proportion to what they can be, and a force and its
 * reaction stay equal. So are those whose speeds a coupling makes one, as long as it does: of two bodies on a
 * taut rope.
 *
 * A switch that watches places, u(x), has the same u' on both sides. It is slid on in second order, where u =
 * 0 and u' = 0, by the share that keeps u'' = 0: what is slid on is w = u' = g v with a constant g, and u = 0
 * besides. sign(v) and sign(x) together are of one unit there. A motion gets there by passing it infinitely
 * often in a finite time (loop/zeno_switch.h), or begins there.
 */
#ifndef FBD_DYNAMICS_SLIDING_H
#define FBD_DYNAMICS_SLIDING_H

#include "dynamics/instant.h"

enum { not_held = -1, all_held = -2 };

/* A switch that the motion slides on. */
struct slide {
    int kink, part;
    int branch;   /* its place in the branches of the state */
    int unit;     /* switches with one surface share one */
    int sign;     /* +1 or -1: the side to which its share goes with the unit's */
    bool places;  /* in second order */
    double share; /* s: of the branch u > 0 */
    double slack; /* beyond 0 and 1 it may go so far, where it has left and come back in no time */
    double along; /* its variation */
};

/* The switches that a motion slides on, and scratch. The most there are is plan.slide_count. */
struct sliding {
    int count, units;
    struct slide *slides;
    int *slide_at; /* plan.branches: 1 + index of the slide, or 0 */
    int *branches; /* plan.branches: scratch of formulas */
    bool *keep;    /* plan.branches: not to be chosen by the values, when modes are settled */
    bool *left;    /* plan.branches: its share has just reached an end */
    bool *ended;   /* plan.branches: the passages that are left are as good as none (loop/zeno_switch.h) */
    int *
        aside; /* plan.mode_count: the side on which friction slips, as a switch holds its coordinate; else 0 */
    bool *slips; /* plan.mode_count: of `decided`, what is not left open */
    int *
        held; /* units: the slot of what friction holds, where it keeps the one coordinate of the surface at rest; else
                  not_held, or all_held where it keeps several */
    int *with; /* n: the first coordinate that couplings move as one with it, as of bodies on a taut rope; */
    double *as_fast; /* n: and how many times as fast as that one it is */
    bool failed;     /* no shares are found: the branches do not act on the surfaces */
    const char *why; /* when modes did not settle for a slide: "none" or "several"; else NULL */
    int blamed;      /* then a kink */
    double *M, *B;   /* units by units, factored in `lu`; n by units: accelerations by the unit's share */
    double *lu, *c, *delta, *step;
    int *pivot;
    double *u, *rate, *rounding; /* of the switches of one formula */
    double *slots, *slots_along, *a, *a_along, *flow, *zero, *shifted, *own_y, *own_dy, *best, *moved;
    int *kept;      /* 2 plan.branches + 2 plan.mode_count: modes while others are tried */
    double *kept_y; /* plan_size */
};

size_t sliding_size(const struct fbd_model *model);
void sliding_init(struct sliding *sliding, const struct fbd_model *model, void *memory);
void sliding_copy(const struct fbd_model *model, struct sliding *to, const struct sliding *from);

/* Slide on a switch from now on, in a unit. */
void sliding_add(struct sliding *sliding, const struct kink *kink, int index, int part, int unit, int sign);
/* Leave those out whose branches no longer know them. */
void sliding_drop(struct sliding *sliding);

/* Number the units anew, in the order of their first slides. */
void sliding_number(struct sliding *sliding);

/* The shares at an instant; accelerations() does this. */
void sliding_solve(const struct fbd_model *model, const struct instant *at);

/* What is left of accelerations that the shares bring to zero is rounding of the forces, not motion: what
 * rests on its switch stays exactly. After sliding_solve. */
void sliding_clear_rounding(const struct fbd_model *model, const struct instant *at, double *a);
/* The same of their variations, after sliding_solve_along. */
void sliding_clear_rounding_along(const struct fbd_model *model, const struct instant *at, double *a_along);

/* After sliding_solve: of what would give the surfaces such rates, one for each unit, what the shares become more by so that
 * they have none. Where friction holds they stay. */
void sliding_answer(const struct sliding *sliding, double *rates);

/* More of the share of a unit. */
void sliding_shift(struct sliding *sliding, int unit, double by);

/* The variations of the shares along a direction, after sliding_solve at the instant. */
void sliding_solve_along(const struct fbd_model *model, const struct instant *given,
                         const struct direction *direction);

/* Is a pair dry friction of a coordinate, or, on a surface that does not move, of one that couplings move as one with it? */
bool sliding_is_friction_of(const struct sliding *sliding, const struct mode *mode, int coordinate);

/* The dry friction that keeps a coordinate from accelerating against its surface, -1 for none. */
int sliding_holder(const struct sliding *sliding, const struct fbd_model *model, const struct instant *at,
                   int coordinate);

/* The same of what is at rest on its surface, also where it is about to slip. */
int sliding_rest(const struct sliding *sliding, const struct fbd_model *model, const struct instant *at,
                 int coordinate);

/* Where friction holds the coordinates of a switch, does the switch go on being zero as their surfaces move? A surface
 * that is shaken, or that takes them along to where x + T v is another, would take them off the switch, which may hold
 * them where they are. 0, or the sign of what it will be. */
int sliding_parted(const struct fbd_model *model, const struct instant *given, const struct kink *kink,
                   int part);

/* What a switch watches: u. */
double sliding_watched(struct sliding *sliding, const struct fbd_model *model, const struct instant *given,
                       const struct kink *kink, int part);

/* What a switch watches as a surface to be slid on, and its rate along (dt, dy); dy has plan_size. Of one that
 * watches places that is u', whose rate along (dt, dx, dv) is that of u along (0, dv, 0). */
double sliding_surface(struct sliding *sliding, const struct fbd_model *model, const struct instant *given,
                       const struct kink *kink, int part);
double sliding_surface_rate(struct sliding *sliding, const struct fbd_model *model,
                            const struct instant *given, const struct kink *kink, int part, double dt,
                            const double *dy);

/* The rates of the surfaces, one for each unit, along (dt, dy); dy has plan_size. */
void sliding_rates(const struct fbd_model *model, const struct instant *given, double dt, const double *dy,
                   double *rates);

struct fbd_state;

/* The rounding of what a switch watches; 0 also when memory is out. */
double sliding_rounding(const struct fbd_state *state, const struct kink *kink, int part);

/* Bring the velocities back onto the surfaces, by impulses of the forces that slide, and likewise the places
 * onto those that are slid on in second order. While modes are settled, `settling`, what is at rest on a surface of
 * friction stays so: how far an event is off its switch is the rounding of its time, and would have it slip already. */
void sliding_project(struct fbd_state *state, bool settling);

struct decided;

/* What rests at the switch of a place, on a branch that it had, keeps that: neither u nor its rate says which. In
 * sliding->keep. */
void sliding_keep_rest(struct fbd_state *state);

/* After the modes have been settled by `settle`, with or without success: slide where both branches of a
 * switch lead back to it, and go on by a branch where the share is used up. False when no choice or several
 * agree with the forces. */
bool sliding_settle(struct fbd_state *state, const struct decided *decided, bool settled,
                    bool (*settle)(struct fbd_state *state, const struct decided *decided));

#endif
