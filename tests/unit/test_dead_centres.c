/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Flywheels that take sliders with friction to and fro: in the dead centres the slider rests, nothing that pushes it
 * moves the flywheel, and momentum takes both on. Friction turns there, and does not hold.
 *
 * A crank of the moment of inertia I, which turns by theta, moves a slider, x = x(theta), with u = theta_dot^2 and
 * a = x' theta_ddot + x'' u:
 *
 *  - by a rod of the length L, as in test_driven.c: x = R cos theta + p, p = sqrt(L^2 - q^2), q = R sin theta - e,
 *    m a = -S p/L - mu |N| sgn x_dot, N = m g - S q/L, I theta_ddot = S p/L x'
 *  - by its pin in the upright slot of a yoke, which rubs on it with mu_g: x = R cos theta, the height of the pin is
 *    y = R sin theta, m a = Q - mu |N| sgn x_dot, N = m g - f, f = mu_g |Q| sgn y_dot, I theta_ddot = R (Q sin theta - f cos theta)
 *
 * A moment M on the crank comes to I theta_ddot. Between two dead centres all is smooth, so that du/dtheta = 2 theta_ddot
 * and dt/dtheta = 1/theta_dot are integrated from one to the next by the method of Runge.
 *
 * At rest in a dead centre M moves the crank, and the slider only to the second order: it slips the way of x''. What
 * presses in the slot is then all that friction holds, so that the yoke rests as long as f = M/R <= mu_g Q, Q <= mu N.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81, pi = 3.14159265358979323846;
static const double static_slide = 1.5, static_slot = 1.2; /* of the kinetic ones */

struct flywheel {
    bool yoke;
    double R, e, L, I, m, mu, mu_g, theta_0, omega_0, M;
    double rise; /* of the moment, in time */
    int way;     /* in which it turns: 1, -1 */
};

static double draw_friction(struct random_numbers *numbers)
{
    return random_bits(numbers) % 3 ? random_between(numbers, 0.02, 0.25) : 0;
}

static struct flywheel draw_flywheel(struct random_numbers *numbers)
{
    struct flywheel wheel = {.yoke = random_bits(numbers) % 2 == 0,
                             .R = random_between(numbers, 0.05, 0.3),
                             .I = random_between(numbers, 0.05, 0.5),
                             .m = random_between(numbers, 0.5, 3),
                             .mu = draw_friction(numbers),
                             .way = random_bits(numbers) % 2 ? 1 : -1};
    wheel.mu_g = wheel.yoke ? draw_friction(numbers) : 0;
    if (wheel.mu == 0 && wheel.mu_g == 0) wheel.mu = 0.1;
    wheel.e = wheel.yoke || random_bits(numbers) % 2 ? 0 : random_between(numbers, -0.2, 0.2) * wheel.R;
    wheel.L = wheel.R * random_between(numbers, 2.5, 5);
    bool dead = wheel.e == 0 && random_bits(numbers) % 3 == 0;
    wheel.theta_0 = dead ? 0 : random_between(numbers, -3, 3);
    wheel.omega_0 = wheel.way * random_between(numbers, 5, 20);
    return wheel;
}

/* The slope and the curvature of x(theta). */
static void slopes_at(const struct flywheel *wheel, double theta, double *first, double *second)
{
    double c = wheel->R * cos(theta), s = wheel->R * sin(theta), q = s - wheel->e;
    double p = sqrt(wheel->L * wheel->L - q * q), dp = -q * c / p;
    *first = -s + (wheel->yoke ? 0 : dp);
    *second = -c + (wheel->yoke ? 0 : -(c * c - q * s + dp * dp) / p);
}

/* What presses, and with which signs: the force of the rod's guide or of the slot, and the yoke's normal force. */
struct lint_friction {
    int first, second;
};

