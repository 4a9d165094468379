/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Dynamics of the bodies: the articulated-body recursion (Featherstone, Rigid Body Dynamics
 * Algorithms, section 7.3) in three sweeps over the links, with time and memory proportional to their number.
 *
 *   outward  position and velocity of each link, its acceleration for zero joint accelerations (the bias), and
 *            the wrench for that bias, p = I A_bias + velocity terms - applied wrench
 *   inward   articulated inertia and p of each link with its subtree; an unlocked joint passes on
 *            I - U U^T / D and p + U u / D
 *   outward  the accelerations of the joints
 *
 * Wrenches are about the reference point O of their link, components are those of the world, so that the
 * transformation between links is a shift along d, the vector from O to O.
 *
 * A sticking joint is rigid: its acceleration is that of its surface. The friction of a slipping one, f =
 * -slip mu_k N, depends on the force N across the slide, which depends on f again: N = N_0 + A f over all
 * slipping slides of the tree, a small linear system. On a slide that stands alone A is zero.
 */
#ifndef FBD_DYNAMICS_TREE_H
#define FBD_DYNAMICS_TREE_H

#include "dynamics/instant.h"
#include "dynamics/spatial.h"
#include "dynamics/tree_loop.h"

/* One right-hand side of the sweeps. */
struct tree_rhs {
    struct wrench p; /* of the link; after the inward sweep of its subtree */
    double g;        /* generalized force in the joint: moment (pivot, planar), force along e (slide) */
    struct vec gf;   /* of a free joint: its force, in the world */
    double u;        /* g - S . p, the joint force that accelerates the joint */
    struct vec uf;
    struct acceleration A; /* by the outward sweep */
};

/* A link at an instant. */
struct tree_state {
    double angle, omega;
    struct vec turn;          /* cosine and sine of the angle */
    struct vec p, v;          /* of O */
    struct vec d;             /* from the parent's O */
    double mass, I_O, across; /* of the link at this instant, see tree_last_pivot */
    struct vec mr;            /* mass times the vector from O to the centre of mass */
    struct vec e;             /* slide, track: direction of +x; free: that of the x axis of the body below */
    struct acceleration A;    /* first the bias, then the acceleration */
    struct inertia_about_O I; /* articulated inertia, of the subtree */
    double D;                 /* pivot, slide, track: 1 / (S . I S); free: 1 / (J - h . M^-1 h) */
    double Uh;                /* slide: h . e; track: plus J turning */
    struct vec U;             /* slide: M e; track: plus h turning; free: h . inverse of M */
    union {
        double inverse[3];      /* free: the inverse of M, xx, xy, yy */
        struct {                /* track: */
            double bend, slope; /* the curvature and its rate per length; */
            double turning;     /* its rotation per length: the curvature, or 0 if the body does not turn */
        };
    };
    double added[2]; /* the inertia that is added to the joint, as in struct tree_link, or 0 */
    bool locked;     /* the joint sticks */
    double held;     /* then the acceleration of its surface */
    struct wrench F; /* the wrench from the joint on the link, by tree_complete */
};

/* A link's variation along a direction. */
struct tree_variation {
    double angle, omega;
    double turning; /* of a track */
    struct vec p, v, d, e;
    struct acceleration A; /* at fixed accelerations of the joints */
    double held;
    struct vec F; /* of the force of the joint on the link, where events name such forces */
};

/* The force on the joint of a link by a wrench on a link behind it, as u and uf of struct tree_rhs, and the
 * acceleration that it would have alone. */
struct tree_push {
    int link;
    double u, alone;
    struct vec uf, alone_f; /* of a free joint, else 0 */
};

struct tree_bare;
struct closed_loops;
struct row;
struct coupling_state;

