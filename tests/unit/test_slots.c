/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Slots: a point on a line or curve of another body, against closed forms, and against the same motion on a track,
 * which has one coordinate and no constraint.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/vec.h"
#include "joined_checks.h"
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81, pi = 3.141592653589793;

/* ---- closed forms */

/* Without a moment omega^2 (I_O + m R^2 sin^2 theta) is constant, x = R cos theta, and the slot has m x''. */
static void a_scotch_yoke_keeps_its_energy(void **unused)
{
    const char *const methods[] = {"auto", "rodas5p"};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 2; i++) {
        const double R = 0.1, m = 2, I = 0.02, omega0 = 10;
        struct trial trial = trial_open("couplings/scotch_yoke.yaml", NULL);
        fbd_options options = FBD_OPTIONS_DEFAULT;
        options.method = methods[i];
        trial_start(&trial, &options);
        for (double t = 0.1; t < 2; t += 0.3) {
            trial_to(&trial, t);
            double theta = trial_get(&trial, "crank.theta"), omega = trial_get(&trial, "crank.omega");
            double s = sin(theta), c = cos(theta), M = I + m * R * R * s * s;
            double alpha = -m * R * R * omega * omega * s * c / M;
            check_close(&checks, "energy", omega * omega * M, omega0 * omega0 * I, 1e-8);
            check_close(&checks, "yoke", trial_get(&trial, "yoke.x"), R * c, 1e-13);
            check_close(&checks, "force", arrow_on(&trial, 1, "groove").fx,
                        -m * R * (alpha * s + omega * omega * c), 1e-8);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* The centre of the roller goes y = r0 + h (1 - sin(W t)) / 2, pressed by m (g + y''). */
static void a_follower_follows_its_cam(void **unused)
{
    const double r0 = 0.04, h = 0.02, m = 0.5, W = 20;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/cam_and_follower.yaml", NULL);
    (void)unused;
    trial_start(&trial, NULL);
    for (double t = 0.05; t < 1; t += 0.19) {
        trial_to(&trial, t);
        double s = sin(W * t), lift = r0 + h * (1 - s) / 2, slope = -h * cos(W * t) / 2;
        double N = m * (g + h * W * W * s / 2);
        fbd_arrow face = arrow_on(&trial, 1, "face");
        check_close(&checks, "lift", trial_get(&trial, "follower.x"), lift, 1e-11);
        check_close(&checks, "press", face.fy, N, 1e-8);
        /* The normal is steeper than the radius by the angle of pressure. */
        check_close(&checks, "side", face.fx, -N * slope / lift, 1e-8);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* Faster it comes off where g + y'' = 0, falls freely, and lands where its parabola meets the law of the cam again: found
 * here by bisection. The blow takes m (v - y')^2 / 2, since the cam is driven. */
static void a_fast_cam_throws_its_follower(void **unused)
{
    const double r0 = 0.04, h = 0.02, m = 0.5, W = 40;
    struct checks checks = {0};
    struct trial trial = trial_open("couplings/cam_and_follower.yaml", SET("W=40 rad/s"));
    (void)unused;
    trial_start(&trial, NULL);
    double off = (pi + asin(2 * g / (h * W * W))) / W;
    double y = r0 + h * (1 - sin(W * off)) / 2, v = -h * W * cos(W * off) / 2, low = off + 0.06,
           high = off + 0.12;
    for (int i = 0; i < 60; i++) {
        double t = (low + high) / 2, tau = t - off;
        bool above = y + tau * (v - g * tau / 2) > r0 + h * (1 - sin(W * t)) / 2;
        *(above ? &low : &high) = t;
    }
    trial_to(&trial, 0.25);
    fbd_event lift = fbd_simulation_event(trial.simulation, 0),
              land = fbd_simulation_event(trial.simulation, 1);
    double speed = v - g * (low - off) + h * W * cos(W * low) / 2;
    char takes[64];
    snprintf(takes, sizeof takes, "takes %.4g", m * speed * speed / 2);
    check_that(&checks, "events", fbd_simulation_event_count(trial.simulation) >= 2);
    check_that(&checks, "lifts off", lift.kind == FBD_EVENT_LIFT_OFF);
    check_close(&checks, "when", lift.t, off, 1e-9);
    check_that(&checks, "lands", land.kind == FBD_EVENT_LANDING);
    check_close(&checks, "where", land.t, low, 1e-9);
    check_that(&checks, "by a blow", strstr(land.detail, takes) != NULL);
    check_close(&checks, "stays", trial_get(&trial, "follower.x"), r0 + h * (1 - sin(W * 0.25)) / 2, 1e-10);
    trial_close(&trial);
    checks_end(&checks);
}

/* A roller on an eccentric disc is a crank with the sum of the radii for a rod: y = e cos(phi) + sqrt((R + r)^2 -
 * e^2 sin^2(phi)), phi the direction of the disc's centre from the line of the follower. */
static void a_roller_keeps_its_distance(void **unused)
{
    static const char text[] =
        "fbd: 1\n"
        "bodies:\n"
        "  cam: {mass: 2, inertia: 0.01, points: {C: [0.03, 0]}, motion: {pivot: {theta: 7*t}}}\n"
        "  follower: {mass: 0.5, motion: {slide: {along: 90 deg}}, initial: {x: 0.1, assemble: true},\n"
        "             forces: [gravity, spring: {stiffness: 2000}]}\n"
        "couplings: [slot: {name: face, between: [follower, cam.C], side: right, radius: 0.02,\n"
        "                   x: \"0.08[m]*cos(p)\", y: \"0.08[m]*sin(p)\", from: 0, to: 6.283185307179586, "
        "closed: "
        "true}]\n"
        "simulate: {until: 2}\n";
    const double e = 0.03, both = 0.1;
    struct checks checks = {0};
    struct trial trial = trial_parse(text);
    (void)unused;
    trial_start(&trial, NULL);
    for (double t = 0.1; t < 2; t += 0.4) {
        trial_to(&trial, t);
        double s = e * cos(7 * t), c = e * sin(7 * t); /* across the line of the follower, and along */
        check_close(&checks, "lift", trial_get(&trial, "follower.x"), c + sqrt(both * both - s * s), 1e-11);
    }
    trial_close(&trial);
    checks_end(&checks);
}

/* x = g sin(a) t^2 / 2 down a straight slot of the ground, to its end. */
static void the_end_of_a_slot_ends_the_run(void **unused)
{
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\n"
                    "ground: {points: {A: [0, 0]}}\n"
                    "bodies: {bead: {mass: 1, motion: particle, forces: [gravity]}}\n"
                    "couplings: [slot: {name: groove, between: [bead, ground.A], along: -30 deg, to: 1}]\n"
                    "simulate: {until: 3}\n");
    (void)unused;
    trial_start(&trial, NULL);
    double end = to_its_end(&trial);
    check_that(&checks, "broken", trial.outcome == FBD_BROKEN);
    check_close(&checks, "when", end, sqrt(2 / (g / 2)), 1e-10);
    check_that(&checks, "says so",
               strstr(fbd_simulation_reason(trial.simulation), "reaches the end") != NULL);
    trial_close(&trial);
    checks_end(&checks);
}

/* Thrown over a straight slot, in the frame of which its place is s = s_0 + v t + a t^2/2, h = h_0 + w t + b t^2/2. */
struct throw
{
    double turn, from, to, s[3], h[3];
};

static double at_time(const double coefficients[3], double t)
{
    return coefficients[0] + t * (coefficients[1] + t * coefficients[2] / 2);
}

static struct throw random_throw(struct random_numbers * numbers)
{
    struct throw throw = {.turn = random_between(numbers, -1.3, 1.3),
                          .from = random_between(numbers, -2, -0.2),
                          .to = random_between(numbers, 0.2, 2)};
    throw.s[0] = random_between(numbers, -3, 3);
    throw.s[1] = random_between(numbers, -6, 6);
    throw.s[2] = -g * sin(throw.turn);
    throw.h[0] = random_between(numbers, 0.05, 3);
    throw.h[1] = random_between(numbers, -3, 3);
    throw.h[2] = -g * cos(throw.turn);
    return throw;
}

static struct trial parse_throw(const struct throw *throw, double until)
{
    char text[900];
    double c = cos(throw->turn), s = sin(throw->turn);
    snprintf(text, sizeof text,
             "fbd: 1\nground: {points: {A: [0, 0]}}\n"
             "bodies: {bead: {mass: 1, motion: particle, initial: {x: %.17g, y: %.17g, vx: %.17g, vy: "
             "%.17g}, forces: "
             "[gravity]}}\n"
             "couplings: [slot: {name: deck, between: [bead, ground.A], along: %.17g rad, from: %.17g, to: "
             "%.17g, side: "
             "left}]\nsimulate: {until: %.17g}\n",
             c * throw->s[0] - s * throw->h[0], s * throw->s[0] + c * throw->h[0],
             c * throw->s[1] - s * throw->h[1], s * throw->s[1] + c * throw->h[1], throw->turn, throw->from,
             throw->to, until);
    return trial_parse(text);
}

/* The first time after `t` at which s is at an end, coming from outside; INFINITY without. */
static double comes_within(const struct throw *throw, double t)
{
    double first = INFINITY;
    for (int end = 0; end < 2; end++) {
        double way = end ? 1 : -1, c = throw->s[0] - (end ? throw->to : throw->from), b = throw->s[1],
               a = throw->s[2] / 2, root = b * b - 4 * a * c;
        for (int k = -1; root > 0 && k <= 1; k += 2) {
            double when = (-b + k * sqrt(root)) / (2 * a);
            if (when > t && when < first && way * (b + 2 * a * when) < 0) first = when;
        }
    }
    return first;
}

/* In the air it passes the ends, and lands where the slot is. From behind it does not come back. */
static void what_flies_passes_the_end_of_its_slot(void **unused)
{
    const int throws = draws_of(60);
    const double until = 2;
    struct checks checks = {0};
    struct random_numbers numbers = {19005};
    int passed = 0, landed = 0, behind = 0;
    (void)unused;
    for (int k = 0; k < throws && !checks.failed; k++) {
        struct throw throw = random_throw(&numbers);
        struct trial trial = parse_throw(&throw, until);
        double w = throw.h[1], b = throw.h[2];
        double down = (-w - sqrt(w * w - 2 * b * throw.h[0])) / b, s = at_time(throw.s, down);
        bool lands = down < until && s > throw.from && s < throw.to;
        double back = comes_within(&throw, down);
        trial_start(&trial, NULL);
        double end = to_its_end(&trial), landing = trial_event(&trial, FBD_EVENT_LANDING, NULL, 0);
        if (lands) {
            check_close(&checks, "landing", landing, down, 1e-8);
            landed++;
        } else if (back < until) {
            check_that(&checks, "broken", trial.outcome == FBD_BROKEN);
            check_close(&checks, "when", end, back, 1e-8);
            behind++;
        } else {
            double c = cos(throw.turn), sine = sin(throw.turn), h = at_time(throw.h, until);
            s = at_time(throw.s, until);
            check_that(&checks, "done", trial.outcome == FBD_DONE);
            check_close(&checks, "x", trial_get(&trial, "bead.x"), c * s - sine * h, 1e-9);
            check_close(&checks, "y", trial_get(&trial, "bead.y"), sine * s + c * h, 1e-9);
            passed++;
        }
        trial_close(&trial);
    }
    check_that(&checks, "of each kind", !thorough() || (passed > 4 && landed > 4 && behind > 1));
    printf("# %d passed, %d landed, %d came back behind\n", passed, landed, behind);
    checks_end(&checks);
}

/* ---- against tracks */

struct wire {
    double a[3], phase[3], turn, speed, spring, start, rate, mu;
};

static struct wire random_wire(struct random_numbers *numbers)
{
    struct wire wire;
    for (int i = 0; i < 3; i++) {
        wire.a[i] = random_between(numbers, -0.12, 0.12) / (i + 1);
        wire.phase[i] = random_between(numbers, 0, 2 * pi);
    }
    wire.turn = random_between(numbers, -pi, pi);
    wire.speed = random_between(numbers, -3, 3);
    wire.spring = random_between(numbers, 0, 60);
    wire.start = random_between(numbers, 0, 2 * pi);
    wire.rate = random_between(numbers, -3, 3);
    return wire;
}

/* r(p) = R + sum a_i sin(i p + b_i), closed. */
static void write_curve(const struct wire *wire, char *text, size_t size)
{
    char r[256];
    snprintf(r, sizeof r,
             "(0.7[m] + %.17g[m]*sin(p + %.17g) + %.17g[m]*sin(2*p + %.17g) + %.17g[m]*sin(3*p + %.17g))",
             wire->a[0], wire->phase[0], wire->a[1], wire->phase[1], wire->a[2], wire->phase[2]);
    snprintf(text, size, "x: \"%s*cos(p)\", y: \"%s*sin(p)\", from: 0, to: 6.283185307179586, closed: true",
             r, r);
}

enum { curve_room = 1024, bead_room = 1500, text_room = 4096 };

/* The wire turns about the origin and swings in a spring; the bead has a spring to the ground. */
static void write_scene(const struct wire *wire, const char *bead, const char *forces, const char *rest,
                        char *text)
{
    snprintf(
        text, text_room,
        "fbd: 1\n"
        "ground: {points: {A: [1.5, 0.4]}}\n"
        "bodies:\n"
        "  wire: {mass: 1.3, inertia: {value: 0.4, about: O}, center: [0.1, 0.05], motion: pivot,\n"
        "         initial: {theta: %.17g, omega: %.17g}, forces: [gravity], moments: [spring: {stiffness: "
        "3}]}\n"
        "  bead: {mass: 0.6, %s, forces: [%sgravity, spring: {stiffness: %.17g, free_length: 0.5, to: A}]}\n"
        "%s"
        "simulate: {until: 1}\n",
        wire->turn, wire->speed, bead, forces, wire->spring, rest);
}

/* Where the scene is at t = 1: the bead, which its weight tells of, and the wire. */
static void run_to_one(const char *text, const char *method, double end[4])
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    struct trial trial = trial_parse(text);
    options.method = method;
    options.tolerance = 1e-11;
    trial_start(&trial, &options);
    trial_to(&trial, 1);
    fbd_arrow weight = arrow_on(&trial, 1, "gravity");
    end[0] = weight.x;
    end[1] = weight.y;
    end[2] = trial_get(&trial, "wire.theta");
    end[3] = trial_get(&trial, "wire.omega");
    trial_close(&trial);
}

static void on_a_track(const struct wire *wire, const char *curve, double end[4])
{
    char text[text_room], bead[bead_room], forces[80];
    snprintf(bead, sizeof bead, "motion: {track: {on: wire, %s}}, initial: {p: %.17g, v: %.17g}", curve,
             wire->start, wire->rate);
    snprintf(forces, sizeof forces, "normal: {two_sided: true}, friction: %.17g, ", wire->mu);
    write_scene(wire, bead, wire->mu > 0 ? forces : "", "", text);
    run_to_one(text, "auto", end);
}

static struct vec turned(double angle, struct vec a)
{
    return (struct vec){cos(angle) * a.x - sin(angle) * a.y, sin(angle) * a.x + cos(angle) * a.y};
}

/* The same start in the world: v = omega k x r + rate e. */
static void in_a_slot(const struct wire *wire, const char *curve, const char *method, double end[4])
{
    char text[text_room], bead[bead_room], rest[bead_room], friction[40];
    double p = wire->start, r = 0.7, slope = 0;
    for (int i = 0; i < 3; i++) {
        r += wire->a[i] * sin((i + 1) * p + wire->phase[i]);
        slope += (i + 1) * wire->a[i] * cos((i + 1) * p + wire->phase[i]);
    }
    struct vec along = {slope * cos(p) - r * sin(p), slope * sin(p) + r * cos(p)};
    struct vec x = turned(wire->turn, (struct vec){r * cos(p), r * sin(p)});
    struct vec e = turned(wire->turn, along);
    double rate = wire->rate / hypot(e.x, e.y);
    snprintf(bead, sizeof bead, "motion: particle, initial: {x: %.17g, y: %.17g, vx: %.17g, vy: %.17g}", x.x,
             x.y, rate * e.x - wire->speed * x.y, rate * e.y + wire->speed * x.x);
    snprintf(friction, sizeof friction, ", kinetic: %.17g", wire->mu);
    snprintf(rest, sizeof rest, "couplings: [slot: {name: groove, between: [bead, wire], %s%s}]\n", curve,
             wire->mu > 0 ? friction : "");
    write_scene(wire, bead, "", rest, text);
    run_to_one(text, method, end);
}

/* One coordinate and no constraint, or two and one. rodas5p needs what a Jacobian has of the slot. */
static void compare(uint64_t seed, double most_friction)
{
    const int scenes = draws_of(10);
    struct random_numbers numbers = {seed};
    struct checks checks = {0};
    for (int i = 0; i < scenes; i++) {
        struct wire wire = random_wire(&numbers);
        wire.mu = most_friction > 0 ? random_between(&numbers, 0, most_friction) : 0;
        char curve[curve_room], label[64];
        double end[4], got[4];
        write_curve(&wire, curve, sizeof curve);
        on_a_track(&wire, curve, end);
        in_a_slot(&wire, curve, i % 4 == 3 ? "rodas5p" : "auto", got);
        for (int k = 0; k < 4; k++) {
            snprintf(label, sizeof label, "scene %d of seed %d, %d", i, (int)seed, k);
            check_close(&checks, label, got[k], end[k], 1e-8 * (1 + fabs(end[k]))); /* 1 s at 1e-11 a step */
        }
    }
    checks_end(&checks);
}

static void a_slot_is_a_track(void **unused)
{
    (void)unused;
    compare(19, 0);
}

/* On both sides of the wire, slipping to and fro, and sticking. */
static void a_slot_that_rubs_is_a_track_that_rubs(void **unused)
{
    (void)unused;
    compare(20, 0.6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scotch_yoke_keeps_its_energy),
        cmocka_unit_test(a_follower_follows_its_cam),
        cmocka_unit_test(a_fast_cam_throws_its_follower),
        cmocka_unit_test(a_roller_keeps_its_distance),
        cmocka_unit_test(the_end_of_a_slot_ends_the_run),
        cmocka_unit_test(what_flies_passes_the_end_of_its_slot),
        cmocka_unit_test(a_slot_is_a_track),
        cmocka_unit_test(a_slot_that_rubs_is_a_track_that_rubs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
