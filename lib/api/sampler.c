/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: states at which scenes are compared.
 */
#include <stdlib.h>

#include "dynamics/project.h"
#include "fbd_view.h"
#include "output/equations.h"
#include "output/random_state.h"

struct fbd_sampler {
    const struct fbd_model *model;
    fbd_state *start;
    gsl_rng *rng;
    struct random_path path;
};

bool fbd_state_settle(fbd_state *state)
{
    if (!state) return false;
    if (random_admissible(state)) return true;
    state_evaluate(state);
    return false;
}

size_t fbd_state_accelerations(fbd_state *state, double *accelerations, size_t room)
{
    if (!state) return 0;
    const size_t n = (size_t)state->model->plan.n;
    state_ready(state);
    for (size_t i = 0; accelerations && i < n && i < room; i++) accelerations[i] = state->a[i];
    return n;
}

fbd_state *fbd_state_new_start(const fbd_model *model)
{
    fbd_state *state = model ? state_new(model) : NULL;
    if (state && model->assembles) state_project(state, true);
    if (state) fbd_state_settle(state);
    return state;
}

void fbd_state_let_forces_act(fbd_state *state)
{
    if (state) state_let_forces_act(state);
}

fbd_sampler *fbd_sampler_new(const fbd_model *model)
{
    fbd_sampler *sampler = model ? calloc(1, sizeof *sampler) : NULL;
    if (!sampler) return NULL;
    sampler->model = model;
    sampler->rng = gsl_rng_alloc(gsl_rng_mt19937);
    sampler->start = state_new(model);
    sampler->path.start = sampler->start;
    sampler->path.y = calloc(random_path_room(model), sizeof *sampler->path.y);
    if (sampler->rng && sampler->start && sampler->path.y) return sampler;
    fbd_sampler_free(sampler);
    return NULL;
}

void fbd_sampler_free(fbd_sampler *sampler)
{
    if (!sampler) return;
    if (sampler->rng) gsl_rng_free(sampler->rng);
    state_free(sampler->start);
    free(sampler->path.y);
    free(sampler);
}

bool fbd_sampler_start(fbd_sampler *sampler, fbd_state *state, bool any_time)
{
    if (!sampler || !state || state->model != sampler->model) return false;
    const struct value *until = &sampler->model->scene->simulate.until;
    if (any_time && model_is_driven(sampler->model)) return false;
    state_copy(state, sampler->start);
    state_let_forces_act(state);
    if (any_time) state->t = gsl_rng_uniform(sampler->rng) * (until->expr ? expr_value(until->expr) : 1);
    return fbd_state_settle(state);
}

bool fbd_sampler_draw(fbd_sampler *sampler, fbd_state *state, unsigned tries)
{
    if (!sampler || !state || state->model != sampler->model) return false;
    for (unsigned k = 0; k < tries; k++)
        if (random_state(sampler->rng, state, &sampler->path) && random_admissible(state)) return true;
    if (tries > 0) state_evaluate(state);
    return false;
}
