/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
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

/* A difference of two positions has the round-off of their distance from the origin, with a share of that of long sums. */
static const double share_of_difference = 1.0 / 64;

/* The largest distance of the ports of a row from the origin. */
static double distance_of_ports(const struct row *row, const struct tree_state *links)
{
    double away = 0;
    for (int k = 0; k < row->port_count; k++)
        away = fmax(away, vec_norm(vec_add(links[row->ports[k].link].p, row->ports[k].arm)));
    return away;
}

/* Relative round-off error of the direction of a rod or rope. Other rows have directions that their links have. */
static double turned_by_places(const struct row *row, const struct tree_state *links)
{
    const struct port *a = &row->ports[0], *b = &row->ports[row->port_count - 1];
    const double length =
        vec_norm(vec_sub(vec_add(links[a->link].p, a->arm), vec_add(links[b->link].p, b->arm)));
    return length > 0 ? share_of_difference * distance_of_ports(row, links) / length : 0;
}

/* How much the links from the ground to each have turned in all: an angle in the world is their sum, and has
 * its rounding. A force between two links has the larger one. A contact, roll or slot finds its point from the other link: its
 * arm has the round-off of that place. `turned` has room for all links three times: for the angle of each, for the larger
 * one, and for the distance from the origin times share_of_difference. */
static void measure_turns(struct run *run, const struct instant *at)
{
    const struct tree *tree = run->model->tree;
    double *own = run->roundoff.turned, *sides = own + tree->count, *places = sides + tree->count;
    /* Where couplings bring states back, directions have the rounding of a radian, turned or not: places are
     * known to that share of the arms that lead to them. */
    own[0] = tree->row_count > 0 ? 1 : 0;
    for (int i = 1; i < tree->count; i++) {
        const struct model_body *body = &run->model->bodies[tree->links[i].body];
        bool turns = body->kind == motion_pivot || body->kind == motion_planar;
        own[i] =
            own[tree->links[i].parent] + (turns ? fabs(run->state->y[body->first + body->count - 1]) : 0);
    }
    memcpy(sides, own, (size_t)tree->count * sizeof *sides);
    memset(places, 0, (size_t)tree->count * sizeof *places);
    for (int i = 1; i < tree->count; i++) {
        double *parent = &sides[tree->links[i].parent];
        *parent = fmax(*parent, own[i]);
    }
    for (int j = 0; j < tree->row_count; j++) {
        if (!tree_takes_part(tree, at, j)) continue;
        const struct row *row = &at->tree->rows[j];
        const struct coupling *coupling = &tree->couplings[tree->coupling_of_row[j]];
        const bool finds_point = !coupling->law->length && coupling->kind != constraint_pin;
        const double away = finds_point ? share_of_difference * distance_of_ports(row, at->tree->links) : 0;
        double most = 0;
        for (int k = 0; k < row->port_count; k++)
            if (port_turns(&row->ports[k])) most = fmax(most, own[row->ports[k].link]);
        if (coupling->law->length) most += turned_by_places(row, at->tree->links);
        for (int k = 0; k < row->port_count; k++) {
            const int link = row->ports[k].link;
            sides[link] = fmax(sides[link], most);
            places[link] = fmax(places[link], away);
        }
    }
}

/* ---- springs between distant points
 *
 * The force of a spring is the small difference of its length and its free length, which has the rounding of the
 * places of its ends: a row of blocks of 1 kg on springs of 1e6 N/m, 1 to 16 m from the origin, has forces of 1e-9 N
 * where it rests. A damper has that of the velocities of its ends. They count
 * with a share of the roundings of gross forces, which are sums of many: these are differences of two numbers. */

static void add_cancelled(struct run *run, int body, double force, double arm)
{
    double *cancelled = run->roundoff.cancelled + 2 * (size_t)body;
    cancelled[0] += force;
    cancelled[1] += force * arm;
}

