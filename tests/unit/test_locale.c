/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Numbers are those of the C locale whatever the program around the library has said to setlocale: everything
 * that the public interface reads and writes is the same, byte by byte, under a locale with a decimal comma
 * and under one with letters of 8 bits and a dotless i as well. They are made for the test.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_errno.h>
#include <locale.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "fbd.h"
#include "fbd_export.h"
#include "fbd_grade.h"
#include "fbd_study.h"

static const struct {
    const char *name, *source, *charmap;
} locales[] = {{"de_DE.UTF-8", "de_DE", "UTF-8"}, {"tr_TR.ISO-8859-9", "tr_TR", "ISO-8859-9"}};

enum { locale_count = sizeof locales / sizeof *locales };

/* ---- what the library says */

static void put(struct text *text, const char *heading, char *made)
{
    assert_non_null(made);
    text_add(text, heading);
    text_add(text, "\n");
    text_add(text, made);
    text_add(text, "\n");
    free(made);
}

static void put_errors(struct text *text, fbd_errors *errors)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error e = fbd_errors_get(errors, i);
        text_printf(text, "%d:%d: %s\n", e.line, e.column, e.message);
        if (e.hint) text_add(text, e.hint);
        text_add(text, "\n");
    }
    fbd_errors_free(errors);
}

static int put_rows(void *context, const char *rows, size_t length)
{
    text_add_bytes(context, rows, length);
    return 0;
}

static fbd_model *read_model(const char *name, const fbd_setting *settings, size_t count)
{
    char path[1000];
    const char *root = getenv("FBD_SOURCE_ROOT");
    snprintf(path, sizeof path, "%s/models/%s", root ? root : ".", name);
    return fbd_model_read(path, settings, count, NULL);
}

static void put_run(struct text *text, const fbd_model *model)
{
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.until = 0.0625;
    options.error_bars = true;
    fbd_simulation *simulation = fbd_simulation_new(model, &options, NULL);
    const fbd_recording recording = {
        .every = 0.015625, .ledger = true, .csv = put_rows, .csv_context = text, .keep = true, .table = true};
    fbd_result *result = fbd_simulation_run(simulation, &recording);
    assert_non_null(result);
    put(text, "report", fbd_result_report(result, false));
    put(text, "json", fbd_result_json(result));
    put(text, "gnuplot", fbd_result_gnuplot(result, "a.pdf", NULL, NULL));
    if (fbd_has_html()) put(text, "html", fbd_result_html(result, NULL));
    fbd_note *note = fbd_note_new(simulation, result, &(fbd_note_options){.date = "today"}, NULL);
    assert_non_null(note);
    put(text, "note.html", fbd_note_write(note, FBD_NOTE_HTML, NULL));
    put(text, "note.tex", fbd_note_write(note, FBD_NOTE_LATEX, NULL));
    fbd_note_free(note);
    text_add(text, fbd_simulation_reason(simulation));
    fbd_result_free(result);
    fbd_simulation_free(simulation);
}

static void put_state(struct text *text, const fbd_model *model, const char *name, const char *value)
{
    fbd_state *state = fbd_state_new(model);
    assert_true(!name || fbd_state_set_text(state, name, value, NULL));
    const fbd_drawing drawing = {.components = true};
    put(text, "equations", fbd_equations_write(state, NULL, NULL));
    put(text, "mathml", fbd_equations_write(state, &(fbd_equations_options){.format = FBD_MATHML}, NULL));
    put(text, "latex", fbd_equations_write(state, &(fbd_equations_options){.format = FBD_LATEX}, NULL));
    put(text, "svg", fbd_diagram_svg(state, &drawing, NULL));
    fbd_statics *statics = fbd_statics_new(state, NULL);
    if (statics) put(text, "statics", fbd_statics_text(statics));
    if (statics) put(text, "statics.json", fbd_statics_json(statics));
    fbd_statics_free(statics);
    fbd_linearization *linear = fbd_linearize(state, NULL);
    if (linear) put(text, "linear", fbd_linearization_text(linear));
    if (linear) put(text, "linear.svg", fbd_linearization_svg(linear));
    fbd_linearization_free(linear);
    fbd_state_free(state);
}

