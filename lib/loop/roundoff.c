/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <gsl/gsl_errno.h>
#include <limits.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/forces.h"
#include "dynamics/load_rounding.h"
#include "dynamics/tree_bare.h"
#include "dynamics/tree_system.h"
#include "dynamics/user_states.h"
#include "loop/error_scale_init.h"
#include "loop/run.h"
#include "numeric/tolerances.h"

/* A difference of two positions has the round-off of their distance from the origin, with a share of that of long sums. */
static const double share_of_difference = 1.0 / 64;

/* The length over which an error of position turns a body: the arm of a force on it, or its radius of gyration where the arm is
 * shorter. */
static double turning_length(const struct model_body *body, struct vec arm)
{
    const struct inertia *inertia = &body->inertia;
    return fmax(vec_norm(arm), inertia->mass > 0 ? sqrt(inertia->I_G / inertia->mass) : 0);
}

/* Relative round-off error of the direction and arms of a row: that of positions, over the length of a rod or rope, else over
 * that by which the bodies turn. A pin has neither: its directions are those of the world, its arms those of its points. A
 * length that is round-off, as the arm of a particle, is none. */
static double turned_by_places(const struct fbd_model *model, int index, const struct tree_work *work)
{
    const struct coupling *coupling = &model->tree->couplings[model->tree->coupling_of_row[index]];
    const struct row *row = &work->rows[index];
    const bool has_length = coupling->law->length;
    double away = 0, length = 0;
    struct vec first = {0, 0};
    for (int k = 0; k < row->port_count; k++) {
        const struct port *port = &row->ports[k];
        const struct vec point = vec_add(work->links[port->link].p, port->arm);
        if (k == 0) first = point;
        away = fmax(away, vec_norm(point));
        if (has_length) length = fmax(length, vec_norm(vec_sub(point, first)));
        if (port->link > 0)
            length =
                fmax(length, turning_length(&model->bodies[model->tree->links[port->link].body], port->arm));
    }
    const bool is_rounding = length <= round_off(64, away + coupling_extent(coupling));
    const bool fixed = coupling->kind == constraint_pin || coupling->kind == constraint_weld;
    return fixed || is_rounding ? 0 : share_of_difference * away / length;
}

/* The sum of the rotations of the links from the ground to each: an angle in the world is that sum, with its
 * rounding. A force between two links uses the larger one: `turned` has room for all links twice. */
static void measure_turns(struct run *run, const struct instant *at)
{
    const struct tree *tree = run->model->tree;
    double *own = run->roundoff.turned, *sides = own + tree->count;
    /* With projection onto couplings, directions have the rounding of a radian, turned or not: positions have
     * that accuracy relative to the arms that lead to them. */
    own[0] = tree->row_count > 0 ? 1 : 0;
    for (int i = 1; i < tree->joined; i++) {
        const struct model_body *body = &run->model->bodies[tree->links[i].body];
        const int angle = body->joint->angle;
        own[i] = own[tree->links[i].parent] + (angle < 0 ? 0 : fabs(run->state->y[body->first + angle]));
    }
    memcpy(sides, own, (size_t)tree->count * sizeof *sides);
    for (int i = 1; i < tree->joined; i++) {
        double *parent = &sides[tree->links[i].parent];
        *parent = fmax(*parent, own[i]);
    }
    for (int j = 0; j < tree->row_count; j++) {
        if (!tree_takes_part(tree, at, j)) continue;
        const struct row *row = &at->tree->rows[j];
        double most = 0;
        for (int k = 0; k < row->port_count; k++)
            if (port_turns(&row->ports[k])) most = fmax(most, own[row->ports[k].link]);
        most += turned_by_places(run->model, j, at->tree);
        for (int k = 0; k < row->port_count; k++) {
            double *side = &sides[row->ports[k].link];
            *side = fmax(*side, most);
        }
    }
}

/* ---- springs between distant points
 *
 * The force of a spring is the small difference of its length and its free length, which has the rounding of
 * the positions of its ends: a row of blocks of 1 kg on springs of 1e6 N/m, 1 to 16 m from the origin, has
 * forces of 1e-9 N at rest. The force of a damper has the rounding of the velocities of its ends. Their
 * weight is smaller than that of the gross forces, which are long sums: these are differences of two numbers.
 */

static void add_cancelled(struct run *run, int body, double force, double arm)
{
    double *cancelled = run->roundoff.cancelled + 2 * (size_t)body;
    cancelled[0] += force;
    cancelled[1] += force * arm;
}

