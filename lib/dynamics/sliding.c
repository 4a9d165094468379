/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/sliding.h"

#include <string.h>

#include "dynamics/world_refs.h"

/* ---- memory */

static size_t most_switches(const struct plan *plan)
{
    size_t most = 0;
    for (size_t i = 0; i < plan->kink_count; i++)
        if (plan->kinks[i].count > most) most = plan->kinks[i].count;
    return most;
}

static size_t double_count(const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    size_t room = (size_t)plan->slide_count, n = (size_t)plan->n, size = plan_size(plan);
    return 2 * room * room + n * room + 3 * room + 3 * most_switches(plan) + 2 * (size_t)plan->slots + 4 * n +
           6 * size + extended_size(model) + size + model->scene->parameter_count;
}

static size_t int_count(const struct plan *plan)
{
    return 4 * (size_t)plan->branches + 3 * plan->mode_count + 2 * (size_t)plan->slide_count +
           (size_t)plan->n;
}

size_t sliding_size(const struct fbd_model *model)
{
    const struct plan *plan = &model->plan;
    if (plan->slide_count == 0) return 0;
    size_t bytes = (size_t)plan->slide_count * sizeof(struct slide) + double_count(model) * sizeof(double) +
                   int_count(plan) * sizeof(int) +
                   (3 * (size_t)plan->branches + plan->mode_count) * sizeof(bool);
    return (bytes + sizeof(double) - 1) / sizeof(double) * sizeof(double);
}

void sliding_init(struct sliding *sliding, const struct fbd_model *model, void *memory)
{
    const struct plan *plan = &model->plan;
    size_t room = (size_t)plan->slide_count, n = (size_t)plan->n, size = plan_size(plan),
           switches = most_switches(plan);
    sliding->slides = memory;
    double *next = (double *)(sliding->slides + room);
    double **const parts[] = {
        &sliding->M,        &sliding->lu,           &sliding->B,           &sliding->c,
        &sliding->delta,    &sliding->step,         &sliding->u,           &sliding->rate,
        &sliding->rounding, &sliding->slots,        &sliding->slots_along, &sliding->a,
        &sliding->a_along,  &sliding->flow,         &sliding->zero,        &sliding->kept_y,
        &sliding->own_y,    &sliding->own_dy,       &sliding->best,        &sliding->moved,
        &sliding->as_fast,  &sliding->shifted_held, &sliding->shifted};
    const size_t sizes[] = {room * room,
                            room * room,
                            n * room,
                            room,
                            room,
                            room,
                            switches,
                            switches,
                            switches,
                            (size_t)plan->slots,
                            (size_t)plan->slots,
                            n,
                            n,
                            size,
                            size,
                            size,
                            size,
                            size,
                            n,
                            model->scene->parameter_count,
                            size,
                            n,
                            extended_size(model) + size};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        *parts[i] = next;
        next += sizes[i];
    }
    void *behind = next;
    sliding->slide_at = behind;
    sliding->branches = sliding->slide_at + plan->branches;
    sliding->kept = sliding->branches + plan->branches;
    sliding->pivot = sliding->kept + 2 * (size_t)plan->branches + 2 * plan->mode_count;
    sliding->held = sliding->pivot + room;
    sliding->aside = sliding->held + room;
    sliding->with = sliding->aside + plan->mode_count;
    sliding->keep = (bool *)(sliding->with + n);
    sliding->left = sliding->keep + plan->branches;
    sliding->ended = sliding->left + plan->branches;
    sliding->slips = sliding->ended + plan->branches;
    for (int i = 0; i < plan->n; i++) sliding->with[i] = i, sliding->as_fast[i] = 1;
}

void sliding_copy(const struct fbd_model *model, struct sliding *to, const struct sliding *from)
{
    to->count = from->count;
    to->units = from->units;
    memcpy(to->slides, from->slides, (size_t)from->count * sizeof *to->slides);
    memcpy(to->held, from->held, (size_t)from->units * sizeof *to->held);
    memcpy(to->with, from->with, (size_t)model->plan.n * sizeof *to->with);
    memcpy(to->as_fast, from->as_fast, (size_t)model->plan.n * sizeof *to->as_fast);
    memcpy(to->slide_at, from->slide_at, (size_t)model->plan.branches * sizeof *to->slide_at);
}

/* ---- the list */

