/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Friction of journal bearings: against closed forms, and random chains of rods against an independent model,
 * Newton's and Euler's laws of each rod with the forces of its pins as unknowns, moments of friction by
 * iteration, all modes tried, and Runge and Kutta's method.
 *
 * Closed forms, k = mu r:
 *
 *   weights on a pulley   (T_1 - T_2) R = I a/R + k (T_1 + T_2 + M g), T_1 = m_1 (g - a), T_2 = m_2 (g + a)
 *   a rising pull F       on the first one: it begins with (m_1 g + F - m_2 g) R = k (m_1 g + F + m_2 g + M g)
 *   a block over it       (T_1 - T_2) R = I a/R + k hypot(T_2, T_1 + M g), T_2 = m_2 a
 *   a lever               without weight, under a force whose line passes the pin at a distance e: it locks itself
 *                         where e < k, whatever the force, and turns with F (e - k) / (I_O - k m L) for e > k
 *                         where the force is across the arm to the centre of mass, at F L m > I_O
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

static const double g = 9.81, accuracy = 1e-9;

/* ---- closed forms */

struct hoist {
    double m1, m2, M, R, k;
};

static struct hoist draw_hoist(struct random_numbers *numbers)
{
    struct hoist hoist = {.m1 = random_between(numbers, 0.5, 5),
                          .m2 = random_between(numbers, 0.5, 5),
                          .M = random_perhaps(numbers, 0.7, 0.1, 10),
                          .R = random_between(numbers, 0.05, 0.5)};
    hoist.k = hoist.R * random_between(numbers, 0.005, 0.3);
    return hoist;
}

/* With another force on the first weight, which hangs; so does the second one, unless it is `flat` on a table. */
static struct trial open_hoist(const struct hoist *h, const char *force, bool flat, double until)
{
    char text[1200], second[200];
    snprintf(second, sizeof second,
             flat ? "motion: {slide: {along: 0, through: [-4, %.17g]}}, forces: [normal: {two_sided: true}]"
                  : "motion: {slide: {along: 90 deg, through: [%.17g, -4]}}, forces: [gravity]",
             flat ? h->R : -h->R);
    snprintf(text, sizeof text,
             "fbd: 1\nbodies:\n  first:\n    mass: %.17g\n    motion: {slide: {along: -90 deg, through: "
             "[%.17g, -4]}}\n    forces: [gravity%s]\n  second: {mass: %.17g, %s}\n  pulley:\n    mass: "
             "%.17g\n    shape: disc\n    radius: %.17g\n    motion: pivot\n    forces: [gravity]\n    "
             "moments: [friction: {bearing: 0.2, radius: %.17g}]\ncouplings:\n  - rope: {through: [second.G, "
             "pulley, first.G]}\nsimulate: {until: %.17g}\n",
             h->m1, h->R, force, h->m2, second, h->M, h->R, h->k / 0.2, until);
    return trial_parse(text);
}

/* The acceleration along the rope by moments on the pulley: zero within its friction, else the root. */
static double hoist_acceleration(const struct hoist *h, bool flat, int side)
{
    double low = -g, high = g;
    for (int i = 0; i < 200; i++) {
        const double a = (low + high) / 2, T1 = h->m1 * (g - a), T2 = h->m2 * (flat ? a : g + a);
        const double R = flat ? hypot(T2, T1 + h->M * g) : T1 + T2 + h->M * g;
        const double rest = (T1 - T2) * h->R - side * h->k * R - h->M * h->R * a / 2;
        *(rest > 0 ? &low : &high) = a;
    }
    return (low + high) / 2;
}

static void check_weights(struct checks *checks, struct random_numbers *numbers)
{
    const struct hoist h = draw_hoist(numbers);
    const bool flat = random_chance(numbers, 0.5);
    const double forth = hoist_acceleration(&h, flat, 1), back = hoist_acceleration(&h, flat, -1);
    const double a = forth > 0 ? forth : fmin(back, 0);
    if (flat && a <= 0) return; /* of a block at rest the rope has any tension up to the weight */
    struct trial trial = open_hoist(&h, "", flat, 0.5);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    check_close(checks, "weights", trial_get(&trial, "first.v"), a / 2, accuracy * g);
    check_close(checks, "pulley", trial_get(&trial, "pulley.omega"), -a / 2 / h.R, accuracy * g / h.R);
    trial_close(&trial);
}

