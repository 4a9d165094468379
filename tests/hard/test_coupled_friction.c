/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Two blocks with friction on one spring, of which one is thrown.
 *
 * What makes it hard: four patterns of stick and slip, and the breakaway of one block is decided by the
 * motion of the other.
 *
 * Reference: closed form in each pattern, with equal masses m. While b rests a swings about b - f/k with w^2
 * = k/m; while both slide the sum of their places is a parabola and the difference swings with w^2 = 2 k/m.
 * The end of a pattern is the first of: a velocity zero, the spring at the limit of a resting block; found by
 * sampling and bisection to rounding.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "hard.h"

static const double g = 9.81, m = 1, k = 100, mu_s = 0.5, mu_d = 0.3, v0 = 4;

/* Signs of slip, 0 for stick. */
struct pattern {
    double x[2], v[2];
    int slip[2];
};

static double friction_of(const struct pattern *p, int i)
{
    return -p->slip[i] * mu_d * m * g;
}

/* x and v of a motion x'' = -w^2 x + c after s. */
static void swing(double w, double c, double s, double *x, double *v)
{
    double middle = c / (w * w), from = *x - middle, speed = *v;
    *x = middle + from * cos(w * s) + speed / w * sin(w * s);
    *v = speed * cos(w * s) - from * w * sin(w * s);
}

static struct pattern after(struct pattern p, double s)
{
    struct pattern q = p;
    if (p.slip[0] && p.slip[1]) {
        double f[2] = {friction_of(&p, 0), friction_of(&p, 1)};
        double sum = p.x[0] + p.x[1], sum_v = p.v[0] + p.v[1], d = p.x[0] - p.x[1], d_v = p.v[0] - p.v[1];
        sum += sum_v * s + (f[0] + f[1]) / m * s * s / 2;
        sum_v += (f[0] + f[1]) / m * s;
        swing(sqrt(2 * k / m), (f[0] - f[1]) / m, s, &d, &d_v);
        return (struct pattern){{(sum + d) / 2, (sum - d) / 2},
                                {(sum_v + d_v) / 2, (sum_v - d_v) / 2},
                                {p.slip[0], p.slip[1]}};
    }
    for (int i = 0; i < 2; i++)
        if (p.slip[i]) {
            double d = p.x[i] - p.x[1 - i];
            swing(sqrt(k / m), friction_of(&p, i) / m, s, &d, &q.v[i]);
            q.x[i] = p.x[1 - i] + d;
        }
    return q;
}

/* Negative once block i has reached the end of its pattern. */
static double margin(const struct pattern *p, int i)
{
    if (p->slip[i]) return p->slip[i] * p->v[i];
    return mu_s * m * g - k * fabs(p->x[0] - p->x[1]);
}

struct search {
    struct pattern start;
    int block;
};

static double margin_after(double s, const void *context)
{
    const struct search *search = context;
    struct pattern p = after(search->start, s);
    return margin(&p, search->block);
}

/* What block i does next, with the force of the spring on it. */
static void decide(struct pattern *p, int i)
{
    double spring = k * (p->x[1 - i] - p->x[i]);
    bool rested = p->slip[i] == 0;
    p->v[i] = rested ? p->v[i] : 0;
    p->slip[i] = rested || fabs(spring) > mu_s * m * g ? (spring > 0 ? 1 : -1) : 0;
}

/* Carry to the next change; false when both rest for good. */
static bool next(struct pattern *p, double *t)
{
    const double step = 1e-3;
    if (!p->slip[0] && !p->slip[1]) return false;
    for (int count = 1;; count++)
        for (int i = 0; i < 2; i++) {
            const double s = count * step;
            struct search search = {*p, i}, other = {*p, 1 - i};
            if (margin_after(s, &search) >= 0) continue;
            double first = hard_root(margin_after, &search, s - step * 0.999999, s);
            if (margin_after(s, &other) < 0) {
                double second = hard_root(margin_after, &other, s - step * 0.999999, s);
                if (second < first) first = second, search.block = 1 - i;
            }
            *p = after(*p, first);
            *t += first;
            decide(p, search.block);
            return true;
        }
}

static double event_time(const struct trial *trial, size_t index)
{
    return index < fbd_simulation_event_count(trial->simulation)
               ? fbd_simulation_event(trial->simulation, index).t
               : NAN;
}

static void every_transition_of_both(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        struct trial trial = trial_open("hard/coupled_friction.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial)) {
            struct pattern p = {{0, 0}, {v0, 0}, {1, 0}};
            double t = 0, error = 0;
            size_t count = 0;
            for (; next(&p, &t); count++) error = fmax(error, fabs(event_time(&trial, count) - t));
            check_that(&checks, "as many events", count == fbd_simulation_event_count(trial.simulation));
            /* Velocities up to 4 m/s are stopped with 3 m/s^2 at the least: 1.4 s times the promise; a
             * transition carries the error of the ones before it, which as much again is allowed for. */
            double promise = hard_promise(&trial);
            hard_case(&checks, &trial, "15 transitions", error, 3 * promise);
            double place =
                fmax(fabs(trial_get(&trial, "a.x") - p.x[0]), fabs(trial_get(&trial, "b.x") - p.x[1]));
            hard_case(&checks, &trial, "where they stay", place, promise);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_transition_of_both),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
