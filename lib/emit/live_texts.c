/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "emit/live_texts.h"

#include <string.h>

#include "emit/live.h"

/* ---- texts of the file */

static bool same_place(struct pos a, struct pos b)
{
    return a.line == b.line && a.column == b.column && a.line > 0;
}

const struct node *texts_find_at(const struct node *node, struct pos at)
{
    const struct node *found = NULL; /* keys first: a mapping has the position of its first key */
    for (size_t i = 0; node->kind == node_map && i < node->count && !found; i++)
        found = same_place(node->pairs[i].at, at) ? node->pairs[i].value
                                                  : texts_find_at(node->pairs[i].value, at);
    for (size_t i = 0; node->kind == node_list && i < node->count && !found; i++)
        found = texts_find_at(node->items[i], at);
    return found ? found : same_place(node->at, at) ? node : NULL;
}

/* The text of `key` in a node or one level below it; the node itself if it is a scalar (short form). */
static const struct node *find_key(const struct node *node, const char *key, int depth)
{
    if (node->kind == node_scalar) return depth == 0 ? node : NULL;
    const struct pair *pair = node_find(node, key);
    if (pair) return pair->value->kind == node_scalar ? pair->value : find_key(pair->value, "value", 1);
    const struct node *found = NULL;
    for (size_t i = 0; node->kind == node_map && depth < 1 && i < node->count && !found; i++)
        if (node->pairs[i].value->kind == node_map) found = find_key(node->pairs[i].value, key, depth + 1);
    return found;
}

const struct node *texts_find(const struct live *live, struct emit_origin origin)
{
    static const char *const others[][2] = {{"static", "coefficient"},  {"kinetic", "coefficient"},
                                            {"static", "kinetic"},      {"kinetic", "static"},
                                            {"neutral", "free_length"}, {"free_length", "neutral"}};
    const struct node *entry = texts_find_at(live->document.root, origin.at);
    const struct node *text = entry ? find_key(entry, origin.key, 0) : NULL;
    for (size_t i = 0; entry && !text && i < sizeof others / sizeof *others; i++)
        if (strcmp(others[i][0], origin.key) == 0) text = find_key(entry, others[i][1], 0);
    return text;
}

static bool is_in(const struct live_node *list, const struct node *node)
{
    for (; list; list = list->before)
        if (list->node == node) return true;
    return false;
}

/* The number of occurrences of a node, more than one with aliases. */
static int count_places(const struct node *from, const struct node *node)
{
    int count = from == node;
    for (size_t i = 0; from->kind == node_map && i < from->count; i++)
        count += count_places(from->pairs[i].value, node);
    for (size_t i = 0; from->kind == node_list && i < from->count; i++)
        count += count_places(from->items[i], node);
    return count;
}

static void add_to(struct emitter *emitter, const struct live_node **list, const struct node *node)
{
    struct live_node *added = ARENA_NEW(&emitter->arena, struct live_node);
    if (!added) return;
    *added = (struct live_node){node, *list};
    *list = added;
}

/* True if a text was taken over, occurs once, and was not used elsewhere. */
static bool is_taken(const struct live *live, const struct node *node)
{
    return is_in(live->taken, node) && !is_in(live->spoilt, node) &&
           count_places(live->document.root, node) == 1;
}

void texts_take(struct emitter *emitter, const struct node *node)
{
    add_to(emitter, &emitter->live->taken, node);
}

void texts_spoil(struct emitter *emitter, const struct node *node)
{
    if (node) add_to(emitter, &emitter->live->spoilt, node);
}

void texts_spoil_all(struct emitter *emitter, const struct node *node)
{
    for (size_t i = 0; node->kind == node_map && i < node->count; i++)
        texts_spoil_all(emitter, node->pairs[i].value);
    for (size_t i = 0; node->kind == node_list && i < node->count; i++)
        texts_spoil_all(emitter, node->items[i]);
    texts_spoil(emitter, node);
}

/* ---- remaining texts */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* True if a text names a parameter. Units are in brackets, or follow a number that is the rest of the text. */
static bool mentions(const char *text, const char *name)
{
    size_t length = strlen(name), digits = strspn(text, "+-.0123456789eE");
    if (digits > 0 && text[digits] == ' ') return false;
    for (const char *at = text; *at; at++) {
        if (*at == '[') at += strcspn(at, "]");
        if (!*at) break;
        bool inside = at > text && (is_letter(at[-1]) || is_digit(at[-1]) || at[-1] == '.');
        if (!inside && strncmp(at, name, length) == 0 && !is_letter(at[length]) && !is_digit(at[length]))
            return true;
    }
    return false;
}

/* True for keys whose texts do not affect the motion. */
static bool is_silent(const char *key)
{
    static const char *const keys[] = {"hand",      "exact",    "description", "title", "output",
                                       "grading",   "fbd",      "$schema",     "units", "every",
                                       "tolerance", "accuracy", "step",        "method"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(keys[i], key) == 0) return true;
    return false;
}

static void fix_those_in(struct emitter *emitter, const struct node *node)
{
    const struct scene *scene = emitter->model->scene;
    for (size_t i = 0; node->kind == node_map && i < node->count; i++)
        if (!is_silent(node->pairs[i].key)) fix_those_in(emitter, node->pairs[i].value);
    for (size_t i = 0; node->kind == node_list && i < node->count; i++) fix_those_in(emitter, node->items[i]);
    if (node->kind != node_scalar || is_taken(emitter->live, node)) return;
    for (size_t i = 0; i < scene->parameter_count; i++)
        if (mentions(node->text, scene->parameters[i].name)) emitter->fixed[i] = true;
}

/* Fix the parameters in texts not taken over, except definitions of parameters, which may be unused. */
static void fix_others(struct emitter *emitter)
{
    const struct node *root = emitter->live->document.root;
    for (size_t i = 0; root->kind == node_map && i < root->count; i++)
        if (!is_silent(root->pairs[i].key) && strcmp(root->pairs[i].key, "parameters") != 0)
            fix_those_in(emitter, root->pairs[i].value);
}

/* Fix the parameters in definitions of fixed parameters, and in definitions that were not taken over. */
static void fix_in_definitions(struct emitter *emitter)
{
    const struct scene *scene = emitter->model->scene;
    const struct live *live = emitter->live;
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const struct node *node = texts_find_at(live->document.root, scene->parameters[i].at);
        if (node && (emitter->fixed[i] || live->defined[i])) fix_those_in(emitter, node);
    }
}

static size_t count_fixed(const struct emitter *emitter)
{
    size_t count = 0;
    for (size_t i = 0; i < emitter->model->scene->parameter_count; i++) count += emitter->fixed[i];
    return count;
}

bool emit_live_settled(struct emitter *emitter)
{
    size_t before = count_fixed(emitter), last;
    fix_others(emitter);
    do {
        last = count_fixed(emitter);
        fix_in_definitions(emitter);
    } while (count_fixed(emitter) != last);
    return last == before;
}
