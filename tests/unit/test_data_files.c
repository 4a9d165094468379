/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Files of data: the ways in which they are written and in which they are wrong, and the models that use some.
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
#include <unistd.h>

#include "gallery.h"
#include "random_numbers.h"
#include "scene/data_file.h"
#include "thorough.h"

/* ---- files */

struct file_case {
    const char *text, *keys;
    double at, value; /* of the force [N] at a time [s] */
    const char *id;   /* of the first error, or NULL */
};

static const struct file_case file_cases[] = {
    {"t [s],F [N]\n0,1\n1,3\n", "", 0.5, 2, NULL},
    {"t [ms],F [kN]\n0,1\n1000,3\n", "", 0.5, 2000, NULL},
    {"t (ms);F (kN)\r\n0;1\r\n1000;3\r\n", "", 0.5, 2000, NULL},
    {"0 1\n1\t3\n", "", 0.5, 2, NULL},
    {"0   1\n\n  1 3", "", 0.5, 2, NULL},
    {"0,0;1,0\n1,0;3,5\n", "", 1, 3.5, NULL},
    {"\xEF\xBB\xBF\"time, s\",\"force\"\n0,1\n1,3\n", ", x: \"time, s\", y: \"force [N]\"", 0.5, 2, NULL},
    {"# rig 4\n# t [s], F [N], T [N]\n0,1,5\n# pause\n1,3,7\n", ", y: T", 0.5, 6, NULL},
    {"a,b,c\n0,9,1\n1,9,3\n", ", x: \"a [s]\", y: \"c [N]\"", 0.5, 2, NULL},
    {"0,9,1\n1,9,3\n", ", x: 1, y: 3", 0.5, 2, NULL},
    {"t,F\n0,1\n0,1\n1,3\n", "", 0.5, 2, NULL},
    {"t,F\r0,1\r1,3\r", "", 0.5, 2, NULL},
    {"t [s],F [N]\n0,1\n1,3\n", ", y: T", 0, 0, "unknown-column"},
    {"t [s],F [N]\n0,1\n1,3\n", ", y: \"F [kN]\"", 0, 0, "wrong-dimension"},
    {"t [s],F [m]\n0,1\n1,3\n", "", 0, 0, "wrong-dimension"},
    {"t [s],F [N]\n0,1\n1,x\n", "", 0, 0, "table-format"},
    {"t [s],F [N]\n0,1\n1\n", "", 0, 0, "table-format"},
    {"t [s],F [N]\n0,1\n1,\n", "", 0, 0, "table-format"},
    {"t [s],F [N]\n0,1\n1,nan\n", "", 0, 0, "table-format"},
    {"t [s],F [N]\n0,1\n1,1e999\n", "", 0, 0, "table-format"},
    {"t [s],F [N]\n0,1\n2,3\n1,3\n", "", 0, 0, "table-order"},
    {"t [s],F [N]\n0,1\n0,3\n", "", 0, 0, "table-order"},
    {"t [s],F [N]\n0,1\n", "", 0, 0, "table-points"},
    {"t [s],F [N]\n0,1\n1,2\n2,3\n", ", interpolation: akima", 0, 0, "table-points"},
    {"t [s],F [N]\n0,1\n1,2\n2,3\n", ", interpolation: cubic, beyond: repeat", 0, 0, "table-points"},
    {"t [s],F [furlong]\n0,1\n1,2\n", "", 0, 0, "unknown-unit"},
    {"t,t\n0,1\n1,3\n", ", x: t", 0, 0, "unknown-column"},
    {"t,F\n0,1\n1,3\n", ", y: t", 0, 0, "unknown-column"},
    {"0,100O\n1,0\n2,0\n", "", 0, 0, "table-format"},
    {"0,nan\n1,0\n2,0\n", "", 0, 0, "table-format"},
    {"t [s],F [kN] (raw)\n0,1\n1,3\n", "", 0.5, 2000, NULL},
    {"run,t,F\na,0,1\nb,1,3\n", ", x: t, y: F", 0.5, 2, NULL},
    {"a,0,1\nb,1,3\n", ", x: 2, y: 3", 0.5, 2, NULL},
    {"", "", 0, 0, "table-format"},
    {"t,F\n", "", 0, 0, "table-format"},
    {"t [ms] F [kN]\n0 1\n1000 3\n", "", 0.5, 2000, NULL},
    {"t\tF\n0,0\t1,0\n1,0\t3,5\n", "", 1, 3.5, NULL},
    {"\"t; s\",F\n0,1\n1,3\n", "", 0.5, 2, NULL},
    {"t [s],F [N],\n0,1,\n1,3,\n", "", 0.5, 2, NULL},
    {"t [s],F [N]\n0,0,1,0\n1,0,3,5\n", "", 0, 0, "table-format"}, /* decimal commas */
    {"t [s],F [N]\n0,1\n1,3,5\n", "", 0, 0, "table-format"},
    {"0,1\n1,3,5\n", "", 0, 0, "table-format"},
    {"t,F\ns,N\n0,1\n1,3\n", "", 0, 0, "table-format"},
    {"\xFF\xFEt", "", 0, 0, "table-format"}, /* UTF-16 */
    {"t [s],F [N]\n0,1e300\n1e-300,-1e300\n", "", 0, 0, "table-points"},
};

