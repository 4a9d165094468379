/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction in slots, against closed forms and against integrations of the equations of one coordinate; tests/unit/test_slots.c
 * holds random curves that rub against the same curves as tracks.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "fbd_study.h"
#include "joined_checks.h"
#include "random_numbers.h"

static const double g = 9.81, pi = 3.141592653589793;

/* ---- a Scotch yoke whose pin rubs: with x = r cos(theta), v = r omega cos(theta) the velocity along the slot, and N the
 * force of the pin on the yoke,
 *
 *     m x'' = N - k x,   I theta'' = r sin(theta) N - sgn(v) mu |N| r cos(theta)
 */
struct yoke {
    double r, mu, I, m, k;
};

static double yoke_acceleration(const struct yoke *y, double theta, double omega)
{
    double c = cos(theta), s = sin(theta), side = omega * c > 0 ? 1 : -1, a = 0;
    for (int sign = 1; sign >= -1; sign -= 2) { /* of N */
        double arm = y->r * s - side * y->mu * sign * y->r * c;
        double still = -y->m * y->r * omega * omega * c + y->k * y->r * c; /* N = still - m r sin(theta) a */
        a = arm * still / (y->I + arm * y->m * y->r * s);
        if (sign * (still - y->m * y->r * s * a) >= 0) break;
    }
    return a;
}

static void yoke_step(const struct yoke *y, double h, double *theta, double *omega)
{
    double a1 = yoke_acceleration(y, *theta, *omega), w1 = *omega;
    double w2 = *omega + h / 2 * a1, a2 = yoke_acceleration(y, *theta + h / 2 * w1, w2);
    double w3 = *omega + h / 2 * a2, a3 = yoke_acceleration(y, *theta + h / 2 * w2, w3);
    double w4 = *omega + h * a3, a4 = yoke_acceleration(y, *theta + h * w3, w4);
    *theta += h / 6 * (w1 + 2 * w2 + 2 * w3 + w4);
    *omega += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
}

/* It passes its dead centres eleven times in 3 s: there the velocity along the slot and the force of the pin are zero, and
 * nothing along the slot could hold it. */
static void a_scotch_yoke_loses_what_its_pin_rubs(void **unused)
{
    enum { steps = 30000 };
    const struct yoke yoke = {0.1, 0.2, 0.01, 2, 200};
    double theta = 0.3, omega = 20;
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "bodies:\n"
        "  crank: {mass: 1, inertia: 0.01, points: {pin: [0.1, 0]}, motion: pivot, initial: {theta: 0.3, "
        "omega: 20}}\n"
        "  yoke: {mass: 2, motion: slide, initial: {x: 0.1, assemble: true}, forces: [spring: {stiffness: "
        "200}]}\n"
        "couplings: [slot: {name: groove, between: [crank.pin, yoke], along: 90 deg, kinetic: 0.2}]\n"
        "simulate: {until: 3}\n");
    trial_start(&trial, NULL);
    trial_to(&trial, 3);
    for (int i = 0; i < steps; i++) yoke_step(&yoke, 3.0 / steps, &theta, &omega);
    check_close(&checks, "theta", trial_get(&trial, "crank.theta"), theta, 1e-8);
    check_close(&checks, "omega", trial_get(&trial, "crank.omega"), omega, 1e-8);
    trial_close(&trial);
    checks_end(&checks);
}

