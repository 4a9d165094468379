/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reading a key: it is graded against itself.
 */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/file.h"
#include "base/text.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/grade.h"

static double points_of(const struct fbd_key *key)
{
    const fbd_marks *points = &key->grading.points;
    double most = 0;
    for (size_t b = 0; b < fbd_model_body_count(key->model); b++)
        most += points->force * (double)(fbd_model_body(key->model, b).listed + key_asks(key, b)) +
                points->derivation * (double)fbd_model_derivation_count(key->model, b) + points->inertia;
    return most;
}

static bool has_points(struct fbd_key *key, fbd_errors *errors)
{
    for (size_t b = 0; b < fbd_model_body_count(key->model); b++)
        key->lines += fbd_model_derivation_count(key->model, b);
    key->most = points_of(key);
    if (key->most > 0) return true;
    diag_add(errors, FBD_ERROR, "nothing-to-grade", (struct pos){0, 0},
             "list the forces and moments that a right answer has, or derivations under `hand`",
             "the key has no entry with points");
    return false;
}

/* The reactions of a body that have to be drawn, by name. */
static void add_names(const struct fbd_key *key, size_t b, struct text *text)
{
    if (key_asks(key, b) == 0) return;
    const fbd_body body = fbd_model_body(key->model, b);
    fbd_state *state = fbd_state_new(key->model);
    fbd_listed_force *forces = calloc(body.most_forces + 1, sizeof *forces);
    size_t count = forces && state ? fbd_state_forces(state, b, forces, body.most_forces) : SIZE_MAX;
    if (count == SIZE_MAX) text->failed = true;
    for (size_t i = 0; !text->failed && i < key->asked_count[b] && body.listed + i < count; i++)
        if (!isnan(key->asked[b][i]))
            text_printf(text, "%s`%s` on `%s`", text->length ? ", " : "", forces[body.listed + i].arrow.name,
                        body.name);
    free(forces);
    fbd_state_free(state);
}

/* Warn the author that answers have to draw reactions where the key does not state it; a model cannot list
 * its reactions, which already act. False when memory is out. */
static bool tell_reactions(const struct fbd_key *key, fbd_errors *errors)
{
    struct text text = {0};
    if (key->grading.reactions_given) return true;
    for (size_t b = 0; b < fbd_model_body_count(key->model); b++) add_names(key, b, &text);
    if (text.length > 0)
        diag_add(errors, FBD_WARNING, "key-differs", (struct pos){0, 0},
                 "write `grading: {reactions: all}` if this is intended, else `none` or the names of those "
                 "to be drawn",
                 "an answer has to draw reactions too: %.600s", text.data);
    bool failed = text.failed;
    if (failed) diag_out_of_memory(errors);
    text_free(&text);
    return !failed;
}

static const fbd_finding *first_fault(const fbd_grade *grade)
{
    for (const struct finding *one = grade->first; one; one = one->next) {
        const fbd_finding *finding = &one->finding;
        bool reaction = finding->kind == FBD_FINDING_MISSING && one->reaction;
        if (!reaction && (finding->points < finding->most || finding->points < 0)) return finding;
    }
    return NULL;
}

/* Grade the key with itself, and warn of entries without full marks; false with a note if the key has no
 * points, or when memory is out. */
static bool check_itself(struct fbd_key *key, fbd_errors *errors)
{
    if (!has_points(key, errors)) return false;
    fbd_grade *grade = grade_itself(key);
    const fbd_finding *fault = grade ? first_fault(grade) : NULL;
    if (!grade) diag_out_of_memory(errors);
    if (fault)
        diag_add(errors, FBD_WARNING, "key-differs", (struct pos){fault->line, fault->column},
                 "`fbd-run --grade KEY KEY --details` lists all, `--check-hand` has more about derivations",
                 "graded against itself the key has not all points: %.80s%s%.200s: %.200s", fault->body,
                 *fault->name ? ": " : "", fault->name, fault->message);
    bool graded = grade != NULL;
    fbd_grade_free(grade);
    return graded && tell_reactions(key, errors);
}

static bool find_asked(struct fbd_key *key)
{
    size_t count = fbd_model_body_count(key->model);
    key->asked = ARENA_ARRAY(&key->arena, count + 1, double *);
    key->asked_count = ARENA_ARRAY(&key->arena, count + 1, size_t);
    bool done = key->asked && key->asked_count && compare_with_itself(key);
    if (!done) key->arena.failed = true;
    return done;
}

