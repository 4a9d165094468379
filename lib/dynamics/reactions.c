/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/reactions.h"

#include "dynamics/diagram.h"
#include "dynamics/tree_system.h"

/* A number with its rate along the motion; a force likewise. */
struct rated {
    double x, rate;
};

struct rated_force {
    struct vec f, rate;
};

struct view {
    const struct fbd_model *model;
    const struct instant *at;
    const struct direction *along; /* or NULL: values alone */
    const double *slots, *slots_along;
};

/* ---- couplings */

/* The multiplier of row k of a coupling. That of friction which slips is a multiple of the one before. */
static struct rated multiplier(const struct view *view, const struct coupling *coupling, int k)
{
    const struct tree_work *work = view->at->tree;
    const int first = coupling->first_row, normal = coupling->normal_row;
    const int index = (int)(coupling - view->model->tree->couplings);
    struct rated lambda = {work->rows[first + k].lambda, view->along ? work->z[first + k] : 0};
    const double share =
        first + k == coupling->along_row ? tree_rubbing_share(view->model, view->at, index) : 0;
    if (share == 0 || !view->along) return lambda;
    double d_mu;
    const struct mode *mode = &view->model->plan.modes[coupling->pair];
    friction_coefficient(view->model, coupling->pair, &mode->mu_k, view->at, view->along, &d_mu);
    const double d_share = -view->at->slip[coupling->pair] * view->at->pull[coupling->pair] * d_mu;
    lambda.rate = share * work->z[normal] + d_share * work->rows[normal].lambda;
    return lambda;
}

/* The force of row k on a body. */
static struct rated_force row_force(const struct view *view, const struct coupling *coupling, int k, int body)
{
    const struct row *row = &view->at->tree->rows[coupling->first_row + k];
    const struct rated lambda = multiplier(view, coupling, k);
    struct rated_force sum = {{0, 0}, {0, 0}};
    for (int i = 0; i < row->port_count; i++) {
        const struct port *port = &row->ports[i];
        if (coupling->end[port->end].body != body) continue;
        sum.f = vec_add(sum.f, vec_scale(lambda.x, port->force));
        sum.rate = vec_add(sum.rate, vec_scale(lambda.rate, port->force));
        if (view->along) sum.rate = vec_add(sum.rate, vec_scale(lambda.x, port->d_force));
    }
    return sum;
}

static bool acts(const struct view *view, int coupling)
{
    const struct coupling *of = &view->model->tree->couplings[coupling];
    if (coupling_is_gone(view->at->tree, of)) return false;
    return of->kind != constraint_contact || view->at->slip[of->surface] == stick;
}

static struct rated_force force_of_couplings(const struct view *view, const struct model_absolute *reaction)
{
    struct rated_force sum = {{0, 0}, {0, 0}};
    for (int i = reaction->couplings.first; i < range_end(reaction->couplings); i++) {
        const struct coupling *coupling = &view->model->tree->couplings[i];
        const int count = coupling->row_count - coupling_has_couple(coupling);
        for (int k = 0; acts(view, i) && k < count; k++) {
            const struct rated_force one = row_force(view, coupling, k, reaction->body);
            sum.f = vec_add(sum.f, one.f);
            sum.rate = vec_add(sum.rate, one.rate);
        }
    }
    return sum;
}

/* The sense of friction: +1 where a multiplier above zero pushes end 0 to the left of the outward normal. */
static double sense_of_friction(const struct view *view, const struct coupling *coupling)
{
    const struct row *rows = &view->at->tree->rows[coupling->first_row];
    for (int i = 0; i < rows[0].port_count; i++)
        for (int k = 0; k < rows[1].port_count; k++)
            if (rows[0].ports[i].end == 0 && rows[1].ports[k].end == 0)
                return vec_cross(rows[0].ports[i].force, rows[1].ports[k].force) < 0 ? -1 : 1;
    return 1;
}

