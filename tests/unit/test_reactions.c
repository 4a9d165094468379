/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What keeps a body on its course, by formulas written here: the term of an axis that moves, moments about G and O, the
 * normal force of a table, couples of slides, friction that shares a load at rest up to both sides of its limit.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fbd_study.h"
#include "gallery.h"
#include "holds/impact.h"
#include "scenes.h"

/* Sums and products of a few numbers, each rounded. */
static const double roundings = 1e-13;

/* A rod of 3 kg hangs from a cart that is pushed. About its axis: I_O theta'' = -m g (L/2) sin(theta) - m r x a, where
 * r = L/2 (sin, -cos) and the axis has the acceleration (a, 0): the last is -m (L/2) a cos(theta). */
static void an_axis_that_moves_has_its_term(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_model *model = model_from("fbd: 1\ngravity: 10\nbodies:\n"
                                  "  cart: {mass: 2 kg, motion: slide, forces: [{applied: 7 N}]}\n"
                                  "  rod:\n"
                                  "    shape: rod\n    mass: 3 kg\n    length: 2 m\n"
                                  "    motion: {pivot: {on: cart, at: G, point: left}}\n"
                                  "    initial: {theta: -50 deg}\n    forces: [gravity]\n");
    fbd_state *state = fbd_state_new(model);
    fbd_equations *equations = fbd_assemble(state);
    const fbd_equation rod = fbd_equations_find(equations, "rod.theta");
    double a = fbd_equations_find(equations, "cart.x").acceleration;
    double angle = -50 * 3.14159265358979324 / 180; /* of the rod: r = L/2 (cos, sin) */
    check_that(&checks, "the cart is accelerated", a > 0.5);
    check_close(&checks, "weight", fbd_equation_term(&rod, "gravity"), -30 * cos(angle), 30 * roundings);
    check_close(&checks, "moving axis", fbd_equation_term(&rod, "moving axis"), 3 * sin(angle) * a,
                30 * roundings);
    fbd_equations_free(equations);
    fbd_state_free(state);
    fbd_model_free(model);
    checks_end(&checks);
}

static double member_after(const char *text, const char *place, const char *name)
{
    const char *at = strstr(text, place);
    at = at ? strstr(at, name) : NULL;
    return at ? strtod(at + strlen(name), NULL) : NAN;
}

/* Two points of 1 and 3 kg at the ends of a massless bar, the frame in the first one: G is at 1.5 m. A force of 2 N
 * upward at G moves the bar without turning it: no moment about G, and 1.5 m times 2 N about O. */
static void moments_about_O_and_G_differ(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_model *model = model_from("fbd: 1\nbodies:\n  bar:\n    motion: planar\n    parts:\n"
                                  "      a: {shape: point, mass: 1 kg, center: [0, 0]}\n"
                                  "      b: {shape: point, mass: 3 kg, center: [2 m, 0]}\n"
                                  "    forces: [{applied: {name: lift, value: 2 N, angle: 90 deg, at: G}}]\n"
                                  "simulate: {until: 1 s}\n");
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    char *json = fbd_result_json(result);
    assert_non_null(json);
    check_close(&checks, "about G", member_after(json, "\"lift\"", "\"moment_G\": "), 0, roundings);
    check_close(&checks, "about O", member_after(json, "\"lift\"", "\"moment_O\": "), 3, 3 * roundings);
    fbd_free(json);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    checks_end(&checks);
}

