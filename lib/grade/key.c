/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The key that answers are held against, and what each student gets of it.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/call.h"
#include "base/file.h"
#include "base/text.h"
#include "dynamics/diagram.h"
#include "grade/grade.h"
#include "output/hand_forces.h"
#include "study/draws.h"
#include "study/hash.h"

/* ---- values of a student */

const char *draw_for_student(struct arena *arena, const struct grading *grading,
                             const struct drawn_parameter *drawn, const char *student)
{
    const struct draw_place place = {.seed = 1,
                                     .member = hash_text(drawn->name, strlen(drawn->name)),
                                     .index = hash_text(student, strlen(student))};
    double value = draw(draw_uniform, drawn->low, drawn->high, place);
    /* So many digits of the larger end: 20 to 40 deg in whole degrees. */
    double largest = fmax(fabs(drawn->low), fabs(drawn->high));
    double unit = pow(10, floor(log10(largest)) + 1 - grading->digits);
    double rounded = fmin(fmax(round(value / unit) * unit, drawn->low), drawn->high);
    const char *blank = *drawn->unit ? " " : "";
    return arena_printf(arena, "%.*g%s%s", grading->digits + 2, rounded, blank, drawn->unit);
}

size_t drawn_overrides(struct arena *arena, const struct fbd_key *key, const char *student,
                       const struct node *root, struct override **overrides)
{
    const struct grading *grading = &key->model->scene->grading;
    const struct pair *parameters = node_find(root, "parameters");
    size_t count = 0;
    *overrides = ARENA_ARRAY(arena, grading->draw_count + 1, struct override);
    for (size_t i = 0; *overrides && student && i < grading->draw_count; i++) {
        const struct drawn_parameter *drawn = &grading->draws[i];
        if (!parameters || !node_find(parameters->value, drawn->name)) continue;
        const char *value = draw_for_student(arena, grading, drawn, student);
        (*overrides)[count++] = (struct override){.name = drawn->name, .value = value};
    }
    return count;
}

/* ---- reading */

size_t key_asks(const struct fbd_key *key, size_t b)
{
    size_t count = 0;
    for (size_t i = 0; i < key->asked_count[b]; i++) count += key->asked[b][i];
    return count;
}

static double points_of(const struct fbd_key *key)
{
    const struct scene *scene = key->model->scene;
    const struct grading_points *points = &scene->grading.points;
    double most = 0;
    for (size_t b = 0; b < scene->body_count; b++)
        most += points->force * (double)(scene->bodies[b].load_count + key_asks(key, b)) +
                points->derivation * (double)scene->bodies[b].hand_count + points->inertia;
    return most;
}

static bool has_points(struct fbd_key *key, fbd_errors *errors)
{
    const struct scene *scene = key->model->scene;
    for (size_t b = 0; b < scene->body_count; b++) key->lines += scene->bodies[b].hand_count;
    key->most = points_of(key);
    if (key->most > 0) return true;
    diag_add(errors, FBD_ERROR, "nothing-to-grade", (struct pos){0, 0},
             "list the forces and moments that a right answer has, or derivations under `hand`",
             "the key has nothing that brings points");
    return false;
}

static bool find_asked(struct fbd_key *key)
{
    size_t count = key->model->body_count;
    key->asked = ARENA_ARRAY(&key->arena, count + 1, bool *);
    key->asked_count = ARENA_ARRAY(&key->arena, count + 1, size_t);
    bool done = key->asked && key->asked_count && compare_with_itself(key);
    if (!done) key->arena.failed = true;
    return done;
}

static bool compile_key(struct fbd_key *key, fbd_errors *errors)
{
    key->model = hands_compile(&key->document, NULL, 0, errors);
    return key->model && find_asked(key) && has_points(key, errors);
}

/* The reactions of a body that have to be drawn, by name. */
static void add_names(const struct fbd_key *key, size_t b, struct text *text)
{
    const fbd_model *model = key->model;
    fbd_state *state = key_asks(key, b) > 0 ? state_new(model) : NULL;
    struct arrow *arrows = calloc(diagram_arrows(model, (int)b) + 1, sizeof *arrows);
    if (state && arrows) {
        state_evaluate(state);
        struct instant at = state_instant(state);
        size_t listed = model->bodies[b].source->load_count;
        size_t count = diagram_list(model, (int)b, &at, state->a, state->slots, arrows);
        for (size_t i = 0; i < key->asked_count[b] && listed + i < count; i++)
            if (key->asked[b][i])
                text_printf(text, "%s`%s` on `%s`", text->length ? ", " : "", arrows[listed + i].name,
                            model->bodies[b].name);
    }
    free(arrows);
    state_free(state);
}

/* A model cannot list its reactions, which act already: warn the author that answers have to draw them, where
 * the key does not say so. */
static void tell_reactions(const struct fbd_key *key, fbd_errors *errors)
{
    struct text text = {0};
    if (key->model->scene->grading.reactions_given) return;
    for (size_t b = 0; b < key->model->body_count; b++) add_names(key, b, &text);
    if (text.length > 0)
        diag_add(
            errors, FBD_WARNING, "key-differs", (struct pos){0, 0},
            "say `grading: {reactions: all}` if this is meant, else `none` or the names of those to be drawn",
            "an answer has to draw reactions too: %.600s", text.data);
    text_free(&text);
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

/* Grade the key with itself, and warn of the entries that do not get full marks. */
static void check_itself(const struct fbd_key *key, fbd_errors *errors)
{
    fbd_grade *grade = grade_itself(key);
    const fbd_finding *fault = grade ? first_fault(grade) : NULL;
    if (fault)
        diag_add(errors, FBD_WARNING, "key-differs", (struct pos){fault->line, fault->column},
                 "`fbd-run --grade KEY KEY --details` says all, `--check-hand` more of derivations",
                 "graded against itself the key has not all points: %.80s%s%.200s: %.200s", fault->body,
                 *fault->name ? ": " : "", fault->name, fault->message);
    fbd_grade_free(grade);
    tell_reactions(key, errors);
}

static fbd_key *read_key(const char *path, fbd_errors *errors)
{
    size_t length;
    fbd_key *key = calloc(1, sizeof *key);
    if (!key) {
        diag_out_of_memory(errors);
        return NULL;
    }
    key->source = file_text(path, &length, errors);
    key->file = arena_text(&key->arena, file_name(path), strlen(file_name(path)));
    bool opened = key->source && document_open(&key->document, key->source, length, key->file, errors);
    key->document.split_hands = true;
    if (opened && key->file && compile_key(key, errors)) {
        key->length = length;
        check_itself(key, errors);
        return key;
    }
    if (key->arena.failed) diag_out_of_memory(errors);
    fbd_key_free(key);
    return NULL;
}

fbd_key *fbd_key_read(const char *path, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_key *key = path ? read_key(path, errors) : call_refuse(errors, "there is no path");
    diag_end(&call);
    return key;
}

void fbd_key_free(fbd_key *key)
{
    if (!key) return;
    fbd_model_free(key->model);
    document_close(&key->document);
    free(key->source);
    arena_free(&key->arena);
    free(key);
}
