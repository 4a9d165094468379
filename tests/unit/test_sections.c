/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Section forces of random beams at rest and of random rods in motion, against sums and integrals over the part beyond the
 * section; the falling chimney; zeros of polynomials; bodies that have no sections.
 *
 * SECTIONS_DRAWS=2000 draws more.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_section.h"
#include "random_numbers.h"
#include "run_checks.h"
#include "section/polynomial.h"

static const double digits = 1e-10;

/* ---- the part beyond a section */

/* Loads in the axes of the rod: x along it, y to the left. */
struct point_load {
    double x, y, fx, fy, couple;
};

/* A force per length in the direction (ex, ey), at the distance y beside the axis. */
struct line_load {
    double from, to, w0, w1, ex, ey, y;
};

enum { most_loads = 12 };

struct loaded_rod {
    double length, mu; /* mass per length */
    double gx, gy;     /* weight per mass */
    double ax, ay, alpha, omega;
    int points, lines;
    struct point_load point[most_loads];
    struct line_load line[most_loads];
};

/* Add the integral over x to `to` of a density a + b s (s from x on) in the direction (ex, ey). */
static void add_linear(double cut[3], double span, double a, double b, double ex, double ey, double y,
                       double arm)
{
    const double F = a * span + b * span * span / 2, S = a * span * span / 2 + b * span * span * span / 3;
    cut[0] += F * ex;
    cut[1] -= F * ey;
    cut[2] += (S + arm * F) * ey - y * F * ex;
}

/* N, V and M at x from all that acts beyond x. */
static void cut_at(const struct loaded_rod *rod, double x, double cut[3])
{
    cut[0] = cut[1] = cut[2] = 0;
    for (int i = 0; i < rod->points; i++) {
        const struct point_load *load = &rod->point[i];
        if (load->x <= x) continue;
        cut[0] += load->fx;
        cut[1] -= load->fy;
        cut[2] += (load->x - x) * load->fy - load->y * load->fx + load->couple;
    }
    for (int i = 0; i < rod->lines; i++) {
        const struct line_load *load = &rod->line[i];
        const double from = fmax(load->from, x), span = load->to - from;
        const double slope = (load->w1 - load->w0) / (load->to - load->from);
        if (span <= 0) continue;
        add_linear(cut, span, load->w0 + slope * (from - load->from), slope, load->ex, load->ey, load->y,
                   from - x);
    }
    const double span = rod->length - x, square = rod->omega * rod->omega;
    add_linear(cut, span, rod->mu * (rod->gx - rod->ax + square * x), rod->mu * square, 1, 0, 0, 0);
    add_linear(cut, span, rod->mu * (rod->gy - rod->ay - rod->alpha * x), -rod->mu * rod->alpha, 0, 1, 0, 0);
}

/* The resultant and the moment about x = 0 of the loads and the weight. */
static void sum_of(const struct loaded_rod *rod, double sum[3])
{
    struct loaded_rod rest = *rod;
    double cut[3];
    rest.ax = rest.ay = rest.alpha = rest.omega = 0;
    for (int i = 0; i < rest.points; i++) rest.point[i].x += 1; /* none at x = 0 itself */
    for (int i = 0; i < rest.lines; i++) {
        rest.line[i].from += 1;
        rest.line[i].to += 1;
    }
    rest.mu = 0;
    cut_at(&rest, 0, cut);
    const double m = rod->mu * rod->length;
    sum[0] = cut[0] + m * rod->gx;
    sum[1] = -cut[1] + m * rod->gy;
    sum[2] = cut[2] - (-cut[1]) + m * rod->gy * rod->length / 2;
}

