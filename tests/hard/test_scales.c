/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The same oscillator with 1e-9, 1 and 1e12 kg in one run, and in SI and US units (case D06).
 *
 * What makes it hard: an error control with an absolute tolerance in metres or newtons is wrong for one of
 * them.
 *
 * Reference: x/x0 = exp(-zeta w t) (cos(wd t) + zeta/sqrt(1 - zeta^2) sin(wd t)), w = 10 rad/s, zeta = 0.05.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

#include <string.h>

static const double w = 10, zeta = 0.05, until = 3;

static double exact(void)
{
    double damped = sqrt(1 - zeta * zeta);
    return exp(-zeta * w * until) * (cos(w * damped * until) + zeta / damped * sin(w * damped * until));
}

static void three_sizes_in_one_run(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    check_close(&checks, "D06.U_x_3", exact(), 0.0150297951867667, 1e-15);
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/scales.yaml", NULL);
        fbd_options together = FBD_OPTIONS_DEFAULT; /* one stepper and one error control for all three */
        together.method = method.name;
        together.tolerance = method.tolerance;
        together.no_structure = true;
        trial_start(&trial, &together);
        if (hard_done(&checks, &trial)) {
            double small = trial_get(&trial, "small.x") / 1e-6, unit = trial_get(&trial, "unit.x");
            double large = trial_get(&trial, "large.x") / 1e3;
            hard_case(&checks, &trial, "x/x0", fabs(unit - exact()), hard_promise(&trial));
            /* The numbers differ by factors that are not powers of two, so they round differently in each
             * step. */
            double roundings = 1e-15 * (double)fbd_simulation_stats(trial.simulation).steps + 1e-14;
            hard_case(&checks, &trial, "1e-9 kg against 1 kg", fabs(small - unit), roundings);
            hard_case(&checks, &trial, "1e12 kg against 1 kg", fabs(large - unit), roundings);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Where a quotient of error and tolerance is close to a threshold, a rounding decides on an order or a step,
 * and the two runs part: then they agree to the tolerance only. So it is with msadams; and bsimp decides on
 * its order by the cost. */
static bool same_steps(const struct trial *a, const struct trial *b)
{
    fbd_stats one = fbd_simulation_stats(a->simulation), other = fbd_simulation_stats(b->simulation);
    return one.steps == other.steps && one.rhs == other.rhs && strcmp(one.method, "bsimp") != 0;
}

static void metres_and_feet_give_the_same_digits(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial si = trial_open("hard/scales.yaml", NULL), us = trial_open("hard/scales_us.yaml", NULL);
        hard_start(&si, &method, NAN);
        hard_start(&us, &method, NAN);
        if (hard_done(&checks, &si) && hard_done(&checks, &us))
            hard_case(&checks, &us, "US against SI",
                      fabs(0.3048 * trial_get(&us, "unit.x") - trial_get(&si, "unit.x")),
                      same_steps(&si, &us) ? 1e-15 * (double)fbd_simulation_stats(us.simulation).steps + 1e-14
                                           : hard_promise(&us));
        trial_close(&si);
        trial_close(&us);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_sizes_in_one_run),
        cmocka_unit_test(metres_and_feet_give_the_same_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
