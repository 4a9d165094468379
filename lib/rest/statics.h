/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Statics: the reactions that hold a scene at rest where it is.
 *
 * The multipliers lambda of the constraints are the only unknowns: what joints pass on, what friction and
 * drives hold, follows from them (dynamics/statics.h), affinely. So
 *
 *     E lambda = -Q_0     for the coordinates that nothing holds, by singular values (moments over a length);
 *
 * where E has null vectors z the scene is statically indeterminate, and of all reactions r = r_0 + R lambda
 * those of the least sum of squares are taken (couples over the length), subject to N >= 0, |F| <= mu_s N and
 * T >= 0: a least-distance problem (least_distance.h) in the coordinates of the null space. What is left of
 * E lambda + Q_0 moves the scene; what would hold it is found by virtual work, from the null vectors of E^T.
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
    size_t indeterminacy;          /* dimensions of the sets of reactions that balance */
    size_t mobility;               /* ways to move that constraints, friction and drives leave */
    bool within_limits;            /* normal forces, friction, tensions */
    double force, length;          /* sizes: of the loads, of the arms */
    double left;                   /* of Q, as a share of the size of the loads */
    struct rest_diagram *diagrams; /* by body */
    size_t unbalanced_count, limit_count, undetermined_count;
    fbd_unbalanced *unbalanced;
    fbd_limit *limits;
    const char **undetermined;
};

/* Does the body have an equation of moments? What slides on the ground or is a particle does not turn, and
 * takes whatever couple that needs without saying. */
static inline bool rest_turns(const struct model_body *body)
{
    if (body->kind == motion_particle) return false;
    return body->place.link > 0 || body->kind == motion_pivot || body->kind == motion_planar;
}

/* The tension of a rod or a rope; NAN for another coupling, 0 for a slack rope. */
static inline double rest_tension(const struct fbd_statics *statics, int coupling)
{
    const struct coupling *of = &statics->model->tree->couplings[coupling];
    if (!of->law->length) return NAN;
    return -statics->state->tree->rows[of->first_row].lambda;
}

/* Say of a state of the file's own that it does not rest with the bodies. */
bool statics_refuse_states(const struct fbd_state *state, fbd_errors *errors);

/* The names of the reactions that equilibrium does not determine, into statics->undetermined. */
bool rest_name_undetermined(struct fbd_statics *statics, const struct rest_system *system);

/* Six digits in a file are meant to be in equilibrium: what is left, as a share of the largest load. */
static const double rest_digits = 2e-6;

/* The ways to move, what is left along them, and what would hold it, into statics->unbalanced. */
bool rest_find_unbalanced(struct fbd_statics *statics, const struct rest_system *system);

#endif
