/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Loads that several holds share: what equilibrium alone does not tell is within the limits and the same in a
 * run as at rest, and gives when the holds together can bear no more.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"

static const double g = 9.81;

/* ---- a block on two rough feet, pushed harder and harder
 *
 * While nothing moves the feet bear N_r = W/2 + P h/b and N_l = W - N_r beside their own weights w, and all
 * slides from P = mu_l (N_l + w) + mu_r (N_r + w) on: the shares in between are not determined. */

struct feet {
    double b, h, mass, foot, mu[2], ratio, push; /* ratio: kinetic over static; push in N/s */
};

static struct feet draw_feet(struct random_numbers *numbers)
{
    struct feet feet = {.b = random_between(numbers, 0.3, 1),
                        .mass = random_between(numbers, 2, 20),
                        .foot = random_between(numbers, 0.01, 1),
                        .mu = {random_between(numbers, 0.05, 0.8), random_between(numbers, 0.05, 0.8)},
                        .ratio = random_bits(numbers) % 2 ? 1 : random_between(numbers, 0.5, 1),
                        .push = random_between(numbers, 5, 50)};
    feet.h = feet.b * random_between(numbers, 0, 0.5); /* it does not tip: h mu < b/2 */
    return feet;
}

static double slides_at(const struct feet *feet)
{
    double W = feet->mass * g, w = feet->foot * g, d = feet->mu[1] - feet->mu[0];
    double P = (feet->mu[0] + feet->mu[1]) * (W / 2 + w) / (1 - d * feet->h / feet->b);
    return P / feet->push;
}

static void write_feet(const struct feet *feet, double until, char *text, size_t size)
{
    char left[200], right[200];
    const char *foot =
        "{mass: %.17g, motion: slide, initial: {x: %.17g}, forces: [gravity, normal, friction: "
        "{static: %.17g, kinetic: %.17g}]}";
    snprintf(left, sizeof left, foot, feet->foot, -feet->b / 2, feet->mu[0], feet->ratio * feet->mu[0]);
    snprintf(right, sizeof right, foot, feet->foot, feet->b / 2, feet->mu[1], feet->ratio * feet->mu[1]);
    snprintf(text, size,
             "fbd: 1\nbodies:\n  block:\n    mass: %.17g\n    inertia: 1\n    points: {L: [%.17g, 0], R: "
             "[%.17g, 0], "
             "A: [0, %.17g]}\n    motion: planar\n    forces: [gravity, applied: {name: push, value: "
             "\"%.17g[N/s]*t\", angle: 0, at: A}]\n  left: %s\n  right: %s\ncouplings:\n"
             "  - pin: {between: [block.L, left]}\n  - pin: {between: [block.R, right]}\n"
             "simulate: {until: %.17g s}\n",
             feet->mass, -feet->b / 2, feet->b / 2, feet->h, feet->push, left, right, until);
}

static fbd_arrow arrow_of(fbd_state *state, size_t body, const char *name)
{
    fbd_arrow arrows[16];
    size_t count = fbd_diagram(state, body, arrows, 16);
    for (size_t i = 0; i < count && i < 16; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("no arrow `%s`", name);
    return arrows[0];
}

static fbd_arrow arrow_at_rest(const fbd_statics *statics, size_t body, const char *name)
{
    fbd_arrow arrows[16];
    size_t count = fbd_statics_diagram(statics, body, arrows, 16);
    for (size_t i = 0; i < count && i < 16; i++)
        if (strcmp(arrows[i].name, name) == 0) return arrows[i];
    fail_msg("no arrow `%s`", name);
    return arrows[0];
}

/* At the state of the end: shares within limits, together the push, and those that statics has there. */
static void check_shares(struct checks *checks, struct trial *trial, const struct feet *feet, double t)
{
    fbd_state *state = trial->state;
    fbd_errors *errors = fbd_errors_new();
    fbd_statics *statics = fbd_statics_new(state, errors);
    assert_non_null(statics);
    double sum = 0, size = feet->mass * g;
    check_that(checks, "one share is open", fbd_statics_indeterminacy(statics) == 1);
    for (size_t foot = 0; foot < 2; foot++) {
        double f = arrow_of(state, 1 + foot, "friction").fx, N = arrow_of(state, 1 + foot, "normal").fy;
        check_that(checks, "within its limit", fabs(f) <= feet->mu[foot] * N + 1e-9 * size);
        check_close(checks, "as at rest", f, arrow_at_rest(statics, 1 + foot, "friction").fx, 1e-9 * size);
        sum += f;
    }
    check_close(checks, "they bear the push", sum, -feet->push * t, 1e-9 * size);
    fbd_statics_free(statics);
    fbd_errors_free(errors);
}

static void two_feet_share_and_give_together(void **unused)
{
    (void)unused;
    enum { draws = 60, seed = 2215 };
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        struct feet feet = draw_feet(&numbers);
        char text[1600];
        double t = slides_at(&feet), before = t * random_between(&numbers, 0.5, 0.999);
        write_feet(&feet, before, text, sizeof text);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "it stands", trial.outcome == FBD_DONE);
        check_that(&checks, "without an event", fbd_simulation_events(trial.simulation) == 0);
        check_shares(&checks, &trial, &feet, before);
        trial_close(&trial);
        write_feet(&feet, 1.01 * t, text, sizeof text);
        trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "it slides to the end", trial.outcome == FBD_DONE);
        for (int foot = 0; foot < 2; foot++)
            check_close(&checks, "both give at once", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, foot), t,
                        1e-10 * t);
        check_that(&checks, "and no other", fbd_simulation_events(trial.simulation) == 2);
        if (checks.failed) print_message("# draw %d\n%s", draw, text);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- a block with friction that a rod holds: it stands whatever pushes it */

static void what_a_rod_holds_stands(void **unused)
{
    (void)unused;
    enum { draws = 100, seed = 2216 };
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        double slope = random_between(&numbers, -0.5, 0.5),
               mu = random_between(&numbers, 0, 0.6) * (draw % 4 != 0);
        double x = random_between(&numbers, -2, 2), y = random_between(&numbers, -2, 2);
        double force = random_between(&numbers, -30, 30), omega = random_between(&numbers, 0.5, 4);
        char text[1000];
        snprintf(
            text, sizeof text,
            "fbd: 1\nground: {points: {Q: [%.17g, %.17g]}}\nbodies:\n  b:\n    mass: 1\n"
            "    motion: {slide: {along: %.17g}}\n    initial: {x: 0.1}\n"
            "    forces: [gravity, normal: {two_sided: true}, friction: {static: %.17g, kinetic: %.17g}, "
            "applied: {name: F, value: \"%.17g[N]*sin(%.17g*t)\", angle: 0.2}]\n"
            "couplings:\n  - rod: {name: rod, between: [b, ground.Q]}\nsimulate: {until: 2 s}\n",
            x, y, slope, mu, mu * (draw % 2 ? 1 : 0.8), force, omega);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "it stands to the end", trial.outcome == FBD_DONE);
        fbd_state *state = trial.state;
        double x_end = 0;
        fbd_state_get(state, "b.x", &x_end);
        check_close(&checks, "where it is", x_end, 0.1, 1e-12);
        fbd_arrow f = arrow_of(state, 0, "friction"), N = arrow_of(state, 0, "normal");
        check_that(&checks, "within its limit",
                   hypot(f.fx, f.fy) <= mu * hypot(N.fx, N.fy) + 1e-9 * (fabs(force) + g));
        if (checks.failed) print_message("# draw %d\n%s", draw, text);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_feet_share_and_give_together),
        cmocka_unit_test(what_a_rod_holds_stands),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
