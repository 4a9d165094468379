/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Impacts at a point: numbers known from textbooks and by hand, and random ones by the million
 * (FBD_IMPACTS=1000000), whose laws are held against the way of (v_n, v_t) followed in small pieces.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "holds/impact.h"
#include "random_numbers.h"

static void check(double actual, double expected, double tolerance)
{
    if (fabs(actual - expected) <= tolerance) return;
    fail_msg("%.15g, expected %.15g, off by %.3g of %.3g", actual, expected, fabs(actual - expected),
             tolerance);
}

/* The end of a uniform rod, 1 m, 1 kg, at 45 degrees: W = 1/m + r^2 / I_G in each direction, with r_x = r_y =
 * 0.5 cos 45 deg and I_G = 1/12. */
static struct impact_point rod_end(double mu, double e, enum impact_law law)
{
    return (struct impact_point){{2.5, -1.5, 2.5}, mu, e, law};
}

static void a_falling_rod_slides_on_or_sticks(void **state)
{
    const double mu[] = {0, 0.1, 0.5, 1}, v_t[] = {-0.9, -0.797872340, -0.214285714, 0};
    (void)state;
    for (int i = 0; i < 4; i++) {
        struct impact_point end = rod_end(mu[i], 0.5, impact_stronge);
        struct impact impact = impact_at_point(&end, -1, 0);
        check(impact.v_t, v_t[i], 1e-9); /* the table has nine digits */
        check(impact.v_n, 0.5, 1e-15);
    }
    struct impact_point end = rod_end(1, 0.5, impact_stronge);
    struct impact impact = impact_at_point(&end, -1, -1);
    check(impact.v_t, 0, 0);
    check(impact.v_n, 0.632455532, 1e-9);
    check(impact.p, 1.395284708, 1e-9);
    assert_int_equal(impact.slip, impact_sticks);
}

/* A body that slips backwards after the impact, by hand: W = [2, 1.5, 2], mu = 0.1, from (-1, -0.2) with e =
 * 1 by Poisson. Slipping to the left, f = +0.1: dv_n = 2.15, dv_t = 1.7, it rests at p = 2/17. Then it is
 * thrown to the right, f = -0.1, for 1.5 > 0.1 * 2: dv_n = 1.85, dv_t = 1.3. */
static void friction_that_does_not_hold_lets_it_slip_back(void **state)
{
    (void)state;
    struct impact_point point = {{2, 1.5, 2}, 0.1, 1, impact_poisson};
    struct impact impact = impact_at_point(&point, -1, -0.2);
    double rest = 0.2 / 1.7, v_n = -1 + 2.15 * rest, compression = rest - v_n / 1.85;
    check(impact.compression, compression, 1e-15);
    check(impact.p, 2 * compression, 1e-15);
    check(impact.v_n, 1.85 * compression, 1e-15);
    check(impact.v_t, 1.3 * (2 * compression - rest), 1e-15);
    assert_int_equal(impact.slip, impact_reverses);
}

/* Without friction all laws are one: v_n = -e v_n. */
static void without_friction_the_laws_agree(void **state)
{
    (void)state;
    for (enum impact_law law = impact_stronge; law <= impact_moreau; law++) {
        struct impact_point point = {{3, -2, 4}, 0, 0.7, law};
        check(impact_at_point(&point, -2, 1).v_n, 1.4, 4e-16);
        check(impact_at_point(&point, 0, 1).p, 0, 0);
        check(impact_at_point(&point, 1, 1).v_n, 1, 0);
    }
}

/* ---- random ones */

static struct impact_point random_point(struct random_numbers *numbers)
{
    double a = pow(10, random_between(numbers, -3, 3)), c = a * pow(10, random_between(numbers, -2, 2));
    double b = sqrt(a * c) * random_between(numbers, -0.999, 0.999);
    double mu = random_bits(numbers) % 4 == 0 ? 0 : pow(10, random_between(numbers, -2, 1));
    double e = random_bits(numbers) % 4 == 0 ? 0 : random_between(numbers, 0, 1);
    return (struct impact_point){{a, b, c}, mu, e, (enum impact_law)(random_bits(numbers) % 4)};
}

/* Of the two directions, in the sense of the masses: 1 where one impulse does all of the other's work. */
static double square_of_cosine(const struct impact_point *point)
{
    return point->W[1] * point->W[1] / (point->W[0] * point->W[2]);
}

/* Kane's paradox (Kane and Levinson, Dynamics, 1985): where slipping ends within the impact, v_n = -e v_n may
 * take more energy than there was. The other laws never do, from the same starts. */