static void check_pull(struct checks *checks, struct random_numbers *numbers)
{
    struct hoist h = draw_hoist(numbers);
    char force[100];
    h.m1 = h.m2;
    const double F = h.k * (2 * h.m1 + h.M) * g / (h.R - h.k), begin = random_between(numbers, 0.3, 1);
    snprintf(force, sizeof force, ", applied: {name: pull, value: \"%.17g[N/s]*t\"}", F / begin);
    struct trial trial = open_hoist(&h, force, false, 1.5 * begin);
    trial_start(&trial, NULL);
    trial_finish(&trial);
    /* (m_1 + m_2 + M/2 + k (m_2 - m_1)/R) a = F' (1 - k/R) */
    const double rate = F / begin * (1 - h.k / h.R) / (2 * h.m1 + h.M / 2), v = rate * begin * begin / 8;
    check_close(checks, "begin", trial_event(&trial, FBD_EVENT_BREAKAWAY, NULL, 0), begin, accuracy * begin);
    check_close(checks, "v by a pull", trial_get(&trial, "first.v"), v, 10 * accuracy * fmax(v, 1));
    trial_close(&trial);
}

/* A rod of the length 2 L about one end, in a plane without weight; the force at s = e along it. */
static void check_lever(struct checks *checks, struct random_numbers *numbers)
{
    const double m = random_between(numbers, 0.5, 5), L = random_between(numbers, 0.2, 2);
    const double k = L * random_between(numbers, 0.02, 0.4), e = k * random_between(numbers, 0.2, 1.8);
    const double F = pow(10, random_between(numbers, 0, 5)), I_O = 4 * m * L * L / 3;
    char text[800];
    snprintf(text, sizeof text,
             "fbd: 1\ngravity: 0\nbodies:\n  lever:\n    shape: rod\n    mass: %.17g\n    length: %.17g\n    "
             "motion: {pivot: {at: [0, 0], point: [%.17g, 0]}}\n    forces: [applied: {value: %.17g, angle: "
             "90 deg, frame: body, at: [%.17g, 0]}]\n    moments: [friction: {bearing: 0.5, radius: "
             "%.17g}]\nsimulate: {until: 1 s}\n",
             m, 2 * L, -L, F, e - L, 2 * k);
    struct trial trial = trial_parse(text);
    /* The reaction is F - m L alpha, against the force where it is positive. */
    const double alpha = e < k ? 0 : F * (e - k) / (I_O - k * m * L);
    check_close(checks, "lever", trial_acceleration(&trial, "lever.theta"), alpha, accuracy * F * L / I_O);
    trial_close(&trial);
}

static void bearings_have_closed_forms(void **unused)
{
    (void)unused;
    static void (*const kinds[])(struct checks * checks,
                                 struct random_numbers * numbers) = {check_weights, check_pull, check_lever};
    const int draws = draws_of(60);
    struct random_numbers numbers = {5104};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) kinds[k](&checks, &numbers);
    checks_end(&checks);
}

/* ---- chains */

enum { most_rods = 3, most_unknowns = 6 * most_rods };

struct rod {
    double m, I, back, fore, k; /* distances from G to both pins; the friction circle */
    double pull;                /* a force along x at G, times t */
};

struct chain {
    int count;
    struct rod rods[most_rods];
    double pull_rate;
};

/* Absolute angles, and angular velocities relative to the rod before. */
struct motion {
    double t, q[most_rods], w[most_rods];
};

struct forces {
    double alpha[most_rods]; /* absolute */
    double c[most_rods], R[most_rods];
};

static bool solve(int n, double A[most_unknowns][most_unknowns + 1])
{
    for (int j = 0; j < n; j++) {
        int best = j;
        for (int i = j; i < n; i++)
            if (fabs(A[i][j]) > fabs(A[best][j])) best = i;
        if (A[best][j] == 0) return false;
        for (int k = 0; k <= n; k++) {
            const double swap = A[j][k];
            A[j][k] = A[best][k];
            A[best][k] = swap;
        }
        for (int i = 0; i < n; i++) {
            const double by = i == j ? 0 : A[i][j] / A[j][j];
            for (int k = j; by != 0 && k <= n; k++) A[i][k] -= by * A[j][k];
        }
    }
    for (int i = 0; i < n; i++) A[i][n] /= A[i][i];
    return true;
}

