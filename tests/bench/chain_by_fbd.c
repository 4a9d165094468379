/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The chain as a scene: what a stepper calls.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "chain.h"
#include "dynamics/modes.h"
#include "dynamics/rates.h"
#include "fbd.h"

struct chain {
    fbd_model *model;
    struct fbd_state *state;
    struct rates *rates;
    rates_function *function;
    void *params;
};

/* The model text; release it with free(). */
static char *text_of(int n)
{
    char *text = NULL;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    if (!file) return NULL;
    fputs("fbd: 1\nbodies:\n", file);
    for (int i = 1; i <= n; i++) {
        fprintf(file, "  rod%d:\n    shape: rod\n    mass: %.17g kg\n", i, CHAIN_MASS);
        fprintf(file, "    from: [0, 0]\n    to: [0, %.17g m]\n    forces: [gravity]\n", -CHAIN_LENGTH);
        if (i == 1) fputs("    motion: pivot\n", file);
        if (i > 1) fprintf(file, "    motion: {pivot: {on: rod%d, at: right, point: left}}\n", i - 1);
    }
    fclose(file);
    return text;
}

static void chain_close(void *data)
{
    struct chain *chain = data;
    if (!chain) return;
    rates_free(chain->rates);
    state_free(chain->state);
    fbd_model_free(chain->model);
    free(chain);
}

static void *chain_open(int n)
{
    struct chain *chain = calloc(1, sizeof *chain);
    char *text = text_of(n);
    fbd_errors *errors = fbd_errors_new();
    if (chain && text && errors) chain->model = fbd_model_parse(text, strlen(text), "chain", NULL, 0, errors);
    if (errors && fbd_errors_count(errors) > 0) fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    free(text);
    if (chain && chain->model) chain->state = state_new(chain->model);
    if (chain && chain->state && modes_settle(chain->state, NULL))
        chain->rates = rates_new(chain->state, rates_by_rows);
    if (chain && chain->rates) {
        chain->function = rates_call(chain->rates, &chain->params);
        return chain;
    }
    chain_close(chain);
    return NULL;
}

static void chain_rates(void *data, const double *y, double *dydt)
{
    struct chain *chain = data;
    chain->function(0, y, dydt, chain->params);
}

const struct chain_solver chain_by_fbd = {"fbd", chain_open, chain_rates, chain_close};
