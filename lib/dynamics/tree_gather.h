/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The unilateral constraints between jointed bodies that are to be decided, as one problem: all of them
 * loose, and their accelerations by a unit force along each.
 */
#ifndef FBD_DYNAMICS_TREE_GATHER_H
#define FBD_DYNAMICS_TREE_GATHER_H

#include "dynamics/friction.h"
#include "dynamics/state.h"
#include "holds/holds.h"

enum { keeps_still = 2 }; /* beside the modes that rates decide: immovable, whatever the forces */

/* The couplings alone make a unilateral constraint immovable: for all forces, or until forces move the
 * mechanism out of a dead centre, to second order. */
enum { still_stays = 1, still_sets_out };

/* Responses with switches in sliding modes: accelerations of the unilateral constraints and normal forces of
 * the guides by the weight of each unit (units by holds), and rates of the surfaces, later changes of the
 * weights, by a unit force of each constraint (holds by units). */
struct shared_out {
    int units; /* 0 if no weights are computed */
    double *c, *N, *rates;
};

struct gathered {
    struct fbd_state *state;
    struct instant at; /* with all of them loose */
    struct hold_problem problem;
    int *pair, *hold; /* the mode of a hold; the hold of a mode, or -1 */
    int *guide;       /* of a guide: the mode whose normal force it has */
    struct vec
        *reactions; /* or NULL: of guides that are journals, count + 1 each, their reaction without forces
                            * of the constraints and those by a unit of each */
    int *trial;     /* modes with all of them loose */
    int *still;     /* of a hold: still_..., 0 if it is movable */
    int *forced;
    struct shared_out shares;
};

static inline int link_of(const struct fbd_state *state, int pair)
{
    return state->model->bodies[mode_of(state, pair)->body].place.link;
}

/* Is the constraint to be decided? `forced`: modes that rates have decided, else 0. */
bool hold_in_question(const struct fbd_state *state, const struct decided *decided, const int *forced,
                      int pair);

/* The side on which a friction already slips, 0 at rest. */
int hold_slips_already(const struct fbd_state *state, const struct decided *decided, const int *forced,
                       int pair);

/* Set the loaded side of a two-sided guide by its normal force. */
void hold_set_pull(struct fbd_state *state, int pair, double N);

/* Set up the problem of all constraints to be decided; false when memory is out. To be freed in either case.
 * `shares_answer`: sliding modes persist whatever the constraints do, with weights without limits. */
bool gathered_find(struct gathered *all, struct fbd_state *state, const struct decided *decided, int *forced,
                   bool shares_answer);
void gathered_free(struct gathered *all);

/* With the weights of sliding modes as unknowns; with no more digits than the equations of motion resolve. */
enum gathering { as_it_is, with_shares, coarsely };

/* Set up that problem, and set the modes by pivoting. `barely`: for each constraint an alternative mode that
 * is as consistent, 0 for none, or keeps_still. */
enum holds_found gathered_solve(struct fbd_state *state, const struct decided *decided, int *forced,
                                int *barely, enum gathering how);

/* Direct the normal forces of journals along their reactions by the present forces of the constraints. True when
 * that changes the problem. */
bool gathered_turn_journals(struct gathered *all);

/* Set constraints that leave a dead centre, of those in `gives` (modes, else 0), to slip in the direction of
 * the motion to second order, whatever the force that held them. */
void gathered_set_out(struct fbd_state *state, const int *gives);

/* ---- friction that is zero in all of its modes: it slips to the side of its motion, at rest as before, in
 * `forced`, and is not decided */

/* Friction whose coefficients are zero and remain so. */
void tree_find_frictionless(struct fbd_state *state, const struct decided *decided, int *forced);

/* Friction on a guide whose normal force is zero in all modes, and remains so. */
void tree_find_unpressed(struct gathered *all, const struct decided *decided, int *forced);

#endif
