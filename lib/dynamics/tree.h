/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dynamics of the jointed bodies: the articulated-body recursion (Featherstone, Rigid Body Dynamics
 * Algorithms, section 7.3) in three sweeps over the links, with time and memory proportional to their number.
 *
 *   outward  where each link is, how it moves, and how it would accelerate if no joint gave way (the bias);
 *            what keeps it on that course, p = I A_bias + velocity terms - applied wrench
 *   inward   the inertia that each link has with all that hangs on it, and p likewise: a joint that gives way
 *            passes on I - U U^T / D and p + U u / D
 *   outward  the accelerations of the joints
 *
 * Wrenches are about the reference point O of their link, components are those of the world, so that going
 * from link to link is a shift along d, the vector from O to O.
 *
 * A sticking joint gives nothing away: its acceleration is that of its surface. The friction of a slipping
 * one, f = -slip mu_k N, goes with the force N across the slide, which depends on f again: N = N_0 + A f over
 * all slipping slides of the tree, a small linear system.
 */
#ifndef FBD_DYNAMICS_TREE_H
#define FBD_DYNAMICS_TREE_H

#include "dynamics/instant.h"
#include "dynamics/spatial.h"
#include "dynamics/tree_loop.h"

/* One right-hand side on its way through the sweeps. */
struct tree_rhs {
    struct wrench p; /* of the link alone; after the inward sweep with all that hangs on it */
    double g;        /* generalized force in the joint: moment (pivot, planar), force along e (slide) */
    struct vec gf;   /* of a free joint: its force, in the world */
    double u;        /* what the joint has left of g and gf to give way */
    struct vec uf;
    struct acceleration A; /* by the outward sweep */
};

/* A link at an instant. */
struct tree_state {
    double angle, omega;
    struct vec turn;          /* cosine and sine of the angle */
    struct vec p, v;          /* of O */
    struct vec d;             /* from the parent's O */
    double mass, I_O, across; /* those of the link, at this instant */
    struct vec mr;            /* mass times the vector from O to the centre of mass */
    struct vec e;             /* slide, track: direction of +x; free: that of the x axis of the body below */
    struct acceleration A;    /* first the bias, then the acceleration */
    struct inertia_about_O I; /* with all that hangs on it */
    double D;                 /* pivot, slide, track: 1 / (S . I S); free: 1 / what is left of J */
    double Uh;                /* slide: h . e; track: J turning beside */
    struct vec U;             /* slide: M e; track: h turning beside; free: h . inverse of M */
    union {
        double inverse[3];      /* free: the inverse of M, xx, xy, yy */
        struct {                /* track: */
            double bend, slope; /* the curvature and its rate per length; */
            double
                turning; /* its rate of turning per length: the curvature, or 0 where the body does not turn */
        };
    };
    bool locked;     /* it sticks */
    double held;     /* then the acceleration of its surface */
    struct wrench F; /* what the joint passes to the link, by tree_transmitted */
};

/* A link's variation along a direction. */
struct tree_variation {
    double angle, omega;
    double turning; /* of a track */
    struct vec p, v, d, e;
    struct acceleration A; /* at fixed accelerations of the joints */
    double held;
};

struct tree_bare;
struct row;
struct coupling_state;

