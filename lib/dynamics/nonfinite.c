/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/nonfinite.h"

#include <stdarg.h>
#include <stdio.h>

#include "dynamics/diagram.h"
#include "dynamics/energy.h"
#include "dynamics/friction.h"
#include "dynamics/kinematics.h"
#include "dynamics/tree.h"

const char *nonfinite_reason(double value)
{
    return isnan(value) ? "an expression leaves its domain there (a root or logarithm of a negative number, "
                          "0/0, beyond the end of a table, thresholds of `hysteresis` that cross)"
                        : "it is beyond the largest number (a division by zero, or an overflow)";
}

bool nonfinite_note(struct nonfinite *found, double value, struct pos at, const char *format, ...)
{
    if (isfinite(value)) return false;
    va_list args;
    va_start(args, format);
    /* NOLINTNEXTLINE(clang-analyzer-valist.Uninitialized): initialized a line above */
    vsnprintf(found->what, sizeof found->what, format, args);
    va_end(args);
    found->value = value;
    found->at = at;
    return true;
}

static bool note_coordinates(const struct fbd_state *state, struct nonfinite *found)
{
    const struct fbd_model *model = state->model;
    for (int i = 0; i < 2 * model->plan.n; i++) {
        const struct coordinate *c = &model->scene->coordinates[i % model->plan.n];
        const struct model_body *body = &model->bodies[c->body];
        const char *name = i < model->plan.n ? c->name : c->rate_name;
        if (nonfinite_note(found, state->y[i], body->source->at, "`%s.%s`", body->name, name)) return true;
    }
    return false;
}

static bool note_own(const struct fbd_state *state, struct nonfinite *found)
{
    const struct fbd_model *model = state->model;
    const int n = model->plan.n;
    for (int i = 0; i < model->plan.own; i++) {
        const struct own_state *own = &model->scene->own[i];
        if (nonfinite_note(found, state->y[2 * n + i], own->at, "the state `%s`", own->name) ||
            nonfinite_note(found, state->a[n + i], own->rate.at, "the rate of the state `%s`", own->name))
            return true;
    }
    return false;
}

static bool note_accelerations(const struct fbd_state *state, struct nonfinite *found)
{
    const struct fbd_model *model = state->model;
    for (int i = 0; i < model->plan.n; i++) {
        const struct coordinate *c = &model->scene->coordinates[i];
        const struct model_body *body = &model->bodies[c->body];
        if (nonfinite_note(found, state->a[i], body->source->at, "the acceleration along `%s.%s`", body->name,
                           c->name))
            return true;
    }
    return false;
}

static struct pos place_of(const struct fbd_model *model, const struct model_body *body,
                           const struct arrow *arrow)
{
    return arrow->load >= 0 ? model->loads[arrow->load].source->at : body->source->at;
}

static bool note_arrow(const struct fbd_model *model, const struct model_body *body,
                       const struct arrow *arrow, struct vec G, struct nonfinite *found)
{
    struct pos at = place_of(model, body, arrow);
    const char *on = body->name, *name = arrow->name;
    const double force[] = {arrow->force.x, arrow->force.y};
    const double moments[] = {arrow->couple, arrow_moment(arrow, G)};
    double sum = force[0] + force[1] + moments[0] + moments[1] + arrow->power;
    for (int k = 0; k < body->count; k++) sum += arrow->share[k];
    if (isfinite(sum)) return false; /* the usual case: then all are finite */
    const char *toward = arrow->load >= 0 ? model->loads[arrow->load].source->toward : NULL;
    if (toward && nonfinite_note(found, force[0], at,
                                 "the force `%s` on `%s`, which has no direction where "
                                 "it acts at the point that it is directed to (%s),",
                                 name, on, toward))
        return true;
    const char *singular = arrow->load >= 0 ? load_law(model->loads[arrow->load].source)->singular : NULL;
    if (singular && (nonfinite_note(found, force[0], at, "`%s` on `%s`, %s,", name, on, singular) ||
                     nonfinite_note(found, moments[0], at, "`%s` on `%s`, %s,", name, on, singular)))
        return true;
    for (int k = 0; k < 2; k++)
        if (nonfinite_note(found, force[k], at, "the force `%s` on `%s`", name, on)) return true;
    for (int k = 0; k < 2; k++)
        if (nonfinite_note(found, moments[k], at, "the moment of `%s` on `%s`", name, on)) return true;
    for (int k = 0; k < body->count; k++)
        if (nonfinite_note(found, arrow->share[k], at, "the share of `%s` in the motion of `%s`", name, on))
            return true;
    return nonfinite_note(found, arrow->power, at, "the power of `%s` on `%s`", name, on);
}

