/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * From the file to the report with memory that runs out at each allocation in turn: no crash, no leak, and no
 * result that looks whole but is not.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "dynamics/tree.h"
#include "fbd_export.h"
#include "fbd_grade.h"
#include "fbd_study.h"
#include "memory_calls.h"
#include "model/model.h"
#include "rest/balance.h"
#include "scene_fixture.h"

static const char text[] = "fbd: 1\n"
                           "parameters: {mu: 0.3, k: 4 N/m}\n"
                           "bodies:\n"
                           "  block:\n"
                           "    mass: 2 kg\n"
                           "    motion: slide\n"
                           "    initial: {v: 1 m/s}\n"
                           "    forces:\n"
                           "      - gravity\n"
                           "      - normal\n"
                           "      - friction: mu\n"
                           "      - applied: {value: '-k*x*step(t - 0.1[s])'}\n"
                           "    hand: 'm*v_dot = -k*x*step(t - 0.1[s]) - mu*m*g*sign(v)'\n"
                           "  arm:\n"
                           "    shape: rod\n"
                           "    mass: 1 kg\n"
                           "    length: 1 m\n"
                           "    motion: {pivot: {point: left}}\n"
                           "    forces: [gravity]\n"
                           "    moments: [{damper: {coefficient: 0.1 N*m*s/rad}}]\n"
                           "simulate: {until: 0.4 s, events: [{when: 'block.x = 0.05[m]'}]}\n";

static const char joined[] =
    "fbd: 1\n"
    "bodies:\n"
    "  arm:\n"
    "    shape: rod\n"
    "    mass: 1 kg\n"
    "    length: 1 m\n"
    "    motion: {pivot: {point: left}}\n"
    "    forces: [gravity]\n"
    "  tip: {mass: 1 kg, motion: {weld: {on: arm, at: right}}, forces: [gravity]}\n"
    "  bob: {mass: 1 kg, motion: particle, initial: {x: 1, y: -1}, forces: [gravity]}\n"
    "couplings:\n"
    "  - rope: {through: [bob, arm.right]}\n"
    "  - spring: {between: [bob, arm], stiffness: 1}\n"
    "simulate: {until: 0.1 s, events: [{when: 'arm.right.y < -0.01[m]'}]}\n";

/* Lines of energy and momentum: a run is made for them. */
static const char by_a_run[] = "fbd: 1\n"
                               "parameters: {e: 0.5}\n"
                               "ground: {lines: {floor: {along: 0 deg}}}\n"
                               "bodies:\n"
                               "  ball:\n"
                               "    shape: disk\n"
                               "    radius: 0.1 m\n"
                               "    mass: 1 kg\n"
                               "    motion: planar\n"
                               "    initial: {y: 0.2 m}\n"
                               "    forces: [gravity]\n"
                               "    hand:\n"
                               "      - 'after(vy) = -e*before(vy)'\n"
                               "      - '½ m vy² + m g (y - y0) = work(floor)'\n"
                               "      - 'm*vy = m*vy0 + impulse(gravity.y)'\n"
                               "      - conserved: 'm*vy^2/2 + m*g*y'\n"
                               "contacts: [{name: floor, between: [ball, ground.floor], restitution: e}]\n"
                               "simulate: {until: 0.2 s}\n";

static bool judge_by_a_run(void)
{
    fbd_errors *errors;
    size_t differing = 0;
    fbd_model *model = load(by_a_run, &errors);
    if (!model) return false;
    bool done = some(fbd_check_hand(model, 1, &differing));
    if (done) assert_int_equal(differing, 2);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return done;
}

static int swallow(void *context, const char *bytes, size_t length)
{
    (void)context, (void)bytes, (void)length;
    return 0;
}