static double scale_of(const struct loaded_rod *rod)
{
    double size = rod->mu * rod->length *
                  (fabs(rod->gx) + fabs(rod->gy) + fabs(rod->ax) + fabs(rod->ay) +
                   (fabs(rod->alpha) + rod->omega * rod->omega) * rod->length);
    for (int i = 0; i < rod->points; i++)
        size += fabs(rod->point[i].fx) + fabs(rod->point[i].fy) + fabs(rod->point[i].couple) / rod->length;
    for (int i = 0; i < rod->lines; i++)
        size += (fabs(rod->line[i].w0) + fabs(rod->line[i].w1)) * (rod->line[i].to - rod->line[i].from);
    return size;
}

static void check_cuts(struct checks *checks, const char *what, const fbd_section *section,
                       const struct loaded_rod *rod)
{
    const double size = scale_of(rod);
    double greatest = -HUGE_VAL, least = HUGE_VAL;
    for (int i = 0; i < 41; i++) {
        const double x = rod->length * (i + 0.37) / 41.3;
        const fbd_cut cut = fbd_section_at(section, x, false);
        double known[3];
        cut_at(rod, x, known);
        check_close(checks, what, cut.N, known[0], digits * size);
        check_close(checks, what, cut.V, known[1], digits * size);
        check_close(checks, what, cut.M, known[2], digits * size * rod->length);
        greatest = fmax(greatest, known[2]);
        least = fmin(least, known[2]);
    }
    const fbd_section_extreme high = fbd_section_extreme_of(section, 2, true),
                              low = fbd_section_extreme_of(section, 2, false);
    assert_true(high.value >= greatest - digits * size * rod->length);
    assert_true(low.value <= least + digits * size * rod->length);
    for (int end = 0; end < 2;
         end++) { /* the extreme is the value at its place, where V has a zero or a jump */
        const fbd_section_extreme extreme = end ? high : low;
        const fbd_cut before = fbd_section_at(section, extreme.x, false),
                      behind = fbd_section_at(section, extreme.x, true);
        const double off = fmin(fabs(before.M - extreme.value), fabs(behind.M - extreme.value));
        check_close(checks, "extreme", off, 0, digits * size * rod->length);
    }
}

/* ---- scenes */

struct lines {
    char text[6000];
    size_t length;
};

