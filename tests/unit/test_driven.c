/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Mechanisms that drives move altogether, with friction: it never holds them, turns where they turn, and
 * rests where they rest.
 *
 * A crank of the length R that is driven by theta(t) takes along a slider by a rod of the length L. With q =
 * R sin theta - e, the height of the crank's end over the slider's line, and p = sqrt(L^2 - q^2),
 *
 *     x = R cos theta + p,    p' = -q q'/p,    p'' = -(q'^2 + q q'' + p'^2)/p
 *
 * and with the tension S of the rod, m a = -S p/L - mu |N| sgn x' and N = m g - S q/L.
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
#include "joined_checks.h"
#include "random_numbers.h"
#include "thorough.h"

static const double g = 9.81, pi = 3.14159265358979323846;

enum law { accelerated, swinging, from_rest, cycloid, delayed, rise_and_return, rise_345, law_count };

struct crank {
    enum law law;
    double R, e, L, m, mu_s, mu_k, theta_0;
    double A, W, t_0, T; /* of the law: angle, frequency, delay, time of a rise */
    int power;
};

/* An angle and its two rates. */
struct motion {
    double at, rate, second;
};

static struct crank draw_crank(struct random_numbers *numbers)
{
    static const double dead_centres[] = {0, 1, 0.5};
    struct crank crank = {.law = (enum law)(random_bits(numbers) % law_count),
                          .R = random_between(numbers, 0.2, 1),
                          .m = random_between(numbers, 0.5, 2),
                          .mu_k = random_between(numbers, 0, 0.4),
                          .W = random_between(numbers, 1, 6),
                          .t_0 = random_between(numbers, 0.3, 1.5),
                          .T = random_between(numbers, 0.5, 1.2),
                          .power = 2 + (int)(random_bits(numbers) % 3)};
    crank.A = random_between(numbers, 0.5, 6) * (random_bits(numbers) % 2 ? 1 : -1);
    crank.mu_s = crank.mu_k * random_between(numbers, 1, 1.5);
    crank.e = random_bits(numbers) % 2 ? 0 : random_between(numbers, -0.1, 0.1);
    crank.L = (crank.R + fabs(crank.e)) * random_between(numbers, 1.6, 4);
    int centre = (int)(random_bits(numbers) % 4);
    crank.theta_0 = centre < 3 ? dead_centres[centre] * pi : random_between(numbers, -3, 3);
    return crank;
}

static struct motion cycloid_at(double s, double T)
{
    double w = 2 * pi / T;
    return (struct motion){s / T - sin(w * s) / (2 * pi), (1 - cos(w * s)) / T, w * sin(w * s) / T};
}

static struct motion scaled(double A, struct motion motion)
{
    return (struct motion){A * motion.at, A * motion.rate, A * motion.second};
}

static struct motion law_at(const struct crank *crank, double t)
{
    double A = crank->A, W = crank->W, T = crank->T, s = fmin(t / T, 1), d = fmax(0, t - crank->t_0);
    int n = crank->power;
    switch (crank->law) {
    case accelerated: return (struct motion){A * t + W * t * t, A + 2 * W * t, 2 * W};
    case swinging: return (struct motion){A * sin(W * t), A * W * cos(W * t), -A * W * W * sin(W * t)};
    case from_rest: return (struct motion){A * (1 - cos(W * t)), A * W * sin(W * t), A * W * W * cos(W * t)};
    case cycloid: return scaled(A * 2 * pi / W, cycloid_at(t, 2 * pi / W));
    case delayed:
        return scaled(A, (struct motion){pow(d, n), n * pow(d, n - 1), n * (n - 1) * pow(d, n - 2)});
    case rise_and_return:
        if (t < T) return scaled(A, cycloid_at(t, T));
        if (t < 1.5 * T) return (struct motion){A, 0, 0};
        struct motion back = scaled(-A, cycloid_at(t - 1.5 * T, T));
        return (struct motion){A + back.at, back.rate, back.second};
    default:
        if (t >= T) return (struct motion){A, 0, 0};
        return (struct motion){A * s * s * s * (10 + s * (6 * s - 15)),
                               A / T * 30 * s * s * (1 - s) * (1 - s),
                               A / (T * T) * 60 * s * (1 - s) * (1 - 2 * s)};
    }
}

