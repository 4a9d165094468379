/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A student's sheet made from a key: the scene with the student's own values, without forces, derivations and
 * comments; and the same filled in.
 */
#include <string.h>

#include "base/api_check.h"
#include "base/text.h"
#include "fbd_grade.h"
#include "grade/handout.h"

/* Keys left out of the file, and of a body: the answers, and the teacher's notes. */
static const char *const kept_back[] = {"grading", "description", "$schema", "output", NULL};
static const char *const asked[] = {"forces", "moments", "hand", "exact", "description", NULL};

static bool is_one_of(const char *key, const char *const *names)
{
    for (; *names; names++)
        if (strcmp(key, *names) == 0) return true;
    return false;
}

/* True for text that would be misread or cut off as a plain scalar. */
static bool needs_quotes(const char *text)
{
    return strpbrk(text, ":#{}[],&*!|>'\"%@`\n\t") || text[0] == '-' || text[0] == '?' || text[0] == '\0' ||
           text[0] == ' ';
}

static void write_text(struct text *text, const char *value, bool quoted)
{
    if (quoted || needs_quotes(value))
        text_json_string(text, value);
    else
        text_add(text, value);
}

static void write_scalar(struct text *text, const struct node *scalar)
{
    if (scalar->kind != node_null) write_text(text, scalar->text, scalar->quoted);
}

static void write_value(struct text *text, const struct node *node);

static void write_pairs(struct text *text, const struct node *map)
{
    for (size_t i = 0; i < map->count; i++) {
        text_add(text, i ? ", " : "");
        text_add(text, map->pairs[i].key);
        text_add(text, ": ");
        write_value(text, map->pairs[i].value);
    }
}

/* Write a value on one line. */
static void write_value(struct text *text, const struct node *node)
{
    switch (node->kind) {
    case node_null:
    case node_scalar: write_scalar(text, node); return;
    case node_map:
        text_add(text, "{");
        write_pairs(text, node);
        text_add(text, "}");
        return;
    case node_list: break;
    }
    text_add(text, "[");
    for (size_t i = 0; i < node->count; i++) {
        text_add(text, i ? ", " : "");
        write_value(text, node->items[i]);
    }
    text_add(text, "]");
}

static void write_pair(struct text *text, int depth, const char *key, const struct node *value)
{
    text_printf(text, "%*s%s: ", 2 * depth, "", key);
    write_value(text, value);
    text_add(text, "\n");
}

static void write_parameters(const struct handout *handout, const struct node *map)
{
    for (size_t i = 0; i < map->count; i++) {
        const char *name = map->pairs[i].key;
        const char *value = value_for_student(handout->arena, handout->key, name, handout->student);
        if (!value) {
            write_pair(handout->text, 1, name, map->pairs[i].value);
            continue;
        }
        text_printf(handout->text, "  %s: ", name);
        write_text(handout->text, value, false);
        text_add(handout->text, "\n");
    }
}

/* Write each entry on its own line, so that an unreadable one does not affect the others. */
static void write_list(struct text *text, const struct node *list)
{
    size_t count = !list ? 0 : list->kind == node_list ? list->count : list->kind != node_null;
    for (size_t i = 0; i < count; i++) {
        text_add(text, "      - ");
        const struct node *entry = list->kind == node_list ? list->items[i] : list;
        if (entry->kind == node_map && entry->count == 1)
            write_pairs(text, entry);
        else
            write_value(text, entry);
        text_add(text, "\n");
    }
}

static void write_lists(const struct handout *handout, const struct pair *body, bool hand)
{
    for (size_t k = 0; k < (hand ? 3 : 2); k++) {
        const struct pair *list = node_find(body->value, asked[k]);
        text_printf(handout->text, "    %s:\n", asked[k]);
        if (!handout->model) continue;
        write_list(handout->text, list ? list->value : NULL);
        if (k < 2) solution_reactions(handout, body->key, k == 1);
    }
}

static void write_body(const struct handout *handout, const struct pair *body)
{
    struct text *text = handout->text;
    bool asks_inertia = !handout->scene && handout->key->grading.points.inertia > 0, hand = false;
    text_printf(text, "  %s:\n", body->key);
    for (size_t i = 0; i < body->value->count && body->value->kind == node_map; i++) {
        const struct pair *pair = &body->value->pairs[i];
        hand = hand || strcmp(pair->key, "hand") == 0;
        if (is_one_of(pair->key, asked)) continue;
        if (!asks_inertia || strcmp(pair->key, "inertia") != 0)
            write_pair(text, 2, pair->key, pair->value);
        else if (handout->open)
            text_printf(text, "%c%c%s\n", sheet_lists, sheet_hand, body->key);
    }
    if (handout->open)
        text_printf(text, "%c%s\n", hand ? sheet_hand : sheet_lists, body->key);
    else
        write_lists(handout, body, hand);
}