/* theta_ddot of the yoke. Neither force has to be above zero. */
static double yoke_answer(const struct flywheel *wheel, double theta, double u, struct lint_friction on,
                          double *Q, double *N)
{
    double c = wheel->R * cos(theta), s = wheel->R * sin(theta), I = wheel->I, m = wheel->m;
    double mu = -copysign(wheel->mu, s * wheel->way) * on.second;
    double mu_g = copysign(wheel->mu_g, c * wheel->way) * on.first, lever = s - mu_g * c;
    *Q = (mu * m * g - m * c * u - m * s * wheel->M / I) / (1 + mu * mu_g + m * s * lever / I);
    *N = m * g - mu_g * *Q;
    return (*Q * lever + wheel->M) / I;
}

/* theta_ddot of the slider on a rod. */
static double rod_answer(const struct flywheel *wheel, double theta, double u, struct lint_friction on,
                         double *N)
{
    double first, second, I = wheel->I, m = wheel->m, L = wheel->L, q = wheel->R * sin(theta) - wheel->e;
    slopes_at(wheel, theta, &first, &second);
    double p = sqrt(L * L - q * q), mu = copysign(wheel->mu, first * wheel->way) * on.first;
    double S = -(m * second * u + mu * m * g + m * first * wheel->M / I) /
               ((p - mu * q) / L + m * first * first * p / (L * I));
    *N = m * g - S * q / L;
    return (S * p * first / L + wheel->M) / I;
}

/* Of the sides on which both press those that agree with the forces. */
static double acceleration(const struct flywheel *wheel, double theta, double u, struct lint_friction *on)
{
    for (int k = 0; k < 4; k++) {
        double first, second = 1;
        *on = (struct lint_friction){k % 2 ? -1 : 1, k / 2 ? -1 : 1};
        double a = wheel->yoke ? yoke_answer(wheel, theta, u, *on, &first, &second)
                               : rod_answer(wheel, theta, u, *on, &first);
        if (first * on->first >= 0 && second * on->second >= 0) return a;
    }
    return NAN;
}

static bool same_sides(const struct flywheel *wheel, double theta, double u, double to, double u_there)
{
    struct lint_friction here, there;
    acceleration(wheel, theta, u, &here);
    acceleration(wheel, to, u_there, &there);
    return here.first == there.first && here.second == there.second;
}

/* One step of the method, which keeps off its ends, where friction turns: t and u behind it. */
static void step(const struct flywheel *wheel, double theta, double h, double *t, double *u)
{
    const double inside = 1e-6; /* of the step */
    double at[3] = {theta + inside * h, theta + h / 2, theta + h - inside * h};
    struct lint_friction on;
    double k1 = 2 * acceleration(wheel, at[0], *u, &on), u2 = *u + h / 2 * k1;
    double k2 = 2 * acceleration(wheel, at[1], u2, &on), u3 = *u + h / 2 * k2;
    double k3 = 2 * acceleration(wheel, at[1], u3, &on), u4 = *u + h * k3;
    double k4 = 2 * acceleration(wheel, at[2], u4, &on), end = *u + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    *t += fabs(h) / 6 * (1 / sqrt(*u) + 2 / sqrt(u2) + 2 / sqrt(u3) + 1 / sqrt(end));
    *u = end;
}

/* From theta to the next place, `to`: t and u there. False where it comes near to its rest. */
static bool go_to(const struct flywheel *wheel, double theta, double to, double *t, double *u)
{
    enum { steps = 4000, parts = 256 }; /* where the side of what presses changes */
    const double h = (to - theta) / steps, slow = 1;
    for (int k = 0; k < steps; k++) {
        double from = theta + k * h, t_before = *t, u_before = *u;
        step(wheel, from, h, t, u);
        if (!(*u > slow)) return false;
        if (same_sides(wheel, from, u_before, from + h, *u)) continue;
        *t = t_before, *u = u_before;
        for (int j = 0; j < parts; j++) step(wheel, from + h / parts * j, h / parts, t, u);
    }
    return true;
}

