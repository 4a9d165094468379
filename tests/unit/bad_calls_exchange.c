/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls of fbd_exchange.h that cannot be meant.
 */
#include "bad_calls.h"
#include "fbd_exchange.h"

void exchanges(void **context)
{
    (void)context;
    double numbers[2] = {0}, next, t;
    fbd_state *foreign = fbd_state_new(other);
    REFUSES(fbd_model_exchanges, !fbd_model_exchanges(NULL, errors));
    REFUSES(fbd_exchange_new, !fbd_exchange_new(NULL, NULL, errors));
    ENDURES(fbd_exchange_free, fbd_exchange_free(NULL));
    ANSWERS(fbd_exchange_number_count, fbd_exchange_number_count(NULL) == 0);
    ANSWERS(fbd_exchange_indicator_count, fbd_exchange_indicator_count(NULL) == 0);
    ENDURES(fbd_exchange_set, fbd_exchange_set(NULL, 0, numbers));
    ENDURES(fbd_exchange_get, fbd_exchange_get(NULL, &t, numbers));
    assert_true(is_nan(t));
    ANSWERS(fbd_exchange_derivatives, !fbd_exchange_derivatives(NULL, numbers));
    ENDURES(fbd_exchange_indicators, fbd_exchange_indicators(NULL, numbers));
    ANSWERS(fbd_exchange_complete, !fbd_exchange_complete(NULL));
    ANSWERS(fbd_exchange_update, fbd_exchange_update(NULL, &next) == FBD_FAILED && is_nan(next));
    ANSWERS(fbd_exchange_outcome, fbd_exchange_outcome(NULL) == FBD_FAILED);
    ANSWERS(fbd_exchange_reason, strcmp(fbd_exchange_reason(NULL), "") == 0);
    fbd_state *state = fbd_state_new(model);
    fbd_exchange *exchange = fbd_exchange_new(state, NULL, NULL);
    assert_non_null(exchange);
    ANSWERS(fbd_exchange_state, !fbd_exchange_state(exchange, foreign) && !fbd_exchange_state(NULL, state));
    REFUSES(fbd_exchange_set_input, !fbd_exchange_set_input(NULL, "F", 1, errors));
    REFUSES(fbd_exchange_set_input, !fbd_exchange_set_input(exchange, NULL, 1, errors));
    REFUSES(fbd_exchange_set_input, !fbd_exchange_set_input(exchange, "F", NAN, errors));
    fbd_exchange_free(exchange);

    fbd_force_columns *columns = fbd_force_columns_new(model);
    assert_non_null(columns);
    ANSWERS(fbd_force_columns_new, !fbd_force_columns_new(NULL));
    ENDURES(fbd_force_columns_free, fbd_force_columns_free(NULL));
    ANSWERS(fbd_force_columns_count, fbd_force_columns_count(NULL) == 0);
    ANSWERS(fbd_force_columns_name,
            !fbd_force_columns_name(NULL, 0) && !fbd_force_columns_name(columns, past));
    ANSWERS(fbd_force_columns_unit,
            !fbd_force_columns_unit(NULL, 0) && !fbd_force_columns_unit(columns, past));
    ANSWERS(fbd_force_columns_kind, fbd_force_columns_kind(NULL, 0) == FBD_COLUMN_FORCE &&
                                        fbd_force_columns_kind(columns, past) == FBD_COLUMN_FORCE);
    fbd_simulation *simulation = fbd_simulation_new(other, NULL, NULL);
    assert_non_null(simulation);
    ANSWERS(fbd_force_columns_follow, !fbd_force_columns_follow(NULL, simulation) &&
                                          !fbd_force_columns_follow(columns, NULL) &&
                                          !fbd_force_columns_follow(columns, simulation));
    fbd_simulation_free(simulation);
    ANSWERS(fbd_force_columns_values, !fbd_force_columns_values(columns, foreign, numbers) &&
                                          !fbd_force_columns_values(NULL, state, numbers));
    fbd_force_columns_free(columns);
    fbd_state_free(state);
    fbd_state_free(foreign);
}
