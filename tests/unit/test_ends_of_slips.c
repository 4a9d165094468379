/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * User events in the same step as the end of a slip, at its very instant and beside it by 1e-17 s to 1e-2 s: they change
 * neither the motion nor the modes. A block on an incline against the closed form,
 *
 *     a = -g (sin(phi) + mu_k cos(phi)) up to t_s = v/|a|; then it holds where tan(phi) <= mu_s, or slides back with
 *     a = -g (sin(phi) - mu_k cos(phi)),
 *
 * other scenes (two blocks on a spring, a driven stick-slip, a rope that becomes taut, a disc that bounces and rolls)
 * against themselves without events. FBD_ENDS: how many random scenes.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "random_numbers.h"
#include "scenes.h"
#include "thorough.h"

enum { text_size = 3000, most_told = 400 };

static const double until = 2, g = 9.81;

static double drawn(struct random_numbers *random, double from, double to)
{
    return round(random_between(random, from, to) * 1000) / 1000;
}

/* ---- runs */

struct trajectory {
    size_t count; /* of what is no user event */
    fbd_event_kind kind[most_told];
    double t[most_told], x, v;
    bool ended;
};

static struct trajectory run(const char *bodies, const char *events, const char *x, const char *v)
{
    char text[text_size];
    struct trajectory trajectory = {0};
    snprintf(text, sizeof text, "fbd: 1\n%ssimulate: {until: %g%s}\n", bodies, until, events);
    fbd_model *model = model_from(text);
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
    const fbd_recording recording = {.motion_only = true};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    trajectory.ended = fbd_result_outcome(result) == FBD_DONE;
    fbd_state_get(fbd_result_state(result), x, &trajectory.x);
    fbd_state_get(fbd_result_state(result), v, &trajectory.v);
    for (size_t i = 0; i < fbd_simulation_event_count(simulation) && trajectory.count < most_told; i++) {
        fbd_event event = fbd_simulation_event(simulation, i);
        if (event.kind == FBD_EVENT_USER) continue;
        trajectory.kind[trajectory.count] = event.kind;
        trajectory.t[trajectory.count++] = event.t;
    }
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return trajectory;
}

/* One to three events about `t`, or where `v` is next to nothing. */
static void write_events(struct random_numbers *random, double t, const char *v, const char *unit,
                         char *events)
{
    static const double levels[] = {0, 0, 1e-12, -1e-12, 1e-6, 1e-3};
    size_t count = 1 + random_bits(random) % 3, length = (size_t)sprintf(events, ", events: [");
    for (size_t i = 0; i < count; i++) {
        double off = pow(10, random_between(random, -17, -2)) * ((double)(random_bits(random) % 3) - 1);
        const char *comma = i > 0 ? ", " : "";
        if (random_bits(random) % 3 > 0)
            length +=
                (size_t)sprintf(events + length, "%s{name: e%zu, when: \"t - %.17g[s]\"}", comma, i, t + off);
        else
            length += (size_t)sprintf(events + length, "%s{name: e%zu, when: \"%s - %g[%s]\"}", comma, i, v,
                                      levels[random_bits(random) % 6], unit);
    }
    sprintf(events + length, "]");
}

/* ---- the incline */

static bool stops_as_it_should(struct random_numbers *random)
{
    char bodies[text_size], events[400];
    double phi = random_bits(random) % 3 ? drawn(random, 0, 0.6) : 0, kinetic = drawn(random, 0.1, 0.6);
    double limit = kinetic + drawn(random, 0, 0.2), v = drawn(random, 0.2, 4);
    snprintf(bodies, sizeof bodies,
             "bodies:\n  b: {mass: 2, motion: {slide: {along: %.17g rad}}, initial: {v: %.17g},\n"
             "    forces: [gravity, normal, friction: {static: %.17g, kinetic: %.17g}]}\n",
             phi, v, limit, kinetic);
    double up = g * (sin(phi) + kinetic * cos(phi)), stop = v / up,
           back = g * (sin(phi) - kinetic * cos(phi));
    if (stop > 0.9 * until || fabs(tan(phi) - limit) < 1e-6) return true;
    write_events(random, stop, "b.v", "m/s", events);
    struct trajectory trajectory = run(bodies, events, "b.x", "b.v");
    bool holds = tan(phi) < limit;
    double since = until - stop, x = v * v / (2 * up) - (holds ? 0 : back * since * since / 2);
    bool right = trajectory.ended && fabs(trajectory.x - x) < 1e-9 &&
                 fabs(trajectory.v + (holds ? 0 : back * since)) < 1e-9 && trajectory.count == 1 &&
                 trajectory.kind[0] == (holds ? FBD_EVENT_STICK : FBD_EVENT_REVERSAL) &&
                 fabs(trajectory.t[0] - stop) < 1e-9;
    if (!right)
        print_error("%s%s: ends at %.17g with %.17g, should be %.17g with %.17g; %zu events\n", bodies,
                    events, trajectory.x, trajectory.v, x, holds ? 0 : -back * since, trajectory.count);
    return right;
}

/* ---- against themselves */

struct other {
    const char *bodies, *x, *v, *unit;
    double numbers[3][2]; /* between what they are drawn */
};

