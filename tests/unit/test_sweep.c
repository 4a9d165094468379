/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sweeps: which values the runs get, and that their rows are those of the runs by themselves.
 */
#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "base/file.h"
#include "base/text.h"
#include "fbd.h"
#include "scene/scene.h"

static const char projectile[] =
    "fbd: 1\n"
    "parameters: {m: 2 kg, v0: 3 m/s, h: 0 m}\n"
    "bodies:\n"
    "  ball:\n"
    "    mass: m\n"
    "    motion: particle\n"
    "    initial: {y: h, vx: v0, vy: 4}\n"
    "    forces: [gravity]\n"
    "simulate:\n"
    "  until: 5 s\n"
    "  events: [{name: top, when: vy < 0}, {name: land, when: y < h - 1, then: stop}]\n";

/* ---- one sweep as text */

struct table {
    fbd_sweep *sweep;
    fbd_errors *errors;
    struct text rows;
    fbd_sweep_counts counts;
    fbd_sweep_end end;
};

static int append(void *context, const char *rows, size_t length)
{
    text_add_bytes(context, rows, length);
    return 0;
}

#define TEXTS(...) ((const char *const[]){__VA_ARGS__, NULL})

static size_t count_texts(const char *const *texts)
{
    size_t count = 0;
    while (texts && texts[count]) count++;
    return count;
}

static fbd_sweep_plan plan_of(const char *const *vary, const char *const *outputs)
{
    return (fbd_sweep_plan){.vary = vary,
                            .vary_count = count_texts(vary),
                            .outputs = outputs,
                            .output_count = count_texts(outputs),
                            .seed = 1,
                            .run = FBD_OPTIONS_DEFAULT};
}

static struct table open_table(const char *text, const fbd_sweep_plan *plan)
{
    struct table table = {.errors = fbd_errors_new()};
    assert_non_null(table.errors);
    table.sweep = fbd_sweep_parse(text, strlen(text), "test.yaml", plan, table.errors);
    return table;
}

static struct table sweep_by(const char *text, const fbd_sweep_plan *plan, size_t first, size_t jobs)
{
    struct table table = open_table(text, plan);
    if (!table.sweep) fbd_errors_print(table.errors, stderr);
    assert_non_null(table.sweep);
    const fbd_sweep_work work = {.first = first,
                                 .end = fbd_sweep_runs(table.sweep),
                                 .jobs = jobs,
                                 .write = append,
                                 .write_context = &table.rows};
    table.end = fbd_sweep_run(table.sweep, &work, &table.counts);
    return table;
}

static struct table sweep_of(const char *text, const char *const *vary, const char *const *outputs)
{
    const fbd_sweep_plan plan = plan_of(vary, outputs);
    return sweep_by(text, &plan, 0, 1);
}

static void close_table(struct table *table)
{
    text_free(&table->rows);
    fbd_sweep_free(table->sweep);
    fbd_errors_free(table->errors);
}

/* Field `column` (from 0) of row `row` (from 0), as text. */
static const char *field(const struct table *table, size_t row, size_t column, char *buffer, size_t size)
{
    const char *at = table->rows.data;
    for (size_t i = 0; i < row; i++) at = strchr(at, '\n') + 1;
    for (size_t i = 0; i < column; i++) at = strchr(at, ',') + 1;
    snprintf(buffer, size, "%.*s", (int)strcspn(at, ",\n"), at);
    return buffer;
}

static double number(const struct table *table, size_t row, size_t column)
{
    char buffer[64];
    return strtod(field(table, row, column, buffer, sizeof buffer), NULL);
}

static void assert_field(const struct table *table, size_t row, size_t column, const char *want)
{
    char buffer[64];
    assert_string_equal(field(table, row, column, buffer, sizeof buffer), want);
}

static void assert_refused(const char *const *vary, const char *const *outputs, const char *id)
{
    const fbd_sweep_plan plan = plan_of(vary, outputs);
    struct table table = open_table(projectile, &plan);
    assert_null(table.sweep);
    const fbd_error *note = fbd_errors_get(table.errors, 0);
    assert_non_null(note);
    assert_string_equal(note->id, id);
    close_table(&table);
}