static void write_law(const struct crank *crank, char *text, size_t size)
{
    double A = crank->A, W = crank->W, T = crank->T, w = 2 * pi / T;
    switch (crank->law) {
    case accelerated: snprintf(text, size, "%.17g*t/1[s] + %.17g*(t/1[s])^2", A, W); break;
    case swinging: snprintf(text, size, "%.17g*sin(%.17g*t/1[s])", A, W); break;
    case from_rest: snprintf(text, size, "%.17g*(1 - cos(%.17g*t/1[s]))", A, W); break;
    case cycloid: snprintf(text, size, "%.17g*(t/1[s] - sin(%.17g*t/1[s])/%.17g)", A, W, W); break;
    case delayed: snprintf(text, size, "%.17g*max(0, t/1[s] - %.17g)^%d", A, crank->t_0, crank->power); break;
    case rise_and_return:
        snprintf(text, size,
                 "%.17g*if(t < %.17g[s], t/%.17g[s] - sin(%.17g*t/1[s])/(2*pi), if(t < %.17g[s], 1, "
                 "1 - (t/%.17g[s] - 1.5 - sin(%.17g*(t/1[s] - %.17g))/(2*pi))))",
                 A, T, T, w, 1.5 * T, T, w, 1.5 * T);
        break;
    default:
        snprintf(text, size,
                 "%.17g*min(t/%.17g[s], 1)^3*(10 - 15*min(t/%.17g[s], 1) + 6*min(t/%.17g[s], 1)^2)", A, T, T,
                 T);
    }
}

/* Where the slider is, and how it moves. */
static struct motion slider_at(const struct crank *crank, double t, double *q, double *p)
{
    struct motion theta = law_at(crank, t);
    double c = crank->R * cos(crank->theta_0 + theta.at), s = crank->R * sin(crank->theta_0 + theta.at);
    double rate = theta.rate, second = theta.second;
    *q = s - crank->e;
    *p = sqrt(crank->L * crank->L - *q * *q);
    double dq = c * rate, d2q = c * second - s * rate * rate, dp = -*q * dq / *p;
    double d2p = -(dq * dq + *q * d2q + dp * dp) / *p;
    return (struct motion){c + *p, -s * rate + dp, -c * rate * rate - s * second + d2p};
}

/* The tension of the rod, for the side on which the guide presses. */
static double tension(const struct crank *crank, struct motion x, double q, double p, double *N)
{
    for (int press = 1;; press = -1) {
        double mu = crank->mu_k * press * (x.rate > 0 ? 1 : -1), weight = crank->m * g;
        double S = -(crank->m * x.second + mu * weight) * crank->L / (p - mu * q);
        *N = weight - S * q / crank->L;
        if (*N * press >= 0 || press < 0) return S;
    }
}

static struct trial parse_crank(const struct crank *crank, double until)
{
    char law[400], text[1500];
    double q, p;
    write_law(crank, law, sizeof law);
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n"
             "  slider:\n    mass: %.17g\n    motion: {slide: {through: [0, %.17g]}}\n"
             "    initial: {assemble: true, x: %.17g}\n"
             "    forces: [gravity, normal: {two_sided: true}, friction: {static: %.17g, kinetic: %.17g}]\n"
             "  crank: {mass: 1, shape: rod, length: %.17g, points: {A: [%.17g, 0]}, motion: {pivot: {theta: "
             "\"%.17g + %s\"}}}\n"
             "couplings: [rod: {name: rod, between: [crank.A, slider], length: %.17g}]\nsimulate: {until: "
             "%.17g}\n",
             crank->m, crank->e, slider_at(crank, 0, &q, &p).at, crank->mu_s, crank->mu_k, 2 * crank->R,
             crank->R, crank->theta_0, law, crank->L, until);
    return trial_parse(text);
}

static void check_crank(struct checks *checks, const struct crank *crank, struct random_numbers *numbers)
{
    enum { looks = 5 };
    const double until = 2.9;
    struct trial trial = parse_crank(crank, until);
    trial_start(&trial, NULL);
    double fastest = fabs(crank->A) * 6 * crank->R;
    for (int i = 0; i < looks; i++) {
        double t = until * (i + random_between(numbers, 0, 1)) / looks, q, p, N;
        trial_to(&trial, t);
        struct motion x = slider_at(crank, t, &q, &p);
        check_close(checks, "x", trial_get(&trial, "slider.x"), x.at, 1e-8 * (1 + fastest));
        check_close(checks, "v", trial_get(&trial, "slider.v"), x.rate, 1e-8 * (1 + fastest));
        if (fabs(x.rate) < 1e-3 * fastest) continue;
        double S = tension(crank, x, q, p, &N);
        fbd_arrow rod = trial_arrow(&trial, "rod"), rub = trial_arrow(&trial, "friction");
        double size = fabs(S) + crank->m * g;
        check_close(checks, "tension", -rod.fx, S * p / crank->L, 1e-6 * size);
        check_close(checks, "friction", rub.fx, -copysign(crank->mu_k * fabs(N), x.rate), 1e-6 * size);
    }
    trial_finish(&trial);
    check_that(checks, "it runs to the end", trial.outcome == FBD_DONE);
    trial_close(&trial);
}

