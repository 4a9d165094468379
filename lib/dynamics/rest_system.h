/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reactions that equilibrium alone does not determine, shared within limits: at rest, and as a scene moves.
 *
 * The multipliers lambda of the constraints are the only unknowns: what joints pass on, what friction and
 * drives hold, follows from them (statics.h), affinely,
 *
 *     r = r_0 + R lambda,    limits h_0 + H lambda >= 0:    N >= 0, |F| <= mu_s N, T >= 0
 *
 * At rest lambda balances the coordinates that nothing holds, E lambda = -Q_0. As a scene moves its
 * accelerations are known, and lambda with them but for the null vectors Z of E. In both cases lambda + Z y
 * does as well for every y, and shown are the reactions of least |r|^2 within the limits (couples over a
 * length): a least-distance problem (least_distance.h).
 *
 * Null vectors that have neither a reaction nor a limit in common do not feel each other: each such part is a problem of
 * its own. In a stack of boxes that is how the two corners of each share what is between them.
 *
 * Whether there are any within the limits is told by the largest s with h(y) >= s for all limits that y
 * moves: a linear programme, max s. It is below zero when there are none, and its rate of change is that of
 * the limits at its multipliers u, s' = sum u_i h_i', since u is orthogonal to whatever y does.
 */
#ifndef FBD_DYNAMICS_REST_SYSTEM_H
#define FBD_DYNAMICS_REST_SYSTEM_H

#include "base/arena.h"
#include "dynamics/constraint.h"
#include "dynamics/diagram.h"
#include "dynamics/statics.h"
#include "numeric/qr.h"

/* The system and its solution. */
struct rest_system {
    struct fbd_state *state;
    struct instant at;
    struct arena *arena;
    size_t n, m, slots, reactions; /* coordinates, rows that take part, plan.slots, entries of r */
    int *rows;                     /* m: their numbers */
    const double *accelerations;   /* n */
    bool *held;                    /* n */
    double *scale;                 /* n: 1, or one over the length for an angle; 0 for what is held */
    double *lambda;                /* row_count: what is added to those of the base */
    struct rest_base {             /* the forces as the scene moves; at rest nothing */
        bool moves;
        double *slots, *lambda; /* slots; row_count */
        struct wrench *F;       /* tree.count */
    } base;
    double *forces;           /* slots: with the present lambda */
    double *Q, *E;            /* n; n x m, scaled */
    double *slots0, *columns; /* slots; slots x m */
    double *r, *R;            /* reactions; reactions x m */
    double force, length;
    struct qr qr;       /* of E */
    double *least;      /* m: from the base to the least reactions, limits or not */
    double *basis;      /* m x indeterminacy: lambda for a unit of r */
    size_t basis_count; /* indeterminacy */
    int *part;          /* indeterminacy: which part of the problem each of them is in */
    int parts;
    bool within_limits;
};

/* Three entries of r for each link, then one for each row that takes part: of a pivot F_x, F_y and the moment
 * that is held; of a slide what is held along it, N and the couple. */
static inline size_t rest_entry_of_row(const struct rest_system *system, size_t j)
{
    return system->reactions - system->m + j;
}

/* Set up and solve for lambda: the state is left with the reactions. False when memory is out. */
bool rest_solve(struct rest_system *system, struct fbd_state *state, struct arena *arena);
void rest_free(struct rest_system *system);

/* A limit of what is held; the kinds in the order of fbd_limit_kind. */
struct rest_limit {
    enum rest_limit_kind { limit_normal, limit_friction, limit_rope } kind;
    int index;          /* of the contact, or of the pair */
    double needed, may; /* normal and rope: the force, and 0; friction: |F| and its limit */
};

/* Is what the mode limits an entry of its own? What a surface may do is that of its normal force. */
static inline bool rest_has_limit(const struct mode *mode)
{
    return mode_is_friction(mode) || mode->kind == mode_rope;
}

/* The number of limits, and limit `index` in the state's present slots. */
size_t rest_limits(const struct rest_system *system);
struct rest_limit rest_limit_at(const struct rest_system *system, size_t index);

/* Do constraints that take part leave multipliers open, as far as the elimination tells? */
bool rest_is_open(const struct fbd_model *model, const struct instant *at);

/* All limits as functions h >= 0 at the present lambda: their number, what they are, what counts as zero; and
 * their slopes in the basis, values x basis_count, added to G (false when memory is out). */
size_t rest_limit_values(const struct rest_system *system);
void rest_read_limits(const struct rest_system *system, double *values);
double rest_limit_slack(const struct rest_system *system);
bool rest_limit_slopes(struct rest_system *system, double *G);

/* Set the basis from the null vectors of E, and take from `start` what leads to the least reactions, limits or not. False
 * when memory is out. */
bool rest_set_basis(struct rest_system *system, double *start);

/* Part `which`: its basis vectors and the limits that they move, with the slopes of these in it. */
struct rest_part {
    size_t size, limits;
    size_t *column, *limit; /* size, limits */
    double *G;              /* limits x size */
};
bool rest_part(const struct rest_system *system, const double *G, int which, struct rest_part *part);

/* The same of a state as it moves, evaluated in its modes: false when its constraints leave nothing open, or
 * memory is out (arena->failed). */
bool rest_open(struct rest_system *system, struct fbd_state *state, const struct instant *at,
               const double *slots, const double *accelerations, struct arena *arena);

/* Share what is open: slots, and the forces in the links and rows of the state's tree, are then those of the
 * least reactions within limits. */
void rest_share(struct rest_system *system, double *slots);

/* Let what sticks on a guide with two sides press where the least reactions do; true when that is another
 * side than before. */
bool rest_choose_sides(struct rest_system *system);

/* Put back what rest_open found. */
void rest_restore(struct rest_system *system);

/* Go from there by `size` along basis vector k: reactions that do as well, limits or not. Their slots are in
 * system->forces. False when memory is out. */
bool rest_vary(struct rest_system *system, size_t k, double size);

/* What is left to the limits of a shared load, all together; what gives when it is used up. */
struct rest_margin {
    double size;         /* of the forces: zero is measured against it */
    double value, rate;  /* HUGE_VAL where no limit takes part */
    bool *of, *contacts; /* plan.mode_count, plan.contact_count: those that take part, in the arena */
    int *gives;          /* plan.mode_count: the mode in which it gives, 0 for one that keeps */
};

/* The rounding of a margin: a load that only just reaches its limits does not break away by that. */
static inline double rest_margin_slack(const struct rest_margin *margin)
{
    return 1e-12 * margin->size;
}

/* At the base, right after the rates of change of its slots and of the multipliers of the rows along `flow`.
 * With `guides` the normal forces of slides with one side count; without, these may pull. False when memory
 * is out. */
bool rest_find_margin(struct rest_system *system, bool guides, const double *slots_along,
                      const double *lambda_along, const struct direction *flow, struct rest_margin *margin);

#endif
