/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The rows of a run as numbers: what the CSV says to the last bit, whether both are written or the numbers
 * alone; and the same states by a simulation that goes through the same steps again.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fbd_study.h"
#include "gallery.h"
#include "rows.h"
#include "scenes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The header line, made from the heads. */
static void check_heads(const fbd_table *table, const char **at)
{
    for (size_t i = 0; i < table->columns; i++) {
        char head[300];
        int length = snprintf(head, sizeof head, "%s [%s]%c", table->heads[i].name, table->heads[i].unit,
                              i + 1 < table->columns ? ',' : '\n');
        assert_memory_equal(*at, head, (size_t)length);
        *at += length;
    }
}

/* The field of an error that is not known is empty. */
static void check_field(const char **at, double value, char end)
{
    if (**at == end) {
        assert_true(isinf(value));
    } else {
        char *after;
        double read = strtod(*at, &after);
        assert_true(read == value); /* CSV has no sign of zero */
        *at = after;
    }
    assert_int_equal(**at, end);
    ++*at;
}

static void check_rows(const fbd_table *table, const char *csv)
{
    const char *at = csv;
    const double *value = table->values;
    check_heads(table, &at);
    for (size_t row = 0; row < table->rows; row++)
        for (size_t i = 0; i < table->columns; i++)
            check_field(&at, *value++, i + 1 < table->columns ? ',' : '\n');
    assert_int_equal(*at, '\0');
    assert_true(table->rows > 1);
}

static void check_states(const fbd_model *model, fbd_simulation *run, const fbd_table *table)
{
    fbd_simulation *again = fbd_simulation_again(run, false, NULL);
    fbd_state *state = fbd_state_new(model);
    double from, to;
    assert_true(again && state);
    for (size_t row = 0; row < table->rows; row++) {
        double t = table->values[row * table->columns];
        fbd_outcome outcome = FBD_GOING;
        fbd_simulation_interval(again, &from, &to);
        for (; to < t && outcome == FBD_GOING; fbd_simulation_interval(again, &from, &to))
            outcome = fbd_simulation_advance(again);
        assert_true(fbd_simulation_state(again, t, state));
        for (size_t i = 1; i < table->columns; i++) {
            double value;
            if (!fbd_state_get(state, table->heads[i].name, &value)) continue;
            assert_true(value == table->values[row * table->columns + i]);
        }
    }
    fbd_state_free(state);
    fbd_simulation_free(again);
}

static void check_recording(const fbd_model *model, const fbd_options *options, bool ledger)
{
    struct rows rows = {0};
    const fbd_recording both = {.ledger = ledger, .csv = append, .csv_context = &rows, .table = true};
    const fbd_recording alone = {.ledger = ledger, .table = true};
    fbd_simulation *first = fbd_simulation_new(model, options, NULL);
    fbd_simulation *second = fbd_simulation_new(model, options, NULL);
    fbd_result *with = fbd_simulation_run(first, &both), *without = fbd_simulation_run(second, &alone);
    assert_true(with && without);
    fbd_table table = fbd_result_table(with);
    check_rows(&table, rows.text);
    table = fbd_result_table(without);
    check_rows(&table, rows.text);
    check_states(model, second, &table);
    fbd_result_free(with);
    fbd_result_free(without);
    fbd_simulation_free(first);
    fbd_simulation_free(second);
    free(rows.text);
}

static void numbers_are_those_of_the_csv(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < all_scenes_count; i++) {
        fbd_model *model = model_from(all_scenes[i].text);
        fbd_options options = FBD_OPTIONS_DEFAULT;
        for (int bars = 0; bars < 2; bars++) {
            options.error_bars = bars;
            for (int ledger = 0; ledger < 2; ledger++) check_recording(model, &options, ledger);
        }
        fbd_model_free(model);
    }
}

static void they_are_of_the_run_that_reached_the_accuracy(void **unused)
{
    (void)unused;
    struct trial trial = trial_open("hard/stick_slip_belt.yaml", NULL);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.accuracy = 1e-7;
    check_recording(trial.model, &options, true);
    trial_close(&trial);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_those_of_the_csv),
        cmocka_unit_test(they_are_of_the_run_that_reached_the_accuracy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
