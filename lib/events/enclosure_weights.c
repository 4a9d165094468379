/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Enclosures of the weights of switches in Filippov sliding modes.
 *
 * The surface of a unit is w = g_x x + g_v v with constant g, or with positions alone u' = g v. Along the
 * motion
 *
 *     w' = g_x v + g_v a = c_0 + sum_l C_l d_l = 0,
 *
 * with d_l = s - 1/2 of unit l (with the sign of each switch), because a formula with one sliding switch is
 * (F+ + F-)/2 + d (F+ - F-), and each of these coordinates has an acceleration independent of the others: its
 * force divided by its inertia. Where friction keeps the coordinate of the surface at rest, its sum of forces
 * replaces w' (sliding.h). With one unit d = -c_0/C, else C has to be constant and is eliminated.
 */
#include <string.h>

#include "events/enclosure.h"
#include "numeric/lu.h"

const struct slide *enclose_filippov(const struct fbd_state *state, const struct formula *formula,
                                     int *slides)
{
    const struct slide *found = NULL;
    *slides = 0;
    if (!state_sliding(state) || !formula->expr || formula->branch < 0) return NULL;
    size_t switches = expr_switches(formula->expr);
    for (size_t k = 0; k < switches; k++) {
        int slide = state->sliding->slide_at[(size_t)formula->branch + k];
        if (slide == 0) continue;
        found = &state->sliding->slides[slide - 1];
        ++*slides;
    }
    return found;
}

struct enclosure enclose_branch(const struct enclosure_input *input, const struct formula *formula,
                                const struct slide *slide, int side)
{
    int *branches = input->state->sliding->branches; /* scratch */
    size_t switches = expr_switches(formula->expr);
    memcpy(branches, input->state->branch + formula->branch, switches * sizeof *branches);
    branches[slide->branch - formula->branch] = side;
    return expr_enclose(formula->expr, input->stretch, input->y, branches);
}

/* ---- existence */

static bool has_slides(const struct fbd_state *state, const struct formula *formula)
{
    int slides;
    enclose_filippov(state, formula, &slides);
    return slides > 0;
}

/* The largest number in one formula. */
static int most_slides(const struct fbd_state *state, struct range list)
{
    int most = 0;
    for (int i = list.first; i < list.first + list.count; i++) {
        int slides;
        enclose_filippov(state, &state->model->plan.formulas[i].value, &slides);
        if (slides > most) most = slides;
    }
    return most;
}

/* Sliding modes act on a coordinate through terms of its own slot, one in each formula; not through the
 * normal force or the coefficient of its friction. */
static bool knows_coordinate(const struct fbd_state *state, int coordinate)
{
    const struct plan *plan = &state->model->plan;
    const struct scalar_equation *equation = &plan->equations[coordinate];
    if (!equation->known || most_slides(state, equation->formulas) > 1 ||
        most_slides(state, equation->across_formulas) > 0)
        return false;
    for (size_t pair = 0; pair < plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        if (mode->body != state->model->scene->coordinates[coordinate].body) continue;
        if (mode->kind != mode_single) return false;
        if (mode->surface_speed.expr || has_slides(state, &mode->mu_k)) return false;
    }
    return true;
}

bool enclosure_has_weights(const struct fbd_state *state)
{
    const struct fbd_model *model = state->model;
    const struct sliding *s = state->sliding;
    int n = model->plan.n;
    if (s->units > most_enclosed_units) return false;
    for (int j = 0; j < s->count; j++) {
        const struct kink *kink = &model->plan.kinks[s->slides[j].kink];
        const int *slots;
        size_t count = expr_variables(kink->formula.expr, &slots);
        if (expr_switch_degree(kink->formula.expr, (size_t)s->slides[j].part, 2 * n, model->constant_slots) !=
            expr_affine)
            return false;
        for (size_t k = 0; k < count; k++) {
            if (slots[k] > 2 * n) return false; /* user states and positions */
            if (!knows_coordinate(state, (slots[k] - 1) % n)) return false;
        }
    }
    return true;
}

/* ---- equations */

struct equations {
    struct enclosure c[most_enclosed_units], C[most_enclosed_units][most_enclosed_units];
};

/* The friction force of a slipping pair, without sliding modes. */
static struct enclosure friction_of(const struct enclosure_input *input, int coordinate)
{
    const struct plan *plan = &input->state->model->plan;
    struct enclosure sum = enclosure_point(0);
    for (int pair = 0; pair < (int)plan->mode_count; pair++) {
        const struct mode *mode = &plan->modes[pair];
        int side = slip_side(input->state->slip[pair]);
        if (mode->coordinate != coordinate || !mode_is_friction(mode) || side == 0) continue;
        struct enclosure rubs =
            enclosure_multiply(enclose_formula(input, &mode->mu_k), enclose_normal_force(input, pair));
        sum = enclosure_subtract(sum, enclosure_scale(side, rubs));
    }
    return sum;
}

/* Add `factor` times the force along a coordinate to the equation of a unit: the force at weights of 1/2, and
 * the coefficient of each unit's weight. */
