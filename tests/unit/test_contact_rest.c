/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random stacks of boxes that lie flat on each other, on a floor or a slope, and are pushed: what `--static` says of them
 * against what a run of them does. They stand in both or in none; where they stand every force of every diagram is the
 * same in both, though two corners of each box share what one of them could bear (four unknowns, three equations).
 * FBD_STACKS=10000 FBD_STACK_SEED=7 tries others.
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

#include "fbd_study.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_boxes = 3, most_arrows = 40, room = 6000 };

/* Each one lies on the one below, with its middle over it. */
static int draw_stack(struct random_numbers *numbers, char *text)
{
    int count = 1 + (int)(random_bits(numbers) % most_boxes);
    double slope = random_bits(numbers) % 2 == 0 ? 0 : random_between(numbers, -0.3, 0.3);
    double c = cos(slope), s = sin(slope), along = 0, up = 0, width = 0;
    int length = snprintf(text, room, "fbd: 1\nground: {lines: {floor: {along: %.17g}}}\nbodies:\n", slope);
    for (int i = 0; i < count; i++) {
        double a = random_between(numbers, 0.3, 1), b = random_between(numbers, 0.2, 0.8);
        double mass = random_between(numbers, 0.5, 3);
        if (i > 0) along += random_between(numbers, -0.5, 0.5) * width;
        width = a;
        length += snprintf(
            text + length, (size_t)(room - length),
            "  b%d: {shape: prism, a: %.17g, b: %.17g, c: 1, mass: %.17g, motion: planar, initial: {x: "
            "%.17g, y: %.17g, theta: %.17g}, points: {p: [%.17g, %.17g]},\n    forces: [gravity, "
            "applied: {name: push, value: [%.17g, %.17g], at: p}]}\n",
            i, a, b, mass, c * along - s * (up + b / 2), s * along + c * (up + b / 2), slope,
            random_between(numbers, -a / 2, a / 2), random_between(numbers, -b / 2, b / 2),
            random_between(numbers, -4, 4), random_between(numbers, -8, 4));
        up += b;
    }
    length += snprintf(text + length, (size_t)(room - length), "contacts:\n");
    for (int i = 0; i < count; i++) {
        char with[20] = "ground.floor";
        if (i > 0) snprintf(with, sizeof with, "b%d", i - 1);
        length +=
            snprintf(text + length, (size_t)(room - length), "  - {between: [b%d, %s], static: %.17g}\n", i,
                     with, random_between(numbers, 0.1, 0.9));
    }
    snprintf(text + length, (size_t)(room - length), "simulate: {until: 50 ms}\n");
    return count;
}

/* Has any box gone anywhere, by more than its digits were off the surface? */
static bool stays(struct trial *trial, const struct trial *start, int count)
{
    const double near = 1e-9;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            char name[24];
            snprintf(name, sizeof name, "b%d.%s", i, k == 0 ? "x" : k == 1 ? "y" : "theta");
            if (fabs(trial_get(trial, name) - trial_get(start, name)) > near) return false;
        }
    return true;
}

static const fbd_arrow *find(const fbd_arrow *arrows, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++)
        if (strcmp(arrows[i].name, name) == 0) return &arrows[i];
    return NULL;
}

static void compare_forces(struct checks *checks, const struct trial *trial, const fbd_statics *statics,
                           size_t body)
{
    const double rounding = 1e-9; /* of the largest force */
    fbd_arrow run[most_arrows], rest[most_arrows];
    size_t run_count = fbd_diagram(trial->state, body, run, most_arrows),
           rest_count = fbd_statics_diagram(statics, body, rest, most_arrows);
    double size = 0;
    assert_true(run_count <= most_arrows && rest_count <= most_arrows);
    for (size_t i = 0; i < rest_count; i++) size = fmax(size, hypot(rest[i].fx, rest[i].fy));
    for (size_t i = 0; i < rest_count; i++) {
        const fbd_arrow *same = find(run, run_count, rest[i].name);
        double fx = same ? same->fx : 0, fy = same ? same->fy : 0;
        check_close(checks, rest[i].name, fx, rest[i].fx, rounding * size);
        check_close(checks, rest[i].name, fy, rest[i].fy, rounding * size);
    }
}

static void what_stands_in_statics_stands_in_a_run(void **unused)
{
    struct random_numbers numbers = {(uint64_t)number_of("FBD_STACK_SEED", 20261126)};
    struct checks checks = {0};
    int count = number_of("FBD_STACKS", draws_of(120)), stand = 0, only = number_of("FBD_STACK_ONLY", -1);
    (void)unused;
    for (int i = 0; i < count; i++) {
        char text[room];
        int boxes = draw_stack(&numbers, text);
        if (only >= 0 && only != i) continue;
        if (only >= 0) puts(text);
        struct trial start = trial_parse(text), trial = trial_parse(text);
        fbd_errors *errors = fbd_errors_new();
        fbd_statics *statics = fbd_statics_new(start.state, errors);
        trial_run(&trial, NULL);
        bool stands = statics && fbd_statics_holds(statics), rests = stays(&trial, &start, boxes);
        size_t before = checks.failed;
        check_that(&checks, "statics says something", statics != NULL);
        check_that(&checks, "the run comes to its end", trial.outcome == FBD_DONE);
        check_that(&checks, "stands in both or in none", stands == rests);
        for (int b = 0; b < boxes && stands && rests; b++)
            compare_forces(&checks, &trial, statics, (size_t)b);
        stand += stands;
        if (checks.failed > before) print_message("# stack %d\n", i);
        fbd_statics_free(statics);
        fbd_errors_free(errors);
        trial_close(&start);
        trial_close(&trial);
    }
    print_message("# %d of %d stacks stand\n", stand, count);
    check_that(&checks, "some stand, some do not",
               only >= 0 || (5 * stand > count && 10 * stand < 9 * count));
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_stands_in_statics_stands_in_a_run)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