static void add(struct lines *lines, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(struct lines *lines, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    int count = vsnprintf(lines->text + lines->length, sizeof lines->text - lines->length, format, list);
    va_end(list);
    assert_true(count >= 0 && lines->length + (size_t)count < sizeof lines->text);
    lines->length += (size_t)count;
}

/* Draw loads, and write them as `forces` and `moments`; `turn` is the angle of the rod in the world. */
static void draw_loads(struct random_numbers *numbers, struct loaded_rod *rod, double turn,
                       struct lines *lines)
{
    const int points = (int)random_between(numbers, 0, 4), spreads = (int)random_between(numbers, 0, 3);
    const bool weighs = random_chance(numbers, 0.7);
    rod->gx = weighs ? -9.81 * sin(turn) : 0;
    rod->gy = weighs ? -9.81 * cos(turn) : 0;
    add(lines, "    forces:\n      - drag: {linear: 0}\n%s", weighs ? "      - gravity\n" : "");
    for (int i = 0; i < points; i++) {
        struct point_load *load = &rod->point[rod->points++];
        *load = (struct point_load){random_between(numbers, 0, rod->length),
                                    random_perhaps(numbers, 0.3, -0.1, 0.1), random_between(numbers, -50, 50),
                                    random_between(numbers, -50, 50), 0};
        add(lines, "      - applied: {name: P%d, value: [%.17g, %.17g], frame: body, at: [%.17g, %.17g]}\n",
            i, load->fx, load->fy, load->x, load->y);
    }
    for (int i = 0; i < spreads; i++) {
        struct line_load *load = &rod->line[rod->lines++];
        const double a = random_between(numbers, 0, 0.5 * rod->length),
                     b = random_between(numbers, a + 0.1 * rod->length, rod->length),
                     angle = random_between(numbers, -3, 3);
        *load = (struct line_load){
            a,          b,          random_between(numbers, 0, 60),         random_between(numbers, 5, 60),
            cos(angle), sin(angle), random_perhaps(numbers, 0.3, -0.1, 0.1)};
        const bool back = random_chance(numbers, 0.5);
        add(lines,
            "      - distributed: {name: w%d, from: [%.17g, %.17g], to: [%.17g, %.17g], value: [%.17g, "
            "%.17g], angle: "
            "%.17g, frame: body}\n",
            i, back ? b : a, load->y, back ? a : b, load->y, back ? load->w1 : load->w0,
            back ? load->w0 : load->w1, angle);
    }
    struct point_load *couple = &rod->point[rod->points++];
    *couple = (struct point_load){.x = random_between(numbers, 0, rod->length),
                                  .couple = random_between(numbers, -20, 20)};
    add(lines, "    moments:\n      - applied: {name: C, value: %.17g, at: [%.17g, 0]}\n", couple->couple,
        couple->x);
}

static int draws(void)
{
    return number_of("SECTIONS_DRAWS", 60);
}

static fbd_section *section_of(struct trial *trial, bool rests)
{
    fbd_statics *statics = rests ? fbd_statics_new(trial->state, NULL) : NULL;
    if (rests) assert_true(statics && fbd_statics_holds(statics));
    fbd_errors *errors = fbd_errors_new();
    fbd_section *section = fbd_section_new(trial->state, statics, "rod", errors);
    if (!section) fail_msg("%s", fbd_errors_get(errors, 0).message);
    fbd_errors_free(errors);
    fbd_statics_free(statics);
    return section;
}

/* ---- at rest: on a pin and a link in any direction */

static void beams_on_two_supports(void **unused)
{
    struct random_numbers numbers = {(uint64_t)number_of("SECTIONS_SEED", 71)};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws(); i++) {
        struct loaded_rod rod = {.length = random_between(&numbers, 0.5, 5)};
        struct lines lines = {.length = 0};
        const double L = rod.length, turn = random_between(&numbers, -1.4, 1.4),
                     m = random_between(&numbers, 0.5, 9);
        const double a = random_between(&numbers, 0, 0.4 * L), b = random_between(&numbers, 0.6 * L, L),
                     slope = random_between(&numbers, 0.4, 2.7);
        rod.mu = m / L;
        const double ax = a * cos(turn), ay = a * sin(turn), bx = b * cos(turn), by = b * sin(turn);
        add(&lines,
            "fbd: 1\nground: {points: {A: [%.17g, %.17g], B: [%.17g, %.17g]}}\nbodies:\n  rod:\n    shape: "
            "rod\n"
            "    mass: %.17g\n    from: [0, 0]\n    to: [%.17g, 0]\n    motion: planar\n    initial: {theta: "
            "%.17g}\n"
            "    points: {a: [%.17g, 0], b: [%.17g, 0]}\n",
            ax, ay, bx + cos(turn + slope), by + sin(turn + slope), m, L, turn, a, b);
        draw_loads(&numbers, &rod, turn, &lines);
        add(&lines, "couplings:\n  - pin: {name: A, between: [rod.a, ground.A]}\n"
                    "  - rod: {name: B, between: [rod.b, ground.B]}\nsimulate: {until: 1 s}\n");
        double sum[3];
        sum_of(&rod, sum);
        const double T = -(sum[2] - a * sum[1]) / ((b - a) * sin(slope));
        rod.point[rod.points++] = (struct point_load){.x = b, .fx = T * cos(slope), .fy = T * sin(slope)};
        rod.point[rod.points++] =
            (struct point_load){.x = a, .fx = -sum[0] - T * cos(slope), .fy = -sum[1] - T * sin(slope)};
        struct trial trial = trial_parse(lines.text);
        fbd_section *section = section_of(&trial, true);
        check_cuts(&checks, "beam", section, &rod);
        fbd_section_free(section);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- in motion: a rod that is free, or turns about a point */

static void rods_in_motion(void **unused)
{
    struct random_numbers numbers = {(uint64_t)number_of("SECTIONS_SEED", 72)};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < draws(); i++) {
        struct loaded_rod rod = {.length = random_between(&numbers, 0.5, 5)};
        struct lines lines = {.length = 0};
        const bool free = random_chance(&numbers, 0.5);
        const double L = rod.length, turn = random_between(&numbers, -3, 3),
                     m = random_between(&numbers, 0.5, 9);
        const double a = random_between(&numbers, 0, L);
        rod.mu = m / L;
        rod.omega = random_between(&numbers, -3, 3);
        add(&lines,
            "fbd: 1\nbodies:\n  rod:\n    shape: rod\n    mass: %.17g\n    from: [0, 0]\n    to: [%.17g, 0]\n"
            "    initial: {theta: %.17g, omega: %.17g}\n",
            m, L, turn, rod.omega);
        add(&lines, free ? "    motion: planar\n" : "    motion: {pivot: {point: [%.17g, 0]}}\n", a);
        draw_loads(&numbers, &rod, turn, &lines);
        add(&lines, "simulate: {until: 1 s}\n");
        double sum[3];
        sum_of(&rod, sum);
        const double square = rod.omega * rod.omega;
        if (free) {
            rod.alpha = (sum[2] - L / 2 * sum[1]) / (m * L * L / 12);
            rod.ax = sum[0] / m + square * L / 2;
            rod.ay = sum[1] / m - rod.alpha * L / 2;
        } else {
            const double I = m * L * L / 12 + m * (L / 2 - a) * (L / 2 - a);
            rod.alpha = (sum[2] - a * sum[1]) / I;
            rod.ax = square * a;
            rod.ay = -rod.alpha * a;
            const double gx = rod.ax - square * L / 2, gy = rod.ay + rod.alpha * L / 2;
            rod.point[rod.points++] =
                (struct point_load){.x = a, .fx = m * gx - sum[0], .fy = m * gy - sum[1]};
        }
        struct trial trial = trial_parse(lines.text);
        fbd_section *section = section_of(&trial, false);
        check_cuts(&checks, free ? "free" : "pivot", section, &rod);
        fbd_section_free(section);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- a chimney breaks at a third of its height */

static void a_falling_chimney(void **unused)
{
    struct random_numbers numbers = {73};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < trials; i++) {
        const double L = random_between(&numbers, 1, 50), m = random_between(&numbers, 1, 900),
                     theta = random_between(&numbers, 0.1, 1.5), omega = random_between(&numbers, -1, 0);
        struct lines lines = {.length = 0};
        add(&lines,
            "fbd: 1\nbodies:\n  rod: {shape: rod, mass: %.17g, length: %.17g, motion: {pivot: {point: "
            "left}}, initial: "
            "{theta: %.17g, omega: %.17g}, forces: [gravity]}\nsimulate: {until: 1 s}\n",
            m, L, theta, omega);
        struct trial trial = trial_parse(lines.text);
        fbd_section *section = section_of(&trial, false);
        const fbd_section_extreme M = fbd_section_extreme_of(section, 2, true),
                                  V = fbd_section_extreme_of(section, 1, false);
        check_close(&checks, "place of M", M.x, L / 3, 1e-9 * L);
        check_close(&checks, "M", M.value, m * 9.81 * L * cos(theta) / 27, digits * m * 10 * L);
        check_close(&checks, "place of V", V.x, 2 * L / 3, 1e-9 * L);
        check_close(&checks, "V", V.value, -m * 9.81 * cos(theta) / 12, digits * m * 10);
        fbd_section_free(section);
        trial_close(&trial);
    }
    checks_end(&checks);
}

/* ---- the ends of bodies of any length, at any distance from their pins */

static void every_row_of_a_table_has_numbers(void **unused)
{
    struct random_numbers numbers = {74};
    (void)unused;
    for (int i = 0; i < 1000; i++) {
        const double L = random_between(&numbers, 0.01, 30), x = random_between(&numbers, -1e3, 1e3),
                     y = random_between(&numbers, -1e3, 1e3), angle = random_between(&numbers, 0, 6.28);
        struct lines lines = {.length = 0};
        add(&lines,
            "fbd: 1\nbodies:\n  rod: {shape: rod, mass: 3, from: [%.17g, %.17g], to: [%.17g, %.17g], motion: "
            "{pivot: "
            "{point: left}}, initial: {theta: 1}, forces: [gravity]}\nsimulate: {until: 1 s}\n",
            x, y, x + L * cos(angle), y + L * sin(angle));
        struct trial trial = trial_parse(lines.text);
        fbd_section *section = section_of(&trial, false);
        const double length = fbd_section_length(section);
        char *json = fbd_section_json(section, NULL);
        assert_non_null(json);
        assert_null(strstr(json, "null"));
        const double ends[] = {nextafter(length, 2 * length), length * (1 + 1e-15), -1e-15 * length};
        for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
            const bool behind = ends[k] > 0;
            const fbd_cut cut = fbd_section_at(section, ends[k], behind);
            assert_true(cut.x == (behind ? length : 0) && cut.N == 0 && cut.V == 0 && cut.M == 0);
        }
        assert_true(isnan(fbd_section_at(section, 1.001 * length, false).M));
        free(json);
        fbd_section_free(section);
        trial_close(&trial);
    }
}

/* ---- a load of any form: w = w0 sin(pi s/L) on a beam; M = w0 (L/pi)^2 sin(pi x/L) */

static void a_load_of_another_form(void **unused)
{
    struct checks checks = {0};
    const double pi = 3.14159265358979323846, L = 3, w0 = 70;
    struct trial trial = trial_parse("fbd: 1\nground: {points: {A: [0, 0], B: [3, 1]}}\nbodies:\n  rod: "
                                     "{shape: rod, mass: 1, from: [0, 0], to: [3, "
                                     "0], motion: planar, forces: [distributed: {name: w, from: left, to: "
                                     "right, value: '70[N/m]*sin(pi*s/3[m])', "
                                     "angle: -90 deg}]}\ncouplings:\n  - pin: {name: A, between: [rod.left, "
                                     "ground.A]}\n  - rod: {name: B, between: "
                                     "[rod.right, ground.B]}\nsimulate: {until: 1 s}\n");
    fbd_section *section = section_of(&trial, true);
    (void)unused;
    for (int i = 1; i < 30; i++) {
        const double x = L * i / 30;
        const fbd_cut cut = fbd_section_at(section, x, false);
        check_close(&checks, "M", cut.M, w0 * L * L / pi / pi * sin(pi * x / L), 1e-9 * w0);
        check_close(&checks, "V", cut.V, w0 * L / pi * cos(pi * x / L), 1e-9 * w0);
    }
    check_close(&checks, "place", fbd_section_extreme_of(section, 2, true).x, L / 2, 1e-8);
    fbd_section_free(section);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- a thick plate: its rotary inertia is along its axis, not at its ends */

static void a_plate_and_a_bob(void **unused)
{
    struct checks checks = {0};
    struct trial trial = trial_parse(
        "fbd: 1\nbodies:\n  rod: {shape: prism, mass: 6, a: 2, b: 1, center: [1, 0], motion: {pivot: {}}, "
        "forces: [gravity]}\nsimulate: {until: 1 s}\n");
    fbd_section *section = section_of(&trial, false);
    (void)unused;
    /* I_O = m (a^2 + b^2)/12 + m = 6 (5/12 + 1) = 8.5; alpha = -m g/I_O */
    const double alpha = -6 * g / 8.5, mu = 3, iota = 3. / 12;
    for (int i = 1; i < 20; i++) {
        const double x = i / 10., s = 2 - x;
        /* beyond x: forces mu (-g - alpha r) at r, couples -iota alpha */
        const double M =
            -mu * g * s * s / 2 - mu * alpha * (x * s * s / 2 + s * s * s / 3) - iota * alpha * s;
        check_close(&checks, "plate", fbd_section_at(section, x, false).M, M, 1e-10 * 100);
    }
    fbd_section_free(section);
    trial_close(&trial);
    trial = trial_parse(
        "fbd: 1\nbodies:\n  rod: {parts: {r: {shape: rod, mass: 1, from: [0, 0], to: [2, 0]}, b: {shape: "
        "sphere, mass: 3, radius: 0.1, center: [2.1, 0]}}, motion: pivot, forces: [gravity]}\nsimulate: "
        "{until: 1 s}\n");
    section = section_of(&trial, false);
    const double I = 4. / 3 + 3 * (2.1 * 2.1 + 0.4 * 0.01), turn = -g * (1 + 3 * 2.1) / I;
    check_close(&checks, "tip", fbd_section_at(section, 2, false).V, 3 * (g + turn * 2.1), 1e-8);
    check_close(&checks, "couple at the tip", fbd_section_at(section, 2, false).M,
                -3 * (g + turn * 2.1) * 0.1 - 3 * 0.4 * 0.01 * turn, 1e-8);
    fbd_section_free(section);
    trial_close(&trial);
    checks_end(&checks);
}

/* ---- refusals */

static void expect(const char *body, const char *id)
{
    struct lines lines = {.length = 0};
    add(&lines, "fbd: 1\nbodies:\n  rod: %s\nsimulate: {until: 1 s}\n", body);
    struct trial trial = trial_parse(lines.text);
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_section_new(trial.state, NULL, "rod", errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, id);
    fbd_errors_free(errors);
    trial_close(&trial);
}

static void bodies_without_sections(void **unused)
{
    (void)unused;
    expect("{mass: 1, motion: particle}", "no-section");
    expect("{mass: 1, inertia: 2, motion: planar}", "no-section");
    expect("{shape: disc, mass: 1, radius: 1, motion: planar}", "no-section");
    expect("{shape: polygon, mass: 1, corners: [[0, 0], [-1, -2], [1, -2]], motion: pivot}", "no-section");
    expect("{shape: polygon, mass: 1, corners: [[0, 0], [4, 0], [4, 1], [0, 2]], motion: pivot}",
           "no-section");
    expect("{parts: {a: {shape: rod, mass: 1, from: [0, 0], to: [1, 0]}, b: {shape: rod, mass: 1, from: [0, "
           "0], to: "
           "[0, 1]}}, motion: planar}",
           "no-section");
    expect("{shape: rod, mass: 1, length: 1, motion: planar, moments: [applied: 2 N*m]}", "no-section");
    expect("{shape: rod, mass: 1, length: 1, motion: planar, forces: [distributed: {from: left, to: [3, 0], "
           "value: 2, "
           "angle: 0}]}",
           "no-section");
}

/* ---- roots */

static void roots_of_polynomials(void **unused)
{
    struct random_numbers numbers = {74};
    struct checks checks = {0};
    (void)unused;
    for (int i = 0; i < 400; i++) {
        struct polynomial p = {{random_between(&numbers, 0.5, 2)}};
        double known[6], found[polynomial_most];
        const int count = (int)random_between(&numbers, 0, 6.99);
        for (int k = 0; k < count; k++) {
            known[k] = -0.95 + 1.9 * (k + random_between(&numbers, 0, 0.9)) / count;
            p = polynomial_product(&p, &(struct polynomial){{-known[k], 1}});
        }
        assert_int_equal(polynomial_roots(&p, found), count);
        for (int k = 0; k < count; k++) check_close(&checks, "root", found[k], known[k], 1e-9);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_row_of_a_table_has_numbers),
        cmocka_unit_test(beams_on_two_supports),
        cmocka_unit_test(rods_in_motion),
        cmocka_unit_test(a_falling_chimney),
        cmocka_unit_test(a_load_of_another_form),
        cmocka_unit_test(a_plate_and_a_bob),
        cmocka_unit_test(bodies_without_sections),
        cmocka_unit_test(roots_of_polynomials),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
