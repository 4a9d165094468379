/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reactions that equilibrium does not determine, chosen within limits: at rest, and as a scene moves.
 *
 * The multipliers lambda of the constraints are the only unknowns: the forces of joints, sticking friction
 * and drives follow from them (statics.h), affinely,
 *
 *     r = r_0 + R lambda,    limits h_0 + H lambda >= 0:    N >= 0, |F| <= mu_s N, T >= 0
 *
 * At rest lambda balances the coordinates without friction or drive, E lambda = -Q_0. As a scene moves its
 * accelerations are given, and with them lambda up to the null vectors Z of E. In both cases lambda + Z y is
 * a solution for every y; the one that is used has the reactions of least |r|^2 within the limits (couples
 * over a length): a least-distance problem (least_distance.h).
 *
 * Null vectors that have neither a reaction nor a limit in common are independent: each such part is a
 * problem of its own. In a stack of boxes each interface is a part, in which two corners share the load.
 *
 * There are solutions within the limits if the largest s with h(y) >= s, for all limits that depend on y, is
 * not negative: a linear programme, max s, in which s rises until limits cannot be satisfied
 * (least_distance_rise). Its rate of change is that of the limits at its multipliers u, s' = sum u_i h_i', since u is
 * orthogonal to all changes of y.
 */
#ifndef FBD_DYNAMICS_REST_SYSTEM_H
#define FBD_DYNAMICS_REST_SYSTEM_H

#include "base/arena.h"
#include "dynamics/constraint.h"
#include "dynamics/diagram.h"
#include "dynamics/statics.h"
#include "numeric/qr.h"
#include "numeric/tolerances.h"

/* A limit of the friction of points on a plane (plane_friction.h), for velocities u_i of them: sum c_i |u_i| - f_i . u_i. */
struct rest_cut {
    int count;
    int *coupling; /* count */
    struct vec *u; /* count: along both rows of the coupling (numeric/limit_surface.h) */
};

/* A limit in force, as a function h >= 0 of the forces: of a normal force, of the tension of a rope, of the loaded side of a
 * guide that slips; of friction mu N - F and mu N + F; of friction on a plane. */
struct rest_bound {
    enum { bound_normal, bound_rope, bound_guide, bound_friction, bound_plane } kind;
    int pair, contact; /* the mode, -1 for the normal force of a slide; index into plan.contacts */
    double mu,
        unit; /* the larger coefficient; the change of h for a unit margin: a force, or a moment at the length */
    int side; /* of F: -1 or 1 */
    struct rest_cut cut;
};

/* The system and its solution. */
struct rest_system {
    struct fbd_state *state;
    struct instant at;
    struct arena *arena;
    size_t n, m, slots, reactions; /* coordinates, active rows, plan.slots, entries of r */
    int *rows;                     /* m: their numbers */
    int *set;                      /* of each link: another one of its set, or itself (weak_sets) */
    bool *held, *reached;          /* n; tree.count: the links that the forces of a row reach */
    double *scale;                 /* n: 1, or one over the length for an angle; 0 if held */
    double *lambda;                /* row_count: the change from those of the base */
    struct rest_base {             /* the forces as the scene moves; at rest zero */
        bool moves;
        double *slots, *lambda; /* slots; row_count */
        struct wrench *F;       /* tree.count */
    } base;
    double *forces;           /* slots: with the present lambda */
    double *Q, *E;            /* n; n x m, scaled */
    double *slots0, *columns; /* slots; m x slots */
    double *r, *R;            /* reactions; m x reactions */
    double force, length;
    struct rest_bound *bounds;
    size_t bound_count, bound_room;
    struct qr qr;       /* of E */
    double *least;      /* m: from the base to the least reactions, limits or not */
    double *basis;      /* m x indeterminacy: lambda for a unit of r */
    size_t basis_count; /* indeterminacy */
    int *part;          /* indeterminacy: which part of the problem each of them is in */
    int parts;
    bool within_limits;
};

/* Three entries of r for each link, then one for each active row: of a pivot F_x, F_y and the friction or
 * drive moment; of a slide the friction or drive force along it, N and the couple. */
static inline size_t rest_entry_of_row(const struct rest_system *system, size_t j)
{
    return system->reactions - system->m + j;
}

/* Set up and solve for lambda; leaves the reactions in the state. False when memory is out. */
bool rest_solve(struct rest_system *system, struct fbd_state *state, struct arena *arena);
void rest_free(struct rest_system *system);

/* A limit of a reaction; the kinds in the order of fbd_limit_kind. */
struct rest_limit {
    enum rest_limit_kind { limit_normal, limit_friction, limit_rope } kind;
    int index;          /* of the contact, or of the mode */
    double needed, may; /* normal and rope: the force, and 0; friction: |F| and its limit */
};

/* Does the mode have a limit of its own? A surface is limited by its normal force. */
static inline bool rest_has_limit(const struct mode *mode)
{
    return mode_is_friction(mode) || mode->kind == mode_rope;
}

/* The number of limits, and limit `index` in the state's present slots. */
size_t rest_limits(const struct rest_system *system);
struct rest_limit rest_limit_at(const struct rest_system *system, size_t index);

