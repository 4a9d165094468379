/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Studies of cost and of effects with memory that runs out at one allocation after the other: no crash, no
 * leak, and no table that looks whole but is not.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "fbd_study.h"
#include "memory_calls.h"

static const char text[] = "fbd: 1\n"
                           "bodies:\n"
                           "  block:\n"
                           "    mass: 2 kg\n"
                           "    motion: slide\n"
                           "    initial: {v: 1 m/s}\n"
                           "    forces: [gravity, normal, {friction: 0.3}]\n"
                           "simulate: {until: 0.1 s}\n";

enum { stride = 40 };

/* What is written of a study that was made with memory: the reference needs bsimp and msadams, and those of
 * GSL 2.7.1 do not survive a failed allocation (see test_stepper_memory.c). */
static fbd_cost *studied;

static bool write_cost(void)
{
    return some(fbd_cost_text(studied)) && some(fbd_cost_csv(studied)) && some(fbd_cost_json(studied)) &&
           some(fbd_cost_svg(studied));
}

static bool study_effects(void)
{
    fbd_errors *errors;
    fbd_model *model = load(text, &errors);
    if (!model) return false;
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.budget = 2e-3;
    fbd_effects *effects = fbd_effects_new(model, &options, errors);
    bool done = effects && some(fbd_effects_text(effects)) && some(fbd_effects_csv(effects)) &&
                some(fbd_effects_json(effects));
    fbd_effects_free(effects);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return done;
}

static void a_study_of_cost_is_written_whole_or_not_at_all(void **unused)
{
    (void)unused;
    fbd_errors *errors;
    fbd_model *model = load(text, &errors);
    assert_non_null(model);
    fbd_cost_options options = FBD_COST_OPTIONS_DEFAULT;
    options.budget = 0.2;
    studied = fbd_cost_new(model, &options, errors);
    assert_non_null(studied);
    fail_each(write_cost, stride);
    fbd_cost_free(studied);
    fbd_model_free(model);
    fbd_errors_free(errors);
}

static void a_study_of_effects_without_memory_fails_and_leaks_nothing(void **unused)
{
    (void)unused;
    fail_each(study_effects, stride);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_study_of_cost_is_written_whole_or_not_at_all),
        cmocka_unit_test(a_study_of_effects_without_memory_fails_and_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
