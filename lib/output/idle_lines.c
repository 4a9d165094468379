/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "output/idle_lines.h"

#include "dynamics/constraint_view.h"

static const char *const when[idle_kinds] = {[idle_contact] = "while out of contact",
                                             [idle_rope] = "while slack",
                                             [idle_before] = "before the beginning",
                                             [idle_after] = "after the end"};

static enum idle of_lifetime(const struct fbd_state *state, int lifetime)
{
    if (is_there(state->tree, lifetime)) return idle_kinds;
    return state->tree->life[lifetime - 1] == life_waits ? idle_before : idle_after;
}

/* Why the force is zero; idle_kinds if it acts. */
static enum idle idle_of(const struct fbd_state *state, int b, const struct arrow *arrow)
{
    const struct fbd_model *model = state->model;
    struct coupling_place place;
    if (!coupling_of_force(model, b, arrow->name, &place))
        return arrow->load < 0 ? idle_kinds
                               : of_lifetime(state, model->loads[arrow->load].source->lifetime.number);
    const struct coupling *coupling = &model->tree->couplings[place.coupling];
    const enum idle life = of_lifetime(state, coupling->source->lifetime.number);
    if (life != idle_kinds) return life;
    if (coupling->surface >= 0 && state->slip[coupling->surface] != stick) return idle_contact;
    const bool rope = coupling->pair >= 0 && model->plan.modes[coupling->pair].kind == mode_rope;
    return rope && state->slip[coupling->pair] != stick ? idle_rope : idle_kinds;
}

int idle_lines(struct formulas *formulas, int b, struct idle_line lines[static idle_kinds])
{
    const struct fbd_state *state = formulas->state;
    const struct instant at = state_instant(state);
    struct arrow *arrows = ARENA_ARRAY(&formulas->arena, diagram_arrows(state->model, b), struct arrow);
    const char *sums[idle_kinds] = {"", "", "", ""};
    const size_t arrow_count = arrows ? diagram_list(state->model, b, &at, state->slots, arrows) : 0;
    for (size_t i = 0; i < arrow_count; i++) {
        const enum idle idle = idle_of(state, b, &arrows[i]);
        if (idle == idle_kinds || acts_of(&formulas->samples, b, arrows[i].name, false).count == 0) continue;
        sums[idle] = arena_printf(&formulas->arena, "%s%s = ", sums[idle] ? sums[idle] : "",
                                  formulas->symbols[b][i].text);
    }
    int count = 0;
    for (int k = 0; k < idle_kinds; k++)
        if (!sums[k] || sums[k][0])
            lines[count++] =
                (struct idle_line){sums[k] ? arena_printf(&formulas->arena, "%s0", sums[k]) : NULL, when[k]};
    return count;
}
