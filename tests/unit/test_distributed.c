/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Distributed loads: resultants of random polynomials, of kinks, jumps and tables against their integrals; reactions of
 * beams; a gate against its equation by GSL; a chain that hangs off a table.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "random_numbers.h"
#include "run_checks.h"

static const double digits = 1e-12;

/* The force and its moment about the origin of a rod along x, on a body that does not move. */
static void check_resultant(struct checks *checks, const char *what, const char *value, const char *extra,
                            double from, double to, double force, double moment)
{
    char text[text_room];
    snprintf(text, sizeof text,
             "fbd: 1\n%sbodies:\n  b:\n    {mass: 1, inertia: 1, motion: planar, forces: [distributed: "
             "{name: d, from: "
             "[%.17g, 0], to: [%.17g, 0], value: %s, angle: 90 deg}]}\n",
             extra, from, to, value);
    struct trial trial = trial_parse(text);
    fbd_arrow arrow = arrow_of(&trial, 0, "d");
    check_close(checks, what, arrow.fy, force, digits * (1 + fabs(force)));
    check_close(checks, what, arrow.fx, 0, digits * (1 + fabs(force)));
    check_close(checks, what, arrow.x * arrow.fy, moment, digits * (1 + fabs(moment)));
    trial_close(&trial);
}

/* w = a + b s + c s^2 from x0 on over the length l. */
static void polynomials(void **unused)
{
    struct random_numbers numbers = {41};
    struct checks checks = {0};
    char value[300];
    (void)unused;
    for (int i = 0; i < trials; i++) {
        double a = random_between(&numbers, 1, 5), b = random_between(&numbers, -1, 3),
               c = random_between(&numbers, 0, 2), x0 = random_between(&numbers, -2, 2),
               l = random_between(&numbers, 0.1, 3);
        double F = a * l + b * l * l / 2 + c * l * l * l / 3,
               M = a * l * l / 2 + b * l * l * l / 3 + c * l * l * l * l / 4;
        snprintf(value, sizeof value, "'%.17g[N/m] + %.17g[N/m^2]*s + %.17g[N/m^3]*s^2'", a, b, c);
        check_resultant(&checks, "forth", value, "", x0, x0 + l, F, x0 * F + M);
        check_resultant(&checks, "back", value, "", x0, x0 - l, F, x0 * F - M);
        snprintf(value, sizeof value, "[%.17g, %.17g N/m]", a, b);
        check_resultant(&checks, "trapezoid", value, "", x0, x0 + l, l * (a + b) / 2,
                        x0 * l * (a + b) / 2 + l * l * (a + 2 * b) / 6);
    }
    checks_end(&checks);
}

static void kinks_jumps_and_tables(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    /* |s - 1/3| over [0, 1]: (1/9 + 4/9)/2; its arm by parts 1/162 + 2/9 - 2/81 ... as integrals of powers */
    double a = 1.0 / 3, F = (a * a + (1 - a) * (1 - a)) / 2,
           M = a * a * a / 2 - a * a * a / 3 + (1 - a * a * a) / 3 - a * (1 - a * a) / 2;
    check_resultant(&checks, "kink", "'abs(s - 1[m]/3)*1[N/m^2]'", "", 0, 1, F, M);
    check_resultant(&checks, "jump", "'if(s < 0.7[m], 2[N/m], 5[N/m])'", "", 0, 2, 2 * 0.7 + 5 * 1.3,
                    2 * 0.7 * 0.7 / 2 + 5 * (4 - 0.49) / 2);
    check_resultant(&checks, "root", "'sqrt(s/1[m])*3[N/m]'", "", 0, 1, 2, 3.0 / 2.5);
    check_resultant(&checks, "table", "'f(s)'", "tables: {f: {points: [[0, 0], [1 m, 6 N/m], [3 m, 0]]}}\n",
                    0, 3, 9, 1 * 3 * 2.0 / 3 + 6 * 5.0 / 3);
    checks_end(&checks);
}

static int gate_rates(double t, const double *y, double *dydt, void *context)
{
    const double *p = context; /* p h^3/3 / I, 1/tau, m g h/2 / I */
    dydt[0] = y[1];
    dydt[1] = p[0] * exp(-t * p[1]) - p[2] * cos(y[0]);
    return GSL_SUCCESS;
}

static void a_flood_gate(void **unused)
{
    const double h = 2, m = 300, I = m * h * h / 3;
    double p[3] = {900 * h * h * h / 3 / I, 1 / 1.5, m * g * h / 2 / I}, y[2] = {-acos(0), 0};
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    (void)unused;
    options.tolerance = 1e-12;
    struct trial trial = trial_open("rotation/flood_gate.yaml", NULL);
    trial_run(&trial, &options);
    integrate(gate_rates, p, 2, 3, y);
    check_close(&checks, "theta", get(&trial, "gate.theta"), y[0], same);
    check_close(&checks, "omega", get(&trial, "gate.omega"), y[1], same);
    check_energy(&checks, &trial);
    trial_close(&trial);
    checks_end(&checks);
}

/* The reactions of the parts of the load are those of the model's derivation. */
static void a_loaded_beam(void **unused)
{
    const double l = 4, w0 = 300, w1 = 600, m = 20;
    const double T = (w0 * l * l / 8 + w1 * l / 4 * (l / 2 + l / 3) + m * g * l / 2) / l;
    struct checks checks = {0};
    fbd_arrow arrows[10];
    (void)unused;
    struct trial trial = trial_open("statics/loaded_beam.yaml", NULL);
    fbd_statics *rest = fbd_statics_new(trial.state, NULL);
    assert_non_null(rest);
    size_t count = fbd_statics_diagram(rest, 0, arrows, 10);
    for (size_t i = 0; i < count; i++) {
        if (strcmp(arrows[i].name, "link") == 0) check_close(&checks, "link", arrows[i].fy, T, 1e-9);
        if (strcmp(arrows[i].name, "pin") == 0)
            check_close(&checks, "pin", arrows[i].fy, w0 * l / 2 + w1 * l / 4 + m * g - T, 1e-9);
    }
    check_that(&checks, "all", count == 5);
    fbd_statics_free(rest);
    trial_close(&trial);
    checks_end(&checks);
}

/* x0 cosh(t sqrt(g/l)) is l as the end of the chain leaves the table. */
static void a_chain_slides_off(void **unused)
{
    const double l = 2, x0 = 0.1, rate = sqrt(g / l);
    struct checks checks = {0};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    (void)unused;
    options.tolerance = 1e-12;
    struct trial trial = trial_open("kinetics/chain_off_table.yaml", NULL);
    trial_run(&trial, &options);
    check_close(&checks, "when", get(&trial, "t"), acosh(l / x0) / rate, same);
    check_close(&checks, "speed", get(&trial, "chain.v"), rate * sqrt(l * l - x0 * x0), same);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(polynomials),        cmocka_unit_test(kinks_jumps_and_tables),
        cmocka_unit_test(a_flood_gate),       cmocka_unit_test(a_loaded_beam),
        cmocka_unit_test(a_chain_slides_off),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
