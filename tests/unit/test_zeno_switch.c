/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Switches that are passed infinitely often in a finite time, and slid on in second order from there.
 *
 * An attraction F towards a place, rubbing R < F, and a constant push P, |P| + R < F: the motion between
 * passages and turns is a parabola each, so that their series is summed up here term by term. Then it rests
 * until a growing push is as large as F + R, which is Coulomb's law for the sum of what holds.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const methods[] = {NULL, "dop853", "rkf45", "rk8pd", "rodas5p", "rk4imp", "rk4", "rkck"};

enum { method_count = sizeof methods / sizeof *methods };

static void run_with(struct trial *trial, const char *method, double tolerance)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = method;
    options.tolerance = tolerance;
    trial_start(trial, &options);
    trial_finish(trial);
}

/* The time to the end of the series, from u with the rate w, per unit of mass. */
static double time_to_rest(double F, double R, double P, double u, double w)
{
    const double least = 1e-17;
    double t = 0, most = fmax(fabs(w), sqrt(2 * F * fabs(u)));
    while (fabs(w) > least * most || u != 0) {
        double side = u != 0 ? (u > 0 ? 1 : -1) : w > 0 ? 1 : -1, push = P * side;
        double far = fabs(u);
        if (w * side > 0) { /* outwards, to the turn */
            double a = F + R - push;
            far += w * w / (2 * a);
            t += fabs(w) / a;
            w = 0;
        }
        double a = F - R - push, v = -w * side; /* inwards, from there */
        double passing = sqrt(v * v + 2 * a * far);
        t += (passing - v) / a;
        u = 0;
        w = -side * passing;
    }
    return t;
}

struct draw {
    double m, n, F, R, P, x, v, place, wait, rate;
};

static struct draw draw_one(struct random_numbers *numbers)
{
    struct draw d = {.m = random_between(numbers, 0.3, 3), .n = random_between(numbers, 0.3, 3)};
    d.F = random_between(numbers, 1, 8);
    d.R = random_between(numbers, 0.15, 0.6) * d.F;
    d.P = random_between(numbers, -0.8, 0.8) * (d.F - d.R);
    d.x = random_between(numbers, -1, 1);
    d.v = random_between(numbers, -1, 1);
    d.place = random_between(numbers, -2, 2);
    d.wait = random_between(numbers, 0.5, 3);
    d.rate = random_between(numbers, 0.3, 2);
    return d;
}

/* Kind 0: rubbing written; 1: in one expression with the attraction; 2: declared; 3: two bodies that attract and
 * rub each other, written twice. The push begins to grow at t = `from`. */
static void write_scene(const struct draw *d, int kind, double from, double end, char *text, size_t size)
{
    char push[200], rub[400];
    snprintf(push, sizeof push, "      - applied: {name: push, value: \"%.17g + %.17g*max(0, t - %.17g)\"}\n",
             d->P, d->P > 0 ? d->rate : -d->rate, from);
    static const char block[] = "fbd: 1\ngravity: 1\nbodies:\n  b:\n    mass: %.17g\n    motion: slide\n"
                                "    initial: {x: %.17g, v: %.17g}\n    forces:\n%s%s"
                                "simulate: {until: %.17g s}\n";
    if (kind == 3) {
        snprintf(
            text, size,
            "fbd: 1\nbodies:\n  b:\n    mass: %.17g\n    motion: slide\n    initial: {x: %.17g, v: %.17g}\n"
            "    forces:\n      - applied: {name: pull, value: \"-%.17g*sign(b.x - c.x)\"}\n"
            "      - applied: {name: rub, value: \"%.17g*sign(c.v - b.v)\"}\n%s"
            "  c:\n    mass: %.17g\n    motion: slide\n    initial: {x: 0, v: 0}\n"
            "    forces:\n      - applied: {name: pull, value: \"if(b.x > c.x, %.17g[N], -%.17g[N])\"}\n"
            "      - applied: {name: rub, value: \"%.17g*sign(b.v - c.v)\"}\nsimulate: {until: %.17g s}\n",
            d->m, d->x, d->v, d->F, d->R, push, d->n, d->F, d->F, d->R, end);
        return;
    }
    if (kind == 0)
        snprintf(rub, sizeof rub,
                 "      - applied: {name: pull, value: \"if(x > %.17g[m], -%.17g[N], %.17g[N])\"}\n"
                 "      - applied: {name: rub, value: \"-%.17g*sign(v)\"}\n",
                 d->place, d->F, d->F, d->R);
    else if (kind == 1)
        snprintf(rub, sizeof rub,
                 "      - applied: {name: pull, value: \"-%.17g*sign(v) - %.17g*sign(3*x - %.17g[m])\"}\n",
                 d->R, d->F, 3 * d->place);
    else
        snprintf(rub, sizeof rub,
                 "      - gravity\n      - normal\n      - friction: %.17g\n"
                 "      - applied: {name: pull, value: \"%.17g*sign(%.17g[m] - x)\"}\n",
                 d->R / d->m, d->F, d->place);
    snprintf(text, size, block, d->m, d->place + d->x, d->v, rub, push, end);
}

