/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Works as they are listed - in the JSON, the report and the columns of the ledger - of a bob that falls free within reach
 * of its rope, until that takes what velocity it has along it: against the parabola and the circle on which it meets the
 * end of its rope, and their sum against the change of kinetic energy. Random starts, lengths and masses, beside a spring
 * between two other bodies. FBD_LISTED=1000 tries so many, FBD_LISTED_SEED=17 begins there.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fbd_export.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"
#include "written.h"

static const double g = 9.81;

/* A bob below the origin, where its rope ends; with n > 0 one of n times its mass and one of 1 kg beside it, on a spring. */
struct fall {
    double m, L, x, y, vx, vy, n;
};

static struct fall draw(struct random_numbers *numbers)
{
    struct fall fall = {.m = random_between(numbers, 0.3, 3), .L = random_between(numbers, 0.5, 3)};
    double angle = random_between(numbers, -2.6, -0.5), r = fall.L * random_between(numbers, 0.2, 0.9);
    fall.x = r * cos(angle);
    fall.y = r * sin(angle);
    fall.vx = random_between(numbers, -1, 1);
    fall.vy = random_between(numbers, -2, 0);
    fall.n = random_perhaps(numbers, 0.5, 0.2, 2);
    return fall;
}

static double beyond(const struct fall *fall, double t)
{
    return hypot(fall->x + fall->vx * t, fall->y + fall->vy * t - g * t * t / 2) - fall->L;
}

/* When the rope is taut: it falls away from its end all the time, below it. */
static double when_taut(const struct fall *fall)
{
    double before = 0, after = 0.01;
    while (beyond(fall, after) < 0) after *= 1.5;
    for (int i = 0; i < 100; i++) {
        double middle = (before + after) / 2;
        *(beyond(fall, middle) < 0 ? &before : &after) = middle;
    }
    return after;
}

/* What the jerk takes: the velocity along the rope. */
static double work_of_jerk(const struct fall *fall, double t)
{
    double x = fall->x + fall->vx * t, y = fall->y + fall->vy * t - g * t * t / 2;
    double along = (x * fall->vx + y * (fall->vy - g * t)) / fall->L;
    return -fall->m * along * along / 2;
}

static void write(const struct fall *fall, double until, struct written *text)
{
    add(text, "fbd: 1\nground: {points: {A: [0, 0]}}\nbodies:\n");
    add(text,
        "  bob: {mass: %.17g, motion: particle, initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g}, forces: "
        "[gravity]}\n",
        fall->m, fall->x, fall->y, fall->vx, fall->vy);
    if (fall->n > 0)
        add(text,
            "  p: {mass: %.17g, motion: particle, initial: {x: 9}, forces: [gravity]}\n"
            "  q: {mass: 1, motion: particle, initial: {x: 10, vy: 1}, forces: [gravity, drag: {linear: "
            "0.3}]}\n",
            fall->n * fall->m);
    add(text, "couplings:\n  - rope: {name: cord, through: [bob, ground.A], length: %.17g}\n", fall->L);
    if (fall->n > 0) add(text, "  - spring: {name: s, between: [p, q], stiffness: 20, free_length: 0.5}\n");
    add(text, "simulate: {until: %.17g, tolerance: 1e-11}\n", until);
}

/* The last row's sum of the columns whose names end so, but that of the scene. */
static double sum_of_works(const fbd_table *table)
{
    static const char end[] = ".work";
    const double *last = table->values + (table->rows - 1) * table->columns;
    double sum = 0;
    for (size_t i = 0; i < table->columns; i++) {
        const char *name = table->heads[i].name;
        size_t length = strlen(name), tail = sizeof end - 1;
        bool works = length > tail && strcmp(name + length - tail, end) == 0;
        if (works && strncmp(name, "energy.", 7) != 0) sum += last[i];
    }
    return sum;
}

/* The number behind `after` that comes behind `key` in a text. */
static double number_after(const char *text, const char *key, const char *after)
{
    const char *at = strstr(text, key);
    at = at ? strstr(at, after) : NULL;
    return at ? strtod(at + strlen(after), NULL) : NAN;
}

static double kinetic(const struct trial *trial, const char *body, double mass)
{
    char x[20], y[20];
    snprintf(x, sizeof x, "%s.vx", body);
    snprintf(y, sizeof y, "%s.vy", body);
    fbd_state *end = fbd_result_state(trial->result);
    double vx = NAN, vy = NAN;
    assert_true(fbd_state_get(end, x, &vx) && fbd_state_get(end, y, &vy));
    return mass * (vx * vx + vy * vy) / 2;
}

static void look_at_texts(struct checks *checks, const struct trial *trial, double want, double allowed)
{
    char *json = fbd_result_json(trial->result), *report = fbd_result_report(trial->result, true);
    assert_non_null(json);
    assert_non_null(report);
    const char *forces = strstr(json, "\"forces\": {"), *listed = strstr(report, "Forces at the end");
    assert_non_null(forces);
    assert_non_null(listed);
    check_close(checks, "in the JSON", number_after(forces, "\"cord\": {", "\"work\": "), want, allowed);
    check_close(checks, "in the report", number_after(listed, "    cord ", " work "), want,
                allowed + 1e-8 * fabs(want));
    fbd_free(json);
    fbd_free(report);
}

static void compare(struct checks *checks, const struct fall *fall)
{
    struct written text = {0};
    double t = when_taut(fall), want = work_of_jerk(fall, t);
    write(fall, t + 0.01, &text);
    struct trial trial = trial_parse(text.all);
    const fbd_recording recording = {.ledger = true, .table = true};
    trial_record(&trial, NULL, &recording);
    double before = fall->m * (fall->vx * fall->vx + fall->vy * fall->vy) / 2 + (fall->n > 0 ? 0.5 : 0),
           after = kinetic(&trial, "bob", fall->m);
    if (fall->n > 0) after += kinetic(&trial, "p", fall->n * fall->m) + kinetic(&trial, "q", 1);
    double allowed = 1e-8 * (before + after + fall->m * g * fall->L);
    check_close(checks, "of the jerk", fbd_result_work(trial.result, "bob", "cord"), want, allowed);
    look_at_texts(checks, &trial, want, allowed);
    fbd_table table = fbd_result_table(trial.result);
    check_close(checks, "they add up", sum_of_works(&table), after - before, allowed);
    trial_close(&trial);
}

static void works_that_are_listed_add_up(void **unused)
{
    const int draws = number_of("FBD_LISTED", draws_of(60)), first = number_of("FBD_LISTED_SEED", 1);
    struct checks checks = {0};
    (void)unused;
    for (int i = first; i < first + draws; i++) {
        struct random_numbers numbers = {(uint64_t)i};
        struct fall fall = draw(&numbers);
        size_t failed = checks.failed;
        compare(&checks, &fall);
        if (checks.failed > failed) print_message("seed %d\n", i);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(works_that_are_listed_add_up)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