static bool compile_key(struct fbd_key *key, fbd_errors *errors)
{
    key->model = tree_compile(key->root, key->file, key->set, key->set_count, true, errors);
    key->grading = fbd_model_grading(key->model);
    return key->model && find_asked(key);
}

/* The texts are copied. */
static bool take_settings(struct fbd_key *key, const fbd_setting *settings, size_t count)
{
    key->set = ARENA_ARRAY(&key->arena, count + 1, fbd_setting);
    for (size_t i = 0; key->set && i < count; i++) {
        const char *name = settings[i].name, *value = settings[i].value;
        key->set[i] = (fbd_setting){.name = arena_text(&key->arena, name, strlen(name)),
                                    .value = arena_text(&key->arena, value, strlen(value))};
        key->set_count++;
    }
    return !key->arena.failed;
}

/* Make a key of this text, which it takes over, without checking it; the text may be NULL. */
static fbd_key *compile_text(char *text, size_t length, const char *name, const fbd_setting *settings,
                             size_t count, fbd_errors *errors)
{
    fbd_key *key = text ? calloc(1, sizeof *key) : NULL;
    if (!key) {
        if (text) diag_out_of_memory(errors);
        free(text);
        return NULL;
    }
    key->source = text;
    key->length = length;
    key->file = arena_text(&key->arena, name, strlen(name));
    bool taken = take_settings(key, settings, count);
    diag_in_file(errors, key->file);
    if (taken && key->file) key->root = node_open(&key->arena, text, length, errors);
    if (key->root && compile_key(key, errors)) return key;
    if (key->arena.failed) diag_out_of_memory(errors);
    fbd_key_free(key);
    return NULL;
}

/* The same, and grade it against itself. */
static fbd_key *make_key(char *text, size_t length, const char *name, const fbd_setting *settings,
                         size_t count, fbd_errors *errors)
{
    fbd_key *key = compile_text(text, length, name, settings, count, errors);
    if (key && check_itself(key, errors)) return key;
    fbd_key_free(key);
    return NULL;
}

static bool is_asked(const char *path_or_text, const fbd_setting *settings, size_t count, fbd_errors *errors)
{
    if (path_or_text && api_has_settings(settings, count)) return true;
    api_refuse(errors,
               path_or_text ? "a setting has no name or no value" : "there is no path, or no text, of a key");
    return false;
}

fbd_key *fbd_key_read_set(const char *path, const fbd_setting *settings, size_t setting_count,
                          fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    size_t length = 0;
    char *text = is_asked(path, settings, setting_count, errors) ? file_text(path, &length, errors) : NULL;
    fbd_key *key = text ? make_key(text, length, file_name(path), settings, setting_count, errors) : NULL;
    diag_end(&call);
    return key;
}

static bool check_source(const fbd_model *model, fbd_errors *errors)
{
    size_t length;
    const char *source = fbd_model_source(model, &length);
    fbd_errors *others = fbd_errors_new(); /* discards warnings already given when the file was read */
    char *copy = others ? file_copy(source, length, others) : NULL;
    fbd_key *key = compile_text(copy, length, fbd_model_file(model), NULL, 0, others);
    bool lacking = !others || others->out_of_memory;
    if (lacking) diag_out_of_memory(errors);
    diag_in_file(errors, fbd_model_file(model));
    /* A file that needs settings to be a valid model is rejected when it is graded. */
    bool done = key ? check_itself(key, errors) : !lacking;
    fbd_key_free(key);
    fbd_errors_free(others);
    return done;
}

bool fbd_model_check_key(const fbd_model *model, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    size_t length;
    bool is_key = fbd_model_source(model, &length) && length > 0 && fbd_model_grading(model).given;
    bool done = is_key ? check_source(model, errors) : model || api_refuse(errors, "there is no model");
    diag_end(&call);
    return done;
}

fbd_key *fbd_key_parse(const char *text, size_t length, const char *name, const fbd_setting *settings,
                       size_t setting_count, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    bool asked = is_asked(text, settings, setting_count, errors);
    char *copy = asked ? file_copy(text, length, errors) : NULL;
    fbd_key *key = copy ? make_key(copy, length, name ? name : "key", settings, setting_count, errors) : NULL;
    diag_end(&call);
    return key;
}

fbd_key *fbd_key_read(const char *path, fbd_errors *errors)
{
    return fbd_key_read_set(path, NULL, 0, errors);
}
