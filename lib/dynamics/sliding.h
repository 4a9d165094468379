/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sliding modes of a switch (A. F. Filippov, Differential Equations with Discontinuous Righthand Sides,
 * 1988).
 *
 * Where the forces on both sides of a switch drive the motion towards it, u < 0 with u' > 0 and u > 0 with u'
 * < 0, the motion continues along u = 0: each formula with the switch takes a convex combination of its two
 * branches,
 *
 *     F = (1 - s) F(-) + s F(+),   0 <= s <= 1,
 *
 * with the weight s for which u' = 0. That is Coulomb's law for -F sign(v), and the equivalent control of a
 * sliding mode -F sign(x + c v). It ends when s reaches 0 or 1, where the motion leaves u = 0 on one branch.
 *
 * The weights follow from the accelerations: c_j = u_j' along the motion is zero for all j at once. For
 * forces that enter linearly c is affine in the weights, and one step of Newton's method is exact. Switches
 * with one surface, as two forces with sign(v), form a unit: their weights have equal distances from 1/2,
 * each on the side that helps, so that their forces are proportional to their magnitudes, and a force and its
 * reaction stay equal. Switches of speeds that a coupling makes proportional, as of two bodies on a taut
 * rope, are one unit while it does.
 *
 * A switch of positions, u(x), has the same u' on both sides. Its sliding mode is of second order, u = 0 and
 * u' = 0, with the weight for which u'' = 0: the surface is w = u' = g v with a constant g, beside u = 0.
 * There sign(v) and sign(x) are of one unit. A motion reaches such a mode by infinitely many crossings in a
 * finite time (loop/zeno.h), or starts in it.
 */
#ifndef FBD_DYNAMICS_SLIDING_H
#define FBD_DYNAMICS_SLIDING_H

#include "dynamics/instant.h"

enum { not_held = -1, all_held = -2 };

/* A switch in a sliding mode. */
struct slide {
    int kink, part;
    int branch;   /* its index in the branches of the state */
    int unit;     /* the same for switches with one surface */
    int sign;     /* +1 or -1: whether its weight increases with the unit's */
    bool places;  /* of positions: of second order */
    double share; /* s: the weight of the branch u > 0 */
    double slack; /* tolerance of the weight beyond 0 and 1, after it left and returned at once */
    double along; /* its variation */
};

/* The switches in sliding modes, and scratch. There are at most plan.slide_count. */
struct sliding {
    int count, units;
    struct slide *slides;
    int *slide_at;   /* plan.branches: 1 + index of the slide, or 0 */
    int *branches;   /* plan.branches: scratch of formulas */
    bool *keep;      /* plan.branches: not to be resolved by values while modes are settled */
    bool *left;      /* plan.branches: its weight has just reached an end */
    bool *ended;     /* plan.branches: the remaining crossings are negligible (loop/zeno.h) */
    int *aside;      /* plan.mode_count: side of friction that slips while a switch holds; else 0 */
    bool *slips;     /* plan.mode_count: scratch for `slips` of struct decided */
    int *held;       /* units: slot of the friction that holds its coordinate; not_held; all_held: several */
    int *with;       /* n: the first coordinate proportional to it by couplings, as on a taut rope; */
    double *as_fast; /* n: and the ratio of its speed to that of the first */
    bool failed;     /* no weights exist: the branches do not affect the surfaces */
    const char *why; /* why modes were not settled: "none" or "several" solutions; else NULL */
    int blamed;      /* then the index of a kink */
    double *M, *B;   /* units by units, factored in `lu`; n by units: accelerations by the unit's weight */
    double *lu, *c, *delta, *step;
    int *pivot;
    double *u, *rate, *rounding; /* of the switches of one formula */
    double *slots, *slots_along, *a, *a_along, *flow, *zero, *shifted, *own_y, *own_dy, *best, *moved;
    double *shifted_held; /* by parameter, as instant.held */
    int *kept;            /* 2 plan.branches + 2 plan.mode_count: saved modes while others are tried */
    double *kept_y;       /* plan_size */
};

size_t sliding_size(const struct fbd_model *model);
void sliding_init(struct sliding *sliding, const struct fbd_model *model, void *memory);
void sliding_copy(const struct fbd_model *model, struct sliding *to, const struct sliding *from);

