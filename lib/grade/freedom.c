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

#include "fbd_view.h"
#include "grade/lines.h"

/* Memory for one state: its numbers, its accelerations, and their changes under the pushes. */
struct room {
    size_t packed, count; /* numbers, accelerations */
    double *numbers, *a, *change[lines_pushes];
};

/* Change of the accelerations under push k; false if the state is inadmissible under it. */
static bool change_by(const struct lines *lines, int k, const struct room *room)
{
    fbd_state *other = fbd_state_new(lines->pushed[k].model);
    bool found = fbd_state_unpack(other, room->numbers, room->packed) && fbd_state_settle(other);
    if (found) fbd_state_accelerations(other, room->change[k], room->count);
    for (size_t i = 0; found && i < room->count; i++) room->change[k][i] -= room->a[i];
    fbd_state_free(other);
    return found;
}

/* True if both are parallel up to the round-off of differences of accelerations. */
static bool are_parallel(const double *a, const double *b, size_t n, double size)
{
    const double rounding = 1e-9;
    double aa = 0, bb = 0, ab = 0;
    for (size_t i = 0; i < n; i++) {
        aa += a[i] * a[i];
        bb += b[i] * b[i];
        ab += a[i] * b[i];
    }
    if (!(aa > 0 && bb > 0)) return false;
    double off = 0;
    for (size_t i = 0; i < n; i++) off = fmax(off, fabs(b[i] - a[i] * (ab / aa)));
    return off <= rounding * (sqrt(bb) + size);
}

static bool is_one_at(const struct lines *lines, fbd_state *state, const struct room *room, bool *seen)
{
    double size = 0;
    fbd_state_pack(state, room->numbers, room->packed);
    fbd_state_accelerations(state, room->a, room->count);
    for (size_t i = 0; i < room->count; i++) size = fmax(size, fabs(room->a[i]));
    for (int k = 0; k < lines_pushes; k++)
        if (!change_by(lines, k, room)) return true;
    *seen = true;
    return are_parallel(room->change[0], room->change[1], room->count, size);
}

bool lines_one_freedom(struct lines *lines)
{
    enum { states = 6 };
    const fbd_model *model = lines->model;
    if (!lines->pushed[0].model || !lines->pushed[1].model) return false;
    fbd_state *state = fbd_state_new(model);
    fbd_sampler *sampler = fbd_sampler_new(model);
    struct room room = {
        fbd_state_pack(state, NULL, 0), fbd_model_coordinate_count(model), NULL, NULL, {NULL}};
    room.numbers = calloc(room.packed + 3 * room.count + 1, sizeof *room.numbers);
    bool one = state && sampler && room.numbers, seen = false;
    if (one) {
        room.a = room.numbers + room.packed;
        for (int k = 0; k < lines_pushes; k++) room.change[k] = room.a + (size_t)(k + 1) * room.count;
    }
    if (!one) lines->grade->arena.failed = true;
    for (int k = 0; one && k < states; k++)
        if (fbd_sampler_draw(sampler, state, 1)) one = is_one_at(lines, state, &room, &seen);
    fbd_sampler_free(sampler);
    fbd_state_free(state);
    free(room.numbers);
    return one && seen;
}
