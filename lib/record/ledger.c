/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/ledger.h"

#include <math.h>
#include <stdlib.h>

#include "base/block_alloc.h"
#include "dynamics/energy.h"
#include "dynamics/load_rounding.h"
#include "numeric/tolerances.h"
#include "record/powers.h"

static double kinetic(const struct fbd_model *model, const struct instant *at)
{
    double sum = 0;
    for (size_t b = 0; b < model->body_count; b++) sum += kinetic_energy(&model->bodies[b], at);
    return sum;
}

/* Constraint forces perpendicular to the motion do no work, except those of couplings in an impact. */
static void count_works(struct ledger *ledger)
{
    const struct fbd_model *model = ledger->model;
    for (size_t i = 0; i < model->load_count; i++)
        ledger->integrated[i] = ledger->counted[i] = model->loads[i].potential_kind == potential_none;
    for (int i = 0; i < model->tree->coupling_count; i++) {
        int load = model->tree->couplings[i].load;
        if (load >= 0 && model->loads[load].potential_kind == potential_workless)
            ledger->counted[load] = true;
    }
}

bool ledger_has_works(const struct ledger *ledger, size_t load)
{
    return ledger->counted[load] || ledger->model->loads[load].source->lifetime.number > 0;
}

bool ledger_init(struct ledger *ledger, const struct fbd_model *model, struct fbd_state *start, bool works)
{
    size_t loads = model->load_count;
    *ledger = (struct ledger){.model = model, .works = works};
    const size_t most_arrows = diagram_most_arrows(model), size = plan_size(&model->plan);
    ledger->arrows = block_alloc(most_arrows * sizeof *ledger->arrows +
                                 ((7 + power_points) * loads + 2 + size) * sizeof *ledger->work + 2 * loads);
    if (!ledger->arrows) return false;
    ledger->work = (double *)(ledger->arrows + most_arrows);
    ledger->initial_potential = ledger->work + loads;
    ledger->begin = ledger->initial_potential + loads;
    ledger->end = ledger->begin + loads;
    ledger->struck = ledger->end + loads;
    ledger->lively = ledger->struck + loads;
    ledger->through = ledger->lively + loads + 1;
    ledger->powers = ledger->through + loads + 1;
    ledger->scratch = ledger->powers + power_points * loads;
    ledger->integrated = (void *)(ledger->scratch + size);
    ledger->counted = ledger->integrated + loads;
    struct instant at = state_instant(start);
    ledger->initial_kinetic = kinetic(model, &at);
    count_works(ledger);
    for (size_t i = 0; i < loads; i++) {
        const struct model_load *load = &model->loads[i];
        ledger->any |= works && ledger_has_works(ledger, i);
        if (!works && ledger_has_works(ledger, i)) ledger->work[i] = NAN;
        ledger->initial_potential[i] = potential_energy(model, load, &at, ledger->scratch);
        ledger->initial_sum += ledger->initial_potential[i];
    }
    return true;
}

void ledger_free(struct ledger *ledger)
{
    free(ledger->arrows);
    *ledger = (struct ledger){0};
}

bool ledger_counts(const struct ledger *ledger, const struct group *group)
{
    for (size_t i = 0; i < group->model->load_count; i++)
        if (ledger_has_works(ledger, (size_t)group_load(group, (int)i))) return true;
    return false;
}

/* Index at which the sums of a group are kept: its first load. A group without loads has no sums that matter. */
static size_t first_load(const struct ledger *ledger, const struct group *group)
{
    return group_load_count(ledger->model, group) > 0 ? (size_t)group_load(group, 0)
                                                      : ledger->model->load_count;
}

bool ledger_step(struct ledger *ledger, struct ensemble *ensemble, size_t index)
{
    const struct group *group = &ensemble->groups[index];
    const struct fbd_model *model = group->model;
    for (size_t i = 0; i < model->load_count; i++) {
        int load = group_load(group, (int)i);
        ledger->begin[load] = ledger->end[load];
    }
    const struct run *run = group->run;
    size_t first = first_load(ledger, group);
    struct sums sums = {ledger->end, ledger->lively[first], ledger->through[first], 0};
    if (!powers_integrate(ledger, ensemble, index, run_start(run), run_end(run), &sums)) return false;
    ledger->turnover += sums.turnover - ledger->through[first];
    ledger->through[first] = sums.turnover;
    for (size_t i = 0; i < model->load_count; i++) {
        int load = group_load(group, (int)i);
        if (!ledger_has_works(ledger, (size_t)load)) continue;
        ledger->end[load] += run->impact_work[i] - ledger->struck[load];
        ledger->struck[load] = run->impact_work[i];
    }
    return true;
}