/* Unknowns of rod i: a_x, a_y, alpha, R_x, R_y and c of its first pin. `given`: moments of those that slip. */
static void solve_chain(const struct chain *chain, const struct motion *at, const int *mode, struct forces *f)
{
    const int n = chain->count, size = 6 * n;
    double A[most_unknowns][most_unknowns + 1] = {{0}};
    double spin = 0, before = 0;
    for (int i = 0; i < n; i++) {
        const struct rod *rod = &chain->rods[i];
        const bool last = i + 1 == n;
        const double x = cos(at->q[i]), y = sin(at->q[i]);
        double(*row)[most_unknowns + 1] = &A[6 * i];
        const int u = 6 * i, v = u + 6, p = u - 6;
        spin = before + at->w[i];
        row[0][u] = rod->m; /* m a_x = R_x - R_x' + pull */
        row[0][u + 3] = -1;
        row[0][size] = rod->pull + chain->pull_rate * at->t;
        row[1][u + 1] = rod->m;
        row[1][u + 4] = -1;
        row[1][size] = -rod->m * g;
        row[2][u + 2] = rod->I; /* I alpha = c - c' + (-b e) x R + (f e) x (-R') */
        row[2][u + 3] = -rod->back * y;
        row[2][u + 4] = rod->back * x;
        row[2][u + 5] = -1;
        if (!last) {
            row[0][v + 3] = row[1][v + 4] = 1;
            row[2][v + 3] = -rod->fore * y;
            row[2][v + 4] = rod->fore * x;
            row[2][v + 5] = 1;
        }
        /* The pin: a - alpha k x b e + w^2 b e = that of the rod before. */
        row[3][u] = row[4][u + 1] = 1;
        row[3][u + 2] = rod->back * y;
        row[4][u + 2] = -rod->back * x;
        row[3][size] = -spin * spin * rod->back * x;
        row[4][size] = -spin * spin * rod->back * y;
        if (i > 0) {
            const double X = cos(at->q[i - 1]), Y = sin(at->q[i - 1]), d = rod[-1].fore;
            row[3][p] = row[4][p + 1] = -1;
            row[3][p + 2] = d * Y;
            row[4][p + 2] = -d * X;
            row[3][size] -= before * before * d * X;
            row[4][size] -= before * before * d * Y;
        }
        if (mode[i] == 0) {
            row[5][u + 2] = 1;
            if (i > 0) row[5][p + 2] = -1;
        } else {
            row[5][u + 5] = 1;
            row[5][size] = f->c[i];
        }
        before = spin;
    }
    assert_true(solve(size, A));
    for (int i = 0; i < n; i++) {
        f->alpha[i] = A[6 * i + 2][size];
        f->R[i] = hypot(A[6 * i + 3][size], A[6 * i + 4][size]);
        if (mode[i] == 0) f->c[i] = A[6 * i + 5][size];
    }
}

static void solve_modes(const struct chain *chain, const struct motion *at, const int *mode, struct forces *f)
{
    for (int i = 0; i < chain->count; i++) f->c[i] = 0;
    for (int pass = 0; pass < 200; pass++) {
        double change = 0;
        solve_chain(chain, at, mode, f);
        for (int i = 0; i < chain->count; i++) {
            if (mode[i] == 0) continue;
            const double c = -mode[i] * chain->rods[i].k * f->R[i];
            change = fmax(change, fabs(c - f->c[i]) / (fabs(c) + 1e-300));
            f->c[i] = c;
        }
        if (change < 1e-14) break;
    }
}

/* How far joint i is from a change of its mode. */
static double margin(const struct chain *chain, const struct forces *f, const int *mode, int i)
{
    const double own = f->alpha[i] - (i > 0 ? f->alpha[i - 1] : 0);
    return mode[i] == 0 ? chain->rods[i].k * f->R[i] - fabs(f->c[i]) : mode[i] * own;
}

/* Try all modes of joints at rest. Returns the number of those that agree. */
static int decide(const struct chain *chain, const struct motion *at, int *mode, struct forces *f)
{
    int found = 0, all = 1;
    for (int i = 0; i < chain->count; i++) all *= 3;
    for (int number = 0; number < all; number++) {
        int tried[most_rods], code = number;
        bool agrees = true;
        struct forces forces;
        for (int i = 0; i < chain->count; i++, code /= 3) {
            tried[i] = code % 3 - 1;
            if (at->w[i] != 0 && tried[i] != (at->w[i] > 0 ? 1 : -1)) agrees = false;
        }
        if (!agrees) continue;
        solve_modes(chain, at, tried, &forces);
        for (int i = 0; i < chain->count; i++)
            if (at->w[i] == 0 && margin(chain, &forces, tried, i) < 0) agrees = false;
        if (!agrees) continue;
        found++;
        memcpy(mode, tried, sizeof tried);
        *f = forces;
    }
    return found;
}