/* A bead rests in the slot of an arm that is turned with W, until g sin(W t) - W^2 s = mu g cos(W t). */
static void a_bead_sticks_until_its_slot_is_steep(void **unused)
{
    const double W = 0.5, s = 0.3, mu = 0.4;
    double low = 0, high = 2;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "bodies:\n"
                    "  arm: {mass: 1, inertia: 0.1, motion: {pivot: {theta: \"0.5[rad/s]*t\"}}}\n"
                    "  bead: {mass: 0.2, motion: particle, initial: {x: 0.3, vy: 0.15}, forces: [gravity]}\n"
                    "couplings: [slot: {name: groove, between: [bead, arm], static: 0.4, kinetic: 0.3}]\n"
                    "simulate: {until: 1}\n");
    (void)unused;
    trial_start(&trial, NULL);
    trial_to(&trial, 0.5); /* it has not moved along the arm */
    check_close(&checks, "sticks", trial_get(&trial, "bead.x"), s * cos(W * 0.5), 1e-12);
    check_close(&checks, "holds",
                hypot(arrow_on(&trial, 1, "groove.friction").fx, arrow_on(&trial, 1, "groove.friction").fy),
                0.2 * (g * sin(W * 0.5) - W * W * s), 1e-10);
    trial_to(&trial, 1);
    for (int i = 0; i < 60; i++) {
        double t = (low + high) / 2;
        *(g * sin(W * t) - W * W * s > mu * g * cos(W * t) ? &high : &low) = t;
    }
    fbd_event slips = fbd_simulation_event(trial.simulation, 0);
    check_that(&checks, "breaks away", slips.kind == FBD_EVENT_BREAKAWAY);
    check_close(&checks, "when", slips.t, low, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* The follower of a driven cam with friction: N (cos(alpha) - mu sin(alpha) s) = m (g + y''), where the rim goes by below it
 * to the side s, and sin(alpha) is as of a cam without; the drive does the rest of the work. */
static void a_follower_that_rubs_is_pressed_aside(void **unused)
{
    const double r0 = 0.04, h = 0.02, m = 0.5, W = 20, mu = 0.1;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "parameters: {r0: 40 mm, h: 20 mm, W: 20 rad/s}\n"
                    "bodies:\n"
                    "  cam: {mass: 2, inertia: 0.002, motion: {pivot: {theta: W*t}}}\n"
                    "  follower: {mass: 0.5, motion: {slide: {along: 90 deg}}, initial: {x: r0 + h/2, "
                    "assemble: true}, forces: [gravity]}\n"
                    "couplings:\n"
                    "  - slot: {name: face, between: [follower, cam], side: right, kinetic: 0.1, x: \"(r0 + "
                    "h*(1 - cos(p))/2)*cos(p)\",\n"
                    "           y: \"(r0 + h*(1 - cos(p))/2)*sin(p)\", from: 0, to: 360 deg, closed: true}\n"
                    "simulate: {until: 1}\n");
    (void)unused;
    trial_start(&trial, NULL);
    for (int i = 0; i < 6; i++) {
        double t = 0.05 + 0.18 * i;
        trial_to(&trial, t);
        double s = sin(W * t), lift = r0 + h * (1 - s) / 2, slope = -h * cos(W * t) / 2,
               along = hypot(lift, slope);
        /* The rim below goes to the left as the cam turns to the left, and takes the follower along. */
        double N = m * (g + h * W * W * s / 2) / ((lift - mu * slope) / along);
        fbd_arrow normal = arrow_on(&trial, 1, "face.normal"),
                  friction = arrow_on(&trial, 1, "face.friction");
        check_close(&checks, "lift", trial_get(&trial, "follower.x"), lift, 1e-11);
        check_close(&checks, "N", hypot(normal.fx, normal.fy), N, 1e-8);
        check_close(&checks, "friction", hypot(friction.fx, friction.fy), mu * N, 1e-9);
        check_that(&checks, "to the left", friction.fx < 0);
        check_close(&checks, "up", normal.fy + friction.fy, m * (g + h * W * W * s / 2), 1e-9);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- at rest: it holds within the angle of friction, atan(mu), and says how near that is */

static void a_slot_holds_at_rest(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int steep = 0; steep < 2; steep++) {
        struct trial trial =
            trial_parse(steep ? "fbd: 1\nground: {points: {A: [0, 0]}}\n"
                                "bodies: {bead: {mass: 2, motion: particle, forces: [gravity]}}\n"
                                "couplings: [slot: {name: groove, between: [bead, ground.A], along: 30 deg, "
                                "static: 0.57}]\n"
                              : "fbd: 1\nground: {points: {A: [0, 0]}}\n"
                                "bodies: {bead: {mass: 2, motion: particle, forces: [gravity]}}\n"
                                "couplings: [slot: {name: groove, between: [bead, ground.A], along: 30 deg, "
                                "static: 0.58}]\n");
        fbd_state *state = fbd_state_new(trial.model);
        fbd_statics *statics = fbd_statics_new(state, NULL);
        fbd_limit limit = fbd_statics_limit(statics, 0);
        check_that(&checks, "holds", fbd_statics_holds(statics) == !steep); /* tan(30 deg) = 0.577 */
        check_that(&checks, "name", strcmp(limit.name, "groove.friction") == 0);
        check_close(&checks, "limit", limit.limit, (steep ? 0.57 : 0.58) * 2 * g * cos(pi / 6), 1e-9);
        if (!steep) check_close(&checks, "needed", limit.needed, g, 1e-9);
        fbd_statics_free(statics);
        fbd_state_free(state);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A bead in a slot bounces off a wall across it, which does not press it in the slot. */
static void a_bead_is_struck_in_its_slot(void **unused)
{
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "ground: {points: {A: [0, 0]}, lines: {wall: {through: [1, 0], along: 90 deg}}}\n"
        "bodies: {bead: {mass: 2, shape: sphere, radius: 0.1, motion: planar, initial: {vx: 2.25}}}\n"
        "couplings: [slot: {name: groove, between: [bead, ground.A], along: 0, kinetic: 0.1}]\n"
        "contacts: [{between: [bead, ground.wall], restitution: 0.5}]\n"
        "simulate: {until: 0.6}\n");
    (void)unused;
    trial_run(&trial, NULL);
    check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
    check_close(&checks, "when", trial_event(&trial, FBD_EVENT_IMPACT, NULL, 0), 0.9 / 2.25, 1e-9);
    check_close(&checks, "vx", trial_get(&trial, "vx"), -1.125, 1e-9);
    trial_close(&trial);
    checks_end(&checks);
}

/* A bead slips with u along a slot that is drawn across by v = 1 m/s on a slide, which comes to its stop: the bead's own
 * m v presses on the slot, whose friction takes mu m v from m u. */
static void a_slot_that_stops_rubs(void **unused)
{
    static const double u[] = {2, 0.2}, left[] = {2 - 0.3, 0};
    const char *const text =
        "fbd: 1\n"
        "gravity: 0\n"
        "bodies:\n"
        "  yoke: {mass: 1, motion: {slide: {max: 0.5}}, initial: {v: 1}}\n"
        "  bead: {mass: 2, motion: particle, initial: {vx: 1, vy: %g}}\n"
        "couplings: [slot: {name: groove, between: [bead, yoke], along: 90 deg, kinetic: 0.3}]\n"
        "simulate: {until: 0.7}\n";
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 2; i++) {
        char model[600];
        snprintf(model, sizeof model, text, u[i]);
        struct trial trial = trial_parse(model);
        trial_run(&trial, NULL);
        check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
        check_close(&checks, "vx", trial_get(&trial, "bead.vx"), 0, 1e-9);
        check_close(&checks, "vy", trial_get(&trial, "bead.vy"), left[i], 1e-9);
        check_close(&checks, "y", trial_get(&trial, "bead.y"), 0.5 * u[i] + 0.2 * left[i], 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A follower that rubs lands on its cam at rest with 1 m/s down and u along: friction takes mu m * 1 m/s. */
static void a_follower_that_rubs_lands(void **unused)
{
    static const double u[] = {2, 0.2}, left[] = {2 - 0.3, 0};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 2; i++) {
        char model[600];
        snprintf(model, sizeof model,
                 "fbd: 1\ngravity: 10\nground: {points: {P: [0, 0]}}\nbodies:\n"
                 "  follower: {mass: 2, motion: particle, initial: {vx: %g, vy: 1}, forces: [gravity]}\n"
                 "couplings: [slot: {between: [follower, ground.P], side: left, kinetic: 0.3}]\n"
                 "simulate: {until: 1}\n",
                 u[i]);
        struct trial trial = trial_parse(model);
        trial_start(&trial, NULL);
        check_close(&checks, "t", trial_to_event(&trial, FBD_EVENT_LANDING, NULL, 0), 0.2, 1e-9);
        check_close(&checks, "x", trial_get(&trial, "x"), 0.2 * u[i], 1e-9);
        check_close(&checks, "vx", trial_get(&trial, "vx"), left[i], 1e-9);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A bead slips along a slot of the ground and comes to its end: v t - mu g t^2 / 2 = l. */
static void a_slot_that_rubs_has_an_end(void **unused)
{
    const double v = 2.25, mu = 0.1, l = 0.4;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "ground: {points: {A: [0, 0]}}\n"
        "bodies: {bead: {mass: 2, motion: particle, initial: {vx: 2.25}, forces: [gravity]}}\n"
        "couplings: [slot: {name: groove, between: [bead, ground.A], from: -0.2, to: 0.4, kinetic: 0.1}]\n"
        "simulate: {until: 2}\n");
    (void)unused;
    trial_start(&trial, NULL);
    check_close(&checks, "when", to_its_end(&trial), (v - sqrt(v * v - 2 * mu * g * l)) / (mu * g), 1e-9);
    check_that(&checks, "broken", trial.outcome == FBD_BROKEN);
    check_that(&checks, "why",
               strstr(fbd_simulation_reason(trial.simulation), "the end of the slot") != NULL);
    trial_close(&trial);
    checks_end(&checks);
}

/* A rod at rest in two slots that rub breaks away in both at once, where no forces within their limits hold it any more
 * (it had no acceleration yet, and "events chatter"). What its angular acceleration is from there on says Newton's law with
 * both slipping: -1.669 to -1.902 rad/s^2 at the end, nearly straight. */
static void a_rod_breaks_away_in_two_slots(void **unused)
{
    const double from = 0.524786377, until = 0.53;
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\n"
        "gravity: 10\n"
        "ground: {points: {P0: [-0.14679752593829024, 0.12552851707015228], P1: [0.45234878022495995, "
        "0.13774850762784652]}}\n"
        "bodies:\n"
        "  rod:\n"
        "    {shape: rod, mass: 0.55531736561937939, length: 0.57262788837777689, motion: planar, initial: "
        "{theta: "
        "0.72168863331705513, assemble: true},\n"
        "    forces: [gravity, applied: {value: [\"3.8487443921435349*sin(3.0386890147972268*t + "
        "5.417070764052367) + 0.92990774049247893\", 0.10587648094964441]}], moments: [applied: "
        "0.72244076648941857]}\n"
        "couplings:\n"
        "  - slot: {name: s0, between: [rod.left, ground.P0], along: 1.3575655884945794, static: "
        "0.16230758007436302}\n"
        "  - slot: {name: s1, between: [rod.right, ground.P1], along: 2.928361915289476, static: "
        "0.24624173771625349}\n"
        "simulate: {until: 0.53}\n");
    (void)unused;
    trial_run(&trial, NULL);
    check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
    check_close(&checks, "when", trial_event(&trial, FBD_EVENT_BREAKAWAY, "s1.friction", 0), from, 1e-8);
    check_close(&checks, "omega", trial_get(&trial, "omega"), -(1.669 + 1.902) / 2 * (until - from), 2e-5);
    trial_close(&trial);
    checks_end(&checks);
}

/* A wedge that F pushes drives a plunger, which comes to its stop. With u the speed of the wedge, u tan(alpha) that of the
 * plunger, and N what the slot in the wedge, at the slope alpha, presses,
 *
 *     m_1 tan(alpha) u' = N (cos(alpha) - mu sin(alpha)),     m_0 u' = F - N (sin(alpha) + mu cos(alpha));
 *
 * the impulses of the slot and of the stop follow as well, with P of the stop,
 *
 *     N (sin(alpha) + mu cos(alpha)) = m_0 u,     P = m_1 tan(alpha) u + N (cos(alpha) - mu sin(alpha)).
 *
 * Of slopes of 1:300 the plunger does a hundred-thousandth of what the wedge does. A heavy plunger may be stopped by the slot
 * alone, which locks: there are two ways to go on then, and none is asked for. */
struct wedge {
    double alpha, slope, mu, m[2], u, F, way, turn;
};

static struct wedge draw_wedge(struct random_numbers *numbers)
{
    struct wedge wedge = {.slope = exp(random_between(numbers, -5.7, -0.5)),
                          .mu = random_between(numbers, 0, 0.6),
                          .m = {random_between(numbers, 0.2, 5), random_between(numbers, 0.2, 5)},
                          .u = random_between(numbers, 0.1, 2),
                          .F = random_between(numbers, 0.1, 20),
                          .way = random_between(numbers, 0.1, 2),
                          .turn = random_between(numbers, -3, 3)};
    wedge.alpha = atan(wedge.slope);
    return wedge;
}

static bool may_lock(const struct wedge *w)
{
    double across = w->m[0] * sin(w->alpha) - w->m[1] * w->slope * cos(w->alpha),
           along = w->m[0] * cos(w->alpha) + w->m[1] * w->slope * sin(w->alpha);
    return across < 0 && along <= 1.1 * w->mu * -across;
}

static double told_impulse(const struct trial *trial)
{
    double told = 0;
    for (size_t i = 0; i < fbd_simulation_event_count(trial->simulation); i++) {
        fbd_event event = fbd_simulation_event(trial->simulation, i);
        const char *impulses = strstr(event.detail, "impulses ");
        if (event.kind == FBD_EVENT_IMPACT && impulses) told += strtod(impulses + strlen("impulses "), NULL);
    }
    return told;
}

static void compare_wedge(struct checks *checks, const struct wedge *w)
{
    double c = cos(w->alpha), s = sin(w->alpha), back = s + w->mu * c, up = c - w->mu * s;
    double a = w->F / (w->m[0] + w->m[1] * w->slope * back / up), u = sqrt(w->u * w->u + 2 * a * w->way);
    double P = w->m[1] * w->slope * u + w->m[0] * u / back * up, strikes = (u - w->u) / a;
    char text[900];
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: 0\nbodies:\n"
             "  wedge: {mass: %.17g, motion: {slide: {along: %.17g}}, initial: {v: %.17g}, forces: [applied: "
             "%.17g]}\n"
             "  plunger: {mass: %.17g, motion: {slide: {along: %.17g, max: %.17g}}, initial: {v: %.17g}}\n"
             "couplings: [slot: {name: groove, between: [plunger, wedge], along: %.17g, static: %.17g}]\n"
             "simulate: {until: %.17g}\n",
             w->m[0], w->turn, -w->u, -w->F, w->m[1], w->turn + pi / 2, w->way * w->slope, w->u * w->slope,
             w->alpha, w->mu, strikes + 0.1);
    struct trial trial = trial_parse(text);
    trial_run(&trial, NULL);
    if (!check_that(checks, "it comes to its end", trial.outcome == FBD_DONE)) puts(text);
    check_close(checks, "when", trial_event(&trial, FBD_EVENT_IMPACT, NULL, 0), strikes, 1e-8 * strikes);
    check_close(checks, "impulse", told_impulse(&trial) / P, 1, 1e-5);
    check_close(checks, "the wedge stops", trial_get(&trial, "wedge.v") / u, 0, 1e-8);
    trial_close(&trial);
}

/* A slide that goes 64 times as fast as the one that it drives, which comes to its stop: what the slot is known to by then
 * leaves the impulses of stop and friction contradicting each other by 1e-10, and "have no solution" ended the run. */
static void a_fast_slide_is_stopped_by_a_slow_one(void **unused)
{
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\ngravity: 10\nbodies:\n"
        "  b0:\n    mass: 1.5613986704393077\n"
        "    motion: {slide: {along: -0.61731612838954852, through: [0, 0]}}\n"
        "    initial: {x: -0.16123283410646227, v: 1.4808842507907007}\n"
        "    forces: [gravity, normal: {two_sided: true}, applied: {value: [0, -3.3817451905399127]}]\n"
        "  b1:\n    mass: 0.41485348925280269\n"
        "    motion: {slide: {along: 0.90051032789332819, through: [0.15253855520386245, "
        "-0.17879593522781367], "
        "min: -0.044553394318205347, max: 0.080015223805315894, restitution: 0}}\n"
        "    initial: {x: 0.051500460540230109, v: 0.022959322501468055, assemble: true}\n"
        "    forces: [gravity, normal: {two_sided: true}, applied: {value: "
        "[\"2.31380251410727*sin(2.2755090750231504*t + 2.7867450437475298)\", "
        "\"8.0576275192816134*sin(10.536254500275298*t + 2.1011027496334158)\"]}]\n"
        "couplings: [slot: {name: groove, between: [b0, b1], along: 1.6082726707832564, static: "
        "0.30389292947391078}]\n"
        "simulate: {until: 0.7}\n");
    (void)unused;
    trial_run(&trial, NULL);
    check_that(&checks, "it comes to its end", trial.outcome == FBD_DONE);
    check_close(&checks, "b0.v", trial_get(&trial, "b0.v"), 0, 1e-9);
    check_close(&checks, "b1.x", trial_get(&trial, "b1.x"), 0.080015223805315894, 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

static void a_wedge_is_stopped_by_its_plunger(void **unused)
{
    struct random_numbers numbers = {20261126};
    struct checks checks = {0};
    const int draws = number_of("FBD_WEDGES", 60);
    (void)unused;
    for (int draw = 0; draw < draws; draw++) {
        struct wedge wedge = draw_wedge(&numbers);
        if (!may_lock(&wedge)) compare_wedge(&checks, &wedge);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scotch_yoke_loses_what_its_pin_rubs),
        cmocka_unit_test(a_bead_sticks_until_its_slot_is_steep),
        cmocka_unit_test(a_follower_that_rubs_is_pressed_aside),
        cmocka_unit_test(a_slot_holds_at_rest),
        cmocka_unit_test(a_bead_is_struck_in_its_slot),
        cmocka_unit_test(a_slot_that_stops_rubs),
        cmocka_unit_test(a_follower_that_rubs_lands),
        cmocka_unit_test(a_slot_that_rubs_has_an_end),
        cmocka_unit_test(a_rod_breaks_away_in_two_slots),
        cmocka_unit_test(a_wedge_is_stopped_by_its_plunger),
        cmocka_unit_test(a_fast_slide_is_stopped_by_a_slow_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
