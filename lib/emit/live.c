/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parameters of the file that stay parameters of the program.
 *
 * A model has numbers where the file has expressions of its parameters. So the texts are read once more, with
 * parameters as variables. A text counts as taken when this gives the model's number, or formula, to the bit. A
 * parameter that stands in any text that is not taken is no member of the program: its value is part of numbers
 * there, and changing it in some places alone would be another scene.
 */
#include "emit/live.h"

#include <string.h>

#include "emit/bodies.h"

struct live_pair {
    const struct expr *given, *live;
    const struct live_pair *before;
};

struct live_node {
    const struct node *node;
    const struct live_node *before;
};

struct live {
    struct document document;
    int first;         /* slot of the first parameter; then that of g, then masses of bodies */
    bool *used;        /* by parameter; then g */
    const char **name; /* members of struct parameters */
    bool *defined;
    double *y; /* values of all slots from 1 on */
    int slots;
    const struct live_pair *pairs;
    const struct live_node *taken, *spoilt;
    bool pulls_down; /* gravity is given by its magnitude */
};

/* ---- texts of the file */

static bool same_place(struct pos a, struct pos b)
{
    return a.line == b.line && a.column == b.column && a.line > 0;
}

/* What stands at `at`: the value behind the key there, or the value itself. */
static const struct node *find_at(const struct node *node, struct pos at)
{
    const struct node *found = NULL; /* a mapping begins where its first key does, which is meant then */
    for (size_t i = 0; node->kind == node_map && i < node->count && !found; i++)
        found = same_place(node->pairs[i].at, at) ? node->pairs[i].value : find_at(node->pairs[i].value, at);
    for (size_t i = 0; node->kind == node_list && i < node->count && !found; i++)
        found = find_at(node->items[i], at);
    return found ? found : same_place(node->at, at) ? node : NULL;
}

/* The text behind `key` in a node or right below it; the node itself where it is a short form. */
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

static const struct node *find_text(const struct live *live, struct emit_origin origin)
{
    static const char *const others[][2] = {{"static", "coefficient"},  {"kinetic", "coefficient"},
                                            {"static", "kinetic"},      {"kinetic", "static"},
                                            {"neutral", "free_length"}, {"free_length", "neutral"}};
    const struct node *entry = find_at(live->document.root, origin.at);
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

/* In how many places a value stands, by aliases. */
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

/* A text that is taken stands in one place, and nothing else was made of it. */
static bool is_taken(const struct live *live, const struct node *node)
{
    return is_in(live->taken, node) && !is_in(live->spoilt, node) &&
           count_places(live->document.root, node) == 1;
}

static void take(struct emitter *emitter, const struct node *node)
{
    add_to(emitter, &emitter->live->taken, node);
}

static void spoil(struct emitter *emitter, const struct node *node)
{
    if (node) add_to(emitter, &emitter->live->spoilt, node);
}

/* ---- names in them */

struct live_scope {
    struct emitter *emitter;
    int body; /* whose coordinates have no dot; -1 for none */
    bool constant;
};

static struct symbol variable(struct dim dim, int slot)
{
    return (struct symbol){.kind = symbol_variable, .dim = dim, .slot = slot};
}

static struct symbol coordinate(const struct emitter *emitter, const char *name)
{
    const struct scene *scene = emitter->model->scene;
    int n = emitter->model->plan.n, k = model_find_component(emitter->model, name, false);
    if (k < 0) return (struct symbol){.kind = symbol_unknown};
    return variable(k < n ? scene->coordinates[k].dim : scene->coordinates[k - n].rate_dim, 1 + k);
}

static struct symbol parameter(struct emitter *emitter, size_t index)
{
    struct live *live = emitter->live;
    const struct parameter *known = &emitter->model->scene->parameters[index];
    if (emitter->fixed[index])
        return (struct symbol){.kind = symbol_constant,
                               .dim = known->dim,
                               .free = known->bare,
                               .value = known->value};
    struct symbol symbol = variable(known->dim, live->first + (int)index);
    symbol.free = known->bare;
    return symbol;
}

static struct symbol look_up(void *context, const char *name, struct pos at)
{
    const struct live_scope *scope = context;
    struct emitter *emitter = scope->emitter;
    const struct scene *scene = emitter->model->scene;
    const struct live *live = emitter->live;
    struct symbol symbol = {.kind = symbol_unknown};
    (void)at;
    if (!scope->constant && strcmp(name, "t") == 0) return variable(DIM_TIME, 0);
    if (!scope->constant && strchr(name, '.')) return coordinate(emitter, name);
    if (!scope->constant && scope->body >= 0)
        symbol = coordinate(emitter, emit_printf(emitter, "%s.%s", scene->bodies[scope->body].name, name));
    else if (!scope->constant && scene->body_count == 1)
        symbol = coordinate(emitter, emit_printf(emitter, "%s.%s", scene->bodies[0].name, name));
    for (size_t i = 0; symbol.kind == symbol_unknown && i < scene->parameter_count; i++)
        if (strcmp(scene->parameters[i].name, name) == 0) return parameter(emitter, i);
    if (symbol.kind == symbol_unknown && strcmp(name, "g") == 0 && live->pulls_down)
        return variable(DIM_ACCELERATION, live->first + (int)scene->parameter_count);
    if (symbol.kind == symbol_unknown && strcmp(name, "m") == 0 && scope->body >= 0)
        return variable(DIM_MASS, live->first + (int)scene->parameter_count + 1 + scope->body);
    return symbol;
}

static const struct expr *read_text(struct live_scope *scope, const struct node *node)
{
    struct emitter *emitter = scope->emitter;
    const struct scope names = {.lookup = look_up, .context = scope, .units = emitter->model->scene->units};
    const struct expr_want want = {.any_dim = true, .what = "value"};
    fbd_errors errors = {.limit = 1};
    const struct expr *expr =
        expr_compile(&emitter->arena, node->text, (struct pos){1, 1}, &names, &want, &errors);
    bool failed = errors.errors > 0;
    emitter->arena.failed = emitter->arena.failed || errors.out_of_memory || errors.arena.failed;
    arena_free(&errors.arena);
    return failed ? NULL : expr;
}

/* ---- is it the same? */

static bool same_bits(double a, double b)
{
    return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b));
}