/* Out of a dead centre, by steps that are small shares of the way from there: u goes with that way. */
static void set_out(const struct flywheel *wheel, double *theta, double *t, double *u)
{
    const double least = 1e-12, most = 0.1, share = 0.01;
    struct lint_friction on;
    double a = fabs(acceleration(wheel, *theta + wheel->way * least, 0, &on)), way = least;
    *t = sqrt(2 * way / a), *u = 2 * a * way;
    while (way < most) {
        step(wheel, wheel->theta_0 + wheel->way * way, wheel->way * share * way, t, u);
        way *= 1 + share;
    }
    *theta += wheel->way * way;
}

/* Dead centre number `k` of the slider, counted by theta. */
static double dead_centre(const struct flywheel *wheel, int k)
{
    double far = asin(wheel->e / (wheel->R + wheel->L)), near = asin(wheel->e / (wheel->L - wheel->R));
    if (wheel->yoke) far = near = 0;
    return k * pi + (k % 2 == 0 ? far : near);
}

/* The next place behind theta at which friction turns, and on which of both: 0 the slider's, 1 the slot's. */
static double next_turn(const struct flywheel *wheel, double theta, int *which)
{
    const double beside = 1e-9;
    double best = INFINITY;
    for (int k = -200; k <= 200; k++) {
        double places[] = {dead_centre(wheel, k), (k + 0.5) * pi};
        for (int i = 0; i < (wheel->yoke ? 2 : 1); i++) {
            double way = wheel->way * (places[i] - theta);
            if (way < beside || way > fabs(best - theta)) continue;
            best = places[i];
            *which = i;
        }
    }
    return best;
}

static struct trial parse_flywheel(const struct flywheel *wheel, double until)
{
    char coupling[400], text[1500];
    double c = wheel->R * cos(wheel->theta_0), q = wheel->R * sin(wheel->theta_0) - wheel->e;
    double x = c + (wheel->yoke ? 0 : sqrt(wheel->L * wheel->L - q * q));
    if (wheel->yoke && wheel->mu_g == 0)
        snprintf(coupling, sizeof coupling, "slot: {name: slot, between: [crank.A, slider], along: 90 deg");
    else if (wheel->yoke)
        snprintf(
            coupling, sizeof coupling,
            "slot: {name: slot, between: [crank.A, slider], along: 90 deg, static: %.17g, kinetic: %.17g",
            static_slot * wheel->mu_g, wheel->mu_g);
    else
        snprintf(coupling, sizeof coupling, "rod: {name: rod, between: [crank.A, slider], length: %.17g",
                 wheel->L);
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n"
             "  crank: {mass: 1, inertia: {value: %.17g, about: O}, points: {A: [%.17g, 0]}, motion: pivot,\n"
             "    initial: {theta: %.17g, omega: %.17g}, moments: [applied: %.17g + %.17g*t]}\n"
             "  slider:\n    mass: %.17g\n    motion: {slide: {through: [0, %.17g]}}\n"
             "    initial: {assemble: true, x: %.17g}\n"
             "    forces: [gravity, normal: {two_sided: true}, friction: {static: %.17g, kinetic: %.17g}]\n"
             "couplings: [%s}]\nsimulate: {until: %.17g}\n",
             wheel->I, wheel->R, wheel->theta_0, wheel->omega_0, wheel->M, wheel->rise, wheel->m, wheel->e, x,
             static_slide * wheel->mu, wheel->mu, coupling, until);
    return trial_parse(text);
}

static void check_flywheel(struct checks *checks, const struct flywheel *wheel)
{
    enum { most = 40 };
    const double until = 3;
    struct trial trial = parse_flywheel(wheel, until);
    double theta = wheel->theta_0, t = 0, u = wheel->omega_0 * wheel->omega_0;
    if (u == 0) set_out(wheel, &theta, &t, &u);
    int which = 0, turns[2] = {0, 0};
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_that(checks, "it runs to the end", trial.outcome == FBD_DONE);
    for (int k = 0; k < most && !checks->failed; k++) {
        double to = next_turn(wheel, theta, &which);
        if (!go_to(wheel, theta, to, &t, &u) || t > until - 1e-6) break;
        theta = to;
        if ((which ? wheel->mu_g : wheel->mu) == 0) continue;
        double at =
            trial_event(&trial, FBD_EVENT_REVERSAL, which ? "slot.friction" : "friction", turns[which]++);
        check_close(checks, "reversal", at, t, 1e-7 * (1 + t));
    }
    double stick = trial_event(&trial, FBD_EVENT_STICK, NULL, 0);
    check_that(checks, "it does not stick before", isnan(stick) || stick > t);
    check_that(checks, "the way on is one", isnan(trial_event(&trial, FBD_EVENT_SEVERAL, NULL, 0)));
    trial_close(&trial);
}

