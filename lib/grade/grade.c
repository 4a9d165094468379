/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: compare an answer with a key.
 */
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/text.h"
#include "fbd_grade.h"
#include "grade/grade.h"

/* The name of a file without folders and extension. */
static const char *stem(struct arena *arena, const char *path)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    return arena_text(arena, name, dot && dot != name ? (size_t)(dot - name) : strlen(name));
}

static double sum(const struct fbd_grade *grade)
{
    double points = 0;
    for (const struct finding *one = grade->first; one; one = one->next) points += one->finding.points;
    return points;
}

/* A key may be invalid for the values drawn for a student: then the answer cannot be graded. */
static bool make_sheet(struct fbd_grade *grade)
{
    fbd_errors *errors = fbd_errors_new();
    if (!errors) return false;
    grade->sheet = grade_compile(grade, grade->key->root, grade->key->file, true, errors);
    const fbd_error *error = diag_get(errors, 0);
    bool done = grade->sheet != NULL || (error && !errors->out_of_memory);
    if (!grade->sheet && done) {
        fbd_finding *finding = finding_add(grade, FBD_FINDING_NO_SUBMISSION, "", "", (struct pos){0, 0});
        finding_say(grade, finding, "the sheet of this student cannot be made: ask the teacher");
        finding_tell(grade, finding, error->message);
    }
    fbd_errors_free(errors);
    return done;
}

static void hold_against(struct fbd_grade *grade, const struct submission *submission, fbd_errors *errors)
{
    struct answer answer;
    if (answer_read(grade, submission, &answer, errors)) {
        grade_bodies(grade, answer.model);
        grade_lines(grade, answer.root);
    }
    answer_close(&answer);
}

static fbd_grade *make_grade(const fbd_key *key, const struct submission *submission, const char *file,
                             const char *student, fbd_errors *errors)
{
    fbd_grade *grade = calloc(1, sizeof *grade);
    if (!grade) {
        diag_out_of_memory(errors);
        return NULL;
    }
    grade->key = key;
    grade->student =
        student ? arena_text(&grade->arena, student, strlen(student)) : stem(&grade->arena, file);
    grade->file = arena_text(&grade->arena, file, strlen(file));
    if (grade->student && grade->file && make_sheet(grade)) {
        if (grade->sheet) hold_against(grade, submission, errors);
        fbd_model_free(grade->sheet);
        grade->sheet = NULL;
        if (grade->readable && grade->submitted) grade->points = fmax(0, sum(grade));
        if (!grade->arena.failed && fbd_errors_failed_count(errors) == 0) return grade;
    }
    if (fbd_errors_failed_count(errors) == 0) diag_out_of_memory(errors);
    fbd_grade_free(grade);
    return NULL;
}

fbd_grade *grade_itself(const fbd_key *key)
{
    fbd_grade *grade = calloc(1, sizeof *grade);
    fbd_errors *errors = fbd_errors_new();
    if (grade && errors) {
        grade->key = key;
        grade->file = key->file;
        const struct submission itself = {.text = key->source, .length = key->length};
        if (make_sheet(grade) && grade->sheet) hold_against(grade, &itself, errors);
        fbd_model_free(grade->sheet);
        grade->sheet = NULL;
    }
    if (grade && (!errors || errors->out_of_memory || grade->arena.failed)) {
        fbd_grade_free(grade);
        grade = NULL;
    }
    fbd_errors_free(errors);
    return grade;
}

fbd_grade *fbd_grade_new(const fbd_key *key, const char *path, const char *student, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    const struct submission submission = {.path = path};
    fbd_grade *grade = key && path ? make_grade(key, &submission, path, student, errors)
                                   : api_refuse(errors, "there is no key, or no path of an answer");
    diag_end(&call);
    return grade;
}

fbd_grade *fbd_grade_parse(const fbd_key *key, const char *text, size_t length, const char *student,
                           fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    const struct submission submission = {.text = text, .length = length};
    fbd_grade *grade = key && text && student
                           ? make_grade(key, &submission, student, student, errors)
                           : api_refuse(errors, "there is no key, no text of an answer, or no student");
    diag_end(&call);
    return grade;
}

void fbd_grade_free(fbd_grade *grade)
{
    if (!grade) return;
    fbd_model_free(grade->sheet);
    arena_free(&grade->arena);
    free(grade);
}

double fbd_grade_points(const fbd_grade *grade)
{
    return grade ? grade->points : 0;
}

double fbd_grade_most(const fbd_grade *grade)
{
    return grade ? grade->key->most : 0;
}

bool fbd_grade_passed(const fbd_grade *grade)
{
    if (!grade || !grade->submitted || !grade->readable) return false;
    const double rounding = 1e-9;
    return grade->points >= (grade->key->grading.pass - rounding) * grade->key->most;
}

size_t fbd_grade_finding_count(const fbd_grade *grade)
{
    return grade ? grade->count : 0;
}

fbd_finding fbd_grade_finding(const fbd_grade *grade, size_t index)
{
    if (!grade || index >= grade->count) return (fbd_finding){.points = NAN, .most = NAN};
    const struct finding *one = grade->first;
    while (index-- > 0) one = one->next;
    return one->finding;
}
