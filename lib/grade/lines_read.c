/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Put the derivations of an answer into the scene of the key, without unreadable ones.
 */
#include <string.h>

#include "document/node_edit.h"
#include "fbd_grade.h"
#include "grade/lines.h"

/* ---- the key's scene with the answer's derivations */

const struct node *lines_value(const struct node *map, const char *key)
{
    const struct pair *pair = node_find(map, key);
    return pair ? pair->value : NULL;
}

bool name_is_of_equations(const char *name)
{
    static const char *const names[] = {"m",    "g",    "N",    "I_G",      "I_O", "L",  "mu",
                                        "mu_s", "mu_k", "slip", "distance", "t",   "pi", "e"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) return true;
    return false;
}

/* Add the parameters that a derivation names beside those of the sheet. */
static const struct node *with_parameters(struct arena *arena, const struct node *root,
                                          const struct node *answer)
{
    const struct node *own = lines_value(root, "parameters"), *more = lines_value(answer, "parameters");
    if (!more || more->kind != node_map) return root;
    const struct node *all = own && own->kind == node_map ? own : node_empty_map(arena);
    for (size_t i = 0; all && i < more->count; i++)
        if (!node_find(all, more->pairs[i].key) && !name_is_of_equations(more->pairs[i].key))
            all = node_with(arena, all, more->pairs[i].key, more->pairs[i].value);
    return all ? node_with(arena, root, "parameters", all) : NULL;
}

/* The bodies of the sheet with the derivations of the answer: unchanged, or in the coordinates of the sheet. */
static const struct node *with_lines(struct fbd_grade *grade, const struct node *root,
                                     const struct node *answer, bool as_they_are)
{
    struct arena *arena = &grade->arena;
    const struct node *bodies = lines_value(root, "bodies"), *others = lines_value(answer, "bodies"),
                      *made = bodies;
    for (size_t b = 0; made && b < bodies->count; b++) {
        const struct node *other = lines_value(others, bodies->pairs[b].key);
        const struct node *hand = lines_value(other, "hand");
        const struct node *same =
            as_they_are ? hand : coordinates_of_sheet(grade, answer, hand, bodies->pairs[b].key);
        const struct node *body = node_with(arena, bodies->pairs[b].value, "hand", same);
        const struct node *symbols =
            as_they_are || !hand ? NULL : drawn_symbols(grade, answer, bodies->pairs[b].key, hand->at);
        if (body && symbols) body = node_with(arena, body, "symbols", symbols);
        made = body ? node_with(arena, made, bodies->pairs[b].key, body) : NULL;
    }
    return made ? node_with(arena, root, "bodies", made) : NULL;
}

/* ---- unreadable lines */

static bool is_behind(struct pos a, struct pos b)
{
    return a.line > b.line || (a.line == b.line && a.column > b.column);
}

struct culprit {
    const struct node *item; /* the line, or all of `hand` */
    const char *body;
};

static void consider(struct culprit *culprit, const struct node *item, const char *body, struct pos at)
{
    if (is_behind(item->at, at) || (culprit->item && is_behind(culprit->item->at, item->at))) return;
    *culprit = (struct culprit){item, body};
}

static struct culprit find_culprit(const struct node *root, struct pos at)
{
    const struct node *bodies = lines_value(root, "bodies");
    struct culprit culprit = {0};
    for (size_t b = 0; b < bodies->count; b++) {
        const struct node *hand = lines_value(bodies->pairs[b].value, "hand");
        if (!hand) continue;
        if (hand->kind != node_list) consider(&culprit, hand, bodies->pairs[b].key, at);
        for (size_t i = 0; hand->kind == node_list && i < hand->count; i++)
            consider(&culprit, hand->items[i], bodies->pairs[b].key, at);
    }
    return culprit;
}

static bool is_it(const struct node *item, const void *context)
{
    return item == context;
}