static void newton_s_law_can_make_energy(void **state)
{
    struct random_numbers numbers = {3};
    int made = 0;
    (void)state;
    for (int i = 0; i < 1000; i++) {
        struct impact_point point = random_point(&numbers);
        double v_t = random_between(&numbers, -5, 5);
        point.law = impact_newton;
        if (!(impact_at_point(&point, -1, v_t).work > 1e-3 / point.W[0])) continue;
        made++;
        point.law = impact_stronge;
        assert_true(impact_at_point(&point, -1, v_t).work <= 0);
        point.law = impact_poisson;
        assert_true(impact_at_point(&point, -1, v_t).work <= 0);
    }
    assert_true(made > 0);
}

static void check_laws(const struct impact_point *point, double v_n, double v_t)
{
    const double *W = point->W, rounding = 1e-13;
    struct impact impact = impact_at_point(point, v_n, v_t);
    double size = W[0] * impact.p + fabs(W[1] * impact.tau) - v_n;
    double along = fabs(W[1]) * impact.p + W[2] * fabs(impact.tau) + fabs(v_t);
    check(impact.v_n, v_n + W[0] * impact.p + W[1] * impact.tau, rounding * size);
    check(impact.v_t, v_t + W[1] * impact.p + W[2] * impact.tau, rounding * along);
    assert_true(impact.p > 0 && fabs(impact.tau) <= point->mu * impact.p * (1 + rounding));
    assert_true(impact.v_n >= 0);
    double energy = impact.p * size + fabs(impact.tau) * along;
    if (!impact_by_velocity(point->law)) assert_true(impact.work <= rounding * energy);
    if (impact_by_velocity(point->law)) check(impact.v_n, -point->e * v_n, rounding * size);
    if (point->law == impact_moreau && fabs(impact.v_t) > rounding * along)
        check(impact.tau, -copysign(point->mu * impact.p, impact.v_t), rounding * point->mu * impact.p);
    if (point->law == impact_poisson)
        check(impact.p, (1 + point->e) * impact.compression, rounding * impact.p);
}

static void random_impacts_keep_their_laws(void **state)
{
    const char *many = getenv("FBD_IMPACTS");
    long count = many ? atol(many) : 20000;
    struct random_numbers numbers = {20260101};
    (void)state;
    for (long i = 0; i < count; i++) {
        struct impact_point point = random_point(&numbers);
        double v_n = -pow(10, random_between(&numbers, -3, 3));
        double v_t = random_bits(&numbers) % 4 == 0 ? 0 : v_n * random_between(&numbers, -5, 5);
        check_laws(&point, v_n, v_t);
    }
    print_message("# %ld impacts\n", count);
}

/* The friction of the velocity after is that of the way to it, but where the point slips back: then it is
 * more. */
static void moreau_s_law_is_newton_s_but_where_it_slips_back(void **state)
{
    struct random_numbers numbers = {11};
    int back = 0, same = 0;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        struct impact_point point = random_point(&numbers);
        double v_t = random_bits(&numbers) % 4 == 0 ? 0 : random_between(&numbers, -5, 5);
        point.law = impact_newton;
        struct impact newton = impact_at_point(&point, -1, v_t);
        point.law = impact_moreau;
        struct impact moreau = impact_at_point(&point, -1, v_t);
        if (newton.slip == impact_reverses) {
            back += point.mu > 0 && fabs(moreau.tau) > fabs(newton.tau);
            continue;
        }
        same++;
        double size = newton.p + fabs(newton.tau), stretch = 1 / (1 - square_of_cosine(&point));
        check(moreau.p, newton.p, 1e-14 * stretch * size);
        check(moreau.tau, newton.tau, 1e-14 * stretch * size);
    }
    assert_true(back > 100 && same > 10000);
}

/* Stronge's law by following the way in small pieces: the work of the normal impulse in restitution is -e^2
 * that of compression. */
static void the_work_of_restitution_is_e_squared(void **state)
{
    enum { pieces = 20000 };
    struct random_numbers numbers = {7};
    (void)state;
    for (int i = 0; i < 50; i++) {
        struct impact_point point = random_point(&numbers);
        point.law = impact_stronge;
        double v_n = -1, v_t = random_between(&numbers, -3, 3);
        struct impact impact = impact_at_point(&point, v_n, v_t);
        double down = 0, up = 0, dp = impact.p / pieces, t = v_t, before = v_n;
        for (int k = 0; k < pieces; k++) {
            double stuck = point.W[2] > 0 ? -point.W[1] / point.W[2] : 0;
            double f = fabs(stuck) <= point.mu ? stuck : copysign(point.mu, stuck);
            /* implicit in the slip: what would pass through zero sticks */
            double minus = t + (point.W[1] + point.W[2] * point.mu) * dp;
            double plus = t + (point.W[1] - point.W[2] * point.mu) * dp;
            if (plus > 0) f = -point.mu;
            if (minus < 0) f = point.mu;
            if (plus <= 0 && minus >= 0) f = fabs(point.W[2]) > 0 ? (-t / dp - point.W[1]) / point.W[2] : 0;
            t += (point.W[1] + point.W[2] * f) * dp;
            double after = before + (point.W[0] + point.W[1] * f) * dp, mean = (before + after) / 2;
            if (mean < 0)
                down += mean * dp;
            else
                up += mean * dp;
            before = after;
        }
        check(up, -point.e * point.e * down, -1e-3 * down); /* first order in 1/20000, with breaks */
    }
}

