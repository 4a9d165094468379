/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ropes that wind themselves round a pulley, off it, and past it while they are slack.
 *
 * Reference: without gravity the rope of a bob that circles a fixed post of radius r pulls across its
 * velocity, so that the speed v stays. With the free length l and the angle phi that has been wound up, l =
 * l_0 - r phi and l phi' = v, so l^2 = l_0^2 - 2 r v t; unwinding, l^2 = l_0^2 + 2 r v t.
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
#include "thorough.h"

static const double pi = 3.14159265358979323846;

/* The whole scene is turned by `tilt`, and mirrored where `side` is -1. */
struct tether {
    double r, l, v, up, tilt, side;
};

struct point {
    double x, y;
};

static struct point turned(const struct tether *tether, double x, double y)
{
    double c = cos(tether->tilt), s = sin(tether->tilt);
    y *= tether->side;
    return (struct point){c * x - s * y, s * x + c * y};
}

/* The rope comes in along x, at the top of the post, and hangs down from its right; v > 0 winds it up. */
static struct trial tether_trial(const struct tether *tether, double until, const char *more)
{
    char text[1200];
    struct point A = turned(tether, -3, tether->r), bob = turned(tether, tether->r, -tether->l),
                 v = turned(tether, -tether->v, tether->up);
    snprintf(
        text, sizeof text,
        "fbd: 1\ngravity: [0, 0]\nground: {points: {A: [%.17g, %.17g]}}\nbodies:\n"
        "  post: {mass: 1, shape: disc, radius: %.17g, motion: {pivot: {at: [0, 0], theta: \"0 rad\"}}}\n"
        "  bob: {mass: 1, motion: particle, initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g}}\n"
        "couplings:\n  - rope: {name: line, through: [ground.A, post, bob]%s}\n"
        "simulate: {until: %.17g s, tolerance: 1e-11}\n",
        A.x, A.y, tether->r, bob.x, bob.y, v.x, v.y, more, until);
    return trial_parse(text);
}

static void check_place(struct checks *checks, struct trial *trial, const struct tether *tether, double t)
{
    double r = tether->r, l = sqrt(tether->l * tether->l - 2 * r * tether->v * t), phi = (tether->l - l) / r;
    struct point want = turned(tether, r * cos(phi) - l * sin(phi), -r * sin(phi) - l * cos(phi));
    struct point v = turned(tether, -tether->v * cos(phi), tether->v * sin(phi));
    check_close(checks, "x", trial_get(trial, "bob.x"), want.x, 1e-8);
    check_close(checks, "y", trial_get(trial, "bob.y"), want.y, 1e-8);
    check_close(checks, "vx", trial_get(trial, "bob.vx"), v.x, 1e-7);
    check_close(checks, "vy", trial_get(trial, "bob.vy"), v.y, 1e-7);
}

static double between(uint64_t *seed, double low, double high)
{
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return low + (high - low) * (double)(*seed >> 11) / 9007199254740992.0;
}

static struct tether draw(uint64_t *seed)
{
    return (struct tether){.r = between(seed, 0.02, 0.3),
                           .l = between(seed, 1, 3),
                           .v = between(seed, 0.3, 5),
                           .tilt = between(seed, -pi, pi),
                           .side = between(seed, 0, 1) < 0.5 ? -1 : 1};
}

/* Until half of the rope is left: from half a turn to some twenty. */
static void a_rope_winds_itself_up_any_number_of_times(void **unused)
{
    (void)unused;
    enum { looks = 10 };
    const int scenes = draws_of(100);
    struct checks checks = {0};
    uint64_t seed = 1;
    double most = 0;
    for (int i = 0; i < scenes; i++) {
        struct tether tether = draw(&seed);
        double until = 0.75 * tether.l * tether.l / (2 * tether.r * tether.v);
        most = fmax(most, tether.l / 2 / tether.r / (2 * pi));
        struct trial trial = tether_trial(&tether, until, "");
        trial_start(&trial, NULL);
        for (int k = 1; k <= looks; k++) {
            trial_to(&trial, until * (k - 0.5) / looks);
            check_place(&checks, &trial, &tether, until * (k - 0.5) / looks);
        }
        trial_finish(&trial);
        check_that(&checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
        trial_close(&trial);
    }
    print_message("# up to %.1f turns\n", most);
    check_that(&checks, "several turns", most > 5 || !thorough());
    checks_end(&checks);
}

/* A quarter of a turn is on the post at the start. */
static void it_comes_off_when_all_is_unwound(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    uint64_t seed = 2;
    for (int i = 0; i < draws_of(50); i++) {
        struct tether tether = draw(&seed);
        double end = tether.l + tether.r * pi / 2;
        double when = (end * end - tether.l * tether.l) / (2 * tether.r * tether.v);
        tether.v = -tether.v;
        struct trial trial = tether_trial(&tether, 2 * when, "");
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "it ends", trial.outcome == FBD_BROKEN);
        check_that(&checks, "by name",
                   strstr(fbd_simulation_reason(trial.simulation), "comes off its pulley `post`") != NULL);
        check_close(&checks, "when", trial_get(&trial, "t"), when, 1e-8 * when);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Upwards past the post, 2 m of it loose, to where the straight line from A is as long as the rope. */
static void a_slack_rope_may_pass_its_pulley_and_is_not_taut_beside_it(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int side = -1; side <= 1; side += 2) {
        struct tether tether = {.r = 0.1, .l = 1, .v = -0.5, .up = 1, .tilt = 0.3, .side = side};
        struct point v = turned(&tether, 0.5, 1), start = turned(&tether, 0.1, -1);
        struct trial trial = tether_trial(&tether, 5, ", length: 6");
        trial_start(&trial, NULL);
        trial_finish(&trial);
        double t = trial_get(&trial, "t");
        check_that(&checks, "it ends", trial.outcome == FBD_BROKEN && t > 1.2 && t < 2.2);
        check_that(&checks, "by name",
                   strstr(fbd_simulation_reason(trial.simulation), "is taut beside its pulley `post`") !=
                       NULL);
        check_that(&checks, "it was free before",
                   fabs(hypot(trial_get(&trial, "bob.x") - start.x, trial_get(&trial, "bob.y") - start.y) -
                        t * hypot(v.x, v.y)) < 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Far from its end the interpolant of a step tells enough: dop853 takes 12 right-hand sides a step, 3 more for that, and
 * some for the jerks at both ends and where the yo-yo turns round. Made again for each look there were 200. */
static void what_is_wound_is_watched_without_steps(void **unused)
{
    (void)unused;
    const double most_a_step = 40;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/yo_yo.yaml", NULL);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    fbd_stats stats = fbd_simulation_stats(trial.simulation);
    print_message("# %lu steps, %lu right-hand sides\n", (unsigned long)stats.steps,
                  (unsigned long)stats.rhs);
    check_that(&checks, "few right-hand sides", (double)stats.rhs <= most_a_step * (double)stats.steps);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rope_winds_itself_up_any_number_of_times),
        cmocka_unit_test(it_comes_off_when_all_is_unwound),
        cmocka_unit_test(a_slack_rope_may_pass_its_pulley_and_is_not_taut_beside_it),
        cmocka_unit_test(what_is_wound_is_watched_without_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
