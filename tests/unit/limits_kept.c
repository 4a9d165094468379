/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "limits_kept.h"

#include <math.h>
#include <stdio.h>

#include "dynamics/constraint.h"
#include "dynamics/friction.h"
#include "dynamics/state.h"

static const double rounding = 1e-6;

struct held {
    double bears, most; /* up to */
};

/* What mode `pair` has in hand, where it holds. */
static struct held held_by(struct fbd_state *state, int pair)
{
    const struct mode *mode = mode_of(state, pair);
    struct instant at = state_instant(state);
    if (state->slip[pair] != stick || mode->kind == mode_drive) return (struct held){0, 0};
    if (mode_is_one_sided(mode)) return (struct held){-one_sided_at(state->model, &at, pair).force, 0};
    struct friction_values now = friction_at(state->model, pair, &at, state->slots);
    return (struct held){fabs(now.hold), now.limit};
}

/* Forces that cancel, as those of a tight belt, leave their rounding; what is limited by nothing is measured against what
 * others bear. */
const char *beyond_limits(fbd_state *state)
{
    static char text[200];
    const int count = (int)state->model->plan.mode_count;
    double size = 0;
    state_evaluate(state);
    for (int pair = 0; pair < count; pair++) size = fmax(size, held_by(state, pair).most);
    for (int pair = 0; pair < count; pair++) {
        const struct mode *mode = mode_of(state, pair);
        struct held held = held_by(state, pair);
        double weight =
            state->model->bodies[mode->body].inertia.mass * vec_norm(state->model->scene->gravity);
        if (!(held.bears - held.most > rounding * fmax(fmax(size, held.most), weight))) continue;
        snprintf(text, sizeof text, "mode %d of `%s` at t = %.9g bears %.9g, up to %.9g", pair,
                 fbd_model_body_name(state->model, (size_t)mode->body), state->t, held.bears, held.most);
        return text;
    }
    return NULL;
}