struct tree_work {
    struct tree_state *links;                       /* tree.count; links[0] is the ground */
    struct tree_rhs *x;                             /* tree.count */
    struct tree_variation *variation;               /* tree.count */
    struct tree_bare *bare;                         /* tree.count if bodies are jointed, see tree_bare.h */
    struct row *rows;                               /* row_count: constraints, see constraint.h */
    struct coupling_state *couplings;               /* coupling_count: their references from the start */
    struct closed_loops *loops;                     /* or NULL, see closed_loops.h */
    double *lower, *upper, *diagonal, *inverse, *z; /* the system of tree_system.h */
    struct rest_memo *memo;                         /* rest_memo.h */
    double *whole;                  /* lower and upper parts of the system before it was factored */
    double *right, *rest, *ordered; /* unknowns in the order of elimination */
    double *wanted, *left;          /* unknowns: a right-hand side, and the residual of its solution */
    struct tree_rhs *sum;           /* of unknowns: tree.count, and n: results before a correction */
    double *sum_unit;
    int *mark;                /* count: the unknown to which the results of a tree belong */
    struct tree_push *pushes; /* of the active rows, in steps of a symmetric system: */
    int *push_end;            /* row_count + 1: after those of a place, the first at 1 */
    int *acting;              /* acting_count: couplings other than open contacts, in their order */
    int acting_count;
    size_t *envelope;        /* of the active unknowns, see constraint_solve.c: */
    int *unknown_at, *first; /* as in struct tree, which has them for all unknowns */
    int *place;              /* of an unknown, or -1 */
    int *rank;               /* unknowns: number of active unknowns before a place of the tree */
    int count;               /* of active unknowns */
    int *newest, *older;     /* chains of those that act on a tree: see constraint_matrix.c */
    size_t envelope_size;
    double *unit;                        /* n: accelerations that are added */
    double *a, *a_along;                 /* n: accelerations of the last force_balance, and their variation */
    double *taken;                       /* n: the result of tree_rounding */
    double most;                         /* the largest scale of a row */
    const struct tree_massless *unmoved; /* a coordinate whose motion no inertia resists, or NULL */
    double *scale;                       /* unknowns: largest possible diagonals, see constraint_solve.c */
    double damping;         /* of a projection: relative squares of slopes below this are damped out */
    double accuracy;        /* relative, of projected coordinates */
    double tolerance;       /* of the run, relative; 0 without one */
    bool projecting;        /* the system is set up for a projection: no friction */
    bool tentative;         /* modes are tried: a motion without inertia keeps some of the added one */
    bool placing;           /* a projection: inertias that are added are part of its metric */
    bool settling_down;     /* contacts are projected by their gaps only, without sticking friction */
    struct tree_loop *loop; /* of three links, if that is the scene, or NULL: see tree_loop.h */
    bool placed;            /* the places of the unknowns are final: there are no modes */
    bool
        apart; /* solutions are refined by accelerations: masses differ much, or points on planes may be close */
    bool symmetric;     /* there is no friction in the system: it has been assembled by pushes */
    bool direct;        /* factored without a shift: its solution needs no corrections */
    bool shared;        /* indeterminate forces have been distributed, see rest_system.h */
    double shared_size; /* then: the largest force before that, as the scale of rounding */
    bool kept;          /* couplings_keep: sides of lines do not change */
    bool complete;      /* A and F of the links are final, see tree_complete */
    bool rates_only;    /* only the accelerations of the joints are required */
    double fastest;     /* the speed of the fastest link; negative: not yet computed, see constraint.c; */
    double spin;        /* then with the largest angular speed */
    double *borne;      /* count, if there are contacts: largest acceleration by one force */
    int *life;          /* of each lifetime of the scene (scene/loads.h): enum life */
};

/* A load or constraint acts from its begin to its end. */
enum life { life_there, life_over, life_waits };

static inline bool is_there(const struct tree_work *work, int lifetime)
{
    return lifetime == 0 || work->life[lifetime - 1] == life_there;
}

/* Size of a workspace in bytes (a multiple of the size of a double), and its initialization. */
size_t tree_work_size(const struct fbd_model *model);
void tree_work_init(struct tree_work *work, const struct fbd_model *model, void *memory);

/* Compute the accelerations of all bodies, a[n], from the generalized forces in the joints, slots[n].
 * The slots behind receive minus the normal forces and minus the forces of sticking friction, as friction_at
 * expects. Further results are in at->tree. */
void tree_accelerations(const struct fbd_model *model, const struct instant *at, double *slots, double *a);

/* The rounding errors of the joint accelerations, or with `along` of their variations, due to couplings, for
 * the last solution (tree_rounding.c). Returns n values in the workspace. */