/* ---- values */

static void a_grid_has_its_ends_and_values_as_people_write_them(void **state)
{
    (void)state;
    struct table table = sweep_of(projectile, TEXTS("v0=0.1:0.6:6"), TEXTS("t"));
    const char *const want[] = {"0.1", "0.2", "0.3", "0.4", "0.5", "0.6"};
    assert_int_equal(table.counts.written, 6);
    for (size_t i = 0; i < 6; i++) assert_field(&table, i, 1, want[i]);
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=-0.1:0.5:7"), TEXTS("t"));
    assert_field(&table, 1, 1, "0");
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=0.30000000000000004:1:1"), TEXTS("t"));
    assert_field(&table, 0, 1, "0.30000000000000004");
    close_table(&table);
}

static void a_logarithmic_grid_has_equal_ratios(void **state)
{
    (void)state;
    struct table table = sweep_of(projectile, TEXTS("m=1:1000:4:log"), TEXTS("t"));
    const char *const want[] = {"1", "10", "100", "1000"};
    for (size_t i = 0; i < 4; i++) assert_field(&table, i, 1, want[i]);
    close_table(&table);
}

static void a_unit_holds_for_all_values_and_stands_in_the_header(void **state)
{
    (void)state;
    struct table table = sweep_of(projectile, TEXTS("v0=1,2 km/h"), TEXTS("ball.vx"));
    assert_string_equal(fbd_sweep_header(table.sweep), "run,v0 [km/h],ball.vx [m/s],events,status,reason\n");
    assert_field(&table, 1, 1, "2");
    /* 2/3.6 rounds once, and so does the conversion of the unit */
    assert_true(fabs(number(&table, 1, 2) - 2 / 3.6) <= 2.3e-16);
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=1 km/h,2 km/h"), TEXTS("ball.vx"));
    assert_field(&table, 0, 1, "1");
    close_table(&table);
    table = sweep_of(projectile, TEXTS("v0=1,2"), TEXTS("t"));
    assert_string_equal(fbd_sweep_header(table.sweep), "run,v0 [m/s],t [s],events,status,reason\n");
    close_table(&table);
}

static void the_last_axis_changes_fastest(void **state)
{
    (void)state;
    struct table table = sweep_of(projectile, TEXTS("m=1,2", "v0=5,6,7"), TEXTS("t"));
    assert_int_equal(table.counts.written, 6);
    for (size_t i = 0; i < 6; i++) {
        assert_true(number(&table, i, 0) == (double)(i + 1));
        assert_true(number(&table, i, 1) == (i < 3 ? 1 : 2));
        assert_true(number(&table, i, 2) == (double)(5 + i % 3));
    }
    close_table(&table);
}

static void members_of_an_axis_go_side_by_side_and_so_does_all_with_zip(void **state)
{
    (void)state;
    struct table table = sweep_of(projectile, TEXTS("m=1,2; v0=5,6", "h=0,1,2"), TEXTS("t"));
    assert_int_equal(table.counts.written, 6);
    assert_field(&table, 3, 1, "2");
    assert_field(&table, 3, 2, "6");
    assert_field(&table, 3, 3, "0");
    close_table(&table);
    fbd_sweep_plan plan = plan_of(TEXTS("m=1,2,3", "v0=5:7:3"), TEXTS("t"));
    plan.zip = true;
    table = sweep_by(projectile, &plan, 0, 1);
    assert_int_equal(table.counts.written, 3);
    assert_field(&table, 1, 1, "2");
    assert_field(&table, 1, 2, "6");
    close_table(&table);
    plan = plan_of(TEXTS("m=1,2,3", "v0=5,6"), TEXTS("t"));
    plan.zip = true;
    table = open_table(projectile, &plan);
    assert_null(table.sweep);
    close_table(&table);
}

