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

#include "base/text.h"
#include "fbd_study.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

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
    enum { seed = 2215 };
    const int draws = thorough() ? 60 : 12;
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
        check_that(&checks, "without an event", fbd_simulation_event_count(trial.simulation) == 0);
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
        check_that(&checks, "and no other", fbd_simulation_event_count(trial.simulation) == 2);
        if (checks.failed) print_message("# draw %d\n%s", draw, text);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- three or four feet: what presses on each is not determined either
 *
 * N_i >= 0 with sum N_i = m g + k w and their moment about the centre of mass that of the push: the most that
 * friction can bear is at a corner of these, where all but two feet press on nothing. */

enum { most_feet = 4 };

struct row_of_feet {
    int count;
    double x[most_feet], mu[most_feet]; /* x from the centre of mass */
    double mass, foot, h, push;
};

static struct row_of_feet draw_row(struct random_numbers *numbers)
{
    struct row_of_feet row = {.count = 3 + (int)(random_bits(numbers) % 2),
                              .mass = random_between(numbers, 2, 20),
                              .foot = random_between(numbers, 0.01, 0.5),
                              .h = random_between(numbers, 0, 0.4),
                              .push = random_between(numbers, 5, 50)};
    for (int i = 0; i < row.count; i++) {
        row.x[i] = -1 + 2.0 * i / (row.count - 1) + random_between(numbers, -0.2, 0.2);
        row.mu[i] = random_between(numbers, 0.05, 0.8);
    }
    return row;
}

/* The most that friction bears against the push P; below zero when the row tips over. */
static double most_friction(const struct row_of_feet *row, double P)
{
    double most = -1, w = row->foot * g;
    for (int i = 0; i < row->count; i++)
        for (int j = i + 1; j < row->count; j++) {
            double total = row->mass * g + row->count * w, moment = P * row->h, d = row->x[j] - row->x[i];
            for (int k = 0; k < row->count; k++) moment += w * row->x[k]; /* the feet's own weights */
            double right = (moment - total * row->x[i]) / d, left = total - right;
            if (left < 0 || right < 0) continue;
            most = fmax(most, row->mu[i] * left + row->mu[j] * right);
        }
    return most;
}

static double gives_at(const struct row_of_feet *row)
{
    double low = 0, high = 1e4;
    for (int k = 0; k < 200; k++) {
        double middle = (low + high) / 2;
        if (most_friction(row, middle) >= middle)
            low = middle;
        else
            high = middle;
    }
    return low / row->push;
}

static void write_row(const struct row_of_feet *row, double until, struct text *text)
{
    text_printf(
        text, "fbd: 1\nbodies:\n  block:\n    mass: %.17g\n    inertia: 1\n    motion: planar\n    points: {",
        row->mass);
    for (int i = 0; i < row->count; i++) text_printf(text, "L%d: [%.17g, 0], ", i, row->x[i]);
    text_printf(
        text,
        "A: [0, %.17g]}\n    forces: [gravity, applied: {name: push, value: \"%.17g[N/s]*t\", angle: 0, "
        "at: A}]\n",
        row->h, row->push);
    for (int i = 0; i < row->count; i++)
        text_printf(
            text,
            "  f%d: {mass: %.17g, motion: slide, initial: {x: %.17g}, forces: [gravity, normal, friction: "
            "%.17g]}\n",
            i, row->foot, row->x[i], row->mu[i]);
    text_add(text, "couplings:\n");
    for (int i = 0; i < row->count; i++) text_printf(text, "  - pin: {between: [block.L%d, f%d]}\n", i, i);
    text_printf(text, "simulate: {until: %.17g s}\n", until);
}

static void many_feet_give_when_no_share_is_left(void **unused)
{
    (void)unused;
    enum { seed = 2217 };
    const int draws = thorough() ? 60 : 12;
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    int gave = 0;
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        struct row_of_feet row = draw_row(&numbers);
        double t = gives_at(&row);
        if (most_friction(&row, (1 + 1e-6) * t * row.push) < 0) continue; /* it tips first */
        struct text text = {0};
        write_row(&row, 1.02 * t, &text);
        struct trial trial = trial_parse(text.data);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_close(&checks, "gives", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), t, 1e-9 * t);
        gave++;
        if (checks.failed) print_message("# draw %d\n%s", draw, text.data);
        text_free(&text);
        trial_close(&trial);
    }
    check_that(&checks, "most of them are tried", gave > draws / 2);
    checks_end(&checks);
}

/* ---- a block with friction that a rod holds: it stands whatever pushes it */

