/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: integration by another program (loop/exchange.h).
 */
#include "loop/exchange.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "api/set_input.h"
#include "base/api_check.h"
#include "base/diag.h"
#include "fbd_exchange.h"
#include "loop/options.h"

struct fbd_exchange {
    struct exchange exchange;
};

static bool exchanges(const fbd_model *model, fbd_errors *errors)
{
    struct text words = {0};
    const bool lacks = exchange_lack(model, &words);
    if (words.failed) diag_out_of_memory(errors);
    if (lacks && !words.failed)
        diag_add(errors, FBD_ERROR, "no-exchange", (struct pos){0, 0}, "use co-simulation",
                 "%s, which no event indicator shows: no other program can integrate this scene", words.data);
    text_free(&words);
    return !lacks;
}

bool fbd_model_exchanges(const fbd_model *model, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    if (!model) api_refuse(errors, "there is no model");
    const bool fine = model && exchanges(model, errors);
    diag_end(&call);
    return fine;
}

static fbd_exchange *make(const fbd_state *state, const fbd_options *options, fbd_errors *errors)
{
    struct run_options chosen;
    if (!exchanges(state->model, errors) || !options_choose(state->model, options, &chosen, errors))
        return NULL;
    fbd_exchange *exchange = calloc(1, sizeof *exchange);
    if (exchange && exchange_init(&exchange->exchange, state, &chosen)) return exchange;
    fbd_exchange_free(exchange);
    diag_out_of_memory(errors);
    return NULL;
}

fbd_exchange *fbd_exchange_new(const fbd_state *state, const fbd_options *options, fbd_errors *list)
{
    fbd_options own = FBD_OPTIONS_DEFAULT;
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_exchange *exchange = NULL;
    if (!state)
        api_refuse(errors, "there is no state");
    else if (api_take_options(&own, sizeof own, options, errors))
        exchange = make(state, &own, errors);
    diag_end(&call);
    return exchange;
}

void fbd_exchange_free(fbd_exchange *exchange)
{
    if (!exchange) return;
    exchange_free(&exchange->exchange);
    free(exchange);
}

size_t fbd_exchange_number_count(const fbd_exchange *exchange)
{
    return exchange ? plan_size(&exchange->exchange.run->model->plan) : 0;
}

size_t fbd_exchange_indicator_count(const fbd_exchange *exchange)
{
    return exchange ? exchange->exchange.run->search.moving.count : 0;
}

void fbd_exchange_set(fbd_exchange *exchange, double t, const double *numbers)
{
    if (exchange && numbers) exchange_put(&exchange->exchange, t, numbers);
}

void fbd_exchange_get(const fbd_exchange *exchange, double *t, double *numbers)
{
    if (t) *t = exchange ? exchange->exchange.run->state->t : NAN;
    if (exchange && numbers)
        memcpy(numbers, exchange->exchange.run->state->y,
               fbd_exchange_number_count(exchange) * sizeof *numbers);
}

static bool set_input(struct exchange *exchange, const char *name, double value, fbd_errors *errors)
{
    const size_t input = settable_input(exchange->run->model->scene, name, errors);
    if (input == SIZE_MAX) return false;
    exchange_set_input(exchange, input, value);
    return true;
}

bool fbd_exchange_set_input(fbd_exchange *exchange, const char *name, double value, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    const bool meant = exchange && name && isfinite(value);
    if (!meant) api_refuse(errors, "there is no motion or no name of an input, or its value is not finite");
    const bool set = meant && set_input(&exchange->exchange, name, value, errors);
    diag_end(&call);
    return set;
}

bool fbd_exchange_derivatives(fbd_exchange *exchange, double *derivatives)
{
    double probe = 0; /* zero unless one is not finite */
    if (!exchange || !derivatives) return false;
    exchange_slopes(&exchange->exchange, derivatives);
    for (size_t i = 0; i < fbd_exchange_number_count(exchange); i++) probe += 0 * derivatives[i];
    return probe == 0;
}

void fbd_exchange_indicators(fbd_exchange *exchange, double *indicators)
{
    if (exchange && indicators) exchange_functions(&exchange->exchange, indicators);
}

bool fbd_exchange_complete(fbd_exchange *exchange)
{
    return exchange && exchange_complete(&exchange->exchange);
}

fbd_outcome fbd_exchange_update(fbd_exchange *exchange, double *next)
{
    double own = NAN;
    if (exchange) exchange_update(&exchange->exchange, &own);
    if (next) *next = own;
    return fbd_exchange_outcome(exchange);
}

fbd_outcome fbd_exchange_outcome(const fbd_exchange *exchange)
{
    return exchange ? exchange->exchange.run->end.outcome : FBD_FAILED;
}

const char *fbd_exchange_reason(const fbd_exchange *exchange)
{
    return exchange ? exchange->exchange.run->end.reason : "";
}

bool fbd_exchange_state(fbd_exchange *exchange, fbd_state *state)
{
    if (!exchange || !state || state->model != exchange->exchange.run->model) return false;
    state_copy(state, exchange->exchange.run->state);
    state->settled = true;
    state_evaluate(state);
    return true;
}