static void a_series_ends_and_rests_until_it_is_pushed_away(void **unused)
{
    (void)unused;
    enum { seed = 20261123 };
    const char *wanted = getenv("FBD_PASSAGES");
    const int draws = wanted ? atoi(wanted) : draws_of(160);
    struct checks checks = {0};
    struct random_numbers numbers = {seed};
    printf("# seed %d\n", seed);
    for (int draw = 0; draw < draws; draw++) {
        const struct draw d = draw_one(&numbers);
        int kind = draw % 4;
        /* What pushes one of two bodies accelerates both. */
        double mass = kind == 3 ? d.m * d.n / (d.m + d.n) : d.m,
               P = kind == 3 ? d.P * d.n / (d.m + d.n) : d.P;
        double rest = time_to_rest(d.F / mass, d.R / mass, P / mass, d.x, d.v), from = rest + d.wait;
        double needed = (d.F + d.R) * (kind == 3 ? (d.m + d.n) / d.n : 1);
        double leaves = from + (needed - fabs(d.P)) / d.rate;
        char text[1600];
        write_scene(&d, kind, from, leaves + 1, text, sizeof text);
        struct trial trial = trial_parse(text);
        double tolerance = draw % 3 ? 1e-10 : 1e-8, room = 300 * tolerance;
        run_with(&trial, methods[draw / 4 % method_count], tolerance);
        check_that(&checks, "it gets to the end", trial.outcome == FBD_DONE);
        check_close(&checks, "rests", trial_event(&trial, FBD_EVENT_SLIDING, "pull", 0), rest, room);
        double end = trial_get(&trial, "t"), after = end - leaves, side = P > 0 ? 1 : -1;
        /* Declared friction takes what the switch cannot hold any more. */
        double gives_way = kind == 2 ? leaves - d.R / d.rate : leaves;
        check_close(&checks, "gives way", trial_event(&trial, FBD_EVENT_SLIDING_ENDS, "pull", 0), gives_way,
                    room);
        if (kind == 2)
            check_close(&checks, "leaves", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), leaves, room);
        if (kind != 3) {
            check_close(&checks, "v", trial_get(&trial, "v"), side * d.rate / d.m * after * after / 2, room);
            check_close(&checks, "x", trial_get(&trial, "x"),
                        d.place + side * d.rate / d.m * after * after * after / 6, room);
        }
        if (checks.failed)
            print_message("# draw %d, %s\n%s", draw, fbd_simulation_reason(trial.simulation), text);
        trial_close(&trial);
        if (checks.failed) break;
    }
    checks_end(&checks);
}

/* ---- beside other switches and other holds, by hand */

struct beside {
    const char *what, *bodies;
    double until, x, v;          /* of b, at the end */
    size_t slides, ends, leaves; /* events: sliding, sliding_ends, breakaway */
};