static bool names_anything(const struct live *live, const struct expr *expr)
{
    const int *slots;
    size_t count = expr_variables(expr, &slots);
    return count > 0 && slots[count - 1] >= live->first;
}

/* At points all over the place, the plain values and those of the smooth formulas. */
static bool agree(const struct emitter *emitter, const struct expr *given, const struct expr *live)
{
    enum { points = 12 };
    double *y = emitter->live->y, t = 0.4142135623730951;
    unsigned seed = 1;
    if (expr_switches(given) != expr_switches(live)) return false;
    for (int point = 0; point < points; point++) {
        for (int i = 0; i + 1 < emitter->live->first; i++) {
            seed = seed * 1664525u + 1013904223u;
            y[i] = ((double)(seed >> 8) / 8388608 - 1) * (point % 3 == 0 ? 1 : point % 3 == 1 ? 5 : 0.1);
        }
        t *= 1.6180339887498949;
        if (!same_bits(expr_eval(given, t, y, NULL), expr_eval(live, t, y, NULL))) return false;
    }
    return true;
}

/* ---- members */

/* Define a parameter, after those that its definition names. */
static void define(struct emitter *emitter, size_t index)
{
    struct live *live = emitter->live;
    const struct scene *scene = emitter->model->scene;
    if (live->defined[index]) return;
    live->defined[index] = true;
    const struct parameter *known = &scene->parameters[index];
    const struct node *node = find_at(live->document.root, known->at);
    struct live_scope scope = {emitter, -1, true};
    const struct expr *expr = node && node->kind == node_scalar ? read_text(&scope, node) : NULL;
    bool same =
        expr && names_anything(live, expr) && same_bits(expr_eval(expr, 0, live->y, NULL), known->value);
    const char *value = same ? emit_expression(emitter, expr, 0) : emit_number(emitter, known->value);
    char unit[64];
    unit_name(known->dim, scene->units, unit, sizeof unit);
    if (expr && (same || !names_anything(live, expr))) take(emitter, node);
    text_printf(&emitter->parameters, "    double %s;%s%s%s\n", live->name[index], *unit ? " /* " : "", unit,
                *unit ? " */" : "");
    text_printf(&emitter->defaults, "    p->%s = %s;\n", live->name[index], value);
}

const char *emit_live_variable(struct emitter *emitter, int slot)
{
    struct live *live = emitter->live;
    int index = slot - live->first, count = (int)emitter->model->scene->parameter_count;
    if (index > count) return emit_printf(emitter, "c->%s.mass", emitter->body[index - count - 1]);
    live->used[index] = true;
    if (index == count) return "p->g";
    define(emitter, (size_t)index);
    return emit_printf(emitter, "p->%s", live->name[index]);
}

bool emit_is_live(const struct emitter *emitter, int slot)
{
    return emitter->live && slot >= emitter->live->first;
}

