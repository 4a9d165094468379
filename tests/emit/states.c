/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Usage: states MODEL.yaml COUNT: the start and COUNT random states of a model, each a line "t q.. v.." with the
 * library's accelerations there in the next line. States that no motion goes on from are left out.
 */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_rng.h>
#include <stdio.h>
#include <stdlib.h>

#include "dynamics/modes.h"
#include "dynamics/state.h"

static void print_values(const double *values, int count)
{
    for (int i = 0; i < count; i++) printf(" %.17g", values[i]);
    printf("\n");
}

static void print_state(struct fbd_state *state)
{
    int n = state->model->plan.n;
    if (!modes_settle(state, NULL)) return;
    state_evaluate(state);
    printf("%.17g", state->t);
    print_values(state->y, 2 * n);
    print_values(state->a, n);
}

/* Around the start; a third of the rates rest, so that friction sticks. */
static void draw(struct fbd_state *state, const struct fbd_state *start, gsl_rng *rng)
{
    int n = state->model->plan.n;
    state_copy(state, start);
    state_set_moment(state, time_dd_at(gsl_rng_uniform(rng)));
    for (int i = 0; i < 2 * n; i++) {
        bool rests = i >= n && gsl_rng_uniform(rng) < 1.0 / 3;
        state->y[i] = rests ? 0 : start->y[i] * (1 + gsl_rng_uniform(rng)) + 2 * gsl_rng_uniform(rng) - 1;
    }
}

int main(int count, char **words)
{
    if (count != 3) return 2;
    gsl_set_error_handler_off();
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_read(words[1], NULL, 0, errors);
    fbd_errors_print(errors, stderr);
    if (!model) return 3;
    struct fbd_state *start = fbd_state_new(model), *state = fbd_state_new(model);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    if (!start || !state || !rng) return 1;
    print_state(start);
    for (int i = 0; i < (int)strtol(words[2], NULL, 10); i++) {
        draw(state, start, rng);
        print_state(state);
    }
    gsl_rng_free(rng);
    fbd_state_free(start);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return 0;
}