static void draws_are_of_their_distribution(void **state)
{
    (void)state;
    enum { n = 2000 };
    struct table table =
        sweep_of(projectile,
                 TEXTS("m=uniform(1,3) kg:2000; v0=normal(5,0.5) m/s:2000; h=loguniform(1,100):2000"),
                 TEXTS("t"));
    double sum[3] = {0}, squares[3] = {0};
    for (size_t i = 0; i < n; i++) {
        double x[3] = {number(&table, i, 1), number(&table, i, 2), log(number(&table, i, 3))};
        assert_true(x[0] >= 1 && x[0] < 3);
        assert_true(x[2] >= 0 && x[2] <= log(100) * (1 + 1e-15));
        for (int k = 0; k < 3; k++) {
            sum[k] += x[k];
            squares[k] += x[k] * x[k];
        }
    }
    const double mean[3] = {2, 5, log(100) / 2}, deviation[3] = {2 / sqrt(12), 0.5, log(100) / sqrt(12)};
    for (int k = 0; k < 3; k++) {
        /* The mean of n draws varies by deviation/sqrt(n), the standard deviation by less than that: five of
         * them happen by chance once in a million seeds, and the seed is fixed. */
        double spread = 5 * deviation[k] / sqrt(n), m = sum[k] / n;
        assert_true(fabs(m - mean[k]) < spread);
        assert_true(fabs(sqrt(squares[k] / n - m * m) - deviation[k]) < spread);
    }
    close_table(&table);
}

static void a_draw_depends_on_seed_name_and_number_alone(void **state)
{
    (void)state;
    char a[64], b[64];
    struct table few = sweep_of(projectile, TEXTS("m=uniform(1,2):10"), TEXTS("t"));
    struct table many = sweep_of(projectile, TEXTS("h=normal(0,1):2", "m=uniform(1,2):20"), TEXTS("t"));
    for (size_t i = 0; i < 10; i++) {
        assert_string_equal(field(&few, i, 1, a, sizeof a), field(&many, i, 2, b, sizeof b));
        assert_string_equal(a, field(&many, 20 + i, 2, b, sizeof b));
    }
    fbd_sweep_plan plan = plan_of(TEXTS("m=uniform(1,2):10"), TEXTS("t"));
    plan.seed = 2;
    struct table other = sweep_by(projectile, &plan, 0, 1);
    for (size_t i = 0; i < 10; i++)
        assert_string_not_equal(field(&few, i, 1, a, sizeof a), field(&other, i, 1, b, sizeof b));
    close_table(&few);
    close_table(&many);
    close_table(&other);
}

