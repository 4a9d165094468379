/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The method of a run: by its structure, and in its present modes; and the steps of exact methods.
 */
#include <math.h>
#include <string.h>

#include "loop/run.h"

bool run_chooses_structure(const struct run *run)
{
    return run->options.automatic && run->options.structure && run->options.step == 0;
}

bool run_make_stepper(struct run *run)
{
    size_t n = (size_t)run->model->plan.n;
    bool *angle = ARENA_ARRAY(run->memory, n, bool);
    if (!angle) return false;
    for (size_t i = 0; i < n; i++) angle[i] = run->model->scene->coordinates[i].angle;
    if (run_chooses_structure(run)) {
        if (run->kind != structure_fixed) run->kind = structure_of(run->model);
        run->options.method = structure_method(run->model, run->kind);
    }
    struct stepper_options options = {.method = run->options.method,
                                      .layout = {.pairs = n,
                                                 .extra = (size_t)run->model->plan.own,
                                                 .angle = angle},
                                      .tolerance = run->options.tolerance,
                                      .h_fixed = run->options.step};
    bool automatic = run->options.automatic && plan_size(&run->model->plan) <= method_most_stiff_states;
    automatic = automatic && !structure_is_exact(run->kind);
    run->stepper = switcher_alloc(&options, automatic ? method_find("rodas5p") : NULL);
    const struct method *parabola = structure_method(run->model, structure_constant);
    return run->stepper &&
           (run->kind != structure_flights || switcher_add_exact(run->stepper, &options, parabola));
}

static bool has_closed_contact(const struct run *run)
{
    const struct tree *tree = run->model->tree;
    for (int i = 0; i < tree->coupling_count; i++)
        if (run->during->slip[tree->couplings[i].surface] == stick) return true;
    return false;
}

void run_choose_method(struct run *run)
{
    if (run->kind != structure_flights) return;
    run->flies = !has_closed_contact(run);
    switcher_use_exact(run->stepper, run->flies);
}

int run_start_stepper(struct run *run)
{
    const struct time_dd until = time_dd_at(run->options.until);
    if (run->flies || run->kind == structure_constant) {
        double probe = 0;
        state_flow(run->state, run->work.f);
        for (size_t i = 0; i < plan_size(&run->model->plan); i++) probe += 0 * run->work.f[i];
        if (probe == 0)
            return switcher_restart(run->stepper, run_end(run), run->work.y, run->work.f, until,
                                    &run->step.h);
    }
    return switcher_reset(run->stepper, &run->system, run_end(run), run->work.y, run->work.f, until,
                          &run->step.h);
}

/* The matrices of a linear system depend on the modes only: branches, slips and pulls, one behind the other;
 * except in a Filippov sliding mode. */
bool run_start_linear(struct run *run)
{
    const bool kept = !state_sliding(run->during) && !run->model->tree->ends;
    const int *modes = kept ? run->during->branch : NULL;
    if (!linear_pace_start(&run->pace, &run->system, run->state->t, run->work.y, modes)) {
        run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
        return false;
    }
    const struct linear_modes *now = run->pace.now;
    if (now && isfinite(now->rho)) switcher_set_linear(run->stepper, now->A, now->rho);
    return true;
}

/* An exact method has no error estimate for its step size; its steps only have to resolve events. */
static void set_linear_step(struct run *run)
{
    double resolved = run->search.moving.resolved;
    const double other = 0.8;
    double longest = run->leaps ? linear_pace_leap(&run->pace) : linear_pace_step(&run->pace, run->step.from);
    if (run->options.apart) longest *= other;
    run->step.h = fmin(longest, run->options.until - run->step.from);
    if (resolved > 0) run->step.h = fmin(run->step.h, resolved);
}

void run_limit_method(struct run *run)
{
    if (run->kind == structure_linear) set_linear_step(run);
    if (run_is_one_step(run)) run->step.h = run->options.until - run->step.from;
    if (run->flies && run->step.flight > 0) run->step.h = fmin(run->step.h, run->step.flight);
}

/* An exact step may be of any length. But the farther contacts are searched, the more shapes may meet there, and mostly in
 * vain, so steps without a closed contact grow; not by a power of two, as bisections of a step would then end at the next
 * of equal bounces. */
void run_limit_flight(struct run *run)
{
    const double growth = 3, least = 1.0 / 64;
    double length = run->state->t - run->step.from;
    run->step.flight = fmax(growth * length, least * run->step.longest);
}
