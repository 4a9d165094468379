/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction that goes with the slip: of every pair that there is, against closed forms of v' = -A - B v and
 * others, and its exact Jacobian against differences.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "dynamics/modes.h"
#include "fbd_study.h"
#include "gallery.h"
#include "random_numbers.h"
#include "scenes.h"
#include "thorough.h"

#include <string.h>

#define RUN "simulate: {until: 20 s}\n"

static const double g = 9.81;

/* ---- when it stops: s' = -a (mu + c s) from s_0 */

static double stops_at(double a, double mu, double c, double s0)
{
    return log1p(c * s0 / mu) / (a * c);
}

struct pair {
    const char *name, *text;
    double a, mu, c, s0;
};

static const struct pair pairs[] = {
    {"a slide",
     "fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: slide\n    initial: {v: -3}\n"
     "    forces: [gravity, normal, friction: \"0.3 + 0.2[s/m]*slip\"]\n" RUN,
     9.81, 0.3, 0.2, 3},
    {"a belt",
     "fbd: 1\nbodies:\n  b:\n    mass: 2\n    motion: slide\n    initial: {v: -1}\n    forces:\n      - "
     "gravity\n"
     "      - normal\n      - friction: {kinetic: \"0.3 + 0.2[s/m]*slip\", surface_speed: 2}\n" RUN,
     9.81, 0.3, 0.2, 3},
    {"a bearing",
     "fbd: 1\nbodies:\n  b:\n    mass: 1\n    inertia: 2\n    motion: {pivot: {at: [0, 0]}}\n"
     "    initial: {omega: 3}\n    moments: [friction: \"0.3[N*m] + 0.2[N*m*s/rad]*slip\"]\n" RUN,
     0.5, 0.3, 0.2, 3},
    {"a bearing that turns",
     "fbd: 1\nbodies:\n  b:\n    mass: 1\n    inertia: 2\n    motion: {pivot: {at: [0, 0]}}\n    moments:\n"
     "      - friction: {kinetic: \"0.3[N*m] + 0.2[N*m*s/rad]*slip\", surface_speed: 3}\n" RUN,
     0.5, 0.3, 0.2, 3},
    {"a ball that begins to roll: s' = -(1 + m R^2/I) mu g", /* 7/2 */
     "fbd: 1\nground: {lines: {floor: {through: [0, 0], along: 0 deg}}}\nbodies:\n  b:\n    mass: 2\n"
     "    shape: sphere\n    radius: 0.1\n    motion: planar\n    initial: {y: 0.1, vx: 4}\n"
     "    forces: [gravity]\ncouplings:\n  - roll: {name: tread, body: b, on: floor, static: 0.2,\n"
     "      kinetic: \"0.2 + 0.05[s/m]*slip\"}\n" RUN,
     3.5 * 9.81, 0.2, 0.05, 4},
    {"a ball on a wedge at rest that is held", /* the line moves on a body; s is counted on it */
     "fbd: 1\nbodies:\n  plank: {mass: 5, motion: slide, initial: {v: 1}}\n  b:\n    mass: 2\n"
     "    shape: sphere\n    radius: 0.1\n    motion: planar\n    initial: {y: 0.1, vx: 4}\n"
     "    forces: [gravity]\ncouplings:\n  - roll: {name: tread, body: b, on: plank,\n"
     "      static: \"0.2 + 0.05[s/m]*slip\"}\n" RUN,
     (3.5 + 0.4) * 9.81, 0.2, 0.05, 3},
    {"two bodies: s' = -(1 + m/M) mu g",
     "fbd: 1\nbodies:\n  sled: {mass: 5, motion: slide}\n  b:\n    mass: 2\n    motion: {slide: {on: sled}}\n"
     "    initial: {v: 3}\n    forces: [gravity, normal, friction: {kinetic: \"0.3 + 0.2[s/m]*slip\"}]\n" RUN,
     1.4 * 9.81, 0.3, 0.2, 3},
    {"two jointed bars: I_1 on the ground, I_2 on it, both about one axis", /* s' = -M (1/I_1 + 1/I_2) */
     "fbd: 1\nbodies:\n  one: {mass: 1, inertia: 3, motion: {pivot: {at: [0, 0]}}}\n  b:\n    mass: 1\n"
     "    inertia: 1.5\n    motion: {pivot: {on: one, at: [0, 0]}}\n    initial: {omega: -3}\n"
     "    moments: [friction: {static: 0.5, kinetic: \"0.3[N*m] + 0.2[N*m*s]*slip\"}]\n" RUN,
     1, 0.3, 0.2, 3},
};