/* Applied forces, reactions, or both. */
enum which_arrows { given_arrows, reaction_arrows, all_arrows };

static bool note_arrows(const struct fbd_state *state, enum which_arrows which, struct nonfinite *found)
{
    const struct fbd_model *model = state->model;
    struct arrow *arrows = state->arrows;
    struct instant at = state_instant(state);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        struct pose pose = body_pose(body, &at);
        struct vec G = point_motion(body, &pose, body->inertia.G).p;
        size_t count = diagram_fill(model, (int)b, &at, state->slots, arrows);
        for (size_t i = 0; i < count; i++)
            if ((which == all_arrows || arrow_is_reaction(model, &arrows[i]) == (which == reaction_arrows)) &&
                note_arrow(model, body, &arrows[i], G, found))
                return true;
    }
    return false;
}

static bool note_energies(const struct fbd_state *state, struct nonfinite *found)
{
    const struct fbd_model *model = state->model;
    struct instant at = state_instant(state);
    for (size_t b = 0; b < model->body_count; b++) {
        const struct model_body *body = &model->bodies[b];
        if (nonfinite_note(found, kinetic_energy(body, &at), body->source->at, "the kinetic energy of `%s`",
                           body->name))
            return true;
    }
    for (size_t i = 0; i < model->load_count; i++) {
        const struct model_load *load = &model->loads[i];
        if (load->potential_kind == potential_none || load->potential_kind == potential_quadrature) continue;
        double V = potential_energy(model, load, &at, NULL);
        if (nonfinite_note(found, V, load->source->at, "the potential energy of `%s` on `%s`",
                           load->source->name, model->bodies[load->body].name))
            return true;
    }
    return false;
}

/* A friction force may be finite while its limit, which is also output, is not. */
static bool note_limits(const struct fbd_state *state, struct nonfinite *found)
{
    const struct fbd_model *model = state->model;
    const struct instant at = state_instant(state);
    for (size_t i = 0; i < model->plan.mode_count; i++) {
        const struct mode *mode = &model->plan.modes[i];
        if (!mode_is_friction(mode)) continue;
        const struct friction_values values = friction_at(model, (int)i, &at, state->slots);
        const struct load *source = model->loads[mode->load].source;
        const double limits[] = {values.limit_static, values.limit_kinetic};
        for (int k = 0; k < 2; k++)
            if (nonfinite_note(found, limits[k], source->at, "the %s limit of `%s` on `%s`",
                               k == 0 ? "static" : "kinetic", source->name, model->bodies[mode->body].name))
                return true;
    }
    return false;
}

bool state_is_unresisted(const struct fbd_state *state, struct unresisted *motion)
{
    const struct fbd_model *model = state->model;
    const struct tree_massless *of = state->tree->unmoved;
    if (!of) return false;
    const struct tree_link *link = &model->tree->links[of->link];
    const struct model_body *body = &model->bodies[link->body];
    snprintf(motion->text, sizeof motion->text, "no inertia resists the motion along `%s.%s`", body->name,
             model->scene->coordinates[link->coordinate + of->local].name);
    motion->at = body->source->at;
    return true;
}

bool nonfinite_find(const struct fbd_state *state, struct nonfinite *found)
{
    struct nonfinite unused; /* all are finite usually, and no order is needed */
    bool fine = !note_arrows(state, all_arrows, &unused);
    return note_coordinates(state, found) || note_own(state, found) ||
           (!fine && note_arrows(state, given_arrows, found)) || note_accelerations(state, found) ||
           (!fine && note_arrows(state, reaction_arrows, found)) || note_limits(state, found) ||
           note_energies(state, found);
}
