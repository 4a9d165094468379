/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Statics: the reactions that hold a scene at rest in its position.
 *
 * The multipliers lambda of the constraints are the only unknowns: joint reactions, friction and drive forces
 * are affine functions of them (dynamics/statics.h). So
 *
 *     E lambda = -Q_0     for the free coordinates, by orthogonal reflections (moments over a length);
 *
 * where E has null vectors z the scene is statically indeterminate, and the reactions r = r_0 + R lambda are
 * chosen with the least sum of squares (couples over the length), subject to N >= 0, |F| <= mu_s N and T >=
 * 0: a least-distance problem (least_distance.h) in the coordinates of the null space. A residual E lambda +
 * Q_0 moves the scene; the forces that would balance it are found by virtual work, from the null vectors of
 * E^T.
 */
#ifndef FBD_REST_STATICS_H
#define FBD_REST_STATICS_H

#include "dynamics/constraint.h"
#include "dynamics/diagram.h"
#include "dynamics/rest_system.h"
#include "fbd_study.h"

/* The free-body diagram of one body at rest. */
struct rest_diagram {
    struct arrow *arrows;
    size_t count;
};

struct fbd_statics {
    const struct fbd_model *model;
    struct arena arena;
    struct fbd_state *state;       /* at rest; its F, lambda and slots are those of the solution */
    size_t indeterminacy;          /* dimension of the set of reactions in equilibrium */
    size_t mobility;               /* degrees of freedom left by constraints, friction and drives */
    bool within_limits;            /* normal forces, friction, tensions */
    double force, length;          /* scales: of the loads, of the arms */
    double left;                   /* residual of Q, relative to the size of the loads */
    struct rest_diagram *diagrams; /* by body */
    size_t unbalanced_count, limit_count, undetermined_count, member_count;
    fbd_unbalanced *unbalanced;
    fbd_limit *limits;
    fbd_member *members;
    const char **undetermined;
};

/* Does the body have an equation of moments? A body that slides on the ground, or is a particle, does not
 * turn, and its couple is not listed. */
static inline bool rest_turns(const struct model_body *body)
{
    return !body->joint->prevents_turning && !body_never_turns(body);
}

/* The tension of a rod or a rope; NAN for another coupling, 0 for a slack rope. */
static inline double rest_tension(const struct fbd_statics *statics, int coupling)
{
    const struct coupling *of = &statics->model->tree->couplings[coupling];
    if (!of->law->length) return NAN;
    return -statics->state->tree->rows[of->first_row].lambda;
}

/* Report a user state whose rate is not zero at rest. */
bool statics_refuse_states(const struct fbd_state *state, fbd_errors *errors);

/* The names of the reactions that equilibrium does not determine, into statics->undetermined. */
bool rest_name_undetermined(struct fbd_statics *statics, const struct rest_system *system);

/* Store the possible motions, the residual along them, and the balancing forces in statics->unbalanced. */
bool rest_find_unbalanced(struct fbd_statics *statics, const struct rest_system *system);

#endif
