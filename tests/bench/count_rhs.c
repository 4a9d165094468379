/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Usage: count_rhs MODEL NUMBER [empty]
 *
 * Evaluates the right-hand side of a model NUMBER times, in the modes of its start and at states near it, for
 * those who count instructions (tests/tools/effects); with `empty`, a function that does nothing instead,
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

static double evaluate(struct fbd_state *state, struct rates *rates, long count, bool empty)
{
    size_t size = 2 * (size_t)state->model->plan.n;
    double *dydt = calloc(size, sizeof *dydt), sum = 0;
    if (!dydt) return NAN;
    void *params;
    rates_function *volatile function = rates_call(rates, &params);
    if (empty) function = nothing;
    for (long i = 0; i < count; i++) {
        state->y[0] += 1e-6; /* so that no two are the same */
        function(1e-3 * (double)i, state->y, dydt, params);
        sum += dydt[0];
    }
    free(dydt);
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
