/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tables: against GSL's own evaluation, and forces by random tables against the integrals of their pieces and against
 * the same kinks written out as expressions.
 *
 * FBD_TABLES=N runs N of each random kind (default 100), FBD_TABLE_SEED=S others.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_spline.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "expr/table.h"
#include "gallery.h"
#include "random_numbers.h"
#include "thorough.h"

enum { most_points = 40, text_room = 16384 };

static const char *const interpolation_names[] = {"linear", "step", "cubic", "akima", "steffen"};
static const char *const beyond_names[] = {"hold", "zero", "repeat", "error"};

static int wanted(void)
{
    const char *number = getenv("FBD_TABLES");
    return number ? (int)strtol(number, NULL, 10) : thorough() ? 100 : 10;
}

static struct random_numbers seeded(uint64_t offset)
{
    const char *seed = getenv("FBD_TABLE_SEED");
    return (struct random_numbers){offset + 1000 * (seed ? (uint64_t)strtol(seed, NULL, 10) : 1)};
}

static int pick(struct random_numbers *numbers, int count)
{
    return (int)random_between(numbers, 0, count);
}

/* ---- random points */

struct points {
    int count;
    double x[most_points], y[most_points];
    enum table_interpolation interpolation;
    enum table_beyond beyond;
};

/* Steps from a hundredth to one; some are even. */
static struct points random_points(struct random_numbers *numbers, enum table_interpolation interpolation,
                                   enum table_beyond beyond, double from)
{
    struct points p = {.count = 5 + pick(numbers, most_points - 5),
                       .interpolation = interpolation,
                       .beyond = beyond};
    bool even = pick(numbers, 3) == 0;
    double x = from;
    for (int i = 0; i < p.count; i++) {
        p.x[i] = x;
        p.y[i] = random_between(numbers, -5, 5);
        x += even ? 0.125 : pow(10, random_between(numbers, -2, 0));
    }
    if (beyond == table_repeat) p.y[p.count - 1] = p.y[0];
    return p;
}

static const gsl_interp_type *type_of(const struct points *p)
{
    bool periodic = p->beyond == table_repeat;
    switch (p->interpolation) {
    case table_cubic: return periodic ? gsl_interp_cspline_periodic : gsl_interp_cspline;
    case table_akima: return periodic ? gsl_interp_akima_periodic : gsl_interp_akima;
    case table_steffen: return gsl_interp_steffen;
    default: return gsl_interp_linear;
    }
}

/* The value and the slope within the points, without our code. */
static double plain(const struct points *p, const gsl_spline *spline, double x, double *slope)
{
    int last = p->count - 1, i = 0;
    if (p->beyond == table_repeat)
        x -= (p->x[last] - p->x[0]) * floor((x - p->x[0]) / (p->x[last] - p->x[0]));
    *slope = 0;
    if (x < p->x[0] || x > p->x[last]) {
        double end = x < p->x[0] ? p->y[0] : p->y[last];
        return p->beyond == table_hold ? end : p->beyond == table_zero ? 0 : (double)NAN;
    }
    while (i < last - 1 && p->x[i + 1] <= x) i++;
    if (p->interpolation == table_step) return p->y[i];
    *slope = gsl_spline_eval_deriv(spline, x, NULL);
    return gsl_spline_eval(spline, x, NULL);
}