static void friction_turns_in_dead_centres(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {190411};
    int draws = draws_of(24);
    printf("# seed %d\n", 190411);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        struct flywheel wheel = draw_flywheel(&numbers);
        check_flywheel(&checks, &wheel);
        if (checks.failed)
            print_message("# draw %d: %s, theta_0 %.17g, mu %g, mu_g %g, e %g\n", draw,
                          wheel.yoke ? "yoke" : "rod", wheel.theta_0, wheel.mu, wheel.mu_g, wheel.e);
    }
    checks_end(&checks);
}

/* What the friction of slide and slot holds of a moment in a dead centre: M/R <= mu_g mu (m g - M/R), where the pin
 * rubs the yoke upwards. */
static double held_moment(const struct flywheel *wheel)
{
    double both = wheel->yoke ? static_slot * wheel->mu_g * static_slide * wheel->mu : 0;
    double up = wheel->way * cos(wheel->theta_0) > 0 ? 1 : -1;
    return wheel->R * both * wheel->m * g / (1 + both * up);
}

/* At rest in a dead centre. */
static struct flywheel draw_at_rest(struct random_numbers *numbers)
{
    struct flywheel wheel = draw_flywheel(numbers);
    wheel.theta_0 = random_bits(numbers) % 2 ? 0 : pi;
    wheel.e = wheel.omega_0 = 0;
    return wheel;
}

static void what_rests_in_a_dead_centre_sets_out(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {19112509};
    int draws = draws_of(16);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        struct flywheel wheel = draw_at_rest(&numbers);
        wheel.M = wheel.way * (held_moment(&wheel) * random_between(&numbers, 1.01, 3) +
                               wheel.m * g * wheel.R * random_between(&numbers, 0.5, 2));
        check_flywheel(&checks, &wheel);
        if (checks.failed)
            print_message("# draw %d: %s, theta_0 %.17g, mu %g, mu_g %g, M %g\n", draw,
                          wheel.yoke ? "yoke" : "rod", wheel.theta_0, wheel.mu, wheel.mu_g, wheel.M);
    }
    checks_end(&checks);
}

static void the_limit_of_what_rests_in_a_dead_centre(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {19112510};
    int draws = draws_of(16);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        struct flywheel wheel = draw_at_rest(&numbers);
        bool beyond = draw % 2;
        if (!wheel.yoke || wheel.mu == 0 || wheel.mu_g == 0) continue;
        wheel.M = wheel.way * held_moment(&wheel) * (beyond ? 1.001 : 0.999);
        struct trial trial = parse_flywheel(&wheel, 0.1);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "it runs to the end", trial.outcome == FBD_DONE);
        const double rounding = 1e-12; /* of what the moment alone would give */
        bool moved = fabs(trial_get(&trial, "crank.omega")) > rounding * fabs(wheel.M) / wheel.I * 0.1;
        check_that(&checks, beyond ? "it moves" : "it rests", moved == beyond);
        if (checks.failed)
            print_message("# draw %d: theta_0 %.17g, mu %g, mu_g %g, M %g\n", draw, wheel.theta_0, wheel.mu,
                          wheel.mu_g, wheel.M);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A moment that rises until it is more than is held: both give at that instant, each the way it goes. */
