/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * States with equations of their own: random scenes against closed forms and against equations that are written out here
 * and integrated by GSL; equilibrium and eigenvalues against characteristic polynomials; kinks of rates to the rounding
 * of their instants.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <complex.h>
#undef I
#include <stdlib.h>

#include "dynamics/rates.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "random_numbers.h"
#include "run_checks.h"

static const double pi = 3.14159265358979323846;

/* ---- an inverted pendulum under a PID controller */

struct held {
    double I, mgl, kp, ki, kd, setpoint;
};

static int held_rates(double t, const double *y, double *dydt, void *context)
{
    const struct held *h = context;
    (void)t;
    dydt[0] = y[1];
    dydt[1] = (h->mgl * sin(y[0]) + h->kp * (h->setpoint - y[0]) + h->ki * y[2] - h->kd * y[1]) / h->I;
    dydt[2] = h->setpoint - y[0];
    return GSL_SUCCESS;
}

/* I l^3 + kd l^2 + (kp - m g L cos) l + ki = 0 for each eigenvalue l. */
static void check_modes(struct checks *checks, struct trial *trial, const struct held *h)
{
    fbd_linearization *linear = fbd_linearize(trial->state, NULL);
    assert_non_null(linear);
    assert_int_equal(fbd_linearization_size(linear), 3);
    assert_true(fbd_linearization_coordinate(linear, 1) == (size_t)-1);
    double slope = h->kp - h->mgl * cos(h->setpoint);
    for (size_t k = 0; k < 3; k++) {
        fbd_mode mode = fbd_linearization_mode(linear, k);
        double complex l = mode.re + _Complex_I * mode.im,
                       left = h->I * l * l * l + h->kd * l * l + slope * l + h->ki;
        double size = h->I * pow(cabs(l), 3) + h->kd * pow(cabs(l), 2) + fabs(slope) * cabs(l) + h->ki;
        check_close(checks, "eigenvalue", cabs(left) / size, 0, 1e-10);
    }
    check_close(checks, "theta at rest", get(trial, "p.theta"), h->setpoint, 1e-9);
    check_close(checks, "integral at rest", get(trial, "states.e"), -h->mgl * sin(h->setpoint) / h->ki, 1e-8);
    fbd_linearization_free(linear);
}

