/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "record/ledger.h"

#include <stdlib.h>

#include "dynamics/energy.h"
#include "dynamics/mass.h"
#include "model/tree.h"

static double kinetic(const struct fbd_model *model, const struct instant *at)
{
    double sum = 0;
    for (size_t b = 0; b < model->body_count; b++) sum += kinetic_energy(&model->bodies[b], at);
    return sum;
}

bool ledger_init(struct ledger *ledger, const struct fbd_model *model, struct fbd_state *start, bool works)
{
    size_t loads = model->load_count;
    *ledger = (struct ledger){.model = model, .works = works};
    ledger->integrated = calloc(loads + 1, sizeof *ledger->integrated);
    ledger->work = calloc(5 * loads + 1, sizeof *ledger->work);
    ledger->arrows = calloc(diagram_most_arrows(model), sizeof *ledger->arrows);
    ledger->scratch = calloc(plan_size(&model->plan) + 1, sizeof *ledger->scratch);
    if (!ledger->integrated || !ledger->work || !ledger->arrows || !ledger->scratch) {
        ledger_free(ledger);
        return false;
    }
    ledger->initial_potential = ledger->work + loads;
    ledger->begin = ledger->initial_potential + loads;
    ledger->end = ledger->begin + loads;
    ledger->struck = ledger->end + loads;
    struct instant at = state_instant(start);
    ledger->initial_kinetic = kinetic(model, &at);
    for (size_t i = 0; i < loads; i++) {
        const struct model_load *load = &model->loads[i];
        ledger->integrated[i] = load->potential_kind == potential_none;
        ledger->any |= works && ledger->integrated[i];
        if (!works && ledger->integrated[i]) ledger->work[i] = NAN;
        ledger->initial_potential[i] = potential_energy(model, load, &at, ledger->scratch);
        ledger->initial_sum += ledger->initial_potential[i];
    }
    return true;
}

void ledger_free(struct ledger *ledger)
{
    free(ledger->integrated);
    free(ledger->work);
    free(ledger->arrows);
    free(ledger->scratch);
    *ledger = (struct ledger){0};
}

static void add_power(struct ledger *ledger, int load, double weight, double power, double *work)
{
    work[load] += weight * power;
    ledger->turnover += weight * fabs(power);
}

/* On the ground what is integrated is listed by the body, and its joint does no work. */
static void add_powers_on_ground(struct ledger *ledger, const struct group *group,
                                 const struct model_body *body, const struct fbd_state *state, double weight,
                                 double *work)
{
    struct instant at = state_instant(state);
    const struct pose pose = body_pose(body, &at);
    for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
        int load = group_load(group, i);
        if (ledger->integrated[load])
            add_power(ledger, load, weight, load_power(group->model, i, &pose, &at, state->slots), work);
    }
}

/* Add weight * power of every integrated load of a group in a state of it. */
static void add_powers(struct ledger *ledger, const struct group *group, const struct fbd_state *state,
                       double weight, double *work)
{
    const struct fbd_model *model = group->model;
    struct instant at = state_instant(state);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        bool wanted = body->place.link > 0;
        for (int i = 0; i < body->load_count; i++)
            wanted |= ledger->integrated[group_load(group, body->first_load + i)];
        if (!wanted) continue;
        if (body->carried >= 0) {
            double power = body_carried_power(model, body, &at);
            add_power(ledger, group_load(group, body->carried), weight, power, work);
        }
        if (body->place.link == 0) {
            add_powers_on_ground(ledger, group, body, state, weight, work);
            continue;
        }
        size_t count = diagram_fill(model, (int)b, &at, state->a, state->slots, ledger->arrows);
        for (size_t i = 0; i < count; i++) {
            int load = group_load(group, ledger->arrows[i].load);
            /* What acts between two bodies: its power on both. */
            if (load < 0 || !ledger->integrated[load]) continue;
            add_power(ledger, load, weight, ledger->arrows[i].power, work);
        }
    }
}

bool ledger_integrates(const struct ledger *ledger, const struct group *group)
{
    for (size_t i = 0; i < group->model->load_count; i++)
        if (ledger->integrated[group_load(group, (int)i)]) return true;
    return false;
}

/* Add the integral of power over [from, to] of a group's last step. */
static bool integrate(struct ledger *ledger, struct ensemble *ensemble, size_t group, struct moment from,
                      struct moment to, double *work)
{
    /* Gauss-Legendre, five points on [-1, 1]: x = 0, sqrt(5 -+ 2 sqrt(10/7)) / 3 (Abramowitz & Stegun,
     * table 25.4). */
    static const double x[] = {-0.906179845938663992797626878299, -0.538469310105683091036314420700, 0,
                               0.538469310105683091036314420700, 0.906179845938663992797626878299};
    static const double w[] = {0.236926885056189087514264040720, 0.478628670499366468041291514836,
                               0.568888888888888888888888888889, 0.478628670499366468041291514836,
                               0.236926885056189087514264040720};
    const struct group *of = &ensemble->groups[group];
    double length = moment_since(to, from);
    if (!(length > 0) || !ledger_integrates(ledger, of)) return true;
    int panels = run_panels(of->run);
    double half = length / (2 * panels);
    for (int i = 0; i < 5 * panels; i++) {
        int panel = i / 5;
        struct moment t = moment_after(from, half * (2 * panel + 1 + x[i % 5]));
        const struct fbd_state *state = ensemble_look_group(ensemble, group, t);
        if (!state) return false;
        add_powers(ledger, of, state, half * w[i % 5], work);
    }
    return true;
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
    if (!integrate(ledger, ensemble, index, run_start(run), run_end(run), ledger->end)) return false;
    for (size_t i = 0; i < model->load_count; i++) {
        int load = group_load(group, (int)i);
        if (!ledger->integrated[load]) continue;
        ledger->end[load] += run->impact_work[i] - ledger->struck[load];
        ledger->struck[load] = run->impact_work[i];
    }
    return true;
}

