/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drives of constant power: the work is P t at any speed, and at rest there is no force to start from.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

#include <string.h>

static void the_work_is_power_times_time(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const struct {
        const char *path, *body, *name;
        double work;
    } drives[] = {{"kinetics/constant_power.yaml", "car", "engine", 60e3 * 10},
                  {"rotation/flywheel_drive.yaml", "flywheel", "motor", 2e3 * 5}};
    for (size_t i = 0; i < sizeof drives / sizeof *drives; i++) {
        struct trial trial = trial_open(drives[i].path, NULL);
        trial_run(&trial, NULL);
        check_that(&checks, drives[i].path, trial.outcome == FBD_DONE);
        /* 100 tolerances of a step, 1e-10 */
        check_close(&checks, drives[i].path, fbd_result_work(trial.result, drives[i].body, drives[i].name),
                    drives[i].work, 1e-8 * drives[i].work);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static const char *reason_of_start(const char *path, const char *setting, char *reason, size_t size)
{
    struct trial trial = trial_open(path, SET(setting));
    trial_start(&trial, NULL);
    snprintf(reason, size, "%s", fbd_simulation_reason(trial.simulation));
    trial_close(&trial);
    return reason;
}

static void at_rest_it_is_refused_by_name(void **unused)
{
    (void)unused;
    char reason[400];
    assert_non_null(strstr(reason_of_start("kinetics/constant_power.yaml", "v0=0 m/s", reason, sizeof reason),
                           "`engine` on `car`, which is P/v and infinite at rest"));
    assert_non_null(
        strstr(reason_of_start("rotation/flywheel_drive.yaml", "start=0 rad/s", reason, sizeof reason),
               "`motor` on `flywheel`, which is P/omega and infinite at rest"));
}

static void a_brake_of_constant_power_ends_at_rest(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("kinetics/constant_power.yaml", SET("P=-60 kW"));
    trial_run(&trial, NULL);
    check_that(&checks, "it does not go on", trial.outcome == FBD_FAILED || trial.outcome == FBD_BROKEN);
    check_that(&checks, "it says what", strstr(fbd_simulation_reason(trial.simulation), "`car`") != NULL);
    /* v^2 = v0^2 - 2 P t/m is 0 at t = m v0^2/(2 P); to a thousandth, far from rounding */
    double t = 1200 * 25 / (2 * 60e3);
    double end = NAN;
    fbd_state_get(fbd_result_state(trial.result), "t", &end);
    check_close(&checks, "when it comes to rest", end, t, 1e-3 * t);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_work_is_power_times_time),
        cmocka_unit_test(at_rest_it_is_refused_by_name),
        cmocka_unit_test(a_brake_of_constant_power_ends_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
