/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: states by name.
 */
#include <math.h>
#include <string.h>

#include "base/api_check.h"
#include "dynamics/mass.h"
#include "dynamics/modes.h"
#include "dynamics/project.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "output/display_units.h"
#include "rest/start.h"

fbd_state *fbd_state_new(const fbd_model *model)
{
    if (!model) return NULL;
    fbd_state *state = state_new(model);
    if (!state) return NULL;
    modes_settle(state, NULL);
    if (state->holds.found != holds_no_memory) return state;
    state_free(state);
    return NULL;
}

void fbd_state_free(fbd_state *state)
{
    state_free(state);
}

bool fbd_state_copy(fbd_state *to, const fbd_state *from)
{
    if (!to || !from || to->model != from->model) return false;
    if (to != from) state_copy(to, from);
    return true;
}

const fbd_model *fbd_state_model(const fbd_state *state)
{
    return state ? state->model : NULL;
}

/* The address of a named quantity, or NULL. */
static double *find(const fbd_state *state, const char *name)
{
    const struct scene *scene = state->model->scene;
    int index = model_find_component(state->model, name, false);
    if (index >= 0) return &state->y[index];
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (scene->parameters[i].call.held && strcmp(scene->parameters[i].name, name) == 0)
            return &state->held[i];
    return NULL;
}

bool fbd_state_set(fbd_state *state, const char *name, double value)
{
    if (!state || !name) return false;
    double *place = strcmp(name, "t") == 0 ? &state->t : find(state, name);
    if (!place || !isfinite(value)) return false;
    *place = value;
    state->settled = false;
    return true;
}

static struct symbol no_name(void *context, const char *name, struct pos at)
{
    (void)context;
    (void)name;
    (void)at;
    return (struct symbol){.kind = symbol_unknown};
}

static const struct expr *compile(struct arena *arena, const fbd_model *model, const char *text,
                                  const struct expr_want *want, fbd_errors *errors)
{
    const struct scope scope = {.lookup = no_name, .units = model->scene->units};
    return expr_compile(arena, text, (struct pos){0, 0}, &scope, want, errors);
}

static bool set_text(fbd_state *state, const char *name, const char *text, bool degrees, fbd_errors *errors)
{
    const fbd_model *model = state->model;
    int n = model->plan.n, index = model_find_component(model, name, true);
    diag_in_file(errors, model->scene->file);
    if (index < 0) {
        diag_add(errors, FBD_ERROR, "unknown-coordinate", (struct pos){0, 0},
                 n > 0 ? diag_hint(errors, "as `%s`", model->labels[0].name) : NULL,
                 "there is no coordinate%s `%s`", model->plan.own > 0 ? " and no state" : "", name);
        return false;
    }
    struct expr_want want = {.constant = true, .what = name};
    const struct display shown = display_of_component(model, (size_t)index, degrees);
    if (index < 2 * n) {
        const struct coordinate *c = &model->scene->coordinates[index % n];
        want.dim = index < n ? c->dim : c->rate_dim;
        want.angle = c->angle && index < n && !degrees;
    } else {
        want.dim = model->scene->own[index - 2 * n].dim;
    }
    struct arena arena = {0};
    const struct expr *expr = compile(&arena, model, text, &want, errors);
    if (expr) {
        state->y[index] = expr_value(expr) * (expr_is_bare(expr) ? shown.size : 1);
        state->settled = false;
    }
    arena_free(&arena);
    return expr != NULL;
}

static bool set_named(fbd_state *state, const char *name, const char *text, bool degrees, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    bool set = state && name && text ? set_text(state, name, text, degrees, errors)
                                     : api_refuse(errors, "there is no state, name or text") != NULL;
    diag_end(&call);
    return set;
}

bool fbd_state_set_text(fbd_state *state, const char *name, const char *text, fbd_errors *errors)
{
    return set_named(state, name, text, false, errors);
}

bool fbd_state_set_text_degrees(fbd_state *state, const char *name, const char *text, fbd_errors *errors)
{
    return set_named(state, name, text, true, errors);
}

bool fbd_model_quantity(const fbd_model *model, const char *name, const char *text, const char *unit,
                        double *value, fbd_errors *list)
{
    struct diag_call call;
    struct arena arena = {0};
    struct unit of;
    fbd_errors *errors = diag_begin(&call, list);
    const struct expr *expr = NULL;
    if (!model || !name || !text || !unit || !value)
        api_refuse(errors, "there is no model, name, text, unit or place for the value");
    else if (unit_parse(unit, strlen(unit), model->scene->units, errors, (struct pos){0, 0}, &of)) {
        const struct expr_want want = {.dim = of.dim, .constant = true, .what = name};
        expr = compile(&arena, model, text, &want, errors);
    }
    if (expr) *value = expr_value(expr);
    arena_free(&arena);
    diag_end(&call);
    return expr != NULL;
}

void fbd_state_show_degrees(fbd_state *state, bool degrees)
{
    if (state) state->degrees = degrees;
}

static bool close_state(fbd_state *state, fbd_errors *errors)
{
    if (!state->settled) modes_settle(state, NULL); /* inconsistent modes are reported by the check */
    if (state->model->assembles) state_project(state, true);
    state->settled = false;
    return start_check(state, "the state", errors);
}

bool fbd_state_close(fbd_state *state, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    bool fits = state ? close_state(state, errors) : api_refuse(errors, "there is no state") != NULL;
    diag_end(&call);
    return fits;
}

/* The body whose mass has this name ("rocket.m"), or NULL. */
static const struct model_body *massive(const fbd_model *model, const char *name)
{
    const char *dot = strrchr(name, '.');
    if (!dot || strcmp(dot, ".m") != 0) return NULL;
    for (size_t b = 0; b < model->body_count; b++) {
        const char *body = model->bodies[b].name;
        if (strlen(body) == (size_t)(dot - name) && strncmp(body, name, strlen(body)) == 0)
            return &model->bodies[b];
    }
    return NULL;
}

bool fbd_state_get(const fbd_state *state, const char *name, double *value)
{
    if (!state || !name || !value) return false;
    const double *place = strcmp(name, "t") == 0 ? &state->t : find(state, name);
    const struct model_body *body = place ? NULL : massive(state->model, name);
    const struct instant at = state_instant(state);
    if (!place && !body) return false;
    *value = place ? *place : body_mass(body, &at);
    return true;
}
