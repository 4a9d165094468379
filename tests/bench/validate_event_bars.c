/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Error bars of scenes that are rich in events: estimated over true errors of random scenes
 *
 *     x'' = -k x - c v - p sin x + F s(t, x, v),    s = +1 or -1 (or 1 and 0),
 *
 * a free block, an oscillator or a pendulum under a force that switches by time (a square wave, a sine over a
 * threshold) or by where the body is. What is true is integrated here in long doubles, by Taylor series from
 * switch to switch.
 *
 * Usage: validate_event_bars SCENES [SEED]
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "error_ratio.h"
#include "random_numbers.h"

enum { order = 24, text_size = 1500 };

enum form { by_square, by_sine, by_place, by_speed, form_kinds };

struct scene {
    double k, c, p, F, x0, v0, until;
    enum form form;
    double period, threshold;
};

/* The truth on its way. */
struct trajectory {
    struct scene scene;
    long double t, x, v;
    int side;  /* of the switch */
    bool lost; /* a zero that is hardly one */
};

static struct trajectory course;

/* ---- the truth */

/* x(s) = sum x_j s^j. With S = sin x, C = cos x: S' = C x', C' = -S x'. */
static void series(const struct trajectory *at, long double F, long double *x)
{
    const struct scene *scene = &at->scene;
    long double S[order + 1], C[order + 1];
    x[0] = at->x, x[1] = at->v;
    S[0] = sinl(at->x), C[0] = cosl(at->x);
    for (int j = 0; j + 2 <= order; j++) {
        if (j > 0) {
            S[j] = C[j] = 0;
            for (int i = 1; i <= j; i++) {
                S[j] += i * x[i] * C[j - i] / j;
                C[j] -= i * x[i] * S[j - i] / j;
            }
        }
        long double a = -(long double)scene->k * x[j] - (long double)scene->c * (j + 1) * x[j + 1] -
                        (long double)scene->p * S[j] + (j == 0 ? F : 0);
        x[j + 2] = a / ((j + 1) * (j + 2));
    }
}

static void value(const long double *x, long double s, long double *place, long double *speed)
{
    *place = x[order], *speed = 0;
    for (int j = order - 1; j >= 0; j--) *speed = *speed * s + *place, *place = *place * s + x[j];
}

/* The switching function, and its rate, at s from the present moment. */
static long double switching(const struct trajectory *at, const long double *x, long double s,
                             long double *rate)
{
    const struct scene *scene = &at->scene;
    const long double turn = 2 * acosl(-1), w = turn / (long double)scene->period;
    long double place, speed, before, after, little = 1e-4L;
    switch (scene->form) {
    case by_square: *rate = w * cosl(w * (at->t + s)); return sinl(w * (at->t + s));
    case by_sine: *rate = w * cosl(w * (at->t + s)); return sinl(w * (at->t + s)) - scene->threshold;
    case by_place: value(x, s, &place, rate); return place - scene->threshold;
    default: break;
    }
    value(x, s, &place, &speed);
    value(x, s - little, &place, &before);
    value(x, s + little, &place, &after);
    *rate = (after - before) / (2 * little);
    return speed - scene->threshold;
}

static long double force(const struct trajectory *at)
{
    const struct scene *scene = &at->scene;
    switch (scene->form) {
    case by_square:
    case by_speed: return (long double)scene->F * at->side;
    default: return at->side > 0 ? (long double)scene->F : 0;
    }
}

/* To the time t, from switch to switch, in short steps. */
static void go(struct trajectory *at, long double t)
{
    const long double longest = 0.02L;
    while (at->t < t) {
        long double x[order + 1], h = fminl(longest, t - at->t), rate;
        series(at, force(at), x);
        long double end = switching(at, x, h, &rate);
        bool crosses = end * at->side < 0;
        for (int i = 1; i < 8; i++) { /* there and back */
            long double inner = switching(at, x, h * i / 8, &rate);
            at->lost |= !crosses && inner * at->side < 0;
        }
        if (crosses) {
            long double low = 0, high = h;
            for (int i = 0; i < 80; i++) {
                long double s = (low + high) / 2;
                *(switching(at, x, s, &rate) * at->side < 0 ? &high : &low) = s;
            }
            h = high;
            at->lost |= fabsl(rate) < 1e-3L;
        }
        value(x, h, &at->x, &at->v);
        at->t += h;
        if (crosses) at->side = -at->side;
    }
    at->t = t;
}

static void exact(double t, double *y)
{
    if (t == 0) {
        const struct scene *scene = &course.scene;
        long double rate, x[order + 1] = {(long double)scene->x0, (long double)scene->v0};
        course = (struct trajectory){.scene = *scene, .x = x[0], .v = x[1]};
        long double start = switching(&course, x, 0, &rate);
        course.side = start > 0 || (start == 0 && rate > 0) ? 1 : -1;
    }
    go(&course, t);
    y[0] = (double)course.x;
    y[1] = (double)course.v;
}