static struct motion derivative(const struct chain *chain, const struct motion *at, const int *mode)
{
    struct motion d = {.t = 1};
    struct forces f;
    double spin = 0;
    solve_modes(chain, at, mode, &f);
    for (int i = 0; i < chain->count; i++) {
        spin += at->w[i];
        d.q[i] = spin;
        d.w[i] = mode[i] == 0 ? 0 : f.alpha[i] - (i > 0 ? f.alpha[i - 1] : 0);
    }
    return d;
}

static struct motion moved(const struct motion *at, const struct motion *d, double h)
{
    struct motion to = *at;
    to.t += h * d->t;
    for (int i = 0; i < most_rods; i++) {
        to.q[i] += h * d->q[i];
        to.w[i] += h * d->w[i];
    }
    return to;
}

static struct motion step(const struct chain *chain, const struct motion *at, const int *mode, double h)
{
    const struct motion a = derivative(chain, at, mode), to_b = moved(at, &a, h / 2);
    const struct motion b = derivative(chain, &to_b, mode), to_c = moved(at, &b, h / 2);
    const struct motion c = derivative(chain, &to_c, mode), to_d = moved(at, &c, h);
    const struct motion d = derivative(chain, &to_d, mode);
    struct motion to = moved(at, &a, h / 6);
    to = moved(&to, &b, h / 3);
    to = moved(&to, &c, h / 3);
    return moved(&to, &d, h / 6);
}

/* The joint that has left its mode at the end of a step, or -1. */
static int leaves(const struct chain *chain, const struct motion *at, const int *mode)
{
    struct forces f;
    solve_modes(chain, at, mode, &f);
    for (int i = 0; i < chain->count; i++) {
        if (mode[i] == 0 && margin(chain, &f, mode, i) < 0) return i;
        if (mode[i] != 0 && mode[i] * at->w[i] < 0) return i;
    }
    return -1;
}

/* Move to `until`, with each change of modes located by bisection. False where it is too close to call. */
static bool run_chain(const struct chain *chain, struct motion *at, double h, double until)
{
    int mode[most_rods], changes = 0;
    struct forces f;
    if (decide(chain, at, mode, &f) != 1) return false;
    while (at->t < until - 1e-12) {
        const double whole = fmin(h, until - at->t);
        struct motion next = step(chain, at, mode, whole);
        int which = leaves(chain, &next, mode);
        if (which < 0) {
            *at = next;
            continue;
        }
        double low = 0, high = whole;
        for (int i = 0; i < 50; i++) {
            const double middle = (low + high) / 2;
            next = step(chain, at, mode, middle);
            const int then = leaves(chain, &next, mode);
            if (then >= 0) which = then;
            *(then >= 0 ? &high : &low) = middle;
        }
        *at = step(chain, at, mode, high);
        if (mode[which] != 0) at->w[which] = 0;
        if (mode[which] == 0) { /* beyond the limit by rounding: take the side of its moment */
            solve_modes(chain, at, mode, &f);
            mode[which] = f.c[which] > 0 ? -1 : 1;
            *at = step(chain, at, mode, 1e-7);
        } else if (decide(chain, at, mode, &f) != 1) {
            return false;
        }
        if (++changes > 30) return false;
    }
    return true;
}

static struct chain draw_chain(struct random_numbers *numbers)
{
    struct chain chain = {.count = 1 + (int)random_between(numbers, 0, 2.999)};
    for (int i = 0; i < chain.count; i++) {
        const double L = random_between(numbers, 0.3, 1.5), share = random_between(numbers, 0.3, 0.7);
        struct rod *rod = &chain.rods[i];
        rod->m = random_between(numbers, 0.5, 3);
        rod->I = rod->m * L * L * random_between(numbers, 0.05, 0.15);
        rod->back = share * L;
        rod->fore = (1 - share) * L;
        rod->k = L * random_between(numbers, 0.001, 0.05);
    }
    chain.pull_rate = random_perhaps(numbers, 0.3, -20, 20);
    return chain;
}

