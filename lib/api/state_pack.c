/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the numbers that determine the further motion.
 */
#include <math.h>
#include <string.h>

#include "dynamics/constraint.h"
#include "dynamics/state.h"
#include "fbd_view.h"

/* Of a coupling: zero, sides, directions and turns of a rope's ends. */
enum { numbers_of_a_coupling = 9 };

static size_t coupling_count(const struct fbd_model *model)
{
    return (size_t)model->tree->coupling_count;
}

/* The branch of memory `index` among all switches, or -1 past the last one. */
static int find_memory(const struct plan *plan, size_t index)
{
    for (size_t i = 0; i < plan->kink_count; i++) {
        const struct formula *formula = &plan->kinks[i].formula;
        for (size_t k = 0; k < plan->kinks[i].count; k++)
            if (expr_switch_remembers(formula->expr, k) && index-- == 0) return formula->branch + (int)k;
    }
    return -1;
}

static size_t memory_count(const struct plan *plan)
{
    size_t count = 0;
    while (find_memory(plan, count) >= 0) count++;
    return count;
}

static size_t held_count(const struct scene *scene)
{
    size_t count = 0;
    for (size_t i = 0; i < scene->parameter_count; i++) count += scene->parameters[i].call.held;
    return count;
}

static size_t size_of(const struct fbd_model *model)
{
    return 1 + plan_size(&model->plan) + memory_count(&model->plan) +
           numbers_of_a_coupling * coupling_count(model) + (size_t)model->scene->lifetime_count +
           held_count(model->scene);
}

struct packing {
    double *numbers;
    size_t count, room;
};

static void put(struct packing *packing, double number)
{
    if (packing->count < packing->room) packing->numbers[packing->count] = number;
    packing->count++;
}

static void put_coupling(struct packing *packing, const struct coupling_state *coupling)
{
    put(packing, coupling->zero);
    for (int end = 0; end < 2; end++) {
        put(packing, coupling->side[end]);
        put(packing, coupling->psi[end]);
        put(packing, coupling->turned[end]);
        put(packing, coupling->laid[end]);
    }
}

/* NOLINTNEXTLINE(readability-non-const-parameter): `put` writes them */
size_t fbd_state_pack(const fbd_state *state, double *numbers, size_t room)
{
    if (!state) return 0;
    const struct plan *plan = &state->model->plan;
    struct packing packing = {numbers, 0, numbers ? room : 0};
    int branch;
    put(&packing, state->t);
    for (size_t i = 0; i < plan_size(plan); i++) put(&packing, state->y[i]);
    for (size_t i = 0; (branch = find_memory(plan, i)) >= 0; i++) put(&packing, state->branch[branch]);
    for (size_t i = 0; i < coupling_count(state->model); i++)
        put_coupling(&packing, &state->tree->couplings[i]);
    for (int i = 0; i < state->model->scene->lifetime_count; i++) put(&packing, state->tree->life[i]);
    for (size_t i = 0; i < state->model->scene->parameter_count; i++)
        if (state->model->scene->parameters[i].call.held) put(&packing, state->held[i]);
    return packing.count;
}

/* The branch of an expression with memory, and a side, is 1 or -1; a side may also be 0. */
static bool is_sign(double number, bool or_zero)
{
    return number == 1 || number == -1 || (or_zero && number == 0);
}

static bool are_signs(const struct fbd_model *model, const double *memories, const double *couplings)
{
    size_t count = memory_count(&model->plan);
    for (size_t i = 0; i < count; i++)
        if (!is_sign(memories[i], false)) return false;
    for (size_t i = 0; i < coupling_count(model); i++, couplings += numbers_of_a_coupling)
        if (!is_sign(couplings[1], true) || !is_sign(couplings[5], true)) return false;
    for (int i = 0; i < model->scene->lifetime_count; i++)
        if (couplings[i] != life_there && couplings[i] != life_over && couplings[i] != life_waits)
            return false;
    return true;
}

static void take_coupling(const double *numbers, struct coupling_state *coupling)
{
    coupling->zero = numbers[0];
    for (int end = 0; end < 2; end++) {
        coupling->side[end] = (int)numbers[1 + 4 * end];
        coupling->psi[end] = numbers[2 + 4 * end];
        coupling->turned[end] = numbers[3 + 4 * end];
        coupling->laid[end] = numbers[4 + 4 * end];
    }
}

bool fbd_state_unpack(fbd_state *state, const double *numbers, size_t count)
{
    if (!state || !numbers || count != size_of(state->model)) return false;
    const struct plan *plan = &state->model->plan;
    size_t size = plan_size(plan);
    const double *memories = numbers + 1 + size, *couplings = memories + memory_count(plan);
    int branch;
    for (size_t i = 0; i < count; i++)
        if (!isfinite(numbers[i])) return false;
    if (!are_signs(state->model, memories, couplings)) return false;
    state->t = numbers[0];
    state->rest = 0;
    memcpy(state->y, numbers + 1, size * sizeof *state->y);
    for (size_t i = 0; (branch = find_memory(plan, i)) >= 0; i++) state->branch[branch] = (int)memories[i];
    for (size_t i = 0; i < coupling_count(state->model); i++)
        take_coupling(couplings + numbers_of_a_coupling * i, &state->tree->couplings[i]);
    const double *lives = couplings + numbers_of_a_coupling * coupling_count(state->model);
    for (int i = 0; i < state->model->scene->lifetime_count; i++) state->tree->life[i] = (int)lives[i];
    const double *held = numbers + count - held_count(state->model->scene);
    for (size_t i = 0; i < state->model->scene->parameter_count; i++)
        if (state->model->scene->parameters[i].call.held) state->held[i] = *held++;
    state->settled = false;
    return true;
}
