/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A force that acts in no sample: the states in which it acts.
 *
 * A coupling acts alone: with its lifetime begun, touching, taut or sticking, and all other one-sided constraints
 * open, as they may exclude it. Its force has the direction of its rows, with any multipliers, since those of a
 * motion may vanish where those of an impact do not. A load acts in its lifetime, with any value of inputs. If it is
 * zero in such states too, but varies, or is a reaction or friction, then it is a force in the direction of its law
 * or joint; if no such state is found, one of any direction at any point.
 */
#include <math.h>

#include "dynamics/constraint.h"
#include "dynamics/constraint_view.h"
#include "dynamics/contact.h"
#include "dynamics/tree_system.h"
#include "output/samples.h"

enum { enough = 4, most_tries = 8 };

/* ---- a coupling */

static void open_others(struct fbd_state *state)
{
    const struct plan *plan = &state->model->plan;
    for (size_t k = 0; k < plan->mode_count; k++) {
        const struct mode *mode = &plan->modes[k];
        if (!mode_is_one_sided(mode)) continue;
        state->slip[k] = slip_plus;
        if (mode->kind == mode_contact) state->tree->couplings[mode->coupling].feature = no_feature;
    }
}

static void begin(struct fbd_state *state, const struct coupling *coupling)
{
    const struct tree *tree = state->model->tree;
    const struct instant at = state_instant(state);
    int *life = &state->tree->life[coupling->source->lifetime.number - 1];
    if (*life == life_there) return;
    *life = life_there;
    for (int i = 0; i < tree->coupling_count; i++)
        if (tree->couplings[i].constraint == coupling->constraint && coupling->meeting < 0)
            coupling_begin(state->model, &at, i);
}

/* Let a contact touch by one of its features; false if it has none here. */
static bool touch(struct fbd_state *state, int index, int turn)
{
    const int meeting = state->model->tree->couplings[index].meeting;
    const struct instant at = state_instant(state);
    int features[2];
    const int count = meeting_touching(state->model, state->tree, meeting, HUGE_VAL, features);
    if (count > 0) coupling_set_feature(state->model, &at, index, features[turn % count]);
    return count > 0;
}

static bool may_rub(const struct mode *mode)
{
    return !mode_is_friction(mode) || mode->mu_s.expr || mode->mu_s.constant > 0;
}

static bool close_coupling(struct fbd_state *state, int index, int turn)
{
    const struct fbd_model *model = state->model;
    const struct tree *tree = model->tree;
    const struct coupling *coupling = &tree->couplings[index];
    const struct instant at = state_instant(state);
    tree_move(model, &at);
    open_others(state);
    if (coupling->source->lifetime.number > 0) begin(state, coupling);
    if (coupling->meeting >= 0 && !touch(state, index, turn)) return false;
    for (int i = 0; i < tree->coupling_count; i++) {
        const struct coupling *piece = &tree->couplings[i];
        if (i != index && (piece->constraint != coupling->constraint || piece->meeting >= 0)) continue;
        if (piece->surface >= 0) state->slip[piece->surface] = stick;
        if (piece->pair >= 0)
            state->slip[piece->pair] = may_rub(&model->plan.modes[piece->pair]) ? stick : slip_plus;
    }
    return sample_evaluate(state);
}

/* Give each of its rows a multiplier. */
static void press(struct fbd_state *state, int index, gsl_rng *rng)
{
    const struct coupling *coupling = &state->model->tree->couplings[index];
    const struct instant at = state_instant(state);
    for (int k = coupling->first_row; k < coupling->first_row + coupling->row_count; k++)
        if (tree_takes_part(state->model->tree, &at, k))
            state->tree->rows[k].lambda = sample_between(rng, 1, 2);
}

/* ---- a load */

static void begin_load(struct fbd_state *state, int load, gsl_rng *rng)
{
    const struct scene *scene = state->model->scene;
    const int lifetime = state->model->loads[load].source->lifetime.number;
    if (lifetime > 0) state->tree->life[lifetime - 1] = life_there;
    for (size_t i = 0; state->held && i < scene->parameter_count; i++)
        if (scene->parameters[i].input) state->held[i] += sample_between(rng, -1, 1);
}

/* ---- the states */

struct place_of_force {
    int coupling, load; /* -1 for none */
};

static bool draw(const struct samples *samples, const struct place_of_force *of, int turn)
{
    struct fbd_state *state = samples->apart;
    state_copy(state, samples->states[0]);
    sample_move(state, samples->rng, turn < enough ? 1 : 0.25);
    if (of->coupling < 0) {
        begin_load(state, of->load, samples->rng);
        return sample_evaluate(state);
    }
    if (!close_coupling(state, of->coupling, turn)) return false;
    press(state, of->coupling, samples->rng);
    return true;
}

/* False if no such state exists. */
static bool add_states(struct acts *acts, const struct samples *samples, const struct acting *acting,
                       const struct place_of_force *of)
{
    const struct fbd_state *state = samples->apart;
    bool found = false;
    for (int turn = 0; turn < most_tries && acts->count < enough; turn++) {
        if (!draw(samples, of, turn)) continue;
        const struct instant at = state_instant(state);
        const size_t count = diagram_list(state->model, acting->body, &at, state->slots, samples->arrows),
                     i = acting_arrow(acting, samples->arrows, count);
        const struct arrow *arrow = &samples->arrows[i];
        found = true;
        if (vec_norm(arrow->force) > 0 || arrow->couple != 0) acts_add(acts, samples, &at, acting, i);
    }
    return found;
}

