/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reading an answer: unreadable parts are noted and left out, and the rest is read again.
 */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "grade/lines.h"

/* ---- leaving out */

static bool is_before(struct pos a, struct pos b)
{
    return a.line < b.line || (a.line == b.line && a.column < b.column);
}

/* The last position of the file at or before `at` at which a node starts, and the entry of a list of forces,
 * moments or couplings that contains it; NULL for none. */
struct search {
    struct pos at, found;
    const struct node *entry;
    const char *key;
};

static void look(struct search *search, struct pos at, const struct node *entry, const char *key)
{
    if (is_before(search->at, at) || is_before(at, search->found)) return;
    search->found = at;
    search->entry = entry;
    search->key = key;
}

static void walk(struct search *search, const struct node *node, const struct node *entry, const char *key)
{
    look(search, node->at, entry, key);
    for (size_t i = 0; i < node->count; i++) {
        if (node->kind == node_map) look(search, node->pairs[i].at, entry, key);
        walk(search, node->kind == node_map ? node->pairs[i].value : node->items[i], entry, key);
    }
}

static void walk_entries(struct search *search, const struct node *list, const char *key)
{
    if (list->kind != node_list) return;
    look(search, list->at, NULL, NULL);
    for (size_t i = 0; i < list->count; i++) walk(search, list->items[i], list->items[i], key);
}

static bool holds_entries(const char *key)
{
    return strcmp(key, "forces") == 0 || strcmp(key, "moments") == 0;
}

static void walk_body(struct search *search, const struct node *body)
{
    for (size_t i = 0; i < body->count && body->kind == node_map; i++) {
        const struct pair *pair = &body->pairs[i];
        look(search, pair->at, NULL, NULL);
        if (holds_entries(pair->key) && pair->value->kind == node_list)
            walk_entries(search, pair->value, pair->key);
        else
            walk(search, pair->value, NULL, NULL);
    }
}

static struct search find_entry(const struct node *root, struct pos at)
{
    struct search search = {.at = at};
    for (size_t i = 0; i < root->count; i++) {
        const struct pair *pair = &root->pairs[i];
        look(&search, pair->at, NULL, NULL);
        if (strcmp(pair->key, "bodies") != 0 || pair->value->kind != node_map) {
            walk(&search, pair->value, NULL, NULL);
            continue;
        }
        for (size_t b = 0; b < pair->value->count; b++) {
            look(&search, pair->value->pairs[b].at, NULL, NULL);
            walk_body(&search, pair->value->pairs[b].value);
        }
    }
    return search;
}

static bool is_it(const struct node *item, const void *context)
{
    return item == context;
}

/* A tree without one entry of a list of one of its bodies. */
static const struct node *without(struct arena *arena, const struct node *root, const struct search *search)
{
    const struct node *bodies = node_find(root, "bodies")->value, *made = bodies;
    for (size_t b = 0; made && b < bodies->count; b++) {
        const struct node *body = bodies->pairs[b].value;
        const struct pair *pair = node_find(body, search->key);
        if (!pair || pair->value->kind != node_list) continue;
        const struct node *list = node_filtered(arena, pair->value, is_it, search->entry);
        if (list && list->count == pair->value->count) continue;
        const struct node *changed = list ? node_with(arena, body, search->key, list) : NULL;
        made = changed ? node_with(arena, made, bodies->pairs[b].key, changed) : NULL;
    }
    return made ? node_with(arena, root, "bodies", made) : NULL;
}

static const char *body_around(const struct node *root, const struct search *search)
{
    const struct pair *bodies = node_find(root, "bodies");
    for (size_t b = 0; bodies && b < bodies->value->count; b++) {
        const struct pair *list = node_find(bodies->value->pairs[b].value, search->key);
        for (size_t i = 0; list && list->value->kind == node_list && i < list->value->count; i++)
            if (list->value->items[i] == search->entry) return bodies->value->pairs[b].key;
    }
    return "";
}

/* The name of an entry: `name` in the value of its kind, or else the kind. */
static const char *name_of(const struct node *entry)
{
    if (!entry || entry->kind == node_list) return "";
    if (entry->kind != node_map) return entry->text ? entry->text : "";
    const struct pair *name = entry->count > 0 ? node_find(entry->pairs[0].value, "name") : NULL;
    if (name && name->value->kind == node_scalar) return name->value->text;
    return entry->count > 0 ? entry->pairs[0].key : "";
}

static void note_unreadable(struct fbd_grade *grade, const char *body, const struct node *entry,
                            const fbd_error *error)
{
    bool dimension = strcmp(error->id, "wrong-dimension") == 0 || strcmp(error->id, "time-as-unit") == 0;
    bool unit = dimension && entry;
    finding_of_error(grade, unit ? FBD_FINDING_UNIT : FBD_FINDING_UNREADABLE, body, name_of(entry), error);
}