static void what_a_rod_holds_stands(void **unused)
{
    (void)unused;
    enum { seed = 2216 };
    const int draws = thorough() ? 100 : 20;
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

/* ---- two blocks on a table that one condition too many keeps at rest
 *
 * What holds the blocks takes no part in what is shared below them. Along the table, F_i being the forces
 * there, a rope over a fixed point gets longer by k_i for a way of one: it has the tension
 *
 *     T = (k_1 F_1/m_1 + k_2 F_2/m_2) / (k_1^2/m_1 + k_2^2/m_2),  or none where that is negative,
 *
 * and friction holds where |F| <= mu N. */

struct blocks {
    double slope, O[2], Q[2], m[2], F[2][2], x[2], mu[2];
};

static struct blocks draw_blocks(struct random_numbers *numbers)
{
    struct blocks blocks = {.slope = random_between(numbers, -3, 3)};
    for (int k = 0; k < 2; k++) {
        blocks.O[k] = random_between(numbers, -2, 2);
        blocks.Q[k] = random_between(numbers, -2, 2);
        blocks.m[k] = random_between(numbers, 0.5, 3);
        blocks.x[k] = random_between(numbers, -2, 2);
        blocks.mu[k] = random_between(numbers, 0.1, 1.5);
        for (int i = 0; i < 2; i++) blocks.F[k][i] = random_between(numbers, -9, 9);
    }
    return blocks;
}

static void write_blocks(const struct blocks *blocks, bool rope, char *text, size_t size)
{
    char block[2][400];
    for (int k = 0; k < 2; k++) {
        char friction[100] = "";
        if (!rope)
            snprintf(friction, sizeof friction, ", friction: {static: %.17g, kinetic: %.17g}", blocks->mu[k],
                     blocks->mu[k]);
        snprintf(
            block[k], sizeof block[k],
            "{mass: %.17g, motion: {slide: {on: table}}, initial: {x: %.17g}, forces: [normal: {two_sided: "
            "true}, applied: {name: F, fx: %.17g, fy: %.17g}%s]}",
            blocks->m[k], blocks->x[k], blocks->F[k][0], blocks->F[k][1], friction);
    }
    snprintf(text, size,
             "fbd: 1\nground: {points: {O: [%.17g, %.17g], Q: [%.17g, %.17g]}}\nbodies:\n"
             "  table: {mass: 1, motion: {slide: {along: %.17g, through: [%.17g, %.17g]}}}\n"
             "  b1: %s\n  b2: %s\ncouplings:\n%s  - pin: {between: [table, ground.O]}\n",
             blocks->O[0], blocks->O[1], blocks->Q[0], blocks->Q[1], blocks->slope, blocks->O[0],
             blocks->O[1], block[0], block[1], rope ? "  - rope: {through: [b1, ground.Q, b2]}\n" : "");
}

/* Accelerations along the table. */
static void move_blocks(const struct blocks *blocks, bool rope, double *a)
{
    double c = cos(blocks->slope), s = sin(blocks->slope), k[2], pull = 0, ease = 0;
    for (int i = 0; i < 2; i++) {
        double dx = blocks->O[0] + blocks->x[i] * c - blocks->Q[0],
               dy = blocks->O[1] + blocks->x[i] * s - blocks->Q[1], m = blocks->m[i];
        double along = blocks->F[i][0] * c + blocks->F[i][1] * s,
               N = fabs(blocks->F[i][1] * c - blocks->F[i][0] * s);
        k[i] = (dx * c + dy * s) / hypot(dx, dy);
        pull += k[i] * along / m;
        ease += k[i] * k[i] / m;
        a[i] = along / m;
        if (!rope) a[i] = copysign(fmax(0, fabs(along) - blocks->mu[i] * N), along) / m;
    }
    for (int i = 0; rope && i < 2; i++) a[i] -= fmax(0, pull / ease) * k[i] / blocks->m[i];
}

static void what_has_no_part_in_a_share_decides_for_itself(void **unused)
{
    (void)unused;
    enum { seed = 1048 };
    const int draws = thorough() ? 200 : 40;
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        bool rope = draw % 2;
        double a[2];
        char text[1500];
        struct blocks blocks = draw_blocks(&numbers);
        write_blocks(&blocks, rope, text, sizeof text);
        move_blocks(&blocks, rope, a);
        struct trial trial = trial_parse(text);
        check_close(&checks, "the first", trial_acceleration(&trial, "b1.x"), a[0], 1e-11);
        check_close(&checks, "the second", trial_acceleration(&trial, "b2.x"), a[1], 1e-11);
        if (checks.failed) print_message("# draw %d\n%s", draw, text);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_feet_share_and_give_together),
        cmocka_unit_test(many_feet_give_when_no_share_is_left),
        cmocka_unit_test(what_a_rod_holds_stands),
        cmocka_unit_test(what_has_no_part_in_a_share_decides_for_itself),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