static void put_model(struct text *text, const char *path, const char *name, const char *value)
{
    fbd_model *model = read_model(path, NULL, 0);
    assert_non_null(model);
    const fbd_options options = FBD_OPTIONS_DEFAULT;
    put(text, path, fbd_check_hand(model, 7, NULL));
    put(text, "explain", fbd_explain(model, &options));
    put_run(text, model);
    put_state(text, model, name, value);
    fbd_model_free(model);
}

static void put_sweep(struct text *text)
{
    static const char *const vary[] = {"mu_k=0.125:0.375:3", "v0=1.5,2.5 m/s", "f1=uniform(0.5,1.5) N:2"};
    static const char *const outputs[] = {"final,times,energy"};
    const fbd_sweep_plan plan = {
        .vary = vary, .vary_count = 3, .seed = 3, .outputs = outputs, .output_count = 1};
    const fbd_sweep_work work = {.end = 12, .jobs = 2, .write = put_rows, .write_context = text};
    char path[1000];
    const char *root = getenv("FBD_SOURCE_ROOT");
    snprintf(path, sizeof path, "%s/models/kinetics/incline.yaml", root ? root : ".");
    fbd_sweep *sweep = fbd_sweep_read(path, &plan, NULL);
    fbd_sweep_counts counts;
    assert_non_null(sweep);
    text_add(text, fbd_sweep_header(sweep));
    text_add(text, fbd_sweep_key(sweep));
    assert_int_equal(fbd_sweep_run(sweep, &work, &counts), FBD_SWEEP_DONE);
    fbd_sweep_free(sweep);
}

/* Messages with numbers, and words that are told without regard to case. */
static void put_mistakes(struct text *text)
{
    static const char wrong[] = "fbd: 1\n"
                                "gravity: 32.2\n"
                                "bodies:\n"
                                "  a: {mass: INF, motion: slide}\n"
                                "  b: {mass: 1.5 kg, motion: {pivot: {at: [1.25, IF]}}}\n"
                                "  c: {mass: 1,5 kg, motion: slide, forces: [GRAVITI]}\n"
                                "  d: {mass: -0.5, motion: slide, assemble: ON}\n"
                                "simulate: {until: 1.5 s, tolerance: 0.75}\n";
    const char *const all[] = {wrong, "fbd: 1\nbodies:\n  d:\n    mass:2.5\n    motion: slide\n",
                               "fbd: 1\nbodies:\n  d\xC3\xA4:2.5\n    motion: slide\n"};
    for (size_t i = 0; i < 3; i++) {
        fbd_errors *errors = fbd_errors_new();
        assert_null(fbd_model_parse(all[i], strlen(all[i]), "wrong", NULL, 0, errors));
        put_errors(text, errors);
    }
}

/* Times that a run has taken differ from run to run: numbers before ` ms` and behind `seconds":`. */
static void drop_times(struct text *text)
{
    char *to = text->data;
    for (const char *from = text->data; *from;) {
        if (strncmp(from, " ms", 3) == 0)
            while (to > text->data && strchr("0123456789.,e-\xD9\xAB", to[-1])) to--;
        bool seconds = strncmp(from, "\"seconds", 8) == 0;
        *to++ = *from++;
        if (!seconds) continue;
        while (*from && to[-1] != ':') *to++ = *from++;
        while (*from && !strchr("}\n", *from) && strncmp(from, ", \"", 3) != 0 &&
               strncmp(from, ",\"", 2) != 0)
            from++;
    }
    *to = '\0';
    text->length = (size_t)(to - text->data);
}

static struct text everything(void)
{
    struct text text = {0};
    const fbd_setting settings[] = {{"phi", "12.5 deg"}, {"mu_k", "0.5*0.75"}};
    put_model(&text, "kinetics/incline.yaml", "block.x", "0.75 m");
    put_model(&text, "rotation/compound_pendulum.yaml", "pendulum.theta", "12.5 deg");
    put_model(&text, "couplings/slider_crank.yaml", "crank.theta", "0.75");
    fbd_model *ladder = read_model("statics/ladder.yaml", NULL, 0);
    put_state(&text, ladder, NULL, NULL);
    fbd_model_free(ladder);
    fbd_model *model = read_model("kinetics/incline.yaml", settings, 2);
    assert_non_null(model);
    put_run(&text, model);
    fbd_model_free(model);
    put_sweep(&text);
    put_mistakes(&text);
    assert_false(text.failed);
    drop_times(&text);
    return text;
}

