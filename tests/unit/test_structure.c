/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Structure: what is recognised; that runs with and without it agree; that independent groups of bodies leave
 * each other alone.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "gallery.h"

#include <stdlib.h>
#include <string.h>

#define HEAD "fbd: 1\nbodies:\n"

/* ---- what is recognised */

static const char general[] = "general", velocity_free[] = "velocity-free", linear[] = "linear",
                  constant[] = "constant";

static const char *kind_of(const fbd_simulation *simulation)
{
    fbd_stats stats = fbd_simulation_stats(simulation);
    if (stats.groups != 1) return "several groups";
    return stats.velocity_free ? velocity_free : stats.linear ? linear : stats.constant ? constant : general;
}

#define SLIDE(forces)                                                                                        \
    HEAD "  b:\n    mass: 2 kg\n    motion: slide\n    forces:\n" forces "simulate: {until: 1 s}\n"
#define PIVOT(loads)                                                                                         \
    HEAD "  b:\n    mass: 2 kg\n    center: [0, -1 m]\n    motion: {pivot: {at: [0, 0]}}\n" loads            \
         "simulate: {until: 1 s}\n"
#define PLANE(motion, forces)                                                                                \
    "fbd: 1\nground: {points: {P: [0, 0]}}\nbodies:\n  b:\n    mass: 2 kg\n    inertia: 1 kg*m^2\n    "      \
    "motion: " motion "\n    initial: {x: 1 m}\n    forces:\n" forces "simulate: {until: 1 s}\n"
#define PARTICLE(forces)                                                                                     \
    "fbd: 1\nground: {points: {P: [0, 0]}}\nbodies:\n  b:\n    mass: 2 kg\n    motion: particle\n"           \
    "    initial: {x: 1 m}\n    forces:\n" forces "simulate: {until: 1 s}\n"

static const struct {
    const char *text, *kind;
} recognised[] = {
    {SLIDE("      - gravity\n      - normal\n      - friction: 0.3\n"), constant},
    {SLIDE("      - applied: {value: \"3[N]*step(t - 0.5[s])\"}\n"), constant},
    {SLIDE("      - applied: {value: \"if(x > 0.1[m], 3[N], -2[N])\"}\n"), constant},
    {SLIDE("      - applied: {value: \"3[N/s]*t\"}\n"), velocity_free},
    {SLIDE("      - spring: {stiffness: 5 N/m}\n"), linear},
    {SLIDE("      - spring: {stiffness: 5 N/m}\n      - damper: {coefficient: 1 N*s/m}\n"), linear},
    {SLIDE("      - gravity\n      - normal\n      - friction: 0.3\n      - spring: {stiffness: 5 N/m}\n"),
     linear},
    {SLIDE("      - applied: {value: \"-5[N/m]*x - 2[N*s/m]*v + 1[N]*sign(v)\"}\n"), linear},
    {SLIDE("      - applied: {value: \"-5[N/m]*abs(x)\"}\n"), linear},
    {SLIDE("      - applied: {value: \"if(v > 0[m/s], -5[N/m]*x, -5[N/m^3]*x^3)\"}\n"), general},
    {SLIDE("      - applied: {value: \"-5[N/m^3]*x^3\"}\n"), velocity_free},
    {SLIDE("      - applied: {value: \"-5[N*s^2/m^2]*v^2\"}\n"), general},
    {SLIDE("      - drag: {linear: 1 N*s/m}\n"), linear},
    {SLIDE("      - drag: {quadratic: 1 N*s^2/m^2}\n"), general},
    {SLIDE("      - gravity\n      - normal\n      - friction: {static: 0.3, kinetic: \"0.3 - "
           "0.1[s/m]*abs(v)\"}\n"),
     general},
    {PIVOT("    forces: [gravity]\n"), velocity_free},
    {PIVOT("    forces: [gravity]\n    moments:\n      - damper: {coefficient: 1 N*m*s/rad}\n"), general},
    {PIVOT("    moments:\n      - spring: {stiffness: 1 N*m/rad}\n"), linear},
    {PIVOT("    moments:\n      - applied: {value: 2 N*m}\n      - friction: 1 N*m\n"), constant},
    {PARTICLE("      - gravity\n"), constant},
    {PARTICLE("      - gravity\n      - drag: {linear: 1 N*s/m}\n"), linear},
    {PARTICLE("      - spring: {stiffness: 5 N/m, to: P}\n"), linear},
    {PARTICLE("      - spring: {stiffness: 5 N/m, free_length: 0.5 m, to: P}\n"), velocity_free},
    {PLANE("planar", "      - gravity\n"), constant},
    {PLANE("planar", "      - gravity\n      - applied: {fx: 1 N, fy: 0 N, at: [0, 0.1 m]}\n"),
     velocity_free},
    {PLANE("planar", "      - applied: {fx: 1 N, fy: 0 N, frame: body}\n"), velocity_free},
};

