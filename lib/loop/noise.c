/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <float.h>
#include <gsl/gsl_errno.h>
#include <limits.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/own.h"
#include "dynamics/tree_bare.h"
#include "dynamics/tree_system.h"
#include "loop/run.h"

/* How much the links from the ground to each have turned in all: an angle in the world is their sum, and has
 * its rounding. A force between two links has the larger one: `turned` has room for all links twice. */
static void measure_turns(struct run *run, const struct instant *at)
{
    const struct tree *tree = run->model->tree;
    double *own = run->grain.turned, *sides = own + tree->count;
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
    for (int i = 1; i < tree->count; i++) {
        double *parent = &sides[tree->links[i].parent];
        *parent = fmax(*parent, own[i]);
    }
    for (int j = 0; j < tree->row_count; j++) {
        if (!tree_takes_part(tree, at, j)) continue;
        const struct row *row = &at->tree->rows[j];
        double most = 0;
        for (int k = 0; k < row->port_count; k++)
            if (port_turns(&row->ports[k])) most = fmax(most, own[row->ports[k].link]);
        for (int k = 0; k < row->port_count; k++) {
            double *side = &sides[row->ports[k].link];
            *side = fmax(*side, most);
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
    double *cancelled = run->grain.cancelled + 2 * (size_t)body;
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
    memset(run->grain.cancelled, 0, 2 * run->model->body_count * sizeof *run->grain.cancelled);
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
                        const struct arrow *arrow, double *gross)
{
    struct vec f = arrow->force, arm = vec_sub(arrow->point, link->p);
    double size = vec_norm(f), moment = fabs(arm.x * f.y) + fabs(arm.y * f.x) + fabs(arrow->couple);
    moment += angle * size * vec_norm(arm);
    double along = fabs(link->e.x * f.x) + fabs(link->e.y * f.y) + angle * size;
    double across = fabs(link->e.x * f.y) + fabs(link->e.y * f.x) + angle * size;
    if (body->count > 0) gross[0] += body->kind == motion_pivot ? moment : along;
    if (body->count > 1) gross[1] += across;
    if (body->count > 2) gross[2] += moment;
}

static bool turns(const struct model_body *body, int k)
{
    return body->kind == motion_pivot || k == 2;
}

/* Add the sizes of what acts along each coordinate of a body. */
static void add_gross_forces(struct run *run, int b, const struct instant *at, double *gross)
{
    const struct model_body *body = &run->model->bodies[b];
    int link = body->place.link;
    size_t count = (link > 0 ? diagram_list : diagram_fill)(run->model, b, at, run->state->a,
                                                            run->state->slots, run->work.arrows);
    const struct tree *tree = run->model->tree;
    double angle = tree && link > 0 ? run->grain.turned[tree->count + link] : 0;
    for (size_t i = 0; i < count; i++) {
        if (link > 0)
            add_jointed(body, &at->tree->links[link], angle, &run->work.arrows[i], gross);
        else
            for (int k = 0; k < body->count; k++) gross[k] += fabs(run->work.arrows[i].share[k]);
    }
    const double share = 1.0 / 64;
    for (int k = 0; k < body->count; k++) gross[k] += share * run->grain.cancelled[2 * b + turns(body, k)];
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

/* How fast the accelerations change: along the motion, or by the time alone, which is what its rounding does
 * to them: where no force names it, and nothing is prescribed, nothing, as steps have the size that they say.
 * `along` has plan_rates entries: the rates of states change likewise. */
static void changes(struct run *run, const struct instant *at, bool by_time, double *along)
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
    if (plan->own > 0) own_rates_along(run->model, at, &flow, along + plan->n);
}

/* ---- how large what starts from zero becomes */

/* The acceleration of coordinate i (or the rate of a state) as it is, or as it becomes in a short time: drives start without
 * one. */
static double starting(const struct run *run, size_t i, double tau)
{
    double a = run->state->a[i], later = tau * run->grain.along[i];
    return isfinite(later) && fabs(later) > fabs(a) ? later : a;
}

static void vary(struct run *run, const struct instant *at, const double *dy, double *along)
{
    struct scratch scratch = state_scratch(run->state);
    const struct direction direction = {0, dy};
    accelerations_along(run->model, at, &direction, scratch.slots, scratch.slots_along, along);
    if (run->model->plan.own > 0) own_rates_along(run->model, at, &direction, along + run->model->plan.n);
}

/* How long each acceleration, and rate of a state, goes on as it starts: for less than the time that is given where something
 * ends it before. */

/* Accelerations, and rates of states, at another instant or place; false where there are none. */
static bool accelerations_there(const struct run *run, double t, const double *y, double *f)
{
    const gsl_odeiv2_system *system = &run->system.inner;
    return system->function(t, y, f, system->params) == GSL_SUCCESS;
}

/* Forces fade, or turn round by themselves: one of 1 kN that falls with (t + 1 us)^-2 moves 1 kg by 1e-3 m/s, and not by
 * 100 m/s in a tenth of a second. `along` is by the time alone. */
static void end_with_forces(struct run *run, double tau, double *times)
{
    const double most = 0.75;
    const size_t n = (size_t)run->model->plan.n, rates = (size_t)plan_rates(&run->model->plan);
    double *f = run->work.sample;
    double t = tau;
    bool ends = !tree_is_bare(run->model);
    while (ends && run->state->t + t > run->state->t) {
        ends = false;
        bool known = accelerations_there(run, run->state->t + t, run->state->y, f);
        for (size_t i = 0; i < rates; i++) {
            double a = starting(run, i, t);
            if (times[i] < t || a == 0 || (known && fabs(f[n + i] - a) <= most * fabs(a))) continue;
            times[i] = t / 2;
            ends = true;
        }
        t /= 2;
    }
}

/* Springs and dampers turn it round as soon as what it makes of places and speeds changes it by no less than itself: a
 * spring of 3e8 N/m whose end is moved by 0.4 m/s would have a block of 0.2 kg at 10 km/s in 4 ms. */
static void end_with_springs(struct run *run, const struct instant *at, double *times)
{
    const struct plan *plan = &run->model->plan;
    const size_t n = (size_t)plan->n, size = plan_size(plan), rates = (size_t)plan_rates(plan);
    double *dy = run->work.sample, *by_place = run->work.aside, *by_speed = by_place + size;
    memset(dy, 0, size * sizeof *dy);
    for (size_t i = 0; i < n; i++)
        dy[i] = times[i] * (run->state->y[n + i] + times[i] * starting(run, i, times[i]));
    vary(run, at, dy, by_place);
    memset(dy, 0, n * sizeof *dy);
    for (size_t i = 0; i < rates; i++) dy[n + i] = times[i] * starting(run, i, times[i]);
    vary(run, at, dy, by_speed);
    for (size_t i = 0; i < rates; i++) {
        double a = fabs(starting(run, i, times[i])), springs = sqrt(fabs(by_place[i]) / a),
               dampers = fabs(by_speed[i]) / a;
        double share = fmax(isfinite(springs) ? springs : 0, isfinite(dampers) ? dampers : 0);
        times[i] /= fmax(1, share);
    }
}

/* What starts to move as far and as fast as it does in these times. */
static void set_off(const struct run *run, const double *times, double *y)
{
    const size_t n = (size_t)run->model->plan.n, rates = (size_t)plan_rates(&run->model->plan);
    memcpy(y, run->state->y, plan_size(&run->model->plan) * sizeof *y);
    for (size_t i = 0; i < rates; i++) {
        double tau = times[i], gain = tau * starting(run, i, tau);
        if (i < n) y[i] += tau * (y[n + i] + gain);
        y[n + i] += gain;
    }
}

/* That was the answer of straight lines. A spring that stiffens, or drag by the square of the speed, is not there yet where
 * it starts: halved until accelerations change by no more than twice themselves. */
static void end_with_bends(struct run *run, double *times)
{
    enum { most_halvings = 60 };
    const double most = 2;
    const size_t n = (size_t)run->model->plan.n, rates = (size_t)plan_rates(&run->model->plan);
    double *y = run->work.aside, *f = run->work.sample;
    bool bent = true;
    for (int halving = 0; bent && halving < most_halvings; halving++) {
        bent = false;
        set_off(run, times, y);
        bool known = accelerations_there(run, run->state->t, y, f);
        for (size_t i = 0; i < rates; i++) {
            double a = starting(run, i, times[i]);
            if (a == 0 || (known && fabs(f[n + i] - a) <= most * fabs(a))) continue;
            times[i] /= 2;
            bent = true;
        }
    }
}

/* What a coordinate and its rate become in a short time, and the arm that makes a length of an angle: of a body
 * that turns, the radius of gyration. */
struct motion_size {
    double place, rate, arm;
};

static struct motion_size motion_size(const struct run *run, const struct model_body *body, int k,
                                      const double *times)
{
    int i = body->first + k;
    double tau = times[i], v = fabs(run->state->y[i + run->model->plan.n]),
           a = fabs(starting(run, (size_t)i, tau));
    double arm = turns(body, k) ? 1 / sqrt(run->model->plan.inverse_inertia[i] * body->inertia.mass) : 1;
    return (struct motion_size){v * tau + a * tau * tau, fmax(v, a * tau), arm};
}

/* The largest of all, as lengths and speeds: by what moves, or by what starts to where nothing moves yet, for near
 * singular positions accelerations are far beyond what comes of them. */
static struct motion_size largest_motion(const struct run *run, const double *times)
{
    const int n = run->model->plan.n;
    struct motion_size all = {.arm = 1};
    bool moves = false;
    for (int i = 0; i < n; i++) moves |= run->state->y[n + i] != 0;
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        for (int k = 0; k < body->count; k++) {
            struct motion_size one = motion_size(run, body, k, times);
            double tau = times[body->first + k];
            double v = fabs(run->state->y[n + body->first + k]);
            if (!isfinite(one.arm)) continue;
            if (moves) one.place = v * tau, one.rate = v;
            if (!moves && !(one.rate > tau * run->grain.accelerations[body->first + k]))
                continue; /* it rests */
            all.place = fmax(all.place, one.place * one.arm);
            all.rate = fmax(all.rate, one.rate * one.arm);
        }
    }
    return all;
}

/* Couplings bring states back to rounding of a radian, or of the scene: an error that is allowed of this is that. */
static double unseen_place(const struct run *run, const struct model_body *body, int k)
{
    double reach = 0;
    for (int i = 1; i < run->model->tree->count; i++)
        reach = fmax(reach, vec_norm(run->state->tree->links[i].p));
    return DBL_EPSILON / run->options.tolerance * (turns(body, k) ? 1 : reach);
}

/* A coordinate or rate that is exactly zero has no size that an error could be compared with, and a method of
 * low order needs one (Euler's first step from rest errs by all that the body moves). What the acceleration
 * does in a thousandth of the run is small, and enough; of the time for which it lasts (end_with_forces and what
 * follows it), for a force that is switched on may be large and short, and a stiff spring turns it round. The last of a row
 * of blocks on springs that is pulled at its other end starts as a high power of the time, or by rounding, which no step follows to a share of itself: what is a
 * billionth of the largest motion has that for its size. */
static void set_floors(struct run *run, double tau, const double *times)
{
    const struct tree *tree = run->model->tree;
    /* Bodies that touch rest or part by roundings of their gaps: each keeps its own size. */
    const double negligible = tree && tree->meeting_count > 0 ? 0 : 1e-9;
    struct motion_size all = largest_motion(run, times);
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        for (int k = 0; k < body->count; k++) {
            size_t position = (size_t)body->first + (size_t)k, rate = position + (size_t)run->model->plan.n;
            struct motion_size own = motion_size(run, body, k, times);
            bool sized = own.arm > 0 && isfinite(own.arm); /* what is driven need have no mass */
            double place = sized ? negligible * all.place / own.arm : 0;
            double speed = sized ? negligible * all.rate / own.arm : 0;
            run->grain.nothing[position] = fmax(run->grain.nothing[position], place);
            run->grain.nothing[rate] = fmax(run->grain.nothing[rate], speed);
            if (run->state->y[position] == 0) place = fmax(place, own.place);
            if (run->state->y[rate] == 0) speed = fmax(speed, own.rate);
            if (tree && tree->row_count > 0 && tree->meeting_count == 0 && place == 0 && speed == 0 &&
                run->state->y[position] == 0) {
                place = unseen_place(run, body, k); /* held by a coupling, before anything acts */
                speed = place / tau;
            }
            switcher_set_floor(run->stepper, position, place);
            switcher_set_floor(run->stepper, rate, speed);
        }
    }
}

