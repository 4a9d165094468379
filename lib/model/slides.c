/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Find the switches that admit a sliding mode (dynamics/sliding.h): those at which a force or a coefficient
 * of friction jumps as a function of a velocity; and those on a sum of coordinates, which are crossed while
 * their rate is not zero but admit a second-order sliding mode where it becomes zero.
 */
#include "model/builder.h"

enum { most_slides = 32 };

/* True for a force, whose branches can be mixed; false for directions, potentials and prescribed motions. */
static bool is_force(const struct fbd_model *model, const struct kink *kink)
{
    int branch = kink->formula.branch;
    if (kink->load >= 0) {
        const struct model_load *load = &model->loads[kink->load];
        if (load->value.branch == branch && load->value.expr) return true;
        if (load->fx.branch == branch && load->fx.expr) return true;
        if (load->fy.branch == branch && load->fy.expr) return true;
        if (load->couple.branch == branch && load->couple.expr) return true;
    }
    for (size_t i = 0; i < model->plan.mode_count; i++) {
        const struct formula *mu = &model->plan.modes[i].mu_k;
        if (mu->expr && mu->branch == branch) return true;
    }
    return false;
}

/* True if the expression depends on a velocity: a rate, or one in the world. */
static bool reads_velocity(const struct fbd_model *model, const struct expr *expr)
{
    const int *slots, n = model->plan.n, size = (int)plan_size(&model->plan);
    size_t count = expr_variables(expr, &slots);
    for (size_t i = 0; i < count; i++) {
        if (slots[i] <= n) continue;
        if (slots[i] <= 2 * n) return true;
        if (slots[i] <= size || slot_is_constant(model, slots[i])) continue;
        enum absolute_kind kind = model->scene->absolutes[slots[i] - 1 - size - hand_slots].kind;
        if (kind != absolute_x && kind != absolute_y && kind != absolute_angle) return true;
    }
    return false;
}

/* The jumps at switches on a sum of coordinates with constant factors, a bit each. */
static unsigned watch_places(const struct fbd_model *model, const struct kink *kink)
{
    enum { most_bits = 32 };
    const struct expr *expr = kink->formula.expr;
    unsigned places = 0;
    for (size_t part = 0; part < kink->count && part < most_bits; part++)
        if (expr_switch_jumps(expr, part) &&
            expr_switch_degree(expr, part, model->plan.n, model->constant_slots) == expr_affine)
            places |= 1u << part;
    return places;
}

void slides_find(struct fbd_model *model)
{
    struct plan *plan = &model->plan;
    for (size_t i = 0; i < plan->kink_count; i++) {
        struct kink *kink = &plan->kinks[i];
        int jumps = 0;
        for (size_t part = 0; part < kink->count; part++)
            jumps +=
                expr_switch_jumps(kink->formula.expr, part) && !expr_switch_is_time(kink->formula.expr, part);
        kink->places = watch_places(model, kink);
        kink->slides = jumps > 0 && plan->slide_count + jumps <= most_slides && is_force(model, kink) &&
                       (kink->places > 0 || reads_velocity(model, kink->formula.expr));
        if (kink->slides) plan->slide_count += jumps;
    }
}