static void what_is_no_sweep_is_refused(void **state)
{
    (void)state;
    static const char *const wrong[] = {"m",
                                        "m=",
                                        "=1",
                                        "m=1:2",
                                        "m=1:2:0",
                                        "m=1:2:x",
                                        "m=1:2:3:4",
                                        "m=a,b",
                                        "m=1,,2",
                                        "m=uniform(1):3",
                                        "m=uniform(1,2)",
                                        "m=gamma(1,2):3",
                                        "m=loguniform(0,1):3",
                                        "m=normal(1,-1):3",
                                        "m=0:1:3:log",
                                        "m=1 kg:2 g:3",
                                        "m=1,2; v0=1",
                                        "m=1; m=2",
                                        "m=1:2:99999999999999999999",
                                        "m=inf",
                                        "m=nan",
                                        "m=1:2:3x",
                                        "m=1e999"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        assert_refused(TEXTS(wrong[i]), NULL, "bad-vary");
    assert_refused(TEXTS("m=1:2:9000000000", "v0=1:2:9000000000"), NULL, "bad-vary");
    assert_refused(TEXTS("x=1"), NULL, "unknown-parameter");
    assert_refused(TEXTS("m=1 m"), NULL, "wrong-dimension");
    assert_refused(TEXTS("m=1 kilo"), NULL, "unknown-unit");
    assert_refused(TEXTS("m=1"), TEXTS("ball.z"), "unknown-output");
    assert_refused(TEXTS("m=1"), TEXTS("t,time(nothing)"), "unknown-output");
    assert_refused(TEXTS("m=1"), TEXTS("max(t)"), "unknown-output");
    assert_refused(TEXTS("m=1"), TEXTS("ball.drag.work"), "unknown-output");
}

/* ---- rows */

static void rows_show_what_happened(void **state)
{
    (void)state;
    /* From y = h up and down to h - 1: top at 4/g and h + 16/(2 g); land at (4 + sqrt(16 + 2 g))/g. The
     * tolerance of a step is 1e-10, and the motion is a polynomial that dop853 integrates exactly. */
    const double g = 9.81, land = (4 + sqrt(16 + 2 * g)) / g, tolerance = 1e-12;
    struct table table =
        sweep_of(projectile, TEXTS("h=0,7"),
                 TEXTS("t,ball.x,max(ball.y)", "min(ball.y),max(ball.vy),time(top),time(land),count(land),"
                                               "energy.kinetic,ball.gravity.work,time(stick)"));
    for (size_t i = 0; i < 2; i++) {
        double h = i ? 7 : 0;
        const double want[] = {land, 3 * land, h + 8 / g, h - 1, 4, 4 / g, land, 1, 0.5 * 2 * 25 + 2 * g,
                               2 * g};
        for (size_t k = 0; k < sizeof want / sizeof *want; k++)
            assert_true(fabs(number(&table, i, 2 + k) - want[k]) <= tolerance * fmax(1, fabs(want[k])));
        assert_field(&table, i, 12, "");
        assert_field(&table, i, 13, "2");
        assert_field(&table, i, 14, "stopped");
        assert_field(&table, i, 15, "");
    }
    close_table(&table);
}

static void the_amplitude_of_a_pendulum_is_found_between_the_steps(void **state)
{
    (void)state;
    static const char pendulum[] = "fbd: 1\n"
                                   "parameters: {start: 1 rad}\n"
                                   "bodies:\n"
                                   "  p:\n"
                                   "    parts: {bob: {mass: 1, center: [0, -1]}}\n"
                                   "    motion: {pivot: {at: [0, 0]}}\n"
                                   "    initial: {theta: start}\n"
                                   "    forces: [gravity]\n"
                                   "simulate: {until: 20 s}\n";
    struct table table =
        sweep_of(pendulum, TEXTS("start=0.1,1,2,3"), TEXTS("min(theta),max(theta),max(omega)"));
    for (size_t i = 0; i < 4; i++) {
        /* Without loss it swings as far on the other side, and below omega^2/2 = g/l (1 - cos(start)). Near
         * the top an error of the step, 1e-10, grows by the long time there. */
        double start = number(&table, i, 1), tolerance = 1e-7;
        assert_true(fabs(number(&table, i, 2) + start) <= tolerance);
        assert_true(fabs(number(&table, i, 3) - start) <= tolerance);
        assert_true(fabs(number(&table, i, 4) - sqrt(2 * 9.81 * (1 - cos(start)))) <= tolerance);
    }
    close_table(&table);
}

static void runs_that_fail_are_rows_and_stop_no_others(void **state)
{
    (void)state;
    static const char lost[] = "fbd: 1\n"
                               "parameters: {m: 2 kg, lift: 10 N}\n"
                               "bodies:\n"
                               "  block:\n"
                               "    mass: m\n"
                               "    motion: slide\n"
                               "    initial: {x: 1, v: -1}\n"
                               "    forces:\n"
                               "      - gravity\n"
                               "      - normal\n"
                               "      - applied: {name: up, value: lift, angle: 90 deg}\n"
                               "      - applied: {name: pull, value: '-1[N*m^2]/x^2'}\n"
                               "simulate: {until: 0.1 s}\n";
    struct table table = sweep_of(lost, TEXTS("m=-1,2", "lift=10,30"), NULL);
    assert_int_equal(table.end, FBD_SWEEP_DONE);
    assert_int_equal(table.counts.written, 4);
    assert_int_equal(table.counts.failed, 3);
    assert_field(&table, 0, 7, "wrong");
    assert_field(&table, 0, 3, "");
    assert_non_null(strstr(table.rows.data, "test.yaml:5:11: the `mass` of a body must be above zero"));
    assert_field(&table, 2, 7, "done");
    assert_field(&table, 3, 7, "broken");
    close_table(&table);
    fbd_sweep_plan plan = plan_of(TEXTS("lift=0,1"), NULL);
    plan.run.until = 5; /* into the singularity at x = 0 */
    table = sweep_by(lost, &plan, 0, 1);
    assert_int_equal(table.counts.failed, 2);
    assert_field(&table, 0, 6, "failed");
    close_table(&table);
}

static void rows_do_not_depend_on_the_number_of_workers_or_where_one_starts(void **state)
{
    (void)state;
    const fbd_sweep_plan plan = plan_of(TEXTS("m=-1:2:31", "v0=normal(1,1):17"), TEXTS("final,times,max(y)"));
    struct table one = sweep_by(projectile, &plan, 0, 1);
    assert_int_equal(one.counts.written, 31 * 17);
    for (size_t jobs = 2; jobs <= 7; jobs += 5) {
        struct table more = sweep_by(projectile, &plan, 0, jobs);
        assert_int_equal(more.counts.written, one.counts.written);
        assert_int_equal(more.counts.failed, one.counts.failed);
        assert_string_equal(more.rows.data, one.rows.data);
        close_table(&more);
    }
    const char *tail = one.rows.data;
    for (int i = 0; i < 100; i++) tail = strchr(tail, '\n') + 1;
    struct table rest = sweep_by(projectile, &plan, 100, 2);
    assert_string_equal(rest.rows.data, tail);
    close_table(&rest);
    close_table(&one);
}

/* ---- stopping */

static bool stop_later(void *context)
{
    size_t *left = context;
    if (*left == 0) return true;
    --*left;
    return false;
}

static void a_sweep_that_is_stopped_leaves_its_first_rows(void **state)
{
    (void)state;
    const fbd_sweep_plan plan = plan_of(TEXTS("v0=1:9:500"), NULL);
    struct table whole = sweep_by(projectile, &plan, 0, 1), part = open_table(projectile, &plan);
    size_t steps = 1000;
    const fbd_sweep_work work = {.end = 500,
                                 .jobs = 1,
                                 .write = append,
                                 .write_context = &part.rows,
                                 .stop = stop_later,
                                 .stop_context = &steps};
    assert_int_equal(fbd_sweep_run(part.sweep, &work, &part.counts), FBD_SWEEP_STOPPED);
    assert_in_range(part.counts.written, 1, 499);
    assert_int_equal(part.rows.data[part.rows.length - 1], '\n');
    assert_memory_equal(part.rows.data, whole.rows.data, part.rows.length);
    struct table rest = sweep_by(projectile, &plan, part.counts.written, 2);
    assert_string_equal(rest.rows.data, whole.rows.data + part.rows.length);
    close_table(&rest);
    close_table(&part);
    close_table(&whole);
}

static int refuse_later(void *context, const char *rows, size_t length)
{
    (void)rows;
    (void)length;
    return stop_later(context);
}

static void a_table_that_cannot_be_written_ends_the_sweep(void **state)
{
    (void)state;
    for (size_t jobs = 1; jobs <= 3; jobs++) {
        const fbd_sweep_plan plan = plan_of(TEXTS("v0=1:9:500"), NULL);
        struct table table = open_table(projectile, &plan);
        size_t left = 3;
        const fbd_sweep_work work = {.end = 500, .jobs = jobs, .write = refuse_later, .write_context = &left};
        assert_int_equal(fbd_sweep_run(table.sweep, &work, &table.counts), FBD_SWEEP_REFUSED);
        assert_true(table.counts.written < 500);
        close_table(&table);
    }
}

/* ---- with the help of others */

static void shares_that_others_make_take_their_place_in_the_order(void **state)
{
    (void)state;
    const fbd_sweep_plan plan = plan_of(TEXTS("v0=1:9:200"), NULL);
    struct table alone = sweep_by(projectile, &plan, 0, 1), led = open_table(projectile, &plan);
    const fbd_sweep_work work = {
        .end = 200, .jobs = 1, .helpers = 1, .write = append, .write_context = &led.rows};
    fbd_sweep_crew *crew = fbd_sweep_start(led.sweep, &work);
    assert_non_null(crew);
    fbd_sweep_share share;
    for (int claimed; (claimed = fbd_sweep_claim(crew, 1, &share)) >= 0;) {
        if (claimed == 0) continue;
        struct text rows = {0};
        fbd_sweep_counts counts;
        const fbd_sweep_work mine = {
            .first = share.first, .end = share.end, .jobs = 1, .write = append, .write_context = &rows};
        assert_int_equal(fbd_sweep_run(alone.sweep, &mine, &counts), FBD_SWEEP_DONE);
        fbd_sweep_deliver(crew, &share, rows.data, rows.length, &counts);
        text_free(&rows);
    }
    assert_int_equal(fbd_sweep_finish(crew, &led.counts), FBD_SWEEP_DONE);
    assert_int_equal(led.counts.written, 200);
    assert_string_equal(led.rows.data, alone.rows.data);
    close_table(&led);
    close_table(&alone);
}

/* ---- the same bits as a run by itself */

/* The row of a run by itself, its parameter set as --set sets it. */
static void add_single(const char *text, const char *name, const char *value, struct text *row)
{
    const fbd_setting setting = {name, value};
    const fbd_options options = {.until = 0.5};
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), "test.yaml", &setting, 1, errors);
    fbd_simulation *simulation = model ? fbd_simulation_new(model, &options, errors) : NULL;
    if (simulation) {
        while (fbd_simulation_advance(simulation) == FBD_GOING) continue;
        fbd_state *state = fbd_state_new(model);
        double from, to;
        fbd_simulation_interval(simulation, &from, &to);
        assert_true(fbd_simulation_state(simulation, to, state));
        for (size_t i = 0; i < 2 * fbd_model_coordinates(model); i++) {
            fbd_coordinate c = fbd_model_coordinate(model, i / 2);
            double number;
            assert_true(fbd_state_get(state, i % 2 ? c.rate_name : c.name, &number));
            text_add(row, ",");
            if (!isnan(number)) text_number(row, number, 17);
        }
        text_printf(row, ",%zu,", fbd_simulation_events(simulation));
        fbd_state_free(state);
    }
    fbd_simulation_free(simulation);
    fbd_model_free(model);
    fbd_errors_free(errors);
}

