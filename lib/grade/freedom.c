/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Determine whether a scene has one degree of freedom.
 *
 * Forces change accelerations only along the degrees of freedom. If linearly independent pushes change all
 * accelerations of the scene in the same proportion, at every state, there is a single one, and an equation
 * of motion for any of the accelerations is the same equation.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "grade/lines.h"
#include "output/random_state.h"

/* Change of the accelerations under a push; false if the state is inadmissible under it. */
static bool change_by(const fbd_model *pushed, const fbd_state *state, double *change)
{
    int n = state->model->plan.n;
    fbd_state *other = state_new(pushed);
    if (!other) return false;
    other->t = state->t;
    memcpy(other->y, state->y, plan_size(&pushed->plan) * sizeof *other->y);
    bool found = random_admissible(other);
    for (int i = 0; found && i < n; i++) change[i] = other->a[i] - state->a[i];
    state_free(other);
    return found;
}

/* True if both are parallel up to the round-off of differences of accelerations. */
static bool are_parallel(const double *a, const double *b, int n, double size)
{
    const double rounding = 1e-9;
    double aa = 0, bb = 0, ab = 0;
    for (int i = 0; i < n; i++) {
        aa += a[i] * a[i];
        bb += b[i] * b[i];
        ab += a[i] * b[i];
    }
    if (!(aa > 0 && bb > 0)) return false;
    double off = 0;
    for (int i = 0; i < n; i++) off = fmax(off, fabs(b[i] - a[i] * (ab / aa)));
    return off <= rounding * (sqrt(bb) + size);
}

static bool is_one_at(const struct lines *lines, const fbd_state *state, double *room, bool *seen)
{
    int n = state->model->plan.n;
    double size = 0, *first = room, *second = room + n;
    for (int i = 0; i < n; i++) size = fmax(size, fabs(state->a[i]));
    if (!change_by(lines->pushed[0].model, state, first) || !change_by(lines->pushed[1].model, state, second))
        return true;
    *seen = true;
    return are_parallel(first, second, n, size);
}

bool lines_one_freedom(struct lines *lines)
{
    enum { states = 6 };
    const fbd_model *model = lines->model;
    size_t n = (size_t)model->plan.n;
    if (!lines->pushed[0].model || !lines->pushed[1].model) return false;
    fbd_state *start = state_new(model), *state = start ? state_new(model) : NULL;
    double *room = calloc(2 * n + random_path_room(model), sizeof *room);
    struct random_path path = {.start = start, .y = room ? room + 2 * n : NULL};
    bool one = state && room, seen = false;
    if (!one) lines->grade->arena.failed = true;
    for (int k = 0; one && k < states; k++)
        if (random_state(lines->rng, state, &path) && random_admissible(state))
            one = is_one_at(lines, state, room, &seen);
    state_free(start);
    state_free(state);
    free(room);
    return one && seen;
}
