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

bool fbd_state_get(const fbd_state *state, const char *name, double *value)
{
    const double *place = strcmp(name, "t") == 0 ? &state->t : find(state, name);
    if (!place) return false;
    *value = *place;
    return true;
}