static void a_moment_rises_until_it_is_not_held(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {19112511};
    int draws = draws_of(16);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        struct flywheel wheel = draw_at_rest(&numbers);
        if (!wheel.yoke || wheel.mu == 0 || wheel.mu_g == 0) continue;
        wheel.rise = wheel.way * held_moment(&wheel);
        struct trial trial = parse_flywheel(&wheel, 1.3);
        trial_start(&trial, NULL);
        trial_finish(&trial);
        check_that(&checks, "it runs to the end", trial.outcome == FBD_DONE);
        check_close(&checks, "slide", trial_event(&trial, FBD_EVENT_BREAKAWAY, "friction", 0), 1, 1e-9);
        check_close(&checks, "slot", trial_event(&trial, FBD_EVENT_BREAKAWAY, "slot.friction", 0), 1, 1e-9);
        check_that(&checks, "it moves", wheel.way * trial_get(&trial, "crank.omega") > 0);
        if (checks.failed)
            print_message("# draw %d: theta_0 %.17g, mu %g, mu_g %g, I %g, R %g, m %g, way %d\n", draw,
                          wheel.theta_0, wheel.mu, wheel.mu_g, wheel.I, wheel.R, wheel.m, wheel.way);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- the dead centre of a rope */

/* Weights m1 and m2 on a rope over a pulley of the radius R on a journal bearing, k = mu r. */
struct hoist {
    double m1, m2, R, k;
};

/* The first weight rises beside its pulley, past the dead centre of its rope, level with the axis, where the
 * pulley reverses, and back. Returns whether it passes. */
static bool run_past(const struct hoist *h, double aside, double M, double *v, double *omega)
{
    char text[800];
    snprintf(
        text, sizeof text,
        "fbd: 1\nbodies:\n  first: {mass: %.17g, motion: {slide: {along: 90 deg, through: [%.17g, -1]}}, "
        "forces: [gravity]}\n  second: {mass: %.17g, motion: {slide: {along: 90 deg, through: [%.17g, -4]}}, "
        "forces: [gravity]}\n  pulley:\n    mass: %.17g\n    shape: disc\n    radius: %.17g\n    motion: "
        "pivot\n    moments: [friction: {bearing: 0.2, radius: %.17g}]\ncouplings:\n  - rope: {through: "
        "[second.G, pulley, first.G]}\nsimulate: {until: 1.2 s, events: [{name: past, when: first.y > 0}]}\n",
        h->m1, h->R + aside, h->m2, -h->R, M, h->R, h->k / 0.2);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    const bool passes = trial.outcome == FBD_DONE && trial_event(&trial, FBD_EVENT_USER, "past", 0) > 0;
    *v = trial_get(&trial, "first.v");
    *omega = trial_get(&trial, "pulley.omega");
    trial_close(&trial);
    return passes;
}

/* A pulley without mass moves as one of a millionth of the weights does. */
static void a_weight_rises_past_its_pulley(void **unused)
{
    (void)unused;
    const double light = 1e-6, near = 1e-4;
    const int draws = draws_of(20);
    struct random_numbers numbers = {5105};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++) {
        struct hoist h = {.m1 = random_between(&numbers, 0.5, 5), .R = random_between(&numbers, 0.05, 0.5)};
        const double aside = random_between(&numbers, 0.1, 0.5);
        double v, omega, v_light, omega_light;
        h.m2 = h.m1 * random_between(&numbers, 2.5, 4);
        h.k = h.R * random_between(&numbers, 0.005, 0.3);
        check_that(&checks, "passes", run_past(&h, aside, 0, &v, &omega));
        check_that(&checks, "passes", run_past(&h, aside, light * h.m1, &v_light, &omega_light));
        check_close(&checks, "v past the dead centre", v, v_light, near);
        check_close(&checks, "omega past the dead centre", omega, omega_light, near / h.R);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(friction_turns_in_dead_centres),
        cmocka_unit_test(what_rests_in_a_dead_centre_sets_out),
        cmocka_unit_test(the_limit_of_what_rests_in_a_dead_centre),
        cmocka_unit_test(a_moment_rises_until_it_is_not_held),
        cmocka_unit_test(a_weight_rises_past_its_pulley),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
