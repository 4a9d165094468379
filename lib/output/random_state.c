/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/random_state.h"

#include <string.h>

#include "base/diag.h"
#include "base/text.h"
#include "dynamics/contact.h"
#include "dynamics/project.h"
#include "output/hand_forces.h"

static double between(gsl_rng *rng, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

bool random_model(const struct document *document, const fbd_model *model, gsl_rng *rng, double spread,
                  fbd_model **drawn)
{
    const struct scene *scene = model->scene;
    struct arena arena = {0};
    struct override *overrides = ARENA_ARRAY(&arena, scene->parameter_count + 1, struct override);
    fbd_errors *errors = fbd_errors_new();
    struct text text = {0};
    *drawn = NULL;
    for (size_t i = 0; overrides && i < scene->parameter_count; i++) {
        text.length = 0;
        text_number(&text, scene->parameters[i].value * between(rng, 1 - spread, 1 + spread), 17);
        if (text.failed) break;
        overrides[i] = (struct override){.name = scene->parameters[i].name,
                                         .value = arena_text(&arena, text.data, text.length)};
    }
    bool done = errors && !arena.failed && !text.failed;
    if (done) {
        *drawn = hands_compile(document, overrides, scene->parameter_count, errors);
        done = !errors->out_of_memory;
    }
    fbd_errors_free(errors);
    text_free(&text);
    arena_free(&arena);
    return done;
}

enum { path_steps = 64 };

size_t random_path_room(const struct fbd_model *model)
{
    return (path_steps + 3) * model->scene->coordinate_count + 1;
}

static double duration_of(const struct scene *scene)
{
    const struct value *until = &scene->simulate.until;
    return until->expr ? expr_value(until->expr) : 1;
}

/* Advance to time t: set prescribed coordinates there, and assemble the others. */
static bool follow_to(struct fbd_state *state, double t)
{
    state->t = t;
    modes_drive(state);
    return state_project(state, false);
}

/* Advance along the path to the state's time, from node to node; the last node is kept for later states. */
static bool follow_prescribed(struct fbd_state *state, struct random_path *path)
{
    const size_t n = state->model->scene->coordinate_count;
    const double t = state->t, step = duration_of(state->model->scene) / path_steps;
    const int node = step > 0 ? (int)fmin(path_steps, t / step) : 0;
    for (int k = path->known + 1; k <= node && !path->ends; k++) {
        memcpy(state->y, path->y + (size_t)(k - 1) * n, n * sizeof *state->y);
        path->ends = !follow_to(state, k * step);
        if (path->ends) break;
        memcpy(path->y + (size_t)k * n, state->y, n * sizeof *state->y);
        path->known = k;
    }
    state->t = t;
    if (path->known < node) return false;
    memcpy(state->y, path->y + (size_t)node * n, n * sizeof *state->y);
    return follow_to(state, t);
}

/* Rolling bodies touch their surface, and slip as often as they roll. All other modes stay as at the start. */
static void draw_modes(gsl_rng *rng, struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    for (size_t k = 0; k < plan->mode_count; k++) {
        if (plan->modes[k].kind == mode_tangent || plan->modes[k].kind == mode_plane)
            state->slip[k] = between(rng, 0, 1) < 0.5 ? stick : slip_plus;
        if (plan->modes[k].kind == mode_surface) state->slip[k] = stick;
    }
}

/* Move along the free directions of the couplings, in steps so small that the assembled state stays on the
 * same branch of all loops, and so fast that prescribed motions contribute little. `way`: displacement of
 * each coordinate without couplings. */
static bool wander(struct fbd_state *state, const double *way)
{
    enum { steps = 4 };
    const size_t n = state->model->scene->coordinate_count;
    const double time = 1e-6 * duration_of(state->model->scene);
    for (int k = 0; k < steps; k++) {
        for (size_t i = 0; i < n; i++) state->y[n + i] = way[i] / time;
        modes_drive(state);
        if (!state_project(state, false)) return false;
        for (size_t i = 0; i < n; i++) state->y[i] += state->y[n + i] * time / steps;
    }
    return true;
}

/* With closed loops most random states are inconsistent: so the start is displaced by up to 0.3 rad or a
 * tenth of a metre, with random rates. False when no consistent state is found there, or bodies would
 * overlap. */
static bool draw_closed(gsl_rng *rng, struct fbd_state *state, struct random_path *path)
{
    const struct fbd_model *model = state->model;
    size_t n = model->scene->coordinate_count;
    double *way = path->y + (path_steps + 1) * n, *rates = way + n, depth;
    if (model->tree->coupling_count == 0) return true;
    memcpy(rates, state->y + n, n * sizeof *rates);
    memcpy(path->y, path->start->y, n * sizeof *path->y);
    memcpy(state->y, path->y, n * sizeof *path->y);
    if (model_is_driven(model) && !follow_prescribed(state, path)) return false;
    for (size_t i = 0; i < n; i++)
        way[i] = between(rng, -1, 1) * (model->scene->coordinates[i].angle ? 0.3 : 0.1);
    draw_modes(rng, state);
    if (!wander(state, way)) return false;
    memcpy(state->y + n, rates, n * sizeof *rates);
    modes_drive(state);
    return state_project(state, false) && contacts_overlap(state, &depth) < 0;
}

bool random_state(gsl_rng *rng, struct fbd_state *state, struct random_path *path)
{
    const struct scene *scene = state->model->scene;
    size_t n = scene->coordinate_count;
    state_copy(state, path->start);
    state_let_forces_act(state);
    state->t = between(rng, 0, duration_of(scene));
    for (size_t i = 0; i < n; i++) {
        const struct coordinate *c = &scene->coordinates[i];
        double reach = c->angle ? 3.14159 : fmax(1, 2 * fabs(c->initial)),
               speed = fmax(1, 2 * fabs(c->initial_rate));
        const struct curve *curve = scene->bodies[c->body].motion.curve;
        state->y[i] = curve ? curve->start + between(rng, 0, 1) * curve->length : between(rng, -reach, reach);
        state->y[n + i] = between(rng, -speed, speed);
    }
    for (size_t i = 0; i < scene->own_count; i++) {
        double reach = fmax(1, 2 * fabs(scene->own[i].initial));
        state->y[2 * n + i] = between(rng, -reach, reach);
    }
    return draw_closed(rng, state, path);
}

bool random_admissible(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    state->settled = true;
    if (!modes_settle(state, NULL)) return false;
    for (int i = 0; i < plan->n; i++)
        if (!isfinite(state->a[i])) return false;
    for (size_t i = 0; i < plan->contact_count; i++) {
        const struct contact *contact = &plan->contacts[i];
        if (-state->slots[contact->slot] < 0) return false;
        if (contact->pair < 0 || state->slip[contact->pair] == stick) continue;
        bool was_closed = state->slip_rests[contact->pair];
        if (was_closed || plan->modes[contact->pair].kind != mode_contact) return false;
    }
    return true;
}
