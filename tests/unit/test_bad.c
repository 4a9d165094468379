/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Wrong model files, one for each mistake that people make. Each says in comment lines what it must be
 * answered with, and nothing else may be said:
 *
 *     # expect: <line>:<column> <error|warning> <id>: <words of the message>
 *     # hint: <words of the hint of the expectation above>
 *
 * The folder is tests/bad below FBD_SOURCE_ROOT, or below the first argument.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "output/hand_forces.h"
#include "scene_fixture.h"

#include <dirent.h>
#include <stdlib.h>

enum { most_expected = 32, most_bytes = 65536, most_files = 1000, longest_path = 1024 };

struct expectation {
    int line, column;
    char severity[16], id[48], words[200], hint[200];
};

struct wrong_file {
    char text[most_bytes];
    size_t length;
    struct expectation expected[most_expected];
    size_t count;
};

static char folder[longest_path];

/* ---- reading what a file expects */

static int parse_number(const char **text)
{
    char *end;
    long number = strtol(*text, &end, 10);
    assert_true(end > *text && *end && number >= 0 && number < 10000000);
    *text = end + 1;
    return (int)number;
}

static void parse_expectation(struct expectation *expected, const char *text)
{
    expected->line = parse_number(&text);
    expected->column = parse_number(&text);
    int fields = sscanf(text, "%15s %47[^:]: %199[^\n]", expected->severity, expected->id, expected->words);
    assert_int_equal(fields, 3);
}

static void parse_line(struct wrong_file *file, const char *line)
{
    static const char expect[] = "# expect: ";
    if (strncmp(line, expect, sizeof expect - 1) == 0) {
        assert_true(file->count < most_expected);
        parse_expectation(&file->expected[file->count++], line + sizeof expect - 1);
    } else if (strncmp(line, "# hint: ", 8) == 0) {
        assert_true(file->count > 0);
        assert_int_equal(sscanf(line, "# hint: %199[^\n]", file->expected[file->count - 1].hint), 1);
    }
}

static void read_file(const char *path, struct wrong_file *file)
{
    FILE *stream = fopen(path, "rb");
    assert_non_null(stream);
    *file = (struct wrong_file){0};
    file->length = fread(file->text, 1, sizeof file->text - 1, stream);
    fclose(stream);
    assert_true(file->length < sizeof file->text - 1);
    for (const char *line = file->text; line && *line; line = strchr(line, '\n')) {
        if (*line == '\n') line++;
        parse_line(file, line);
    }
}

/* ---- checking */

static bool matches(const struct expectation *expected, fbd_error note)
{
    bool error = strcmp(expected->severity, "error") == 0;
    return expected->line == note.line && expected->column == note.column &&
           error == (note.severity == FBD_ERROR) && strcmp(expected->id, note.id) == 0 &&
           strstr(note.message, expected->words) &&
           (!*expected->hint ||
            (note.hint && strncmp(note.hint, expected->hint, strlen(expected->hint)) == 0));
}

/* True when notes and expectations pair off, in any order. */
static bool pairs_off(const struct wrong_file *file, fbd_errors *errors)
{
    bool met[most_expected] = {false};
    size_t count = fbd_errors_count(errors);
    for (size_t i = 0; i < count; i++) {
        size_t k = 0;
        while (k < file->count && (met[k] || !matches(&file->expected[k], fbd_errors_get(errors, i)))) k++;
        if (k == file->count) return false;
        met[k] = true;
    }
    return count == file->count;
}

static bool check_file(const char *name)
{
    static struct wrong_file file;
    char path[2 * longest_path];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    read_file(path, &file);
    fbd_errors *errors = fbd_errors_new();
    struct document document;
    struct fbd_model *model = NULL;
    if (document_open(&document, file.text, file.length, name, errors))
        model = hands_compile(&document, NULL, 0, errors);
    document_close(&document);
    bool fine = file.count > 0 && pairs_off(&file, errors);
    if (!fine) {
        print_error("%s expects %zu notes and is answered:\n", name, file.count);
        fbd_errors_print(errors, stderr);
    }
    if (model) model_free(model);
    fbd_errors_free(errors);
    return fine;
}

static bool ends_with(const char *text, const char *end)
{
    size_t length = strlen(text), wanted = strlen(end);
    return length > wanted && strcmp(text + length - wanted, end) == 0;
}

static void every_wrong_file_is_answered_as_it_says(void **state)
{
    (void)state;
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    int files = 0, failed = 0;
    const struct dirent *entry;
    while ((entry = readdir(directory)) != NULL && files < most_files) {
        if (!ends_with(entry->d_name, ".yaml")) continue;
        files++;
        if (!check_file(entry->d_name)) failed++;
    }
    closedir(directory);
    if (failed) print_error("%d of %d files\n", failed, files);
    assert_int_equal(failed, 0);
    assert_true(files >= 75);
}

int main(int argc, char **argv)
{
    const char *root = argc > 1 ? argv[1] : getenv("FBD_SOURCE_ROOT");
    snprintf(folder, sizeof folder, "%s/tests/bad", root ? root : ".");
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_wrong_file_is_answered_as_it_says)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