/* Read the tree until it has no error, each time without the entry of the first error. */
static void compile_rest(struct fbd_grade *grade, struct answer *answer)
{
    while (answer->root && !answer->model && !grade->arena.failed) {
        fbd_errors *errors = fbd_errors_new();
        if (!errors) {
            grade->arena.failed = true;
            return;
        }
        answer->model = grade_compile(grade, answer->root, grade->key->file, false, errors);
        const fbd_error *error = answer->model ? NULL : first_error(errors);
        if (errors->out_of_memory) grade->arena.failed = true;
        struct search search = {0};
        if (error) search = find_entry(answer->root, (struct pos){error->line, error->column});
        if (error)
            note_unreadable(grade, search.entry ? body_around(answer->root, &search) : "", search.entry,
                            error);
        if (!answer->model)
            answer->root = search.entry ? without(&grade->arena, answer->root, &search) : NULL;
        fbd_errors_free(errors);
    }
}

/* The path of a table with a file; NULL for one with points. */
static const struct node *file_of(const struct node *table)
{
    const struct node *file = table && table->kind == node_map ? lines_value(table, "file") : table;
    return file && file->kind == node_scalar ? file : NULL;
}

/* Reject tables whose file is not that of the sheet. */
static void refuse_files(struct fbd_grade *grade, const struct node *root, const struct node *own)
{
    const struct node *tables = lines_value(root, "tables");
    for (size_t i = 0; tables && tables->kind == node_map && i < tables->count; i++) {
        const char *name = tables->pairs[i].key;
        const struct node *file = file_of(tables->pairs[i].value);
        const struct node *given = own ? file_of(lines_value(own, name)) : NULL;
        if (!file || (given && strcmp(given->text, file->text) == 0)) continue;
        fbd_finding *finding = finding_add(grade, FBD_FINDING_UNREADABLE, "", name, file->at);
        finding_say(grade, finding, "an answer reads no files: tables are those of the sheet");
    }
}

/* Remove the sections that are not graded, and replace the tables by those of the sheet: an answer must not
 * read files. */
static const struct node *strip(struct fbd_grade *grade, const struct node *root)
{
    static const char *const unused[] = {"grading", "simulate", "output", "tables"};
    const struct pair *tables = node_find(grade->key->root, "tables");
    refuse_files(grade, root, tables ? tables->value : NULL);
    for (size_t i = 0; root && i < sizeof unused / sizeof *unused; i++)
        root = node_with(&grade->arena, root, unused[i], NULL);
    return root && tables ? node_with(&grade->arena, root, "tables", tables->value) : root;
}

/* No real diagram has that many on one body; pairing them all would take too long. */
enum { most_entries = 60 };

static const struct node *shorten_lists(struct fbd_grade *grade, const struct node *root)
{
    if (!root) return NULL;
    static const char *const keys[] = {"forces", "moments", "hand"};
    const struct pair *bodies = node_find(root, "bodies");
    const struct node *made = bodies ? bodies->value : NULL;
    for (size_t b = 0; made && bodies->value->kind == node_map && b < bodies->value->count; b++)
        for (size_t k = 0; made && k < sizeof keys / sizeof *keys; k++) {
            const char *name = bodies->value->pairs[b].key;
            const struct node *body = node_find(made, name)->value;
            const struct pair *pair = node_find(body, keys[k]);
            if (!pair || pair->value->kind != node_list || pair->value->count <= most_entries) continue;
            fbd_finding *finding = finding_add(grade, FBD_FINDING_UNREADABLE, name, keys[k], pair->at);
            finding_say(grade, finding, "there are more than 60: the rest is not looked at");
            const struct node *list = node_shortened(&grade->arena, pair->value, most_entries);
            body = list ? node_with(&grade->arena, body, keys[k], list) : NULL;
            made = body ? node_with(&grade->arena, made, name, body) : NULL;
        }
    return made ? node_with(&grade->arena, root, "bodies", made) : root;
}

/* Limit the total number of derivations, as each is evaluated under many values of the parameters. */
static const struct node *shorten_hands(struct fbd_grade *grade, const struct node *root)
{
    size_t left = most_entries + 2 * grade->key->lines;
    const struct node *bodies = lines_value(root, "bodies"), *made = bodies;
    for (size_t b = 0; made && bodies->kind == node_map && b < bodies->count; b++) {
        const char *name = bodies->pairs[b].key;
        const struct node *body = bodies->pairs[b].value, *hand = lines_value(body, "hand");
        size_t count = !hand ? 0 : hand->kind == node_list ? hand->count : 1;
        if (count <= left) {
            left -= count;
            continue;
        }
        fbd_finding *finding = finding_add(grade, FBD_FINDING_UNREADABLE, name, "hand", hand->at);
        finding_say(grade, finding, "the answer has more derivations than are looked at: the rest is not");
        const struct node *list = hand->kind == node_list ? node_shortened(&grade->arena, hand, left) : NULL;
        body = node_with(&grade->arena, body, "hand", list);
        made = body ? node_with(&grade->arena, made, name, body) : NULL;
        left = 0;
    }
    return made ? node_with(&grade->arena, root, "bodies", made) : root;
}