static void cancel_in_tree(struct run *run, const struct instant *at)
{
    const struct tree *tree = run->model->tree;
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

/* To the ground: what its length has beyond that of the anchor's distance is in its force. */
static void measure_cancelled(struct run *run, const struct instant *at)
{
    const struct plan *plan = &run->model->plan;
    memset(run->roundoff.cancelled, 0, 2 * run->model->body_count * sizeof *run->roundoff.cancelled);
    for (size_t i = 0; i < plan->link_count; i++) {
        const struct link_term *link = &plan->links[i];
        double far = vec_norm(link->anchor) + fabs(link->free_length);
        add_cancelled(run, link->body, fabs(link->stiffness) * far, vec_norm(link->point));
    }
    if (run->model->tree) cancel_in_tree(run, at);
}

/* The size of what has been added up for the share of an arrow in each coordinate of a jointed body. A moment
 * is small where the force points at O, and still has the rounding of its products, and of the angle. */
static void add_jointed(const struct model_body *body, const struct tree_state *link, double angle,
                        double place, const struct arrow *arrow, double *gross)
{
    struct vec f = arrow->force, arm = vec_sub(arrow->point, link->p);
    double size = vec_norm(f), moment = fabs(arm.x * f.y) + fabs(arm.y * f.x) + fabs(arrow->couple);
    moment += (angle * vec_norm(arm) + place) * size;
    double along = fabs(link->e.x * f.x) + fabs(link->e.y * f.y) + angle * size;
    double across = fabs(link->e.x * f.y) + fabs(link->e.y * f.x) + angle * size;
    if (body->count > 0) gross[0] += body->kind == motion_pivot ? moment : along;
    if (body->count > 1) gross[1] += across;
    if (body->count > 2) gross[2] += moment;
}

/* Add the sizes of what acts along each coordinate of a body. */
static void add_gross_forces(struct run *run, int b, const struct instant *at, double *gross)
{
    const struct model_body *body = &run->model->bodies[b];
    int link = body->place.link;
    size_t count = (link > 0 ? diagram_list : diagram_fill)(run->model, b, at, run->state->a,
                                                            run->state->slots, run->work.arrows);
    const struct tree *tree = run->model->tree;
    double angle = tree && link > 0 ? run->roundoff.turned[tree->count + link] : 0,
           place = tree && link > 0 ? run->roundoff.turned[2 * tree->count + link] : 0;
    for (size_t i = 0; i < count; i++) {
        if (link > 0)
            add_jointed(body, &at->tree->links[link], angle, place, &run->work.arrows[i], gross);
        else
            for (int k = 0; k < body->count; k++) gross[k] += fabs(run->work.arrows[i].share[k]);
    }
    for (int k = 0; k < body->count; k++)
        gross[k] += share_of_difference * run->roundoff.cancelled[2 * b + coordinate_turns(body, k)];
}

/* ---- formulas of applied forces (load_rounding.h) */

/* What a force at a point is along the coordinates of a link that carries it. */
static void add_along_link(const struct run *run, const struct tree_state *s, int link, struct vec point,
                           const struct load_rounding *of, double *Q)
{
    const struct model_body *body = &run->model->bodies[run->model->tree->links[link].body];
    double moment = vec_cross(vec_sub(point, s->p), of->force) + of->couple, along = vec_dot(s->e, of->force),
           own[most_coordinates_of_a_body] = {along, vec_cross(s->e, of->force), moment};
    if (body->kind == motion_pivot) own[0] = moment;
    if (body->kind == motion_track) own[0] += s->turning * moment;
    for (int k = 0; k < body->count && k < most_coordinates_of_a_body; k++) Q[body->first + k] += own[k];
}

/* Add what the rounding of a load is along coordinates; false where it has none. */
static bool add_rounding(const struct run *run, const struct instant *at, size_t index, double *Q)
{
    const struct model_load *load = &run->model->loads[index];
    const struct load_rounding of = load_rounding(run->model, index, at);
    const struct model_body *body = &run->model->bodies[load->body];
    if (vec_norm(of.force) == 0 && of.couple == 0) return false;
    const struct pose pose = body_pose(body, at);
    const struct vec point = point_motion(body, &pose, load->point).p;
    if (body->place.link == 0) {
        double arm = vec_norm(vec_sub(point, pose.origin)), force = vec_norm(of.force);
        for (int k = 0; k < body->count; k++)
            Q[body->first + k] += coordinate_turns(body, k) ? force * arm + of.couple : force;
    }
    for (int link = body->place.link; link > 0;
         link = load->in_joint ? 0 : run->model->tree->links[link].parent)
        add_along_link(run, &at->tree->links[link], link, point, &of, Q);
    return true;
}

/* Accelerations of jointed bodies are found once more with forces that are off by Q. */
static void add_answer(struct run *run, const struct instant *at, const double *Q, double *noise)
{
    const struct tree *tree = run->model->tree;
    double *slots = state_scratch(run->state).slots;
    force_slots(run->model, at, slots);
    for (int i = 0; i < run->model->plan.n; i++) slots[i] += Q[i];
    tree_accelerations(run->model, at, slots, at->tree->a);
    for (int link = 1; link < tree->count; link++) {
        const struct model_body *body = &run->model->bodies[tree->links[link].body];
        for (int i = body->first; i < body->first + body->count; i++)
            noise[i] += fabs(at->tree->a[i] - run->state->a[i]);
    }
}

/* What they do to each acceleration: the sum over the loads, or over a few lots of many. */
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
            for (int i = body->first; body->place.link == 0 && i < body->first + body->count; i++)
                noise[i] += fabs(Q[i]) * model->plan.inverse_inertia[i];
        }
        if (model->tree) add_answer(run, at, Q, noise);
    }
}

/* What moves with the time and not by the integration: coordinates that are prescribed. */
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