static void forces_are_sorted_by_what_they_depend_on(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < sizeof recognised / sizeof *recognised; i++) {
        struct trial trial = trial_parse(recognised[i].text);
        trial_start(&trial, NULL);
        const char *kind = kind_of(trial.simulation);
        if (!check_that(&checks, "the kind", strcmp(kind, recognised[i].kind) == 0))
            fprintf(stderr, "# %s instead of %s:\n%s", kind, recognised[i].kind, recognised[i].text);
        trial_close(&trial);
    }
    checks_end(&checks);
}

static void a_method_asked_for_is_taken(void **unused)
{
    (void)unused;
    struct trial trial = trial_parse(SLIDE("      - spring: {stiffness: 5 N/m}\n"));
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.method = "dop853";
    trial_start(&trial, &options);
    assert_string_equal(kind_of(trial.simulation), general);
    trial_close(&trial);
}

/* ---- with and without: the same motion */

enum { most_path = 512 };

static double reach_of(const fbd_options *options, const char *path, struct trial *trial, double tolerance)
{
    fbd_options own = *options;
    own.tolerance = tolerance;
    *trial = trial_open(path, NULL);
    trial_run(trial, &own);
    return 2 * tolerance * (double)fbd_simulation_stats(trial->simulation).steps;
}

/* The last state and the times of events. A model may magnify errors: what a tolerance a hundred times as
 * large does to it tells by how much, with a factor of ten for chance. */
static void check_agreement(struct checks *checks, const char *path)
{
    fbd_options with = FBD_OPTIONS_DEFAULT, without = with;
    without.no_structure = true;
    struct trial a, b, rough;
    double promise = reach_of(&with, path, &a, 1e-11) + reach_of(&without, path, &b, 1e-11);
    reach_of(&without, path, &rough, 1e-9);
    const fbd_state *last[] = {fbd_result_state(a.result), fbd_result_state(b.result),
                               fbd_result_state(rough.result)};
    char what[2 * most_path];
    for (size_t i = 0; i < fbd_model_coordinate_count(a.model); i++) {
        for (int rate = 0; rate < 2; rate++) {
            fbd_coordinate coordinate = fbd_model_coordinate(a.model, i);
            const char *name = rate ? coordinate.rate_name : coordinate.name;
            double x[3];
            for (int k = 0; k < 3; k++) assert_true(fbd_state_get(last[k], name, &x[k]));
            snprintf(what, sizeof what, "%s: %s", path, name);
            double size = fmax(fabs(x[0]), 1);
            check_close(checks, what, x[0], x[1], 10 * fmax(promise * size, fabs(x[2] - x[1])));
        }
    }
    size_t events = fbd_simulation_event_count(a.simulation);
    snprintf(what, sizeof what, "%s: as many events", path);
    bool as_many = check_that(checks, what, events == fbd_simulation_event_count(b.simulation));
    for (size_t i = 0; as_many && i < events; i++) {
        fbd_event one = fbd_simulation_event(a.simulation, i), other = fbd_simulation_event(b.simulation, i);
        double spread = fabs(fbd_simulation_event(rough.simulation, i).t - other.t);
        snprintf(what, sizeof what, "%s: event %zu", path, i);
        check_close(checks, what, one.t, other.t, 10 * fmax(promise * fmax(other.t, 1), spread));
        check_that(checks, what, one.kind == other.kind && strcmp(one.name, other.name) == 0);
    }
    trial_close(&a);
    trial_close(&b);
    trial_close(&rough);
}

static void runs_with_and_without_agree_over_the_gallery(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    each_model_in_turn(&checks, 0, check_agreement);
    checks_end(&checks);
}

/* ---- groups */

