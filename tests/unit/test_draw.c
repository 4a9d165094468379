/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drawings: labels that never overlap, sizes of every shape, the record of a run and how it is thinned and
 * packed, and runs that are interrupted.
 */
#include <float.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "api/pack.h"
#include "draw/labelling.h"
#include "draw/shapes.h"
#include "fbd_export.h"
#include "random_numbers.h"
#include "scenes.h"

static const double pi = 3.141592653589793;

/* ---- labels */

static bool overlap(struct box a, struct box b)
{
    return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

static void labels_of_random_crowds_never_overlap(void **unused)
{
    (void)unused;
    struct random_numbers random = {20261121};
    for (int crowd = 0; crowd < 40; crowd++) {
        struct arena arena = {0};
        struct labelling labelling = {.arena = &arena};
        const int count = 5 + crowd;
        for (int i = 0; i < count; i++) {
            struct vec anchor = {random_between(&random, -15, 15), random_between(&random, -15, 15)};
            struct vec toward = i % 3 ? vec_unit(random_between(&random, -pi, pi)) : (struct vec){0, 0};
            labelling_add(&labelling, i % 2 ? "gravity 19.62 N" : "p 3 N", 3.4, anchor, toward, 1);
            labelling_avoid(&labelling, (struct vec){0, 0}, anchor, 12);
        }
        assert_true(labelling_solve(&labelling));
        for (size_t i = 0; i < labelling.label_count; i++)
            for (size_t k = 0; k < i; k++)
                if (overlap(labelling_box(&labelling.labels[i]), labelling_box(&labelling.labels[k])))
                    fail_msg("crowd %d: label %zu lies on label %zu", crowd, i, k);
        arena_free(&arena);
    }
}

/* ---- shapes */

static void shapes_have_their_sizes(void **unused)
{
    (void)unused;
    static const struct {
        const char *shape;
        double width, height; /* of what is seen, at angle 0 */
    } seen[] = {
        {"rod, axis: z, length: 2", 2, 0},
        {"rod, axis: x, length: 2", 0, 0}, /* from its end */
        {"sphere, radius: 0.5", 1, 1},
        {"cylinder, axis: x, radius: 0.5, length: 3", 1, 1},
        {"cylinder, axis: y, radius: 0.5, length: 3", 3, 1},
        {"hollow_cylinder, axis: x, outer_radius: 2, inner_radius: 1", 4, 4},
        {"ring, axis: x, radius: 2", 4, 4},
        {"ring, axis: z, radius: 2", 0, 4}, /* from its edge */
        {"prism, axis: z, a: 4, b: 3, c: 2", 4, 3},
        {"prism, axis: y, a: 4, b: 3, c: 2", 4, 2},
        {"prism, axis: x, a: 4, b: 3, c: 2", 3, 2},
        {"point", 0, 0},
    };
    const double rounding = 4 * DBL_EPSILON * 4;
    for (size_t i = 0; i < sizeof seen / sizeof *seen; i++) {
        char text[300];
        snprintf(text, sizeof text,
                 "fbd: 1\nbodies: {body: {motion: {slide: {along: 0}}, parts: {p: {shape: %s, mass: 1, "
                 "center: [0.25, -0.5]}}}}\n",
                 seen[i].shape);
        fbd_model *model = model_from(text);
        struct vec low, high;
        assert_int_equal(shapes_size(model, 0, &low, &high), seen[i].width + seen[i].height > 0);
        assert_true(fabs(high.x - low.x - seen[i].width) <= rounding);
        assert_true(fabs(high.y - low.y - seen[i].height) <= rounding);
        double reach = shapes_reach(model, 0, (struct vec){0.25, -0.5}, (struct vec){0, -1});
        assert_true(fabs(reach - seen[i].height / 2) <= rounding);
        fbd_model_free(model);
    }
}

/* ---- records */

struct recorded {
    fbd_model *model;
    fbd_errors *errors;
    fbd_simulation *simulation;
    fbd_result *result;
};

static struct recorded record_rows(const char *text, double until, unsigned rows)
{
    struct recorded run = {.model = model_from(text), .errors = fbd_errors_new()};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_recording recording = {.keep = true, .rows = rows};
    options.until = until;
    run.simulation = fbd_simulation_new(run.model, &options, run.errors);
    assert_non_null(run.simulation);
    run.result = fbd_simulation_run(run.simulation, &recording);
    assert_non_null(run.result);
    return run;
}

static struct recorded record_run(const char *text, double until)
{
    return record_rows(text, until, 0);
}

static void end_run(struct recorded *run)
{
    fbd_result_free(run->result);
    fbd_simulation_free(run->simulation);
    fbd_errors_free(run->errors);
    fbd_model_free(run->model);
}

static int column_named(const struct record *record, const char *name)
{
    for (size_t c = 0; c < record->column_count; c++)
        if (strcmp(record->columns[c].name, name) == 0) return (int)c;
    fail_msg("no column is called %s", name);
    return -1;
}

static const char pendulum[] = "fbd: 1\n"
                               "bodies:\n"
                               "  arm:\n"
                               "    shape: rod\n"
                               "    mass: 1 kg\n"
                               "    length: 1 m\n"
                               "    motion: {pivot: {at: [0, 0], point: left}}\n"
                               "    forces: [gravity]\n"
                               "simulate: {until: 10 s, events: [{name: mark, when: 't = 77.7[s]'}]}\n";

static void a_thinned_record_keeps_events_and_extremes(void **unused)
{
    (void)unused;
    /* from rest, horizontal: theta swings between 0 and -pi; some 19 steps of each 1.9 s period */
    struct recorded run = record_run(pendulum, 20000);
    struct record *record = run.result->record;
    record_thin(record, 1000, 256);
    assert_true(record_is_thinned(record));
    assert_true(record->count <= 1000 && record->bucket_count <= 256);
    size_t at_event = 0;
    for (size_t i = 0; i < record->count; i++) at_event += fabs(record->times[i] - 77.7) < 1e-9;
    assert_int_equal(at_event, 2);
    assert_true(record->times[0] == 0 && record->times[record->count - 1] == 20000);
    /* Every piece but the last, which may be empty, has seen whole periods. */
    int theta = column_named(record, "arm.theta");
    size_t pieces = (size_t)(20000 / record->bucket);
    assert_true(pieces >= 64);
    for (size_t k = 0; k < pieces; k++) {
        const float *cell = record->envelope + 2 * (k * record->column_count + (size_t)theta);
        /* the turning point is found to 1/4096 of a step of about 0.1 s, with alpha = 14.7 rad/s^2, and its
         * place on a cubic is a guess: 1e-4 rad covers both */
        assert_true(fabs((double)cell[0] + pi) < 1e-4 && fabs((double)cell[1]) < 1e-4);
    }
    end_run(&run);
}

static void fewer_rows_are_of_the_same_motion(void **unused)
{
    (void)unused;
    struct recorded run = record_run(pendulum, 5), few = record_rows(pendulum, 5, 50);
    const struct record *all = run.result->record, *some = few.result->record;
    size_t regular = 0, k = 0;
    assert_true(some->count < all->count / 4);
    for (size_t i = 0; i < some->count; i++) {
        double t = some->times[i], tenths = 10 * t;
        if (fabs(tenths - round(tenths)) > 1e-9) continue; /* the end of a step */
        regular++;
        while (k + 1 < all->count && all->times[k] < t - 1e-9) k++;
        /* the times differ by their roundings, and what moves with them */
        for (size_t c = 0; c < all->column_count; c++) {
            double a = all->rows[k * all->column_count + c], b = some->rows[i * all->column_count + c];
            assert_true(fabs(a - b) <= 1e-10 * fmax(1, fabs(a)));
        }
    }
    assert_int_equal(regular, 51);
    end_run(&run);
    end_run(&few);
}

/* The value that the page makes of a packed column. */
static double unpacked(const struct packed_column *packed, const double *row, size_t c)
{
    if (packed->kind == packed_constant) return packed->offset;
    return packed->kind == packed_affine ? packed->offset + packed->factor * row[packed->of] : row[c];
}

static void check_column(const struct pack *pack, size_t c, const char *scene)
{
    const struct record *record = pack->record;
    const struct record_column *column = &record->columns[c];
    /* 1e-13 of the larger of the two terms of the packed value, of which the first may be 1e6 times its
     * change */
    double size = fmax(fabs(column->least), fabs(column->greatest)), allowed = 1e-7 * size;
    for (size_t i = 0; i < record->count; i++) {
        const double *row = record->rows + i * record->column_count;
        double value = unpacked(&pack->columns[c], row, c);
        if (!(fabs(value - row[c]) <= allowed || isnan(row[c])))
            fail_msg("%s: %s in row %zu: %.17g instead of %.17g", scene, column->name, i, value, row[c]);
    }
}

static void packing_loses_nothing(void **unused)
{
    (void)unused;
    for (size_t s = 0; s < all_scenes_count; s++) {
        struct recorded run = record_run(all_scenes[s].text, 0.5);
        struct pack pack;
        assert_true(pack_begin(&pack, run.result->record, 1000000));
        for (size_t c = 0; c < run.result->record->column_count; c++)
            check_column(&pack, c, all_scenes[s].name);
        pack_end(&pack);
        end_run(&run);
    }
}

static void what_was_not_recorded_cannot_be_shown(void **unused)
{
    (void)unused;
    fbd_model *model = model_from(pendulum);
    fbd_errors *errors = fbd_errors_new();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_result *result = fbd_simulation_run(simulation, NULL);
    assert_null(fbd_result_gnuplot(result, NULL, NULL, errors));
    assert_string_equal(fbd_errors_get(errors, 0).id, "not-recorded");
    assert_null(fbd_result_html(result, errors));
    assert_int_equal(fbd_errors_failed_count(errors), 2);
    assert_true(fbd_model_has_columns(model, "arm.theta,arm.pin.x,energy.work", errors));
    assert_false(fbd_model_has_columns(model, "arm.theta,arm.phi", errors));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
    fbd_model_free(model);
}

/* ---- interruptions */

struct stop {
    double at;
    double seen; /* the last time that was told */
    char last_row[400];
};

static int stop_there(void *context, const fbd_progress *progress)
{
    struct stop *stop = context;
    stop->seen = progress->t;
    return progress->t >= stop->at;
}

static int keep_row(void *context, const char *text, size_t length)
{
    struct stop *stop = context;
    snprintf(stop->last_row, sizeof stop->last_row, "%.*s", (int)length, text);
    return 0;
}

static void an_interrupted_run_ends_where_it_was_told_to(void **unused)
{
    (void)unused;
    /* a body at rest, whose one step has a row every millisecond */
    static const char rest[] =
        "fbd: 1\n"
        "bodies:\n"
        "  b: {mass: 1 kg, motion: slide, forces: [gravity, normal, friction: {static: 1, "
        "kinetic: 1}]}\n"
        "simulate: {until: 10 s, events: [{name: late, when: 't = 10[s]'}]}\n";
    fbd_model *model = model_from(rest);
    fbd_errors *errors = fbd_errors_new();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    struct stop stop = {.at = 4.2};
    fbd_recording recording = {.every = 0.001,
                               .csv = keep_row,
                               .csv_context = &stop,
                               .progress = stop_there,
                               .progress_context = &stop};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    assert_non_null(result);
    assert_int_equal(fbd_result_outcome(result), FBD_INTERRUPTED);
    double t = 0;
    assert_true(fbd_state_get(fbd_result_state(result), "t", &t));
    assert_true(t == stop.seen && t >= 4.2 && t < 4.2011);
    assert_true(strtod(stop.last_row, NULL) == t);
    assert_non_null(strstr(fbd_simulation_reason(simulation), "interrupted at t = 4.2"));
    assert_int_equal(fbd_simulation_event_count(simulation), 0); /* that of t = 10 s has not happened */
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
    fbd_model_free(model);
}

/* The kinetic energy m v^2 / 2 is beyond all numbers from v = 1.9e154 m/s on, which no step notices. */
static void an_interruption_shows_no_number_that_is_not_finite(void **unused)
{
    (void)unused;
    static const char text[] =
        "fbd: 1\n"
        "bodies: {b: {mass: 1, motion: slide, forces: [{applied: {name: push, value: 1e154}}]}}\n"
        "simulate: {until: 10 s}\n";
    fbd_model *model = model_from(text);
    fbd_errors *errors = fbd_errors_new();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    struct stop stop = {.at = 5};
    fbd_recording recording = {.every = 0.01,
                               .csv = keep_row,
                               .csv_context = &stop,
                               .progress = stop_there,
                               .progress_context = &stop};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    assert_int_equal(fbd_result_outcome(result), FBD_FAILED);
    assert_true(stop.seen >= 5 && stop.seen < 5.1);
    assert_non_null(strstr(fbd_simulation_reason(simulation), "is not finite at t = 5"));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
    fbd_model_free(model);
}

static int stop_soon(void *context, const fbd_progress *progress)
{
    (void)context;
    return progress->steps > 100;
}

/* Of two groups one makes a hundred million steps: who interrupts does not wait for a thousandth of them. */
static void a_stiff_group_does_not_hold_up_an_interruption(void **unused)
{
    (void)unused;
    static const char text[] =
        "fbd: 1\n"
        "bodies:\n"
        "  a: {mass: 1, motion: slide, initial: {x: 1}, forces: [spring: {stiffness: 1e12}]}\n"
        "  b: {mass: 1, motion: slide, initial: {x: 1}, forces: [spring: {stiffness: 1}]}\n"
        "simulate: {until: 10 s, method: rkck}\n";
    fbd_model *model = model_from(text);
    fbd_errors *errors = fbd_errors_new();
    fbd_options options = FBD_OPTIONS_DEFAULT;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    fbd_recording recording = {.progress = stop_soon};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    assert_int_equal(fbd_result_outcome(result), FBD_INTERRUPTED);
    assert_true(fbd_simulation_stats(simulation).steps < 10000);
    fbd_result_free(result);
    fbd_simulation_free(simulation);
    fbd_errors_free(errors);
    fbd_model_free(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_of_random_crowds_never_overlap),
        cmocka_unit_test(shapes_have_their_sizes),
        cmocka_unit_test(a_thinned_record_keeps_events_and_extremes),
        cmocka_unit_test(fewer_rows_are_of_the_same_motion),
        cmocka_unit_test(packing_loses_nothing),
        cmocka_unit_test(what_was_not_recorded_cannot_be_shown),
        cmocka_unit_test(an_interrupted_run_ends_where_it_was_told_to),
        cmocka_unit_test(an_interruption_shows_no_number_that_is_not_finite),
        cmocka_unit_test(a_stiff_group_does_not_hold_up_an_interruption),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
