/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Runs in lanes have the bits that they have alone, after every stretch that they make there, and all that they go by is
 * what it is alone.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "base/sine.h"
#include "batch/batch.h"
#include "integrate/stepper_state_view.h"
#include "loop/options.h"
#include "random_numbers.h"
#include "scenes.h"

static const unsigned seed = 1738;

/* ---- runs, and twins of them that are never in a lane */

struct twins {
    fbd_model *model;
    struct arena memory; /* of both runs */
    struct run *run, *alone;
    char text[900], told[120];
    unsigned long abreast; /* steps in lanes */
};

static struct run *start(const fbd_model *model, const fbd_options *given, struct arena *memory)
{
    struct run_options options;
    fbd_errors *errors = fbd_errors_new();
    assert_true(errors && options_choose(model, given, &options, errors));
    fbd_errors_free(errors);
    struct run *run = run_new(model, &options, NULL, memory);
    assert_non_null(run);
    return run;
}

static void open_twins(struct twins *twins, const char *text, const fbd_options *options)
{
    *twins = (struct twins){0};
    snprintf(twins->text, sizeof twins->text, "%s", text);
    snprintf(twins->told, sizeof twins->told, "tolerance %.17g until %.17g", options->tolerance,
             options->until);
    twins->model = model_from(text);
    twins->run = start(twins->model, options, &twins->memory);
    twins->alone = start(twins->model, options, &twins->memory);
}

static void close_twins(struct twins *twins)
{
    run_free(twins->run);
    run_free(twins->alone);
    arena_free(&twins->memory);
    fbd_model_free(twins->model);
}

static void check_bits(const struct twins *twins, const char *what, const void *a, const void *b, size_t size)
{
    double x[2] = {0};
    if (memcmp(a, b, size) == 0) return;
    if (size == sizeof(double)) memcpy(&x[0], a, size), memcpy(&x[1], b, size);
    fail_msg("seed %u: %s differs at t = %.17g (%.17g and %.17g): %s\n%s", seed, what, twins->run->state->t,
             x[0], x[1], twins->told, twins->text);
}

#define CHECK(what) check_bits(twins, #what, &run->what, &alone->what, sizeof run->what)

static void compare(const struct twins *twins)
{
    struct run *run = twins->run, *alone = twins->alone;
    const size_t n = (size_t)run->model->plan.n, state = 2 * n * sizeof(double);
    CHECK(state->t);
    CHECK(state->rest);
    CHECK(step.h);
    CHECK(step.crawl);
    CHECK(step.restart);
    CHECK(roundoff.since);
    CHECK(roundoff.pause);
    CHECK(system.rhs);
    CHECK(stale);
    CHECK(end.outcome);
    check_bits(twins, "the state", run->state->y, alone->state->y, state);
    check_bits(twins, "its copy", run->work.y, alone->work.y, state);
    check_bits(twins, "its slope", run->work.f, alone->work.f, state);
    check_bits(twins, "the largest state", run->recent.anchor + 2 * n, alone->recent.anchor + 2 * n, state);
    const struct stepper_counts counts = switcher_counts(run->stepper),
                                of_alone = switcher_counts(alone->stepper);
    assert_int_equal(counts.accepted, of_alone.accepted);
    assert_int_equal(counts.last, of_alone.last);
    assert_memory_equal(counts.rejected, of_alone.rejected, sizeof counts.rejected);
    struct stepper_state_view view, lent_alone;
    memset(&view, 0, sizeof view);
    memset(&lent_alone, 0, sizeof lent_alone);
    const bool lends = switcher_lend(run->stepper, &view);
    assert_int_equal(lends, switcher_lend(alone->stepper, &lent_alone));
    if (lends) check_bits(twins, "what it goes by", &view, &lent_alone, sizeof view);
}

static unsigned long steps_of(const struct run *run)
{
    return switcher_counts(run->stepper).accepted;
}