struct tree_work {
    struct tree_state *links;                       /* tree.count; links[0] is the ground */
    struct tree_rhs *x;                             /* tree.count */
    struct tree_variation *variation;               /* tree.count */
    struct tree_bare *bare;                         /* tree.count, see tree_bare.h */
    struct row *rows;                               /* row_count: constraints, see constraint.h */
    struct coupling_state *couplings;               /* coupling_count: what they keep of the start */
    double *lower, *upper, *diagonal, *inverse, *z; /* the system of tree_system.h */
    struct rest_memo *memo;                         /* rest_memo.h */
    double *whole;                  /* lower and upper parts of the system before it was factored */
    double *right, *rest, *ordered; /* unknowns in the order of elimination */
    double *wanted, *left;          /* unknowns: a right-hand side, and what its solution has left of it */
    struct tree_rhs *sum;           /* tree.count, and n: answers before a correction */
    double *sum_unit;
    int *mark;        /* count: which unknown a tree answers to */
    size_t *envelope; /* of the unknowns that take part in the system, see constraint_solve.c: */
    int *unknown_at, *first, *reach; /* what struct tree has of all of them */
    int *place;                      /* of an unknown, or -1 */
    int *rank;                       /* unknowns + 1: how many take part before a place of the tree */
    int count;                       /* how many do */
    size_t envelope_size;
    double *unit;        /* n: accelerations that are added */
    double *a, *a_along; /* n: accelerations of the last force_balance, and their variation */
    double *taken;       /* n: by tree_rounding */
    double most;         /* the largest scale of a row */
    double *scale;       /* unknowns: how large the diagonals could be, see constraint_solve.c */
    double damping;      /* of a projection: slopes whose square is less than this share are left alone */
    double accuracy;     /* relative, of the coordinates that are projected */
    bool projecting;     /* the system is set up for a projection: no friction */
    bool settling_down;  /* contacts are brought to their places: their gaps alone count, not what sticks */
    bool is_loop;        /* the scene is the loop of three links that follows, see tree_loop.h */
    struct tree_loop loop;
    bool placed;        /* the places of the unknowns are known, for good: there are no modes */
    bool apart;         /* masses are so far apart that solutions are refined by their accelerations */
    bool symmetric;     /* there is no friction in the system */
    bool direct;        /* it was factored as it stands, and its solution needs no corrections */
    bool shared;        /* what constraints leave open is shared in them, see rest_system.h */
    double shared_size; /* then: the largest force that was there before, which has given its rounding */
    bool kept;          /* couplings_keep: on which side of a line a body is stays as it has been */
    bool complete;      /* A and F of the links are final, see tree_complete */
    bool rates_only;    /* nobody asks for anything but the accelerations of the joints */
    double fastest;     /* the speed of the fastest link; negative: to be found, see constraint.c; */
    double spin;        /* then with the largest angular speed */
    double *borne;      /* count, where there are contacts: what one force alone would do to a link [m/s^2] */
};

/* Bytes that a workspace needs (a multiple of the size of a double), and laying it out. */
size_t tree_work_size(const struct fbd_model *model);
void tree_work_init(struct tree_work *work, const struct fbd_model *model, void *memory);

/* The accelerations of the jointed bodies into a[n], given the generalized forces in the joints, slots[n].
 * The slots behind get minus the normal forces and minus what holds the sticking pairs, as friction_at
 * expects. The rest of the results is in at->tree. */
void tree_accelerations(const struct fbd_model *model, const struct instant *at, double *slots, double *a);

/* The rounding of the accelerations of the joints, or with `along` of their variations, by couplings (tree_rounding.c): n, in
 * the workspace. Of the solution that was last. */
const double *tree_rounding(const struct fbd_model *model, const struct instant *at, bool along);

/* What friction on one link holds by couplings is at rest: make zero what is no more than that rounding. */
void tree_rest(const struct fbd_model *model, const struct instant *at, bool along, double *a);

/* After tree_accelerations: make A of the links their accelerations, and F what their joints pass to them. */
void tree_complete(const struct fbd_model *model, struct tree_work *work);

/* The slots behind the n, once more, from complete results; slots[n] hold the forces in the joints. */
void tree_slots(const struct fbd_model *model, const struct instant *at, double *slots);

/* The variation of tree_accelerations along a direction, at the same instant and right after it. On entry
 * slots_along[n] are the variations of the generalized forces in the joints. */
void tree_accelerations_along(const struct fbd_model *model, const struct instant *at,
                              const struct direction *along, const double *slots, const double *a,
                              double *slots_along, double *a_along);

/* The acceleration of a place of a jointed body in the world, of its centre of mass, and its angular one, when complete. */
struct vec tree_point_acceleration(const struct model_body *body, struct vec place, const struct instant *at);
struct vec tree_mass_center_acceleration(const struct model_body *body, const struct instant *at);
double tree_angular_acceleration(const struct model_body *body, const struct instant *at);

/* What stands in the equation along the coordinate of its joint beside forces: of a pivot on a body the moment
 * -m r x a_O of its axis, which accelerates itself; of what turns along a track -kappa (I_G alpha + r x m a_G). */
bool tree_has_more(const struct model_body *body);
double tree_more(const struct model_body *body, const struct instant *at);

/* Kinematics alone: where the links are, how they move, and what of them there is. */
void tree_move(const struct fbd_model *model, const struct instant *at);

/* The same for a tree of pivots and slides, whose links that turn are known to be turned so. */
void tree_move_turned(const struct fbd_model *model, const struct instant *at, const struct vec *turns);

/* ---- parts, for the files of the tree */

