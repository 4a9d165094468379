/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Gears with an efficiency: against the equations of each wheel, by trying both signs of each force of teeth.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "random_numbers.h"
#include "run_checks.h"

enum { most_wheels = 4 };

/* Gear j joins wheels j and j + 1 by the radii first[j] and second[j]: first omega_j + second omega_(j+1) = 0. */
struct train {
    int wheels;
    double I[most_wheels], M[most_wheels], first[most_wheels], second[most_wheels], efficiency[most_wheels],
        omega;
};

static struct train draw_train(struct random_numbers *numbers, int wheels)
{
    struct train train = {.wheels = wheels, .omega = random_between(numbers, -5, 5)};
    for (int i = 0; i < wheels; i++) {
        train.I[i] = random_between(numbers, 0.01, 0.2);
        train.M[i] = random_perhaps(numbers, 0.8, -2, 2);
        train.first[i] = random_between(numbers, 0.05, 0.3);
        train.second[i] = random_between(numbers, 0.05, 0.3);
        train.efficiency[i] = random_chance(numbers, 0.2) ? 1 : random_between(numbers, 0.3, 0.99);
    }
    return train;
}

/* omega_i / omega_0 */
static double ratio(const struct train *train, int i)
{
    double ratio = 1;
    for (int j = 0; j < i; j++) ratio *= -train->first[j] / train->second[j];
    return ratio;
}

/* The force of each gear is F = p + q alpha with the angular acceleration alpha of the first wheel, from the last wheel on:
 * the moment on wheel j is r F (1 - sense kappa sign F), its friction included. `turns`: the sense of rotation of the first
 * wheel. False where the signs of the forces are not those of `signs`. */
static bool solve(const struct train *train, double turns, unsigned signs, double *alpha, double *F)
{
    double p = 0, q = 0, passed = 0, p_of[most_wheels] = {0}, q_of[most_wheels] = {0};
    for (int i = train->wheels - 1; i >= 0; i--) {
        const double rho = ratio(train, i);
        if (i < train->wheels - 1) {
            const double sigma = signs >> i & 1 ? -1 : 1, sense = turns * rho < 0 ? -1 : 1;
            passed = train->first[i] * (1 - sense * sigma * (1 / train->efficiency[i] - 1));
        }
        const double p_next = i < train->wheels - 1 ? p_of[i] : 0,
                     q_next = i < train->wheels - 1 ? q_of[i] : 0;
        p = -train->M[i] - passed * p_next; /* I rho alpha = M + passed F_i + second F_(i-1) */
        q = train->I[i] * rho - passed * q_next;
        if (i > 0) p_of[i - 1] = p / train->second[i - 1], q_of[i - 1] = q / train->second[i - 1];
    }
    *alpha = -p / q;
    bool fits = isfinite(*alpha);
    for (int j = 0; j < train->wheels - 1; j++) {
        F[j] = p_of[j] + q_of[j] * *alpha;
        fits &= (F[j] < 0) == (signs >> j & 1);
    }
    return fits;
}

/* The number of solutions, the last of them in alpha and F. */
static int solutions(const struct train *train, double turns, double *alpha, double *F)
{
    int count = 0;
    for (unsigned signs = 0; signs < 1u << (train->wheels - 1); signs++) {
        double one, forces[most_wheels];
        if (!solve(train, turns, signs, &one, forces)) continue;
        *alpha = one;
        memcpy(F, forces, sizeof forces);
        count++;
    }
    return count;
}

static void write_train(const struct train *train, double until, char *text, size_t size)
{
    double x = 0;
    size_t used = (size_t)snprintf(text, size, "fbd: 1\nbodies:\n");
    for (int i = 0; i < train->wheels; i++) {
        if (i > 0) x += train->first[i - 1] + train->second[i - 1];
        used += (size_t)
            snprintf(text + used, size - used,
                     "  w%d: {mass: 1, inertia: %.17g, motion: {pivot: {at: [%.17g, 0]}}, initial: {omega: "
                     "%.17g}, moments: [applied: {name: M, value: %.17g}]}\n",
                     i, train->I[i], x, train->omega * ratio(train, i), train->M[i]);
    }
    used += (size_t)snprintf(text + used, size - used, "couplings:\n");
    for (int j = 0; j < train->wheels - 1; j++)
        used += (size_t)
            snprintf(text + used, size - used,
                     "  - gear: {name: g%d, between: [w%d, w%d], radii: [%.17g, %.17g], efficiency: %.17g}\n",
                     j, j, j + 1, train->first[j], train->second[j], train->efficiency[j]);
    snprintf(text + used, size - used, "simulate: {until: %.17g}\n", until);
}