/* The twin makes as many steps alone. */
static void follow(struct twins *twins, unsigned long before)
{
    twins->abreast += steps_of(twins->run) - before;
    while (steps_of(twins->alone) < steps_of(twins->run)) run_advance(twins->alone);
    compare(twins);
}

static void advance_both(struct twins *twins)
{
    run_advance(twins->run);
    run_advance(twins->alone);
    compare(twins);
}

/* ---- batches of them */

struct tally {
    unsigned long abreast, all; /* steps */
    unsigned long runs;
};

/* Runs as `open_next` has them, until it has no more; a lane that becomes empty gets the next one. */
typedef bool open_next(struct twins *twins, void *context);

static void enter(struct batch *batch, unsigned lane, struct twins *twins, unsigned long *before)
{
    while (twins->run->end.outcome == FBD_GOING && !batch_put(batch, lane, twins->run)) advance_both(twins);
    *before = steps_of(twins->run);
}

static void finish(struct twins *twins, struct tally *tally)
{
    tally->abreast += twins->abreast;
    tally->all += steps_of(twins->run);
    tally->runs++;
    close_twins(twins);
}

/* The next run that comes into the lane before its end. */
static bool fill(struct batch *batch, unsigned lane, struct twins *twins, unsigned long *before,
                 open_next *open, void *context, struct tally *tally)
{
    while (open(twins, context)) {
        enter(batch, lane, twins, before);
        if (twins->run->end.outcome == FBD_GOING) return true;
        finish(twins, tally);
    }
    return false;
}

static struct tally run_all(unsigned lanes, open_next *open, void *context)
{
    struct tally tally = {0};
    struct twins twins[batch_most_lanes];
    unsigned long before[batch_most_lanes];
    struct batch *batch = batch_new(lanes);
    assert_non_null(batch);
    for (unsigned lane = 0; lane < batch_lanes(batch); lane++)
        fill(batch, lane, &twins[lane], &before[lane], open, context, &tally);
    for (unsigned stops; (stops = batch_go(batch)) != 0;) {
        for (unsigned lane = 0; lane < batch_lanes(batch); lane++) {
            if (!(stops >> lane & 1)) continue;
            follow(&twins[lane], before[lane]);
            advance_both(&twins[lane]);
            enter(batch, lane, &twins[lane], &before[lane]);
            if (twins[lane].run->end.outcome == FBD_GOING) continue;
            finish(&twins[lane], &tally);
            fill(batch, lane, &twins[lane], &before[lane], open, context, &tally);
        }
    }
    batch_free(batch);
    return tally;
}

static const unsigned widths[] = {2, 4, 8};

enum { width_count = sizeof widths / sizeof *widths };

/* ---- pendulums */

struct supply {
    struct random_numbers numbers;
    int left;
    bool damped; /* some of them by a damper, the others by the general method */
    bool fast;   /* it goes round so often that the sine of large angles is asked for */
};

static bool open_pendulum(struct twins *twins, void *context)
{
    struct supply *supply = context;
    struct random_numbers *numbers = &supply->numbers;
    char text[500], damper[100] = "";
    if (supply->left == 0) return false;
    supply->left--;
    const bool turns = random_chance(numbers, 0.3), rod = random_chance(numbers, 0.5);
    double theta = random_perhaps(numbers, 0.9, -3.14159, 3.14159),
           omega = turns ? random_between(numbers, -40, 40) : random_perhaps(numbers, 0.3, -3, 3);
    const bool damped = supply->damped && random_chance(numbers, 0.7);
    if (supply->fast) omega = random_between(numbers, 200, 700);
    if (damped)
        snprintf(damper, sizeof damper, "    moments: [{damper: {coefficient: %.17g}}]\n",
                 pow(10, random_between(numbers, -4, 3)));
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: %.17g\nbodies:\n  b:\n    %smass: %.17g\n    %s%.17g%s\n    motion: pivot\n"
             "    initial: {theta: %.17g rad, omega: %.17g}\n    forces: [gravity]\n%s",
             random_between(numbers, 1, 20), rod ? "shape: rod\n    " : "", random_between(numbers, 0.1, 10),
             rod ? "from: [0, 0]\n    to: [0, -" : "center: [0, -", random_between(numbers, 0.1, 10), "]",
             theta, omega, damper);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = pow(10, random_between(numbers, -15, -2));
    options.until =
        supply->fast ? 100 : random_between(numbers, 0.01, random_chance(numbers, 0.2) ? 400 : 40);
    if (supply->damped && (!damped || random_chance(numbers, 0.2))) options.method = "rk8pd";
    open_twins(twins, text, &options);
    return true;
}

