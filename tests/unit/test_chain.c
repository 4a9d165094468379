/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Long chains.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dynamics/state.h"
#include "dynamics/tree.h"
#include "random_numbers.h"
#include "random_trees.h"
#include "scenes.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static fbd_model *chain_of(int n)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(out, "fbd: 1\nbodies:\n");
    for (int i = 1; i <= n; i++) {
        fprintf(out, "  rod%d:\n    shape: rod\n    mass: 1 kg\n    from: [0, 0]\n    to: [0, -0.2 m]\n", i);
        fprintf(out, "    forces: [gravity]\n");
        if (i == 1) fprintf(out, "    motion: pivot\n");
        if (i > 1) fprintf(out, "    motion: {pivot: {on: rod%d, at: right, point: left}}\n", i - 1);
    }
    fclose(out);
    fbd_model *model = model_from(text);
    free(text);
    return model;
}

struct rod {
    double dx, dy, omega, alpha, ax, ay; /* from pin to end; absolute rates; the acceleration of the pin */
    double alphas, as;                   /* sizes of what was added up to alpha and to the latter */
};

/* The force in a pin and the moment about it, and sizes of what was added up to them. */
struct sum {
    double fx, fy, moment, fs, moments;
};

/* Newton and Euler for a rod, given its lower pin. */

static struct sum pin_of(const struct rod *rod, struct sum below)
{
    const double m = 1, l = 0.2, g = 9.81;
    double w2 = rod->omega * rod->omega, gx = rod->dx / 2, gy = rod->dy / 2;
    double ax = rod->ax - rod->alpha * gy - w2 * gx, ay = rod->ay + rod->alpha * gx - w2 * gy;
    double fx = m * ax, fy = m * (ay + g);
    double fs = below.fs + m * (rod->as + l * (rod->alphas + w2) + g);
    return (struct sum){below.fx + fx, below.fy + fy,
                        below.moment + rod->dx * below.fy - rod->dy * below.fx + gx * fy - gy * fx +
                            m * l * l / 12 * rod->alpha,
                        fs, below.moments + l * fs};
}

/* The accelerations make the moment in each pin vanish, up to the rounding of what is added up to it. */
static void check_inverse(int n, uint64_t seed)
{
    fbd_model *model = chain_of(n);
    struct fbd_state *state = state_new(model);
    struct rod *rods = calloc((size_t)n, sizeof *rods);
    assert_true(state && rods);
    struct random_numbers numbers = {seed};
    for (int i = 0; i < 2 * n; i++) state->y[i] = random_between(&numbers, -1, 1);
    state_evaluate(state);
    struct rod next = {0};
    double angle = 0;
    for (int i = 0; i < n; i++) {
        angle += state->y[i];
        next.omega += state->y[n + i];
        next.alpha += state->a[i];
        next.alphas += fabs(state->a[i]);
        next.dx = 0.2 * sin(angle);
        next.dy = -0.2 * cos(angle);
        rods[i] = next;
        double w2 = next.omega * next.omega;
        next.ax += -next.alpha * next.dy - w2 * next.dx;
        next.ay += next.alpha * next.dx - w2 * next.dy;
        next.as += 0.2 * (next.alphas + w2);
    }
    struct sum pin = {0};
    double worst = 0;
    for (int i = n - 1; i >= 0; i--) {
        pin = pin_of(&rods[i], pin);
        worst = fmax(worst, fabs(pin.moment) / pin.moments);
    }
    print_message("# %d rods: moments in the pins %.2g of what is added up\n", n, worst);
    assert_true(worst <= DBL_EPSILON);
    free(rods);
    state_free(state);
    fbd_model_free(model);
}

static void forward_and_inverse_dynamics_of_long_chains_agree_to_rounding(void **unused)
{
    (void)unused;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        check_inverse(2, seed);
        check_inverse(64, seed);
        check_inverse(512, seed);
    }
}

static size_t memory_of(int n)
{
    fbd_model *model = chain_of(n);
    size_t bytes = tree_work_size(model);
    fbd_model_free(model);
    return bytes;
}

static void memory_grows_with_the_number_of_rods(void **unused)
{
    (void)unused;
    size_t a = memory_of(128), b = memory_of(256), c = memory_of(512);
    assert_int_equal(c - b, 2 * (b - a));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forward_and_inverse_dynamics_of_long_chains_agree_to_rounding),
        cmocka_unit_test(memory_grows_with_the_number_of_rods),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