static const struct node *without(struct arena *arena, const struct node *root, const struct culprit *culprit)
{
    const struct node *bodies = lines_value(root, "bodies"), *body = lines_value(bodies, culprit->body);
    const struct node *hand = lines_value(body, "hand");
    const struct node *left =
        hand->kind == node_list ? node_filtered(arena, hand, is_it, culprit->item) : NULL;
    body = node_with(arena, body, "hand", left);
    bodies = body ? node_with(arena, bodies, culprit->body, body) : NULL;
    return bodies ? node_with(arena, root, "bodies", bodies) : NULL;
}

/* Leave out every line with an error; false when there is none. */
static bool leave_out_wrong(struct lines *lines, fbd_errors *errors)
{
    struct fbd_grade *grade = lines->grade;
    const struct node *root = lines->root;
    struct culprit culprit = {0};
    const fbd_error *error;
    bool any = false;
    for (size_t i = 0; lines->root && (error = diag_get(errors, i)) != NULL; i++) {
        const struct node *before = culprit.item;
        if (error->severity != FBD_ERROR) continue;
        culprit = find_culprit(root, (struct pos){error->line, error->column});
        if (!culprit.item || culprit.item == before) continue; /* notes are sorted by position */
        const fbd_derivation here = {.written = culprit.item->text,
                                     .line = culprit.item->at.line,
                                     .column = culprit.item->at.column};
        bool scalar = culprit.item->kind == node_scalar;
        finding_of_error(grade, FBD_FINDING_UNREADABLE, culprit.body,
                         scalar ? line_as_written(lines, culprit.body, &here) : "", error);
        lines->root = without(&grade->arena, lines->root, &culprit);
        any = true;
    }
    return any;
}

fbd_model *lines_try(struct lines *lines, const struct node *root, bool hands, bool tell, fbd_errors *errors)
{
    struct fbd_grade *grade = lines->grade;
    fbd_model *model = root ? grade_compile(grade, root, grade->key->file, hands, errors) : NULL;
    const fbd_error *error = model ? NULL : first_error(errors);
    if (errors->out_of_memory) grade->arena.failed = true;
    if (error && tell) finding_of_error(grade, FBD_FINDING_UNREADABLE, "", "", error);
    return model;
}

/* Leave out parameters of the answer that are incompatible with the sheet, with a finding. */
static void check_parameters(struct lines *lines, const struct node *sheet)
{
    fbd_errors *errors = fbd_errors_new();
    if (!errors) lines->grade->arena.failed = true;
    if (errors) {
        fbd_model *model = lines_try(lines, lines->root, false, true, errors);
        if (!model) lines->root = sheet;
        fbd_model_free(model);
    }
    fbd_errors_free(errors);
}

/* Leave out all lines, with a finding, if the error is in none of them. */
static void leave_out_all(struct lines *lines, fbd_errors *errors)
{
    struct fbd_grade *grade = lines->grade;
    const struct node *key = grade->key->root;
    const fbd_error *error = first_error(errors);
    if (error) finding_of_error(grade, FBD_FINDING_UNREADABLE, "", "", error);
    lines->root = lines->left_out ? NULL : with_lines(grade, key, NULL, true);
    lines->left_out = true;
}

/* Compile until every remaining line is readable. */
static void compile_lines(struct lines *lines)
{
    while (lines->root && !lines->model && !lines->grade->arena.failed) {
        fbd_errors *errors = fbd_errors_new();
        if (!errors) {
            lines->grade->arena.failed = true;
            return;
        }
        lines->model = lines_try(lines, lines->root, true, false, errors);
        if (!lines->model && !leave_out_wrong(lines, errors)) leave_out_all(lines, errors);
        fbd_errors_free(errors);
    }
}

void lines_read(struct lines *lines, const struct node *answer)
{
    struct fbd_grade *grade = lines->grade;
    struct arena *arena = &grade->arena;
    drawn_find_forces(grade);
    const struct node *key = grade->key->root, *written = with_lines(grade, key, answer, true);
    if (written) written = with_parameters(arena, written, answer);
    lines->paper = answer;
    lines->answer = answer = lines_of_notation(grade, answer, written);
    const struct node *plain = answer ? with_lines(grade, key, answer, false) : NULL;
    lines->root = plain ? with_parameters(arena, plain, answer) : NULL;
    if (lines->root) check_parameters(lines, plain);
    compile_lines(lines);
}