static void check_pendulums(bool damped)
{
    for (int i = 0; i < width_count; i++) {
        struct supply supply = {{seed + (unsigned)i}, 200, damped, false};
        const struct tally tally = run_all(widths[i], open_pendulum, &supply);
        assert_int_equal(tally.runs, 200);
        print_message("%u lanes: %lu of %lu steps abreast\n", widths[i], tally.abreast, tally.all);
        assert_true((double)tally.abreast > 0.8 * (double)tally.all);
    }
}

static void pendulums_have_their_bits(void **unused)
{
    (void)unused;
    check_pendulums(false);
}

static void damped_pendulums_have_their_bits(void **unused)
{
    (void)unused;
    check_pendulums(true);
}

/* ---- double pendulums */

static void add_rod(struct random_numbers *numbers, const char *name, const char *motion, char *text,
                    size_t size)
{
    const size_t length = strlen(text);
    snprintf(
        text + length, size - length,
        "  %s:\n    shape: rod\n    mass: %.17g\n    from: [0, 0]\n    to: [%.17g, -%.17g]\n    motion: %s\n"
        "    initial: {theta: %.17g rad, omega: %.17g}\n    forces: [gravity%s]\n",
        name, random_between(numbers, 0.1, 5), random_perhaps(numbers, 0.5, -1, 1),
        random_between(numbers, 0.2, 2), motion, random_perhaps(numbers, 0.9, -3, 3),
        random_perhaps(numbers, 0.3, -3, 3),
        random_chance(numbers, 0.3) ? ", {applied: {value: 2, angle: 1 rad, at: right}}" : "");
}

