/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Calculation notes by the library: the hash of texts against the examples of FIPS 180-4, numbers with units, notes that
 * are refused, and what the caller may ask of one.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/engineering.h"
#include "base/printed.h"
#include "base/sha256.h"
#include "fbd_export.h"
#include "fbd_view.h"

static const char block[] =
    "fbd: 1\n"
    "title: A block\n"
    "parameters: {m: 2 kg}\n"
    "bodies:\n"
    "  b: {mass: m, motion: slide, initial: {v: 3}, forces: [gravity, normal, friction: 0.5]}\n"
    "simulate: {until: 2}\n";

/* ---- hashes */

static void the_hash_is_that_of_the_standard(void **context)
{
    (void)context;
    static const struct {
        const char *text, *digits;
    } examples[] = {
        {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
        {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
        {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
         "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
    };
    char digits[sha256_size], million[1000000];
    for (size_t i = 0; i < sizeof examples / sizeof *examples; i++) {
        sha256_text(examples[i].text, strlen(examples[i].text), digits);
        assert_string_equal(digits, examples[i].digits);
    }
    memset(million, 'a', sizeof million);
    sha256_text(million, sizeof million, digits);
    assert_string_equal(digits, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

/* ---- numbers */

static void writes(double value, const char *unit, int digits, const char *expected)
{
    struct text text = {0};
    value_write(&text, value, unit, digits, false);
    assert_string_equal(text.data, expected);
    text_free(&text);
}

static void numbers_are_those_of_engineers(void **context)
{
    (void)context;
    writes(10150, "N", 4, "10.15\u00a0kN");
    writes(9999, "N", 4, "9999\u00a0N");
    writes(-2.5e7, "N*m", 4, "−25\u00a0MN·m");
    writes(1.9e5, "N/m", 6, "190\u00a0kN/m");
    writes(0.004, "m", 6, "4\u00a0mm");
    writes(0, "m", 6, "0\u00a0m");
    writes(9.81, "m/s^2", 6, "9.81\u00a0m/s²");
    writes(0.45093425, "s", 9, "0.45093425\u00a0s");
    writes(999999.6, "kg", 6, "1·10⁶\u00a0kg");
    writes(12345.67, "kg", 3, "12346\u00a0kg");
    writes(2.6e-16, "1", 2, "2.6·10⁻¹⁶");
    writes(0.00025, "", 2, "0.00025");
    writes(9999, "lbf", 4, "9999\u00a0lbf");
    writes(1.5e4, "lbf", 4, "15\u00a0kip");
    writes(2.5e4, "ft*lbf", 4, "25\u00a0ft·kip");
    writes(INFINITY, "N", 4, "?\u00a0N");
}

static void angles_are_in_degrees_if_wanted(void **context)
{
    (void)context;
    struct text text = {0};
    value_write(&text, acos(0.5), "rad", 6, true);
    text_add(&text, " ");
    value_write(&text, acos(0.5), "rad/s", 6, true);
    assert_string_equal(text.data, "60° 60°/s");
    text_free(&text);
}

static void symbols_have_greek_letters_and_indices(void **context)
{
    (void)context;
    struct text text = {0};
    text_symbol(&text, "mu_k");
    text_add(&text, " ");
    text_symbol(&text, "rod.theta_12");
    text_add(&text, " ");
    text_symbol(&text, "m_cart");
    assert_string_equal(text.data, "μₖ rod.θ₁₂ m_cart");
    text_free(&text);
}

/* ---- notes */

struct run {
    fbd_errors *errors;
    fbd_model *model;
    fbd_simulation *simulation;
    fbd_result *result;
};

static struct run run_of(const char *source, bool table)
{
    struct run run = {.errors = fbd_errors_new()};
    fbd_options options = FBD_OPTIONS_DEFAULT;
    options.error_bars = true;
    run.model = fbd_model_parse(source, strlen(source), NULL, NULL, 0, run.errors);
    run.simulation = fbd_simulation_new(run.model, &options, run.errors);
    run.result = fbd_simulation_run(run.simulation, &(fbd_recording){.table = table});
    assert_non_null(run.result);
    return run;
}

static void end_run(struct run *run)
{
    fbd_result_free(run->result);
    fbd_simulation_free(run->simulation);
    fbd_model_free(run->model);
    fbd_errors_free(run->errors);
}

static void a_note_outlives_its_run(void **context)
{
    (void)context;
    struct run run = run_of(block, true);
    const fbd_setting setting = {"m", "2 kg"};
    const fbd_note_options options = {.settings = &setting, .setting_count = 1, .date = "1 May"};
    fbd_note *note = fbd_note_new(run.simulation, run.result, &options, run.errors);
    end_run(&run);
    char *page = fbd_note_write(note, FBD_NOTE_HTML, NULL),
         *text = fbd_note_write(note, FBD_NOTE_MARKDOWN, "sheet");
    assert_true(strstr(page, "1 May") && strstr(page, "m = 2 kg"));
    assert_true(strstr(text, "(<sheet-1.svg>)"));
    assert_null(fbd_note_write(note, (fbd_note_format)9, NULL));
    assert_int_equal(fbd_note_drawing_count(note), 5); /* system, letters, body, x, v */
    assert_non_null(strstr(fbd_note_drawing(note, 4), "<svg"));
    assert_null(fbd_note_drawing(note, 5));
    assert_true(fbd_note_check_count(note) >= 5);
    assert_int_equal(fbd_note_failed_check_count(note), 0);
    free(page);
    free(text);
    fbd_note_free(note);
}

static void refuses(struct run *run, const fbd_note_options *options, const char *id)
{
    assert_null(fbd_note_new(run->simulation, run->result, options, run->errors));
    assert_string_equal(fbd_errors_get(run->errors, 0).id, id);
    end_run(run);
}

static int stop(void *context, const fbd_progress *progress)
{
    (void)context, (void)progress;
    return 1;
}

static void notes_are_refused(void **context)
{
    (void)context;
    static const char singular[] =
        "fbd: 1\nbodies:\n  b: {mass: 1, motion: slide, initial: {x: 1}, forces: [applied: "
        "{name: f, value: '-1[N*m]/x'}]}\nsimulate: {until: 10}\n";
    struct run unrecorded = run_of(block, false), failed = run_of(singular, true),
               stopped = run_of(block, true);
    refuses(&unrecorded, NULL, "not-recorded");
    refuses(&failed, NULL, "no-note");
    refuses(&stopped, &(fbd_note_options){.progress = stop}, "stopped");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_hash_is_that_of_the_standard),
        cmocka_unit_test(numbers_are_those_of_engineers),
        cmocka_unit_test(angles_are_in_degrees_if_wanted),
        cmocka_unit_test(symbols_have_greek_letters_and_indices),
        cmocka_unit_test(a_note_outlives_its_run),
        cmocka_unit_test(notes_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
