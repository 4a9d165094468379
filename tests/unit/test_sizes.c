/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Long chains, combs and stars: what a run of many rods costs is counted in right-hand sides, whose number
 * must not depend on that of the rods.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>

#include "gallery.h"
#include "scenes.h"

enum shape { chain, comb, star };

static const char *const shape_names[] = {"chain", "comb", "star"};

/* The rod that rod `i` hangs on, and where. */
static int parent_of(enum shape shape, int i, const char **at)
{
    *at = shape == comb && i % 2 == 1 ? "G" : "right";
    if (shape == star) return 0;
    return shape == comb && i % 2 == 0 ? i - 2 : i - 1;
}

static char *rods_text(enum shape shape, int rods)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    fprintf(out, "fbd: 1\nbodies:\n  b0: {shape: rod, mass: 1, length: 1, motion: {pivot: {point: left}}, "
                 "forces: [gravity]}\n");
    for (int i = 1; i < rods; i++) {
        const char *at;
        int parent = parent_of(shape, i, &at);
        fprintf(out,
                "  b%d: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: b%d, at: %s, point: left}}, "
                "forces: [gravity]}\n",
                i, parent, at);
    }
    fprintf(out, "simulate: {until: 0.01 s}\n");
    fclose(out);
    return text;
}

static fbd_stats stats_of(struct checks *checks, enum shape shape, int rods)
{
    char *text = rods_text(shape, rods);
    assert_non_null(text);
    struct trial trial = trial_parse(text);
    free(text);
    trial_run(&trial, NULL);
    check_that(checks, "it is done", trial.outcome == FBD_DONE);
    fbd_stats stats = fbd_simulation_stats(trial.simulation);
    trial_close(&trial);
    return stats;
}

/* All rods lie in a line and start to fall: near the pin they turn, and each on feels a quarter of what the
 * one before does, so that from the thirtieth on nothing is left but rounding. A method that follows that
 * took 39,000 evaluations for a thousand rods. */
static void many_rods_take_no_more_steps_than_few(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int shape = chain; shape <= star; shape++)
        for (int rods = 30; rods <= 3000; rods *= 10) {
            fbd_stats stats = stats_of(&checks, (enum shape)shape, rods);
            printf("# %s of %d rods: %lu right-hand sides in %lu steps\n", shape_names[shape], rods,
                   stats.rhs, stats.steps);
            check_that(&checks, "it takes a hundred evaluations or two", stats.rhs < 300);
        }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_rods_take_no_more_steps_than_few),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
