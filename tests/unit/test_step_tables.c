/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Jumps of step tables of the state, at which a motion may stay: closed forms.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"
#include "written.h"

#include <stdlib.h>

static const char *const methods[] = {NULL, "dop853", "rkf45", "rodas5p"};

enum { method_count = sizeof methods / sizeof *methods };

static struct trial run_with(const char *text, int method)
{
    struct trial trial = trial_parse(text);
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = methods[method % method_count];
    options.tolerance = 1e-10;
    trial_run(&trial, &options);
    return trial;
}

static void check_end(struct checks *checks, struct written *text, int method, double x, double v)
{
    struct trial trial = run_with(text->all, method);
    bool same = check_that(checks, "it comes to its end", trial.outcome == FBD_DONE);
    same = same && check_close(checks, "place", trial_get(&trial, "b.x"), x, 1e-8);
    same = same && check_close(checks, "speed", trial_get(&trial, "b.v"), v, 1e-8);
    if (!same) printf("# method %s\n%s", methods[method % method_count], text->all);
    trial_close(&trial);
}

static void write_table(struct written *text, const char *units, int count, const double *at,
                        const double *level)
{
    add(text, "fbd: 1\ntables: {T: {interpolation: step, %s, points: [", units);
    for (int i = 0; i < count; i++) add(text, "%s[%.17g, %.17g]", i > 0 ? ", " : "", at[i], level[i]);
    add(text, "]}}\n");
}

/* ---- of a speed
 *
 * m v' = F_0 + k t + T(v), from v_0 with a growing speed. Where T drops by more than F + T it stays at the jump, until F alone
 * is more than the level behind: F + T = 0 there. Between, m (v - v_1) = (F + T)^2 / (2 k), less its value at t_1. */

enum { jumps = 5 };

struct pushed {
    double m, F0, k, v0, end;
    double at[jumps], level[jumps]; /* from at[i] on */
};

static struct pushed draw_pushed(struct random_numbers *numbers)
{
    struct pushed p = {.m = random_between(numbers, 0.5, 2),
                       .k = random_between(numbers, 1, 5),
                       .v0 = random_between(numbers, -1, 1),
                       .end = random_between(numbers, 1, 6)};
    double at = p.v0 - random_between(numbers, 0.1, 1);
    for (int i = 0; i < jumps; i++) {
        p.at[i] = at;
        p.level[i] = random_between(numbers, -8, 2);
        at += (i == 0 ? p.v0 - at : 0) + random_between(numbers, 0.2, 1.5);
    }
    p.F0 = random_between(numbers, 0.1, 2) - p.level[0];
    return p;
}

/* From t at v, with the level y: where it is after `time`. */
static void go_on(const struct pushed *p, double y, double t, double time, double *x, double *v)
{
    double f = p->F0 + p->k * t + y;
    *x += *v * time + (f * time * time / 2 + p->k * time * time * time / 6) / p->m;
    *v += (f * time + p->k * time * time / 2) / p->m;
}

static void follow_pushed(const struct pushed *p, double *x, double *v)
{
    double t = 0;
    *x = 0;
    *v = p->v0;
    for (int i = 0; i < jumps && t < p->end; i++) {
        double f = p->F0 + p->k * t + p->level[i], left = p->end - t, time = left;
        if (f < 0) { /* at the jump, until f = 0 */
            time = fmin(left, -f / p->k);
            *x += *v * time;
            t += time;
            left = p->end - t;
            f = p->F0 + p->k * t + p->level[i];
        }
        if (i + 1 < jumps) {
            double gain = p->m * (p->at[i + 1] - *v);
            time = 2 * gain / (f + sqrt(f * f + 2 * p->k * gain));
        }
        time = i + 1 < jumps ? fmin(time, left) : left;
        go_on(p, p->level[i], t, time, x, v);
        t += time;
    }
}