/* N = m g cos(phi) in each row, and friction mu_k N against the slip. */
static void a_table_has_the_normal_force(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_model *model = model_from(
        "fbd: 1\ngravity: 10\nbodies:\n  block:\n    mass: 2 kg\n    motion: {slide: {along: 60 deg}}\n"
        "    initial: {v: -1 m/s}\n    forces: [gravity, normal, {friction: 0.25}]\n"
        "simulate: {until: 1 s}\n");
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
    const fbd_recording recording = {.ledger = true, .table = true, .every = 0.5};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    fbd_table table = fbd_result_table(result);
    int seen = 0;
    for (size_t c = 0; c < table.columns; c++) {
        bool normal = strcmp(table.heads[c].name, "block.normal") == 0;
        bool friction = strcmp(table.heads[c].name, "block.friction") == 0;
        for (size_t r = 0; (normal || friction) && r < table.rows; r++, seen++)
            check_close(&checks, table.heads[c].name, table.values[r * table.columns + c], normal ? 10 : 2.5,
                        10 * roundings);
    }
    check_that(&checks, "both columns in three rows", seen == 6);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    checks_end(&checks);
}

/* A box on a sledge is pushed 0.4 m above its centre: the sledge keeps it from turning by a couple, here -h f of the
 * push about G, so +0.4 m times 5 N. */
static void a_slide_keeps_from_turning(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_model *model =
        model_from("fbd: 1\ngravity: 10\nbodies:\n  sledge: {mass: 4 kg, motion: slide}\n"
                   "  box:\n    mass: 2 kg\n    motion: {slide: {on: sledge}}\n"
                   "    points: {top: [0, 0.4 m]}\n"
                   "    forces: [gravity, {applied: {name: push, value: 5 N, angle: 0 deg, at: top}}]\n");
    fbd_state *state = fbd_state_new(model);
    fbd_arrow arrows[8];
    for (size_t body = 0; body < 2; body++) {
        size_t count = fbd_diagram(state, body, arrows, 8);
        double couple = 0, moment = 0;
        for (size_t i = 0; i < count && i < 8; i++) {
            couple += arrows[i].couple;
            moment += arrows[i].moment;
        }
        check_close(&checks, "nothing turns", moment, 0, 10 * roundings);
        if (body == 1) check_close(&checks, "couple on the box", couple, 2, 10 * roundings);
    }
    fbd_state_free(state);
    fbd_model_free(model);
    checks_end(&checks);
}

/* Two blocks on a rod, pushed by F along the floor: f_a + f_b = -F. Of least squares each would take half; the light
 * one can take 0.1 times 10 N at most, so the heavy one has what is left. To the right and to the left. */
static void friction_shares_up_to_both_sides_of_its_limit(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int side = -1; side <= 1; side += 2) {
        char text[800];
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: 10\nbodies:\n"
                 "  light: {mass: 1 kg, motion: slide, forces: [gravity, normal, {friction: 0.1}, {applied: "
                 "%d N}]}\n"
                 "  heavy: {mass: 8 kg, motion: slide, initial: {x: 1 m}, forces: [gravity, normal, "
                 "{friction: 0.1}]}\n"
                 "couplings: [{rod: {name: bar, between: [light.G, heavy.G], length: 1 m}}]\n",
                 4 * side);
        fbd_model *model = model_from(text);
        fbd_state *state = fbd_state_new(model);
        fbd_statics *statics = fbd_statics_new(state, NULL);
        fbd_arrow arrows[8];
        static const double most[] = {1, 3};
        check_that(&checks, "it holds", fbd_statics_holds(statics));
        for (size_t body = 0; body < 2; body++) {
            size_t count = fbd_statics_diagram(statics, body, arrows, 8);
            for (size_t i = 0; i < count; i++)
                if (strcmp(arrows[i].name, "friction") == 0)
                    check_close(&checks, body ? "heavy" : "light", arrows[i].fx, -side * most[body], 1e-7);
        }
        for (size_t i = 0; i < fbd_statics_limit_count(statics); i++) {
            const fbd_limit limit = fbd_statics_limit(statics, i);
            if (limit.kind != FBD_LIMIT_FRICTION) continue;
            bool heavy = strcmp(limit.name, "heavy.friction") == 0;
            check_close(&checks, limit.name, limit.needed, heavy ? 3 : 1, 1e-7);
            check_close(&checks, limit.name, limit.limit, heavy ? 8 : 1, 10 * roundings);
        }
        fbd_statics_free(statics);
        fbd_state_free(state);
        fbd_model_free(model);
    }
    checks_end(&checks);
}

