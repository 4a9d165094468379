/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "grading.h"

#include <errno.h>
#include <string.h>

#include "complain.h"
#include "fbd_grade.h"
#include "place.h"
#include "standard_streams.h"
#include "whole_file.h"

/* An output must not overwrite the key or an answer. */
bool grading_agrees(const struct options *options, const struct command_line *line, bool others)
{
    const struct output_place places[] = {{"--csv", options->csv},
                                          {"--json", options->json},
                                          {"--page", options->page}};
    bool grades = options->action == action_grade, solution = options->drawing.solution;
    bool of_answers = options->csv || options->json || options->quiet || options->details;
    const char *wrong = NULL;
    if (grades && options->student && options->answer_count != 1)
        wrong = "--student goes with one answer; without it each is called as its file";
    else if (!grades && !options->student)
        wrong = "--handout needs --student NAME";
    else if (others)
        wrong = "with --grade go --set, --student, --details, --csv, --json and --quiet only; with "
                "--handout --set, --student, --solution, --page and --exam only";
    else if (grades && (solution || options->page))
        wrong = "--solution and --page go with --handout, not with --grade";
    else if (!grades && of_answers)
        wrong = "with --handout go --set, --student, --solution, --page and --exam only";
    else if (options->page && solution)
        wrong = "--page is to be drawn on: --solution is without it";
    else if (options->exam && !options->page)
        wrong = "--exam goes with --handout and --page";
    if (wrong) return command_line_usage(line, wrong, "");
    for (size_t i = 0; i < options->answer_count; i++)
        if (!places_differ(line, options->answers[i], places, sizeof places / sizeof *places)) return false;
    return places_differ(line, options->model, places, sizeof places / sizeof *places);
}

/* Outputs other than the text. */
struct tables {
    struct whole_file json, csv;
    bool first;
};

static bool open_one(struct whole_file *file, const char *path)
{
    if (!path || whole_file_open(file, path)) return true;
    complain("fbd-run: cannot write `%s`: %s", path, strerror(errno));
    return false;
}

static bool close_one(struct whole_file *file, const char *path, bool keep)
{
    if (!path || !file->stream || whole_file_close(file, keep) || !keep) return true;
    complain("fbd-run: cannot write `%s`: %s", path, strerror(errno));
    return false;
}

/* Write a CSV field, quoted if it contains a separator, quote or newline. */
static void put_field(FILE *stream, const char *text)
{
    bool quotes = strpbrk(text, ",\"\n\r") != NULL;
    if (quotes) fputc('"', stream);
    for (; *text; text++) {
        if (*text == '"') fputc('"', stream);
        fputc(*text, stream);
    }
    if (quotes) fputc('"', stream);
    fputc(',', stream);
}

/* Write the number of findings of each kind, one column per kind. */
static void put_kinds(FILE *stream, const fbd_grade *grade)
{
    for (int kind = 0; *fbd_finding_kind_name((fbd_finding_kind)kind); kind++) {
        size_t count = 0;
        for (size_t i = 0; i < fbd_grade_finding_count(grade); i++)
            count += (int)fbd_grade_finding(grade, i).kind == kind;
        fprintf(stream, ",%zu", count);
    }
    fputc('\n', stream);
}

static void put_header(FILE *stream)
{
    fputs("student,file,points,max_points,score,passed", stream);
    for (int kind = 0; *fbd_finding_kind_name((fbd_finding_kind)kind); kind++)
        fprintf(stream, ",%s", fbd_finding_kind_name((fbd_finding_kind)kind));
    fputc('\n', stream);
}

static void put_row(FILE *stream, const fbd_grade *grade, const char *student, const char *file)
{
    double points = fbd_grade_points(grade), most = fbd_grade_most(grade);
    put_field(stream, student);
    put_field(stream, file);
    fprintf(stream, "%.10g,%.10g,%.10g,%s", points, most, points / most,
            fbd_grade_passed(grade) ? "yes" : "no");
    put_kinds(stream, grade);
}

/* The default name of the student: that of the file. */
static void name_of(const char *path, char *name, size_t room)
{
    const char *slash = strrchr(path, '/'), *start = slash ? slash + 1 : path, *dot = strrchr(start, '.');
    size_t length = dot && dot != start ? (size_t)(dot - start) : strlen(start);
    if (length >= room) length = room - 1;
    memcpy(name, start, length);
    name[length] = '\0';
}