#define PENDULUM(name, angle)                                                                                \
    "  " name ":\n    mass: 1 kg\n    center: [0, -1 m]\n    motion: {pivot: {at: [0, 0]}}\n"                \
    "    initial: {theta: " angle " deg}\n    forces: [gravity]\n"
#define BLOCK                                                                                                \
    "  block:\n    mass: 2 kg\n    motion: slide\n    initial: {v: 3 m/s}\n    forces:\n      - gravity\n"   \
    "      - normal\n      - friction: 0.2\n      - applied: {value: \"9[N]*sin(2[1/s]*t)\"}\n"
#define FOLLOWER                                                                                             \
    "  follower:\n    mass: 1 kg\n    motion: slide\n    forces:\n"                                          \
    "      - applied: {value: \"3[N/rad]*one.theta\"}\n"

static size_t groups_of(const char *text)
{
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    size_t groups = fbd_simulation_stats(trial.simulation).groups;
    trial_close(&trial);
    return groups;
}

static void bodies_hang_together_by_what_they_read(void **unused)
{
    (void)unused;
    assert_int_equal(groups_of(HEAD PENDULUM("one", "60") PENDULUM("two", "20") BLOCK
                               "simulate: {until: 1 s}\n"),
                     3);
    assert_int_equal(groups_of(HEAD PENDULUM("one", "60") BLOCK FOLLOWER "simulate: {until: 1 s}\n"), 2);
    assert_int_equal(groups_of(HEAD PENDULUM("one", "60") PENDULUM("two", "20") BLOCK
                               "simulate: {until: 1 s, events: [{name: e, when: one.theta = two.theta}]}\n"),
                     2);
    assert_int_equal(groups_of(HEAD PENDULUM("one", "60") PENDULUM(
                         "two", "20") "simulate: {until: 1 s, events: [{name: e, when: t = 0.5}]}\n"),
                     2);
}

#define TWO_AND_A_BLOCK HEAD PENDULUM("one", "60") BLOCK PENDULUM("two", "20")

/* Neither friction nor the events of the block change a bit of the pendulums. */
static void a_group_moves_as_if_it_were_alone(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char *const names[] = {"one.theta", "one.omega", "two.theta",
                                        "two.omega", "block.x",   "block.v"};
    static const char *const alone[] = {HEAD PENDULUM("one", "60") "simulate: {until: 7 s}\n",
                                        HEAD PENDULUM("two", "20") "simulate: {until: 7 s}\n",
                                        HEAD BLOCK "simulate: {until: 7 s}\n"};
    struct trial all = trial_parse(TWO_AND_A_BLOCK "simulate: {until: 7 s}\n");
    trial_run(&all, NULL);
    unsigned long rhs = 0;
    for (size_t i = 0; i < 3; i++) {
        struct trial one = trial_parse(alone[i]);
        trial_run(&one, NULL);
        for (size_t k = 2 * i; k < 2 * i + 2; k++) {
            double together, apart;
            assert_true(fbd_state_get(fbd_result_state(all.result), names[k], &together));
            assert_true(fbd_state_get(fbd_result_state(one.result), names[k], &apart));
            check_close(&checks, names[k], together, apart, 0);
        }
        rhs += fbd_simulation_stats(one.simulation).rhs;
        trial_close(&one);
    }
    check_that(&checks, "the cost is the sum", fbd_simulation_stats(all.simulation).rhs == rhs);
    trial_close(&all);
    checks_end(&checks);
}

/* x = cos(w t), v = -w sin(w t) with w^2 = 40, in 20 digits; the first time is within the step. */
static void a_long_oscillation_keeps_its_phase(void **unused)
{
    (void)unused;
    static const struct {
        double t, x, v;
    } want[] = {{5e5, 0.72445882041237263227, -4.3596303399564216662},
                {1e6, 0.04968116494657276263, -6.3167453070376406614}};
    struct checks checks = {0};
    struct trial trial =
        trial_parse(HEAD "  b: {mass: 2 kg, motion: slide, initial: {x: 1 m}, forces: [spring: "
                         "{stiffness: 80 N/m}]}\nsimulate: {until: 1e6 s}\n");
    trial_start(&trial, NULL);
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        trial_to(&trial, want[i].t);
        check_close(&checks, "x", trial_get(&trial, "b.x"), want[i].x, 4e-15);
        check_close(&checks, "v", trial_get(&trial, "b.v"), want[i].v, 2e-14);
    }
    check_that(&checks, "one step", fbd_simulation_stats(trial.simulation).steps == 1);
    trial_close(&trial);
    checks_end(&checks);
}

