/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A model is constant: threads that share one and ask it everything at the same time get, bit for bit, what
 * one thread gets alone. Built with -Db_sanitize=thread (`make tsan`) the same program shows that nothing is
 * written that two of them see.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd_export.h"
#include "fbd_study.h"
#include "gallery.h"
#include "scenes.h"

#include <gsl/gsl_errno.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { threads = 3 };

/* ---- everything that a model answers, as one text */

struct answer {
    char *text;
    size_t length;
};

static void append(struct answer *answer, const char *text, size_t length)
{
    char *more = realloc(answer->text, answer->length + length + 1);
    if (!more) abort();
    memcpy(more + answer->length, text, length);
    answer->text = more;
    answer->length += length;
    more[answer->length] = '\0';
}

static int append_row(void *context, const char *text, size_t length)
{
    append(context, text, length);
    return 0;
}

/* A text of the library, freed here; its absence is part of the answer. */
static void append_text(struct answer *answer, char *text)
{
    const char *shown = text ? text : "(none)\n";
    append(answer, shown, strlen(shown));
    free(text);
}

/* What a clock says is no answer: the numbers behind "seconds" and "seconds_spent" are cut out. */
static void append_timed(struct answer *answer, char *text)
{
    for (char *at = text; at && (at = strstr(at, "\"seconds")) != NULL;) {
        at = strchr(at, ':') + 1;
        char *behind = at + strcspn(at, ",}\n");
        memmove(at, behind, strlen(behind) + 1);
    }
    append_text(answer, text);
}

static void append_errors(struct answer *answer, fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error error = fbd_errors_get(errors, i);
        append(answer, error.message, strlen(error.message));
    }
}

static void ask_at_the_start(struct answer *answer, const fbd_model *model, fbd_errors *errors)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    append_text(answer, fbd_explain(model, &options));
    fbd_state *state = fbd_state_new(model);
    if (!state) abort();
    if (fbd_state_close(state, errors)) {
        append_text(answer, fbd_equations_write(state, NULL, NULL));
        append_text(answer, fbd_diagram_svg(state, NULL, errors));
    }
    fbd_statics *statics = fbd_statics_new(state, errors);
    if (statics) append_text(answer, fbd_statics_json(statics));
    fbd_statics_free(statics);
    fbd_linearization *linear = fbd_linearize(state, errors);
    if (linear) append_text(answer, fbd_linearization_text(linear));
    fbd_linearization_free(linear);
    fbd_state_free(state);
}

static void ask_for_a_run(struct answer *answer, const fbd_model *model, bool page, fbd_errors *errors)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = 0.05;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, errors);
    if (!simulation) return;
    fbd_recording recording = {
        .every = 0.01, .ledger = true, .csv = append_row, .csv_context = answer, .keep = page};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    if (!result) abort();
    append_timed(answer, fbd_result_json(result));
    if (page && fbd_has_html()) append_timed(answer, fbd_result_html(result, errors));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
}

/* The page is asked for where the scenes are few: it takes longer than all else. */
static struct answer ask(const fbd_model *model, bool page)
{
    struct answer answer = {0};
    fbd_errors *errors = fbd_errors_new();
    if (!errors) abort();
    ask_at_the_start(&answer, model, errors);
    ask_for_a_run(&answer, model, page, errors);
    append_errors(&answer, errors);
    fbd_errors_free(errors);
    return answer;
}

/* ---- by several threads at once */

struct asker {
    const fbd_model *model;
    bool page;
    struct answer answer;
    pthread_t thread;
};

static void *ask_aside(void *context)
{
    struct asker *asker = context;
    asker->answer = ask(asker->model, asker->page);
    return NULL;
}

static void check_shared(struct checks *checks, const char *what, const fbd_model *model, bool page)
{
    struct answer alone = ask(model, page);
    struct asker askers[threads];
    for (size_t i = 0; i < threads; i++) {
        askers[i] = (struct asker){.model = model, .page = page};
        assert_int_equal(pthread_create(&askers[i].thread, NULL, ask_aside, &askers[i]), 0);
    }
    bool same = alone.length > 0;
    for (size_t i = 0; i < threads; i++) {
        pthread_join(askers[i].thread, NULL);
        same = same && askers[i].answer.length == alone.length &&
               memcmp(askers[i].answer.text, alone.text, alone.length) == 0;
        free(askers[i].answer.text);
    }
    check_that(checks, what, same);
    free(alone.text);
}

static void check_model(struct checks *checks, const char *path)
{
    struct trial trial = trial_open(path, NULL);
    check_shared(checks, path, trial.model, false);
    trial_close(&trial);
}

static void threads_that_share_a_model_of_the_gallery_get_the_same_bits(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    each_model_in_turn(&checks, 2, check_model);
    checks_end(&checks);
}

static void threads_that_share_any_scene_get_the_same_bits(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    for (size_t i = 0; i < all_scenes_count; i++) {
        fbd_model *model = model_from(all_scenes[i].text);
        check_shared(&checks, all_scenes[i].name, model, true);
        fbd_model_free(model);
    }
    checks_end(&checks);
}

/* ---- a sweep by several threads */

static struct answer rows_of(const fbd_sweep *sweep, size_t jobs)
{
    struct answer answer = {0};
    fbd_sweep_work work = {.end = fbd_sweep_run_count(sweep),
                           .jobs = jobs,
                           .write = append_row,
                           .write_context = &answer};
    fbd_sweep_counts counts;
    assert_int_equal(fbd_sweep_run(sweep, &work, &counts), FBD_SWEEP_DONE);
    return answer;
}

static void a_sweep_by_three_threads_has_the_rows_of_one(void **unused)
{
    (void)unused;
    static const char text[] = "fbd: 1\n"
                               "parameters: {mu: 0.3, push: 5 N}\n"
                               "bodies:\n"
                               "  block:\n"
                               "    mass: 2\n"
                               "    motion: {slide: {along: 20 deg}}\n"
                               "    initial: {v: 3 m/s}\n"
                               "    forces:\n"
                               "      - gravity\n"
                               "      - normal\n"
                               "      - friction: {static: mu, kinetic: mu}\n"
                               "      - applied: {value: \"push*sin(3[rad/s]*t)\"}\n"
                               "simulate: {until: 2 s}\n";
    const char *vary[] = {"mu=uniform(0.1,0.9):20", "push=0:40:10"};
    fbd_sweep_plan plan = {.vary = vary, .vary_count = 2, .seed = 5};
    fbd_errors *errors = fbd_errors_new();
    fbd_sweep *sweep = fbd_sweep_parse(text, strlen(text), "block.yaml", &plan, errors);
    if (!sweep) fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    assert_non_null(sweep);
    struct answer alone = rows_of(sweep, 1), together = rows_of(sweep, threads);
    assert_int_equal(alone.length, together.length);
    assert_memory_equal(alone.text, together.text, alone.length);
    free(alone.text);
    free(together.text);
    fbd_sweep_free(sweep);
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_that_share_a_model_of_the_gallery_get_the_same_bits),
        cmocka_unit_test(threads_that_share_any_scene_get_the_same_bits),
        cmocka_unit_test(a_sweep_by_three_threads_has_the_rows_of_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