/* ---- locales */

static char place[] = "/tmp/fbd-locale-XXXXXX";

static bool make_locales(void)
{
    char command[500];
    if (!mkdtemp(place)) return false;
    for (size_t i = 0; i < locale_count; i++) {
        snprintf(command, sizeof command, "localedef -i %s -f %s '%s/%s' >/dev/null 2>&1", locales[i].source,
                 locales[i].charmap, place, locales[i].name);
        if (system(command) > 1 << 8) return false; /* 1 is for warnings */
    }
    return setenv("LOCPATH", place, 1) == 0;
}

static void same_text(const struct text *expected, const struct text *actual, const char *name)
{
    size_t line = 1, at = 0;
    while (at < expected->length && at < actual->length && expected->data[at] == actual->data[at])
        line += expected->data[at++] == '\n';
    if (at == expected->length && at == actual->length) return;
    print_message("%s, line %zu:\n%.60s\ninstead of\n%.60s\n", name, line, actual->data + at,
                  expected->data + at);
    fail();
}

static struct text plain; /* under the C locale */

static int take_plain(void **unused)
{
    (void)unused;
    plain = everything();
    return 0;
}

static void numbers_are_those_of_the_C_locale(void **unused)
{
    (void)unused;
    for (size_t i = 0; i < locale_count; i++) {
        assert_non_null(setlocale(LC_ALL, locales[i].name));
        struct text there = everything();
        char sign[8];
        snprintf(sign, sizeof sign, "%.1f", 0.5);
        setlocale(LC_ALL, "C");
        assert_string_not_equal(sign, "0.5"); /* that locale is in force */
        same_text(&plain, &there, locales[i].name);
        text_free(&there);
    }
}

static void *in_a_thread(void *name)
{
    locale_t locale = newlocale(LC_ALL_MASK, name, (locale_t)0);
    if (!locale) return NULL;
    uselocale(locale);
    struct text *there = malloc(sizeof *there);
    if (there) *there = everything();
    char sign[8];
    snprintf(sign, sizeof sign, "%.1f", 0.5);
    if (there && strcmp(sign, "0.5") == 0) there->failed = true; /* the locale of the thread is lost */
    uselocale(LC_GLOBAL_LOCALE);
    freelocale(locale);
    return there;
}

static void so_they_are_in_threads_with_locales_of_their_own(void **unused)
{
    (void)unused;
    pthread_t threads[2];
    static char names[2][20] = {"de_DE.UTF-8", "tr_TR.ISO-8859-9"};
    for (int i = 0; i < 2; i++) assert_int_equal(pthread_create(&threads[i], NULL, in_a_thread, names[i]), 0);
    for (int i = 0; i < 2; i++) {
        void *made;
        pthread_join(threads[i], &made);
        struct text *there = made;
        assert_non_null(there);
        assert_false(there->failed);
        same_text(&plain, there, names[i]);
        text_free(there);
        free(there);
    }
}

static void the_locale_of_the_program_stays(void **unused)
{
    (void)unused;
    char sign[8];
    assert_non_null(setlocale(LC_ALL, "de_DE.UTF-8"));
    struct text there = {0};
    put_model(&there, "kinetics/incline.yaml", "block.x", "0.75 m");
    snprintf(sign, sizeof sign, "%.1f", 0.5);
    setlocale(LC_ALL, "C");
    text_free(&there);
    assert_string_equal(sign, "0,5");
}

int main(void)
{
    gsl_set_error_handler_off();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_are_those_of_the_C_locale),
        cmocka_unit_test(so_they_are_in_threads_with_locales_of_their_own),
        cmocka_unit_test(the_locale_of_the_program_stays),
    };
    if (!make_locales() || !setlocale(LC_ALL, "de_DE.UTF-8")) {
        puts("1..0 # SKIP localedef cannot make locales here (Debian: package locales)");
        return 0;
    }
    setlocale(LC_ALL, "C");
    int failed = cmocka_run_group_tests(tests, take_plain, NULL);
    text_free(&plain);
    char command[100];
    snprintf(command, sizeof command, "rm -rf '%s'", place);
    return system(command) != 0 || failed;
}