/* The expression of a number of the file, or its digits. */
const char *emit_live_number(struct emitter *emitter, double value, struct emit_origin origin)
{
    struct live *live = emitter->live;
    const struct node *node = origin.at.line > 0 ? find_text(live, origin) : NULL;
    struct live_scope scope = {emitter, -1, true};
    const struct expr *expr = node ? read_text(&scope, node) : NULL;
    if (!expr || !same_bits(expr_eval(expr, 0, live->y, NULL), value)) {
        spoil(emitter, node);
        return emit_number(emitter, value);
    }
    take(emitter, node);
    return names_anything(live, expr) ? emit_expression(emitter, expr, 0) : emit_number(emitter, value);
}

/* ---- points */

static void spoil_tree(struct emitter *emitter, const struct node *node)
{
    for (size_t i = 0; node->kind == node_map && i < node->count; i++)
        spoil_tree(emitter, node->pairs[i].value);
    for (size_t i = 0; node->kind == node_list && i < node->count; i++) spoil_tree(emitter, node->items[i]);
    spoil(emitter, node);
}

void emit_live_spoil_body(struct emitter *emitter, int b)
{
    static const char *const keys[] = {"from", "to", "length", "angle", "center"};
    const struct body *body = b < 0 ? NULL : &emitter->model->scene->bodies[b];
    for (size_t i = 0; body && i < body->part_count; i++) {
        const struct node *entry = find_at(emitter->live->document.root, body->parts[i].at);
        for (size_t k = 0; entry && k < sizeof keys / sizeof *keys; k++) {
            const struct pair *pair = node_find(entry, keys[k]);
            if (pair) spoil_tree(emitter, pair->value);
        }
    }
}

/* One component by parameters; NULL where that is another number. */
static const char *component(struct emitter *emitter, const struct node *node, double value)
{
    struct live_scope scope = {emitter, -1, true};
    const struct expr *expr = node->kind == node_scalar ? read_text(&scope, node) : NULL;
    if (!expr || !same_bits(expr_eval(expr, 0, emitter->live->y, NULL), value)) return NULL;
    return names_anything(emitter->live, expr) ? emit_expression(emitter, expr, 0)
                                               : emit_number(emitter, value);
}

const char *emit_live_vector(struct emitter *emitter, const struct node *node, struct vec value)
{
    if (node->kind != node_list || node->count != 2) return NULL;
    const char *x = component(emitter, node->items[0], value.x),
               *y = component(emitter, node->items[1], value.y);
    if (!x || !y) return NULL;
    take(emitter, node->items[0]);
    take(emitter, node->items[1]);
    return emit_printf(emitter, "(struct vec){%s, %s}", x, y);
}

bool emit_live_pair(struct emitter *emitter, const struct node *node, struct vec *value)
{
    double *components[] = {&value->x, &value->y};
    struct live_scope scope = {emitter, -1, true};
    for (size_t i = 0; i < 2; i++) {
        bool plain = node->kind == node_list && node->count == 2 && node->items[i]->kind == node_scalar;
        const struct expr *expr = plain ? read_text(&scope, node->items[i]) : NULL;
        if (!expr) return false;
        *components[i] = expr_eval(expr, 0, emitter->live->y, NULL);
    }
    return true;
}

const struct node *emit_live_find(const struct emitter *emitter, struct emit_origin origin)
{
    const struct node *entry = origin.at.line > 0 ? find_at(emitter->live->document.root, origin.at) : NULL;
    const struct pair *pair = entry ? node_find(entry, origin.key) : NULL;
    return pair ? pair->value : NULL;
}

/* ---- formulas */

static void remember(struct emitter *emitter, const struct expr *given, const struct expr *expr)
{
    struct live_pair *pair = ARENA_NEW(&emitter->arena, struct live_pair);
    if (!pair) return;
    *pair = (struct live_pair){given, expr, emitter->live->pairs};
    emitter->live->pairs = pair;
}

const struct expr *emit_live(const struct emitter *emitter, const struct expr *given)
{
    for (const struct live_pair *pair = emitter->live->pairs; pair; pair = pair->before)
        if (pair->given == given) return pair->live;
    return given;
}

/* An event has a formula on each side of its sign. */
static void live_relation(struct emitter *emitter, const struct node *node, const struct expr *left,
                          const struct expr *right)
{
    struct live_scope scope = {emitter, -1, false};
    const struct scope names = {.lookup = look_up, .context = &scope, .units = emitter->model->scene->units};
    const struct expr_want want = {.any_dim = true, .what = "when"};
    fbd_errors errors = {.limit = 1};
    const struct expr *a, *b;
    char relation;
    bool read = expr_compile_relation(&emitter->arena, node->text, (struct pos){1, 1}, &names, &want, &errors,
                                      &a, &relation, &b);
    emitter->arena.failed = emitter->arena.failed || errors.out_of_memory || errors.arena.failed;
    arena_free(&errors.arena);
    if (!read || !agree(emitter, left, a) || !b != !right || (b && !agree(emitter, right, b))) {
        spoil(emitter, node);
        return;
    }
    take(emitter, node);
    remember(emitter, left, a);
    if (b) remember(emitter, right, b);
}