/* All coordinates and rates of a model, one after the other, as outputs. */
static void list_outputs(const char *text, struct text *outputs)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, strlen(text), "test.yaml", NULL, 0, errors);
    assert_non_null(model);
    for (size_t i = 0; i < fbd_model_coordinates(model); i++) {
        fbd_coordinate c = fbd_model_coordinate(model, i);
        text_printf(outputs, "%s%s,%s", i ? "," : "", c.name, c.rate_name);
    }
    fbd_model_free(model);
    fbd_errors_free(errors);
}

static size_t compare_parameter(const char *path, const char *text, const char *outputs,
                                const struct parameter *parameter)
{
    size_t differ = 0;
    struct text vary = {0};
    text_printf(&vary, "%s=", parameter->name);
    text_number(&vary, parameter->value * 0.9, 15);
    text_add(&vary, ",");
    text_number(&vary, parameter->value * 1.1, 15);
    fbd_sweep_plan plan = plan_of(TEXTS(vary.data), TEXTS(outputs));
    plan.run = (fbd_options){.until = 0.5};
    struct table table = sweep_by(text, &plan, 0, 1);
    for (size_t row = 0; row < 2; row++) {
        char value[64];
        struct text single = {0};
        field(&table, row, 1, value, sizeof value);
        add_single(text, parameter->name, value, &single);
        const char *at = table.rows.data;
        for (size_t i = 0; i < row; i++) at = strchr(at, '\n') + 1;
        for (size_t i = 0; i < 2; i++) at += strcspn(at, ",\n") + 1;
        bool same = single.length == 0 ? strstr(at, ",wrong,") != NULL
                                       : strncmp(at - 1, single.data, single.length) == 0;
        if (!same)
            print_error("%s, %s = %s:\n  sweep  %s  single %s\n", path, parameter->name, value, at - 1,
                        single.data);
        differ += !same;
        text_free(&single);
    }
    close_table(&table);
    text_free(&vary);
    return differ;
}