static bool open_double(struct twins *twins, void *context)
{
    struct supply *supply = context;
    struct random_numbers *numbers = &supply->numbers;
    char text[900] = "fbd: 1\nbodies:\n";
    if (supply->left == 0) return false;
    supply->left--;
    add_rod(numbers, "a", "pivot", text, sizeof text);
    add_rod(numbers, "b", "{pivot: {on: a, at: right, point: left}}", text, sizeof text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = pow(10, random_between(numbers, -15, -2));
    options.until = random_between(numbers, 0.01, random_chance(numbers, 0.1) ? 100 : 10);
    if (random_chance(numbers, 0.2)) options.method = "rk8pd";
    open_twins(twins, text, &options);
    return true;
}

static void double_pendulums_have_their_bits(void **unused)
{
    (void)unused;
    for (int i = 0; i < width_count; i++) {
        struct supply supply = {{seed + (unsigned)i}, 150, false, false};
        const struct tally tally = run_all(widths[i], open_double, &supply);
        assert_int_equal(tally.runs, 150);
        print_message("%u lanes: %lu of %lu steps abreast\n", widths[i], tally.abreast, tally.all);
        assert_true((double)tally.abreast > 0.8 * (double)tally.all);
    }
}

/* Beyond SINE_MOST they are made alone. */
static void fast_pendulums_have_their_bits(void **unused)
{
    (void)unused;
    struct supply supply = {{seed}, 12, false, true};
    const struct tally tally = run_all(8, open_pendulum, &supply);
    assert_int_equal(tally.runs, 12);
    print_message("%lu of %lu steps abreast\n", tally.abreast, tally.all);
    assert_true(tally.abreast > tally.all / 100 && tally.abreast < tally.all);
}

/* ---- what is refused */

static void check_refused(const char *what, const char *body, const fbd_options *options)
{
    char text[800];
    struct batch *batch = batch_new(2);
    assert_non_null(batch);
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n  b:\n    mass: 1\n    center: [0, -1]\n    motion: pivot\n    %s\n", body);
    fbd_model *model = model_from(text);
    struct arena memory = {0};
    struct run *run = start(model, options, &memory);
    while (run->end.outcome == FBD_GOING) {
        if (batch_put(batch, 0, run)) fail_msg("%s is put into a lane", what);
        run_advance(run);
    }
    run_free(run);
    arena_free(&memory);
    fbd_model_free(model);
    batch_free(batch);
}

static void others_are_refused(void **unused)
{
    static const struct {
        const char *what, *body;
    } bodies[] = {
        {"one with a spring",
         "initial: {theta: 1}\n    forces: [gravity]\n    moments: [{spring: {stiffness: 1}}]"},
        {"one that is driven", "initial: {theta: 1}\n    forces: [gravity]\n    moments: [{applied: {value: "
                               "'2*sin(3[rad/s]*t)'}}]"},
        {"one with events", "initial: {theta: 1}\n    forces: [gravity]\nsimulate:\n  until: 3\n  events: "
                            "[{name: e, when: b.theta = 0}]"},
        {"two of them", "initial: {theta: 1}\n    forces: [gravity]\n  c:\n    mass: 1\n    center: [0, "
                        "-1]\n    motion: pivot\n"
                        "    initial: {theta: 2}\n    forces: [gravity]"},
        {"what hangs at rest", "forces: [gravity]"},
    };
    (void)unused;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = 3;
    for (size_t i = 0; i + 1 < sizeof bodies / sizeof *bodies; i++)
        check_refused(bodies[i].what, bodies[i].body, &options);
    const char *swings = "initial: {theta: 1}\n    forces: [gravity]";
    fbd_options other = options;
    other.step = 0.01;
    check_refused("steps of equal size", swings, &other);
    other = options;
    other.method = "dop853";
    check_refused("another method", swings, &other);
}

/* ---- the sine */

/* To twice the digits: sin x = 2 sin(x/2) cos(x/2) and the like lose some, Taylor's series of what is left of x after
 * whole turns does not. Long doubles have 11 bits more here. */
static void sines_are_sines(void **unused)
{
    (void)unused;
    struct random_numbers numbers = {seed};
    double worst = 0;
    for (int i = 0; i < 200000; i++) {
        static const double ranges[] = {1e-3, 1, 4, 100, SINE_MOST};
        double range = ranges[i % 5], x = random_between(&numbers, -range, range);
        if (i % 7 == 0) x = round(x / 1.5707963267948966) * 1.5707963267948966; /* where least is left */
        const double got = sine(x), ulp = nextafter(fabs(got), INFINITY) - fabs(got);
        worst = fmax(worst, fabs((double)((long double)got - sinl(x))) / ulp);
    }
    print_message("off by %.3f roundings\n", worst);
    assert_true(worst < 0.8);
    assert_true(sine(0.0) == 0 && !signbit(sine(0.0)) && signbit(sine(-0.0)));
    assert_true(isnan(sine(NAN)) && isnan(sine(INFINITY)));
    assert_true(sine(1e5) == sin(1e5));
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pendulums_have_their_bits),
        cmocka_unit_test(damped_pendulums_have_their_bits),
        cmocka_unit_test(double_pendulums_have_their_bits),
        cmocka_unit_test(fast_pendulums_have_their_bits),
        cmocka_unit_test(others_are_refused),
        cmocka_unit_test(sines_are_sines),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
