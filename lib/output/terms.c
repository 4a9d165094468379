/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/terms.h"

#include <stdio.h>

#include "base/format.h"
#include "dynamics/diagram.h"
#include "output/laws.h"

/* True if a one-sided surface would have a tensile normal force above round-off level of the weight. */
static bool normal_is_lost(const struct fbd_state *state, const struct model_body *body)
{
    double slack = 1e-12 * body->inertia.mass * vec_norm(state->model->scene->gravity);
    for (int i = body->first_load; i < body->first_load + body->load_count; i++) {
        const struct load *load = state->model->loads[i].source;
        if (load->kind == load_normal && !load->two_sided) return -state->slots[body->normal_slot] < -slack;
    }
    return false;
}

/* Write the value of a normal force or friction. */
static void normal_remark(const struct fbd_state *state, const struct model_body *body, char *remark)
{
    if (body->normal_slot >= 0)
        format_into(remark, term_remark_size, "acts across: N = %.9g%s", -state->slots[body->normal_slot],
                    normal_is_lost(state, body) ? " (contact is lost: it would have to pull)" : "");
    else
        snprintf(remark, term_remark_size, "acts across the guide");
}

static const char *friction_limit(const struct mode *mode, bool kinetic)
{
    if (mode->normal_slot < 0) return kinetic ? "M_k" : "M_s";
    if (mode->moment) return "mu r R";
    if (mode->two_sided) return kinetic ? "mu_k |N|" : "mu_s |N|";
    return kinetic ? "mu_k N" : "mu_s N";
}

/* Write the slip velocity if the law depends on it. */
static void slip_remark(const struct fbd_state *state, int pair, char *remark)
{
    const struct fbd_model *model = state->model;
    const char *law = friction_limit(&model->plan.modes[pair], true),
               *sign = state->slip[pair] > 0 ? "-" : "+";
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
    bool kinetic = now.limit_kinetic > now.limit_static; /* warned of by the reader */
    if (state->slip[body->friction] == stick)
        format_into(remark, term_remark_size, "sticks: the force of equilibrium, up to %s = %.9g",
                    friction_limit(&state->model->plan.modes[body->friction], kinetic), now.limit);
    else
        slip_remark(state, body->friction, remark);
}

/* ---- the remark */

/* Words for gravity where its law has no symbols, or is zero. */
static const char *gravity_words(const struct model_body *body, int part)
{
    const bool on_ground = body->parent == ground_body;
    if (body->joint->has_axis) return "through the axis";
    if (body->joint->path == path_curve) return "m g along the track";
    if (body->joint->path == path_line) return on_ground ? "acts across" : "m g along x";
    return part < 2 && !on_ground ? "m g along the axis" : "";
}

static const char *listed_words(const struct model_load *load, const struct model_body *body, int part)
{
    const struct load *source = load->source;
    if (source->kind == load_gravity) return gravity_words(body, part);
    if (load->linked) return load_law(source)->between;
    if (source->kind == load_drag)
        return load_has_wind(source) ? "drag at its point, in the wind" : "drag at its point";
    return "";
}

static void listed_remark(struct fbd_state *state, const struct equation *equation, size_t term,
                          char remark[static term_remark_size])
{
    const struct fbd_model *model = state->model;
    const struct model_load *load = &model->loads[equation->loads[term]];
    const struct model_body *body = &model->bodies[equation->body];
    switch (load->source->kind) {
    case load_normal: normal_remark(state, body, remark); return;
    case moment_friction:
        if (!coordinate_is_angle(body, equation->part)) return;
        friction_remark(state, equation->body, remark);
        return;
    case load_friction: friction_remark(state, equation->body, remark); return;
    default: break;
    }
    if (load->source->toward)
        format_into(remark, term_remark_size, "toward %s", load->source->toward);
    else if (!remark[0])
        format_into(remark, term_remark_size, "%s", listed_words(load, body, equation->part));
}

static bool write_law(const struct fbd_model *model, const struct equation *equation, size_t term,
                      char remark[static term_remark_size])
{
    static const struct law_names names = {"m", "along", "L"};
    struct text law = {0};
    law_write(&law, model, equation, term, &names);
    const bool written = !law.failed;
    if (written && law.data) format_into(remark, term_remark_size, "%s", law.data);
    text_free(&law);
    return written;
}

bool equation_remark(struct fbd_state *state, const struct equation *equation, size_t term,
                     char remark[static term_remark_size])
{
    const struct fbd_model *model = state->model;
    int index = equation->loads[term];
    remark[0] = '\0';
    if (equation->cut_free) return true;
    if (!write_law(model, equation, term, remark)) return false;
    if (index < 0) return true;
    if (body_lists(model, equation->body, index))
        listed_remark(state, equation, term, remark);
    else if (index >= (int)model->listed_count && model->loads[index].linked)
        format_into(remark, term_remark_size, "%s", load_law(model->loads[index].source)->between);
    return true;
}

const char *term_mode(const struct fbd_state *state, int body)
{
    int pair = state->model->bodies[body].friction;
    if (pair < 0) return "";
    return state->slip[pair] == stick ? "sticks" : "slips";
}