/* x = cosh(2 t): the force 4 x is beyond the largest number, 1.8e308, from t = 354.2 on; x itself from 355.2 on. */
static void a_growing_motion_ends_where_it_overflows(void **unused)
{
    (void)unused;
    double last = 0, beyond = 0;
    struct checks checks = {0};
    struct trial trial =
        trial_parse(HEAD "  b: {mass: 1 kg, motion: slide, initial: {x: 1 m}, forces: [applied: "
                         "{value: \"4[N/m]*x\"}]}\nsimulate: {until: 1000 s}\n");
    trial_run(&trial, NULL);
    check_that(&checks, "it fails", trial.outcome == FBD_FAILED);
    const char *reason = fbd_simulation_reason(trial.simulation), at[] = "at t = ";
    const char *first = strstr(reason, at), *second = first ? strstr(first + 1, at) : NULL;
    check_that(&checks, "both times", second != NULL);
    if (second) {
        beyond = strtod(first + strlen(at), NULL);
        last = strtod(second + strlen(at), NULL);
    }
    check_that(&checks, "around the overflow", last > 353 && beyond > last && beyond < 356);
    trial_close(&trial);
    checks_end(&checks);
}

/* Step by step the interval is covered by every group; in one go the same end is reached. */
static void step_by_step_and_in_one_go_are_the_same(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial steps = trial_parse(TWO_AND_A_BLOCK "simulate: {until: 7 s}\n");
    struct trial go = trial_parse(TWO_AND_A_BLOCK "simulate: {until: 7 s}\n");
    trial_run(&go, NULL);
    trial_start(&steps, NULL);
    double from, to = 0, before, last = 0;
    while (steps.outcome == FBD_GOING) {
        before = to;
        steps.outcome = fbd_simulation_advance(steps.simulation);
        fbd_simulation_interval(steps.simulation, &from, &to);
        check_that(&checks, "intervals join", from == before && to >= from);
        for (int i = 0; i <= 4; i++)
            check_that(&checks, "a state anywhere",
                       fbd_simulation_state(steps.simulation, from + (to - from) * i / 4, steps.state));
    }
    assert_int_equal(steps.outcome, FBD_DONE);
    for (size_t i = 0; i < fbd_simulation_event_count(steps.simulation); i++) {
        fbd_event event = fbd_simulation_event(steps.simulation, i);
        check_that(&checks, "events ascend", event.t >= last);
        check_that(&checks, "the same event", event.t == fbd_simulation_event(go.simulation, i).t);
        last = event.t;
    }
    check_that(&checks, "as many events",
               fbd_simulation_event_count(steps.simulation) == fbd_simulation_event_count(go.simulation));
    check_that(&checks, "some events", fbd_simulation_event_count(steps.simulation) > 4);
    static const char *const names[] = {"one.theta", "two.omega", "block.x"};
    assert_true(fbd_simulation_state(steps.simulation, to, steps.state));
    for (size_t i = 0; i < 3; i++) {
        double other;
        assert_true(fbd_state_get(fbd_result_state(go.result), names[i], &other));
        check_close(&checks, names[i], trial_get(&steps, names[i]), other, 0);
    }
    trial_close(&steps);
    trial_close(&go);
    checks_end(&checks);
}

/* The end of a run, and where a pendulum is then, held against the pendulum alone up to that time. */
static void check_early_end(struct checks *checks, const char *text, fbd_outcome outcome, double t,
                            double tolerance)
{
    struct trial trial = trial_parse(text),
                 alone = trial_parse(HEAD PENDULUM("one", "60") "simulate: {until: 50 s}\n");
    trial_start(&trial, NULL);
    trial.result = fbd_simulation_run(trial.simulation, NULL);
    assert_non_null(trial.result);
    check_that(checks, "it ends as it should", fbd_result_outcome(trial.result) == outcome);
    double from, to, theta;
    fbd_simulation_interval(trial.simulation, &from, &to);
    check_close(checks, "when it ends", to, t, tolerance);
    trial_start(&alone, NULL);
    trial_to(&alone, to);
    assert_true(fbd_state_get(fbd_result_state(trial.result), "one.theta", &theta));
    check_close(checks, "theta then", theta, trial_get(&alone, "one.theta"), 0);
    for (size_t i = 0; i < fbd_simulation_event_count(trial.simulation); i++)
        check_that(checks, "no event after the end", fbd_simulation_event(trial.simulation, i).t <= to);
    trial_close(&trial);
    trial_close(&alone);
}

