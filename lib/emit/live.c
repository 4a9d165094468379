/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Parameters of the file that become parameters of the program.
 *
 * A model has numbers where the file has expressions of its parameters. So the texts are read once more, with
 * parameters as variables. A text is taken over when it reproduces the model's number, or formula, bitwise. A
 * parameter that occurs in any other text is no member of the program: its value is contained in numbers
 * there, and changing only some of its occurrences would give an inconsistent scene.
 */
#include "emit/live.h"

#include <stdint.h>
#include <string.h>

#include "emit/live_texts.h"

/* ---- names */

struct live_scope {
    struct emitter *emitter;
    int body; /* body whose coordinates have no prefix; -1 for none */
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

/* ---- comparison */

static bool same_bits(double a, double b)
{
    uint64_t x, y;
    memcpy(&x, &a, sizeof x);
    memcpy(&y, &b, sizeof y);
    return x == y || (isnan(a) && isnan(b));
}

static bool names_anything(const struct live *live, const struct expr *expr)
{
    const int *slots;
    size_t count = expr_variables(expr, &slots);
    return count > 0 && slots[count - 1] >= live->first;
}

/* Compare two expressions at pseudorandom points of different magnitudes. */
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

/* Define a parameter, after those in its definition. */
static void define(struct emitter *emitter, size_t index)
{
    struct live *live = emitter->live;
    const struct scene *scene = emitter->model->scene;
    if (live->defined[index]) return;
    live->defined[index] = true;
    const struct parameter *known = &scene->parameters[index];
    const struct node *node = texts_find_at(live->document.root, known->at);
    struct live_scope scope = {emitter, -1, true};
    const struct expr *expr = node && node->kind == node_scalar ? read_text(&scope, node) : NULL;
    bool same =
        expr && names_anything(live, expr) && same_bits(expr_eval(expr, 0, live->y, NULL), known->value);
    const char *value = same ? emit_expression(emitter, expr, 0) : emit_number(emitter, known->value);
    char unit[64];
    unit_name(known->dim, scene->units, unit, sizeof unit);
    if (expr && (same || !names_anything(live, expr))) texts_take(emitter, node);
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

const char *emit_live_number(struct emitter *emitter, double value, struct emit_origin origin)
{
    struct live *live = emitter->live;
    const struct node *node = origin.at.line > 0 ? texts_find(live, origin) : NULL;
    struct live_scope scope = {emitter, -1, true};
    const struct expr *expr = node ? read_text(&scope, node) : NULL;
    if (!expr || !same_bits(expr_eval(expr, 0, live->y, NULL), value)) {
        texts_spoil(emitter, node);
        return emit_number(emitter, value);
    }
    texts_take(emitter, node);
    return names_anything(live, expr) ? emit_expression(emitter, expr, 0) : emit_number(emitter, value);
}

/* ---- points */

void emit_live_spoil_body(struct emitter *emitter, int b)
{
    static const char *const keys[] = {"from", "to", "length", "angle", "center"};
    const struct body *body = b < 0 ? NULL : &emitter->model->scene->bodies[b];
    for (size_t i = 0; body && i < body->part_count; i++) {
        const struct node *entry = texts_find_at(emitter->live->document.root, body->parts[i].at);
        for (size_t k = 0; entry && k < sizeof keys / sizeof *keys; k++) {
            const struct pair *pair = node_find(entry, keys[k]);
            if (pair) texts_spoil_all(emitter, pair->value);
        }
    }
}

/* One component by parameters; NULL if that gives another value. */
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
    texts_take(emitter, node->items[0]);
    texts_take(emitter, node->items[1]);
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
    const struct node *entry =
        origin.at.line > 0 ? texts_find_at(emitter->live->document.root, origin.at) : NULL;
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

/* Take over an event, which has a formula on each side of its relation. */
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
        texts_spoil(emitter, node);
        return;
    }
    texts_take(emitter, node);
    remember(emitter, left, a);
    if (b) remember(emitter, right, b);
}

void emit_live_event(struct emitter *emitter, const struct user_event *event)
{
    const struct node *node = texts_find(emitter->live, (struct emit_origin){.at = event->at, .key = "when"});
    if (node) live_relation(emitter, node, event->left, event->right);
}

void emit_live_formula(struct emitter *emitter, const struct expr *given, struct emit_origin origin)
{
    const struct node *node = origin.at.line > 0 ? texts_find(emitter->live, origin) : NULL;
    struct live_scope scope = {emitter, origin.body, false};
    if (!node || emit_live(emitter, given) != given) return;
    const struct expr *expr = read_text(&scope, node);
    if (!expr || !agree(emitter, given, expr)) {
        texts_spoil(emitter, node);
        return;
    }
    texts_take(emitter, node);
    remember(emitter, given, expr);
}

const char *emit_live_gravity(struct emitter *emitter)
{
    double magnitude = vec_norm(emitter->model->scene->gravity);
    const struct pair *pair = node_find(emitter->live->document.root, "gravity");
    struct emit_origin origin = {.at = pair ? pair->at : (struct pos){0, 0}, .key = "gravity"};
    return emitter->live->pulls_down ? emit_live_number(emitter, magnitude, origin) : NULL;
}

/* The position of an initial value of a body in the file. */
struct emit_origin emit_live_start(const struct emitter *emitter, struct pos body, const char *key)
{
    const struct node *node = texts_find_at(emitter->live->document.root, body);
    const struct pair *initial = node ? node_find(node, "initial") : NULL;
    return (struct emit_origin){.at = initial ? initial->at : (struct pos){0, 0}, .key = key};
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