static void tables_are_those_of_gsl(void **unused)
{
    struct random_numbers numbers = seeded(1);
    (void)unused;
    for (int trial = 0; trial < 20 * wanted(); trial++) {
        struct points p = random_points(&numbers, (enum table_interpolation)(trial % 5),
                                        (enum table_beyond)(trial / 5 % 4), random_between(&numbers, -3, 3));
        struct table table = {.interpolation = p.interpolation, .beyond = p.beyond};
        gsl_spline *spline = gsl_spline_alloc(type_of(&p), (size_t)p.count);
        assert_non_null(spline);
        gsl_spline_init(spline, p.x, p.y, (size_t)p.count);
        assert_int_equal(table_make(&table, (size_t)p.count, p.x, p.y), table_made);
        for (int k = 0; k < 100; k++) {
            double span = p.x[p.count - 1] - p.x[0], slope, f, d, dd;
            double x =
                k < p.count ? p.x[k] + 1e-7 : random_between(&numbers, p.x[0] - span, p.x[0] + 2.5 * span);
            double want = plain(&p, spline, x, &slope), piece = table_piece(&table, x);
            struct double_double low, high;
            table_slopes(&table, piece, x, &f, &d, &dd);
            table_ends(&table, piece, &low, &high);
            bool inside = low.x <= x && x <= high.x;
            bool same = isnan(want) ? isnan(f)
                                    : fabs(f - want) <= 1e-9 && fabs(d - slope) <= 1e-6 * (1 + fabs(slope));
            if (!inside || !same)
                print_message(
                    "seed %d of %s, %s: f(%.17g) = %.17g (%.9g), not %.17g (%.9g), in [%.17g, %.17g]\n",
                    trial, interpolation_names[p.interpolation], beyond_names[p.beyond], x, f, d, want, slope,
                    low.x, high.x);
            assert_true(inside && same);
        }
        gsl_spline_free(spline);
        table_drop(&table);
    }
}

/* ---- forces by random tables */

static void write_points(const struct points *p, const char *unit_x, const char *unit_y, char *text,
                         size_t *used)
{
    for (int i = 0; i < p->count; i++)
        *used += (size_t)snprintf(text + *used, text_room - *used, "%s[%.17g%s, %.17g%s]", i ? ", " : "",
                                  p->x[i], unit_x, p->y[i], unit_y);
}

/* The integral of the table from its first point to x, and of (x - s) f(s): velocity and place of a unit mass. By
 * the two-point rule of Gauss in each piece, exact to the third degree. */
static void integrate(const struct points *p, const gsl_spline *spline, double to, double *v, double *s)
{
    double at = 0, node = 0.57735026918962576451, span = p->x[p->count - 1] - p->x[0];
    *v = *s = 0;
    while (at < to) {
        /* The next place where the formula changes. */
        double next = to, start = p->beyond == table_repeat ? floor((at + 1e-12 - p->x[0]) / span) * span : 0;
        for (int period = 0; period < 2; period++)
            for (int i = 0; i < p->count; i++) {
                double x = p->x[i] + start + period * (p->beyond == table_repeat ? span : 0);
                if (x > at + 1e-12 && x < next) next = x;
            }
        double half = (next - at) / 2, middle = at + half, slope, sum = 0, moment = 0;
        for (int side = -1; side <= 1; side += 2) {
            double x = middle + side * node * half, f = plain(p, spline, x, &slope);
            sum += f * half;
            moment += f * half * (to - x);
        }
        /* (to - x) f is of the fourth degree: its error is half^5/135 times the fourth derivative, -4 f'''. */
        double third = 0;
        if (p->interpolation >= table_cubic) {
            double left, right, h = half * 0.5;
            plain(p, spline, middle - h, &left);
            plain(p, spline, middle + h, &right);
            double centre;
            plain(p, spline, middle, &centre);
            third = (left - 2 * centre + right) / (h * h);
        }
        moment += pow(half, 5) / 135 * -4 * third;
        *v += sum;
        *s += moment;
        at = next;
    }
}

static void a_force_by_a_table_of_time(void **unused)
{
    struct random_numbers numbers = seeded(2);
    struct checks checks = {0};
    char text[text_room];
    (void)unused;
    for (int trial = 0; trial < wanted(); trial++) {
        struct points p =
            random_points(&numbers, (enum table_interpolation)(trial % 5), (enum table_beyond)(trial / 5 % 3),
                          random_between(&numbers, -0.5, 0.5));
        if (p.beyond == table_repeat && p.x[0] > 0) p.beyond = table_hold;
        double until = random_between(&numbers, 0.5, p.x[p.count - 1] + 1), v, s;
        gsl_spline *spline = gsl_spline_alloc(type_of(&p), (size_t)p.count);
        gsl_spline_init(spline, p.x, p.y, (size_t)p.count);
        integrate(&p, spline, until, &v, &s);
        gsl_spline_free(spline);
        size_t used = (size_t)snprintf(text, sizeof text, "fbd: 1\ntables:\n  f:\n    points: [");
        write_points(&p, " s", " N", text, &used);
        snprintf(text + used, text_room - used,
                 "]\n    interpolation: %s\n    beyond: %s\nbodies:\n  b: {mass: 1, motion: slide, forces: "
                 "[applied: f(t)]}\n"
                 "simulate: {until: %.17g}\n",
                 interpolation_names[p.interpolation], beyond_names[p.beyond], until);
        struct trial run = trial_parse(text);
        trial_start(&run, NULL);
        trial_finish(&run);
        bool fine_0 = check_close(&checks, "v", trial_get(&run, "b.v"), v, 1e-9 * (1 + fabs(v)));
        bool fine_1 = check_close(&checks, "x", trial_get(&run, "b.x"), s, 1e-9 * (1 + fabs(s)));
        bool fine = fine_0 && fine_1;
        if (!fine) print_message("trial %d:\n%s", trial, text);
        trial_close(&run);
    }
    checks_end(&checks);
}