/* ---- without states */

static struct vec any(gsl_rng *rng)
{
    const double x = sample_between(rng, 1, 2);
    return (struct vec){x, sample_between(rng, 1, 2)};
}

static const struct force_symbol *symbol_of(const struct samples *samples, int body, size_t arrow)
{
    for (size_t i = 0; i < samples->forces.count; i++)
        if (samples->forces.list[i].name.body == body && samples->forces.list[i].arrow == arrow)
            return samples->forces.list[i].symbol;
    return NULL;
}

static bool rubs(const struct model_load *load)
{
    return load->source->kind == load_friction || load->source->kind == moment_friction;
}

/* In the direction of the law, which depends on neither the size nor the place. */
static struct vec any_of_applied(const struct samples *samples, const struct model_load *load,
                                 const struct instant *at)
{
    const struct pose pose = body_pose(&samples->apart->model->bodies[load->body], at);
    struct model_load acting = *load;
    struct formula *sizes[] = {&acting.value, &acting.fx, &acting.fy};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
        if (sizes[k]->expr) *sizes[k] = (struct formula){.constant = sample_between(samples->rng, 1, 2)};
    return applied_force(&acting, &pose, at);
}

static struct vec any_force(const struct samples *samples, const struct instant *at, int joint,
                            const struct model_load *load)
{
    const struct fbd_model *model = samples->apart->model;
    if (joint >= 0 && model->bodies[joint].joint->path != path_none)
        return surface_normal(model, &model->bodies[joint], at);
    if (!load) return any(samples->rng);
    const struct model_body *body = &model->bodies[load->body];
    if (load->source->kind == load_applied) return any_of_applied(samples, load, at);
    if (rubs(load) || (load->source->kind == load_potential && body->count == 1))
        return body_direction(body, at);
    return any(samples->rng);
}

static void set_any(const struct samples *samples, const struct instant *at,
                    const struct force_symbol *symbol, struct arrow *arrow)
{
    const struct fbd_model *model = samples->apart->model;
    const int joint = symbol ? symbol->joint : -1;
    const struct model_load *load = arrow->load >= 0 ? &model->loads[arrow->load] : NULL;
    const bool moment = symbol && symbol->moment;
    if (!moment || joint >= 0) arrow->force = any_force(samples, at, joint, load);
    if (!moment && joint < 0 && !load) arrow->point = vec_add(arrow->point, any(samples->rng));
    if (moment || (joint >= 0 && !model->bodies[joint].joint->has_axis && !model->bodies[joint].alone))
        arrow->couple = sample_between(samples->rng, 1, 2);
}

static void add_any(struct acts *acts, const struct samples *samples, const struct acting *acting)
{
    for (int k = 0; k < samples->count; k++) {
        const struct fbd_state *state = samples->states[k];
        const struct instant at = state_instant(state);
        const size_t count = diagram_list(state->model, acting->body, &at, state->slots, samples->arrows),
                     i = acting_arrow(acting, samples->arrows, count);
        set_any(samples, &at, symbol_of(samples, acting->body, i), &samples->arrows[i]);
        acts_add(acts, samples, &at, acting, i);
    }
}

/* ---- the whole */

/* True if no formula of the load varies, and no friction. */
static bool is_zero_by_law(const struct fbd_model *model, const struct model_load *load)
{
    const int pair = model->bodies[load->body].friction;
    const struct mode *mode = rubs(load) && pair >= 0 ? &model->plan.modes[pair] : NULL;
    if (mode) return !may_rub(mode);
    return !load->value.expr && !load->fx.expr && !load->fy.expr && !load->couple.expr &&
           !load->potential.expr;
}

static void find(struct acts *acts, const struct samples *samples, const struct acting *acting, size_t i)
{
    const struct fbd_state *state = samples->states[0];
    const struct fbd_model *model = state->model;
    struct place_of_force of = {-1, -1};
    struct coupling_place place;
    gsl_rng_set(samples->rng, gsl_rng_default_seed);
    const int load = samples->arrows[i].load;
    if (coupling_of_force(model, acting->body, acting->name, &place))
        of.coupling = place.coupling;
    else if (load >= 0 && model->loads[load].source->kind != load_normal)
        of.load = load;
    const bool joint = of.coupling < 0 && of.load < 0,
               found = !joint && add_states(acts, samples, acting, &of);
    if (acts->count > 0) return;
    if (of.load >= 0 ? !found || !is_zero_by_law(model, &model->loads[load]) : !found)
        add_any(acts, samples, acting);
}

void acts_apart(struct acts *acts, const struct samples *samples, const struct acting *acting)
{
    const struct fbd_state *state = samples->states[0];
    const struct instant at = state_instant(state);
    const size_t count = diagram_list(state->model, acting->body, &at, state->slots, samples->arrows),
                 i = acting_arrow(acting, samples->arrows, count);
    struct acts_kept **of_body = &samples->kept[acting->body];
    if (!*of_body) *of_body = ARENA_ARRAY(samples->arena, count, struct acts_kept);
    if (i == count || !*of_body) return;
    struct acts_kept *kept = &(*of_body)[i];
    if (!kept->known || kept->about_axis != acting->about_axis) {
        find(acts, samples, acting, i);
        *kept = (struct acts_kept){true, acting->about_axis, *acts};
    }
    *acts = kept->acts;
}