static void a_controller_holds_a_pendulum(void **unused)
{
    struct random_numbers numbers = {32};
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int k = 0; k < trials; k++) {
        double m = random_between(&numbers, 0.5, 3), L = random_between(&numbers, 0.5, 1.5);
        struct held h = {m * L * L,
                         m * g * L,
                         random_between(&numbers, 40, 90),
                         random_between(&numbers, 10, 60),
                         random_between(&numbers, 3, 12),
                         random_between(&numbers, -0.3, 0.3)};
        double y[3] = {random_between(&numbers, -0.3, 0.3), 0, random_between(&numbers, -0.1, 0.1)}, t = 4;
        snprintf(text, sizeof text,
                 "fbd: 1\nstates: {e: {rate: %.17g - p.theta, initial: %.17g s}}\nbodies:\n  p:\n    parts: "
                 "{bob: {shape: point, mass: %.17g, center: [0, %.17g]}}\n    motion: pivot\n    initial: "
                 "{theta: %.17g}\n    forces: [gravity]\n    moments: [applied: {name: motor, value: "
                 "%.17g*(%.17g - theta) + %.17g*states.e - %.17g*omega}]\nsimulate: {until: %g}\n",
                 h.setpoint, y[2], m, L, y[0], h.kp, h.setpoint, h.ki, h.kd, t);
        struct trial trial = run_of(text);
        integrate(held_rates, &h, 3, t, y);
        check_close(&checks, "theta", get(&trial, "p.theta"), y[0], same);
        check_close(&checks, "omega", get(&trial, "p.omega"), y[1], 10 * same);
        check_close(&checks, "integral", get(&trial, "states.e"), y[2], same);
        check_energy(&checks, &trial);
        check_modes(&checks, &trial, &h);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- kinks and events */

/* A body passes places with 1 m/s: z' is 1 up to x = 1, then 2, and |x - 3| beside it. */
static void kinks_of_rates_are_events(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_of(
        "fbd: 1\nstates:\n  z: {rate: 'if(b.x > 1[m], 2, 1)', unit: s}\n  w: {rate: 'abs(b.x - 3[m])'}\n"
        "  p: {rate: 'pulse(t, 0.3, 0.01)', unit: s}\nbodies: {b: {mass: 1, motion: slide, initial: "
        "{v: 1}}}\nsimulate:\n  until: 5\n  events:\n    - {name: half, when: 'states.z = 1.5[s]'}\n");
    check_close(&checks, "z", get(&trial, "states.z"), 1 + 2 * 4, 1e-13);
    check_close(&checks, "w", get(&trial, "states.w"), 4.5 + 2, 1e-13);
    check_close(&checks, "p", get(&trial, "states.p"), 0.01, 1e-14);
    check_close(&checks, "t", trial_event(&trial, FBD_EVENT_USER, "half", 0), 1.25, 1e-13);
    check_close(&checks, "switch", trial_event(&trial, FBD_EVENT_SWITCH, "z", 0), 1, 1e-13);
    trial_close(&trial);
    checks_end(&checks);
}

/* An integral that is held at its limit, and let go when the error turns: e = cos(t), from 0, at most 0.5. */
static void an_integral_is_clamped(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_of("fbd: 1\nstates: {z: {rate: 'if(states.z >= 0.5[s], min(cos(t*1[1/s]), 0), "
                                "cos(t*1[1/s]))', unit: s}}\n"
                                "bodies: {b: {mass: 1, motion: slide}}\nsimulate: {until: 4}\n");
    check_that(&checks, "outcome", trial.outcome == FBD_DONE);
    check_close(&checks, "z", get(&trial, "states.z"), 0.5 + sin(4) - 1, 1e-11);
    trial_close(&trial);
    checks_end(&checks);
}

static void what_has_no_way_on_is_refused(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial relay = run_of(
        "fbd: 1\nstates: {z: {rate: '-sign(states.z)', initial: 1, unit: s}}\nbodies: {b: {mass: 1, motion: "
        "slide}}\nsimulate: {until: 3}\n");
    check_that(&checks, "relay", relay.outcome == FBD_FAILED);
    check_that(&checks, "by name", strstr(fbd_simulation_reason(relay.simulation), "`z`") != NULL);
    check_that(&checks, "with advice", strstr(fbd_simulation_reason(relay.simulation), "hysteresis") != NULL);
    trial_close(&relay);
    struct trial away =
        run_of("fbd: 1\nstates: {z: {rate: 'states.z^2*1[1/s^2]', initial: 1, unit: s}}\nbodies: {b: "
               "{mass: 1, motion: slide}}\nsimulate: {until: 3}\n");
    check_that(&checks, "runs away", away.outcome == FBD_FAILED);
    check_that(&checks, "by name", strstr(fbd_simulation_reason(away.simulation), "`z`") != NULL);
    trial_close(&away);
    struct trial root =
        run_of("fbd: 1\nstates: {z: {rate: '-sqrt(2 - t*1[1/s])', initial: 1, unit: s}}\nbodies: {b: "
               "{mass: 1, motion: slide}}\nsimulate: {until: 3}\n");
    check_that(&checks, "no number", root.outcome == FBD_FAILED);
    check_that(&checks, "by name",
               strstr(fbd_simulation_reason(root.simulation), "rate of the state `z`") != NULL);
    trial_close(&root);
    checks_end(&checks);
}

/* ---- with couplings, places and friction */

/* Two masses on a rope, held by a force that follows with a lag: z' = (x - z)/tau, F = -c z on the first, of
 * mass m1. With M = m1 + m2: M tau l^3 + M l^2 + c = 0. */
static void a_lag_on_coupled_bodies(void **unused)
{
    const double m1 = 2, m2 = 3, c = 40, tau = 0.2, M = m1 + m2;
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_of(
        "fbd: 1\nground: {points: {P: [0, 5], Q: [1, 5]}}\nstates: {z: {rate: '(a.x - states.z)/0.2[s]', "
        "initial: 0.1 m}}\n"
        "bodies:\n  a: {mass: 2, motion: {slide: {along: 90 deg}}, forces: [gravity, applied: {name: f, "
        "value: "
        "'-40[N/m]*states.z'}]}\n"
        "  b: {mass: 3, motion: {slide: {along: 90 deg, through: [1, 0]}}, forces: [gravity]}\n"
        "couplings: [rope: {name: r, through: [a.G, ground.P, ground.Q, b.G]}]\nsimulate: {until: 0.4}\n");
    check_that(&checks, "outcome", trial.outcome == FBD_DONE);
    fbd_linearization *linear = fbd_linearize(trial.state, NULL);
    if (linear) {
        check_that(&checks, "size", fbd_linearization_size(linear) == 3);
        for (size_t k = 0; k < 3; k++) {
            fbd_mode mode = fbd_linearization_mode(linear, k);
            double complex l = mode.re + _Complex_I * mode.im;
            check_close(&checks, "eigenvalue", cabs(M * tau * l * l * l + M * l * l + c) / c, 0, 1e-8);
        }
        check_close(&checks, "z", get(&trial, "states.z"), (m2 - m1) * g / c, 1e-6);
        check_close(&checks, "x", get(&trial, "a.x"), get(&trial, "states.z"), 1e-8);
    }
    check_that(&checks, "linear", linear != NULL);
    fbd_linearization_free(linear);
    trial_close(&trial);
    checks_end(&checks);
}

static const char tangle[] =
    "fbd: 1\nparameters: {tau: 0.3 s}\nstates:\n"
    "  z: {rate: 'tip.right.x - states.w/tau*1[m]', unit: m*s}\n"
    "  w: {rate: 'sin(arm.theta) + abs(tip.omega)*1[s] - states.w/tau', unit: s}\n"
    "bodies:\n  arm:\n    {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [0, 0], point: left}}, "
    "initial: {theta: 0.4, omega: 1}, forces: [gravity], moments: [applied: {name: m, value: "
    "'-3[N/s]*states.z + 2[N*m/s]*states.w*cos(theta)'}]}\n"
    "  tip:\n    {shape: rod, mass: 0.5, length: 0.5, motion: {pivot: {on: arm, at: right, point: left}}, "
    "initial: {omega: -2}, forces: [gravity, applied: {name: f, value: '1[N]*tanh(states.w/1[s])', angle: 90 "
    "deg, at: right}]}\n"
    "simulate: {until: 3}\n";

/* The exact Jacobian of jointed bodies and states against central differences of the rates. */
static void the_jacobian_is_exact(void **unused)
{
    enum { n = 2, size = 6 };
    const double h = 1e-6;
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse(tangle);
    double J[size * size], dfdt[size], y[size], plus[size], minus[size];
    void *params;
    trial_set(&trial, "states.z", 0.3);
    trial_set(&trial, "states.w", 0.4);
    struct fbd_state *state = (struct fbd_state *)trial.state;
    assert_int_equal(plan_size(&state->model->plan), size);
    memcpy(y, state->y, sizeof y);
    struct instant at = state_instant_at(state, 0, y);
    struct rates *made = rates_new(state, rates_by_rows);
    assert_non_null(made);
    state_jacobian(state->model, &at, state->scratch, J, dfdt);
    for (int j = 0; j < size; j++) {
        double kept = y[j];
        y[j] = kept + h;
        rates_call(made, &params)(0, y, plus, params);
        y[j] = kept - h;
        rates_call(made, &params)(0, y, minus, params);
        y[j] = kept;
        for (int i = 0; i < size; i++)
            check_close(&checks, "slope", J[i * size + j], (plus[i] - minus[i]) / (2 * h),
                        1e-7 * (1 + fabs(J[i * size + j])));
    }
    rates_free(made);
    trial_close(&trial);
    checks_end(&checks);
}

/* An integral in the surface of a sliding mode, s = v + 2 x + z with z' = x: on it x'' = -2 x' - x. */
static void a_sliding_mode_with_an_integral(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = run_of("fbd: 1\nstates: {z: {rate: b.x, initial: 0 m*s}}\nbodies:\n  b: {mass: 1, "
                                "motion: slide, initial: {x: 1}, "
                                "forces: [applied: {name: f, value: '-5[N]*sign(v + 2[1/s]*x + "
                                "1[1/s^2]*states.z) + 1[N]*sin(3[1/s]*t)'}]}\n"
                                "simulate: {until: 5}\n");
    check_that(&checks, "outcome", trial.outcome == FBD_DONE);
    double on = trial_event(&trial, FBD_EVENT_SLIDING, "f", 0);
    check_that(&checks, "slides", on > 0 && on < 1);
    check_close(&checks, "surface", get(&trial, "b.v") + 2 * get(&trial, "b.x") + get(&trial, "states.z"), 0,
                1e-10);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- by name, again, and at rest */

static void states_have_names_and_units(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse("fbd: 1\nunits: US\nstates:\n  q: {rate: b.x, initial: 3 in*s}\n  r: "
                                     "{rate: '1/2[s] - states.r/4[s]', unit: 1}\n"
                                     "  e: {rate: b.v, initial: 2, unit: in}\nbodies: {b: {mass: 1, motion: "
                                     "slide}}\nsimulate: {until: 1}\n");
    check_that(&checks, "count", fbd_model_state_count(trial.model) == 3);
    fbd_own_state q = fbd_model_state(trial.model, 0), r = fbd_model_state(trial.model, 1);
    assert_string_equal(q.name, "states.q");
    assert_string_equal(q.unit, "ft*s");
    assert_string_equal(q.rate_unit, "ft");
    assert_string_equal(r.unit, "1");
    assert_null(fbd_model_state(trial.model, 3).name);
    check_close(&checks, "q", get(&trial, "states.q"), 0.25, 1e-15);
    check_close(&checks, "e", get(&trial, "states.e"), 2.0 / 12, 1e-15);
    check_that(&checks, "text", fbd_state_set_text(trial.state, "states.q", "6 in*s", NULL));
    check_close(&checks, "q", get(&trial, "states.q"), 0.5, 1e-15);
    check_that(&checks, "no length", !fbd_state_set_text(trial.state, "states.q", "6 in", NULL));
    check_that(&checks, "no state", !fbd_state_set(trial.state, "states.s", 1));
    trial_close(&trial);
    checks_end(&checks);
}

static void a_run_again_is_the_same(void **unused)
{
    double first[2], again[2];
    (void)unused;
    struct trial trial = trial_parse(tangle);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    first[0] = get(&trial, "states.z"), first[1] = get(&trial, "states.w");
    fbd_simulation *next = fbd_simulation_again(trial.simulation, false, NULL);
    assert_non_null(next);
    fbd_simulation_free(trial.simulation);
    trial.simulation = next;
    while (fbd_simulation_advance(trial.simulation) == FBD_GOING) continue;
    trial_finish(&trial);
    again[0] = get(&trial, "states.z"), again[1] = get(&trial, "states.w");
    assert_memory_equal(first, again, sizeof first);
    trial_close(&trial);
}

static bool is_noted(fbd_errors *errors, const char *id)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++)
        if (strcmp(fbd_errors_get(errors, i).id, id) == 0) return true;
    return false;
}