static void measure_cancelled(struct run *run, const struct instant *at)
{
    const struct tree *tree = run->model->tree;
    memset(run->roundoff.cancelled, 0, 2 * run->model->body_count * sizeof *run->roundoff.cancelled);
    for (size_t i = 0; i < tree->spring_count; i++) {
        const struct tree_spring *spring = &tree->springs[i];
        double far = fabs(spring->free_length), fast = 0, arm[2];
        for (int end = 0; end < 2; end++) {
            const struct tree_state *link = &at->tree->links[spring->link[end]];
            arm[end] = vec_norm(spring->point[end]);
            far += vec_norm(link->p) + arm[end];
            fast += vec_norm(link->v) + fabs(link->omega) * arm[end];
        }
        double force = fabs(spring->stiffness) * far + fabs(spring->damping) * fast;
        for (int end = 0; end < 2; end++)
            if (spring->link[end] > 0)
                add_cancelled(run, tree->links[spring->link[end]].body, force, arm[end]);
    }
}

/* Add the sizes of the terms of the generalized forces of an arrow to `gross`, for a jointed body. A moment
 * is small where the force points at O, and still has the rounding of its products, and of the angle. */
static void add_jointed(const struct model_body *body, const struct tree_state *link, double angle,
                        const struct arrow *arrow, double *gross)
{
    struct vec f = arrow->force, arm = vec_sub(arrow->point, link->p);
    double size = vec_norm(f), moment = fabs(arm.x * f.y) + fabs(arm.y * f.x) + fabs(arrow->couple);
    moment += angle * size * vec_norm(arm);
    double along = fabs(link->e.x * f.x) + fabs(link->e.y * f.y) + angle * size;
    double across = fabs(link->e.x * f.y) + fabs(link->e.y * f.x) + angle * size;
    for (int k = 0; k < body->count; k++)
        gross[k] += coordinate_is_angle(body, k) ? moment : k == 0 ? along : across;
}

/* Add the sizes of the generalized forces along each coordinate of a body. */
static void add_gross_forces(struct run *run, int b, const struct instant *at, double *gross)
{
    const struct model_body *body = &run->model->bodies[b];
    int link = body->place.link;
    size_t count =
        (body->alone ? diagram_fill : diagram_list)(run->model, b, at, run->state->slots, run->state->arrows);
    const struct tree *tree = run->model->tree;
    double angle = body->alone ? 0 : run->roundoff.turned[tree->count + link];
    for (size_t i = 0; i < count; i++) {
        if (!body->alone)
            add_jointed(body, &at->tree->links[link], angle, &run->state->arrows[i], gross);
        else
            for (int k = 0; k < body->count; k++) gross[k] += fabs(run->state->arrows[i].share[k]);
    }
    for (int k = 0; k < body->count; k++)
        gross[k] += share_of_difference * run->roundoff.cancelled[2 * b + coordinate_is_angle(body, k)];
}

/* ---- formulas of applied forces (load_rounding.h) */

/* Add the generalized forces of a force at a point, for the coordinates of a link that carries it. */
static void add_along_link(const struct run *run, const struct tree_state *s, int link, struct vec point,
                           const struct load_rounding *of, double *Q)
{
    const struct model_body *body = &run->model->bodies[run->model->tree->links[link].body];
    const double moment = vec_cross(vec_sub(point, s->p), of->force) + of->couple;
    double own[most_coordinates_of_a_body];
    joint_shares(body->joint, s, (struct wrench){moment, of->force}, own);
    for (int k = 0; k < body->count; k++) Q[body->first + k] += own[k];
}

/* Add the generalized forces of the rounding of a load; false where it has none. */
static bool add_rounding(const struct run *run, const struct instant *at, size_t index, double *Q)
{
    const struct model_load *load = &run->model->loads[index];
    const struct load_rounding of = load_rounding(run->model, index, at);
    const struct model_body *body = &run->model->bodies[load->body];
    if (vec_norm(of.force) == 0 && of.couple == 0) return false;
    const struct pose pose = body_pose(body, at);
    const struct vec point = point_motion(body, &pose, load->point).p;
    if (body->alone) {
        double arm = vec_norm(vec_sub(point, pose.origin)), force = vec_norm(of.force);
        for (int k = 0; k < body->count; k++)
            Q[body->first + k] += coordinate_is_angle(body, k) ? force * arm + of.couple : force;
        return true;
    }
    for (int link = body->place.link; link > 0;
         link = load->in_joint ? 0 : run->model->tree->links[link].parent)
        add_along_link(run, &at->tree->links[link], link, point, &of, Q);
    return true;
}

