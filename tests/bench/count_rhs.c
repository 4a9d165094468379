/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Usage: count_rhs MODEL NUMBER [empty]
 *
 * Evaluates the right-hand side of a model NUMBER times, in the modes of its start and at states near it, for
 * those who count instructions in `counted` (tests/tools/effects); with `empty`, a function that does nothing instead,
 * whose count is that of the loop.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/modes.h"
#include "dynamics/rates.h"

static int nothing(double t, const double y[], double dydt[], void *params)
{
    (void)t, (void)y, (void)params;
    dydt[0] = 0;
    return 0;
}

struct calls {
    rates_function *function;
    void *params;
    double *y, *dydt;
};

static double repeat(const struct calls *calls, long count)
{
    double sum = 0;
    for (long i = 0; i < count; i++) {
        calls->y[0] += 1e-6; /* so that no two are the same */
        calls->function(1e-3 * (double)i, calls->y, calls->dydt, calls->params);
        sum += calls->dydt[0];
    }
    return sum;
}

/* A function of the program, that callgrind may find it by its name. */
double counted(const struct calls *calls, long count);

__attribute__((noinline)) double counted(const struct calls *calls, long count)
{
    return repeat(calls, count);
}

static double evaluate(struct fbd_state *state, struct rates *rates, long count, bool empty)
{
    size_t size = 2 * (size_t)state->model->plan.n;
    struct calls calls = {.y = state->y, .dydt = calloc(size, sizeof(double))};
    if (!calls.dydt) return NAN;
    calls.function = rates_call(rates, &calls.params);
    if (empty) calls.function = nothing;
    repeat(&calls, count); /* until each library function is bound and each memory filled */
    double sum = counted(&calls, count);
    free(calls.dydt);
    return sum;
}

int main(int argc, char **argv)
{
    if (argc < 3) return 2;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_read(argv[1], NULL, 0, errors);
    fbd_errors_print(errors, stderr);
    struct fbd_state *state = model ? state_new(model) : NULL;
    struct rates *rates = state && modes_settle(state, NULL) ? rates_new(state, rates_by_rows) : NULL;
    double sum = NAN;
    if (rates)
        sum = evaluate(state, rates, strtol(argv[2], NULL, 10), argc > 3 && strcmp(argv[3], "empty") == 0);
    rates_free(rates);
    state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return isfinite(sum) ? 0 : 1;
}
