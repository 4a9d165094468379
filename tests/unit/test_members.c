/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two-force members of random trusses, as rods between particles and as bars with pins, against the equations of
 * equilibrium of their joints (LU of GSL); bodies that are no such members.
 *
 * FBD_DRAWS=1000 draws more.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_linalg.h>

#include "fbd_study.h"
#include "random_numbers.h"
#include "rest_checks.h"
#include "thorough.h"

enum { most_joints = 9, most_bars = 2 * (most_joints - 2) };

/* A simple truss: joints 0 and 1 are on the ground, each other one is joined by two bars to earlier joints. */
struct truss {
    size_t joints, bars;
    double p[most_joints][2], load[most_joints][2], tension[most_bars];
    size_t end[most_bars][2];
};

/* The sine of the angle at joint n between its bars to i and k. */
static double sine_at(const struct truss *truss, size_t n, size_t i, size_t k)
{
    const double *p = truss->p[n], *a = truss->p[i], *b = truss->p[k];
    const double ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0], by = b[1] - p[1];
    return (ax * by - ay * bx) / (hypot(ax, ay) * hypot(bx, by));
}

static void draw_joint(struct truss *truss, size_t n, struct random_numbers *numbers)
{
    size_t i, k;
    do {
        for (int c = 0; c < 2; c++) truss->p[n][c] = random_between(numbers, -3, 3);
        i = (size_t)random_between(numbers, 0, (double)n);
        k = (size_t)random_between(numbers, 0, (double)n);
    } while (i == k || !(fabs(sine_at(truss, n, i, k)) > 0.2));
    for (int c = 0; c < 2; c++)
        truss->load[n][c] = random_chance(numbers, 0.3) ? 0 : random_between(numbers, -500, 500);
    truss->end[truss->bars][0] = i;
    truss->end[truss->bars++][1] = n;
    truss->end[truss->bars][0] = k;
    truss->end[truss->bars++][1] = n;
}

/* sum over the bars at joint n of T u + F = 0, u from n to the other end. */
static void solve(struct truss *truss)
{
    const size_t size = truss->bars;
    gsl_matrix *A = gsl_matrix_calloc(size, size);
    gsl_vector *b = gsl_vector_alloc(size), *T = gsl_vector_alloc(size);
    gsl_permutation *order = gsl_permutation_alloc(size);
    int sign;
    for (size_t j = 0; j < size; j++)
        for (int e = 0; e < 2; e++) {
            const size_t n = truss->end[j][e];
            const double *p = truss->p[n], *q = truss->p[truss->end[j][1 - e]];
            for (size_t c = 0; n >= 2 && c < 2; c++)
                gsl_matrix_set(A, 2 * (n - 2) + c, j, (q[c] - p[c]) / hypot(q[0] - p[0], q[1] - p[1]));
        }
    for (size_t i = 0; i < size; i++) gsl_vector_set(b, i, -truss->load[2 + i / 2][i % 2]);
    gsl_linalg_LU_decomp(A, order, &sign);
    gsl_linalg_LU_solve(A, order, b, T);
    for (size_t j = 0; j < size; j++) truss->tension[j] = gsl_vector_get(T, j);
    gsl_matrix_free(A);
    gsl_vector_free(b);
    gsl_vector_free(T);
    gsl_permutation_free(order);
}

static struct truss draw_truss(uint64_t seed)
{
    struct random_numbers numbers = {seed};
    struct truss truss = {.joints = 3 + seed % (most_joints - 2),
                          .p = {{0, 0}, {random_between(&numbers, 1, 4), 0}}};
    for (size_t n = 2; n < truss.joints; n++) draw_joint(&truss, n, &numbers);
    solve(&truss);
    return truss;
}

/* ---- the same as models */

struct writer {
    char text[12000];
    size_t at;
};

#define ADD(to, ...)                                                                                         \
    do {                                                                                                     \
        (to)->at += (size_t)snprintf((to)->text + (to)->at, sizeof(to)->text - (to)->at, __VA_ARGS__);       \
        assert_true((to)->at < sizeof(to)->text);                                                            \
    } while (0)