/* ---- the scenes */

static double power_between(struct random_numbers *numbers, double low, double high)
{
    return low * pow(high / low, random_between(numbers, 0, 1));
}

static struct scene random_scene(struct random_numbers *numbers)
{
    int body = (int)(random_bits(numbers) % 4);
    struct scene scene = {.form = (enum form)(random_bits(numbers) % form_kinds)};
    if (body == 1 || body == 2) scene.k = power_between(numbers, 0.3, 20);
    if (body == 2) scene.c = power_between(numbers, 1e-5, 0.3);
    if (body == 3) scene.p = power_between(numbers, 0.5, 10);
    bool turns = body > 0;
    if (!turns && scene.form >= by_place) scene.form -= by_place;
    scene.F = random_between(numbers, 0.1, 1);
    scene.x0 = random_between(numbers, 0.3, 1);
    scene.v0 = random_between(numbers, -1, 1);
    scene.period = power_between(numbers, 0.3, 5);
    scene.threshold = random_between(numbers, -0.6, 0.6);
    if (scene.form == by_place && body == 2) scene.c *= 0.01; /* it has to pass the place for long */
    if (scene.form == by_speed) scene.F *= 0.2, scene.threshold *= 0.3;
    scene.until = floor(power_between(numbers, 10, 1000));
    return scene;
}

static void write_scene(const struct scene *scene, char *text)
{
    char condition[200], conservative[200] = "";
    switch (scene->form) {
    case by_square: snprintf(condition, sizeof condition, "square(t/%.17g[s])", scene->period); break;
    case by_sine:
        snprintf(condition, sizeof condition, "if(sin(2*pi*t/%.17g[s]) > %.17g, 1, 0)", scene->period,
                 scene->threshold);
        break;
    case by_place: snprintf(condition, sizeof condition, "if(x > %.17g[m], 1, 0)", scene->threshold); break;
    default: snprintf(condition, sizeof condition, "if(v > %.17g[m/s], 1, -1)", scene->threshold); break;
    }
    int length = 0;
    if (scene->k > 0)
        length += snprintf(conservative, sizeof conservative, ", spring: {stiffness: %.17g}", scene->k);
    if (scene->c > 0)
        length += snprintf(conservative + length, sizeof conservative - (size_t)length, ", damper: %.17g",
                           scene->c);
    if (scene->p > 0)
        snprintf(conservative + length, sizeof conservative - (size_t)length,
                 ", applied: {name: p, value: \"-%.17g[N]*sin(x/1[m])\"}", scene->p);
    snprintf(text, text_size,
             "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, initial: {x: %.17g, v: %.17g}, forces: "
             "[applied: {name: u, value: \"%.17g[N]*%s\"}%s]}\nsimulate: {until: %.17g s}\n",
             scene->x0, scene->v0, scene->F, condition, conservative, scene->until);
}

static bool add_scene(struct ratio_table *table, uint64_t seed)
{
    static const char *const methods[] = {"auto", "auto", "auto", "dop853", "rk8pd", "rkf45"};
    struct random_numbers numbers = {seed};
    struct scene scene = random_scene(&numbers);
    const char *method = methods[random_bits(&numbers) % (sizeof methods / sizeof *methods)];
    double tolerance = power_between(&numbers, 1e-13, 1e-4), y[2];
    char text[text_size];
    write_scene(&scene, text);
    course.scene = scene;
    exact(0, y);
    exact(scene.until, y);
    if (course.lost || fabs(y[0]) > 1e6) return false;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, errors);
    struct truth *truth = model ? truth_new(model, exact) : NULL;
    bool added = truth && ratio_add(table, truth, method, tolerance, 0);
    truth_free(truth);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return added;
}

int main(int argc, char **argv)
{
    uint64_t scenes = argc > 1 ? strtoull(argv[1], NULL, 10) : 1000, first = 1, added = 0;
    if (argc > 2) first = strtoull(argv[2], NULL, 10);
    struct ratio_table table = {.verbose = getenv("FBD_VERBOSE") != NULL};
    gsl_set_error_handler_off();
    for (uint64_t seed = first; seed < first + scenes; seed++) {
        if (table.verbose) printf("# seed %llu\n", (unsigned long long)seed);
        added += add_scene(&table, seed);
    }
    printf("%llu scenes\n%-20s %7s %7s %7s %7s %7s %7s %14s\n", (unsigned long long)added, "", "cases",
           "< 0.3", "good", "> 10", "floor", "over", "good of all");
    for (int k = 0; k < ratio_kinds; k++) {
        const struct ratio_counts *c = &table.counts[k];
        printf("%-20s %7lu %7lu %7lu %7lu %7lu %7lu %12.1f %%\n", ratio_names[k],
               c->low + c->good + c->high + c->floor + c->over, c->low, c->good, c->high, c->floor, c->over,
               100 * ratio_share(c));
    }
    return 0;
}
