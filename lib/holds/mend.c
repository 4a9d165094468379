/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/mend.h"

#include "holds/trial.h"

/* The mode of constraint i required by its law, or its present mode if that is consistent. */
static int lawful_mode(const struct hold_problem *problem, size_t i)
{
    const struct hold *hold = &problem->holds[i];
    if (hold->slip != 0) return hold->slip;
    enum hold_breach breach = holds_breach(problem, i);
    if (breach == hold_breaks_nothing) return hold->mode;
    if (breach == hold_moves_back) return hold_keeps;
    if (hold->kind == hold_one_sided) return hold_gives;
    return hold->force > 0 ? hold_slips_back : hold_gives;
}

/* Change the first inconsistent mode; false where all are consistent. */
static bool change_first(struct hold_problem *problem)
{
    for (size_t i = 0; i < problem->count; i++) {
        int mode = lawful_mode(problem, i);
        if (mode == problem->holds[i].mode) continue;
        problem->holds[i].mode = mode;
        return true;
    }
    return false;
}

enum holds_found holds_mend(struct hold_problem *problem)
{
    enum { rounds = 8 }; /* times the number of constraints */
    struct trial trial;
    enum holds_found found = trial_new(&trial, problem) ? holds_lost : holds_no_memory;
    for (size_t round = 0; found == holds_lost && round < rounds * problem->count; round++) {
        for (size_t g = 0; g < problem->guide_count; g++) trial.side[g] = problem->guides[g].N < 0 ? -1 : 1;
        if (!trial_find_forces(&trial)) break;
        if (change_first(problem)) continue;
        if (holds_agree(problem)) found = holds_meet(problem);
        break;
    }
    trial_free(&trial);
    return found;
}
