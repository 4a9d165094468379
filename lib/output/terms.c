/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/terms.h"

#include <stdio.h>

#include "base/format.h"
#include "dynamics/diagram.h"

/* A surface that is no guide cannot pull; less than the rounding of the weight is nothing. */
static bool normal_is_lost(const struct fbd_state *state, const struct model_body *body)
{
    double slack = 1e-12 * body->inertia.mass * vec_norm(state->model->scene->gravity);
    for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
        const struct load *load = state->model->loads[i].source;
        if (load->kind == load_normal && !load->two_sided) return -state->slots[body->normal_slot] < -slack;
    }
    return false;
}

/* A normal force and friction name the values that they stand for. */
static void normal_remark(const struct fbd_state *state, const struct model_body *body, char *remark)
{
    if (body->normal_slot >= 0)
        format_into(remark, term_remark_size, "acts across: N = %.9g%s", -state->slots[body->normal_slot],
                    normal_is_lost(state, body) ? " (contact is lost: it would have to pull)" : "");
    else
        snprintf(remark, term_remark_size, "acts across the guide");
}

/* The speed on the surface where the law goes with it. */
static void slip_remark(const struct fbd_state *state, int pair, char *remark)
{
    const struct fbd_model *model = state->model;
    bool bearing = model->plan.modes[pair].normal_slot < 0;
    const char *law = bearing ? "M_k" : "mu_k N", *sign = state->slip[pair] > 0 ? "-" : "+";
    const double *places = state->y + plan_size(&model->plan) + hand_slots;
    for (size_t k = 0; k < model->absolute_count; k++) {
        if (model->absolutes[k].kind != absolute_slip || model->absolutes[k].pair != pair) continue;
        format_into(remark, term_remark_size, "slips: %s%s at slip = %.9g", sign, law, places[k]);
        return;
    }
    snprintf(remark, term_remark_size, "slips: %s%s", sign, law);
}

static void friction_remark(struct fbd_state *state, int b, char *remark)
{
    const struct model_body *body = &state->model->bodies[b];
    struct instant at = state_instant(state);
    state_balance_of(state, b, state->scratch);
    struct friction_values now = friction_at(state->model, body->friction, &at, state->scratch);
    bool bearing = state->model->plan.modes[body->friction].normal_slot < 0;
    bool kinetic = now.limit_kinetic > now.limit_static; /* warned of by the reader */
    if (state->slip[body->friction] == stick)
        format_into(remark, term_remark_size, "sticks: whatever holds, up to %s_%c%s = %.9g",
                    bearing ? "M" : "mu", kinetic ? 'k' : 's', bearing ? "" : " N", now.limit);
    else
        slip_remark(state, body->friction, remark);
}

/* Gravity on a pivot whose zero angle hangs straight down is the m g L sin(theta) of every textbook. */
static const char *gravity_remark(const struct fbd_model *model, const struct model_body *body, int part)
{
    struct vec g = model->scene->gravity;
    const bool on_ground = body->parent == ground_body;
    if (g.x != 0) return "m g";
    switch (body->kind) {
    case motion_slide:
        if (!on_ground) return "m g along x";
        return body->e.y == 0 ? "acts across" : body->e.x == 0 ? "m g" : "-m g sin(along)";
    case motion_pivot:
        if (body->L == 0) return "through the axis";
        if (!on_ground) return "r_OG x m g";
        if (body->arm.x == 0) return body->arm.y < 0 ? "-m g L sin(theta)" : "m g L sin(theta)";
        return body->arm.y == 0 && body->arm.x > 0 ? "-m g L cos(theta)" : "r_OG x m g";
    case motion_particle:
    case motion_planar:
    case motion_weld: break;
    case motion_track: return "m g along the track";
    }
    return part == 1 ? "-m g" : "";
}

static const char *plain_remark(const struct model_load *load, bool turns)
{
    const struct law *law = load_law(load->source);
    if (law->remark) return law->remark(load->source, load->linked, turns);
    return law->formula ? law->formula : "";
}

bool body_lists(const struct fbd_model *model, int body, int load)
{
    const struct model_body *b = &model->bodies[body];
    return load >= b->first_load && load < b->first_load + b->load_count;
}

static void listed_remark(struct fbd_state *state, int b, const struct model_load *load, int part,
                          char *remark)
{
    const struct fbd_model *model = state->model;
    const struct model_body *body = &model->bodies[b];
    switch (load->source->kind) {
    case load_normal: normal_remark(state, body, remark); return;
    case load_friction:
    case moment_friction: friction_remark(state, b, remark); return;
    case load_gravity: snprintf(remark, term_remark_size, "%s", gravity_remark(model, body, part)); return;
    default:
        if (load->source->toward)
            snprintf(remark, term_remark_size, "toward %s", load->source->toward);
        else
            snprintf(remark, term_remark_size, "%s",
                     plain_remark(load, body->kind == motion_pivot || body->kind == motion_planar));
    }
}

void equation_remark(struct fbd_state *state, const struct equation *equation, size_t term,
                     char remark[static term_remark_size])
{
    const struct fbd_model *model = state->model;
    int index = equation->loads[term];
    remark[0] = '\0';
    if (equation->cut_free || index < 0) return;
    if (body_lists(model, equation->body, index))
        listed_remark(state, equation->body, &model->loads[index], equation->part, remark);
    else if (index >= (int)model->listed_count)
        snprintf(remark, term_remark_size, "%s", plain_remark(&model->loads[index], true));
}

const char *term_mode(const struct fbd_state *state, int body)
{
    int pair = state->model->bodies[body].friction;
    if (pair < 0) return "";
    return state->slip[pair] == stick ? "sticks" : "slips";
}