const double *tree_rounding(const struct fbd_model *model, const struct instant *at, bool along);

/* Set accelerations that do not exceed that rounding to zero: couplings hold such links at rest. */
void tree_rest(const struct fbd_model *model, const struct instant *at, bool along, double *a);

/* After tree_accelerations: set A of the links to their accelerations, and F to the wrenches of their joints. */
void tree_complete(const struct fbd_model *model, struct tree_work *work);

/* Compute the slots behind the n again from complete results; slots[n] hold the forces in the joints. Those of
 * a link that stands alone are set by tree_alone_slots. */
void tree_slots(const struct fbd_model *model, const struct instant *at, double *slots);

/* The slots of a link, and of a coupling, alone. */
void tree_link_slots(const struct fbd_model *model, const struct instant *at, int i, double *slots);
void tree_coupling_slots(const struct fbd_model *model, const struct instant *at, int index, double *slots);

/* The variation of tree_accelerations along a direction, at the same instant and right after it. On entry
 * slots_along[n] are the variations of the generalized forces in the joints. */
void tree_accelerations_along(const struct fbd_model *model, const struct instant *at,
                              const struct direction *along, const double *slots, const double *a,
                              double *slots_along, double *a_along);

/* The link of a body. */
static inline const struct tree_state *body_link(const struct model_body *body, const struct instant *at)
{
    return &at->tree->links[body->place.link];
}

/* The acceleration of a point of a body at a place in the world, when complete. */
struct vec tree_point_acceleration(const struct model_body *body, struct vec place, const struct instant *at);

/* The inertial term in the equation of a joint coordinate beside the forces: of a pivot on a body the moment
 * -m r x a_O of its accelerated axis; of a body that turns along a track -kappa (I_G alpha + r x m a_G). */
bool tree_has_more(const struct model_body *body);
double tree_more(const struct model_body *body, const struct instant *at);

/* Kinematics only: positions, velocities and inertias of the links. */
void tree_move(const struct fbd_model *model, const struct instant *at);

void tree_move_joined(const struct fbd_model *model, const struct instant *at);
void tree_move_alone(const struct fbd_model *model, const struct instant *at);

/* The same for a tree of pivots and slides, given cosine and sine of the angles. */
void tree_move_turned(const struct fbd_model *model, const struct instant *at, const struct vec *turns);

/* ---- parts, for the files of the tree */

/* The variation of positions and velocities of jointed links (tree_motion.c). */
void tree_move_along(const struct fbd_model *model, const struct instant *at, const struct direction *along);

/* The bias accelerations and p of jointed links without applied loads; the variation at fixed accelerations a[n] of the joints (tree_bias.c). */
void tree_bias(const struct tree *tree, const struct instant *at, int n);
void tree_bias_along(const struct tree *tree, const struct instant *at, const struct direction *along, int n,
                     const double *a);

/* Subtract applied loads from p of their links; their variation (tree_loads.c). */
void tree_load(const struct tree *tree, const struct instant *at, const struct link_loads *loads);
void tree_load_along(const struct tree *tree, const struct instant *at, const struct direction *along,
                     const struct link_loads *loads);

/* Variable masses (tree_mass.c): inertias of the links at this instant, the weights of such bodies, and the
 * variation of both. */
void tree_weigh(const struct tree *tree, const struct instant *at);
void tree_weights(const struct tree *tree, const struct instant *at);
void tree_bulk_along(const struct tree *tree, const struct instant *at, const struct direction *along);

/* One link that stands alone (tree_alone.c), without sweeps: first all of its state that does not change, and minus
 * the wrench of its constant forces. Its accelerations; unless work->rates_only also its A and F, and its slots, which
 * are the sums of the applied forces across and along its line in each mode. The variation of both. */
void tree_begin_alone(const struct tree_link *link, struct tree_state *s);
struct wrench tree_alone_weight(const struct tree_link *link, const struct tree_state *s);
void tree_accelerate_alone(const struct fbd_model *model, const struct instant *at, int i, double *slots,
                           double *a);
