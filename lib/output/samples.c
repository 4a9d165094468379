/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/samples.h"

#include <gsl/gsl_rng.h>
#include <math.h>
#include <string.h>

#include "dynamics/kinematics.h"
#include "dynamics/modes.h"
#include "dynamics/plane_friction.h"
#include "dynamics/project.h"
#include "model/tree.h"

static const double same = 1e-9; /* relative: projected states have errors above round-off level */

/* ---- the states */

double sample_between(gsl_rng *rng, double low, double high)
{
    return low + (high - low) * gsl_rng_uniform(rng);
}

void sample_move(struct fbd_state *state, gsl_rng *rng, double reach)
{
    const struct scene *scene = state->model->scene;
    const struct value *until = &scene->simulate.until;
    const size_t n = scene->coordinate_count;
    state->t += sample_between(rng, 0, 0.1) * reach * (until->expr ? expr_value(until->expr) : 1);
    for (size_t i = 0; i < n; i++) {
        const struct coordinate *c = &scene->coordinates[i];
        const struct curve *curve = scene->bodies[c->body].motion.curve;
        state->y[i] += reach * sample_between(rng, -1, 1) * (c->angle ? 0.3 : 0.1);
        if (curve) state->y[i] = fmin(fmax(state->y[i], curve->start), curve->start + curve->length);
        state->y[n + i] += sample_between(rng, -1, 1);
    }
    for (size_t i = 0; i < scene->own_count; i++) state->y[2 * n + i] += sample_between(rng, -1, 1);
}

/* Set sticking friction to slipping and slack ropes to taut, as their forces may be zero in the present
 * modes. */
static void take_other_modes(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    for (size_t k = 0; k < plan->mode_count; k++) {
        if (mode_is_friction(&plan->modes[k]) && state->slip[k] == stick) state->slip[k] = slip_plus;
        if (plan->modes[k].kind == mode_rope) state->slip[k] = stick;
    }
}

bool sample_evaluate(struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    modes_drive(state);
    if (model->tree->coupling_count > 0 && !state_project(state, false)) return false;
    state->settled = true;
    if (model->tree->plane_count > 0) planes_aim(state);
    state_evaluate(state);
    for (int i = 0; i < model->plan.n; i++)
        if (!isfinite(state->a[i])) return false;
    return true;
}

static bool draw(struct fbd_state *state, const struct fbd_state *from, gsl_rng *rng, double reach,
                 bool other)
{
    state_copy(state, from);
    sample_move(state, rng, reach);
    if (other) take_other_modes(state);
    return sample_evaluate(state);
}

/* Draw all states; if couplings have no consistent state so far away, try nearer ones. */
static bool draw_all(struct samples *samples, struct fbd_state *state, gsl_rng *rng)
{
    enum { tries = 16, tries_of_a_reach = 4 };
    for (int i = 0; i < tries && samples->count < most_samples_of_formulas; i++) {
        struct fbd_state *drawn = state_new(state->model);
        if (!drawn) return false;
        if (draw(drawn, state, rng, ldexp(1, -(i / tries_of_a_reach)), i % 2 == 1))
            samples->states[samples->count++] = drawn;
        else
            state_free(drawn);
    }
    return true;
}

bool samples_begin(struct samples *samples, struct fbd_state *state, struct arena *arena)
{
    *samples = (struct samples){.count = 1, .states = {state}};
    samples->arrows = ARENA_ARRAY(arena, diagram_most_arrows(state->model), struct arrow);
    samples->arena = arena;
    samples->kept = ARENA_ARRAY(arena, state->model->body_count, struct acts_kept *);
    samples->rng = gsl_rng_alloc(gsl_rng_mt19937);
    samples->apart = state_new(state->model);
    return samples->arrows && samples->kept && samples->rng && samples->apart &&
           hand_forces_make(state->model, arena, &samples->forces) && draw_all(samples, state, samples->rng);
}

void samples_end(struct samples *samples)
{
    for (int i = 1; i < samples->count; i++) state_free(samples->states[i]);
    state_free(samples->apart);
    if (samples->rng) gsl_rng_free(samples->rng);
}

/* ---- an arrow */

static double size_of(const struct samples *samples, const struct instant *at, int body, size_t arrow)
{
    for (size_t i = 0; i < samples->forces.count; i++) {
        const struct hand_force *force = &samples->forces.list[i];
        if (force->name.body == body && force->arrow == arrow && force->part == hand_force_size)
            return hand_force_value(samples->states[0]->model, force, at, samples->arrows);
    }
    return NAN;
}

/* Round-off level of the forces on the body. */
static double least_force(const struct arrow *arrows, size_t count)
{
    double most = 0;
    for (size_t i = 0; i < count; i++) most = fmax(most, vec_norm(arrows[i].force));
    return 1e-10 * most;
}

