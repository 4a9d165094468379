/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A row of parallelograms between cranks of one length on a line of axes (IFToMM benchmark A02 is the row
 * with rods of 1 m: Gonzalez, Dopico, Lugris and Cuadrado, Multibody System Dynamics 16 (2006)).
 *
 * What makes it hard: twice in each turn all rods lie in one line. There one row of each window loses its
 * slope, the windows could fold over, each by itself, and multipliers are quotients of two numbers that
 * vanish. The position is passed in some steps by chance, and in others a stage comes to lie next to it.
 *
 * Reference: all cranks turn alike, as one pendulum does: omega' = -K cos(theta), from which the energy gives
 * omega = -sqrt(omega_0^2 + 2 K (1 - sin(theta))) while it turns clockwise from the top.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <float.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hard.h"

static const double pi = 3.14159265358979323846, g = 9.81;

/* `windows` with rods of 1 kg: cranks of length a on axes L apart, on a line at angle phi. */
struct row_of_windows {
    int windows;
    double a, L, phi, omega;
};

static char *text_of(const struct row_of_windows *row)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    fprintf(out, "fbd: 1\nbodies:\n");
    for (int i = 0; i <= row->windows; i++) {
        fprintf(out, "  v%d: {shape: rod, mass: 1, length: %.17g, motion: {pivot: {at: [%.17g, %.17g], ", i,
                row->a, i * row->L * cos(row->phi), i * row->L * sin(row->phi));
        fprintf(out, "point: left}}, initial: {theta: %.17g rad, omega: %.17g}, forces: [gravity]}\n", pi / 2,
                -row->omega);
        if (i == row->windows) break;
        fprintf(out, "  h%d: {shape: rod, mass: 1, length: %.17g, motion: {pivot: {on: v%d, at: right, ", i,
                row->L, i);
        fprintf(out, "point: left}}, initial: {theta: %.17g rad, omega: %.17g}, forces: [gravity]}\n",
                row->phi - pi / 2, row->omega);
    }
    fprintf(out, "couplings:\n");
    for (int i = 0; i < row->windows; i++)
        fprintf(out, "  - pin: {name: p%d, between: [h%d.right, v%d.right]}\n", i, i, i + 1);
    fprintf(out, "simulate: {until: 10 s}\n");
    fclose(out);
    return text;
}

/* Cranks count with a/2 for their weight and a^2/3 for their inertia, couplers with a and a^2. */
static double stiffness(const struct row_of_windows *row)
{
    double cranks = row->windows + 1, couplers = row->windows;
    return g * (cranks / 2 + couplers) / (row->a * (cranks / 3 + couplers));
}

struct worst {
    double gap, speed; /* how far pins are apart; how far crank 0 is off its speed by the energy */
};

static void look(const struct trial *trial, const struct row_of_windows *row, struct worst *worst)
{
    for (int i = 0; i < row->windows; i++) {
        char v[24], h[24], next[24];
        snprintf(v, sizeof v, "v%d.theta", i);
        snprintf(h, sizeof h, "h%d.theta", i);
        snprintf(next, sizeof next, "v%d.theta", i + 1);
        double a = trial_get(trial, v), b = a + trial_get(trial, h), c = trial_get(trial, next);
        double x = row->a * (cos(a) - cos(c)) + row->L * (cos(b) - cos(row->phi));
        double y = row->a * (sin(a) - sin(c)) + row->L * (sin(b) - sin(row->phi));
        worst->gap = fmax(worst->gap, hypot(x, y));
    }
    double theta = trial_get(trial, "v0.theta"), K = stiffness(row);
    double omega = -sqrt(row->omega * row->omega + 2 * K * (1 - sin(theta)));
    worst->speed = fmax(worst->speed, fabs(trial_get(trial, "v0.omega") / omega - 1));
}

/* Outputs lie in steps as well as at their ends; not for bsimp, whose steps are as long as a turn and whose
 * curve through them is right to 1e-5 in any mechanism. */
static void turn(struct checks *checks, const struct row_of_windows *row, const struct hard_method *method)
{
    int outputs = method->name && strcmp(method->name, "bsimp") == 0 ? 1 : 250;
    char *text = text_of(row);
    assert_non_null(text);
    struct trial trial = trial_parse(text);
    hard_start(&trial, method, NAN);
    struct worst worst = {0, 0};
    for (int k = 1; k <= outputs; k++) {
        trial_to(&trial, 10.0 * k / outputs);
        look(&trial, row, &worst);
    }
    check_that(checks, "it goes round and round", trial_get(&trial, "v0.theta") < -8 * pi);
    hard_case(checks, &trial, "gap of the pins", worst.gap, method->tolerance);
    /* The promise is that of errors that nothing magnifies. Next to the line of all rods a method sees
     * forces that are off by what the state is off, over the slope of the row; and nearer to it than the root
     * of rounding, positions do not tell the branches apart. */
    const double magnified = 100;
    hard_case(checks, &trial, "speed", worst.speed,
              magnified * fmax(hard_promise(&trial), sqrt(DBL_EPSILON)));
    trial_close(&trial);
    free(text);
}

static const struct row_of_windows rows[] = {
    {1, 1, 1, 0, 1}, {8, 1, 1, 0, 1}, {8, 1, 1, 0.3, 1}, {3, 0.5, 2, 0, 3}, {4, 1, 0.7, 1.1, 8},
};

static void rows_of_windows_turn_with_every_method(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r += 4)
        for (size_t i = 0; hard_method_at(i, &method); i++) turn(&checks, &rows[r], &method);
    checks_end(&checks);
}

static void rows_of_windows_turn_at_every_tolerance(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const double tolerances[] = {1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-12};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++)
            turn(&checks, &rows[r], &(struct hard_method){.tolerance = tolerances[i]});
    checks_end(&checks);
}

/* The benchmark: 40 windows, and less than 0.1 J of error. A conservative loop keeps its energy to 1e-8 of
 * what it turns over at 1e-10: the weights of its rods fall by 1 m and 2 m and rise again in each turn. */
static void forty_windows_keep_their_energy(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const struct row_of_windows row = {40, 1, 1, 0, 1};
    const double fall = g * (41 * 1 + 40 * 2);
    static const double tolerances[] = {1e-6, 1e-7, 1e-10};
    for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++) {
        struct hard_method method = {.tolerance = tolerances[i]};
        turn(&checks, &row, &method);
        char *text = text_of(&row);
        assert_non_null(text);
        struct trial trial = trial_parse(text);
        free(text);
        trial_run(&trial, &(fbd_options){.until = 10, .tolerance = tolerances[i]});
        fbd_energy energy = fbd_result_energy(trial.result);
        check_close(&checks, "residual", energy.residual, 0, fmin(0.1, 100 * tolerances[i] * fall));
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_of_windows_turn_with_every_method),
        cmocka_unit_test(rows_of_windows_turn_at_every_tolerance),
        cmocka_unit_test(forty_windows_keep_their_energy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