static struct rated size_of_couplings(const struct view *view, const struct model_absolute *reaction)
{
    struct rated sum = {0, 0};
    bool first = true;
    for (int i = reaction->couplings.first; i < range_end(reaction->couplings); i++) {
        const struct coupling *coupling = &view->model->tree->couplings[i];
        if (!acts(view, i)) continue;
        const bool tension = reaction->part == reaction_tension, rubs = reaction->part == reaction_friction;
        const struct rated lambda = multiplier(view, coupling, rubs);
        const double sign = tension ? -1 : rubs ? sense_of_friction(view, coupling) : 1;
        const struct rated one = {sign * lambda.x, sign * lambda.rate};
        if (tension && (first || one.x > sum.x)) sum = one;
        if (!tension) sum = (struct rated){sum.x + one.x, sum.rate + one.rate};
        first = false;
    }
    return sum;
}

/* The size of the multiplier of row k times a factor. */
static struct rated size_of_row(const struct view *view, int index, int k, double factor)
{
    if (!acts(view, index)) return (struct rated){0, 0};
    const struct rated lambda = multiplier(view, &view->model->tree->couplings[index], k);
    const double sign = factor * lambda.x < 0 ? -factor : factor;
    return (struct rated){sign * lambda.x, sign * lambda.rate};
}

/* The size of the generalized force on the first coordinate of a ratio, or of the couple of a weld, whose row has
 * the angle times a length; the weld of a particle has none. */
static struct rated size_of_generalized(const struct view *view, int index)
{
    const struct coupling *coupling = &view->model->tree->couplings[index];
    if (coupling->kind == constraint_ratio)
        return size_of_row(view, index, 0, coupling->source->terms[0].factor);
    if (!coupling_has_couple(coupling)) return (struct rated){0, 0};
    return size_of_row(view, index, 2, coupling->end[0].radius);
}

/* ---- springs, dampers and actuators */

/* The other end of the load relative to its point: position, velocity and acceleration. */
static void ends_apart(const struct view *view, const struct model_load *load, struct vec d[3])
{
    const struct model_body *body = &view->model->bodies[load->body];
    const struct pose pose = body_pose(body, view->at);
    const struct motion_of_point here = point_motion(body, &pose, load->point),
                                 there = other_end(view->model, load, view->at);
    struct vec a = {0, 0};
    if (view->along && load->partner >= 0)
        a = tree_point_acceleration(&view->model->bodies[load->partner], there.p, view->at);
    if (view->along) a = vec_sub(a, tree_point_acceleration(body, here.p, view->at));
    d[0] = vec_sub(there.p, here.p);
    d[1] = vec_sub(there.v, here.v);
    d[2] = a;
}

/* k (l - l_0) + c l', or the given one of an actuator. */
static struct rated tension_of(const struct view *view, const struct model_load *load, double l, double rate,
                               double second)
{
    const double k = load->source->stiffness, c = load->source->coefficient;
    if (load->source->kind != load_actuator)
        return (struct rated){k * (l - load->source->free_length) + c * rate, k * rate + c * second};
    struct rated pull = {formula_value(&load->value, view->at), 0};
    if (view->along) formula_along(&load->value, view->at, view->along, &pull.rate);
    return pull;
}

/* l' = u . d', l'' = (d' . d' - l'^2) / l + u . d'' with u = d / l. */
static struct rated_force force_of_spring(const struct view *view, const struct model_load *load,
                                          struct rated *tension)
{
    struct vec d[3];
    ends_apart(view, load, d);
    const double l = vec_norm(d[0]);
    struct rated_force force = {{0, 0}, {0, 0}};
    *tension = (struct rated){0, 0};
    if (!(l > 0)) return force;
    const struct vec u = vec_scale(1 / l, d[0]);
    const double rate = vec_dot(u, d[1]), second = (vec_dot(d[1], d[1]) - rate * rate) / l + vec_dot(u, d[2]);
    *tension = tension_of(view, load, l, rate, second);
    const struct vec turn = vec_scale(1 / l, vec_sub(d[1], vec_scale(rate, u)));
    force.f = vec_scale(tension->x, u);
    force.rate = vec_add(vec_scale(tension->rate, u), vec_scale(tension->x, turn));
    return force;
}

