/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What starts from rest in the middle of a spring that stiffens, u'' = g - k u^p, or under drag with the square of the
 * speed, u'' = g - c u'^2, or by a force that fades, u'' = g (1 + t/s)^-2, or turns, g sin(t/s), on a line, about a pivot, in a plane, and as a
 * state; looked at early in a run that may be a million times as long.
 *
 * What makes it hard: at the start neither force is there, nor its derivative. Errors are counted by what a number has
 * been, and by a guess where it has been zero: what the first acceleration does in a thousandth of the run was 10 km
 * where the spring lets the body go 1 cm, and at a tolerance of 1e-9 none of the digits was right.
 *
 * Reference: it turns at U = ((p + 1) g / k)^(1/p), after half a period T/2 = sqrt(2 U / g) B(1/(2p), 1/2) / (2p), from
 * u'^2 = 2 g u - 2 k u^(p+1) / (p + 1) with (u/U)^p for the variable; under drag u' = V tanh(t/s) with V = sqrt(g/c) and
 * s = 1/sqrt(g c), u = V s ln cosh(t/s); the force that fades leaves u' = g s (1 - 1/(1 + t/s)),
 * the one that turns g s (1 - cos(t/s)).
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_sf_gamma.h>

#include "hard.h"
#include "random_numbers.h"

enum law { spring, drag, fading, turning };
enum dress { on_a_line, about_a_pivot, in_a_plane, as_a_state, dress_count };

struct start {
    enum dress dress;
    enum law kind;
    int power;       /* of the spring */
    double g, law;   /* k or c, by mass or inertia */
    double angle;    /* of the way in a plane */
    double size;     /* of the place, or 0 under drag: it goes on */
    double fastest;  /* of the speed */
    double time;     /* half a period, or s */
    double duration; /* of the run */
};

static struct start random_start(struct random_numbers *numbers)
{
    struct start start = {.dress = (enum dress)(random_between(numbers, 0, dress_count)),
                          .g = pow(10, random_between(numbers, -2, 3)),
                          .law = pow(10, random_between(numbers, 0, 9)),
                          .angle = random_between(numbers, 0, 7)};
    double chosen = random_between(numbers, 0, 1);
    start.kind = chosen < 0.2                                ? fading
                 : chosen < 0.4                              ? turning
                 : start.dress == as_a_state || chosen < 0.6 ? drag
                                                             : spring;
    start.time = 1 / sqrt(start.g * start.law);
    start.fastest = sqrt(start.g / start.law); /* fading: with this time, too */
    if (start.kind == spring) {
        int p = start.power = 3 + 2 * (int)random_between(numbers, 0, 3);
        start.size = pow((p + 1) * start.g / start.law, 1.0 / p);
        start.time = sqrt(2 * start.size / start.g) * gsl_sf_beta(0.5 / p, 0.5) / (2 * p);
        double where = pow(p + 1, -1.0 / p) * start.size; /* g = k u^p */
        start.fastest = sqrt(2 * start.g * where * p / (p + 1));
    }
    start.duration = start.time * pow(10, random_between(numbers, 1, 6));
    return start;
}

/* g - k u^p, g - c v |v| or g (1 + t/s)^-2, of numbers without units. */
static void write_law(const struct start *start, double g, const char *u, const char *v, char *law,
                      size_t size)
{
    if (start->kind == spring)
        snprintf(law, size, "%.17g - %.17g*(%s)^%d", g, start->law, u, start->power);
    else if (start->kind == drag)
        snprintf(law, size, "%.17g - %.17g*(%s)*abs(%s)", g, start->law, v, v);
    else if (start->kind == fading)
        snprintf(law, size, "%.17g/(1 + t/%.17g[s])^2", g, start->time);
    else
        snprintf(law, size, "%.17g*sin(t/%.17g[s])", g, start->time);
}

static void write_straight(const struct start *start, char *body, size_t size)
{
    bool turns = start->dress == about_a_pivot;
    char law[200];
    write_law(start, start->g, turns ? "theta" : "x/1[m]", turns ? "omega/1[rad/s]" : "v/1[m/s]", law,
              sizeof law);
    snprintf(body, size, "motion: %s, %s: [applied: {name: f, value: \"(%s)*1[%s]\"}]",
             turns ? "pivot" : "slide", turns ? "inertia: 1, moments" : "forces", law, turns ? "N*m" : "N");
}

static void write_plane(const struct start *start, char *body, size_t size)
{
    double gx = start->g * cos(start->angle), gy = start->g * sin(start->angle);
    if (start->kind == drag) {
        snprintf(body, size,
                 "motion: particle, forces: [applied: {value: [%.17g, %.17g]}, drag: {quadratic: %.17g}]", gx,
                 gy, start->law);
        return;
    }
    if (start->kind != spring) {
        char fx[100], fy[100];
        write_law(start, gx, "", "", fx, sizeof fx);
        write_law(start, gy, "", "", fy, sizeof fy);
        snprintf(body, size, "motion: particle, forces: [applied: {value: [\"(%s)*1[N]\", \"(%s)*1[N]\"]}]",
                 fx, fy);
        return;
    }
    char pull[100];
    snprintf(pull, sizeof pull, "%.17g*((x^2 + y^2)/1[m^2])^%d/1[m]", start->law, (start->power - 1) / 2);
    snprintf(body, size,
             "motion: particle, forces: [applied: {name: f, fx: \"(%.17g - %s*x)*1[N]\", fy: \"(%.17g - "
             "%s*y)*1[N]\"}]",
             gx, pull, gy, pull);
}