/* A broken line is a sum of hinges: y_0 + sum of (change of slope) max(x - x_i, 0). */
static void a_force_by_a_table_of_place(void **unused)
{
    static const char *const methods[] = {"auto", "dop853", "rodas5p", "msadams"};
    struct random_numbers numbers = seeded(3);
    struct checks checks = {0};
    char text[text_room], hinges[text_room];
    (void)unused;
    for (int trial = 0; trial < wanted(); trial++) {
        struct points p = random_points(&numbers, table_linear, table_hold, -1.5);
        if (p.count > 12) p.count = 12;
        for (int i = 0; i < p.count; i++) p.y[i] -= 8 * p.x[i];
        size_t used = (size_t)snprintf(hinges, sizeof hinges, "%.17g[N]", p.y[0]);
        double before = 0;
        for (int i = 0; i < p.count; i++) {
            double slope = i + 1 < p.count ? (p.y[i + 1] - p.y[i]) / (p.x[i + 1] - p.x[i]) : 0;
            used += (size_t)snprintf(hinges + used, sizeof hinges - used,
                                     " + (%.17g[N/m])*max(x - (%.17g[m]), 0)", slope - before, p.x[i]);
            before = slope;
        }
        double v = random_between(&numbers, -3, 3), c = random_between(&numbers, 0, 1), end[2][2];
        for (int form = 0; form < 2; form++) {
            used = (size_t)snprintf(text, sizeof text, "fbd: 1\ntables:\n  f:\n    points: [");
            write_points(&p, " m", " N", text, &used);
            snprintf(text + used, text_room - used,
                     "]\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    initial: {v: %.17g}\n    "
                     "forces:\n      - damper: "
                     "%.17g\n      - applied: {name: f, value: \"%s\"}\n      - applied: {name: g, value: "
                     "\"0*f(x)\"}\n"
                     "simulate: {until: 3, method: %s}\n",
                     v, c, form ? hinges : "f(x)", methods[trial % 4]);
            struct trial run = trial_parse(text);
            trial_start(&run, NULL);
            trial_finish(&run);
            end[form][0] = trial_get(&run, "b.x");
            end[form][1] = trial_get(&run, "b.v");
            trial_close(&run);
        }
        bool fine_0 = check_close(&checks, "x", end[0][0], end[1][0], 1e-7);
        bool fine_1 = check_close(&checks, "v", end[0][1], end[1][1], 1e-7);
        bool fine = fine_0 && fine_1;
        if (!fine) print_message("trial %d:\n%s", trial, text);
    }
    checks_end(&checks);
}

/* ---- ends */

static double end_of(const struct trial *run)
{
    double from, to;
    fbd_simulation_interval(run->simulation, &from, &to);
    return to;
}