static void an_early_end_of_one_group_ends_all(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    /* A stop: x = 20 t - 9.81 t^2/2 is back at 0 for t = 40/9.81. */
    check_early_end(
        &checks,
        HEAD PENDULUM(
            "one",
            "60") "  ball:\n    mass: 1 kg\n    motion: particle\n    initial: {vy: 20 m/s}\n"
                  "    forces: [gravity]\n"
                  "simulate:\n  until: 50 s\n  events: [{name: ground, when: ball.y = 0, stop: true}]\n",
        FBD_STOPPED, 40 / 9.81, 1e-9);
    /* A failure of a group without events, found when the others have gone on: x' = -sqrt(2 (1/x - 1)) falls
     * into the centre of an inverse-square force from x = 1 in pi / (2 sqrt 2) s. */
    check_early_end(
        &checks,
        HEAD PENDULUM(
            "one", "60") "  falling:\n    mass: 1 kg\n    motion: slide\n    initial: {x: 1 m}\n    forces:\n"
                         "      - applied: {value: \"-1[N*m^2]/x^2\"}\n" BLOCK "simulate: {until: 50 s}\n",
        FBD_FAILED, acos(-1) / (2 * sqrt(2)), 1e-3);
    checks_end(&checks);
}

/* ---- groups of jointed bodies: everything that a group takes along is renumbered in it */

static const char jointed[] = HEAD
    "  lone:\n    mass: 1 kg\n    motion: particle\n    initial: {vy: 3 m/s}\n    forces: [gravity]\n"
    "  rod1:\n    shape: rod\n    mass: 1 kg\n    from: [0, 0]\n    to: [0, -1 m]\n    motion: pivot\n"
    "    initial: {theta: 50 deg}\n    forces: [gravity]\n"
    "  block:\n    mass: 2 kg\n    motion: slide\n    initial: {v: 1 m/s}\n    forces:\n      - gravity\n"
    "      - normal\n      - friction: 0.2\n"
    "  rod2:\n    shape: rod\n    mass: 1 kg\n    from: [0, 0]\n    to: [0, -1 m]\n"
    "    motion: {pivot: {on: rod1, at: right, point: left}}\n    forces: [gravity]\n"
    "    moments: [{damper: {coefficient: 0.1 N*m*s/rad}}]\n"
    "  tip:\n    mass: 0.1 kg\n    motion: {weld: {on: rod2, at: right}}\n    forces: [gravity]\n"
    "  cart:\n    mass: 1 kg\n    motion: slide\n    forces:\n"
    "      - applied: {value: \"-3[N/m]*(x - rider.G.x)\"}\n"
    "  rider:\n    mass: 1 kg\n    motion: {slide: {through: [0, 1 m]}}\n    initial: {x: 0.5 m}\n"
    "  upper:\n    mass: 1 kg\n    motion: {slide: {on: block}}\n    forces:\n      - gravity\n"
    "      - normal\n      - friction: {static: 0.5, kinetic: 0.4}\n"
    "couplings:\n  - damper: {name: dashpot, between: [rider.G, cart.G], coefficient: 0.3 N*s/m}\n"
    "  - spring: {name: cord, between: [cart.G, rider.G], stiffness: 7 N/m, free_length: 0.9 m}\n"
    "simulate:\n  until: 4 s\n  events:\n    - {name: low, when: rod2.right.y = -1.5}\n"
    "    - {name: swap, when: rider.x = cart.x}\n";

static void check_same_events(struct checks *checks, const struct trial *one, const struct trial *other)
{
    size_t events = fbd_simulation_event_count(other->simulation);
    check_that(checks, "some events", events > 3);
    if (!check_that(checks, "as many events", fbd_simulation_event_count(one->simulation) == events)) return;
    for (size_t i = 0; i < events; i++) {
        fbd_event a = fbd_simulation_event(one->simulation, i),
                  b = fbd_simulation_event(other->simulation, i);
        check_close(checks, "time of an event", a.t, b.t, 1e-8);
        check_that(checks, "the same event",
                   a.kind == b.kind && strcmp(a.name, b.name) == 0 && strcmp(a.body, b.body) == 0);
    }
}