/* A state that changes while bodies rest is told by name; where all rest the reactions are those of the state there. */
static void states_at_rest(void **unused)
{
    struct checks checks = {0};
    fbd_errors *errors = fbd_errors_new();
    (void)unused;
    struct trial trial = trial_open("control/held_pendulum.yaml", NULL);
    check_that(&checks, "refused", !fbd_statics_new(trial.state, errors) && is_noted(errors, "not-at-rest"));
    check_that(&checks, "settles", fbd_find_equilibrium(trial.state, errors));
    check_close(&checks, "theta", get(&trial, "pendulum.theta"), 10 * pi / 180, 1e-10);
    fbd_statics *rest = fbd_statics_new(trial.state, errors);
    check_that(&checks, "holds", rest && fbd_statics_holds(rest));
    fbd_statics_free(rest);
    trial_close(&trial);
    struct trial clock =
        trial_parse("fbd: 1\nstates: {c: {rate: 1, unit: s}}\nbodies: {b: {mass: 1, motion: slide, "
                    "forces: [spring: {stiffness: 9}]}}\n");
    check_that(&checks, "a clock does not rest", !fbd_find_equilibrium(clock.state, errors));
    check_that(&checks, "nor here", !fbd_linearize(clock.state, errors));
    trial_close(&clock);
    fbd_errors_free(errors);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_controller_holds_a_pendulum),   cmocka_unit_test(kinks_of_rates_are_events),
        cmocka_unit_test(an_integral_is_clamped),          cmocka_unit_test(what_has_no_way_on_is_refused),
        cmocka_unit_test(a_lag_on_coupled_bodies),         cmocka_unit_test(the_jacobian_is_exact),
        cmocka_unit_test(a_sliding_mode_with_an_integral), cmocka_unit_test(states_have_names_and_units),
        cmocka_unit_test(a_run_again_is_the_same),         cmocka_unit_test(states_at_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