static double acceleration_of(const char *text, const char *coordinate)
{
    fbd_model *model = model_from(text);
    fbd_state *state = fbd_state_new(model);
    fbd_equations *equations = fbd_assemble(state);
    double acceleration = fbd_equations_find(equations, coordinate).acceleration;
    fbd_equations_free(equations);
    fbd_state_free(state);
    fbd_model_free(model);
    return acceleration;
}

/* A box of 2 kg is driven over a sledge of 4 kg with 3 m/s^2: 4 a + 2 (a + 3) = 0. */
static void a_drive_takes_its_acceleration_from_the_other(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const char *text = "fbd: 1\nbodies:\n  sledge: {mass: 4 kg, motion: slide}\n"
                       "  box: {mass: 2 kg, motion: {slide: {on: sledge, x: \"1.5[m/s^2]*t^2\"}}}\n";
    check_close(&checks, "sledge", acceleration_of(text, "sledge.x"), -1, roundings);
    checks_end(&checks);
}

/* A weight m on a rope that unwinds from a drum of I = M R^2 / 2 at r: a (m + I / r^2) = m g, whichever end of the rope
 * is wound, on either side. */
static void a_rope_unwinds_at_either_end(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int k = 0; k < 4; k++) {
        char text[900];
        double side = k % 2 ? -0.1 : 0.1;
        snprintf(
            text, sizeof text,
            "fbd: 1\ngravity: 10\nbodies:\n"
            "  drum: {shape: disc, mass: 4 kg, radius: 0.2 m, motion: {pivot: {at: [0, 0], point: G}}}\n"
            "  load: {mass: 1 kg, motion: {slide: {along: 90 deg, through: [%g, -3]}}, forces: [gravity]}\n"
            "couplings: [{rope: {name: cord, through: [%s], wound: {on: drum, side: %s, radius: 0.1 m}}}]\n",
            k % 2 ? -0.1 : 0.1, k < 2 ? "drum, load" : "load, drum", side > 0 ? "right" : "left");
        check_close(&checks, text, acceleration_of(text, "load.x"), -10 / (1 + 4 * 0.04 / 2 / 0.01),
                    100 * roundings);
    }
    checks_end(&checks);
}

/* A rope of 3 m - t^2 [m/s^2] hauls its load in: it goes up with 2 m/s^2. */
static void a_rope_that_is_hauled_in_lifts(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const char *text =
        "fbd: 1\ngravity: 10\nground: {points: {winch: [0, 0]}}\nbodies:\n"
        "  load: {mass: 2 kg, motion: {slide: {along: 90 deg, through: [0, -3]}}, forces: [gravity]}\n"
        "couplings: [{rope: {name: cord, through: [ground.winch, load], length: \"3[m] - 1[m/s^2]*t^2\"}}]\n";
    check_close(&checks, "load", acceleration_of(text, "load.x"), 2, 10 * roundings);
    checks_end(&checks);
}

/* Weights of 5 and 1 kg on a rope that slips over half a fixed drum: T_1 = T_2 exp(mu pi), so a (5 + e) = (5 - e) g. */
static void a_rope_slips_round_a_drum_by_euler(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    const double e = exp(0.3 * 3.14159265358979324);
    const char *text =
        "fbd: 1\ngravity: 10\nground: {points: {peg: [0, 0]}}\nbodies:\n"
        "  heavy: {mass: 5 kg, motion: {slide: {along: -90 deg, through: [-0.1, -1]}}, forces: [gravity]}\n"
        "  light: {mass: 1 kg, motion: {slide: {along: 90 deg, through: [0.1, -1]}}, forces: [gravity]}\n"
        "couplings: [{rope: {name: cord, through: [heavy, ground.peg, light],"
        " around: {on: ground.peg, radius: 0.1 m, static: 0.3, kinetic: 0.3}}}]\n";
    check_close(&checks, "heavy", acceleration_of(text, "heavy.x"), 10 * (5 - e) / (5 + e), 100 * roundings);
    checks_end(&checks);
}