/* Errors of the instant: 1e-10 of the speed over the rate at which it stops, in some ten steps. */
static void each_pair_stops_when_it_should(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        const struct pair *pair = &pairs[i];
        struct trial trial = trial_parse(pair->text);
        trial_run(&trial, NULL);
        double want = stops_at(pair->a, pair->mu, pair->c, pair->s0);
        check_close(&checks, pair->name, trial_event(&trial, FBD_EVENT_STICK, NULL, 0), want,
                    1e-9 * pair->s0 / (pair->a * pair->mu));
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- Jacobians */

static void set_random(struct fbd_state *state, struct random_numbers *numbers)
{
    size_t size = 2 * (size_t)state->model->plan.n;
    for (size_t i = 0; i < size; i++) state->y[i] = random_between(numbers, -1, 1);
    for (size_t i = 0; i < state->model->plan.mode_count; i++)
        state->slip[i] = random_bits(numbers) % 2 ? slip_plus : slip_minus;
    state->t = random_between(numbers, 0, 1);
}

/* Central differences of the rates: to the cube root of the rounding, 1e-10 here. */
static void check_jacobian(const struct pair *pair, struct random_numbers *numbers)
{
    enum { most = 16 };
    const double h = 1e-5;
    fbd_model *model = model_from(pair->text);
    struct fbd_state *state = fbd_state_new(model);
    assert_non_null(state);
    size_t n = (size_t)model->plan.n, size = 2 * n;
    double y[most], low[most], high[most], dfdy[most * most], dfdt[most], scratch[400];
    assert_true(size <= most && 2 * (size_t)model->plan.slots + 4 * n <= 400);
    for (int point = 0; point < 20; point++) {
        set_random(state, numbers);
        memcpy(y, state->y, size * sizeof *y);
        struct instant at = state_instant(state);
        at.y = y;
        state_jacobian(model, &at, scratch, dfdy, dfdt);
        for (size_t j = 0; j < size; j++) {
            double kept = y[j];
            y[j] = kept - h;
            state_rates(model, &at, scratch, low);
            y[j] = kept + h;
            state_rates(model, &at, scratch, high);
            y[j] = kept;
            for (size_t i = 0; i < size; i++) {
                double slope = (high[i] - low[i]) / (2 * h), got = dfdy[i * size + j];
                if (fabs(got - slope) > 1e-7 * (1 + fabs(slope)))
                    fail_msg("%s: df_%zu/dy_%zu is %.12g, by differences %.12g", pair->name, i, j, got,
                             slope);
            }
        }
    }
    fbd_state_free(state);
    fbd_model_free(model);
}

static void the_jacobian_is_that_of_differences(void **unused)
{
    (void)unused;
    enum { seed = 1821 };
    struct random_numbers numbers = {seed};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) check_jacobian(&pairs[i], &numbers);
}

/* ---- what holds at rest, and from there */

/* `slip` is the number 0 in `static`, also where one key says both. */
static void at_rest_the_slip_is_zero(void **unused)
{
    (void)unused;
    static const char *const laws[] = {"{static: \"0.5 - 0.2[s/m]*slip\", kinetic: 0.3}",
                                       "\"0.5 - 0.2[s/m]*slip\"", "{kinetic: \"0.5 - 0.2[s/m]*slip\"}",
                                       "{static: \"0.5 - 0.2[s/m]*slip\"}"};
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof laws / sizeof *laws; i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    forces: [gravity, normal,\n"
                 "      friction: %s, applied: \"2[N/s]*t\"]\nsimulate: {until: 3 s}\n",
                 laws[i]);
        struct trial trial = trial_parse(text);
        check_that(&checks, "the static coefficient is a number", !trial.model->plan.modes[0].mu_s.expr);
        trial_run(&trial, NULL);
        check_close(&checks, "breakaway", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), 0.5 * g / 2,
                    1e-12);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A coefficient that falls in steps of the slip: from 3 m/s by 0.2 g to 1 m/s, by 0.5 g to rest; away again
 * by the law at zero. */
