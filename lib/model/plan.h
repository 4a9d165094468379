/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plan: the effects that the right-hand side computes.
 *
 * Every effect is added to slots. Slot i < n is the generalized force of coordinate i (a force along a slide,
 * a moment about a pivot, ...) by the springs, dampers and potentials in the joint. The following slots are the
 * sums of the forces across slides whose normal force is needed, and the forces of friction. For each kind of
 * effect there is one dense list, empty when no body lists it. All other loads are in the lists of the tree.
 *
 * Dry friction is not a term: it depends on a mode (stick, slip+, slip-) and on the normal force, so it is
 * computed after the terms.
 */
#ifndef FBD_MODEL_PLAN_H
#define FBD_MODEL_PLAN_H

#include "base/vec.h"
#include "expr/expr.h"

struct user_event;

/* An expression in use: a constant, or a program with the index of its branches. */
struct formula {
    const struct expr *expr; /* NULL: absent, or a constant already read */
    double constant;
    int branch; /* of its first switch in the state's branches */
};

static inline bool formula_is_constant(const struct formula *formula)
{
    return formula->expr == NULL;
}

/* A spring, damper or constant force in a joint: Q += c0 - kq q - kv v. */
struct affine_term {
    int coordinate, link;
    int lifetime; /* its number (scene/loads.h), or 0 */
    double c0, kq, kv;
};

/* scale * value(t, q, v) */
struct formula_term {
    double scale;
    struct formula value;
};

/* Q -= dV/dq */
struct potential_term {
    int coordinate, link;
    int lifetime; /* as of an affine term */
    struct formula V;
};

/* The kinds of modes. A one-sided constraint is closed (`stick`) or open (`slip_plus`). */
enum mode_kind {
    mode_single, /* dry friction along the coordinate of a body that stands alone: decided independently */
    mode_joint, /* dry friction along the coordinate of a jointed body: decided with all modes at rest there */
    mode_tangent, /* dry friction along the tangent of a coupling: rolling, contact, capstan */
    mode_plane,   /* dry friction in any direction of a plane: see dynamics/plane_friction.h */
    mode_rope,    /* one-sided: taut or slack; see coupling.h */
    mode_surface, /* one-sided: a rolling body touches its line or has left it */
    mode_contact, /* one-sided: shapes touch or are apart; see contact.h */
    mode_drive,   /* always sticks, at `position` */
    mode_kinds
};

/* A unilateral constraint, dry friction or drive with its mode. */
struct mode {
    enum mode_kind kind;
    int body, load, coordinate;
    int normal_slot; /* -1 for a bearing whose limits are moments; of a journal bearing that of its reaction */
    bool moment;     /* friction of a bearing, or rolling resistance: its force is a moment */
    bool two_sided;  /* a guide: friction is proportional to |N| */
    struct formula mu_s, mu_k, surface_speed;
    bool moving;             /* the surface moves */
    double inertia;          /* mode_single: m or I_O */
    int hold_slot;           /* the sticking force is inertia times acceleration minus this slot */
    int coupling;            /* index into tree.couplings; -1 for friction along `coordinate` */
    struct formula position; /* of a drive */
};

static inline bool mode_is_friction(const struct mode *mode)
{
    return mode->kind <= mode_plane;
}

/* Is one of its coefficients an expression? */
static inline bool mode_friction_varies(const struct mode *mode)
{
    return mode->mu_s.expr || mode->mu_k.expr;
}

/* Along a coordinate, on a slide or in a bearing. */
static inline bool mode_is_joint_friction(const struct mode *mode)
{
    return mode->kind <= mode_joint;
}

static inline bool mode_is_one_sided(const struct mode *mode)
{
    return mode->kind == mode_rope || mode->kind == mode_surface || mode->kind == mode_contact;
}

/* A normal force that must not become tensile: `pair` is the mode that then opens, or -1 where the body
 * cannot leave its surface, which ends the run. */
struct contact {
    int body, load, slot, pair;
};

/* The switches of one formula (see expr.h). */
struct kink {
    struct formula formula;
    int body, load; /* its load; -1 for a user event and for the rate of a state */
    int own;        /* the user state, or -1 */
    size_t count;
    bool reacts;     /* it names a reaction */
    bool slides;     /* some of its switches admit a sliding mode: see dynamics/sliding.h */
    unsigned places; /* a bit for each switch on a sum of coordinates: second-order sliding mode */
};

static inline bool kink_watches_places(const struct kink *kink, int part)
{
    return part < 32 && (kink->places >> part & 1);
}

/* The divisions of one formula (see expr.h). */
struct pole {
    struct formula formula;
    int body, load; /* its load; -1 for the rate of a state */
    int own;        /* the user state, or -1 */
    size_t count;
};

/* A user event: it occurs where left - right crosses zero. */
struct watch {
    const struct user_event *source;
    struct formula left, right;
    bool reacts;  /* it names a reaction */
    int coupling; /* the first coupling of the constraint that begins or ends there, or -1 */
    int load;     /* the force or moment that does, or -1 */
};

/* Variables that a sum of forces may depend on. */
enum {
    depends_time = 1,
    depends_place = 2, /* coordinates of the body itself */
    depends_rate = 4,  /* rates of the body itself */
    depends_other = 8  /* coordinates or rates of other bodies */
};

/* A part of a list: `count` entries from `first` on. */
struct range {
    int first, count;
};

/* One past its last. */
static inline int range_end(struct range range)
{
    return range.first + range.count;
}

/* The equation of motion of a coordinate of a body that stands alone (tree.h), on a slide, a pivot or as a particle.
 * Where `known`, the forces along it are functions of t, q, v and other variables of formulas, and so are the forces
 * across its line:
 *
 *     q'' = inverse_inertia (c0 - kq q - kv v - square |v| v + s sin q + c cos q + sum of formulas + friction)
 *
 * and N = -(across + sum of across_formulas) on a slide. */
struct scalar_equation {
    bool known;
    double c0, kq, kv, square, s, c;
    double across;
    struct range formulas, across_formulas;
};

struct plan {
    int n;                   /* coordinates */
    int slots;               /* n + normal slots */
    int own;                 /* user states: entries 2 n and on of y */
    size_t size;             /* 2 n + own: the length of y = [q, v, z] */
    struct formula *rates;   /* own: their time derivatives */
    double *inverse_inertia; /* n: 1/m, 1/I_O or 1/I_G */

    size_t affine_count, potential_count;
    struct affine_term *affine; /* in joints */
    struct potential_term *potentials;
    struct scalar_equation *equations; /* by coordinate */
    struct formula_term *formulas;     /* of the equations */

    size_t mode_count, contact_count, kink_count, pole_count, watch_count;
    struct mode *modes;
    struct contact *contacts;
    struct kink *kinks;
    struct pole *poles;
    struct watch *watches;

    int branches;        /* ints of a state for the branches of the kinks */
    int slide_count;     /* switches that admit a sliding mode */
    bool *slot_constant; /* slots: the sum is constant */
};

static inline size_t plan_size(const struct plan *plan)
{
    return plan->size;
}

/* Index of the first user state in y. */
static inline size_t plan_own_place(const struct plan *plan)
{
    return 2 * (size_t)plan->n;
}

/* The length of [a, z'], the part of y' after v. */
static inline size_t plan_rates(const struct plan *plan)
{
    return plan->size - (size_t)plan->n;
}

#endif