static void jointed_bodies_form_groups_that_agree_with_the_whole(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_options whole = FBD_OPTIONS_DEFAULT;
    whole.no_structure = true;
    struct trial apart = trial_parse(jointed), together = trial_parse(jointed);
    trial_run(&apart, NULL);
    trial_run(&together, &whole);
    assert_int_equal(fbd_simulation_stats(apart.simulation).groups, 4);
    check_same_events(&checks, &apart, &together);
    for (size_t i = 0; i < fbd_model_coordinate_count(apart.model); i++) {
        const char *name = fbd_model_coordinate(apart.model, i).rate_name;
        double one, other;
        assert_true(fbd_state_get(fbd_result_state(apart.result), name, &one));
        assert_true(fbd_state_get(fbd_result_state(together.result), name, &other));
        check_close(&checks, name, one, other, 1e-7); /* some hundred steps at 1e-10, speeds of 10 m/s */
    }
    fbd_energy one = fbd_result_energy(apart.result), other = fbd_result_energy(together.result);
    check_close(&checks, "work", one.work, other.work, 1e-7);
    check_close(&checks, "residual", one.residual, 0, 1e-7);
    check_that(&checks, "some work", fabs(other.work) > 0.1);
    check_close(&checks, "work of friction", fbd_result_work(apart.result, "upper", "friction"),
                fbd_result_work(together.result, "upper", "friction"), 1e-8);
    trial_close(&apart);
    trial_close(&together);
    checks_end(&checks);
}

/* ---- output */

struct rows {
    char *text;
    size_t length, room;
};

static int take_rows(void *context, const char *data, size_t size)
{
    struct rows *rows = context;
    if (rows->length + size + 1 > rows->room) {
        rows->room = 2 * (rows->length + size + 1);
        rows->text = realloc(rows->text, rows->room);
        assert_non_null(rows->text);
    }
    memcpy(rows->text + rows->length, data, size);
    rows->length += size;
    rows->text[rows->length] = '\0';
    return 0;
}

/* Works are integrated group by group: they add up to the changes of energy in every row, though the groups
 * make their steps at different times. */
static void the_ledger_of_every_row_closes(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial = trial_parse(TWO_AND_A_BLOCK "simulate: {until: 7 s}\n");
    struct rows rows = {0};
    fbd_recording recording = {.every = 0.01, .ledger = true, .csv = take_rows, .csv_context = &rows};
    trial_start(&trial, NULL);
    trial.result = fbd_simulation_run(trial.simulation, &recording);
    assert_non_null(trial.result);
    size_t count = 0;
    char *line = strchr(rows.text, '\n');
    for (double before = -1; line && line[1]; count++) {
        double t = strtod(line + 1, NULL);
        check_that(&checks, "times ascend", t > before);
        before = t;
        char *end = strchr(line + 1, '\n'), *last = end;
        while (*last != ',') last--;
        /* The residual is the last column; energies and works are of the order of 10 J, and the tolerance is
         * 1e-10 for each of some dozens of steps. */
        check_close(&checks, "residual", strtod(last + 1, NULL), 0, 1e-9);
        line = end;
    }
    check_that(&checks, "a row for each output time and event",
               count == 701 + fbd_simulation_event_count(trial.simulation));
    free(rows.text);
    trial_close(&trial);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_are_sorted_by_what_they_depend_on),
        cmocka_unit_test(a_method_asked_for_is_taken),
        cmocka_unit_test(runs_with_and_without_agree_over_the_gallery),
        cmocka_unit_test(bodies_hang_together_by_what_they_read),
        cmocka_unit_test(a_group_moves_as_if_it_were_alone),
        cmocka_unit_test(a_long_oscillation_keeps_its_phase),
        cmocka_unit_test(a_growing_motion_ends_where_it_overflows),
        cmocka_unit_test(step_by_step_and_in_one_go_are_the_same),
        cmocka_unit_test(an_early_end_of_one_group_ends_all),
        cmocka_unit_test(jointed_bodies_form_groups_that_agree_with_the_whole),
        cmocka_unit_test(the_ledger_of_every_row_closes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