/* The size of k (q - q_0) + c q' along or about the coordinate q of the body. */
static struct rated size_in_joint(const struct view *view, const struct model_load *load)
{
    const struct load *source = load->source;
    const struct model_body *body = &view->model->bodies[load->body];
    const bool about = source->kind == moment_spring || source->kind == moment_damper;
    const int k = about ? body->count - 1 : 0, q = body->first + k, v = body->first_rate + k;
    const double *y = view->at->y;
    const double f = source->stiffness * (y[q] - source->free_length) + source->coefficient * y[v],
                 sign = f < 0 ? -1 : 1;
    struct rated size = {sign * f, 0};
    if (view->along)
        size.rate =
            sign * (source->stiffness * view->along->dy[q] + source->coefficient * view->along->dy[v]);
    return size;
}

/* ---- joints */

static struct rated_force force_of_pin(const struct view *view, int body)
{
    const int link = view->model->bodies[body].place.link;
    struct rated_force force = {view->at->tree->links[link].F.force, {0, 0}};
    if (view->along) force.rate = view->at->tree->variation[link].F;
    return force;
}

/* Friction is positive against +x of the motion. */
static struct rated size_of_guide(const struct view *view, const struct model_absolute *reaction)
{
    const struct model_body *body = &view->model->bodies[reaction->body];
    if (reaction->part == reaction_normal) {
        const double rate = view->along ? -view->slots_along[body->normal_slot] : 0;
        return (struct rated){-view->slots[body->normal_slot], rate};
    }
    if (body->friction < 0) return (struct rated){0, 0};
    struct rated f = {-friction_at(view->model, body->friction, view->at, view->slots).force, 0};
    if (view->along)
        f.rate = -friction_along(view->model, body->friction, view->at, view->slots, view->along,
                                 view->slots_along)
                      .force;
    return f;
}

/* ---- all */

static struct rated part_of(const struct rated_force *force, enum reaction_part part)
{
    const double size = vec_norm(force->f);
    if (part == reaction_x) return (struct rated){force->f.x, force->rate.x};
    if (part == reaction_y) return (struct rated){force->f.y, force->rate.y};
    return (struct rated){size, size > 0 ? vec_dot(force->f, force->rate) / size : 0};
}

static struct rated value_of(const struct view *view, const struct model_absolute *reaction)
{
    const bool component = reaction->part <= reaction_force;
    struct rated_force force;
    if (reaction->couplings.count > 0) {
        const int first = reaction->couplings.first;
        if (view->model->tree->couplings[first].kind == constraint_ratio || reaction->part == reaction_moment)
            return size_of_generalized(view, first);
        if (!component) return size_of_couplings(view, reaction);
        force = force_of_couplings(view, reaction);
    } else if (reaction->load >= 0) {
        const struct model_load *load = &view->model->loads[reaction->load];
        struct rated tension;
        if (!is_there(view->at->tree, load->source->lifetime.number)) return (struct rated){0, 0};
        if (!load->linked) return size_in_joint(view, load);
        force = force_of_spring(view, load, &tension);
        if (!component) return tension;
    } else {
        if (!component) return size_of_guide(view, reaction);
        force = force_of_pin(view, reaction->body);
    }
    return part_of(&force, reaction->part);
}

static void write(const struct view *view, double *y, bool rates)
{
    const struct fbd_model *model = view->model;
    double *places = y + plan_size(&model->plan) + hand_slots;
    for (size_t k = 0; k < model->absolute_count; k++) {
        if (model->absolutes[k].kind != absolute_reaction) continue;
        const struct rated value = value_of(view, &model->absolutes[k]);
        places[k] = rates ? value.rate : value.x;
    }
}

void reactions_write(const struct fbd_model *model, const struct instant *at, const double *slots, double *y)
{
    const struct view view = {model, at, NULL, slots, NULL};
    write(&view, y, false);
}

void reactions_copy(const struct fbd_model *model, const double *y, double *to)
{
    const size_t first = plan_size(&model->plan) + hand_slots;
    for (size_t k = 0; k < model->absolute_count; k++)
        if (model->absolutes[k].kind == absolute_reaction) to[first + k] = y[first + k];
}

void reactions_write_along(const struct fbd_model *model, const struct instant *at,
                           const struct direction *along, const double *slots, const double *slots_along,
                           double *dy)
{
    const struct view view = {model, at, along, slots, slots_along};
    write(&view, dy, true);
}