/* True if a body has a list that is not empty. */
static bool says_something(const struct node *root)
{
    static const char *const keys[] = {"forces", "moments", "hand"};
    const struct pair *bodies = node_find(root, "bodies");
    for (size_t b = 0; bodies && bodies->value->kind == node_map && b < bodies->value->count; b++)
        for (size_t k = 0; k < sizeof keys / sizeof *keys; k++) {
            const struct pair *pair = node_find(bodies->value->pairs[b].value, keys[k]);
            if (pair && (pair->value->count > 0 || pair->value->kind == node_scalar)) return true;
        }
    return false;
}

static const struct node *take_root(struct fbd_grade *grade, const struct node *root)
{
    root = shorten_lists(grade, strip(grade, root));
    root = root ? shorten_hands(grade, root) : NULL;
    root = root ? answer_take_drawn(grade, root) : NULL;
    if (!root) grade->arena.failed = true;
    return root;
}

static void note_absent(struct fbd_grade *grade, const char *message)
{
    fbd_finding *finding = finding_add(grade, FBD_FINDING_NO_SUBMISSION, "", "", (struct pos){0, 0});
    finding_say(grade, finding, message);
}

static const struct node *take_answer(struct fbd_grade *grade, const struct node *root, fbd_errors *failures)
{
    root = answer_take_drawings(grade, root, failures);
    if (root && root->kind == node_map) return take_root(grade, root);
    if (root) note_absent(grade, "the answer is no model, and no drawing");
    return NULL;
}

static bool is_there(const char *path)
{
    struct stat status;
    return strcmp(path, "-") == 0 || (stat(path, &status) == 0 && !S_ISDIR(status.st_mode));
}

/* Grading time grows with the size of the answer, which is therefore bounded. */
enum { most_bytes = 64000, most_more = 20 };

static bool has_more(const struct node *root, const struct node *key, const char *list)
{
    const struct node *own = lines_value(root, list), *other = lines_value(key, list);
    return own && own->count > (other ? other->count : 0) + most_more;
}

static bool is_too_large(const struct fbd_grade *grade, const struct node *root)
{
    const struct node *key = grade->key->root;
    return has_more(root, key, "bodies") || has_more(root, key, "couplings") ||
           has_more(root, key, "contacts");
}

static void open_answer(struct fbd_grade *grade, const struct submission *submission, struct answer *answer,
                        fbd_errors *errors, fbd_errors *failures)
{
    size_t length = submission->length;
    if (!submission->path)
        answer->text = file_copy(submission->text, length, failures);
    else if (is_there(submission->path))
        answer->text = file_text(submission->path, &length, failures);
    else
        note_absent(grade, "there is no answer to read");
    if (!answer->text) return;
    if (length > most_bytes + 4 * grade->key->length) {
        note_absent(grade, "the answer is longer than 64 kB and four times the key: it is not read");
        return;
    }
    grade->submitted = strspn(answer->text, " \t\r\n") < length;
    if (!grade->submitted) {
        note_absent(grade, "the answer is empty");
        return;
    }
    answer_mend(grade, answer->text, length);
    diag_in_file(errors, grade->file);
    const struct node *root = node_open(&grade->arena, answer->text, length, errors);
    if (root && fbd_errors_failed_count(errors) == 0 && is_too_large(grade, root))
        note_absent(grade, "the answer has far more bodies or couplings than the sheet: it is not read");
    else if (root && fbd_errors_failed_count(errors) == 0)
        answer->root = take_answer(grade, root, failures);
    else if (first_error(errors))
        note_unreadable(grade, "", NULL, first_error(errors));
}

bool answer_read(struct fbd_grade *grade, const struct submission *submission, struct answer *answer,
                 fbd_errors *failures)
{
    fbd_errors *errors = fbd_errors_new();
    *answer = (struct answer){.text = NULL};
    if (!errors) {
        grade->arena.failed = true;
        return false;
    }
    open_answer(grade, submission, answer, errors, failures);
    if (answer->root && !says_something(answer->root)) {
        grade->submitted = false;
        note_absent(grade, "the sheet has neither forces nor derivations");
    }
    if (errors->out_of_memory) grade->arena.failed = true;
    fbd_errors_free(errors);
    compile_rest(grade, answer);
    grade->readable = answer->model != NULL;
    return grade->readable && grade->submitted;
}

void answer_close(struct answer *answer)
{
    fbd_model_free(answer->model);
    free(answer->text);
}