/* A bar of 1 kg and 2 m is held level about its left end by a moment of 4 N m and a rod above its other end:
 * 2 F + 4 - 1 m times 10 N = 0. */
static void a_moment_in_a_joint_helps_to_hold(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    fbd_model *model =
        model_from("fbd: 1\ngravity: 10\nground: {points: {hook: [2, 1]}}\nbodies:\n"
                   "  bar:\n    shape: rod\n    mass: 1 kg\n    length: 2 m\n"
                   "    motion: {pivot: {at: [0, 0], point: left}}\n    forces: [gravity]\n"
                   "    moments: [{applied: {name: help, value: 4 N*m}}]\n"
                   "couplings: [{rod: {name: hanger, between: [bar.right, ground.hook], length: 1 m}}]\n");
    fbd_state *state = fbd_state_new(model);
    fbd_statics *statics = fbd_statics_new(state, NULL);
    fbd_arrow arrows[8];
    size_t count = fbd_statics_diagram(statics, 0, arrows, 8);
    int seen = 0;
    for (size_t i = 0; i < count; i++) {
        if (strcmp(arrows[i].name, "hanger") != 0) continue;
        check_close(&checks, "hanger", arrows[i].fy, 3, 100 * roundings);
        seen++;
    }
    check_that(&checks, "it is seen", seen == 1);
    fbd_statics_free(statics);
    fbd_state_free(state);
    fbd_model_free(model);
    checks_end(&checks);
}

/* A block that is lifted has no friction to hold it; on a belt that starts with 3 m/s^2 it is held by what it is pushed
 * with, and by no more. */
static void friction_at_rest_needs_a_surface(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int lifted = 0; lifted < 2; lifted++) {
        char text[500];
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: 10\nbodies:\n  block:\n    mass: 1 kg\n    motion: slide\n    forces:\n"
                 "      - gravity\n      - normal\n"
                 "      - friction: {coefficient: 0.5, surface_speed: \"3[m/s^2]*t\"}\n"
                 "      - applied: {name: lift, value: %d N, angle: 90 deg}\n      - applied: {name: push, "
                 "value: 2 N}\n",
                 lifted ? 30 : 0);
        fbd_model *model = model_from(text);
        fbd_state *state = fbd_state_new(model);
        fbd_statics *statics = fbd_statics_new(state, NULL);
        for (size_t i = 0; i < fbd_statics_limit_count(statics); i++) {
            const fbd_limit limit = fbd_statics_limit(statics, i);
            if (limit.kind != FBD_LIMIT_FRICTION) continue;
            check_close(&checks, "needed", limit.needed, 2, 10 * roundings);
            check_close(&checks, "may be", limit.limit, lifted ? 0 : 5, 10 * roundings);
        }
        check_that(&checks, "held", fbd_statics_holds(statics) == !lifted);
        fbd_statics_free(statics);
        fbd_state_free(state);
        fbd_model_free(model);
    }
    checks_end(&checks);
}

/* Pushed by just what friction can hold, 0.5 times 10 N, and by more from then on (5 + t), a block of 1 kg has the
 * velocity t^2/2; by less (5 - t) it stays, and nothing happens. To both sides. */
