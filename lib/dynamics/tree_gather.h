/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The holds between jointed bodies that are in question, as one problem: each of them let loose, and what all of them
 * do when it pushes with one unit.
 */
#ifndef FBD_DYNAMICS_TREE_GATHER_H
#define FBD_DYNAMICS_TREE_GATHER_H

#include "dynamics/friction.h"
#include "dynamics/state.h"
#include "holds/holds.h"

enum {
    keeps_still = 2
}; /* beside the modes that rates decide: nothing moves along it, whatever the forces */

/* The constraints alone let nothing move along a hold: no force does, or forces that take the mechanism out of a dead
 * centre, to the second order, if nothing else holds it. */
enum { still_stays = 1, still_sets_out };

/* Switches that are slid on: what more of the share of each unit does along the holds (units by holds) and to the guides, and
 * what one unit of each hold does to the surfaces, then to the shares (holds by units). */
struct shared_out {
    int units; /* 0 where no shares are found */
    double *c, *N, *rates;
};

struct gathered {
    struct fbd_state *state;
    struct instant at; /* with all of them loose */
    struct hold_problem problem;
    int *pair, *hold; /* of a hold; of a pair, or -1 */
    int *guide;       /* of a guide: the pair that it presses on */
    int *trial;       /* modes with all of them loose */
    int *still;       /* of a hold: still_..., 0 where something moves along it */
    int *forced;
    struct shared_out shares;
};

static inline int link_of(const struct fbd_state *state, int pair)
{
    return state->model->bodies[mode_of(state, pair)->body].place.link;
}

/* `forced`: modes that rates have decided, 0 where they have not. */
bool hold_in_question(const struct fbd_state *state, const struct decided *decided, const int *forced,
                      int pair);

/* The side on which a friction slips whatever the forces are, 0 for one at rest. */
int hold_slips_already(const struct fbd_state *state, const struct decided *decided, const int *forced,
                       int pair);

/* The side on which a guide with two sides presses, by its normal force. */
void hold_set_pull(struct fbd_state *state, int pair, double N);

/* The problem of all that are in question; false when memory is out. To be freed in either case. `shares_answer`: what is slid
 * on stays so whatever the holds do, by shares without a limit. */
bool gathered_find(struct gathered *all, struct fbd_state *state, const struct decided *decided, int *forced,
                   bool shares_answer);
void gathered_free(struct gathered *all);

/* Find that problem, and set the modes by pivoting. `barely`: for each pair what it might as well do, a mode, 0 for nothing
 * or keeps_still. */
enum holds_found gathered_solve(struct fbd_state *state, const struct decided *decided, int *forced,
                                int *barely, bool shares_answer);

/* What sets out of a dead centre, of what `gives` (modes, 0 where it does not), slips to where it goes to the second
 * order, whatever the force is that held it. */
void gathered_set_out(struct fbd_state *state, const int *gives);

/* ---- friction that has no force in any of its modes: it slips to the side that it moves to, at rest as before, in `forced`,
 * and is out of question */

/* Where its coefficients are zero for now, and go on so. */
void tree_find_frictionless(struct fbd_state *state, const struct decided *decided, int *forced);

/* Where nothing presses on its guide, whatever holds, and goes on so. */
void tree_find_unpressed(struct gathered *all, const struct decided *decided, int *forced);

#endif