static void friction_does_not_hold_what_is_driven(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct random_numbers numbers = {1012258};
    int draws = draws_of(400);
    printf("# seed %d\n", 1012258);
    for (int draw = 0; draw < draws && !checks.failed; draw++) {
        struct crank crank = draw_crank(&numbers);
        check_crank(&checks, &crank, &numbers);
        if (checks.failed) print_message("# draw %d, law %d\n", draw, (int)crank.law);
    }
    checks_end(&checks);
}

/* Its reversals are those of the crank: theta = A sin(W t) from a place beside the dead centres. */
static void it_turns_where_the_drive_turns(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct crank crank = {.law = swinging, .R = 0.3, .L = 1, .m = 1, .mu_s = 0.3, .mu_k = 0.2};
    crank.theta_0 = 1.2, crank.A = 0.5, crank.W = 2;
    struct trial trial = parse_crank(&crank, 6);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    for (int k = 0; k < 4; k++)
        check_close(&checks, "reversal", trial_event(&trial, FBD_EVENT_REVERSAL, "friction", k),
                    (k + 0.5) * pi / crank.W, 1e-8);
    check_that(&checks, "no others", isnan(trial_event(&trial, FBD_EVENT_REVERSAL, "friction", 4)));
    check_that(&checks, "it never sticks", isnan(trial_event(&trial, FBD_EVENT_STICK, NULL, 0)));
    trial_close(&trial);
    checks_end(&checks);
}