/* Do the active constraints leave multipliers indeterminate, by the pivots of the elimination? */
bool rest_is_open(const struct fbd_model *model, const struct instant *at);

/* Find the limits in force. False when memory is out. */
bool rest_find_bounds(struct rest_system *system);

/* Their values at the present lambda, the tolerance for zero, and their slopes in the basis, bound_count x basis_count, which
 * are added to G (false when memory is out). */
void rest_read_bounds(const struct rest_system *system, double *values);
double rest_limit_slack(const struct rest_system *system);
bool rest_bound_slopes(struct rest_system *system, double *G);

/* Set the basis from the null vectors of E, and add to `start` the step to the least reactions, without
 * limits. False when memory is out. */
bool rest_set_basis(struct rest_system *system, double *start);

/* Part `which`: its basis vectors, the limits that depend on them, and the slopes of these. */
struct rest_part {
    size_t size, limits;
    size_t *column, *limit; /* size, limits */
    double *G;              /* limits x size */
};
bool rest_part(const struct rest_system *system, const double *G, int which, struct rest_part *part);

/* Set up the system of a moving state, evaluated in its modes. False when its constraints leave no
 * multipliers indeterminate, or memory is out (arena->failed). */
bool rest_open(struct rest_system *system, struct fbd_state *state, const struct instant *at,
               const double *slots, struct arena *arena);

/* Choose the indeterminate reactions: slots, and the forces in the links and rows of the state's tree, become
 * those of the least reactions within limits. */
void rest_share(struct rest_system *system, double *slots);

/* Choose the loaded side of sticking two-sided guides by the minimum-norm reactions; true when a side has
 * changed. */
bool rest_choose_sides(struct rest_system *system);

/* Restore the forces that rest_open found. */
void rest_restore(struct rest_system *system);

/* Change the reactions by `size` times w in the basis. False when memory is out. */
bool rest_move(struct rest_system *system, const double *w, double size);

/* Change the reactions by `size` along basis vector k, which leaves the equations satisfied, without regard
 * to limits. Their slots are in system->forces. False when memory is out. */
bool rest_vary(struct rest_system *system, size_t k, double size);

/* The common distance of a redundant load to its limits, and the modes at zero distance. */
struct rest_margin {
    double size;         /* of the forces: the scale of zero */
    double value, rate;  /* HUGE_VAL if no limit is involved */
    bool *of, *contacts; /* plan.mode_count, plan.contact_count: those involved, in the arena */
    int *gives;          /* plan.mode_count: the mode after slipping or opening, 0 for an unchanged one */
    struct vec *aims;    /* plan.mode_count: of points on a plane that slip, the velocity along both rows */
};

/* The rounding of a margin: a load within this of its limits does not break away. */
static inline double rest_margin_slack(const struct rest_margin *margin)
{
    return negligible_sum * margin->size;
}

/* The limits that a margin includes: all; without friction on planes, which is decided after the others (plane_friction.h); or
 * without the limits of one-sided slides either, which may pull. */
enum rest_scope { rest_all, rest_without_planes, rest_without_guides };

/* Find the margin at the base, right after the rates of change of its slots and of the multipliers along `flow`. False when
 * memory is out. */
bool rest_find_margin(struct rest_system *system, enum rest_scope scope, const double *slots_along,
                      const double *lambda_along, const struct direction *flow, struct rest_margin *margin);

/* The same of a state, right after force_balance_along with the rates of
 * change `flow`. False when no load is redundant, or memory is out
 * (arena->failed). */
bool tree_find_margin(struct fbd_state *state, const struct instant *at, enum rest_scope scope,
                      const struct direction *flow, const double *slots, const double *slots_along,
                      struct arena *arena, struct rest_margin *margin);

/* ---- friction on planes (rest_planes.c) */

/* The value of a limit [N] at the forces of the rows, those of `lambda` or the present ones; `loads`: with the limits of the
 * points. Its rate of change along `flow`, with those of the rows. */
double rest_cut_value(const struct rest_system *system, const struct rest_cut *cut, const double *lambda,
                      bool loads);
double rest_cut_along(const struct rest_system *system, const struct rest_cut *cut,
                      const double *lambda_along, const struct direction *flow);

/* Add the velocities of the points against u, times a multiplier, for those that slip; and mark all of its points. */
void rest_cut_gives(const struct rest_system *system, const struct rest_cut *cut, double multiplier,
                    int *gives, struct vec *aims);
void rest_cut_mark(const struct rest_system *system, const struct rest_cut *cut, bool *of);

/* The largest force that friction on a plane can bear at a point [N], the size of loads that it bears; 0 without planes. */
double rest_plane_limit(const struct rest_system *system);

/* Add limits of the bodies that stick at several points, or at points that share forces with others, where these are below
 * `level` [N] at the present forces, or those to come at rates `lambda_along` where there are none. False when none is added,
 * or memory is out. */
bool rest_cut_planes(struct rest_system *system, const double *lambda_along, double level);

/* Add limits of single points whose forces exceed them by more than `slack` [N]. */
bool rest_cut_points(struct rest_system *system, double slack);

#endif
