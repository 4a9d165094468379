/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A sweep whose runs share one scene, patched, has the rows of a sweep that reads the file for each: to the last byte,
 * for values that change nothing but numbers, and for those that change what the file means: zero, another sign, a
 * coefficient of restitution beyond one, what is too large. A thread begins to patch with its third row, so rows that
 * are asked for one at a time are read.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_study.h"
#include "fbd_view.h"
#include "gallery.h"
#include "random_numbers.h"
#include "scene/patch.h"
#include "sweep_table.h"
#include "thorough.h"

/* ---- the same rows */

/* So many that a patch has served for long enough to be made again where it does not fit any more. */
enum { rows = 40, most_varied = 2 };

static void make_rows(const fbd_sweep *sweep, size_t first, size_t end, struct text *text)
{
    const fbd_sweep_work work = {
        .first = first, .end = end, .jobs = 1, .write = append, .write_context = text};
    assert_int_equal(fbd_sweep_run(sweep, &work, NULL), FBD_SWEEP_DONE);
}

/* In the neighbourhood mostly; now and then where something else begins. */
static double draw_value(struct random_numbers *seed, double value)
{
    double scale = value != 0 ? value : 1;
    switch ((int)(8 * random_between(seed, 0, 1))) {
    case 0: return 0;
    case 1: return -scale;
    case 2: return scale * 30 * random_between(seed, 0, 1);
    case 3: return 1 + random_between(seed, 0, 1);
    default: return scale * (0.5 + random_between(seed, 0, 1));
    }
}

static void add_axis(struct random_numbers *seed, const fbd_parameter *parameter, struct text *vary)
{
    text_printf(vary, "%s=", parameter->name);
    for (int i = 0; i < rows; i++) {
        text_add(vary, i ? "," : "");
        text_number(vary, draw_value(seed, parameter->value), 17);
    }
    text_printf(vary, " %s", parameter->unit);
}

static void compare_rows(struct checks *checks, const char *what, const fbd_sweep *sweep)
{
    struct text together = {0}, apart = {0};
    make_rows(sweep, 0, rows, &together);
    for (size_t i = 0; i < rows; i++) make_rows(sweep, i, i + 1, &apart);
    assert_false(together.failed || apart.failed);
    bool same = strcmp(together.data, apart.data) == 0;
    if (!check_that(checks, what, same)) fprintf(stderr, "patched:\n%sread:\n%s", together.data, apart.data);
    text_free(&together);
    text_free(&apart);
}

static void sweep_parameters(struct checks *checks, struct random_numbers *seed, const char *path,
                             const fbd_model *model)
{
    size_t count = fbd_model_parameter_count(model), varied = count < most_varied ? count : most_varied;
    struct text axes[most_varied] = {{0}};
    const char *vary[most_varied];
    char file[400];
    snprintf(file, sizeof file, "%s/models/%s", getenv("FBD_SOURCE_ROOT"), path);
    size_t first = (size_t)((double)count * random_between(seed, 0, 1));
    for (size_t i = 0; i < varied; i++) {
        fbd_parameter parameter = fbd_model_parameter(model, (first + i) % count);
        add_axis(seed, &parameter, &axes[i]);
        vary[i] = axes[i].data;
    }
    const fbd_options options = {.until = 0.05, .method = "rk4", .step = 0.01}; /* any values, few steps */
    const fbd_sweep_plan plan = {.vary = vary, .vary_count = varied, .zip = true, .run = &options};
    fbd_errors *errors = fbd_errors_new();
    fbd_sweep *sweep = fbd_sweep_read(file, &plan, errors);
    if (sweep)
        compare_rows(checks, path, sweep); /* a value of the first or last row may be wrong by itself */
    fbd_sweep_free(sweep);
    fbd_errors_free(errors);
    for (size_t i = 0; i < varied; i++) text_free(&axes[i]);
}

static struct random_numbers seed_of_models = {7};

static void sweep_model(struct checks *checks, const char *path)
{
    struct trial trial = trial_open(path, NULL);
    if (fbd_model_parameter_count(trial.model) > 0)
        for (int round = 0; round < draws_of(2); round++)
            sweep_parameters(checks, &seed_of_models, path, trial.model);
    trial_close(&trial);
}