/* Is there a number that is zero, or rounding beside the largest? */
static bool any_is_small(const struct run *run)
{
    const int n = run->model->plan.n;
    double most = 0, least = INFINITY;
    for (int i = 0; i < 2 * n; i++) {
        most = fmax(most, fabs(run->state->y[i]));
        least = fmin(least, fabs(run->state->y[i]));
    }
    return n > 0 && least <= DBL_EPSILON * most;
}

/* Likewise a state that starts from zero. */
static void set_own_floor(struct run *run, int i, const double *times)
{
    const struct plan *plan = &run->model->plan;
    size_t state = 2 * (size_t)plan->n + (size_t)i, rate = (size_t)plan->n + (size_t)i;
    double tau = times[rate], change = fabs(run->grain.along[rate]);
    if (run->state->y[state] != 0) return;
    switcher_set_floor(run->stepper, state,
                       tau * fabs(run->state->a[rate]) + (isfinite(change) ? tau * tau * change : 0));
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

static void set_noise(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    struct instant here = state_instant(run->state);
    const struct instant *at = &here;
    changes(run, at, true, run->grain.along);
    if (run->model->tree) measure_turns(run, at);
    measure_cancelled(run, at);
    const double roundings[] = {roundings_of(run->model, false), roundings_of(run->model, true)};
    for (size_t b = 0; b < run->model->body_count; b++) {
        const struct model_body *body = &run->model->bodies[b];
        double gross[most_coordinates_of_a_body] = {0};
        add_gross_forces(run, (int)b, at, gross);
        for (int k = 0; k < body->count; k++) {
            int i = body->first + k;
            double of_time = fabs(at->t * run->grain.along[i]),
                   of_sum = roundings[body->place.link > 0] * gross[k] * plan->inverse_inertia[i];
            double noise = DBL_EPSILON * (of_sum + of_time);
            run->grain.accelerations[i] = isfinite(noise) ? noise : 0;
            switcher_set_noise(run->stepper, (size_t)i, run->grain.accelerations[i]);
        }
    }
}

void run_set_noise(struct run *run)
{
    const struct plan *plan = &run->model->plan;
    set_noise(run);
    run->grain.since = 0;
    run->grain.pause = 1;
    bool coordinates = any_is_small(run), own = false;
    for (int i = 2 * plan->n; i < (int)plan_size(plan); i++) own |= run->state->y[i] == 0;
    if (!coordinates && !own) return;
    const double share = 1e-3, tau = share * run_time_to_switch(run);
    double *times = run->work.kept;
    for (size_t i = 0; i < plan_rates(plan); i++) times[i] = tau;
    end_with_forces(run, tau, times); /* `along` is that of set_noise */
    struct instant at = state_instant(run->state);
    changes(run, &at, false, run->grain.along);
    end_with_springs(run, &at, times);
    end_with_bends(run, times);
    if (coordinates) set_floors(run, tau, times);
    for (int i = 0; i < plan->own; i++) set_own_floor(run, i, times);
}

/* Have accelerations about the noise that they had before? */
static bool is_steady(const struct run *run, const double *before)
{
    const double most = 2;
    for (int i = 0; i < run->model->plan.n; i++) {
        double now = run->grain.accelerations[i];
        if (now > most * before[i] || before[i] > most * now) return false;
    }
    return true;
}

/* Steps after which it is looked at, in trees: it costs a hundredth of them. */
static const unsigned long steps_between = 64;

unsigned long run_steps_to_noise(const struct run *run)
{
    const unsigned long next = run->grain.since + 1;
    if (!run->model->tree) return ULONG_MAX;
    return next < steps_between ? steps_between - next : 0;
}

/* Where it counts it has to be that of here. It costs as much as five right-hand sides; where it hardly changes, as in a
 * chain whose last rods move by 1e-9 rad/s, some steps may pass. One that is large for a moment is seen to have changed. */
void run_renew_noise(struct run *run)
{
    const unsigned long most_between = 8;
    if (run->options.step > 0) return; /* nothing chooses by it */
    run->grain.since++;
    bool due = run->model->tree && run->grain.since >= steps_between;
    bool counts = run->grain.since >= run->grain.pause && switcher_noise_counts(run->stepper, run->step.h);
    if (!due && !counts) return;
    double *before = run->work.aside;
    memcpy(before, run->grain.accelerations, (size_t)run->model->plan.n * sizeof *before);
    run_evaluate(run);
    set_noise(run);
    run->grain.since = 0;
    run->grain.pause = !is_steady(run, before)               ? 1
                       : 2 * run->grain.pause < most_between ? 2 * run->grain.pause
                                                             : most_between;
}
