/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A ship of 1e9 kg and a buoy of 1 kg on one spring.
 *
 * What makes it hard: the ship moves by 1e-9 m where the buoy moves by 1 m, and its motion has to be as good.
 *
 * Reference, M and m the masses, u the stretch: u = cos(w t) with w^2 = k (1/M + 1/m); the centre of mass
 * stays, so x_ship = m/(M + m) (1 - u) and x_buoy = (m + M u)/(M + m).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double M = 1e9, m = 1, k = 100, until = 20;

static void the_ship_moves_as_well_as_the_buoy(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    double w = sqrt(k * (1 / M + 1 / m)), u = cos(w * until), u_dot = -w * sin(w * until);
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        if (method.order == 1) continue; /* implicit Euler at 1e-5 damps 32 swings by a third */
        struct trial trial = trial_open("hard/mass_ratio.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial)) {
            double ship = fabs(trial_get(&trial, "ship.x") - m / (M + m) * (1 - u)) * M;
            double buoy = fabs(trial_get(&trial, "buoy.x") - (m + M * u) / (M + m));
            double momentum = M * trial_get(&trial, "ship.v") + m * trial_get(&trial, "buoy.v");
            double promise = hard_promise(&trial);
            hard_case(&checks, &trial, "buoy, relative to 1 m", buoy, promise);
            /* The running maximum of its size, which errors count by, is 2 nm, and it starts from zero. */
            hard_case(&checks, &trial, "ship, relative to 1 nm", ship, 2 * promise);
            /* Forces are opposite, and methods are linear: but for roundings in each step nothing is lost. */
            hard_case(&checks, &trial, "momentum, relative to that of one", fabs(momentum) / (m * w),
                      fmax(1e-12, 1e-15 * (double)fbd_simulation_stats(trial.simulation).steps) +
                          (method.implicit || method.order == 12 ? promise : 0));
            check_close(&checks, "speed", trial_get(&trial, "buoy.v"), M / (M + m) * u_dot, w * promise);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_ship_moves_as_well_as_the_buoy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