static void at_the_limit_the_trend_decides(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int k = 0; k < 4; k++) {
        char text[400];
        bool more = k % 2;
        double side = k < 2 ? 1 : -1, v = NAN;
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: 10\nbodies:\n  block:\n    mass: 1 kg\n    motion: slide\n    forces:\n"
                 "      - gravity\n      - normal\n      - friction: 0.5\n"
                 "      - applied: {name: push, value: \"%g*(5[N] %c 1[N/s]*t)\"}\nsimulate: {until: 1 s}\n",
                 side, more ? '+' : '-');
        fbd_model *model = model_from(text);
        fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
        fbd_result *result = fbd_simulation_run(simulation, NULL);
        check_that(&checks, "it has a velocity", fbd_state_get(fbd_result_state(result), "block.v", &v));
        check_close(&checks, text, v, more ? side / 2 : 0, 1e-9); /* the tolerance of a run: 1e-10 */
        if (!more) check_that(&checks, "nothing happens", fbd_simulation_event_count(simulation) == 0);
        fbd_result_free(result);
        fbd_simulation_free(simulation);
        fbd_model_free(model);
    }
    checks_end(&checks);
}

/* What a run is at its end, and its first event. */
struct ended {
    fbd_outcome outcome;
    double t, v, first, told; /* told: the number that the detail of the first event has behind "takes" */
};

static struct ended run_of(const char *text, const char *rate)
{
    struct ended ended = {.v = NAN, .t = NAN, .told = NAN};
    fbd_model *model = model_from(text);
    fbd_simulation *simulation = fbd_simulation_new(model, NULL, NULL);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    const fbd_event event = fbd_simulation_event(simulation, 0);
    const char *takes = event.detail ? strstr(event.detail, "takes ") : NULL;
    ended.outcome = fbd_result_outcome(result);
    ended.first = event.t;
    if (takes) ended.told = strtod(takes + strlen("takes "), NULL);
    fbd_state_get(fbd_result_state(result), rate, &ended.v);
    fbd_state_get(fbd_result_state(result), "t", &ended.t);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    return ended;
}

/* Pushed by 4 + t against friction of 5 a block of 1 kg breaks away at 1 s, and has 1/2 m/s at 2 s: to both sides. */
static void what_breaks_away_goes_where_it_is_pushed(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int side = -1; side <= 1; side += 2) {
        char text[400];
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: 10\nbodies:\n  block:\n    mass: 1 kg\n    motion: slide\n    forces:\n"
                 "      - gravity\n      - normal\n      - friction: 0.5\n"
                 "      - applied: {name: push, value: \"%d*(4[N] + 1[N/s]*t)\"}\nsimulate: {until: 2 s}\n",
                 side);
        struct ended ended = run_of(text, "block.v");
        check_close(&checks, "breakaway", ended.first, 1, 1e-9); /* the tolerance of a run: 1e-10 */
        check_close(&checks, "velocity", ended.v, side * 0.5, 1e-9);
    }
    checks_end(&checks);
}

/* 2 kg fall 2 m into a rope: it takes m g h = 40 J, and the detail has four digits. */
static void a_rope_takes_what_a_fall_has_given(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct ended ended =
        run_of("fbd: 1\ngravity: 10\nground: {points: {hook: [0, 0]}}\nbodies:\n"
               "  load: {mass: 2 kg, motion: particle, initial: {x: 0, y: -1 m}, forces: [gravity]}\n"
               "couplings: [{rope: {name: cord, through: [ground.hook, load], length: 3 m}}]\n"
               "simulate: {until: 1 s}\n",
               "load.vy");
    check_close(&checks, "taut", ended.first, sqrt(0.4), 1e-9);
    check_close(&checks, "taken", ended.told, 40, 0.005);
    checks_end(&checks);
}

/* Drag c v^2 with c/m = 1/m: x = ln(1 + v_0 t), v = v_0 / (1 + v_0 t). At 0.5 m the run ends or goes on, as the event
 * says. */