static size_t compare_model(const char *path)
{
    size_t length, differ = 0;
    fbd_errors *errors = fbd_errors_new();
    char *read = file_text(path, &length, errors), *text = calloc(length + 1, 1);
    assert_true(read && text);
    memcpy(text, read, length);
    free(read);
    struct text outputs = {0};
    list_outputs(text, &outputs);
    struct scene *scene = scene_read(text, length, path, NULL, 0, errors);
    for (size_t i = 0; i < scene->parameter_count; i++)
        differ += compare_parameter(path, text, outputs.data, &scene->parameters[i]);
    scene_free(scene);
    text_free(&outputs);
    free(text);
    fbd_errors_free(errors);
    return differ;
}

static void every_parameter_of_every_model_gives_the_bits_of_a_run_by_itself(void **state)
{
    (void)state;
    const char *root = getenv("FBD_SOURCE_ROOT");
    assert_non_null(root);
    char pattern[1000];
    glob_t found;
    size_t differ = 0;
    snprintf(pattern, sizeof pattern, "%s/models/*/*.yaml", root);
    assert_int_equal(glob(pattern, 0, NULL, &found), 0);
    assert_true(found.gl_pathc > 20);
    for (size_t i = 0; i < found.gl_pathc; i++) differ += compare_model(found.gl_pathv[i]);
    globfree(&found);
    assert_int_equal(differ, 0);
}