/* A start at which the laws of drives have switches is assembled where they are. */
static void a_drive_with_switches_is_assembled(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\nbodies:\n  crank: {mass: 1, shape: rod, length: 2, points: {A: [1, 0]}, motion: "
                    "{pivot: {theta: \"if(t < 1[s], 0.5, 0.7)\"}}}\n"
                    "  slider: {mass: 1, motion: slide, initial: {assemble: true, x: 2}}\n"
                    "couplings: [rod: {between: [crank.A, slider], length: 2}]\n");
    check_close(&checks, "x", trial_get(&trial, "slider.x"), cos(0.5) + sqrt(4 - sin(0.5) * sin(0.5)), 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

/* A place that never changes is a law as well. With every other law beside it, which has an expression. */
static void a_drive_at_a_constant_place_holds(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct trial trial =
        trial_parse("fbd: 1\nbodies:\n  crank: {mass: 1, shape: rod, length: 2, points: {A: [1, 0]}, motion: "
                    "{pivot: {theta: 0.5}}}\n"
                    "  block: {mass: 2, motion: {slide: {x: 3}}, forces: [gravity, normal]}\n"
                    "  slider: {mass: 1, motion: slide, initial: {assemble: true, x: 2}}\n"
                    "  moved: {mass: 1, motion: {slide: {x: \"1[m]*sin(t/1[s])\"}}}\n"
                    "couplings: [rod: {between: [crank.A, slider], length: 2}]\nsimulate: {until: 2}\n");
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_close(&checks, "theta", trial_get(&trial, "crank.theta"), 0.5, 0);
    check_close(&checks, "x", trial_get(&trial, "block.x"), 3, 0);
    check_close(&checks, "v", trial_get(&trial, "block.v"), 0, 0);
    check_close(&checks, "slider", trial_get(&trial, "slider.x"), cos(0.5) + sqrt(4 - sin(0.5) * sin(0.5)),
                1e-12);
    check_close(&checks, "moved", trial_get(&trial, "moved.x"), sin(2), 1e-12);
    trial_close(&trial);
    checks_end(&checks);
}

/* A crank longer than its rod, turned on: the slider cannot follow from r sin(theta) = l on. */
static void a_drive_beyond_its_reach_ends_the_run_by_name(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const double tolerances[] = {1e-6, 1e-9, 1e-12};
    for (int i = 0; i < 30; i++) {
        double r = 0.5 + 0.05 * i, l = r * (0.3 + 0.02 * i), rate = 0.5 + 0.3 * i;
        double when = (asin(l / r) - 0.1) / rate;
        char text[900];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies:\n"
                 "  crank: {mass: 1, shape: rod, length: %.17g, motion: {pivot: {at: [0, 0], point: left, "
                 "theta: \"0.1 + %.17g[rad/s]*t\"}}, forces: [gravity]}\n"
                 "  rod: {mass: %d, shape: rod, length: %.17g, motion: {pivot: {on: crank, at: right, "
                 "point: left}}, initial: {theta: -0.3, assemble: true}, forces: [gravity]}\n"
                 "  slider: {mass: 1, motion: slide, initial: {x: %.17g, assemble: true}}\n"
                 "couplings: [pin: {name: p, between: [rod.right, slider]}]\nsimulate: {until: %.17g}\n",
                 r, rate, 1 + i % 3, l, r + l, 2 * when);
        struct trial trial = trial_parse(text);
        trial_start(&trial, &(fbd_options){.until = NAN, .tolerance = tolerances[i % 3]});
        trial_finish(&trial);
        check_that(&checks, "it ends", trial.outcome == FBD_BROKEN);
        check_that(&checks, "by name",
                   strstr(fbd_simulation_reason(trial.simulation), "the coupling `p") != NULL);
        check_close(&checks, "when", trial_get(&trial, "t"), when, 1e-4 * when);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A force -m q'' on a mass m moves it by q(0) + q'(0) t - q(t), and m P'' of a point P by P(t) - P(0) - P'(0) t. */
static void forces_may_name_accelerations_that_are_prescribed(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    static const char *const methods[] = {NULL, "dop853", "rodas5p", "msbdf"};
    static const char text[] =
        "fbd: 1\nbodies:\n"
        "  table: {mass: 5, motion: {slide: {along: 20 deg, x: \"0.1[m]*sin(6[1/s]*t)\"}}}\n"
        "  arm: {mass: 1, shape: rod, length: 1 m, motion: {pivot: {at: [3, 0], point: left, "
        "theta: \"0.5[rad/s^2]*t^2\"}}}\n"
        "  rider: {mass: 1, inertia: 0.1, motion: {pivot: {on: table, theta: \"0.3*sin(2[1/s]*t)\"}}}\n"
        "  a: {mass: 2, motion: slide, initial: {v: 0.2}, forces: [applied: {value: "
        "\"-2[kg]*table.v_dot\"}]}\n"
        "  b: {mass: 2, motion: particle, forces: [applied: {fx: \"2[kg]*arm.right.ax\", fy: "
        "\"2[kg]*arm.right.ay\"}]}\n"
        "  c: {mass: 2, motion: slide, forces: [applied: {value: \"2[kg*m]*rider.omega_dot\"}]}\n"
        "  d: {mass: 2, motion: slide, forces: [applied: {value: \"2[kg]*table.G.ay\"}]}\n"
        "simulate: {until: 1.5}\n";
    const double t = 1.5, table = 0.1 * sin(6 * t), theta = t * t / 2;
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        struct trial trial = trial_parse(text);
        trial_start(&trial, &(fbd_options){.until = NAN, .method = methods[i]});
        trial_finish(&trial);
        check_close(&checks, "against the table", trial_get(&trial, "a.x"), 0.2 * t + 0.6 * t - table, 1e-8);
        check_close(&checks, "with the point, x", trial_get(&trial, "b.x"), cos(theta) - 1, 1e-8);
        check_close(&checks, "with the point, y", trial_get(&trial, "b.y"), sin(theta), 1e-8);
        check_close(&checks, "relative to a body", trial_get(&trial, "c.x"), 0.3 * sin(2 * t) - 0.6 * t,
                    1e-8);
        check_close(&checks, "a point of the slide", trial_get(&trial, "d.x"),
                    (table - 0.6 * t) * sin(20 * 3.14159265358979323846 / 180), 1e-8);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A rod of 1 m draws a block along its guide, from a slider that rises with 1 m/s to y = 0.5 + t: with x = sqrt(1 - y^2),
 * a = -1/x^3, N_0 = m (g + a y/x), N = N_0/(1 + mu y/x) above zero, N_0/(1 - mu y/x) below. Where mu y/x > 1 neither
 * agrees once N_0 < 0, from y/(1 - y^2)^2 = g on. In a slot it is the same. */
static void friction_that_feeds_its_normal_force_is_named(void **unused)
{
    static const char *const blocks[] = {
        "b: {mass: 2, motion: slide, initial: {assemble: true, x: 0.866}, forces: [gravity, normal: "
        "{two_sided: "
        "true}, friction: %g]}\ncouplings: [rod: {between: [a, b], length: 1}]",
        "b: {mass: 2, motion: particle, initial: {assemble: true, x: 0.866}, forces: [gravity]}\n"
        "couplings: [rod: {between: [a, b], length: 1}, slot: {between: [b, ground.O], kinetic: %g}]"};
    struct checks checks = {0};
    (void)unused;
    double least = 0.5, most = 0.95;
    for (int i = 0; i < 60; i++) {
        double y = (least + most) / 2;
        *(y / pow(1 - y * y, 2) < 9.81 ? &least : &most) = y;
    }
    for (int i = 0; i < 4; i++) {
        double mu = i < 2 ? 0.8 : 0.4, y = 0.9, slope = y / sqrt(1 - y * y);
        char block[400], text[800];
        snprintf(block, sizeof block, blocks[i % 2], mu);
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {O: [0, 0]}}\nbodies:\n"
                 "  a: {mass: 1, motion: {slide: {along: 90 deg, x: 0.5 + 1*t}}}\n  %s\nsimulate: {until: "
                 "0.4}\n",
                 block);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        double end = to_its_end(&trial);
        if (mu * slope > 1) {
            check_close(&checks, "it ends", end, least - 0.5, 1e-8);
            check_that(&checks, "and says why",
                       trial.outcome == FBD_FAILED &&
                           strstr(fbd_simulation_reason(trial.simulation), "Painleve") != NULL);
        } else {
            double x = sqrt(1 - y * y), N_0 = 2 * (9.81 - y / pow(x, 4)), N = N_0 / (1 - mu * slope);
            fbd_arrow drawn = trial_arrow(&trial, "rod");
            check_that(&checks, "done", trial.outcome == FBD_DONE);
            check_close(&checks, "rod", drawn.fy, N - 2 * 9.81, 1e-6);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* A rod of 1 m pushes a block along its guide, from a slider that sinks to y = 0.9 - 0.2 t: a = -0.04/x^3 and
 * N = m (g + a y/x)/(1 - mu y/x), with mu = 0.3 + c t. It grows without bound where mu y/x comes to 1: there it jams, and
 * no run goes on behind. */
static void what_jams_does_not_go_on(void **unused)
{
    static const char *const blocks[] = {
        "b: {mass: 2, motion: slide, initial: {assemble: true, x: 0.436}, forces: [gravity, normal: "
        "{two_sided: true}, friction: {static: 9, kinetic: 0.3 + %g*t}]}\ncouplings: [rod: {between: [a, b], "
        "length: 1}]",
        "b: {mass: 2, motion: particle, initial: {assemble: true, x: 0.436}, forces: [gravity]}\ncouplings: "
        "[rod: "
        "{between: [a, b], length: 1}, slot: {between: [b, ground.O], static: 9, kinetic: 0.3 + %g*t}]"};
    static const double behind[] = {-1e-3, 1e-4, 1e-3, 0.02, 0.3};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 20; i++) {
        double c = 1 + 0.2 * (i / 4), least = 0, most = 1;
        for (int k = 0; k < 60; k++) {
            double t = (least + most) / 2, y = 0.9 - 0.2 * t;
            *((0.3 + c * t) * y / sqrt(1 - y * y) < 1 ? &least : &most) = t;
        }
        char block[500], text[900];
        snprintf(block, sizeof block, blocks[i % 2], c);
        double until = least + behind[i / 2 % 5], y = 0.9 - 0.2 * until, x = sqrt(1 - y * y);
        snprintf(text, sizeof text,
                 "fbd: 1\nground: {points: {O: [0, 0]}}\nbodies:\n  a: {mass: 1, motion: {slide: {along: 90 "
                 "deg, x: "
                 "0.9 - 0.2*t}}}\n  %s\nsimulate: {until: %.17g}\n",
                 block, until);
        struct trial trial = trial_parse(text);
        trial_start(&trial, NULL);
        double end = to_its_end(&trial);
        bool done = trial.outcome == FBD_DONE;
        check_that(&checks, "it goes on until it jams", done == (until < least));
        check_that(&checks, "not before", end > least - 1e-2);
        double N = 2 * (9.81 - 0.04 / (x * x * x) * y / x) / (1 - (0.3 + c * until) * y / x);
        if (done) check_close(&checks, "rod", trial_arrow(&trial, "rod").fy, N - 2 * 9.81, 1e-7 * N);
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(friction_does_not_hold_what_is_driven),
        cmocka_unit_test(it_turns_where_the_drive_turns),
        cmocka_unit_test(a_drive_with_switches_is_assembled),
        cmocka_unit_test(a_drive_at_a_constant_place_holds),
        cmocka_unit_test(a_drive_beyond_its_reach_ends_the_run_by_name),
        cmocka_unit_test(forces_may_name_accelerations_that_are_prescribed),
        cmocka_unit_test(friction_that_feeds_its_normal_force_is_named),
        cmocka_unit_test(what_jams_does_not_go_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