/* Add the changes of accelerations of jointed bodies by generalized forces Q. */
static void add_answer(struct run *run, const struct instant *at, const double *Q, double *noise)
{
    const struct tree *tree = run->model->tree;
    double *slots = state_scratch(run->state).slots;
    force_slots(run->model, at, slots);
    for (int i = 0; i < run->model->plan.n; i++) slots[i] += Q[i];
    tree_accelerations(run->model, at, slots, at->tree->a);
    for (int link = 1; link < tree->joined; link++) {
        const struct model_body *body = &run->model->bodies[tree->links[link].body];
        for (int i = body->first; i < body->first + body->count; i++)
            noise[i] += fabs(at->tree->a[i] - run->state->a[i]);
    }
}

/* The effect of rounding in formulas on each acceleration: the sum over the loads, or over a few groups of
 * them. */
static void measure_formulas(struct run *run, const struct instant *at)
{
    enum { most_lots = 8 };
    const struct fbd_model *model = run->model;
    const size_t n = (size_t)model->plan.n;
    double *noise = run->roundoff.formulas, *Q = run->work.aside + plan_size(&model->plan);
    memset(noise, 0, n * sizeof *noise);
    for (size_t lot = 0; lot < most_lots; lot++) {
        bool any = false;
        memset(Q, 0, n * sizeof *Q);
        for (size_t i = lot; i < model->load_count; i += most_lots) any |= add_rounding(run, at, i, Q);
        if (!any) continue;
        for (size_t b = 0; b < model->body_count; b++) {
            const struct model_body *body = &model->bodies[b];
            for (int i = body->first; body->alone && i < body->first + body->count; i++)
                noise[i] += fabs(Q[i]) * model->plan.inverse_inertia[i];
        }
        if (tree_joins(model->tree)) add_answer(run, at, Q, noise);
    }
}

/* The direction of motion by time alone: of prescribed coordinates. */
static void take_driven(const struct run *run, double *dy)
{
    const struct plan *plan = &run->model->plan;
    size_t n = (size_t)plan->n;
    memset(dy, 0, plan_size(plan) * sizeof *dy);
    for (size_t pair = 0; pair < plan->mode_count; pair++) {
        if (plan->modes[pair].kind != mode_drive) continue;
        size_t i = (size_t)plan->modes[pair].coordinate;
        dy[i] = run->state->y[n + i];
        dy[n + i] = run->state->a[i];
    }
}

/* The derivative by time alone is zero if no force depends on time explicitly and no motion is prescribed. */
void roundoff_changes(struct run *run, const struct instant *at, bool by_time, double *along)
{
    const struct plan *plan = &run->model->plan;
    struct scratch scratch = state_scratch(run->state);
    const struct tree *tree = run->model->tree;
    if (by_time && tree_is_bare(run->model) && tree->joined == tree->count) {
        memset(along, 0, plan_rates(plan) * sizeof *along);
        return;
    }
    struct direction flow = state_flow(run->state, run->work.sample);
    if (by_time) take_driven(run, run->work.sample);
    accelerations_along(run->model, at, &flow, scratch.slots, scratch.slots_along, along);
    if (plan->own > 0) user_state_rates_along(run->model, at, &flow, along + plan->n);
}

/* Round-off level of the acceleration of a body, in roundings of its gross forces. Measured with chains of 16
 * to 128 rods: error estimates of dop853 are up to 4 roundings of the gross forces of the worst rod, seldom
 * 10. The maximum over many is larger: of a thousand rods at rest but for rounding, one is above 16 in every
 * step, which would shorten the steps a thousandfold. */
static double roundings_of(const struct fbd_model *model, bool in_tree)
{
    const double single = 2, jointed = 16, few = 16;
    if (!in_tree) return single;
    double links = model->tree->joined - 1;
    return jointed * (1 + fmax(0, log2(links / few)));
}

/* Set the level of an acceleration, or of the rate of a user state; `passing` is the part that depends on
 * time and formulas. */
static void take_noise(struct run *run, size_t rate, double noise, double passing)
{
    double all = isfinite(noise + passing) ? noise + passing : 0;
    run->roundoff.accelerations[rate] = all;
    run->roundoff.largest[rate] = fmax(run->roundoff.largest[rate], fabs(run->state->a[rate]));
    switcher_set_noise(run->stepper, rate, all, all > 0 ? passing : 0);
}

