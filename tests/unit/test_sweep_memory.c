/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweeps when memory runs out, and how much of it they take.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "fail_alloc.h"
#include "fbd.h"
#include "fbd_study.h"
#include "thorough.h"

static const char text[] = "fbd: 1\n"
                           "parameters: {mu: 0.3, k: 4 N/m}\n"
                           "bodies:\n"
                           "  block:\n"
                           "    mass: 2 kg\n"
                           "    motion: slide\n"
                           "    initial: {v: 1 m/s}\n"
                           "    forces:\n"
                           "      - gravity\n"
                           "      - normal\n"
                           "      - friction: mu\n"
                           "      - applied: {value: '-k*x*step(t - 0.1[s])'}\n"
                           "    hand: 'm*v_dot = -k*x*step(t - 0.1[s]) - mu*m*g*sign(v)'\n"
                           "simulate: {until: 0.4 s, events: [{name: mark, when: 'x = 0.05[m]'}]}\n";

/* Its runs go abreast. */
static const char pendulum[] = "fbd: 1\n"
                               "parameters: {theta0: 1 rad}\n"
                               "bodies:\n"
                               "  b: {mass: 1, center: [0, -1], motion: pivot, initial: {theta: theta0}, "
                               "forces: [gravity]}\n"
                               "simulate: {until: 3 s}\n";

static const char rod[] =
    "fbd: 1\n"
    "parameters: {L: 1 m}\n"
    "bodies:\n"
    "  b: {shape: rod, mass: 1, length: L, motion: {pivot: {point: left}}, forces: [gravity]}\n"
    "simulate: {until: 0.1 s}\n";

enum { most_bytes = 2000 };

struct table {
    char rows[most_bytes];
    size_t length;
};

static int keep(void *context, const char *rows, size_t length)
{
    struct table *table = context;
    assert_true(table->length + length < most_bytes);
    memcpy(table->rows + table->length, rows, length);
    table->length += length;
    return 0;
}

static int drop(void *context, const char *rows, size_t length)
{
    (void)context, (void)rows, (void)length;
    return 0;
}

/* True when it says that it made all rows. */
static bool sweep_scene(const char *scene, const char *vary, const char *outputs, fbd_write *write,
                        void *context)
{
    const fbd_sweep_plan plan = {
        .vary = &vary, .vary_count = 1, .outputs = &outputs, .output_count = 1, .seed = 1};
    fbd_errors *errors = fbd_errors_new();
    fbd_sweep *sweep = errors ? fbd_sweep_parse(scene, strlen(scene), "test", &plan, errors) : NULL;
    bool said = !errors || sweep || fbd_errors_failed_count(errors) > 0, done = false;
    assert_true(said);
    if (sweep) {
        const fbd_sweep_work work = {.end = fbd_sweep_run_count(sweep),
                                     .jobs = 1,
                                     .write = write,
                                     .write_context = context};
        done = fbd_sweep_run(sweep, &work, NULL) == FBD_SWEEP_DONE;
    }
    fbd_sweep_free(sweep);
    fbd_errors_free(errors);
    return done;
}

static bool sweep_all(const char *vary, fbd_write *write, void *context)
{
    return sweep_scene(text, vary, "final,times,energy,max(x)", write, context);
}

static void fail_each(const char *scene, const char *vary, const char *outputs)
{
    struct table whole = {.length = 0};
    assert_true(sweep_scene(scene, vary, outputs, keep, &whole));
    for (size_t n = 0;; n += thorough() ? 1 : 1 + n / 50) {
        struct table table = {.length = 0};
        fail_alloc_at(n);
        bool done = sweep_scene(scene, vary, outputs, keep, &table);
        bool failed = fail_alloc_end();
        bool right = table.length == whole.length && memcmp(table.rows, whole.rows, whole.length) == 0;
        if (done && !right)
            print_error("allocation %zu fails:\n%.*s\nfor\n%.*s\n", n, (int)table.length, table.rows,
                        (int)whole.length, whole.rows);
        assert_true(!done || right);
        if (!failed) {
            assert_true(done && right);
            return;
        }
    }
}

static void no_allocation_that_fails_makes_a_wrong_row(void **state)
{
    (void)state;
    fail_each(text, "mu=0.1,0.3", "final,times,energy,max(x)");
    fail_each(pendulum, "theta0=0.1:3:9", "final,steps");
    fail_each(rod, "L=1,2", "max(M(b, L/3)),V(right)");
}

static void memory_does_not_grow_with_the_number_of_runs(void **state)
{
    (void)state;
    const char *const many[] = {"mu=0.1:0.6:100", "mu=0.1:0.6:10000", "mu=uniform(0.1,0.6):100",
                                "mu=uniform(0.1,0.6):10000"},
                      *const fewer[] = {"mu=0.1:0.6:100", "mu=0.1:0.6:1000", "mu=uniform(0.1,0.6):100",
                                        "mu=uniform(0.1,0.6):1000"},
                      *const *vary = thorough() ? many : fewer;
    long peak[4];
    for (int i = 0; i < 4; i++) {
        alloc_peak_start();
        assert_true(sweep_all(vary[i], drop, NULL));
        peak[i] = alloc_peak();
    }
    /* The runs need the same blocks; malloc may make one a little larger than was asked for. */
    const long loose = peak[0] / 200;
    assert_in_range(peak[1], peak[0] - loose, peak[0] + loose);
    assert_in_range(peak[3], peak[2] - loose, peak[2] + loose);
    assert_in_range(peak[1], 1, 1000000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_allocation_that_fails_makes_a_wrong_row),
        cmocka_unit_test(memory_does_not_grow_with_the_number_of_runs),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