/* Vector from `about` to a point; zero if they differ by rounding. */
static struct vec arm_to(struct vec point, struct vec about)
{
    const struct vec arm = vec_sub(point, about);
    const bool rounding = vec_norm(arm) <= 1e-12 * (vec_norm(point) + vec_norm(about));
    return rounding ? (struct vec){0, 0} : arm;
}

void acts_add(struct acts *acts, const struct samples *samples, const struct instant *at,
              const struct acting *acting, size_t i)
{
    const struct model_body *body = &samples->apart->model->bodies[acting->body];
    const struct pose pose = body_pose(body, at);
    const struct vec about = acting->about_axis ? pose.origin : point_motion(body, &pose, body->inertia.G).p;
    const struct arrow *arrow = &samples->arrows[i];
    acts->list[acts->count++] = (struct act){.force = arrow->force,
                                             .arm = arm_to(arrow->point, about),
                                             .turn = pose.rotation,
                                             .couple = arrow->couple,
                                             .size = size_of(samples, at, acting->body, i)};
}

size_t acting_arrow(const struct acting *acting, const struct arrow *arrows, size_t count)
{
    size_t i = 0;
    while (i < count && strcmp(arrows[i].name, acting->name) != 0) i++;
    return i;
}

struct acts acts_of(const struct samples *samples, int body, const char *name, bool about_axis)
{
    const struct acting acting = {body, name, about_axis};
    struct acts acts = {0};
    for (int k = 0; k < samples->count; k++) {
        const struct fbd_state *state = samples->states[k];
        const struct instant at = state_instant(state);
        const struct arrow *arrows = samples->arrows;
        const size_t count = diagram_list(state->model, body, &at, state->slots, samples->arrows),
                     i = acting_arrow(&acting, arrows, count);
        if (i == count) continue;
        const bool zero = vec_norm(arrows[i].force) <= least_force(arrows, count) && arrows[i].couple == 0;
        if (!zero) acts_add(&acts, samples, &at, &acting, i);
    }
    if (acts.count == 0) acts_apart(&acts, samples, &acting);
    return acts;
}

/* ---- how it acts */

bool acts_never_along(const struct acts *acts, struct vec u)
{
    for (int k = 0; k < acts->count; k++)
        if (fabs(vec_dot(u, acts->list[k].force)) > same * vec_norm(acts->list[k].force)) return false;
    return true;
}

static double reach_of(const struct acts *acts)
{
    double reach = 0;
    for (int k = 0; k < acts->count; k++) reach = fmax(reach, vec_norm(acts->list[k].arm));
    return reach;
}

bool acts_never_about(const struct acts *acts)
{
    const double reach = reach_of(acts);
    for (int k = 0; k < acts->count; k++) {
        const struct act *act = &acts->list[k];
        if (fabs(vec_cross(act->arm, act->force)) > same * reach * vec_norm(act->force) || act->couple != 0)
            return false;
    }
    return true;
}

bool acts_as_couple(const struct acts *acts)
{
    for (int k = 0; k < acts->count; k++)
        if (acts->list[k].couple != 0) return true;
    return false;
}

bool acts_along_line(const struct acts *acts, struct vec *d)
{
    for (int k = 0; k < acts->count; k++) {
        const struct act *act = &acts->list[k];
        const double force = vec_norm(act->force);
        if (!(fabs(fabs(act->size) - force) <= same * force) || act->size == 0) return false;
        const struct vec now = vec_scale(1 / act->size, act->force);
        if (k == 0) *d = now;
        if (vec_norm(vec_sub(now, *d)) > same) return false;
    }
    return acts->count > 1;
}

bool acts_on_lever(const struct acts *acts, double *lever)
{
    const double reach = reach_of(acts);
    for (int k = 0; k < acts->count; k++) {
        const struct act *act = &acts->list[k];
        const double whole = act->couple != 0 ? fabs(act->couple) : vec_norm(act->force);
        if (!(fabs(fabs(act->size) - whole) <= same * whole)) return false;
        const double now = (act->couple + vec_cross(act->arm, act->force)) / act->size;
        if (k == 0) *lever = now;
        if (!(fabs(now - *lever) <= same * fmax(reach, fabs(*lever)))) return false;
    }
    return acts->count > 1;
}

bool acts_at_place(const struct acts *acts, bool turning, struct vec *d)
{
    const double reach = reach_of(acts);
    for (int k = 0; k < acts->count; k++) {
        const struct vec arm = acts->list[k].arm, turn = acts->list[k].turn;
        const struct vec now = turning ? (struct vec){vec_dot(turn, arm), vec_cross(turn, arm)} : arm;
        if (k == 0) *d = now;
        if (vec_norm(vec_sub(now, *d)) > same * reach) return false;
    }
    if (fabs(d->x) <= same * reach) d->x = 0;
    if (fabs(d->y) <= same * reach) d->y = 0;
    return acts->count > 1;
}