static void write_bodies(const struct handout *handout, const struct node *bodies)
{
    for (size_t i = 0; i < bodies->count; i++) write_body(handout, &bodies->pairs[i]);
}

static void write_entry(const struct handout *handout, const struct pair *pair)
{
    bool parameters = strcmp(pair->key, "parameters") == 0, bodies = strcmp(pair->key, "bodies") == 0;
    if (is_one_of(pair->key, kept_back)) return;
    if (strcmp(pair->key, "simulate") == 0) { /* its events may name forces */
        const struct pair *until = node_find(pair->value, "until");
        if (!until) return;
        text_add(handout->text, "simulate: {until: ");
        write_value(handout->text, until->value);
        text_add(handout->text, "}\n");
        return;
    }
    if ((!parameters && !bodies) || pair->value->kind != node_map) {
        write_pair(handout->text, 0, pair->key, pair->value);
        return;
    }
    text_printf(handout->text, "%s:\n", pair->key);
    if (parameters)
        write_parameters(handout, pair->value);
    else
        write_bodies(handout, pair->value);
}

void handout_reactions(struct text *text, const fbd_grading *grading)
{
    if (grading->reactions == FBD_REACTIONS_ALL)
        text_add(text, "Draw reactions too: the forces of joints, guides, couplings and contacts.");
    else if (grading->reactions == FBD_REACTIONS_NONE)
        text_add(text, "Reactions, the forces of joints, guides, couplings and contacts, need not be drawn.");
    else
        text_add(text, "Of the reactions draw those of: ");
    for (size_t i = 0; i < grading->reaction_count; i++)
        text_printf(text, "%s%s", i ? ", " : "", grading->reaction_names[i]);
}

/* Write which forces have to be drawn, and how. */
static void write_head(const struct handout *handout)
{
    struct text *text = handout->text;
    text_add(text, handout->model ? "# Solution of the sheet of " : "# Sheet of ");
    text_shown(text, handout->student);
    text_add(text, ".\n");
    if (handout->model || handout->open) return;
    text_add(text, "# Draw what acts on each body: below `forces` and `moments`, one entry a line, as\n"
                   "#       - gravity\n"
                   "#       - applied: {name: F, value: 10 N, angle: 30 deg, at: [0.5 m, 0]}\n"
                   "#       - applied: {name: R, value: unknown, angle: unknown, at: [0, 0]}\n"
                   "# ");
    handout_reactions(text, &handout->key->grading);
    text_add(text, "\n");
    if (handout->key->lines > 0)
        text_add(text, "# Write equations below `hand`, one a line, as\n#       - \"m*a = F - m*g\"\n");
}

bool handout_write(struct handout *handout)
{
    write_head(handout);
    for (size_t i = 0; i < handout->key->root->count; i++)
        write_entry(handout, &handout->key->root->pairs[i]);
    if (handout->model) solution_equations(handout);
    return !handout->text->failed && !handout->arena->failed;
}

static char *write_handout(struct handout *handout, fbd_errors *errors)
{
    if (handout_write(handout)) return handout->text->data;
    diag_out_of_memory(errors);
    text_free(handout->text);
    return NULL;
}

static char *make_handout(const fbd_key *key, const char *student, bool solved, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    struct text text = {0};
    struct arena arena = {0};
    char *made = NULL;
    if (!key || !student) api_refuse(errors, "there is no key, or no name of a student");
    if (key && student) {
        struct handout handout = {.text = &text, .arena = &arena, .key = key, .student = student};
        if (solved) handout.model = solution_model(&handout, errors);
        if (!solved || handout.model) made = write_handout(&handout, errors);
        fbd_model_free(handout.model);
    }
    arena_free(&arena);
    diag_end(&call);
    return made;
}

char *fbd_key_handout(const fbd_key *key, const char *student, fbd_errors *errors)
{
    return make_handout(key, student, false, errors);
}

char *fbd_key_solution(const fbd_key *key, const char *student, fbd_errors *errors)
{
    return make_handout(key, student, true, errors);
}