static const struct beside besides[] = {
    {"a switch elsewhere is not pulled in",
     "  b:\n    mass: 1\n    motion: slide\n    initial: {x: 0.5}\n    forces:\n"
     "      - applied: {name: pull, value: \"-4*sign(x)\"}\n      - applied: {name: rub, value: "
     "\"-1.5*sign(v)\"}\n"
     "      - applied: {name: far, value: \"-0.3*sign(x - 1[m])\"}\n",
     5, 0, 0, 2, 0, 0},
    /* It leaves at t - 4 = 4 + 1.5 - 0.3, and passes 3 m/s after sqrt(6) s. */
    {"nor one of another speed",
     "  b:\n    mass: 1\n    motion: slide\n    initial: {x: 0.5}\n    forces:\n"
     "      - applied: {name: pull, value: \"-4*sign(x)\"}\n      - applied: {name: rub, value: "
     "\"-1.5*sign(v)\"}\n"
     "      - applied: {name: fast, value: \"-0.3*sign(v - 3[m/s])\"}\n"
     "      - applied: {name: push, value: \"max(0[N], 1[N/s]*(t - 4[s]))\"}\n",
     12, 3.6218094265, 3.7096938457, 2, 2, 0},
    {"held by the friction of the other body",
     "  b:\n    mass: 1\n    motion: slide\n    forces: [applied: {name: pull, value: \"-4*sign(b.x - "
     "c.x)\"}]\n"
     "  c:\n    mass: 1\n    motion: slide\n    forces:\n      - gravity\n      - normal\n      - friction: "
     "0.8\n"
     "      - applied: {name: pull, value: \"4*sign(b.x - c.x)\"}\n      - applied: {name: push, value: 3}\n",
     5, 0, 0, 0, 0, 0},
    {"held by friction of both",
     "  b:\n    mass: 1\n    motion: slide\n    forces:\n      - gravity\n      - normal\n      - friction: "
     "0.1\n"
     "      - applied: {name: pull, value: \"-4*sign(b.x - c.x)\"}\n"
     "  c:\n    mass: 1\n    motion: slide\n    forces:\n      - gravity\n      - normal\n      - friction: "
     "0.8\n"
     "      - applied: {name: pull, value: \"4*sign(b.x - c.x)\"}\n      - applied: {name: push, value: 3}\n",
     5, 0, 0, 0, 0, 0},
    /* From t = 12 s on both go with (t - 12)/2: b needs no more than 4 of 5 N. */
    {"carried on when that gives way",
     "  b:\n    mass: 1\n    motion: slide\n    initial: {x: 0.5}\n    forces:\n"
     "      - applied: {name: pull, value: \"-4*sign(b.x - c.x)\"}\n"
     "      - applied: {name: rub, value: \"-1*sign(b.v - c.v)\"}\n"
     "  c:\n    mass: 1\n    motion: slide\n    forces:\n      - gravity\n      - normal\n      - friction: "
     "0.8\n"
     "      - applied: {name: pull, value: \"4*sign(b.x - c.x)\"}\n"
     "      - applied: {name: rub, value: \"1*sign(b.v - c.v)\"}\n"
     "      - applied: {name: push, value: \"max(0[N], 1[N/s]*(t - 4[s]))\"}\n",
     20, 128.0 / 3, 16, 4, 0, 1},
    {"a place that is passed ends a slide of the speed",
     "  b:\n    mass: 1\n    motion: slide\n    initial: {x: -5, v: 5}\n    forces:\n"
     "      - applied: {name: hold, value: \"-4*sign(v - 5[m/s])\"}\n"
     "      - applied: {name: gate, value: \"-5*sign(x)\"}\n      - applied: {name: c, value: -2}\n",
     3, 4, -1, 0, 1, 0},
    {"friction gives way beside a switch that has",
     "  b:\n    mass: 1\n    motion: slide\n    initial: {x: 0.5}\n    forces:\n      - gravity\n      - "
     "normal\n"
     "      - friction: 0.15\n      - applied: {name: pull, value: \"-4*sign(x)\"}\n"
     "      - applied: {name: push, value: \"max(0[N], 1[N/s]*(t - 4[s]))\"}\n",
     12, 2.5 * 2.5 * 2.5 / 6, 2.5 * 2.5 / 2, 1, 1, 1},
};

static size_t count_of(const struct trial *trial, fbd_event_kind kind)
{
    size_t count = 0, events = fbd_simulation_event_count(trial->simulation);
    for (size_t i = 0; i < events; i++) count += fbd_simulation_event(trial->simulation, i).kind == kind;
    return count;
}

static void other_switches_and_holds_have_their_own_way(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t k = 0; k < sizeof besides / sizeof *besides; k++)
        for (int m = 0; m < method_count; m++) {
            const struct beside *beside = &besides[k];
            char text[1600];
            snprintf(text, sizeof text, "fbd: 1\ngravity: 10\nbodies:\n%ssimulate: {until: %g s}\n",
                     beside->bodies, beside->until);
            struct trial trial = trial_parse(text);
            run_with(&trial, methods[m], 1e-10);
            bool one = fbd_model_coordinate_count(trial.model) == 1;
            check_close(&checks, beside->what, trial_get(&trial, one ? "x" : "b.x"), beside->x, 1e-6);
            check_close(&checks, beside->what, trial_get(&trial, one ? "v" : "b.v"), beside->v, 1e-6);
            check_that(&checks, beside->what,
                       count_of(&trial, FBD_EVENT_SLIDING) == beside->slides &&
                           count_of(&trial, FBD_EVENT_SLIDING_ENDS) == beside->ends &&
                           count_of(&trial, FBD_EVENT_BREAKAWAY) == beside->leaves);
            trial_close(&trial);
        }
    checks_end(&checks);
}

/* More switches of places than can be tried in all ways are passed, or rested on, as ever. */
static void many_places_at_zero_are_no_trouble(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char *const initial[] = {"{x: 0, v: 1}", "{x: 0}"};
    for (int rests = 0; rests < 2; rests++) {
        char text[4000] = "fbd: 1\nbodies:\n";
        for (int i = 0; i < 20; i++)
            snprintf(
                text + strlen(text), sizeof text - strlen(text),
                "  b%d: {mass: 1, motion: slide, initial: %s, forces: [applied: \"-4*sign(x) + 0*b%d.v\"]}\n",
                i, initial[rests], (i + 1) % 20);
        snprintf(text + strlen(text), sizeof text - strlen(text), "simulate: {until: 0.75 s}\n");
        struct trial trial = trial_parse(text);
        run_with(&trial, NULL, 1e-10);
        /* Back at 0 after 0.5 s, and on with -1 + 4 t. */
        check_close(&checks, "x", trial_get(&trial, "b7.x"), rests ? 0 : -0.125, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_series_ends_and_rests_until_it_is_pushed_away),
        cmocka_unit_test(other_switches_and_holds_have_their_own_way),
        cmocka_unit_test(many_places_at_zero_are_no_trouble),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