/* ---- one coordinate, whose unit impulse moves the point by (a, b): W = [a^2, a b, b^2], but for rounding */

struct line {
    double a, b;
    struct impact_point point;
    bool locks; /* friction holds against any normal impulse */
};

static struct line random_line(struct random_numbers *numbers)
{
    static const enum impact_law laws[] = {impact_stronge, impact_poisson, impact_newton, impact_moreau};
    double a = random_between(numbers, 0.1, 2), b = random_between(numbers, -2, 2);
    struct line line = {.a = a, .b = b};
    line.point = (struct impact_point){{a * a, a * b, b * b * (1 + random_between(numbers, -4e-16, 4e-16))},
                                       random_between(numbers, 0.01, 2),
                                       random_chance(numbers, 0.5) ? 0 : random_between(numbers, 0.05, 1),
                                       laws[(int)random_between(numbers, 0, 3.999)]};
    line.locks = a <= line.point.mu * fabs(b);
    return line;
}

/* On what rests it comes to rest with friction against its way, and is thrown back with friction against that:
 * dv_n = a (a + mu |b|) dp, then a (a - mu |b|) dp, or nothing where friction locks it. */
static void what_one_coordinate_moves_comes_to_rest(void **state)
{
    struct random_numbers numbers = {8};
    (void)state;
    for (int i = 0; i < 20000; i++) {
        struct line line = random_line(&numbers);
        double a = line.a, b = line.b, mu = line.point.mu, e = line.point.e;
        double s = random_between(&numbers, 0.1, 3), noise = 1 + random_between(&numbers, -1e-14, 1e-14);
        double down = a * (a + mu * fabs(b)), up = a * (a - mu * fabs(b)), back = e * s;
        if (fabs(up) < 1e-3) continue;
        if (line.point.law == impact_stronge) back *= sqrt(fmax(0, up / down));
        if (line.point.law == impact_poisson) back *= up / down;
        if (line.locks) back = 0;
        struct impact impact = impact_at_point(&line.point, -s, -s * b / a * noise);
        check(impact.v_n, back, 1e-9);
        check(impact.v_t, back * b / a, 1e-8 * (1 + fabs(b / a)));
        check(a * (a * impact.p + b * impact.tau), s + back, 1e-9);
        assert_true(fabs(impact.tau) <= mu * impact.p * (1 + 1e-9));
    }
}

/* On what a drive moves along by -r: where it comes to rest on that while it still closes, and friction locks it, no
 * impulse ends the approach; nor where it presses itself on as it slips. */
static void on_what_is_driven_a_blow_may_jam(void **state)
{
    struct random_numbers numbers = {9};
    int jams = 0;
    (void)state;
    for (int i = 0; i < 20000; i++) {
        struct line line = random_line(&numbers);
        double a = line.a, b = line.b, s = random_between(&numbers, 0.1, 3),
               r = random_between(&numbers, -3, 3);
        double v_t = r - s * b / a, slope = a * (a - line.point.mu * b * copysign(1, v_t));
        double at_rest = -r * a / b; /* v_n, when v_t = 0 */
        if (fabs(slope) < 1e-3 || fabs(r) < 1e-3 || fabs(at_rest) < 1e-3 || fabs(at_rest + s) < 1e-3)
            continue;
        line.point.law = impact_stronge;
        bool jammed = slope < 0 || (line.locks && at_rest > -s && at_rest < 0);
        struct impact impact = impact_at_point(&line.point, -s, v_t);
        assert_int_equal(impact.slip == impact_jams, jammed);
        jams += jammed;
        if (!jammed) check(a * (a * impact.p + b * impact.tau), s + impact.v_n, 1e-9 * (1 + impact.p));
    }
    assert_true(jams > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_one_coordinate_moves_comes_to_rest),
        cmocka_unit_test(on_what_is_driven_a_blow_may_jam),
        cmocka_unit_test(a_falling_rod_slides_on_or_sticks),
        cmocka_unit_test(friction_that_does_not_hold_lets_it_slip_back),
        cmocka_unit_test(without_friction_the_laws_agree),
        cmocka_unit_test(newton_s_law_can_make_energy),
        cmocka_unit_test(random_impacts_keep_their_laws),
        cmocka_unit_test(moreau_s_law_is_newton_s_but_where_it_slips_back),
        cmocka_unit_test(the_work_of_restitution_is_e_squared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