static void patched_rows_are_those_of_a_reading(void **state)
{
    struct checks checks = {0};
    (void)state;
    const char *seed = getenv("FBD_TEST_SEED");
    if (seed) seed_of_models.state = strtoull(seed, NULL, 10);
    fprintf(stderr, "seed %llu\n", (unsigned long long)seed_of_models.state);
    each_model_in_turn(&checks, 1, sweep_model);
    checks_end(&checks);
}

/* ---- what can be patched */

#define BEGIN "fbd: 1\nparameters: {p: 2}\nbodies:\n  b:\n"
#define END   "\nsimulate: {until: 1 s}\n"

static const struct patch_case {
    const char *text;
    bool patched;
} cases[] = {
    {BEGIN "    mass: p\n    motion: slide\n    forces: [applied: {value: 'm*p*t*1[m/s^3]'}]" END, true},
    {BEGIN "    mass: 1\n    motion: slide\n    initial: {x: 3*p, v: 3*p}" END, true},
    {BEGIN "    mass: 1\n    motion: slide\n    forces: [applied: {value: '1[N]*sin(p*t)'}]" END, true},
    {BEGIN "    parts: {one: {mass: p}, other: {mass: 1}}\n    motion: slide\n    forces: [spring: "
           "{stiffness: 'm'}]" END,
     false}, /* m in a constant is no name */
    {BEGIN "    parts: {one: {mass: p}, other: {mass: 1}}\n    motion: slide\n    forces: [applied: {value: "
           "'m*t*1[m/s^3]'}]" END,
     true},
    {BEGIN "    mass: 1\n    motion: slide\n    forces: [normal, friction: {static: 3*p, kinetic: p}]" END,
     true},
    {BEGIN "    mass: 1\n    motion: slide\n    forces: [normal, friction: {coefficient: p}]" END, true},
    {BEGIN "    mass: 1\n    motion: slide\n    forces: [normal, friction: {static: 3*p, kinetic: "
           "'p*exp(-abs(slip)/1[m/s])'}]" END,
     false}, /* the same text at rest is another expression */
    {BEGIN "    mass: 1\n    motion: {slide: {through: [p, 0]}}" END, false}, /* a pair may mean anything */
    {BEGIN "    mass: 1\n    motion: slide\n    forces: [power: {value: p}]" END,
     false}, /* another follows from it */
    {BEGIN "    mass: 1\n    motion: pivot\n    shape: rod\n    length: p" END,
     false}, /* and so do the ends of a rod */
};

/* With the values of a case beside p: 2. */
static struct patch *open_patch(const struct patch_case *example, struct document *document,
                                fbd_errors *errors)
{
    struct override p = {.name = "p", .value = "2.5", .varies = true}, prepared = {.name = "p"};
    const char *beside = "2.4";
    if (!document_open(document, example->text, strlen(example->text), NULL, errors) ||
        !document_prepare(document, &prepared, 1, errors))
        return NULL;
    document->without_hands = true;
    return patch_new(document, &p, 1, &beside);
}

static void only_what_is_stored_is_patched(void **state)
{
    struct checks checks = {0};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct document document;
        fbd_errors *errors = fbd_errors_new();
        struct patch *patch = open_patch(&cases[i], &document, errors);
        check_that(&checks, cases[i].text, (patch != NULL) == cases[i].patched);
        patch_free(patch);
        document_close(&document);
        fbd_errors_free(errors);
    }
    checks_end(&checks);
}

/* A value that leaves its side of 0 and 1 is read. */
static void a_value_stays_on_its_side(void **state)
{
    static const struct {
        const char *value;
        bool taken;
    } values[] = {{"7", true}, {"0.5", false}, {"0", false}, {"-2", false}, {"x", false}, {"3", true}};
    struct document document;
    fbd_errors *errors = fbd_errors_new();
    struct patch *patch = open_patch(&cases[0], &document, errors);
    (void)state;
    assert_non_null(patch);
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        const struct override p = {.name = "p", .value = values[i].value, .varies = true};
        struct scene *scene = patch_apply(patch, &p);
        assert_int_equal(scene != NULL, values[i].taken);
        if (scene) assert_true(scene->bodies[0].parts[0].mass == strtod(values[i].value, NULL));
    }
    patch_free(patch);
    document_close(&document);
    fbd_errors_free(errors);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patched_rows_are_those_of_a_reading),
        cmocka_unit_test(only_what_is_stored_is_patched),
        cmocka_unit_test(a_value_stays_on_its_side),
    };
    return cmocka_run_group_tests_name("patch", tests, NULL, NULL);
}