static void take_force(const struct enclosure_input *input, int coordinate, double factor,
                       struct equations *e, int unit)
{
    const struct fbd_model *model = input->state->model;
    const struct scalar_equation *equation = &model->plan.equations[coordinate];
    struct enclosure force = enclosure_add(enclose_force(input, coordinate), friction_of(input, coordinate));
    e->c[unit] = enclosure_add(e->c[unit], enclosure_scale(factor, force));
    for (int i = equation->formulas.first; i < equation->formulas.first + equation->formulas.count; i++) {
        const struct formula_term *term = &model->plan.formulas[i];
        int slides;
        const struct slide *slide = enclose_filippov(input->state, &term->value, &slides);
        if (!slide) continue;
        struct enclosure jump = enclosure_subtract(enclose_branch(input, &term->value, slide, 1),
                                                   enclose_branch(input, &term->value, slide, -1));
        struct enclosure *C = &e->C[unit][slide->unit];
        *C = enclosure_add(*C, enclosure_scale(factor * slide->sign * term->scale, jump));
    }
}

/* The coordinate of the friction with this slot. */
static int coordinate_held(const struct plan *plan, int hold_slot)
{
    const struct mode *mode = plan->modes;
    while (mode->hold_slot != hold_slot) mode++;
    return mode->coordinate;
}

static void write_equation(const struct enclosure_input *input, int unit, struct equations *e)
{
    const struct fbd_state *state = input->state;
    struct sliding *s = state->sliding;
    const struct plan *plan = &state->model->plan;
    size_t n = (size_t)plan->n;
    const struct instant at = state_instant(state);
    int first = 0;
    while (s->slides[first].unit != unit) first++;
    const struct kink *kink = &plan->kinks[s->slides[first].kink];
    if (s->held[unit] == all_held) {
        e->C[unit][unit] = enclosure_point(1);
        return;
    }
    if (s->held[unit] >= 0) {
        take_force(input, coordinate_held(plan, s->held[unit]), 1, e, unit);
        return;
    }
    memset(s->flow, 0, plan_size(plan) * sizeof *s->flow);
    for (size_t i = 0; i < 2 * n; i++) {
        s->flow[i] = 1;
        double slope = sliding_surface_rate(s, state->model, &at, kink, s->slides[first].part, 0, s->flow);
        s->flow[i] = 0;
        if (slope == 0 || (i >= n && sliding_holder(s, state->model, &at, (int)(i - n)) >= 0)) continue;
        if (i < n)
            e->c[unit] = enclosure_add(e->c[unit], enclosure_scale(slope, input->y[n + i]));
        else
            take_force(input, (int)(i - n), slope * plan->inverse_inertia[i - n], e, unit);
    }
}

/* ---- solution */

static struct enclosure quotient(struct enclosure f, struct enclosure g)
{
    struct enclosure q = {interval_divide(f.value, g.value), {0, 0}, interval_divide(f.middle, g.middle)};
    q.rate = interval_divide(interval_subtract(f.rate, interval_multiply(q.value, g.rate)), g.value);
    return q;
}

static bool is_constant(const struct equations *e, int units)
{
    for (int i = 0; i < units; i++)
        for (int k = 0; k < units; k++)
            if (e->C[i][k].rate.low != 0 || e->C[i][k].rate.high != 0) return false;
    return true;
}

static double centre_of(struct interval a)
{
    return a.low + (a.high - a.low) / 2;
}

/* C is constant to the rounding of its sums; so is its inverse. */
static void eliminate(struct enclosure_input *input, const struct equations *e, int units)
{
    double C[most_enclosed_units * most_enclosed_units], column[most_enclosed_units];
    size_t pivot[most_enclosed_units], size = (size_t)units;
    for (int i = 0; i < units; i++)
        for (int k = 0; k < units; k++) C[i * units + k] = centre_of(e->C[i][k].middle);
    bool solved = is_constant(e, units) && lu_decompose(size, C, pivot);
    for (int i = 0; i < units; i++) input->shares[i] = solved ? enclosure_point(0) : enclosure_everything();
    for (int k = 0; k < units && solved; k++) {
        memset(column, 0, sizeof column);
        column[k] = -1;
        lu_solve(size, C, pivot, column);
        for (int i = 0; i < units; i++)
            input->shares[i] = enclosure_add(input->shares[i], enclosure_scale(column[i], e->c[k]));
    }
}

void enclosure_find_weights(struct enclosure_input *input)
{
    int units = input->state->sliding->units;
    struct equations e;
    for (int i = 0; i < units; i++) {
        input->shares[i] = e.c[i] = enclosure_point(0);
        for (int k = 0; k < units; k++) e.C[i][k] = enclosure_point(0);
    }
    for (int unit = 0; unit < units; unit++) write_equation(input, unit, &e);
    if (units == 1)
        input->shares[0] = quotient(enclosure_negate(e.c[0]), e.C[0][0]);
    else
        eliminate(input, &e, units);
    for (int i = 0; i < units; i++) input->shares[i] = enclose_centred(input, input->shares[i]);
}
