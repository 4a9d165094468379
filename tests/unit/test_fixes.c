/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Fixes of notes: in the wrong model files of tests/bad each is an edit of the text that stands at its position,
 * and the edited text no longer has the note.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fbd.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

enum { most_bytes = 65536, longest_path = 1024, few_fixes = 30 };

static char folder[longest_path];

static fbd_errors *notes_of(const char *path, const char *text)
{
    fbd_errors *errors = fbd_errors_new();
    assert_non_null(errors);
    fbd_model_free(fbd_model_parse(text, strlen(text), path, NULL, 0, errors));
    return errors;
}

/* Where line and column are in a text, which may begin with a byte order mark. */
static const char *place_in(const char *text, int line, int column)
{
    if (strncmp(text, "\xEF\xBB\xBF", 3) == 0) text += 3;
    for (; line > 1; line--) text = strchr(text, '\n') + 1;
    while (column > 1 || ((unsigned char)*text & 0xC0) == 0x80) {
        if (((unsigned char)*text & 0xC0) != 0x80) column--;
        text++;
    }
    return text;
}

static bool same_note(fbd_error a, fbd_error b)
{
    return a.line == b.line && a.column == b.column && strcmp(a.id, b.id) == 0 &&
           strcmp(a.message, b.message) == 0;
}

static bool has_note(fbd_errors *errors, fbd_error note)
{
    for (size_t i = 0; i < fbd_errors_count(errors); i++)
        if (same_note(fbd_errors_get(errors, i), note)) return true;
    return false;
}

/* True if the fix is an edit of what stands there, which removes the note. */
static bool mends(const char *path, const char *text, fbd_error note, fbd_fix fix)
{
    static char edited[most_bytes + 256];
    const char *at = place_in(text, fix.line, fix.column);
    if (strncmp(at, fix.replace, strlen(fix.replace)) != 0) return false;
    snprintf(edited, sizeof edited, "%.*s%s%s", (int)(at - text), text, fix.with, at + strlen(fix.replace));
    fbd_errors *errors = notes_of(path, edited);
    bool mended = !has_note(errors, note);
    fbd_errors_free(errors);
    return mended;
}

/* A word that was suggested for another one at a known place has a fix. */
static bool lacks(fbd_error note, fbd_fix fix)
{
    return !fix.replace && note.line > 0 && note.hint && strncmp(note.hint, "did you mean", 12) == 0;
}

static int check_file(const char *path, int *fixes)
{
    static char text[most_bytes];
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    text[fread(text, 1, sizeof text - 1, stream)] = '\0';
    fclose(stream);
    fbd_errors *errors = notes_of(path, text);
    int failed = 0;
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        const fbd_error note = fbd_errors_get(errors, i);
        const fbd_fix fix = fbd_errors_fix(errors, i);
        if (fix.replace) (*fixes)++;
        if (fix.replace ? mends(path, text, note, fix) : !lacks(note, fix)) continue;
        print_error("%s:%d:%d: %s\n", path, note.line, note.column, note.message);
        failed++;
    }
    fbd_errors_free(errors);
    return failed;
}

static void every_fix_mends_its_note(void **state)
{
    (void)state;
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    int failed = 0, fixes = 0;
    const struct dirent *entry;
    while ((entry = readdir(directory)) != NULL) {
        char path[2 * longest_path];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (strstr(entry->d_name, ".yaml")) failed += check_file(path, &fixes);
    }
    closedir(directory);
    assert_int_equal(failed, 0);
    assert_true(fixes >= few_fixes);
}

/* The place of the first fix in the notes on a text; zero without one. */
static fbd_fix first_fix(const char *text)
{
    fbd_errors *errors = notes_of("model", text);
    fbd_fix fix = {0};
    for (size_t i = 0; i < fbd_errors_count(errors) && fix.line == 0; i++) fix = fbd_errors_fix(errors, i);
    fix.replace = fix.with = NULL;
    fbd_errors_free(errors);
    return fix;
}

static void a_fix_is_where_its_word_is(void **state)
{
    (void)state;
    fbd_fix quoted = first_fix("fbd: 1\nbodies: {b: {\"mas\": 1 kg, motion: slide, forces: []}}\n");
    assert_int_equal(quoted.line, 2);
    assert_int_equal(quoted.column, 15); /* behind the quote */
    fbd_fix behind = first_fix("fbd: 1\nbodies: {crate: {hand: [\"\xC3\xA4 = 1\"], mas: 1 kg}}\n");
    assert_int_equal(behind.line, 2); /* columns are characters, not bytes */
    assert_int_equal(behind.column, 35);
    fbd_fix escaped = first_fix("fbd: 1\nbodies: {b: {\"m\\x61s\": 1 kg, motion: slide, forces: []}}\n");
    assert_int_equal(escaped.line, 0); /* its word is not there */
}

static void none_is_given_without_a_place(void **state)
{
    (void)state;
    const char text[] = "fbd: 1\nbodies: {b: {mass: m, motion: slide, forces: []}}\nparameters: {m: 1 kg}\n";
    const fbd_setting setting = {"n", "2 kg"};
    fbd_errors *errors = fbd_errors_new();
    assert_null(fbd_model_parse(text, strlen(text), "model", &setting, 1, errors));
    assert_null(fbd_errors_fix(errors, 0).replace);
    assert_null(fbd_errors_fix(errors, 99).replace);
    assert_null(fbd_errors_fix(NULL, 0).with);
    fbd_errors_free(errors);
}

int main(int argc, char **argv)
{
    const char *root = argc > 1 ? argv[1] : getenv("FBD_SOURCE_ROOT");
    snprintf(folder, sizeof folder, "%s/tests/bad", root ? root : ".");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_fix_mends_its_note),
        cmocka_unit_test(a_fix_is_where_its_word_is),
        cmocka_unit_test(none_is_given_without_a_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