void ledger_restart(struct ledger *ledger, struct ensemble *ensemble, size_t index)
{
    const struct group *group = &ensemble->groups[index];
    ledger->turnover -= ledger->through[first_load(ledger, group)];
    for (size_t i = 0; i < group->model->load_count; i++) {
        int load = group_load(group, (int)i);
        ledger->begin[load] = ledger->end[load] = ledger->struck[load] = ledger->through[load] =
            ledger->lively[load] = 0;
    }
}

void ledger_note(struct ledger *ledger, const struct group *group)
{
    struct fbd_state *state = group->run->state;
    double sum = group->run->stale ? total_kinetic_energy(state) : standing_kinetic_energy(state);
    ledger->liveliest = fmax(ledger->liveliest, sum);
    double *lively = &ledger->lively[first_load(ledger, group)];
    *lively = fmax(*lively, sum);
}

double ledger_explained(struct ledger *ledger, struct fbd_state *state, double tolerance, double steps)
{
    struct instant at = state_instant(state);
    double size = fmax(ledger->liveliest, ledger->initial_kinetic) + ledger->turnover;
    if (!ledger->works) return NAN;
    struct rounded rounded = rounded_at(state);
    double terms = size + rounded.places;
    /* A body at rest at the origin has coordinates of size 0: add a rounding of the displacement by its
     * forces, for each step. */
    double nothing = round_off(1, rounded.ways) * at.t * at.t / fmax(steps, 1);
    for (size_t i = 0; i < ledger->model->load_count; i++) {
        if (ledger->counted[i]) continue;
        double potential = potential_energy(ledger->model, &ledger->model->loads[i], &at, ledger->scratch);
        terms += fabs(ledger->initial_potential[i]) + fabs(potential);
    }
    return energy_explained(tolerance, steps, size, terms) + nothing;
}

bool ledger_within(struct ledger *ledger, struct ensemble *ensemble, double t, double *work)
{
    for (size_t g = 0; ledger->any && g < ensemble->count; g++) {
        const struct group *group = &ensemble->groups[g];
        bool at_end = t == group_end(group);
        for (size_t i = 0; i < group_load_count(ledger->model, group); i++) {
            int load = group_load(group, (int)i);
            work[load] = (at_end ? ledger->end : ledger->begin)[load];
        }
        size_t first = first_load(ledger, group);
        struct sums sums = {work, ledger->lively[first], ledger->through[first], 0};
        if (!at_end && !powers_integrate(ledger, ensemble, g, run_start(group->run), time_dd_at(t), &sums))
            return false;
    }
    return true;
}

bool ledger_at(struct ledger *ledger, struct ensemble *ensemble, double *work)
{
    return ledger_within(ledger, ensemble, ensemble->t, work);
}

double ledger_work(struct ledger *ledger, const struct fbd_state *state, size_t index, const double *work)
{
    const struct model_load *load = &ledger->model->loads[index];
    if (ledger->counted[index]) return work[index];
    struct instant at = state_instant(state);
    const double V = potential_energy(ledger->model, load, &at, ledger->scratch);
    return ledger->initial_potential[index] - V + (ledger_has_works(ledger, index) ? work[index] : 0);
}

fbd_energy ledger_energy(struct ledger *ledger, const struct fbd_state *state, const double *work)
{
    const struct fbd_model *model = ledger->model;
    struct instant at = state_instant(state);
    fbd_energy energy = {.kinetic = kinetic(model, &at),
                         .initial_kinetic = ledger->initial_kinetic,
                         .initial_potential = ledger->initial_sum};
    /* Differences load by load: a distant datum does not lose the change in rounding. */
    double change = 0;
    for (size_t i = 0; i < model->load_count; i++) {
        if (ledger_has_works(ledger, i)) energy.work += work[i];
        if (ledger->counted[i]) continue;
        double potential = potential_energy(model, &model->loads[i], &at, ledger->scratch);
        energy.potential += potential;
        change += potential - ledger->initial_potential[i];
    }
    energy.residual = energy.kinetic - energy.initial_kinetic + change - energy.work;
    return energy;
}
