/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>

#include "dynamics/modes.h"
#include "dynamics/tree_gather.h"
#include "numeric/tolerances.h"

/* In Painleve's paradox a friction increases its own normal force: find the one with the largest such
 * response. */
static struct holds_trouble trouble_of(const struct gathered *all, enum holds_found found)
{
    struct holds_trouble trouble = {.found = found, .pair = -1, .contradicts = -1};
    const struct hold_problem *problem = &all->problem;
    for (size_t i = 0; i < problem->count; i++) {
        const struct hold *hold = &problem->holds[i];
        if (hold->kind != hold_friction || hold->press == press_constant) continue;
        double answer = 0, own = problem->A[(size_t)hold->presses * problem->count + (size_t)hold->presses];
        if (hold->press == press_guide) answer = problem->B[(size_t)hold->presses * problem->count + i];
        if (hold->press == press_hold && own > 0)
            answer = -problem->A[(size_t)hold->presses * problem->count + i] / own;
        if (fabs(answer) * hold->mu_k <= fabs(trouble.answer)) continue;
        trouble.answer = fabs(answer) * hold->mu_k;
        trouble.pair = all->pair[i];
    }
    for (size_t i = 0; i < problem->count && trouble.pair < 0; i++)
        if (found == holds_several && problem->holds[i].kind == hold_friction) trouble.pair = all->pair[i];
    return trouble;
}

void hold_set_pull(struct fbd_state *state, int pair, double N)
{
    if (mode_of(state, pair)->two_sided) state->pull[pair] = N < 0 ? -1 : 1;
}

/* The limit of a sticking friction. */
static double limit_of(const struct hold_problem *problem, const struct hold *hold)
{
    if (hold->press == press_constant) return hold->mu_s;
    if (hold->press == press_hold) return hold->mu_s * (hold->preload + problem->holds[hold->presses].force);
    const struct hold_guide *guide = &problem->guides[hold->presses];
    return hold->mu_s * (hold->preload + (guide->two_sided ? fabs(guide->N) : fmax(guide->N, 0)));
}

/* The alternative mode of a constraint at its limit, or 0. If a corner touches two surfaces, the friction on
 * one of them and the normal force of the other are redundant, and the solution has one at its limit at rest:
 * it may slip with zero velocity. Of two contacts at nearly the same place one may have no force, and may
 * open. Friction that slips only by rounding may as well stick: keeps_still. */
static int barely_holds(const struct gathered *all, size_t i)
{
    const struct hold *hold = &all->problem.holds[i];
    bool slips = hold->kind == hold_friction && hold->slip == 0 && hold->mode != hold_keeps;
    if (slips && !holds_is_on_open(&all->problem, hold) && holds_is_still(&all->problem, i, undecided_part))
        return keeps_still;
    if (hold->slip != 0 || hold->mode != hold_keeps) return 0;
    if (hold->kind == hold_one_sided) {
        double most = 0;
        for (size_t j = 0; j < all->problem.count; j++) most = fmax(most, fabs(all->problem.holds[j].force));
        return hold->force <= undecided_part * most ? hold_gives : 0;
    }
    double limit = limit_of(&all->problem, hold);
    if (!(limit > 0) || fabs(hold->force) < (1 - undecided_part) * limit) return 0;
    return hold->force > 0 ? -1 : 1;
}

/* Decide, with the directions of the resulting reactions in journals. look() verifies the modes. */
static enum holds_found decide_directed(struct gathered *all)
{
    enum { most_passes = 30 };
    enum holds_found found = holds_decide(&all->problem);
    for (int pass = 0; all->reactions && pass < most_passes && found <= holds_several; pass++) {
        if (!gathered_turn_journals(all)) break;
        found = holds_decide(&all->problem);
    }
    return found;
}

enum holds_found gathered_solve(struct fbd_state *state, const struct decided *decided, int *forced,
                                int *barely, enum gathering how)
{
    struct gathered all;
    enum holds_found found = holds_no_memory;
    if (gathered_find(&all, state, decided, forced, how == with_shares)) {
        tree_find_unpressed(&all, decided, forced);
        all.problem.basic = true; /* for barely_holds */
        all.problem.coarse = how == coarsely;
        found = decide_directed(&all);
        if (found != holds_decided) state->holds = trouble_of(&all, found);
    }
    for (size_t i = 0; found <= holds_several && i < all.problem.count; i++) {
        const struct hold *hold = &all.problem.holds[i];
        state->slip[all.pair[i]] = hold->mode;
        barely[all.pair[i]] = barely_holds(&all, i);
        if (hold->press == press_guide && !(decided && decided->pulls[all.pair[i]]))
            hold_set_pull(state, all.pair[i], all.problem.guides[hold->presses].N);
    }
    if (found == holds_no_memory) state->holds.found = found;
    gathered_free(&all);
    return found;
}
