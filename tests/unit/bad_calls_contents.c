/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calls that cannot be meant of the functions of fbd_view.h about files and variables.
 */
#include "bad_calls.h"
#include "fbd_view.h"

void contents(void **context)
{
    (void)context;
    fbd_state *state = fbd_state_new(model);
    fbd_unit unit;
    double value;
    const size_t beyond[] = {past}, of_time[] = {0};
    ANSWERS(fbd_model_variable_count, fbd_model_variable_count(NULL) == 0);
    ANSWERS(fbd_model_variable, !fbd_model_variable(NULL, 0).name);
    ANSWERS(fbd_model_variable, !fbd_model_variable(model, past).unit);
    ANSWERS(fbd_model_variable, is_nan(fbd_model_variable(model, past).start));
    ANSWERS(fbd_state_variables, fbd_state_variables(NULL, &value, 1) == 0);
    ANSWERS(fbd_state_variables, fbd_state_variables(state, NULL, 9) == fbd_model_variable_count(model));
    REFUSES(fbd_state_derivatives, !fbd_state_derivatives(NULL, NULL, 0, NULL, errors));
    REFUSES(fbd_state_derivatives, !fbd_state_derivatives(state, NULL, 1, &value, errors));
    REFUSES(fbd_state_derivatives, !fbd_state_derivatives(state, of_time, 1, NULL, errors));
    REFUSES(fbd_state_derivatives, !fbd_state_derivatives(state, of_time, 1, &value, errors));
    REFUSES(fbd_state_derivatives, !fbd_state_derivatives(state, beyond, 1, &value, errors));
    ANSWERS(fbd_model_file, !fbd_model_file(NULL));
    ANSWERS(fbd_model_data_file_count, fbd_model_data_file_count(NULL) == 0);
    ANSWERS(fbd_model_data_file, !fbd_model_data_file(NULL, 0).path);
    ANSWERS(fbd_model_data_file, !fbd_model_data_file(model, past).table);
    ANSWERS(fbd_model_hash, !fbd_model_hash(NULL));
    ANSWERS(fbd_model_data_hash, !fbd_model_data_hash(NULL, 0));
    ANSWERS(fbd_model_data_hash, !fbd_model_data_hash(model, past));
    ENDURES(fbd_model_options, fbd_model_options(model, NULL, sizeof(fbd_options)));
    fbd_options options;
    ENDURES(fbd_model_options, fbd_model_options(NULL, &options, sizeof options));
    assert_true(is_nan(options.until));
    ANSWERS(fbd_unit_read, !fbd_unit_read(model, NULL, 1, &unit));
    ANSWERS(fbd_unit_read, !fbd_unit_read(model, "N", 1, NULL));
    ANSWERS(fbd_model_entries, fbd_model_entries(NULL, NULL, 0) == 0);
    ANSWERS(fbd_model_entries, fbd_model_entries(model, NULL, 5) == 1);
    ANSWERS(fbd_state_model, !fbd_state_model(NULL));
    ANSWERS(fbd_simulation_outcome, fbd_simulation_outcome(NULL) == FBD_FAILED);
    fbd_state_free(state);
}