static void a_kink_in_the_slip_is_an_event(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    initial: {v: 3}\n    forces: [gravity,\n"
        "      normal, friction: \"if(slip < 1, 0.5, 0.2)\", applied: {name: later,\n"
        "      value: \"if(t < 3[s], 0, -8[N])\"}]\nsimulate: {until: 5 s}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double slow = 2 / (0.2 * g), rest = slow + 1 / (0.5 * g), fast = 3 + 1 / (8 - 0.5 * g);
    check_close(&checks, "slip = 1", trial_event(&trial, FBD_EVENT_SWITCH, "friction", 0), slow, 1e-12);
    check_close(&checks, "rest", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), rest, 1e-12);
    check_close(&checks, "away", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), 3, 1e-12);
    check_close(&checks, "slip = 1 again", trial_event(&trial, FBD_EVENT_SWITCH, "friction", 1), fast, 1e-12);
    check_close(&checks, "v", trial_get(&trial, "v"), -1 - (8 - 0.2 * g) * (5 - fast), 1e-11);
    trial_close(&trial);
    checks_end(&checks);
}

/* A law with a root has no value beyond rest, where every step goes to find it: v' = -g (mu + c sqrt(v)). */
static void a_law_with_a_root_stops_as_well(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    initial: {v: 3}\n"
                    "    forces: [gravity, normal, friction: \"0.3 + 0.2*(slip/1[m/s])^0.5\"]\n" RUN);
    trial_run(&trial, NULL);
    double w = sqrt(3), want = 2 / g * (w / 0.2 - 0.3 / 0.04 * log1p(0.2 * w / 0.3));
    check_close(&checks, "stops", trial_event(&trial, FBD_EVENT_STICK, NULL, 0), want, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* A law that has nothing at rest, where no force acts yet: it slips to the side to which the force grows, without an event.
 * v' = A t - g v / v_1 with v(0) = 0. */
static void a_law_without_a_limit_slips_where_the_force_goes(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int side = -1; side <= 1; side += 2) {
        char text[300];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    forces:\n      - gravity\n"
                 "      - normal\n      - friction: \"slip/1[m/s]\"\n"
                 "      - applied: {value: \"%d[N/s]*t\"}\nsimulate: {until: 3 s}\n",
                 2 * side);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "done", trial.outcome == FBD_DONE);
        check_that(&checks, "no event", fbd_simulation_event_count(trial.simulation) == 0);
        double want = 2 * (3 / g - (1 - exp(-3 * g)) / (g * g));
        check_close(&checks, "v", trial_get(&trial, "v"), side * want, 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* On a running belt x'' = -k x/m + mu(v_b - x') g: about k x = mu m g the law's slope is a damper, and a
 * negative one where friction falls. */
static void steady_slip_is_linearised(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_open("hard/stribeck_belt.yaml", NULL);
    fbd_state *state = fbd_state_new(trial.model);
    fbd_errors *errors = fbd_errors_new();
    fbd_linearization *linear = fbd_linearize(state, errors);
    assert_non_null(linear);
    const double *A = fbd_linearization_matrix(linear);
    double slope = 0.15 / 0.1 * exp(-2) * g;
    check_close(&checks, "A[1][0]", A[2], -100, 1e-12);
    check_close(&checks, "A[1][1]", A[3], slope, 1e-12);
    check_close(&checks, "exponent", fbd_linearization_mode(linear, 0).re, slope / 2, 1e-12);
    fbd_linearization_free(linear);
    fbd_errors_free(errors);
    fbd_state_free(state);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- the same law written in the velocities, by hand */

/* A block on a shaken belt, which may lie on a shaken table, a spring and a damper; what presses it varies.
 * With `slip`, or with abs(v - s): then a switch of the law stands where the block sticks, stops and breaks
 * away. */
static struct trial shaken_belt(uint64_t seed, bool by_slip)
{
    enum { a, b, w, table_w, mass, v, k, c, press, press_w, mu_d, more, v_s, digits, number_count };
    static const double least[] = {0.05, 0.05, 1, 1, 0.5, -0.5, 20, 0, 0, 2, 0.15, 0.02, 0.05, 6},
                        most[] = {0.3, 0.4, 5, 5, 3, 0.5, 150, 0.5, 4, 9, 0.3, 0.3, 0.3, 12};
    char s[200], law[300], table[200] = "", text[1500];
    struct random_numbers numbers = {seed};
    double x[number_count];
    for (int i = 0; i < number_count; i++) x[i] = random_between(&numbers, least[i], most[i]);
    bool jointed = seed % 2;
    snprintf(s, sizeof s, "%.3g[m/s] + %.3g[m/s]*sin(%.3g[rad/s]*t)", x[a], x[b], x[w]);
    if (jointed)
        snprintf(table, sizeof table,
                 "  table: {mass: 1, motion: {slide: {x: \"0.2[m]*sin(%.3g[rad/s]*t)\"}}}\n", x[table_w]);
    snprintf(law, sizeof law, by_slip ? "slip" : "abs(v - (%s))", s);
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n%s  b:\n    mass: %.3g\n    motion: {slide: {%s}}\n"
             "    initial: {x: 0.1, v: %.2g}\n"
             "    forces:\n      - gravity\n      - normal\n      - spring: {stiffness: %.3g}\n"
             "      - damper: {coefficient: %.3g}\n"
             "      - applied: {name: press, value: [\"0[N]\", \"-%.3g[N]*sin(%.3g[rad/s]*t)\"]}\n"
             "      - friction: {static: %.17g, kinetic: \"%.17g + %.17g*exp(-%s/%.3g[m/s])\", "
             "surface_speed: \"%s\"}\nsimulate: {until: 4 s, tolerance: %.2g}\n",
             table, x[mass], jointed ? "on: table" : "", x[v], x[k], x[c], x[press], x[press_w],
             x[mu_d] + x[more], x[mu_d], x[more], law, x[v_s], s, pow(10, -x[digits]));
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    return trial;
}

static void a_law_written_by_hand_is_the_same(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    int sticks = 0;
    for (uint64_t seed = 1; seed <= (thorough() ? 200 : 20); seed++) {
        struct trial by_hand = shaken_belt(seed, false), by_slip = shaken_belt(seed, true);
        char name[60];
        snprintf(name, sizeof name, "seed %d: both run to the end", (int)seed);
        check_that(&checks, name, by_hand.outcome == FBD_DONE && by_slip.outcome == FBD_DONE);
        snprintf(name, sizeof name, "seed %d: x at the end", (int)seed);
        check_close(&checks, name, trial_get(&by_hand, "x"), trial_get(&by_slip, "x"), 1e-5);
        snprintf(name, sizeof name, "seed %d: v at the end", (int)seed);
        check_close(&checks, name, trial_get(&by_hand, "v"), trial_get(&by_slip, "v"), 1e-4);
        sticks += isfinite(trial_event(&by_slip, FBD_EVENT_STICK, NULL, 0));
        trial_close(&by_hand);
        trial_close(&by_slip);
    }
    check_that(&checks, "some stick", sticks > 10);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pair_stops_when_it_should),
        cmocka_unit_test(the_jacobian_is_that_of_differences),
        cmocka_unit_test(at_rest_the_slip_is_zero),
        cmocka_unit_test(a_kink_in_the_slip_is_an_event),
        cmocka_unit_test(a_law_with_a_root_stops_as_well),
        cmocka_unit_test(a_law_without_a_limit_slips_where_the_force_goes),
        cmocka_unit_test(steady_slip_is_linearised),
        cmocka_unit_test(a_law_written_by_hand_is_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