static void an_event_ends_a_run_or_does_not(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int stop = 0; stop < 2; stop++) {
        char text[400];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n  block:\n    mass: 1 kg\n    motion: slide\n    initial: {v: 2 m/s}\n"
                 "    forces: [{drag: {quadratic: 1 kg/m}}]\n"
                 "simulate: {until: 1 s, events: [{name: mark, when: \"block.x > 0.5[m]\", then: %s}]}\n",
                 stop ? "stop" : "go_on");
        struct ended ended = run_of(text, "block.v");
        double t = (exp(0.5) - 1) / 2;
        check_close(&checks, "mark", ended.first, t, 1e-9);
        check_that(&checks, "how it ends", ended.outcome == (stop ? FBD_STOPPED : FBD_DONE));
        check_close(&checks, "when", ended.t, stop ? t : 1, 1e-9);
        check_close(&checks, "velocity", ended.v, 2 / (1 + 2 * (stop ? t : 1)), 1e-8);
    }
    checks_end(&checks);
}

/* Two bars of 1 m and their coupler in line: the rod has no slope there, and beside it takes one of two freedoms, by
 * either of two branches. Looked for from there, or from beside. */
static void bars_in_line_have_no_linear_motion(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (int beside = 0; beside < 2; beside++) {
        char text[800];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n"
                 "  a: {shape: rod, mass: 1 kg, length: 1 m, motion: {pivot: {at: [0, 0], point: left}},"
                 " initial: {theta: %g rad}, moments: [{spring: {stiffness: 3 N*m/rad}}]}\n"
                 "  b: {shape: rod, mass: 1 kg, length: 1 m, motion: {pivot: {at: [2, 0], point: left}},"
                 " initial: {theta: %g rad}, moments: [{spring: {stiffness: 3 N*m/rad}}]}\n"
                 "couplings: [{rod: {name: bar, between: [a.right, b.right], length: 2 m}}]\n",
                 0.1 * beside, 0.1 * beside);
        fbd_model *model = model_from(text);
        fbd_state *state = fbd_state_new(model);
        fbd_errors *errors = fbd_errors_new();
        fbd_linearization *linear = fbd_linearize(state, errors);
        const char *id = fbd_errors_get(errors, 0).id;
        check_that(&checks, text, !linear && id && strcmp(id, "not-independent") == 0);
        fbd_linearization_free(linear);
        fbd_errors_free(errors);
        fbd_state_free(state);
        fbd_model_free(model);
    }
    checks_end(&checks);
}

/* 1 kg that comes with 2 m/s and leaves with half of it: (1/2) (1 - 4) J, by each law. */
static void an_impact_does_work(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const enum impact_law laws[] = {impact_newton, impact_poisson, impact_stronge, impact_moreau};
    for (size_t i = 0; i < 4; i++) {
        const struct impact_point point = {.W = {1, 0, 1}, .e = 0.5, .mu = 0, .law = laws[i]};
        const struct impact impact = impact_at_point(&point, -2, 0);
        check_close(&checks, "impulse", impact.p, 3, 3 * roundings);
        check_close(&checks, "work", impact.work, -1.5, 3 * roundings);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_axis_that_moves_has_its_term),
        cmocka_unit_test(moments_about_O_and_G_differ),
        cmocka_unit_test(a_table_has_the_normal_force),
        cmocka_unit_test(a_slide_keeps_from_turning),
        cmocka_unit_test(a_drive_takes_its_acceleration_from_the_other),
        cmocka_unit_test(a_rope_unwinds_at_either_end),
        cmocka_unit_test(a_rope_that_is_hauled_in_lifts),
        cmocka_unit_test(a_rope_slips_round_a_drum_by_euler),
        cmocka_unit_test(a_moment_in_a_joint_helps_to_hold),
        cmocka_unit_test(friction_at_rest_needs_a_surface),
        cmocka_unit_test(at_the_limit_the_trend_decides),
        cmocka_unit_test(what_breaks_away_goes_where_it_is_pushed),
        cmocka_unit_test(a_rope_takes_what_a_fall_has_given),
        cmocka_unit_test(an_event_ends_a_run_or_does_not),
        cmocka_unit_test(bars_in_line_have_no_linear_motion),
        cmocka_unit_test(an_impact_does_work),
        cmocka_unit_test(friction_shares_up_to_both_sides_of_its_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