static void write_file(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(text, 1, strlen(text), file);
    assert_int_equal(fclose(file), 0);
}

static void files_are_read_as_they_are_written(void **unused)
{
    char path[] = "/tmp/fbd-table-XXXXXX", text[1000];
    struct checks checks = {0};
    (void)unused;
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    for (size_t i = 0; i < sizeof file_cases / sizeof *file_cases; i++) {
        const struct file_case *c = &file_cases[i];
        write_file(path, c->text);
        snprintf(text, sizeof text,
                 "fbd: 1\ntables:\n  f: {file: %s%s}\nbodies:\n  b:\n    mass: 1\n    motion: slide\n    "
                 "forces: [applied: "
                 "\"f(%.17g[s])\"]\n",
                 path, c->keys, c->at);
        fbd_errors *errors = fbd_errors_new();
        fbd_model *model = fbd_model_parse(text, strlen(text), "scene", NULL, 0, errors);
        const fbd_error first = fbd_errors_get(errors, 0);
        bool as_said = c->id ? first.id && strcmp(first.id, c->id) == 0 : model && !first.id;
        check_that(&checks, c->text, as_said);
        if (!as_said) fbd_errors_print(errors, stdout);
        if (model) {
            struct trial trial = {.model = model, .state = fbd_state_new(model)};
            if (!c->id) check_close(&checks, c->keys, trial_acceleration(&trial, "b.x"), c->value, 1e-12);
            trial_close(&trial);
        }
        fbd_errors_free(errors);
    }
    remove(path);
    checks_end(&checks);
}

/* Read `text` as a table; does a note show `secret`? */
static bool is_shown(const char *path, const char *text, const char *keys, const char *secret)
{
    char model_text[400];
    bool shown = false;
    write_file(path, text);
    snprintf(model_text, sizeof model_text, "fbd: 1\ntables:\n  f: {file: %s%s}\n", path, keys);
    fbd_errors *errors = fbd_errors_new();
    fbd_model_free(fbd_model_parse(model_text, strlen(model_text), "scene", NULL, 0, errors));
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error note = fbd_errors_get(errors, i);
        shown = shown || strstr(note.message, secret) || (note.hint && strstr(note.hint, secret));
    }
    assert_true(fbd_errors_count(errors) > 0);
    fbd_errors_free(errors);
    return shown;
}

/* Whoever runs the model of somebody else shows him no line of a file with passwords, wherever reading ends. */
static void what_is_no_table_is_not_shown(void **unused)
{
    static const char *const keys[] = {"", ", x: 2, y: 1", ", x: SEKRET, y: 3", ", x: SECRE, y: SECRT"};
    static const char *const cells[] = {
        "SECRET",          "SECRET7",    "0",     "12",         "-1.5e3",     "SECRET:x:0",
        "\"SECRET word\"", "",           "#",     "1e999",      "SECRET,1",   "0x1SECRET",
        "[SECRET]",        "t [SECRET]", "t [s]", "SECRET [N]", "a (SECRET)", "SECRET \"x\""};
    static const char *const separators[] = {" ", ",", ";", "\t", ":", ", "};
    char path[] = "/tmp/fbd-table-XXXXXX", text[2000];
    struct checks checks = {0};
    struct random_numbers numbers = {20};
    (void)unused;
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    check_that(&checks, "a heading of a table is", is_shown(path, "t,SECRET\n0,1\n", ", y: SECRE", "SECRET"));
    for (int draw = 0; draw < draws_of(200); draw++) {
        const char *separator = separators[random_bits(&numbers) % 6];
        int lines = (int)(random_bits(&numbers) % 5), used = 0;
        for (int line = 0; line < lines; line++)
            for (int cell = 0, count = 1 + (int)(random_bits(&numbers) % 4); cell < count; cell++)
                used += snprintf(text + used, sizeof text - (size_t)used, "%s%s",
                                 cells[random_bits(&numbers) % (sizeof cells / sizeof *cells)],
                                 cell + 1 < count ? separator : "\n");
        snprintf(text + used, sizeof text - (size_t)used, "0%sSECRET\n", separator); /* no row of numbers */
        for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
            check_that(&checks, text, !is_shown(path, text, keys[k], "SECRET"));
    }
    remove(path);
    checks_end(&checks);
}

