/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The rows of a sweep are those of the runs by themselves, bit for bit.
 */
#include <glob.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <gsl/gsl_errno.h>

#include "base/file.h"
#include "fbd_study.h"
#include "scene/scene.h"
#include "sweep_table.h"
#include "thorough.h"

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
        for (size_t i = 0; i < 2 * fbd_model_coordinate_count(model); i++) {
            fbd_coordinate c = fbd_model_coordinate(model, i / 2);
            double number;
            assert_true(fbd_state_get(state, i % 2 ? c.rate_name : c.name, &number));
            text_add(row, ",");
            if (!isnan(number)) text_exact(row, number);
        }
        text_printf(row, ",%zu,", fbd_simulation_event_count(simulation));
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
    for (size_t i = 0; i < fbd_model_coordinate_count(model); i++) {
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
    plan.run = &(fbd_options){.until = 0.5};
    struct sweep_table table = sweep_by(text, &plan, 0, 1);
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

static void enter_directory_of(const char *path)
{
    char directory[4096];
    snprintf(directory, sizeof directory, "%.*s", (int)(strrchr(path, '/') - path), path);
    assert_int_equal(chdir(directory), 0);
}

static size_t compare_model(const char *path)
{
    size_t length, differ = 0;
    fbd_errors *errors = fbd_errors_new();
    char *read = file_text(path, &length, errors), *text = calloc(length + 1, 1);
    assert_true(read && text);
    memcpy(text, read, length);
    free(read);
    enter_directory_of(path); /* where its tables are */
    struct text outputs = {0};
    list_outputs(text, &outputs);
    struct scene *scene = scene_read(text, length, path, NULL, 0, NULL, errors);
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
    const size_t every = thorough() ? 1 : 12;
    for (size_t i = 0; i < found.gl_pathc; i += every) differ += compare_model(found.gl_pathv[i]);
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
        cmocka_unit_test(what_depends_on_a_parameter_through_others_follows_it),
        cmocka_unit_test(every_parameter_of_every_model_gives_the_bits_of_a_run_by_itself),
    };
    gsl_set_error_handler_off();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