void emit_live_event(struct emitter *emitter, const struct user_event *event)
{
    const struct node *node = find_text(emitter->live, (struct emit_origin){.at = event->at, .key = "when"});
    if (node) live_relation(emitter, node, event->left, event->right);
}

void emit_live_formula(struct emitter *emitter, const struct expr *given, struct emit_origin origin)
{
    const struct node *node = origin.at.line > 0 ? find_text(emitter->live, origin) : NULL;
    struct live_scope scope = {emitter, origin.body, false};
    if (!node || emit_live(emitter, given) != given) return;
    const struct expr *expr = read_text(&scope, node);
    if (!expr || !agree(emitter, given, expr)) {
        spoil(emitter, node);
        return;
    }
    take(emitter, node);
    remember(emitter, given, expr);
}

const char *emit_live_gravity(struct emitter *emitter)
{
    double magnitude = vec_norm(emitter->model->scene->gravity);
    const struct pair *pair = node_find(emitter->live->document.root, "gravity");
    struct emit_origin origin = {.at = pair ? pair->at : (struct pos){0, 0}, .key = "gravity"};
    return emitter->live->pulls_down ? emit_live_number(emitter, magnitude, origin) : NULL;
}

/* Where the start of a body stands. */
struct emit_origin emit_live_start(const struct emitter *emitter, struct pos body, const char *key)
{
    const struct node *node = find_at(emitter->live->document.root, body);
    const struct pair *initial = node ? node_find(node, "initial") : NULL;
    return (struct emit_origin){.at = initial ? initial->at : (struct pos){0, 0}, .key = key};
}

/* ---- what is left */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/* Does a text name a parameter? Units stand in brackets, or behind a number that is all else of the text. */
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

/* Keys whose texts do not say how the scene moves. */
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

/* Definitions of parameters that nothing asks for count for nothing. */
static void fix_others(struct emitter *emitter)
{
    const struct node *root = emitter->live->document.root;
    for (size_t i = 0; root->kind == node_map && i < root->count; i++)
        if (!is_silent(root->pairs[i].key) && strcmp(root->pairs[i].key, "parameters") != 0)
            fix_those_in(emitter, root->pairs[i].value);
}

/* What a definition names is part of a number too where it has become one. */
static void fix_in_definitions(struct emitter *emitter)
{
    const struct scene *scene = emitter->model->scene;
    const struct live *live = emitter->live;
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const struct node *node = find_at(live->document.root, scene->parameters[i].at);
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

/* ---- opening and closing */

static void set_values(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    const struct scene *scene = model->scene;
    struct live *live = emitter->live;
    double *values = live->y + live->first - 1;
    for (size_t i = 0; i < scene->parameter_count; i++) values[i] = scene->parameters[i].value;
    values[scene->parameter_count] = vec_norm(scene->gravity);
    for (size_t b = 0; b < model->body_count; b++)
        values[scene->parameter_count + 1 + b] = model->bodies[b].inertia.mass;
}

bool emit_live_open(struct emitter *emitter)
{
    const struct fbd_model *model = emitter->model;
    const struct scene *scene = model->scene;
    struct arena *arena = &emitter->arena;
    struct live *live = ARENA_NEW(arena, struct live);
    fbd_errors errors = {.limit = 1};
    if (!live) return false;
    emitter->live = live;
    live->first = 1 + 2 * model->plan.n + hand_slots + (int)scene->absolute_count;
    live->slots = live->first + (int)scene->parameter_count + 1 + (int)model->body_count;
    live->used = ARENA_ARRAY(arena, scene->parameter_count + 1, bool);
    live->defined = ARENA_ARRAY(arena, scene->parameter_count, bool);
    live->name = ARENA_ARRAY(arena, scene->parameter_count, const char *);
    live->y = ARENA_ARRAY(arena, (size_t)live->slots, double);
    bool open = document_open(&live->document, model->source, model->source_length, scene->file, &errors);
    arena_free(&errors.arena);
    if (!open || arena->failed) return false;
    for (size_t i = 0; i < scene->parameter_count; i++)
        live->name[i] = emit_name(emitter, scene->parameters[i].name);
    live->pulls_down = scene->gravity.x == 0 && scene->gravity.y <= 0;
    set_values(emitter);
    return !arena->failed;
}

void emit_live_close(struct emitter *emitter)
{
    if (emitter->live) document_close(&emitter->live->document);
    emitter->live = NULL;
}