static void write_ground(struct writer *to, const struct truss *truss)
{
    ADD(to, "fbd: 1\nground: {points: {J0: [0, 0], J1: [%.17g, 0]}}\nbodies:\n", truss->p[1][0]);
}

/* Joints are particles, bars are rods without mass. */
static void write_rods(struct writer *to, const struct truss *truss)
{
    write_ground(to, truss);
    for (size_t n = 2; n < truss->joints; n++)
        ADD(to,
            "  J%zu: {mass: 1, motion: particle, initial: {x: %.17g, y: %.17g}, forces: [applied: {name: F, "
            "value: "
            "[%.17g, %.17g]}]}\n",
            n, truss->p[n][0], truss->p[n][1], truss->load[n][0], truss->load[n][1]);
    ADD(to, "couplings:\n");
    for (size_t j = 0; j < truss->bars; j++)
        ADD(to, "  - rod: {name: b%zu, between: [%sJ%zu, J%zu]}\n", j, truss->end[j][0] < 2 ? "ground." : "",
            truss->end[j][0], truss->end[j][1]);
}

/* The first bar that ends at a joint; its ends are `left` and `right`. */
static size_t owner_of(const struct truss *truss, size_t n, const char **end)
{
    size_t j = 0;
    while (truss->end[j][0] != n && truss->end[j][1] != n) j++;
    *end = truss->end[j][0] == n ? "left" : "right";
    return j;
}

/* Bars are bodies with a pin at each end; the load of a joint acts on its first bar. */
static void write_bars(struct writer *to, const struct truss *truss)
{
    const char *end;
    write_ground(to, truss);
    for (size_t j = 0; j < truss->bars; j++) {
        const double *p = truss->p[truss->end[j][0]], *q = truss->p[truss->end[j][1]];
        ADD(to,
            "  b%zu:\n    {shape: rod, mass: 1, from: [0, 0], to: [%.17g, %.17g], motion: planar, initial: "
            "{x: %.17g, y: %.17g}, forces: [",
            j, q[0] - p[0], q[1] - p[1], p[0], p[1]);
        for (size_t n = 2; n < truss->joints; n++)
            if (owner_of(truss, n, &end) == j)
                ADD(to, "applied: {name: F%zu, value: [%.17g, %.17g], at: %s}, ", n, truss->load[n][0],
                    truss->load[n][1], end);
        ADD(to, "]}\n");
    }
    ADD(to, "couplings:\n");
    for (size_t j = 0; j < truss->bars; j++)
        for (int e = 0; e < 2; e++) {
            const size_t n = truss->end[j][e], owner = owner_of(truss, n, &end);
            if (n < 2)
                ADD(to, "  - pin: {name: p%zu_%d, between: [b%zu.%s, ground.J%zu]}\n", j, e, j,
                    e ? "right" : "left", n);
            else if (owner != j)
                ADD(to, "  - pin: {name: p%zu_%d, between: [b%zu.%s, b%zu.%s]}\n", j, e, j,
                    e ? "right" : "left", owner, end);
        }
}

static fbd_member member(const struct rest *rest, const char *name)
{
    for (size_t i = 0; i < fbd_statics_member_count(rest->statics); i++) {
        const fbd_member one = fbd_statics_member(rest->statics, i);
        if (strcmp(one.name, name) == 0) return one;
    }
    return (fbd_member){.tension = NAN};
}

static void check_members(struct checks *checks, uint64_t seed, fbd_member_kind kind)
{
    const struct truss truss = draw_truss(seed);
    struct writer to = {"", 0};
    (kind == FBD_MEMBER_ROD ? write_rods : write_bars)(&to, &truss);
    struct rest rest = rest_of(trial_parse(to.text));
    double size = 0;
    for (size_t j = 0; j < truss.bars; j++) size = fmax(size, fabs(truss.tension[j]));
    check_that(checks, "in equilibrium", fbd_statics_holds(rest.statics));
    check_that(checks, "all bars are members", fbd_statics_member_count(rest.statics) == truss.bars);
    for (size_t j = 0; j < truss.bars; j++) {
        char name[16], what[60];
        snprintf(name, sizeof name, "b%zu", j);
        snprintf(what, sizeof what, "seed %llu, tension of %s", (unsigned long long)seed, name);
        const fbd_member one = member(&rest, name);
        check_close(checks, what, one.tension, truss.tension[j],
                    1e-10 * size); /* sines above 0.2: condition 1e4 */
        check_that(checks, "its kind", one.kind == kind);
    }
    rest_close(&rest);
}