static void a_run_ends_where_a_table_does(void **unused)
{
    static const char scene[] =
        "fbd: 1\ntables: {f: {points: [[0, 1], [1.5, 2]], beyond: error}}\nbodies:\n  b: {mass: 1, "
        "motion: slide, forces: [applied: f(t)]}\nsimulate: {until: %s}\n";
    struct checks checks = {0};
    char text[400];
    (void)unused;
    snprintf(text, sizeof text, scene, "2");
    struct trial run = trial_parse(text);
    trial_run(&run, NULL);
    check_that(&checks, "broken", run.outcome == FBD_BROKEN);
    check_that(&checks, "by name",
               strstr(fbd_simulation_reason(run.simulation), "the table `f` ends") != NULL);
    check_close(&checks, "there", end_of(&run), 1.5, 1e-11);
    trial_close(&run);
    snprintf(text, sizeof text, scene, "1.5");
    run = trial_parse(text);
    trial_run(&run, NULL);
    check_that(&checks, "up to its last point it is whole", run.outcome == FBD_DONE);
    trial_close(&run);
    checks_end(&checks);
}

/* Corners of what is prescribed have no velocity; a spline has, and its drive does the work. */
static void a_prescribed_motion_may_not_jump(void **unused)
{
    static const struct {
        const char *law;
        double ends; /* NAN: it does not */
    } cases[] = {
        {"abs(t - 1[s])*0.1[m/s]", 1},
        {"0.1[m]*step(t - 0.5[s])", 0.5},
        {"lift(t)", (double)NAN},
        {"0.5[m]*line(t)", 0.75},
        {"0.1[m]*max(t/1[s] - 1, 0)^2", (double)NAN},
    };
    struct checks checks = {0};
    char text[1000];
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        snprintf(text, sizeof text,
                 "fbd: 1\ntables:\n  lift: {points: [[0, 0], [1, 0.2], [2, 0.1], [4, 0.3]], interpolation: "
                 "cubic}\n  line: "
                 "{points: [[0, 0], [0.75, 1], [3, 0]]}\nbodies:\n  s: {mass: 1, motion: {slide: {x: "
                 "\"%s\"}}}\n  p: {shape: "
                 "rod, mass: 1, length: 1, motion: {pivot: {on: s, point: left}}, initial: {theta: -1}, "
                 "forces: [gravity]}\n"
                 "simulate: {until: 3}\n",
                 cases[i].law);
        fbd_errors *errors = fbd_errors_new();
        struct trial run = {.model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, errors)};
        assert_non_null(run.model);
        run.state = fbd_state_new(run.model);
        fbd_errors_free(errors);
        trial_run(&run, NULL);
        bool ends = !isnan(cases[i].ends);
        check_that(&checks, cases[i].law, (run.outcome == FBD_BROKEN) == ends);
        if (ends) check_close(&checks, "there", end_of(&run), cases[i].ends, 1e-12);
        if (!ends) check_close(&checks, "residual", fbd_result_energy(run.result).residual, 0, 1e-9);
        trial_close(&run);
    }
    checks_end(&checks);
}

/* ---- in each other, and late */

struct composed {
    const char *value;
    double until, v; /* from rest, of a unit mass */
};

/* Against a fine quadrature of the same formulas by hand. */
static void tables_of_tables(void **unused)
{
    static const struct composed cases[] = {
        /* load is broken at 1.05 s; sin passes 0.6 at 0.1024 and 0.3976 s and once a second from there */
        {"if(sin(2*pi*t/1[s]) > 0.6, 1[N], 0) + load(t)", 2.5, 1.155052987953882},
        /* the same switch without a table */
        {"step(sin(2*pi*t/1[s]) - 0.6)*1[N] + 0[N]*step(t - 1.05[s])", 2.5, 0.885501705902600},
        /* a knot that is touched where |t - 0.5| turns */
        {"1[N]*ramp(abs(t/1[s] - 0.5))", 2, 0.75 + 2 + 1.5},
        {"1[N]*ramp(1 - ramp(t/1[s]))", 1, 0},
        {"1[N]*saw(saw(t/1[s]))", 3, 0},
        {"1[N]*wave(t + 1e9[s])", 1.025, 0.025},
    };
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1500];
        snprintf(
            text, sizeof text,
            "fbd: 1\ntables:\n  load: [[0 s, 0 N], [1.05 s, 0 N], [3 s, 0.5 N]]\n  ramp: [[0, 1], [1, 3]]\n  "
            "saw: "
            "{points: [[0, -1], [1, 1], [2, -1]], beyond: repeat}\n  wave: {points: [[0 s, 1], [0.5 s, -1], "
            "[1 s, 1]], "
            "interpolation: step, beyond: repeat}\nbodies:\n  b: {mass: 1, motion: slide, forces: [applied: "
            "\"%s\"]}\nsimulate: {until: %.17g}\n",
            cases[i].value, cases[i].until);
        fbd_errors *errors = fbd_errors_new();
        struct trial run = {.model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, errors)};
        if (!run.model) fbd_errors_print(errors, stdout);
        fbd_errors_free(errors);
        assert_non_null(run.model);
        run.state = fbd_state_new(run.model);
        trial_start(&run, NULL);
        trial_finish(&run);
        double want = cases[i].v;
        if (want == 0) { /* saw(saw(t)) and ramp(1 - ramp(t)): summed here */
            enum { parts = 300000 };
            for (int k = 0; k < parts; k++) {
                double t = (k + 0.5) * cases[i].until / parts, saw = fabs(fmod(t, 2) - 1) * -2 + 1;
                double inner = 1 - (1 + 2 * fmin(t, 1)), of_saw = saw < 0 ? saw + 2 : saw;
                double f = strstr(cases[i].value, "ramp") ? 1 + 2 * fmin(fmax(inner, 0), 1)
                                                          : fabs(of_saw - 1) * -2 + 1;
                want += f * cases[i].until / parts;
            }
        }
        check_close(&checks, cases[i].value, trial_get(&run, "b.v"), want, cases[i].v == 0 ? 1e-6 : 1e-9);
        trial_close(&run);
    }
    checks_end(&checks);
}