/* Add a switch to the sliding ones, in a unit. */
void sliding_add(struct sliding *sliding, const struct kink *kink, int index, int part, int unit, int sign);
/* Remove the switches that are no longer marked in slide_at. */
void sliding_drop(struct sliding *sliding);

/* Renumber the units, in the order of their first slides. */
void sliding_number(struct sliding *sliding);

/* Compute the weights at an instant; called by accelerations(). */
void sliding_solve(const struct fbd_model *model, const struct instant *at);

/* Set accelerations that the weights bring to zero to exactly zero, so that a body at rest on its switch
 * stays there. After sliding_solve. */
void sliding_clear_rounding(const struct fbd_model *model, const struct instant *at, double *a);
/* The same of their variations, after sliding_solve_along. */
void sliding_clear_rounding_along(const struct fbd_model *model, const struct instant *at, double *a_along);

/* After sliding_solve: replace given rates of the surfaces, one for each unit, by the changes of the weights
 * that cancel them; zero where friction holds. */
void sliding_answer(const struct sliding *sliding, double *rates);

/* Increase the weight of a unit. */
void sliding_shift(struct sliding *sliding, int unit, double by);

/* The variations of the weights along a direction, after sliding_solve at the instant. */
void sliding_solve_along(const struct fbd_model *model, const struct instant *given,
                         const struct direction *direction);

/* Is a mode dry friction of a coordinate, or, on a fixed surface, of one to which couplings make it
 * proportional? */
bool sliding_is_friction_of(const struct sliding *sliding, const struct mode *mode, int coordinate);

/* The mode of the dry friction that keeps a coordinate from accelerating relative to its surface, -1 for
 * none. */
int sliding_holder(const struct sliding *sliding, const struct fbd_model *model, const struct instant *at,
                   int coordinate);

/* The same for a coordinate at rest on its surface, even if it is about to slip. */
int sliding_rest(const struct sliding *sliding, const struct fbd_model *model, const struct instant *at,
                 int coordinate);

/* Where friction holds the coordinates of a switch, does it stay at zero as their surfaces move? An
 * accelerating surface, or one that carries them to a different x + T v, would take them off the switch,
 * which may hold them instead. Returns 0, or the sign that u will have. */
int sliding_parted(const struct fbd_model *model, const struct instant *given, const struct kink *kink,
                   int part);

/* The switching function u. */
double sliding_watched(struct sliding *sliding, const struct fbd_model *model, const struct instant *given,
                       const struct kink *kink, int part);

/* The surface function of a sliding mode, and its rate along (dt, dy); dy has plan_size. For a switch of
 * positions this is u', whose rate along (dt, dx, dv) is that of u along (0, dv, 0). */
double sliding_surface(struct sliding *sliding, const struct fbd_model *model, const struct instant *given,
                       const struct kink *kink, int part);
double sliding_surface_rate(struct sliding *sliding, const struct fbd_model *model,
                            const struct instant *given, const struct kink *kink, int part, double dt,
                            const double *dy);

/* The rates of the surfaces, one for each unit, along (dt, dy); dy has plan_size. */
void sliding_rates(const struct fbd_model *model, const struct instant *given, double dt, const double *dy,
                   double *rates);

struct fbd_state;

/* The rounding of a switching function; 0 also when memory is out. */
double sliding_rounding(const struct fbd_state *state, const struct kink *kink, int part);

/* Project the velocities onto the surfaces, by impulses of the switched forces, and the positions onto
 * surfaces of second order. While modes are settled, `settling`, a body at rest on a surface with friction
 * stays so: the distance of an event from its switch is the rounding of its time, and must not count as slip.
 */
void sliding_project(struct fbd_state *state, bool settling);

struct decided;

/* Mark in sliding->keep the branches of switches of positions at which the state rests: neither u nor its
 * rate determines them. */
void sliding_keep_rest(struct fbd_state *state);

/* After the modes have been settled by `settle`, with or without success: start sliding where both branches
 * of a switch lead back to it, and continue on a branch where the weight is at its end. False when no choice
 * or several are consistent with the forces. */
bool sliding_settle(struct fbd_state *state, const struct decided *decided, bool settled,
                    bool (*settle)(struct fbd_state *state, const struct decided *decided));

#endif