void tree_alone_slots(const struct fbd_model *model, const struct instant *at, int i, double *slots);
void tree_vary_alone(const struct fbd_model *model, const struct instant *at, const struct direction *along,
                     int i, const double *slots, double *slots_along, double *a_along);

/* The variation of positions and velocities of all of them. */
void tree_move_alone_along(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along);

/* The sweeps (tree_sweep.c). Inward with the inertias of jointed links, once for an instant (those of links that stand
 * alone are known); then inward for any number of right-hand sides in work->x. Outward: accelerations of the joints
 * to a[n]. */
void tree_factor(const struct tree *tree, struct tree_work *work);

/* Links from `from` up to `to` (not included), which are whole trees. */
void tree_inward(const struct tree *tree, struct tree_work *work, int from, int to);
void tree_outward(const struct tree *tree, struct tree_work *work, int from, int to, double *a);

/* Inward along the paths from `count` links, at[], to the ground: the forces on their joints by wrenches p[] on
 * these links (minus the applied ones), from the last link to the first. Returns their number; overwrites both. */
int tree_push(const struct tree *tree, const struct tree_work *work, int *at, struct wrench *p, int count,
              struct tree_push *pushes);

/* Does any slide slip whose friction depends on its normal force? */
bool tree_slips(const struct tree *tree, const struct instant *at);

/* c_k = slip mu_k of the slide of link i, 0 when it sticks; its variation. */
double tree_slip_share(const struct fbd_model *model, const struct instant *at, int i);

/* The part of the articulated inertia I that a free pivot passes on, D = 1 / J: M - h h^T / J. */
static inline struct inertia_about_O tree_pivot(const struct inertia_about_O *I, double D)
{
    struct vec hD = vec_scale(D, I->h);
    return (struct inertia_about_O){
        0, {0, 0}, I->xx - hD.x * I->h.x, I->xy - hD.x * I->h.y, I->yy - hD.y * I->h.y};
}

/* The same for the last link of a chain: M = m 1, h = m k x r, and as h h^T + m r m r^T = |m r|^2 1 it is
 *
 *     (m - |m r|^2 / J) 1 + m r m r^T / J
 *
 * and m - |m r|^2 / J = m I_G / J is a constant. This is a sum of squares; the difference cancels: with it a
 * cart of 1e-6 kg under a pole of 1 kg had only ten digits of acceleration where the pole is vertical. */
static inline struct inertia_about_O tree_last_pivot(double across, struct vec mr, double D)
{
    struct vec r = vec_scale(D, mr);
    return (struct inertia_about_O){0, {0, 0}, across + r.x * mr.x, r.x * mr.y, across + r.y * mr.y};
}

/* The outward normal of the surface of the slide of link i. */
static inline struct vec tree_normal(const struct tree *tree, const struct tree_work *work, int i)
{
    return vec_scale(tree->links[i].side, vec_perp(work->links[i].e));
}

/* Is an inertia added to a coordinate, by tree_factor? */
static inline double tree_added(const struct tree *tree, const struct tree_work *work,
                                const struct tree_massless *massless)
{
    const struct tree_state *s = &work->links[massless->link];
    const struct joint_type *joint = link_joint(&tree->links[massless->link]);
    return s->locked ? 0 : s->added[massless->local > 0 && massless->local == joint->angle];
}

/* Does any coordinate have one? */
bool tree_lacks_inertia(const struct tree *tree, const struct tree_work *work);

/* The normal force at the slide of link i for the right-hand side solved last. */
double tree_normal_in(const struct tree *tree, const struct tree_work *work, int i);

/* The generalized force of a force and a moment about O along the one coordinate of a joint. */
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

/* The same along each coordinate of any joint. */
static inline void joint_shares(const struct joint_type *joint, const struct tree_state *s, struct wrench F,
                                double own[static most_coordinates_of_a_body])
{
    const double along = vec_dot(s->e, F.force), across = vec_cross(s->e, F.force);
    for (int k = 0; k < joint->count; k++) own[k] = k == joint->angle ? F.moment : k == 0 ? along : across;
    if (joint->path == path_curve) own[0] += s->turning * F.moment;
}

/* The number of coordinates of a joint. */
static inline int joint_freedom(enum motion_kind kind)
{
    return joint_types[kind].count;
}

#endif