/* Where no force names the time, and nothing is prescribed, nothing changes by it, as steps have the size that they say. */
void roundoff_changes(struct run *run, const struct instant *at, bool by_time, double *along)
{
    const struct plan *plan = &run->model->plan;
    struct scratch scratch = state_scratch(run->state);
    if (by_time && tree_is_bare(run->model)) { /* no force names the time, and nothing is prescribed */
        memset(along, 0, plan_rates(plan) * sizeof *along);
        return;
    }
    struct direction flow = state_flow(run->state, run->work.sample);
    if (by_time) take_driven(run, run->work.sample);
    accelerations_along(run->model, at, &flow, scratch.slots, scratch.slots_along, along);
    if (plan->own > 0) user_state_rates_along(run->model, at, &flow, along + plan->n);
}

/* Roundings of its gross forces that the acceleration of a body is known to. Measured with chains of 16 to
 * 128 rods, error estimates of dop853 are up to 4 roundings of the gross forces of the worst rod, seldom 10.
 * The worst of many is worse: one of a thousand rods that lie still but for rounding is above 16 in every
 * step, and has steps a thousand times as short as the motion of the others needs. */
static double roundings_of(const struct fbd_model *model, bool in_tree)
{
    const double single = 2, jointed = 16, few = 16;
    if (!in_tree || !model->tree) return single;
    double links = model->tree->count - 1;
    return jointed * (1 + fmax(0, log2(links / few)));
}

/* Of an acceleration, or of the rate of a state; with `passing` besides, which goes with it. */
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
    if (run->model->tree) measure_turns(run, at);
    measure_cancelled(run, at);
    const double roundings[] = {roundings_of(run->model, false), roundings_of(run->model, true)};
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        double gross[most_coordinates_of_a_body] = {0};
        add_gross_forces(run, (int)b, at, gross);
        for (int k = 0; k < body->count; k++) {
            int i = body->first + k;
            double of_time = DBL_EPSILON * fabs(at->t * run->roundoff.along[i]),
                   of_sum =
                       DBL_EPSILON * roundings[body->place.link > 0] * gross[k] * plan->inverse_inertia[i];
            take_noise(run, (size_t)i, of_sum, of_time + run->roundoff.formulas[i]);
        }
    }
    for (int i = 0; i < plan->own; i++) {
        size_t rate = (size_t)plan->n + (size_t)i;
        double of_time = DBL_EPSILON * fabs(at->t * run->roundoff.along[rate]);
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

/* Have accelerations about the noise that they had before? */
static bool is_steady(const struct run *run, const double *before)
{
    const double most = 2;
    for (size_t i = 0; i < plan_rates(&run->model->plan); i++) {
        double now = run->roundoff.accelerations[i];
        if (now > most * before[i] || before[i] > most * now) return false;
    }
    return true;
}

/* A pulse makes an acceleration of nothing, and its noise with it, which is not yet known there. */
static bool has_grown(const struct run *run)
{
    const double most = 4;
    const double *a = run->work.f + run->model->plan.n;
    if (!run->roundoff.heeds_time) return false;
    for (size_t i = 0; i < plan_rates(&run->model->plan); i++)
        if (fabs(a[i]) > most * run->roundoff.largest[i]) return true;
    return false;
}

/* Steps after which it is looked at, in trees: it costs a hundredth of them. */
static const unsigned long steps_between = 64;

unsigned long roundoff_steps(const struct run *run)
{
    const unsigned long next = run->roundoff.since + 1;
    if (!run->model->tree) return ULONG_MAX;
    return next < steps_between ? steps_between - next : 0;
}

/* Where it counts it has to be that of here. It costs as much as five right-hand sides; where it hardly changes, as in a
 * chain whose last rods move by 1e-9 rad/s, some steps may pass. One that is large for a moment is seen to have changed. */
void roundoff_renew(struct run *run)
{
    const unsigned long most_between = 8;
    if (run->options.step > 0) return; /* nothing chooses by it */
    run->roundoff.since++;
    bool due = (run->model->tree && run->roundoff.since >= steps_between) || has_grown(run);
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

/* ---- where it stands */

static size_t links_of(const struct fbd_model *model)
{
    return model->tree ? (size_t)model->tree->count : 0;
}

size_t roundoff_size(const struct fbd_model *model)
{
    return 4 * plan_rates(&model->plan) + 3 * links_of(model) + 2 * model->body_count +
           plan_size(&model->plan);
}

static bool names_time(const struct formula *formula)
{
    return formula->expr && expr_uses_time(formula->expr);
}

/* Does the time name a force, or the rate of a state? */
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
    roundoff->cancelled = roundoff->turned + 3 * links_of(run->model);
    roundoff->nothing = roundoff->cancelled + 2 * run->model->body_count;
    roundoff->heeds_time = heeds_time(run->model);
}