void sliding_add(struct sliding *sliding, const struct kink *kink, int index, int part, int unit, int sign)
{
    int branch = kink->formula.branch + part;
    sliding->slides[sliding->count++] =
        (struct slide){index, part, branch, unit, sign, kink_watches_places(kink, part), 0.5, 0, 0};
    sliding->slide_at[branch] = sliding->count;
    if (unit >= sliding->units) sliding->units = unit + 1;
}

void sliding_number(struct sliding *sliding)
{
    int units = 0;
    for (int j = 0; j < sliding->count; j++) {
        int old = sliding->slides[j].unit, first = 0;
        while (sliding->slides[first].unit != old && sliding->slides[first].unit != -1 - old) first++;
        if (first < j) continue;
        for (int k = j; k < sliding->count; k++)
            if (sliding->slides[k].unit == old) sliding->slides[k].unit = -1 - units;
        units++;
    }
    for (int j = 0; j < sliding->count; j++) sliding->slides[j].unit = -1 - sliding->slides[j].unit;
    sliding->units = units;
}

void sliding_drop(struct sliding *sliding)
{
    int count = 0;
    for (int j = 0; j < sliding->count; j++) {
        if (sliding->slide_at[sliding->slides[j].branch] == 0) continue;
        sliding->slides[count] = sliding->slides[j];
        sliding->slide_at[sliding->slides[count].branch] = count + 1;
        count++;
    }
    sliding->count = count;
    sliding_number(sliding);
}

/* ---- formulas */

enum { most_in_a_formula = 8 };

/* Find the sliding switches in a formula; its branches are copied to the scratch. */
static int slides_of(const struct formula *formula, const struct instant *at, const struct slide **found)
{
    struct sliding *sliding = at->sliding;
    int count = 0, first = formula->branch;
    size_t switches = expr_switches(formula->expr);
    for (size_t k = 0; k < switches; k++) {
        int slide = sliding->slide_at[(size_t)first + k];
        sliding->branches[(size_t)first + k] = at->branch[(size_t)first + k];
        if (slide > 0 && count < most_in_a_formula) found[count++] = &sliding->slides[slide - 1];
    }
    return count;
}

/* The weight of the vertex whose bits give the slides on their upper branch, and its variation. */
static double weight_of(const struct slide *const *slides, int count, unsigned vertex, double *variation)
{
    double weight = 1, along = 0;
    for (int j = 0; j < count; j++) {
        bool upper = vertex >> j & 1;
        double w = upper ? slides[j]->share : 1 - slides[j]->share;
        along = along * w + weight * (upper ? slides[j]->along : -slides[j]->along);
        weight *= w;
    }
    *variation = along;
    return weight;
}

static const int *vertex_branches(const struct formula *formula, const struct instant *at,
                                  const struct slide *const *slides, int count, unsigned vertex)
{
    int *branches = at->sliding->branches;
    for (int j = 0; j < count; j++) branches[slides[j]->branch] = vertex >> j & 1 ? 1 : -1;
    return branches + formula->branch;
}

double sliding_value(const struct formula *formula, const struct instant *at)
{
    const struct slide *slides[most_in_a_formula];
    int count = slides_of(formula, at, slides);
    if (count == 0) return expr_eval(formula->expr, at->t, at->y, at->branch + formula->branch);
    double sum = 0, unused;
    for (unsigned vertex = 0; vertex < 1u << count; vertex++) {
        const int *branch = vertex_branches(formula, at, slides, count, vertex);
        sum += weight_of(slides, count, vertex, &unused) * expr_eval(formula->expr, at->t, at->y, branch);
    }
    return sum;
}

double sliding_value_along(const struct formula *formula, const struct instant *at,
                           const struct direction *along, double *variation)
{
    const struct slide *slides[most_in_a_formula];
    int count = slides_of(formula, at, slides);
    double sum = 0;
    *variation = 0;
    for (unsigned vertex = 0; vertex < 1u << count; vertex++) {
        const int *branch = vertex_branches(formula, at, slides, count, vertex);
        double d_weight, d_value, weight = weight_of(slides, count, vertex, &d_weight);
        double value = expr_eval_along(formula->expr, at->t, at->y, along->dt, along->dy, branch, &d_value);
        sum += weight * value;
        *variation += weight * d_value + d_weight * value;
    }
    return sum;
}