static void a_speed_stays_at_a_jump_until_it_is_pushed_over(void **unused)
{
    struct checks checks = {0};
    struct random_numbers numbers = {5501};
    struct written *text = calloc(1, sizeof *text);
    (void)unused;
    assert_non_null(text);
    for (int i = 0; i < draws_of(300); i++) {
        const struct pushed p = draw_pushed(&numbers);
        double x, v;
        text->length = 0;
        write_table(text, "x: m/s, y: N", jumps, p.at, p.level);
        add(text,
            "bodies:\n  b:\n    mass: %.17g\n    motion: slide\n    initial: {v: %.17g}\n    forces: "
            "[applied: "
            "\"T(v)\", applied: \"%.17g[N] + %.17g[N/s]*t\"]\nsimulate: {until: %.17g}\n",
            p.m, p.v0, p.F0, p.k, p.end);
        follow_pushed(&p, &x, &v);
        check_end(&checks, text, i, x, v);
    }
    free(text);
    checks_end(&checks);
}

/* ---- of a place
 *
 * A block rests on a jump of T(x), from +a to -b, with friction R: it stays until F = k t is more than b + R, and goes on with
 * m x'' = k (t - t_1). */

static void a_place_is_kept_at_a_jump_until_it_is_pushed_over(void **unused)
{
    struct checks checks = {0};
    struct random_numbers numbers = {5503};
    struct written *text = calloc(1, sizeof *text);
    (void)unused;
    assert_non_null(text);
    for (int i = 0; i < draws_of(200); i++) {
        const double m = random_between(&numbers, 0.5, 2), k = random_between(&numbers, 1, 5),
                     a = random_between(&numbers, 0.5, 3), b = random_between(&numbers, 0.5, 3),
                     R = i % 3 == 0 ? 0 : random_between(&numbers, 0.1, 2),
                     c = random_between(&numbers, -3, 3), far = random_between(&numbers, 5, 9);
        const double at[] = {c - far, c, c + far}, level[] = {a, -b, -b - 1};
        const double leaves = (b + R) / k, end = leaves * random_between(&numbers, 0.5, 1.6),
                     h = fmax(0, end - leaves);
        const double x = k * h * h * h / 6 / m, v = k * h * h / 2 / m;
        if (x > far) continue;
        text->length = 0;
        write_table(text, "x: m, y: N", 3, at, level);
        add(text,
            "gravity: 10\nbodies:\n  b:\n    mass: %.17g\n    motion: {slide: {along: 0, through: [0, 0]}}\n "
            "   "
            "initial: {x: %.17g}\n    forces: [gravity, normal, friction: %.17g, applied: \"T(x)\", applied: "
            "\"%.17g[N/s]*t\"]\nsimulate: {until: %.17g}\n",
            m, c, R / (10 * m), k, end);
        check_end(&checks, text, i, c + x, v);
    }
    free(text);
    checks_end(&checks);
}

/* ---- of both: on the jump of T(x + c v) at s it is x - s that decays, with exp(-t/c). */

static void a_sliding_mode_decays_on_a_jump(void **unused)
{
    struct checks checks = {0};
    struct random_numbers numbers = {5507};
    struct written *text = calloc(1, sizeof *text);
    (void)unused;
    assert_non_null(text);
    for (int i = 0; i < draws_of(200); i++) {
        const double m = random_between(&numbers, 0.5, 2), c = random_between(&numbers, 0.2, 1),
                     s = random_between(&numbers, -1, 1), x0 = s + random_between(&numbers, -1, 1),
                     v0 = -(x0 - s) / c, most = m * fabs(v0) / c, end = random_between(&numbers, 0.5, 4);
        const double at[] = {s - 2, s, s + 2}, level[] = {most * random_between(&numbers, 1.1, 3),
                                                          -most * random_between(&numbers, 1.1, 3), -most};
        text->length = 0;
        write_table(text, "x: m, y: N", 3, at, level);
        add(text,
            "bodies:\n  b:\n    mass: %.17g\n    motion: slide\n    initial: {x: %.17g, v: %.17g}\n    "
            "forces: "
            "[applied: \"T(x + %.17g[s]*v)\"]\nsimulate: {until: %.17g}\n",
            m, x0, v0, c, end);
        check_end(&checks, text, i, s + (x0 - s) * exp(-end / c), v0 * exp(-end / c));
    }
    free(text);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_speed_stays_at_a_jump_until_it_is_pushed_over),
        cmocka_unit_test(a_place_is_kept_at_a_jump_until_it_is_pushed_over),
        cmocka_unit_test(a_sliding_mode_decays_on_a_jump),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