void ledger_restart(struct ledger *ledger, struct ensemble *ensemble, size_t index)
{
    const struct group *group = &ensemble->groups[index];
    for (size_t i = 0; i < group->model->load_count; i++) {
        int load = group_load(group, (int)i);
        ledger->begin[load] = ledger->end[load] = ledger->struck[load] = 0;
    }
}

void ledger_note(struct ledger *ledger, const struct group *group)
{
    struct fbd_state *state = group->run->state;
    struct instant at = state_instant(state);
    double sum = group->model->tree ? jointed_kinetic_energy(state) : 0;
    for (size_t b = 0; b < group->model->body_count; b++) {
        const struct model_body *body = &group->model->bodies[b];
        if (body->place.link == 0) sum += kinetic_energy(body, &at);
    }
    ledger->liveliest = fmax(ledger->liveliest, sum);
}

/* How far couplings reach: by that much they know where a body is, wherever that may be. */
static double reach_of_couplings(const struct tree *tree)
{
    double reach = 0;
    for (int i = 0; tree && i < tree->tie_count; i++) {
        const struct tie *tie = &tree->ties[i];
        reach = fmax(reach, fabs(tie->length));
        for (int end = 0; end < tie->end_count; end++)
            reach = fmax(reach, vec_norm(tie->end[end].point) + tie->end[end].radius);
    }
    return reach;
}

/* What roundings do at a state, as energies. */
struct rounded {
    double
        places; /* every force times the distance of its point, and every couple: one rounding of all places */
    double ways; /* of unit time: every force times what it moves its body by alone */
};

static struct rounded rounded_at(struct ledger *ledger, struct fbd_state *state)
{
    const struct fbd_model *model = ledger->model;
    struct instant at = state_instant(state);
    struct rounded sum = {0, 0};
    double reach = reach_of_couplings(model->tree);
    for (size_t b = 0; b < model->body_count; b++) {
        size_t count = diagram_fill(model, (int)b, &at, state->a, state->slots, ledger->arrows);
        double forces = 0, mass = body_mass(&model->bodies[b], &at);
        for (size_t i = 0; i < count; i++) {
            const struct arrow *arrow = &ledger->arrows[i];
            double force = vec_norm(arrow->force);
            sum.places += force * fmax(vec_norm(arrow->point), reach) + fabs(arrow->couple);
            forces += force;
        }
        if (mass > 0) sum.ways += forces * forces / mass;
    }
    return sum;
}

double ledger_explained(struct ledger *ledger, struct fbd_state *state, double tolerance, double steps)
{
    /* Runs of few steps are allowed a hundred; below its rounding a tolerance says nothing. Over the gallery, by all
     * methods from 1e-4 to 1e-10, residuals are up to a tenth of this. */
    const double least_steps = 100, least_tolerance = 1e-13, tolerances = 10, roundings = 1e-11;
    struct instant at = state_instant(state);
    double size = fmax(ledger->liveliest, ledger->initial_kinetic) + ledger->turnover;
    if (!ledger->works) return NAN;
    struct rounded rounded = rounded_at(ledger, state);
    double terms = size + rounded.places;
    /* What rests at the origin has no size there: a rounding of what forces move in a step, for each step. */
    double nothing = DBL_EPSILON * rounded.ways * at.t * at.t / fmax(steps, 1);
    for (size_t i = 0; i < ledger->model->load_count; i++) {
        if (ledger->integrated[i]) continue;
        double potential = potential_energy(ledger->model, &ledger->model->loads[i], &at, ledger->scratch);
        terms += fabs(ledger->initial_potential[i]) + fabs(potential);
    }
    return tolerances * (steps + least_steps) * fmax(tolerance, least_tolerance) * size + roundings * terms +
           nothing;
}

bool ledger_within(struct ledger *ledger, struct ensemble *ensemble, double t, double *work)
{
    for (size_t g = 0; ledger->any && g < ensemble->count; g++) {
        const struct group *group = &ensemble->groups[g];
        bool at_end = t == group->run->state->t;
        for (size_t i = 0; i < group->model->load_count; i++) {
            int load = group_load(group, (int)i);
            work[load] = (at_end ? ledger->end : ledger->begin)[load];
        }
        if (!at_end && !integrate(ledger, ensemble, g, run_start(group->run), moment_at(t), work))
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
    if (ledger->integrated[index]) return work[index];
    struct instant at = state_instant(state);
    return ledger->initial_potential[index] - potential_energy(ledger->model, load, &at, ledger->scratch);
}

fbd_energy ledger_energy(struct ledger *ledger, const struct fbd_state *state, const double *work)
{
    const struct fbd_model *model = ledger->model;
    struct instant at = state_instant(state);
    fbd_energy energy = {.kinetic = kinetic(model, &at),
                         .initial_kinetic = ledger->initial_kinetic,
                         .initial_potential = ledger->initial_sum};
    /* Differences load by load: a datum far away does not drown the change in rounding. */
    double change = 0;
    for (size_t i = 0; i < model->load_count; i++) {
        if (ledger->integrated[i]) {
            energy.work += work[i];
            continue;
        }
        double potential = potential_energy(model, &model->loads[i], &at, ledger->scratch);
        energy.potential += potential;
        change += potential - ledger->initial_potential[i];
    }
    energy.residual = energy.kinetic - energy.initial_kinetic + change - energy.work;
    return energy;
}