static void draw_motion(struct random_numbers *numbers, const struct chain *chain, struct motion *at)
{
    const bool hangs = random_chance(numbers, 0.5); /* near equilibrium, where it may stick */
    for (int i = 0; i < chain->count; i++) {
        const double lean = random_between(numbers, -1, 1);
        at->q[i] = hangs ? -1.5707963267948966 + 0.1 * lean : 3 * lean;
        at->w[i] = random_perhaps(numbers, 0.4, -3, 3);
    }
}

static struct trial open_chain(const struct chain *chain, const struct motion *at, double until)
{
    char text[4000];
    int length = snprintf(text, sizeof text, "fbd: 1\nbodies:\n");
    for (int i = 0; i < chain->count; i++) {
        const struct rod *rod = &chain->rods[i];
        char on[80] = "";
        if (i > 0) snprintf(on, sizeof on, "on: rod%d, at: [%.17g, 0], ", i - 1, rod[-1].fore);
        length += snprintf(text + length, sizeof text - (size_t)length,
                           "  rod%d:\n    mass: %.17g\n    inertia: %.17g\n    motion: {pivot: {%spoint: "
                           "[%.17g, 0]}}\n    initial: {theta: %.17g, omega: %.17g}\n    forces: [gravity, "
                           "applied: {fx: \"%.17g[N/s]*t\", fy: 0}]\n    moments: [friction: {bearing: 0.1, "
                           "radius: %.17g}]\n",
                           i, rod->m, rod->I, on, -rod->back, at->q[i] - (i > 0 ? at->q[i - 1] : 0), at->w[i],
                           chain->pull_rate, 10 * rod->k);
    }
    snprintf(text + length, sizeof text - (size_t)length, "simulate: {until: %.17g}\n", until);
    return trial_parse(text);
}

/* Returns whether the modes were clear enough to be compared. */
static bool check_start(struct checks *checks, const struct chain *chain, const struct motion *at,
                        struct trial *trial)
{
    int mode[most_rods];
    struct forces f;
    const int found = decide(chain, at, mode, &f);
    check_that(checks, "one solution", found == 1);
    for (int i = 0; i < chain->count; i++)
        if (at->w[i] == 0 && fabs(margin(chain, &f, mode, i)) < 1e-9) return false;
    for (int i = 0; i < chain->count; i++) {
        char name[20];
        snprintf(name, sizeof name, "rod%d.theta", i);
        check_close(checks, name, trial_acceleration(trial, name), f.alpha[i],
                    1e-10 * (fabs(f.alpha[i]) + 10));
        check_close(checks, "moment", trial_term(trial, name, "friction"), f.c[i],
                    1e-10 * (fabs(f.c[i]) + 1));
    }
    return true;
}

/* The error of the independent motion is below its change by half the step. */
static void check_chain(struct checks *checks, struct random_numbers *numbers)
{
    const double until = 0.8, h = 2e-3;
    const struct chain chain = draw_chain(numbers);
    struct motion at = {0};
    draw_motion(numbers, &chain, &at);
    struct motion coarse = at;
    struct trial trial = open_chain(&chain, &at, until);
    if (check_start(checks, &chain, &at, &trial) && run_chain(&chain, &at, h / 2, until) &&
        run_chain(&chain, &coarse, h, until)) {
        trial_start(&trial, NULL);
        trial_finish(&trial);
        double change = 0;
        for (int i = 0; i < chain.count; i++) change = fmax(change, fabs(at.w[i] - coarse.w[i]));
        for (int i = 0; i < chain.count; i++) {
            char name[20];
            snprintf(name, sizeof name, "rod%d.omega", i);
            check_close(checks, name, trial_get(&trial, name), at.w[i], 1e-7 + change);
        }
    }
    trial_close(&trial);
}

static void chains_agree_with_an_independent_model(void **unused)
{
    (void)unused;
    const int draws = number_of("FBD_JOURNALS", draws_of(40));
    struct random_numbers numbers = {(uint64_t)number_of("FBD_SEED", 5101)};
    struct checks checks = {0};
    for (int i = 0; i < draws; i++) check_chain(&checks, &numbers);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(bearings_have_closed_forms),
                                       cmocka_unit_test(chains_agree_with_an_independent_model)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