static void set_noise(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct instant here = state_instant(run->state);
    const struct instant *at = &here;
    measure_formulas(run, at);
    roundoff_changes(run, at, true, run->roundoff.along);
    if (tree_joins(run->model->tree)) measure_turns(run, at);
    measure_cancelled(run, at);
    const double roundings[] = {roundings_of(run->model, false), roundings_of(run->model, true)};
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        double gross[most_coordinates_of_a_body] = {0};
        add_gross_forces(run, (int)b, at, gross);
        for (int k = 0; k < body->count; k++) {
            int i = body->first + k;
            double of_time = round_off(1, fabs(at->t * run->roundoff.along[i])),
                   of_sum = round_off(roundings[!body->alone], gross[k]) * plan->inverse_inertia[i];
            take_noise(run, (size_t)i, of_sum, of_time + run->roundoff.formulas[i]);
        }
    }
    for (int i = 0; i < plan->own; i++) {
        size_t rate = (size_t)plan->n + (size_t)i;
        double of_time = round_off(1, fabs(at->t * run->roundoff.along[rate]));
        take_noise(run, rate, 0, of_time + formula_rounding(&plan->rates[i], at));
    }
}

void roundoff_estimate(struct run *run)
{
    set_noise(run);
    run->roundoff.since = 0;
    run->roundoff.pause = 1;
    error_scale_init(run);
}

/* Are the levels within a factor of two of those before? */
static bool is_steady(const struct run *run, const double *before)
{
    const double most = 2;
    for (size_t i = 0; i < plan_rates(&run->model->plan); i++) {
        double now = run->roundoff.accelerations[i];
        if (now > most * before[i] || before[i] > most * now) return false;
    }
    return true;
}

/* A pulse may increase an acceleration from zero, and its round-off level, which is then outdated. */
static bool has_grown(const struct run *run)
{
    const double most = 4;
    const double *a = run->work.f + run->model->plan.n;
    if (!run->roundoff.heeds_time) return false;
    for (size_t i = 0; i < plan_rates(&run->model->plan); i++)
        if (fabs(a[i]) > most * run->roundoff.largest[i]) return true;
    return false;
}

/* Steps between updates with a tree: the cost is a hundredth of that of the steps. */
static const unsigned long steps_between = 64;

unsigned long roundoff_steps(const struct run *run)
{
    const unsigned long next = run->roundoff.since + 1;
    if (!tree_joins(run->model->tree)) return ULONG_MAX;
    return next < steps_between ? steps_between - next : 0;
}

/* Where the level limits steps it must be that of the present state. An update costs as much as five
 * right-hand sides; where the level hardly changes, as in a chain whose last rods move at 1e-9 rad/s, some
 * steps may pass. Levels that change are updated after each step. */
void roundoff_renew(struct run *run)
{
    const unsigned long most_between = 8;
    if (run->options.step > 0) return; /* fixed step size */
    run->roundoff.since++;
    bool due = (tree_joins(run->model->tree) && run->roundoff.since >= steps_between) || has_grown(run);
    bool counts =
        run->roundoff.since >= run->roundoff.pause && switcher_noise_counts(run->stepper, run->step.h);
    if (!due && !counts) return;
    double *before = run->work.aside;
    memcpy(before, run->roundoff.accelerations, plan_rates(&run->model->plan) * sizeof *before);
    run_evaluate(run);
    set_noise(run);
    run->roundoff.since = 0;
    run->roundoff.pause = !is_steady(run, before)                  ? 1
                          : 2 * run->roundoff.pause < most_between ? 2 * run->roundoff.pause
                                                                   : most_between;
}

/* ---- memory */

static size_t links_of(const struct fbd_model *model)
{
    return tree_joins(model->tree) ? (size_t)model->tree->count : 0;
}

size_t roundoff_size(const struct fbd_model *model)
{
    return 4 * plan_rates(&model->plan) + 2 * links_of(model) + 2 * model->body_count +
           plan_size(&model->plan);
}

static bool names_time(const struct formula *formula)
{
    return formula->expr && expr_uses_time(formula->expr);
}

/* Does a force, or the rate of a user state, depend on time explicitly? */
static bool heeds_time(const struct fbd_model *model)
{
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (names_time(&load->value) || names_time(&load->fx) || names_time(&load->fy)) return true;
    }
    for (int i = 0; i < model->plan.own; i++)
        if (names_time(&model->plan.rates[i])) return true;
    return false;
}

void roundoff_init(struct run *run, double *memory)
{
    const size_t rates = plan_rates(&run->model->plan);
    struct roundoff *roundoff = &run->roundoff;
    roundoff->along = memory;
    roundoff->accelerations = roundoff->along + rates;
    roundoff->largest = roundoff->accelerations + rates;
    roundoff->formulas = roundoff->largest + rates;
    roundoff->turned = roundoff->formulas + rates;
    roundoff->cancelled = roundoff->turned + 2 * links_of(run->model);
    roundoff->nothing = roundoff->cancelled + 2 * run->model->body_count;
    roundoff->heeds_time = heeds_time(run->model);
}