static void a_truss_of_rods_bears_as_its_joints_say(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < 40 * draws_asked(); i++) check_members(&checks, (uint64_t)i, FBD_MEMBER_ROD);
    checks_end(&checks);
}

static void a_truss_of_bars_with_pins_bears_as_its_joints_say(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int i = 0; i < 40 * draws_asked(); i++) check_members(&checks, (uint64_t)i, FBD_MEMBER_BODY);
    checks_end(&checks);
}

/* A beam on a wall, propped at its middle by a strut without weight from below: moments about the pin of the beam. */
static const char bracket[] =
    "fbd: 1\nbodies:\n"
    "  beam: {shape: rod, mass: 10 kg, length: 4 m, motion: {pivot: {point: left}}, points: {C: [0, 0]},\n"
    "    forces: [gravity, applied: {name: P, value: [0, -1 kN], at: right}]}\n"
    "  strut: {shape: rod, mass: 1 kg, from: [0, 0], to: [2 m, 2 m], motion: {pivot: {at: [0, -2 m], point: "
    "left}}}\n"
    "couplings:\n  - pin: {name: C, between: [strut.right, beam.C]}\n";

static void a_body_with_weight_is_no_member(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct rest rest = rest_of(trial_parse(bracket));
    check_that(&checks, "one member", fbd_statics_member_count(rest.statics) == 1);
    check_close(&checks, "compression of the strut", -member(&rest, "strut").tension,
                (1000 * 4 + 10 * g * 2) / (2 * sin(pi / 4)), rounding);
    rest_close(&rest);
    checks_end(&checks);
}

/* A load along its line, a couple, and a third point make a bar more than a two-force member. */
static void a_bar_with_other_loads_is_no_member(void **unused)
{
    (void)unused;
    static const char *const loads[] = {
        "forces: [distributed: {from: left, to: right, value: 5 N/m, angle: 0 deg}]",
        "moments: [applied: 3 N*m]", "forces: [applied: {value: [1 N, 2 N], at: G}]"};
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof loads / sizeof *loads; i++) {
        char text[400];
        snprintf(
            text, sizeof text,
            "fbd: 1\nground: {points: {C: [2, 1]}}\nbodies:\n  bar: {shape: rod, mass: 1, from: [0, "
            "0], to: [2, 0], motion: {pivot: {point: left}}, %s}\ncouplings:\n  - rod: {name: B, length: 1, "
            "between: [bar.right, ground.C]}\n",
            loads[i]);
        struct rest rest = rest_of(trial_parse(text));
        check_that(&checks, "in equilibrium", fbd_statics_holds(rest.statics));
        check_that(&checks, "the rod alone", fbd_statics_member_count(rest.statics) == 1);
        rest_close(&rest);
    }
    checks_end(&checks);
}

/* Without a statics, or beyond its members. */
static void there_is_no_member_of_nothing(void **unused)
{
    (void)unused;
    assert_int_equal(fbd_statics_member_count(NULL), 0);
    assert_true(isnan(fbd_statics_member(NULL, 0).tension));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_truss_of_rods_bears_as_its_joints_say),
        cmocka_unit_test(a_truss_of_bars_with_pins_bears_as_its_joints_say),
        cmocka_unit_test(a_body_with_weight_is_no_member),
        cmocka_unit_test(a_bar_with_other_loads_is_no_member),
        cmocka_unit_test(there_is_no_member_of_nothing),
    };
    return cmocka_run_group_tests(tests, no_handler, NULL);
}