static bool put_json(struct tables *tables, const fbd_grade *grade, bool details)
{
    char *json = fbd_grade_json(grade, details);
    if (!json) return false;
    fputs(tables->first ? "\n" : ",\n", tables->json.stream);
    fputs(json, tables->json.stream);
    tables->first = false;
    fbd_free(json);
    return true;
}

static enum exit_code grade_one(const struct options *options, const fbd_key *key, const char *path,
                                struct tables *tables, fbd_errors *errors)
{
    char name[256];
    name_of(path, name, sizeof name);
    const char *student = options->student ? options->student : name;
    fbd_grade *grade = fbd_grade_new(key, path, student, errors);
    bool silent = options->quiet || options_use_stdout(options);
    char *text = grade && !silent ? fbd_grade_text(grade, options->details) : NULL;
    bool done = grade && (silent || text) && (!options->json || put_json(tables, grade, options->details));
    if (done && text) fputs(text, stdout);
    if (done && options->csv) put_row(tables->csv.stream, grade, student, path);
    enum exit_code code = !done ? exit_failed : fbd_grade_passed(grade) ? exit_done : exit_hand_differs;
    if (!done && grade) complain("fbd-run: out of memory");
    fbd_free(text);
    fbd_grade_free(grade);
    return code;
}

static enum exit_code grade_all(const struct options *options, const fbd_key *key, fbd_errors *errors)
{
    struct tables tables = {.first = true};
    enum exit_code code = exit_done;
    bool open = open_one(&tables.json, options->json) && open_one(&tables.csv, options->csv);
    if (open && options->json) fputs("{\"answers\": [", tables.json.stream);
    if (open && options->csv) put_header(tables.csv.stream);
    for (size_t i = 0; open && i < options->answer_count && code != exit_failed; i++) {
        enum exit_code one = grade_one(options, key, options->answers[i], &tables, errors);
        if (one != exit_done) code = one;
    }
    bool keep = open && code != exit_failed;
    if (keep && options->json) fputs("\n]}\n", tables.json.stream);
    bool written = close_one(&tables.json, options->json, keep);
    written = close_one(&tables.csv, options->csv, keep) && written;
    return open && written ? code : exit_failed;
}

/* Print notes and derive the exit code from them. */
static enum exit_code finish(fbd_key *key, fbd_errors *errors, enum exit_code code)
{
    fflush(stdout);
    if (code != exit_failed && !standard_output_arrives("fbd-run")) code = exit_failed;
    fbd_errors_print(errors, stderr);
    code = exit_code_for(code, errors);
    fbd_key_free(key);
    fbd_errors_free(errors);
    return code;
}

static fbd_key *read_key(const struct options *options, fbd_errors *errors)
{
    return errors ? fbd_key_read_set(options->model, options->settings, options->setting_count, errors)
                  : NULL;
}

enum exit_code grading(const struct options *options)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_key *key = read_key(options, errors);
    if (!errors) {
        complain("fbd-run: out of memory");
        return exit_failed;
    }
    return finish(key, errors, key ? grade_all(options, key, errors) : exit_bad_model);
}

static bool put_page(const char *path, const char *page)
{
    if (whole_file_put(path, page)) return true;
    complain("fbd-run: cannot write `%s`: %s", path, strerror(errno));
    return false;
}

enum exit_code handout(const struct options *options)
{
    fbd_errors *errors = fbd_errors_new();
    fbd_key *key = read_key(options, errors);
    if (!errors) {
        complain("fbd-run: out of memory");
        return exit_failed;
    }
    char *text = !key                        ? NULL
                 : options->page             ? fbd_key_page(key, options->student, options->exam, errors)
                 : options->drawing.solution ? fbd_key_solution(key, options->student, errors)
                                             : fbd_key_handout(key, options->student, errors);
    enum exit_code code = text ? exit_done : key ? exit_failed : exit_bad_model;
    if (text && options->page) {
        if (!put_page(options->page, text)) code = exit_failed;
    } else if (text) {
        fputs(text, stdout);
    }
    fbd_free(text);
    return finish(key, errors, code);
}