static void files_that_are_read_are_known(void **unused)
{
    static const char text[] =
        "fbd: 1\ntables: {f: {file: /nowhere/f.csv}, g: {file: /nowhere/f.csv}, h: {file: h.csv}}\n";
    struct checks checks = {0};
    (void)unused;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), "scenes/a.yaml", NULL, 0, errors);
    const char *missing = fbd_errors_file(errors, 0), *beside = fbd_errors_file(errors, 1);
    check_that(&checks, "none is a model", !model);
    check_that(&checks, "what is missing", missing && strcmp(missing, "/nowhere/f.csv") == 0);
    check_that(&checks, "once, then the next", beside && strcmp(beside, "scenes/h.csv") == 0);
    check_that(&checks, "no more", !fbd_errors_file(errors, 2));
    fbd_errors_free(errors);
    checks_end(&checks);
}

/* Two tables of one file read it once: what stands in it meanwhile is not seen. */
static void a_file_is_read_once(void **unused)
{
    char path[] = "/tmp/fbd-table-XXXXXX";
    const char *const wanted[2][2] = {{"t", "F"}, {"t", "G"}};
    const struct data_places nowhere = {{0, 0}, {{0, 0}, {0, 0}}};
    struct checks checks = {0};
    (void)unused;
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    write_file(path, "t,F,G\n0,1,5\n1,3,7\n");
    fbd_errors *errors = fbd_errors_new();
    struct data_text kept = {0};
    for (int i = 0; i < 2; i++) {
        struct data_columns columns;
        bool read = data_file_read(path, wanted[i], &nowhere, &kept, errors, &columns);
        check_that(&checks, "it is read", read && columns.count == 2);
        if (read) check_close(&checks, "value", columns.values[1][1], i ? 7 : 3, 0);
        data_columns_free(&columns);
        write_file(path, "nothing of that\n");
    }
    data_text_free(&kept);
    fbd_errors_free(errors);
    remove(path);
    checks_end(&checks);
}

/* ---- the models */

/* The hammer by its trapezoids. */
static void a_measured_blow(void **unused)
{
    static const double t[] = {0, 0.02, 0.035, 0.06, 0.11, 0.15, 0.2}, F[] = {0, 180, 240, 90, -15, 0, 0};
    struct checks checks = {0};
    (void)unused;
    struct trial run = trial_open("data/measured_push.yaml", NULL);
    trial_start(&run, NULL);
    double x = 0, v = 0, m = 3;
    for (int i = 0; i < 6; i++) {
        double h = t[i + 1] - t[i];
        x += v * h + h * h / m * (F[i] / 3 + F[i + 1] / 6);
        v += h / m * (F[i] + F[i + 1]) / 2;
        trial_to(&run, t[i + 1]);
        check_close(&checks, "x", trial_get(&run, "x"), x, 1e-13);
        check_close(&checks, "v", trial_get(&run, "v"), v, 1e-12);
    }
    check_close(&checks, "the area", v, 3.55, 1e-12);
    trial_close(&run);
    checks_end(&checks);
}

/* A quarter car by its transition matrix: over a piece of the road, a cubic in t, the state z of z' = A z + b u(t) is
 * the sum of b_k t^k by Taylor series, independent of any integrator. */
struct quarter_car {
    double m_b, m_w, k, c, k_t;
};

static void car_rate(const struct quarter_car *car, const double z[4], double h, double rate[4])
{
    double force = car->k * (z[0] - z[1]) + car->c * (z[2] - z[3]);
    rate[0] = z[2];
    rate[1] = z[3];
    rate[2] = -force / car->m_b;
    rate[3] = (force - car->k_t * (z[1] - h)) / car->m_w;
}