static bool run_and_write_with(const char *scene, fbd_options options)
{
    fbd_errors *errors;
    fbd_model *model = load(scene, &errors);
    if (!model) return false;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_recording recording = {.ledger = true, .csv = swallow, .keep = true, .table = true};
    fbd_result *result = simulation ? fbd_simulation_run(simulation, &recording) : NULL;
    bool done = result && fbd_result_outcome(result) == FBD_DONE;
    done = done && some(fbd_result_report(result, false)) && some(fbd_result_json(result));
    done = done && (!fbd_has_html() || some(fbd_result_html(result, errors)));
    done = done && some(fbd_result_gnuplot(result, "a.svg", NULL, errors));
    fbd_simulation *again = done ? fbd_simulation_again(simulation, options.error_bars, errors) : NULL;
    done = done && again;
    fbd_simulation_free(again);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return done;
}

static bool run_and_write(void)
{
    return run_and_write_with(text, (fbd_options)FBD_OPTIONS_DEFAULT);
}

static bool run_and_write_joined(void)
{
    return run_and_write_with(joined, (fbd_options)FBD_OPTIONS_DEFAULT);
}

static bool run_with_error_bars(void)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = true;
    return run_and_write_with(text, options);
}

static bool run_accurately(void)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.accuracy = 1e-9;
    return run_and_write_with(text, options);
}

static bool look_closer(void)
{
    fbd_errors *errors;
    fbd_model *model = load(text, &errors);
    if (!model) return false;
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_state *state = fbd_state_new(model);
    bool done = state && some(fbd_explain(model, &options));
    for (fbd_equations_options written = {0}; written.format <= FBD_JSON; written.format++)
        done = done && some(fbd_equations_write(state, &written, NULL));
    done = done && some(fbd_diagram_svg(state, NULL, errors));
    done = done && fbd_model_has_columns(model, "arm.omega,block.friction", errors);
    done = done && some(fbd_check_hand(model, 1, NULL));
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return done;
}

static bool linearize(void)
{
    static const char pendulum[] =
        "fbd: 1\nbodies:\n  arm: {shape: rod, mass: 1, length: 1, motion: {pivot: {point: left}}, "
        "forces: [gravity]}\nsimulate: {until: 1}\n";
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return false;
    fbd_model *model = fbd_model_parse(pendulum, strlen(pendulum), "scene", NULL, 0, errors);
    fbd_state *state = model ? fbd_state_new(model) : NULL;
    fbd_linearization *linear = state ? fbd_linearize(state, errors) : NULL;
    bool done = linear && some(fbd_linearization_text(linear)) && some(fbd_linearization_svg(linear));
    fbd_linearization_free(linear);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return done;
}

/* A ladder that leans on a rough wall: indeterminate, and its least reactions are beyond a limit. And a
 * cart that is pushed or not. */
static bool rest_with(const char *push)
{
    static const char format[] =
        "fbd: 1\nground: {lines: {wall: {through: [2.5, 0], along: 90 deg}}}\nbodies:\n"
        "  foot: {mass: 1, motion: slide, forces: [gravity, normal, friction: 0.9]}\n"
        "  ladder: {shape: rod, mass: 20, length: 5, motion: {pivot: {on: foot, at: G, point: left}},\n"
        "    initial: {theta: 60 deg}, forces: [gravity]}\n"
        "  top: {mass: 1, motion: {slide: {line: wall}}, initial: {assemble: true},\n"
        "    forces: [gravity, normal: {side: left}, friction: 0.1]}\n"
        "  cart: {mass: 1, motion: slide, forces: [applied: %s]}\n"
        "couplings: [pin: {name: hinge, between: [ladder.right, top.G]}]\n";
    char scene[sizeof format + 40];
    snprintf(scene, sizeof scene, format, push);
    fbd_errors *errors;
    fbd_model *model = load(scene, &errors);
    if (!model) return false;
    fbd_state *state = fbd_state_new(model);
    fbd_statics *statics = state ? fbd_statics_new(state, errors) : NULL;
    bool done = statics && some(fbd_statics_text(statics)) && some(fbd_statics_json(statics));
    done = done && fbd_statics_indeterminacy(statics) == 1;
    fbd_statics_free(statics);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return done;
}

