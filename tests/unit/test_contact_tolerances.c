/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What touches, lifts off and strikes does so at any tolerance: the models of contacts, as they are and within the
 * ranges of their parameters, end with the same events at all of them, each at its time to the tolerance. At each power of
 * ten with FBD_DRAWS, else at every third.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <stdio.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_events = 2000, tightest = 13, loosest = 3 };

static const unsigned seed = 1687;

struct history {
    size_t count;
    fbd_event events[most_events];
    char names[most_events][2][32]; /* of the body and of the load: those of the events go with their run */
};

static bool follow(const char *path, const char *const *settings, double tolerance, struct history *history)
{
    struct trial trial = trial_open(path, settings);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.tolerance = tolerance;
    trial_run(&trial, &options);
    bool done = trial.outcome == FBD_DONE;
    history->count = fbd_simulation_event_count(trial.simulation);
    assert_true(history->count <= most_events);
    for (size_t i = 0; i < history->count; i++) {
        fbd_event *event = &history->events[i];
        *event = fbd_simulation_event(trial.simulation, i);
        snprintf(history->names[i][0], sizeof history->names[i][0], "%s", event->body);
        snprintf(history->names[i][1], sizeof history->names[i][1], "%s", event->name);
    }
    trial_close(&trial);
    return done;
}

static bool same_events(const struct history *a, const struct history *b)
{
    bool same = a->count == b->count;
    for (size_t i = 0; same && i < a->count; i++)
        same = a->events[i].kind == b->events[i].kind && strcmp(a->names[i][0], b->names[i][0]) == 0 &&
               strcmp(a->names[i][1], b->names[i][1]) == 0;
    return same;
}

static double apart(const struct history *a, const struct history *b)
{
    double worst = 0;
    for (size_t i = 0; i < a->count; i++) worst = fmax(worst, fabs(a->events[i].t - b->events[i].t));
    return worst;
}

/* Between the impacts of dominoes rounding grows: d = 2.32898 cm moved by 1e-15 of itself moves a stick by 4e-10 s. */
static const double rounding = 1e-9;

static void check_tolerances(struct checks *checks, const char *path, const char *setting)
{
    static struct history first, next;
    const char *const settings[] = {setting, NULL};
    const char *name = setting ? setting : "as it is";
    char what[160];
    snprintf(what, sizeof what, "%s, %s: done at 1e-%d", path, name, tightest);
    check_that(checks, what, follow(path, settings, 1e-13, &first));
    const int stride = draws_asked() > 1 ? 1 : thorough() ? 3 : 10;
    for (int digits = loosest; digits < tightest; digits += stride) {
        double tolerance = pow(10, -digits);
        snprintf(what, sizeof what, "%s, %s: done at 1e-%d", path, name, digits);
        check_that(checks, what, follow(path, settings, tolerance, &next));
        snprintf(what, sizeof what, "%s, %s: the same events at 1e-%d", path, name, digits);
        bool same = check_that(checks, what, same_events(&first, &next));
        snprintf(what, sizeof what, "%s, %s: at the same times at 1e-%d", path, name, digits);
        if (same) check_close(checks, what, apart(&first, &next), 0, fmax(tolerance, rounding));
    }
}

static void models_have_the_same_events_at_any_tolerance(void **unused)
{
    static const char *const models[] = {
        "contact/ball_off_a_table.yaml",  "contact/bouncing_ball.yaml", "contact/cradle.yaml",
        "contact/disc_leaves_drum.yaml",  "contact/dominoes.yaml",      "contact/ladder.yaml",
        "contact/push_slide_or_tip.yaml", "contact/shaken_table.yaml",  "contact/stairs.yaml",
        "contact/woodpecker.yaml",
    };
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) check_tolerances(&checks, models[i], NULL);
    checks_end(&checks);
}

/* Wherever in its range a parameter is. */
static void so_do_others_like_them(void **unused)
{
    static const struct {
        const char *path, *name, *unit;
        double low, high;
    } ranges[] = {
        {"contact/cradle.yaml", "phi", "deg", -50, -5},
        {"contact/ladder.yaml", "phi", "deg", 40, 80},
        {"contact/dominoes.yaml", "d", "cm", 1, 4},
        {"contact/shaken_table.yaml", "A", "mm", 18, 25},
        {"contact/push_slide_or_tip.yaml", "mu", "", 0.05, 1},
        {"contact/bouncing_ball.yaml", "h", "m", 0.2, 3},
    };
    struct random_numbers numbers = {seed};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++)
        for (int draw = 0; draw < draws_of(1); draw++) {
            char setting[64];
            snprintf(setting, sizeof setting, "%s=%.6g %s", ranges[i].name,
                     random_between(&numbers, ranges[i].low, ranges[i].high), ranges[i].unit);
            check_tolerances(&checks, ranges[i].path, setting);
        }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_have_the_same_events_at_any_tolerance),
        cmocka_unit_test(so_do_others_like_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