/* Over a time h, in which the road is r[0] + r[1] t + r[2] t^2 + r[3] t^3. */
static void car_advance(const struct quarter_car *car, double z[4], const double r[4], double h)
{
    enum { terms = 60 };
    double term[4], sum[4] = {z[0], z[1], z[2], z[3]}, power = 1;
    memcpy(term, z, sizeof term);
    for (int n = 0; n < terms; n++) { /* term is the coefficient of t^n */
        double next[4];
        car_rate(car, term, n < 4 ? r[n] : 0, next);
        power *= h;
        for (int i = 0; i < 4; i++) {
            term[i] = next[i] / (n + 1);
            sum[i] += term[i] * power;
        }
    }
    memcpy(z, sum, sizeof sum);
}

static void a_car_on_a_road(const char *data, size_t points, const double *s, const double *h, double until,
                            struct checks *checks)
{
    const struct quarter_car car = {320, 40, 22e3, 1.6e3, 190e3};
    const double V = 10;
    double z[4] = {0};
    gsl_spline *road = gsl_spline_alloc(gsl_interp_cspline, points);
    gsl_spline_init(road, s, h, points);
    gsl_interp_accel *near = gsl_interp_accel_alloc();
    double at = 0;
    for (size_t i = 0; i + 1 < points && at < until; i++) {
        double r[4] = {h[i], gsl_spline_eval_deriv(road, s[i], near) * V,
                       gsl_spline_eval_deriv2(road, s[i], near) / 2 * V * V, 0};
        double width = (s[i + 1] - s[i]) / V, step = fmin(width, until - at);
        r[3] = ((h[i + 1] - h[i]) / width - r[1] - r[2] * width) / (width * width);
        car_advance(&car, z, r, step);
        at += step;
    }
    const double level[4] = {h[points - 1], 0, 0, 0};
    while (at < until) {
        double step = fmin(0.01, until - at);
        car_advance(&car, z, level, step);
        at += step;
    }
    gsl_interp_accel_free(near);
    gsl_spline_free(road);
    char set[200], end[64];
    snprintf(set, sizeof set, "h=%s", data);
    snprintf(end, sizeof end, "%.17g", until);
    struct trial run = trial_open("data/measured_road.yaml", data[0] ? SET(set) : NULL);
    const fbd_options options = {.until = until};
    trial_start(&run, &options);
    trial_finish(&run);
    static const char *const names[] = {"body.x", "wheel.x", "body.v", "wheel.v"};
    for (int i = 0; i < 4; i++) check_close(checks, names[i], trial_get(&run, names[i]), z[i], 1e-10);
    trial_close(&run);
}

static size_t read_road(const char *path, double *s, double *h, size_t room)
{
    char line[200], full[400];
    size_t count = 0;
    snprintf(full, sizeof full, "%s/models/data/%s", getenv("FBD_SOURCE_ROOT"), path);
    FILE *file = fopen(full, "r");
    assert_non_null(file);
    while (count < room && fgets(line, sizeof line, file)) {
        char *end;
        s[count] = strtod(line, &end);
        if (end == line || *end != ',') continue; /* headings */
        h[count++] = strtod(end + 1, NULL) / 1000;
    }
    fclose(file);
    return count;
}

static void the_quarter_car_follows_its_road(void **unused)
{
    enum { long_road = 100000 };
    struct checks checks = {0};
    struct random_numbers numbers = {7};
    double *s = calloc(long_road, sizeof *s), *h = calloc(long_road, sizeof *h);
    (void)unused;
    assert_true(s && h);
    size_t points = read_road("measured_road.csv", s, h, long_road);
    assert_int_equal(points, 241);
    a_car_on_a_road("", points, s, h, 3, &checks);

    /* A road of 1e5 points, 1 mm apart. */
    char path[] = "/tmp/fbd-road-XXXXXX";
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "w");
    assert_non_null(file);
    fprintf(file, "s [m],h [mm]\n");
    for (size_t i = 0; i < long_road; i++) {
        s[i] = (double)i / 1000;
        h[i] = 5 * sin(0.7 * s[i]) + 2 * sin(3.1 * s[i] + 1) + random_between(&numbers, -0.05, 0.05);
        fprintf(file, "%.3f,%.17g\n", s[i], h[i]);
        h[i] /= 1000;
    }
    assert_int_equal(fclose(file), 0);
    a_car_on_a_road(path, long_road, s, h, thorough() ? 11 : 1, &checks);
    remove(path);
    free(s);
    free(h);
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_are_read_as_they_are_written),
        cmocka_unit_test(what_is_no_table_is_not_shown),
        cmocka_unit_test(files_that_are_read_are_known),
        cmocka_unit_test(a_file_is_read_once),
        cmocka_unit_test(a_measured_blow),
        cmocka_unit_test(the_quarter_car_follows_its_road),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
