/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drives of constant power: the work is P t at any speed, and at rest there is no force to start from.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "run_checks.h"

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

/* A constant push is work, and potential energy where the file says so: on a line, at a pivot, between bodies. */
static void pushes_are_work_unless_asked(void **unused)
{
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int asked = 0; asked < 2; asked++) {
        const char *flag = asked ? ", conservative: true" : "";
        snprintf(text, sizeof text,
                 "fbd: 1\n"
                 "bodies:\n"
                 "  block: {mass: 2, motion: slide, forces: [applied: {value: 5%s}]}\n"
                 "  wheel: {mass: 2, inertia: 0.1, motion: pivot, moments: [applied: {value: 0.3%s}]}\n"
                 "  arm: {mass: 1, inertia: 0.1, motion: {pivot: {on: block}}, moments: [applied: {value: "
                 "0.2%s}]}\n"
                 "simulate: {until: 1}\n",
                 flag, flag, flag);
        struct trial trial = run_of(text);
        double work =
            5 * get(&trial, "block.x") + 0.3 * get(&trial, "wheel.theta") + 0.2 * get(&trial, "arm.theta");
        fbd_energy energy = fbd_result_energy(trial.result);
        check_close(&checks, "work", energy.work, asked ? 0 : work, same);
        check_close(&checks, "potential", energy.potential, asked ? -work : 0, same);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_work_is_power_times_time),
        cmocka_unit_test(at_rest_it_is_refused_by_name),
        cmocka_unit_test(a_brake_of_constant_power_ends_at_rest),
        cmocka_unit_test(pushes_are_work_unless_asked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