static bool rest(void)
{
    return rest_with("0 N");
}

static bool move(void)
{
    return rest_with("5 N");
}

/* Two rods hung up by three points, let down. */
static bool let_down(void)
{
    static const char swing[] = "fbd: 1\nground: {points: {C: [1, 0]}}\nbodies:\n"
                                "  a: {shape: rod, mass: 1, length: 1, motion: {pivot: {point: left}}, "
                                "initial: {theta: -1}, forces: [gravity]}\n"
                                "  b: {shape: rod, mass: 2, length: 1, motion: planar, initial: {assemble: "
                                "true, x: 1, y: -1, theta: 1}}\n"
                                "couplings:\n  - pin: {name: p, between: [b.left, a.right]}\n"
                                "  - rod: {name: r, between: [b.right, ground.C]}\n";
    fbd_errors *errors;
    fbd_model *model = load(swing, &errors);
    if (!model) return false;
    fbd_state *state = fbd_state_new(model);
    bool done = state && fbd_find_equilibrium(state, errors);
    fbd_state_free(state);
    fbd_model_free(model);
    fbd_errors_free(errors);
    return done;
}

static void a_run_without_memory_fails_and_leaks_nothing(void **unused)
{
    (void)unused;
    fail_each(run_and_write, 100);
}

static void error_bars_without_memory_fail_and_leak_nothing(void **unused)
{
    (void)unused;
    fail_each(run_with_error_bars, 100);
    fail_each(run_accurately, 100);
}

static void a_run_of_joined_bodies_without_memory_fails_and_leaks_nothing(void **unused)
{
    (void)unused;
    fail_each(run_and_write_joined, 100);
}

static void lines_of_a_run_without_memory_fail_and_leak_nothing(void **unused)
{
    (void)unused;
    fail_each(judge_by_a_run, 100);
}

static void looking_without_memory_fails_and_leaks_nothing(void **unused)
{
    (void)unused;
    fail_each(look_closer, 100);
}

static void linearisation_without_memory_fails_and_leaks_nothing(void **unused)
{
    (void)unused;
    fail_each(linearize, 0);
}

static void statics_without_memory_fail_and_leak_nothing(void **unused)
{
    (void)unused;
    fail_each(rest, 100);
    fail_each(move, 100);
    fail_each(let_down, 100);
}

/* Without memory nobody can tell what rounding explains: then no equation is said to be off. */
static void a_balance_without_memory_fails_and_leaks_nothing(void **unused)
{
    (void)unused;
    struct reading reading = read_right(joined);
    struct fbd_model *model = model_compile(reading.scene, reading.errors);
    assert_non_null(model);
    reading.scene = NULL;
    struct fbd_state *state = state_new(model);
    assert_non_null(state);
    bool failed = true;
    for (size_t n = 1; failed; n++) {
        struct text lack = {0};
        state_evaluate(state);
        state->tree->links[1].A.a.y = NAN;
        fail_alloc_at(n);
        bool off = balance_lack(state, &lack);
        failed = fail_alloc_end();
        assert_true(off);
        assert_int_equal(lack.failed, failed);
        if (!failed) assert_non_null(strstr(lack.data, "do not account for its motion"));
        text_free(&lack);
    }
    state_free(state);
    fbd_model_free(model);
    end_reading(&reading);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_run_without_memory_fails_and_leaks_nothing),
        cmocka_unit_test(error_bars_without_memory_fail_and_leak_nothing),
        cmocka_unit_test(a_run_of_joined_bodies_without_memory_fails_and_leaks_nothing),
        cmocka_unit_test(lines_of_a_run_without_memory_fail_and_leak_nothing),
        cmocka_unit_test(looking_without_memory_fails_and_leaks_nothing),
        cmocka_unit_test(linearisation_without_memory_fails_and_leaks_nothing),
        cmocka_unit_test(statics_without_memory_fail_and_leak_nothing),
        cmocka_unit_test(a_balance_without_memory_fails_and_leaks_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
