/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: states by name.
 */
#include <math.h>
#include <string.h>

#include "dynamics/modes.h"

fbd_state *fbd_state_new(const fbd_model *model)
{
    fbd_state *state = state_new(model);
    if (state) modes_settle(state, NULL);
    return state;
}

void fbd_state_free(fbd_state *state)
{
    state_free(state);
}

/* Where a named quantity is kept, or NULL. */
static double *find(const fbd_state *state, const char *name)
{
    const fbd_model *model = state->model;
    size_t n = model->scene->coordinate_count;
    for (size_t i = 0; i < n; i++) {
        if (strcmp(model->labels[i].name, name) == 0) return &state->y[i];
        if (strcmp(model->labels[i].rate_name, name) == 0) return &state->y[n + i];
    }
    return NULL;
}

bool fbd_state_set(fbd_state *state, const char *name, double value)
{
    double *place = strcmp(name, "t") == 0 ? &state->t : find(state, name);
    if (!place || !isfinite(value)) return false;
    *place = value;
    state->settled = false;
    return true;
}

/* The coordinate or rate with this name, qualified or, in a scene of one body, plain; -1 when there is none.
 */
static int index_of(const fbd_model *model, const char *name)
{
    int n = (int)model->scene->coordinate_count;
    for (int i = 0; i < n; i++) {
        const struct coordinate *c = &model->scene->coordinates[i];
        bool plain = model->body_count == 1;
        if (strcmp(model->labels[i].name, name) == 0 || (plain && strcmp(c->name, name) == 0)) return i;
        if (strcmp(model->labels[i].rate_name, name) == 0 || (plain && strcmp(c->rate_name, name) == 0))
            return n + i;
    }
    return -1;
}

static struct symbol no_name(void *context, const char *name, struct pos at)
{
    (void)context;
    (void)name;
    (void)at;
    return (struct symbol){.kind = symbol_unknown};
}

static bool set_text(fbd_state *state, const char *name, const char *text, fbd_errors *errors)
{
    const fbd_model *model = state->model;
    int n = (int)model->scene->coordinate_count, index = index_of(model, name);
    diag_in_file(errors, model->scene->file);
    if (index < 0) {
        diag_add(errors, FBD_ERROR, "unknown-coordinate", (struct pos){0, 0},
                 n > 0 ? diag_hint(errors, "as `%s`", model->labels[0].name) : NULL,
                 "there is no coordinate `%s`", name);
        return false;
    }
    const struct coordinate *c = &model->scene->coordinates[index % n];
    struct scope scope = {.lookup = no_name, .units = model->scene->units};
    struct expr_want want = {.dim = index < n ? c->dim : c->rate_dim,
                             .constant = true,
                             .angle = c->angle && index < n,
                             .what = name};
    struct arena arena = {0};
    const struct expr *expr = expr_compile(&arena, text, (struct pos){0, 0}, &scope, &want, errors);
    if (expr) {
        state->y[index] = expr_value(expr);
        state->settled = false;
    }
    arena_free(&arena);
    return expr != NULL;
}

bool fbd_state_set_text(fbd_state *state, const char *name, const char *text, fbd_errors *list)
{
    struct diag_call call;
    bool set = set_text(state, name, text, diag_begin(&call, list));
    diag_end(&call);
    return set;
}

bool fbd_state_get(const fbd_state *state, const char *name, double *value)
{
    const double *place = strcmp(name, "t") == 0 ? &state->t : find(state, name);
    if (!place) return false;
    *value = *place;
    return true;
}
