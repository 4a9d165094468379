/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reading a model text in a test. Include after <cmocka.h>.
 */
#ifndef FBD_TESTS_SCENE_FIXTURE_H
#define FBD_TESTS_SCENE_FIXTURE_H

#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

struct reading {
    struct scene *scene;
    fbd_errors *errors;
};

static inline struct reading read_with(const char *text, const struct override *overrides, size_t count)
{
    struct reading reading = {.errors = fbd_errors_new()};
    assert_non_null(reading.errors);
    reading.scene = scene_read(text, strlen(text), "test.yaml", overrides, count, NULL, reading.errors);
    return reading;
}

static inline struct reading read_text(const char *text)
{
    return read_with(text, NULL, 0);
}

static inline void end_reading(struct reading *reading)
{
    scene_free(reading->scene);
    fbd_errors_free(reading->errors);
}

/* A text that must be right: without any note. */
static inline struct reading read_right(const char *text)
{
    struct reading reading = read_text(text);
    if (fbd_errors_count(reading.errors) > 0) fbd_errors_print(reading.errors, stderr);
    assert_int_equal(fbd_errors_count(reading.errors), 0);
    assert_non_null(reading.scene);
    return reading;
}

/* The number of notes with this id. */
static inline int count_notes(const struct reading *reading, const char *id)
{
    int count = 0;
    for (size_t i = 0; i < fbd_errors_count(reading->errors); i++) {
        const fbd_error note = fbd_errors_get(reading->errors, i);
        count += strcmp(note.id, id) == 0;
    }
    return count;
}

/* The first note must be this one, at this place. */
static inline void assert_first_note(const struct reading *reading, const char *id, int line, int column)
{
    const fbd_error note = fbd_errors_get(reading->errors, 0);
    assert_non_null(note.id);
    assert_string_equal(note.id, id);
    assert_int_equal(note.line, line);
    assert_int_equal(note.column, column);
}

/* Values are converted by one multiplication, which may round once. */
static const double one_rounding = 2.3e-16;

static inline void assert_close(double got, double wanted)
{
    double tolerance = one_rounding * fmax(1, fabs(wanted));
    if (fabs(got - wanted) > tolerance)
        print_error("got %.17g, wanted %.17g, off by %.2g tolerances\n", got, wanted,
                    fabs(got - wanted) / tolerance);
    assert_true(fabs(got - wanted) <= tolerance);
}

static inline void assert_vec(struct vec got, double x, double y)
{
    assert_close(got.x, x);
    assert_close(got.y, y);
}

#endif