static void what_depends_on_a_parameter_through_others_follows_it(void **state)
{
    (void)state;
    static const char chain[] = "fbd: 1\n"
                                "gravity: strength\n"
                                "parameters: {a: 2, b: 3 m/s^2, strength: a*b, push: 2*g, w: 4}\n"
                                "bodies:\n"
                                "  block:\n"
                                "    mass: w\n"
                                "    motion: {slide: {along: -10 deg}}\n"
                                "    forces:\n"
                                "      - gravity\n"
                                "      - applied: {value: 'm*push*cos(t*1[1/s])'}\n"
                                "      - applied: {name: pull, value: 'w*1[N]*x/1[m] - m*g'}\n"
                                "simulate: {until: 0.5 s}\n";
    const char *const names[] = {"a", "b", "w"};
    const double values[] = {2, 3, 4};
    for (size_t i = 0; i < 3; i++) {
        const struct parameter parameter = {.name = names[i], .value = values[i]};
        assert_int_equal(compare_parameter("chain", chain, "x,v", &parameter), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_grid_has_its_ends_and_values_as_people_write_them),
        cmocka_unit_test(a_logarithmic_grid_has_equal_ratios),
        cmocka_unit_test(a_unit_holds_for_all_values_and_stands_in_the_header),
        cmocka_unit_test(the_last_axis_changes_fastest),
        cmocka_unit_test(members_of_an_axis_go_side_by_side_and_so_does_all_with_zip),
        cmocka_unit_test(draws_are_of_their_distribution),
        cmocka_unit_test(a_draw_depends_on_seed_name_and_number_alone),
        cmocka_unit_test(what_is_no_sweep_is_refused),
        cmocka_unit_test(rows_show_what_happened),
        cmocka_unit_test(the_amplitude_of_a_pendulum_is_found_between_the_steps),
        cmocka_unit_test(runs_that_fail_are_rows_and_stop_no_others),
        cmocka_unit_test(rows_do_not_depend_on_the_number_of_workers_or_where_one_starts),
        cmocka_unit_test(a_sweep_that_is_stopped_leaves_its_first_rows),
        cmocka_unit_test(a_table_that_cannot_be_written_ends_the_sweep),
        cmocka_unit_test(shares_that_others_make_take_their_place_in_the_order),
        cmocka_unit_test(what_depends_on_a_parameter_through_others_follows_it),
        cmocka_unit_test(every_parameter_of_every_model_gives_the_bits_of_a_run_by_itself),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