/* Before any wheel stops the accelerations are constant. */
static void check_train(struct checks *checks, const struct train *train, int seed)
{
    double alpha, F[most_wheels];
    const double turns = train->omega < 0 ? -1 : 1;
    if (solutions(train, turns, &alpha, F) != 1) return; /* as where friction increases its own force */
    const double stop = alpha * turns < 0 ? -train->omega / alpha : 1, until = fmin(0.1, stop / 2);
    char text[text_room];
    const size_t failed = checks->failed;
    write_train(train, until, text, sizeof text);
    struct trial trial = run_of(text);
    check_close(checks, "omega", get(&trial, "w0.omega"), train->omega + alpha * until,
                same * (fabs(train->omega) + fabs(alpha)));
    for (int j = 0; j < train->wheels - 1; j++) {
        char name[10];
        snprintf(name, sizeof name, "g%d", j);
        const fbd_arrow arrow = arrow_of(&trial, (size_t)j, name);
        check_close(checks, "F", hypot(arrow.fx, arrow.fy), fabs(F[j]), same * (1 + fabs(F[j])));
    }
    check_energy(checks, &trial);
    trial_close(&trial);
    if (checks->failed > failed) printf("with FBD_SEED=%d FBD_SCENES=1:\n%s", seed, text);
}

static void trains_that_turn(void **unused)
{
    const int first = number_of("FBD_SEED", 1), count = number_of("FBD_SCENES", 200);
    struct checks checks = {0};
    (void)unused;
    for (int seed = first; seed < first + count; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        const struct train train = draw_train(&numbers, 2 + seed % (most_wheels - 1));
        check_train(&checks, &train, seed);
    }
    checks_end(&checks);
}

/* A pair at rest: with F = -M_1/r_1' it stays if |M_0 + r_0 F| is at most the limit; else it turns to the side of that sum.
 * Then until it has turned for a while. */
static void pairs_at_rest(void **unused)
{
    const int first = number_of("FBD_SEED", 1), count = number_of("FBD_SCENES", 200);
    struct checks checks = {0};
    (void)unused;
    for (int seed = first; seed < first + count; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct train train = draw_train(&numbers, 2);
        train.omega = 0;
        const double F = -train.M[1] / train.second[0], rest = train.M[0] + train.first[0] * F,
                     limit = (1 / train.efficiency[0] - 1) * train.first[0] * fabs(F);
        double alpha = 0, forces[most_wheels];
        if (fabs(rest) > limit && solutions(&train, rest < 0 ? -1 : 1, &alpha, forces) != 1) continue;
        char text[text_room];
        const size_t failed = checks.failed;
        write_train(&train, 0.1, text, sizeof text);
        struct trial trial = run_of(text);
        check_close(&checks, "omega", get(&trial, "w0.omega"), alpha * 0.1, same * (1 + fabs(alpha)));
        check_energy(&checks, &trial);
        trial_close(&trial);
        if (checks.failed > failed) printf("with FBD_SEED=%d FBD_SCENES=1:\n%s", seed, text);
    }
    checks_end(&checks);
}

/* A worm gear of efficiency 0.4 holds its load by itself, one of 0.6 is driven back with (2 - 1/0.6) of it. */
static void worm_gears(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int k = 0; k < 2; k++) {
        const struct train train = {.wheels = 2,
                                    .I = {0.02, 0.1},
                                    .M = {0, 3},
                                    .first = {0.05},
                                    .second = {0.2},
                                    .efficiency = {k == 0 ? 0.4 : 0.6}};
        char text[text_room];
        write_train(&train, 1, text, sizeof text);
        struct trial trial = run_of(text);
        /* I_0 a_0 = -(2 - 1/eta) r_0 F, I_1 a_1 = M - r_1 F, a_0 = -4 a_1 */
        const double part = (2 - 1 / 0.6) * 0.05, a = 3 / (0.1 + 0.02 * 4 * 0.2 / part);
        check_close(&checks, "omega", get(&trial, "w1.omega"), k == 0 ? 0 : a, same * a);
        check_energy(&checks, &trial);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trains_that_turn),
        cmocka_unit_test(pairs_at_rest),
        cmocka_unit_test(worm_gears),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