static struct trial trial_of(const struct start *start)
{
    char body[600] = "motion: slide", state[200] = "", law[100], text[1000];
    write_law(start, start->g, "", "s", law, sizeof law);
    if (start->dress == as_a_state)
        snprintf(state, sizeof state, "states: {s: {rate: \"(%s)*1[1/s]\", initial: 0, unit: 1}}\n", law);
    else if (start->dress == in_a_plane)
        write_plane(start, body, sizeof body);
    else
        write_straight(start, body, sizeof body);
    snprintf(text, sizeof text, "fbd: 1\n%sbodies: {b: {mass: 1, %s}}\nsimulate: {until: %.17g}\n", state,
             body, start->duration);
    return trial_parse(text);
}

/* Of place and speed, as shares of their sizes, where `place` and `speed` are right. */
static double error_of(const struct start *start, const struct trial *trial, double place, double speed)
{
    const char *names[][2] = {[on_a_line] = {"b.x", "b.v"}, [about_a_pivot] = {"b.theta", "b.omega"}};
    if (start->dress == as_a_state) return fabs(trial_get(trial, "states.s") - speed) / start->fastest;
    double of_place, of_speed, size = start->size > 0 ? start->size : fabs(place);
    if (start->dress == in_a_plane) {
        double c = cos(start->angle), s = sin(start->angle);
        of_place = hypot(trial_get(trial, "b.x") - place * c, trial_get(trial, "b.y") - place * s);
        of_speed = hypot(trial_get(trial, "b.vx") - speed * c, trial_get(trial, "b.vy") - speed * s);
    } else {
        of_place = fabs(trial_get(trial, names[start->dress][0]) - place);
        of_speed = fabs(trial_get(trial, names[start->dress][1]) - speed);
    }
    if (start->dress == about_a_pivot) size = fmax(size, 1); /* an angle has a unit of its own */
    return fmax(of_place / size, of_speed / start->fastest);
}

/* A spring's after `looks` halves of a period each, drag after half of its time each. */
static double worst_error(const struct start *start, struct trial *trial)
{
    enum { looks = 6 };
    double worst = 0;
    for (int i = 1; i <= looks; i++) {
        double s = i / 2.0, v = start->fastest, way = v * start->time;
        switch (start->kind) {
        case spring:
            trial_to(trial, i * start->time);
            worst = fmax(worst, error_of(start, trial, i % 2 ? start->size : 0, 0));
            break;
        case drag:
            trial_to(trial, s * start->time);
            worst = fmax(worst, error_of(start, trial, way * log(cosh(s)), v * tanh(s)));
            break;
        case fading:
            trial_to(trial, s * start->time);
            worst = fmax(worst, error_of(start, trial, way * (s - log1p(s)), v * s / (1 + s)));
            break;
        case turning:
            trial_to(trial, s * start->time);
            worst = fmax(worst, error_of(start, trial, way * (s - sin(s)), v * (1 - cos(s))));
            break;
        }
    }
    return worst;
}

static void check(struct checks *checks, int seed, const struct hard_method *method, double most)
{
    struct random_numbers numbers = {(uint64_t)seed};
    struct start start = random_start(&numbers);
    struct trial trial = trial_of(&start);
    char name[80];
    hard_start(&trial, method, NAN);
    snprintf(name, sizeof name, "seed %d, law %d, dress %d, power %d, a run of %.0e times", seed, start.kind,
             start.dress, start.power, start.duration / start.time);
    double error = worst_error(&start, &trial), promise = hard_promise(&trial);
    /* Estimates of implicit methods of low order are low by as much where a force turns. */
    if (method->order <= 2) promise *= method->order == 2 ? 6 : 2;
    hard_case(checks, &trial, name, error, fmax(most * method->tolerance, 2 * promise) + 1e-13);
    trial_close(&trial);
}

static void its_errors_are_counted_by_what_it_becomes(void **unused)
{
    (void)unused;
    const double most =
        100; /* 40 were measured in 3,000 draws, but for three whose estimate is lucky: up to 2,300; without a bound before */
    const double tolerances[] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
    struct checks checks = {0};
    int first = number_of("FBD_STARTS_SEED", 1), many = number_of("FBD_STARTS", draws_of(100));
    for (int seed = first; seed < first + many; seed++)
        for (size_t i = 0; i < sizeof tolerances / sizeof *tolerances; i++)
            check(&checks, seed, &(struct hard_method){.tolerance = tolerances[i]}, most);
    checks_end(&checks);
}

static void by_every_method(void **unused)
{
    (void)unused;
    const double most =
        1000; /* 930 were measured in 1,000 draws: within steps of msadams; 190 of bsimp, 100 of others */
    struct checks checks = {0};
    struct hard_method method;
    int first = number_of("FBD_STARTS_SEED", 1), many = number_of("FBD_STARTS", draws_of(10));
    for (size_t i = 0; hard_method_at(i, &method); i++)
        for (int seed = first; seed < first + many; seed++) check(&checks, seed, &method, most);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_errors_are_counted_by_what_it_becomes),
        cmocka_unit_test(by_every_method),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