static const struct other others[] = {
    {"bodies:\n  a: {mass: 1, motion: slide, initial: {v: %g}, forces: [gravity, normal, friction: {static: "
     "0.4, "
     "kinetic: 0.3}]}\n  b: {mass: 2, motion: slide, initial: {x: 1, v: %g}, forces: [gravity, normal, "
     "friction: "
     "{static: 0.3, kinetic: 0.25}]}\ncouplings:\n  - spring: {name: s, between: [a, b], stiffness: %g, "
     "free_length: 1}\n",
     "a.x",
     "b.v",
     "m/s",
     {{0, 3}, {-2, 0}, {20, 120}}},
    {"bodies:\n  b: {mass: 1, motion: slide, initial: {v: %g}, forces: [gravity, normal, friction: {static: "
     "0.5, "
     "kinetic: 0.3, surface_speed: %g}, spring: {stiffness: %g}, applied: {name: p, value: "
     "\"2[N]*sin(5[rad/s]*t)\"}]}\n",
     "b.x",
     "b.v",
     "m/s",
     {{0, 1}, {0, 0.6}, {10, 70}}},
    {"ground: {points: {O: [0, 0]}}\nbodies:\n  p: {mass: 1, motion: particle, initial: {x: %g, y: %g, vx: "
     "%g}, "
     "forces: [gravity]}\ncouplings:\n  - rope: {name: c, through: [ground.O, p], length: 1}\n",
     "p.x",
     "p.vx",
     "m/s",
     {{0.2, 0.7}, {-0.4, -0.1}, {-0.5, 0.5}}},
    {"ground: {lines: {floor: {through: [0, 0], along: 0}}}\nbodies:\n  d: {mass: 1, shape: disc, radius: "
     "0.1, "
     "motion: planar, initial: {y: %g, vx: %g, omega: %g}, forces: [gravity]}\ncontacts:\n  - {name: f, "
     "between: "
     "[d, ground.floor], restitution: 0.4, static: 0.4, kinetic: 0.3}\n",
     "d.x",
     "d.omega",
     "rad/s",
     {{0.3, 0.8}, {0, 2}, {-10, 10}}},
};

/* Times are those of another search; what is between events is the same. */
static bool is_same(const struct trajectory *one, const struct trajectory *two)
{
    const double tolerance = 1e-8;
    bool same = one->ended == two->ended && one->count == two->count && fabs(one->x - two->x) < tolerance &&
                fabs(one->v - two->v) < tolerance;
    for (size_t i = 0; same && i < one->count; i++)
        same = one->kind[i] == two->kind[i] && fabs(one->t[i] - two->t[i]) < tolerance;
    return same;
}

static bool goes_on_as_without(struct random_numbers *random)
{
    char bodies[text_size], events[400];
    const struct other *other = &others[random_bits(random) % (sizeof others / sizeof *others)];
    double drawn_numbers[3];
    for (size_t i = 0; i < 3; i++)
        drawn_numbers[i] = drawn(random, other->numbers[i][0], other->numbers[i][1]);
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    snprintf(bodies, sizeof bodies, other->bodies, drawn_numbers[0], drawn_numbers[1], drawn_numbers[2]);
#pragma GCC diagnostic pop
    struct trajectory without = run(bodies, "", other->x, other->v);
    double t = without.count > 0 ? without.t[random_bits(random) % without.count] : 1;
    write_events(random, t, other->v, other->unit, events);
    struct trajectory with = run(bodies, events, other->x, other->v);
    if (is_same(&with, &without)) return true;
    print_error("%s%s: ends at %.17g with %.17g, without events at %.17g with %.17g; %zu events and %zu\n",
                bodies, events, with.x, with.v, without.x, without.v, with.count, without.count);
    return false;
}

static void events_beside_the_ends_of_slips_change_nothing(void **unused)
{
    (void)unused;
    const char *wanted = getenv("FBD_ENDS");
    int count = wanted ? atoi(wanted) : draws_of(300), wrong = 0;
    struct random_numbers random = {20261124};
    for (int i = 0; i < count; i++) {
        wrong += !stops_as_it_should(&random);
        wrong += !goes_on_as_without(&random);
    }
    assert_int_equal(wrong, 0);
}

/* What a rod holds has no way to go along with a surface that turns round: its friction turns with that. */
static void what_couplings_hold_rubs_on_both_ways(void **unused)
{
    (void)unused;
    static const char bodies[] = "ground: {points: {Q: [-1, 0]}}\n"
                                 "bodies:\n  b: {mass: 1, motion: slide, forces: [gravity, normal, friction: "
                                 "{static: 0.4, kinetic: 0.3, "
                                 "surface_speed: \"0.3[m/s]*cos(1[rad/s]*t)\"}]}\n"
                                 "couplings:\n  - rod: {name: link, between: [b, ground.Q], length: 1}\n";
    struct trajectory trajectory = run(bodies, "", "b.x", "b.v");
    assert_true(trajectory.ended);
    assert_int_equal(trajectory.count, 1);
    assert_int_equal(trajectory.kind[0], FBD_EVENT_REVERSAL);
    assert_true(fabs(trajectory.t[0] - acos(0)) < 1e-12);
    assert_true(fabs(trajectory.x) < 1e-15 && fabs(trajectory.v) < 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(events_beside_the_ends_of_slips_change_nothing),
                                       cmocka_unit_test(what_couplings_hold_rubs_on_both_ways)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
