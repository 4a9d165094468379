/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Many groups of bodies: where states before the end are not asked for, their runs are freed there, with the same results.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/text.h"
#include "gallery.h"

#include <stdlib.h>

#define HEAD "fbd: 1\nbodies:\n"

enum { many = 600 };

static char *many_bodies(const char *rest)
{
    struct text text = {0};
    text_add(&text, HEAD);
    for (int i = 0; i < many / 2; i++)
        text_printf(&text,
                    "  p%d: {mass: 1 kg, motion: particle, initial: {vx: %d m/s}, forces: [gravity, {drag: "
                    "{linear: %d N*s/m}}]}\n  o%d: {mass: 1 kg, motion: slide, initial: {x: 1 m}, forces: "
                    "[{spring: {stiffness: %d N/m}}]}\n",
                    i, 1 + i, 1 + i % 7, i, 2 + i);
    text_add(&text, rest);
    assert_false(text.failed);
    return text.data;
}

static int ignore_row(void *context, const char *row, size_t length)
{
    (void)context, (void)row, (void)length;
    return 0;
}

static int stop_later(void *context, const fbd_progress *progress)
{
    (void)context;
    return progress->t > 1;
}

/* With rows every run is kept. */
static struct trial run_many(const char *rest, const fbd_recording *recording)
{
    char *text = many_bodies(rest);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial.result = fbd_simulation_run(trial.simulation, recording);
    assert_non_null(trial.result);
    free(text);
    return trial;
}

static void check_many(struct checks *checks, const struct trial *one, const struct trial *other)
{
    static const char *const names[] = {"t", "p0.x", "p299.vy", "o0.x", "o299.v"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        double a, b;
        assert_true(fbd_state_get(fbd_result_state(one->result), names[i], &a));
        assert_true(fbd_state_get(fbd_result_state(other->result), names[i], &b));
        check_close(checks, names[i], a, b, 0);
    }
    const fbd_energy a = fbd_result_energy(one->result), b = fbd_result_energy(other->result);
    check_close(checks, "work", a.work, b.work, 1e-12 * fabs(b.work));
    check_close(checks, "energy", a.kinetic, b.kinetic, 0);
}

static void runs_of_many_groups_are_freed_at_their_ends(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char *const rests[] = {
        "simulate: {until: 7 s}\n",
        "  ball: {mass: 1 kg, motion: particle, initial: {vy: 20 m/s}, forces: [gravity]}\n"
        "simulate:\n  until: 7 s\n  events: [{name: ground, when: ball.y = 0, stop: true}]\n"};
    for (size_t i = 0; i < 2; i++) {
        struct trial freed = run_many(rests[i], NULL),
                     kept = run_many(rests[i], &(fbd_recording){.csv = ignore_row, .every = 1});
        check_many(&checks, &freed, &kept);
        const fbd_stats stats = fbd_simulation_stats(freed.simulation);
        check_that(&checks, "groups", stats.groups == many + i && stats.linear == many);
        check_that(&checks, "steps", i > 0 || stats.steps == fbd_simulation_stats(kept.simulation).steps);
        trial_close(&freed);
        trial_close(&kept);
    }
    checks_end(&checks);
}

/* Groups that are at the end are integrated again up to the interruption. */
static void an_interruption_among_many_groups_has_one_time(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = run_many("simulate: {until: 7 s}\n", &(fbd_recording){.progress = stop_later});
    assert_int_equal(fbd_result_outcome(trial.result), FBD_INTERRUPTED);
    double t, x;
    assert_true(fbd_state_get(fbd_result_state(trial.result), "t", &t));
    assert_true(fbd_state_get(fbd_result_state(trial.result), "o2.x", &x));
    check_that(&checks, "before the end", t > 1 && t < 7);
    check_close(&checks, "an oscillator then", x, cos(2 * t), 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(runs_of_many_groups_are_freed_at_their_ends),
        cmocka_unit_test(an_interruption_among_many_groups_has_one_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