/* The variation of where the links are and how they move (tree_motion.c). */
void tree_move_along(const struct fbd_model *model, const struct instant *at, const struct direction *along);

/* The bias accelerations and p of the links without what acts on them; their variation at fixed accelerations
 * a[n] of the joints (tree_bias.c). */
void tree_bias(const struct tree *tree, const struct instant *at, int n);
void tree_bias_along(const struct tree *tree, const struct instant *at, const struct direction *along, int n,
                     const double *a);

/* Subtract what acts on the links from their p; its variation (tree_loads.c). */
void tree_load(const struct tree *tree, const struct instant *at);
void tree_load_along(const struct tree *tree, const struct instant *at, const struct direction *along);

/* Masses that vary (tree_mass.c): what the links are at this instant, the weights of such bodies, and how both vary. */
void tree_weigh(const struct tree *tree, const struct instant *at);
void tree_weights(const struct tree *tree, const struct instant *at);
void tree_bulk_along(const struct tree *tree, const struct instant *at, const struct direction *along);

/* The sweeps (tree_sweep.c). Inward, with the inertias: once for an instant. Then again and again for other
 * right-hand sides in work->x. Outward: accelerations of the joints to a[n]. */
void tree_factor(const struct tree *tree, struct tree_work *work);

/* Links from `from` up to `to` (not included), which are whole trees. */
void tree_inward(const struct tree *tree, struct tree_work *work, int from, int to);
void tree_outward(const struct tree *tree, struct tree_work *work, int from, int to, double *a);

/* All of it at once for a tree of free pivots, tree->pivots_only (tree_pivots.c). */
void tree_pivots(const struct fbd_model *model, const struct instant *at, const double *slots, double *a);

/* Does any slide slip whose friction goes with its normal force? */
bool tree_slips(const struct tree *tree, const struct instant *at);

/* c_k = slip mu_k of the slide of link i, 0 when it sticks; its variation. */
double tree_slip_share(const struct fbd_model *model, const struct instant *at, int i);

/* What a free pivot passes on of the inertia I that it has with all behind it, D = 1 / J: M - h h^T / J. */
static inline struct inertia_about_O tree_pivot(const struct inertia_about_O *I, double D)
{
    struct vec hD = vec_scale(D, I->h);
    return (struct inertia_about_O){
        0, {0, 0}, I->xx - hD.x * I->h.x, I->xy - hD.x * I->h.y, I->yy - hD.y * I->h.y};
}

/* The same where nothing is behind: M = m 1, h = m k x r, and as h h^T + m r m r^T = |m r|^2 1
 * it is
 *
 *     (m - |m r|^2 / J) 1 + m r m r^T / J
 *
 * and m - |m r|^2 / J = m I_G / J is a constant: a sum of squares, where the difference loses what is left of m to
 * a force along the rod - a cart of 1e-6 kg under a pole of 1 kg that passes the vertical had its acceleration to
 * ten digits. */
static inline struct inertia_about_O tree_last_pivot(double across, struct vec mr, double D)
{
    struct vec r = vec_scale(D, mr);
    return (struct inertia_about_O){0, {0, 0}, across + r.x * mr.x, r.x * mr.y, across + r.y * mr.y};
}

/* The direction that the surface of the slide of link i pushes to. */
struct vec tree_normal(const struct tree *tree, const struct tree_work *work, int i);

/* The normal force at the slide of link i in the right-hand side that was solved last. */
double tree_normal_in(const struct tree *tree, const struct tree_work *work, int i);

/* What a force and a moment about O do along the one coordinate of a joint. */
static inline double joint_share(const struct tree_link *link, const struct tree_state *s, struct wrench F)
{
    if (link->kind == motion_pivot) return F.moment;
    double along = vec_dot(s->e, F.force);
    return link->kind == motion_track ? along + s->turning * F.moment : along;
}

/* Its variation with the directions of the joint. */
static inline double joint_share_along(const struct tree_link *link, const struct tree_variation *d,
                                       struct wrench F)
{
    if (link->kind == motion_pivot) return 0;
    double along = vec_dot(d->e, F.force);
    return link->kind == motion_track ? along + d->turning * F.moment : along;
}

/* The number of coordinates of a joint. */
static inline int joint_freedom(enum motion_kind kind)
{
    return kind == motion_weld ? 0 : kind == motion_planar ? 3 : kind == motion_particle ? 2 : 1;
}

#endif
