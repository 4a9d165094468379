/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tracks: the models of models/tracks against closed forms, random curves with random forces against equations of
 * motion in the parameter of the curve, integrated apart in long double.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81, pi = 3.14159265358979323846;

static void run(struct trial *trial)
{
    trial_start(trial, NULL);
    trial_finish(trial);
}

/* ---- closed forms */

/* Every passage of the bottom, whatever the amplitude, is half a period of 4 pi sqrt(R/g) behind the last one. */
static void a_cycloid_is_isochronous(void **unused)
{
    const char *const starts[] = {"p0=170 deg", "p0=90 deg", "p0=10 deg", "p0=0.1 deg"};
    const double quarter = pi * sqrt(0.5 / g);
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        struct trial trial = trial_open("tracks/bead_on_cycloid.yaml", SET(starts[i]));
        run(&trial);
        for (int k = 0; k < 5; k++)
            check_close(&checks, starts[i], trial_event(&trial, FBD_EVENT_USER, "bottom", k),
                        (2 * k + 1) * quarter, 1e-10);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* It leaves where cos(phi) = -2 (h - R) / (3 R); from h = 5 R / 2 on it stays, and from R on it leaves at all. */
static void a_car_leaves_its_loop(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 5; i++) {
        double h = 1.2 + 0.3 * i;
        char setting[32];
        snprintf(setting, sizeof setting, "h=%.1f m", h);
        struct trial trial = trial_open("tracks/loop_the_loop.yaml", SET(setting));
        run(&trial);
        check_that(&checks, "broken", trial.outcome == FBD_BROKEN);
        check_that(&checks, "lost", trial_event(&trial, FBD_EVENT_CONTACT_LOST, NULL, 0) > 0);
        check_close(&checks, setting, trial_get(&trial, "car.s"), acos(-2 * (h - 1) / 3), 1e-10);
        trial_close(&trial);
    }
    const char *const stays[] = {"h=2.6 m", "h=0.9 m"};
    for (int i = 0; i < 2; i++) {
        struct trial trial = trial_open("tracks/loop_the_loop.yaml", SET(stays[i]));
        run(&trial);
        check_that(&checks, stays[i], trial.outcome == FBD_DONE);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* The energy says the speed at the bottom of the parabola, and both the force there: N = m (g + 2 a v^2). */
static void a_bead_passes_the_bottom_of_a_parabola(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_open("tracks/bead_on_parabola.yaml", NULL);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    double bottom = trial_event(&trial, FBD_EVENT_USER, "bottom", 0);
    trial_start(&trial, NULL);
    trial_to(&trial, bottom);
    check_close(&checks, "v", trial_get(&trial, "bead.v"), -sqrt(g), 1e-10);
    check_close(&checks, "N", trial_normal(&trial, "bead.s"), 0.1 * (g + g), 1e-10);
    trial_close(&trial);
    /* s of x = 1 m: (x w + asinh(2 a x) / (2 a)) / 2 */
    trial = trial_open("tracks/bead_on_parabola.yaml", NULL);
    check_close(&checks, "s", trial_get(&trial, "bead.s"), (sqrt(2.0) + asinh(1)) / 2, 1e-14);
    trial_close(&trial);
    checks_end(&checks);
}

/* One period of a pendulum of the length g / W^2 under gravity g: T = 4 K(sin(phi/2)) / W. */
static void a_turned_hoop_is_a_pendulum(void **unused)
{
    const double W = 4, phi = pi / 3;
    struct checks checks = {0};
    (void)unused;
    double a = 1, b = cos(phi / 2); /* the elliptic integral by means */
    for (int i = 0; i < 8; i++) {
        double mean = (a + b) / 2;
        b = sqrt(a * b);
        a = mean;
    }
    struct trial trial = trial_open("tracks/bead_on_turning_hoop.yaml", NULL);
    trial_start(&trial, NULL);
    trial_to(&trial, 2 * pi / (a * W));
    check_close(&checks, "s", trial_get(&trial, "bead.s"), 0.3 * phi, 1e-9);
    check_close(&checks, "v", trial_get(&trial, "bead.v"), 0, 1e-8);
    trial_close(&trial);
    checks_end(&checks);
}

/* On friction it stays where tan(slope) < mu, exactly still. */
static void a_bead_sticks(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial trial = trial_parse("fbd: 1\n"
                                     "bodies:\n"
                                     "  bead:\n"
                                     "    mass: 1 kg\n"
                                     "    motion: {track: {y: \"0.5[1/m]*x^2\", from: -2 m, to: 2 m}}\n"
                                     "    initial: {x: 1.5 m}\n"
                                     "    forces: [gravity, normal: {two_sided: true}, friction: 0.3]\n"
                                     "simulate: {until: 20 s}\n");
    run(&trial);
    double x = trial_get(&trial, "bead.s");
    check_that(&checks, "sticks", trial_event(&trial, FBD_EVENT_STICK, NULL, 0) > 0);
    check_close(&checks, "still", trial_get(&trial, "bead.v"), 0, 0);
    check_that(&checks, "within the cone", fabs(x) < 0.3 * sqrt(1 + 0.09));
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- random curves
 *
 * x = a1 p + a2 sin(w1 p), y = b1 cos(w2 p) + b2 p^2. With G(p) the centre of mass of a rod whose x axis is the tangent
 * and phi(p) its angle, all by the parameter p and differences:
 *
 *     M(p) = m |G'|^2 + I phi'^2,   M p'' = -M' p'^2 / 2 + (F . G') - mu |N| |r'| sign
 *
 * Friction is there for points alone: N = m n . (r'' p'^2) - F . n.
 */
struct curve {
    double a1, a2, w1, b1, b2, w2;
    double mass, length, along, across; /* of the rod, and where its middle is from the track */
    double mu, stiffness, push;
    double p, speed;
};

struct place {
    long double x, y;
};

static struct place point_of(const struct curve *c, long double p)
{
    return (struct place){c->a1 * p + c->a2 * sinl(c->w1 * p), c->b1 * cosl(c->w2 * p) + c->b2 * p * p};
}

static struct place slope_of(const struct curve *c, long double p)
{
    return (struct place){c->a1 + c->a2 * c->w1 * cosl(c->w1 * p),
                          -c->b1 * c->w2 * sinl(c->w2 * p) + 2 * c->b2 * p};
}

static struct place bend_of(const struct curve *c, long double p)
{
    return (struct place){-c->a2 * c->w1 * c->w1 * sinl(c->w1 * p),
                          -c->b1 * c->w2 * c->w2 * cosl(c->w2 * p) + 2 * c->b2};
}

static struct place center_of(const struct curve *c, long double p)
{
    struct place r = point_of(c, p), d = slope_of(c, p);
    long double w = hypotl(d.x, d.y), ex = d.x / w, ey = d.y / w;
    return (struct place){r.x + c->along * ex - c->across * ey, r.y + c->along * ey + c->across * ex};
}

static const long double step = 1e-5L;

static struct place center_slope(const struct curve *c, long double p)
{
    struct place a = center_of(c, p - 2 * step), b = center_of(c, p - step), d = center_of(c, p + step),
                 e = center_of(c, p + 2 * step);
    return (struct place){(a.x - 8 * b.x + 8 * d.x - e.x) / (12 * step),
                          (a.y - 8 * b.y + 8 * d.y - e.y) / (12 * step)};
}

static long double mass_at(const struct curve *c, long double p)
{
    struct place G = center_slope(c, p), d = slope_of(c, p), dd = bend_of(c, p);
    long double turn = (d.x * dd.y - d.y * dd.x) / (d.x * d.x + d.y * d.y);
    return c->mass * (G.x * G.x + G.y * G.y + c->length * c->length / 12 * turn * turn);
}

/* Gravity, a spring of no free length to (0, 1) at G, and a push along the tangent at the track. */
static long double acceleration(const struct curve *c, long double p, long double v)
{
    struct place G = center_of(c, p), dG = center_slope(c, p), d = slope_of(c, p), dd = bend_of(c, p);
    long double w = hypotl(d.x, d.y), fx = -c->stiffness * G.x, fy = -c->stiffness * (G.y - 1) - c->mass * g;
    long double Q = fx * dG.x + fy * dG.y + c->push * w;
    if (c->mu > 0) {
        long double nx = -d.y / w, ny = d.x / w;
        long double N = c->mass * (nx * dd.x + ny * dd.y) * v * v - fx * nx - fy * ny;
        Q -= c->mu * fabsl(N) * w * (v > 0 ? 1 : -1);
    }
    long double rate = (mass_at(c, p - 2 * step) - 8 * mass_at(c, p - step) + 8 * mass_at(c, p + step) -
                        mass_at(c, p + 2 * step)) /
                       (12 * step);
    return (Q - rate * v * v / 2) / mass_at(c, p);
}

static struct place follow(const struct curve *c, long double until)
{
    enum { steps = 1000 };
    long double h = until / steps, p = c->p;
    struct place d = slope_of(c, p);
    long double v = c->speed / hypotl(d.x, d.y);
    for (int i = 0; i < steps; i++) {
        long double a1 = acceleration(c, p, v), v2 = v + h / 2 * a1, a2 = acceleration(c, p + h / 2 * v, v2);
        long double v3 = v + h / 2 * a2, a3 = acceleration(c, p + h / 2 * v2, v3), v4 = v + h * a3;
        long double a4 = acceleration(c, p + h * v3, v4);
        p += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return point_of(c, p);
}

static struct curve draw(struct random_numbers *numbers, bool point)
{
    struct curve c = {.a1 = random_between(numbers, 0.5, 1.5),
                      .a2 = random_between(numbers, -0.3, 0.3),
                      .w1 = random_between(numbers, 0.5, 1.2),
                      .b1 = random_between(numbers, -0.5, 0.5),
                      .b2 = random_between(numbers, -0.4, 0.4),
                      .w2 = random_between(numbers, 0.5, 2),
                      .mass = random_between(numbers, 0.5, 2),
                      .stiffness = random_between(numbers, 0, 20),
                      .push = random_between(numbers, -2, 2),
                      .p = random_between(numbers, -0.5, 0.5),
                      .speed = random_between(numbers, 4, 5)};
    if (point) {
        c.mu = random_between(numbers, 0.05, 0.2);
    } else {
        c.length = random_between(numbers, 0.2, 0.8);
        c.along = random_between(numbers, -0.1, 0.1);
        c.across = random_between(numbers, -0.1, 0.1);
    }
    return c;
}

static void check_curve(struct checks *checks, const struct curve *c, int i)
{
    enum { room = 2000 };
    char text[room];
    const double until =
        0.15; /* nothing turns back by then: the steps of `follow` go over no change of sign */
    snprintf(text, sizeof text,
             "fbd: 1\n"
             "bodies:\n"
             "  bead:\n"
             "    mass: %.17g\n"
             "    shape: %s\n"
             "%s%.17g\n"
             "    points: {Q: [%.17g, %.17g]}\n"
             "    motion: {track: {x: \"%.17g*p + (%.17g)*sin(%.17g*p)\", y: \"(%.17g)*cos(%.17g*p) + "
             "(%.17g)*p^2\",\n"
             "             from: -6, to: 6, point: Q}}\n"
             "    initial: {p: %.17g, v: %.17g}\n"
             "    forces: [gravity, normal: {two_sided: true}, friction: %.17g, spring: {stiffness: %.17g, "
             "to: [0, 1]},\n"
             "             applied: {value: %.17g, at: Q}]\n"
             "simulate: {until: %g, tolerance: 1e-12}\n",
             c->mass, c->length > 0 ? "rod" : "point", c->length > 0 ? "    length: " : "    # ", c->length,
             -c->along, -c->across, c->a1, c->a2, c->w1, c->b1, c->w2, c->b2, c->p, c->speed, c->mu,
             c->stiffness, c->push, until);
    struct trial trial = trial_parse(text);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    struct place want = follow(c, until);
    fbd_arrow normal = trial_arrow(&trial, "normal"); /* it acts at the point on the track */
    char what[40];
    snprintf(what, sizeof what, "curve %d, x", i);
    check_close(checks, what, normal.x, (double)want.x, 1e-8);
    snprintf(what, sizeof what, "curve %d, y", i);
    check_close(checks, what, normal.y, (double)want.y, 1e-8);
    trial_close(&trial);
}

static void random_curves_agree(void **unused)
{
    struct checks checks = {0};
    struct random_numbers numbers = {17};
    (void)unused;
    for (int i = 0; i < 12; i++) {
        struct curve c = draw(&numbers, i % 2 == 0);
        check_curve(&checks, &c, i);
    }
    checks_end(&checks);
}

/* ---- without gravity: N = m |kappa| v^2, so dv/ds = -mu |kappa| v, and v falls by exp(-mu (all that it turns)) */

/* By how much y = A sin(k x + phase) turns from x to `end`, to the left and to the right. */
static double turning(double A, double k, double phase, double x, double end)
{
    double sum = 0;
    for (int j = (int)floor((k * x + phase) / pi) + 1; x < end; j++) { /* to the next inflection */
        double next = fmin(end, (j * pi - phase) / k);
        sum += fabs(atan(A * k * cos(k * next + phase)) - atan(A * k * cos(k * x + phase)));
        x = next;
    }
    return sum;
}

/* Where nothing presses, what is left of forces is the rounding of a curvature. */
static void a_bead_rubs_over_inflections(void **unused)
{
    struct checks checks = {0};
    struct random_numbers numbers = {19112512};
    (void)unused;
    for (int i = 0; i < 60; i++) {
        char text[800];
        double A = random_between(&numbers, 0.1, 0.6), k = random_between(&numbers, 0.5, 3),
               phase = random_between(&numbers, -3, 3), mu = random_between(&numbers, 0.05, 0.8),
               v = random_between(&numbers, 0.5, 3), x = random_between(&numbers, -2, 0);
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: 0\nstates: {clock: {rate: 1, unit: s}}\nbodies:\n"
                 "  bead: {mass: 1, motion: {track: {y: \"%.17g*sin(%.17g[1/m]*x + (%.17g))\", from: -5, to: "
                 "9}},\n    initial: {x: %.17g, v: %.17g}, forces: [normal: {two_sided: true}, friction: "
                 "%.17g]}\nsimulate: {until: 2}\n",
                 A, k, phase, x, v, mu);
        struct trial trial = trial_parse(text);
        run(&trial);
        check_that(&checks, "done", trial.outcome == FBD_DONE);
        double end = trial_arrow(&trial, "normal").x;
        check_close(&checks, "v", trial_get(&trial, "bead.v"), v * exp(-mu * turning(A, k, phase, x, end)),
                    1e-8 * v);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- bends that are short against the range of the parameter */

/* y = A / (1 + u^8), or A / (1 + u^2)^4, with u = (x - c) / w. */
struct bump {
    bool flat;
    double A, w, c, range;
};

static double speed_over(const struct bump *bump, double u)
{
    double base = bump->flat ? 1 + pow(u, 8) : 1 + u * u;
    double slope = bump->flat ? -8 * pow(u, 7) / (base * base) : -8 * u / pow(base, 5);
    return hypot(1, bump->A / bump->w * slope);
}

/* The length from u = -3 to 3, by Simpson's rule. */
static double length_over(const struct bump *bump)
{
    enum { pieces = 20000 };
    const double h = 6.0 / pieces;
    double sum = speed_over(bump, -3) + speed_over(bump, 3);
    for (int i = 1; i < pieces; i++) sum += (i % 2 ? 4 : 2) * speed_over(bump, -3 + i * h);
    return bump->w * sum * h / 3;
}

/* A bead at 1 m/s says how long the way is. */
static void short_bends_are_seen(void **unused)
{
    struct random_numbers numbers = {20261125};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 40; i++) {
        struct bump bump = {.flat = random_bits(&numbers) % 2 == 0,
                            .A = random_between(&numbers, 0.2, 2),
                            .w = random_between(&numbers, 0.3, 2),
                            .range = pow(10, random_between(&numbers, 1.5, 7.5))};
        bump.c = random_bits(&numbers) % 2 == 0 ? 0 : bump.range * random_between(&numbers, 0, 0.5);
        char text[1000], formula[200];
        snprintf(formula, sizeof formula,
                 bump.flat ? "%.17g[m]/(1 + ((x - %.17g[m])/%.17g[m])^8)"
                           : "%.17g[m]*(1 + ((x - %.17g[m])/%.17g[m])^2)^-4",
                 bump.A, bump.c, bump.w);
        snprintf(text, sizeof text,
                 "fbd: 1\ngravity: 0\nbodies:\n  bead:\n    mass: 1\n"
                 "    motion: {track: {y: \"%s\", from: -%.17g m, to: %.17g m}}\n"
                 "    initial: {s: %.17g, v: 1}\n    forces: [{normal: {two_sided: true}}]\n"
                 "simulate:\n  until: %.17g\n  events:\n    - {name: in, when: \"bead.x = %.17g[m]\"}\n"
                 "    - {name: out, when: \"bead.x = %.17g[m]\"}\n",
                 formula, bump.range, bump.range, bump.c - 8 * bump.w, 20 * bump.w, bump.c - 3 * bump.w,
                 bump.c + 3 * bump.w);
        struct trial trial = trial_parse(text);
        run(&trial);
        double way =
            trial_event(&trial, FBD_EVENT_USER, "out", 0) - trial_event(&trial, FBD_EVENT_USER, "in", 0);
        check_close(&checks, formula, way, length_over(&bump), 1e-8 + 1e-15 * bump.c);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* Where a curve switches everywhere, enclosures of its slope stay wide in each of 20,000 pieces: it is refused after seconds,
 * not looked at for hours. */
static void a_curve_that_switches_everywhere_is_refused(void **unused)
{
    static const char text[] =
        "fbd: 1\nbodies:\n  cam: {mass: 1, motion: pivot}\n  follower: {mass: 1, motion: particle}\n"
        "couplings:\n  - slot: {between: [follower, cam], x: \"(0.1 + (1e15 - round(p))/(-4))*sawtooth(p)\", "
        "y: \"(0.1 + (0 - cos(p))/2)*sin(p)\", from: -3, to: 1e100 deg, closed: true}\nsimulate: {until: "
        "1}\n";
    (void)unused;
    if (!thorough()) return;
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_model_parse(text, sizeof text - 1, "a curve", NULL, 0, errors));
    bool refused = false;
    for (size_t i = 0; i < fbd_errors_count(errors); i++)
        refused |= strcmp(fbd_errors_get(errors, i).id, "bad-track") == 0;
    assert_true(refused);
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cycloid_is_isochronous),
        cmocka_unit_test(a_car_leaves_its_loop),
        cmocka_unit_test(a_bead_passes_the_bottom_of_a_parabola),
        cmocka_unit_test(a_turned_hoop_is_a_pendulum),
        cmocka_unit_test(a_bead_sticks),
        cmocka_unit_test(random_curves_agree),
        cmocka_unit_test(a_bead_rubs_over_inflections),
        cmocka_unit_test(short_bends_are_seen),
        cmocka_unit_test(a_curve_that_switches_everywhere_is_refused),
    };
    return cmocka_run_group_tests_name("tracks", tests, NULL, NULL);
}