/* A corner of |x - 0.5| at a knot, with the motion: by energy. */
static void a_knot_that_is_touched_is_passed(void **unused)
{
    struct checks checks = {0};
    (void)unused;
    struct trial run = trial_parse(
        "fbd: 1\ntables: {f: [[0, 1], [1, 3]]}\nbodies:\n  b: {mass: 1, motion: slide, initial: {v: "
        "3}, forces: [applied: \"1[N]*f(abs(x/1[m] - 0.5))\"]}\nsimulate: {until: 1}\n");
    trial_start(&run, NULL);
    trial_finish(&run);
    double x = trial_get(&run, "b.x");
    check_that(&checks, "it gets past the table's end", x > 1.5);
    check_close(&checks, "energy", 0.5 * pow(trial_get(&run, "b.v"), 2), 4.5 + 0.75 + 2 + 3 * (x - 1.5),
                1e-8);
    trial_close(&run);
    checks_end(&checks);
}

/* Steps past counting are not taken for one. */
static void what_is_past_counting_is_said_so(void **unused)
{
    static const char *const values[] = {"1[N]*wave(t + 1.7e9[s])", "1[N]*square((t - 1e9[s])/0.1[s])"};
    struct checks checks = {0};
    (void)unused;
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char text[600];
        snprintf(text, sizeof text,
                 "fbd: 1\ntables: {wave: {points: [[0 s, 1], [0.5 s, -1], [1 s, 1]], interpolation: step, "
                 "beyond: repeat}}\nbodies:"
                 "\n  b: {mass: 1, motion: slide, forces: [applied: \"%s\", applied: {name: u, value: "
                 "0*wave(t)}]}\nsimulate: "
                 "{until: 1}\n",
                 values[i]);
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, errors);
        if (!model) fbd_errors_print(errors, stdout);
        assert_non_null(model);
        fbd_simulation *simulation = fbd_simulation_new(model, NULL, errors);
        fbd_outcome outcome = FBD_FAILED;
        while (simulation && (outcome = fbd_simulation_advance(simulation)) == FBD_GOING) continue;
        check_that(&checks, values[i], outcome != FBD_DONE);
        fbd_simulation_free(simulation);
        fbd_model_free(model);
        fbd_errors_free(errors);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_those_of_gsl),
        cmocka_unit_test(a_force_by_a_table_of_time),
        cmocka_unit_test(a_force_by_a_table_of_place),
        cmocka_unit_test(a_run_ends_where_a_table_does),
        cmocka_unit_test(a_prescribed_motion_may_not_jump),
        cmocka_unit_test(tables_of_tables),
        cmocka_unit_test(a_knot_that_is_touched_is_passed),
        cmocka_unit_test(what_is_past_counting_is_said_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
