/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Equations of equilibrium: sums of forces and moments that are zero at the start of the sheet.
 *
 * Such an equation contains no acceleration, and is true for the values of the sheet only. It is accepted if
 * it is satisfied there and is a combination of the sums of forces and moments on the bodies: under small
 * changes of the parameters it changes as a combination of these sums does. An equation that states a value
 * (W = 400[N]) does not. The sums contain the loads that the key lists and the correct reactions of the
 * answer, each of which is a parameter.
 */
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/lines.h"

enum { sums = 3 }; /* of a body: forces along x and y, moments about the origin */

/* ---- models whose parameters are changed a little */

/* True for a number with or without a unit; parameters that depend on others change with them. */
static bool is_given(const struct node *value)
{
    if (value->kind == node_map) value = lines_value(value, "value");
    if (!value || value->kind != node_scalar) return false;
    char *end;
    strtod(value->text, &end);
    if (end == value->text) return false;
    return *end == '\0' || *end == ' ' || (*end >= 'A' && *end <= 'z');
}

/* Pseudo-random number between -1 and 1 from the name and the number of the change. */
static double change_of(const char *name, int number)
{
    unsigned long long mixed = (unsigned long long)hash_text(name, strlen(name)) ^
                               (0x9e3779b97f4a7c15ULL * (unsigned long long)(number + 1));
    mixed = (mixed ^ (mixed >> 31)) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ (mixed >> 29)) * 0x94d049bb133111ebULL;
    return (double)(mixed >> 11) / 4503599627370496.0 - 1;
}

/* The model of a tree with all given parameters changed; unchanged for number 0. */
static fbd_model *changed_model(struct fbd_grade *grade, const struct node *root, const fbd_model *like,
                                bool hands, int number)
{
    const double spread = 1e-3;
    const size_t most = fbd_model_parameter_count(like);
    const struct node *parameters = lines_value(root, "parameters");
    fbd_setting *settings = ARENA_ARRAY(&grade->arena, most + 1, fbd_setting);
    fbd_errors *errors = fbd_errors_new();
    size_t count = 0;
    fbd_model *model = NULL;
    for (size_t i = 0; settings && i < most; i++) {
        const fbd_parameter parameter = fbd_model_parameter(like, i);
        const struct node *value = lines_value(parameters, parameter.name);
        if (!value || !is_given(value)) continue;
        double factor = number > 0 ? 1 + spread * change_of(parameter.name, number) : 1;
        const char *text = arena_printf(&grade->arena, "%.17g", factor * parameter.value);
        settings[count++] = (fbd_setting){.name = parameter.name, .value = text};
    }
    if (errors && !grade->arena.failed)
        model = tree_compile(root, grade->key->file, settings, count, hands, errors);
    if (!errors || errors->out_of_memory) grade->arena.failed = true;
    fbd_errors_free(errors);
    return model;
}

/* ---- sums */

struct rest {
    int draws;
    size_t rows;
    double *sum;  /* draws + 1 times rows: the first with the values of the sheet */
    double *size; /* rows: sums of magnitudes */
};

static bool counts_here(const struct fbd_grade *grade, const fbd_listed_force *force, bool answer)
{
    if (!answer) return !force->reaction;
    const struct drawn *drawn = drawn_at(grade, (struct pos){force->line, force->column});
    return drawn && isfinite(drawn->size);
}

/* The number of the body of this name; the number of bodies for none. */
static size_t body_called(const fbd_model *model, const char *name)
{
    size_t b = 0;
    while (b < fbd_model_body_count(model) && strcmp(fbd_model_body_name(model, b), name) != 0) b++;
    return b;
}

/* Units of length and force in those of the key. */
struct units {
    double length, force;
};

/* Add the listed forces and moments of a body to its sums. False when memory is out. */
static bool add_body(const struct fbd_grade *grade, fbd_state *state, const fbd_body *body, size_t b,
                     struct units units, bool answer, double *sum, double *size)
{
    fbd_listed_force *forces = calloc(body->most_forces + 1, sizeof *forces);
    bool done = forces && fbd_state_forces(state, b, forces, body->most_forces) != SIZE_MAX;
    for (size_t i = 0; done && i < body->listed; i++) {
        const fbd_arrow *arrow = &forces[i].arrow;
        if (!counts_here(grade, &forces[i], answer)) continue;
        const double moment = arrow->couple + (arrow->x * arrow->fy - arrow->y * arrow->fx);
        const double parts[sums] = {units.force * arrow->fx, units.force * arrow->fy,
                                    units.force * units.length * moment};
        for (int k = 0; k < sums; k++) {
            sum[k] += parts[k];
            size[k] += fabs(parts[k]);
        }
    }
    free(forces);
    return done;
}

/* Add the listed loads of the bodies of a model to their sums. */
static bool add_sums(struct lines *lines, const fbd_model *model, struct units units, bool answer,
                     double *sum, double *size)
{
    const fbd_model *key = lines->grade->sheet;
    fbd_state *state = grade_start(model);
    bool done = state != NULL;
    for (size_t b = 0; done && b < fbd_model_body_count(model); b++) {
        const fbd_body body = fbd_model_body(model, b);
        size_t to = body_called(key, body.name);
        if (to < fbd_model_body_count(key))
            done = add_body(lines->grade, state, &body, b, units, answer, sum + to * sums, size + to * sums);
    }
    fbd_state_free(state);
    return done;
}

static bool is_us(const fbd_model *model)
{
    return strcmp(fbd_model_scene(model).units, "US") == 0;
}

/* The sums under one change of the parameters, in the units of the key. False if a model is invalid. */
static bool take_sums(struct lines *lines, const fbd_model *answer, int number, double *sum, double *size)
{
    struct fbd_grade *grade = lines->grade;
    const struct units own = {1, 1}, us = {0.3048, 4.4482216152605}, si = {1 / us.length, 1 / us.force};
    fbd_model *model = changed_model(grade, grade->key->root, grade->sheet, false, number);
    bool done = model && add_sums(lines, model, own, false, sum, size);
    fbd_model_free(model);
    if (!answer || !done) return done;
    const bool alike = is_us(answer) == is_us(grade->sheet);
    model = changed_model(grade, lines->varied, answer, false, number);
    done = model && add_sums(lines, model, alike ? own : is_us(answer) ? us : si, true, sum, size);
    fbd_model_free(model);
    return done;
}

/* ---- the answer with a parameter for each reaction */

static const struct node *text_node(struct arena *arena, const struct node *like, const char *text)
{
    struct node *made = ARENA_NEW(arena, struct node);
    if (!made || !text) return NULL;
    *made = (struct node){.kind = node_scalar, .height = 1, .at = like->at, .size = 1, .text = text};
    made->length = strlen(text);
    made->text_at = like->at;
    return made;
}

/* An entry of a list whose value is the parameter. */
static const struct node *varied_entry(struct fbd_grade *grade, const struct node *entry)
{
    struct arena *arena = &grade->arena;
    const struct pair *applied = entry->kind == node_map ? node_find(entry, "applied") : NULL;
    struct drawn *drawn = applied ? drawn_at(grade, applied->at) : NULL;
    if (!drawn || !drawn->parameter || !lines_value(applied->value, "value")) return entry;
    const char *text = arena_printf(arena, "%s%s", drawn->minus ? "-" : "", drawn->parameter);
    const struct node *value = text_node(arena, applied->value, text);
    const struct node *keys = value ? node_with(arena, applied->value, "value", value) : NULL;
    return keys ? node_with(arena, entry, "applied", keys) : NULL;
}

static const struct node *varied_list(struct fbd_grade *grade, const struct node *list)
{
    const struct node *made = node_shortened(&grade->arena, list, 0);
    for (size_t i = 0; made && i < list->count; i++) {
        const struct node *entry = varied_entry(grade, list->items[i]);
        made = entry ? node_appended(&grade->arena, made, entry) : NULL;
    }
    return made;
}

static const struct node *varied_bodies(struct fbd_grade *grade, const struct node *bodies)
{
    static const char *const keys[] = {"forces", "moments"};
    const struct node *made = bodies;
    for (size_t b = 0; made && b < bodies->count; b++)
        for (size_t k = 0; made && k < 2; k++) {
            const char *name = bodies->pairs[b].key;
            const struct node *body = lines_value(made, name), *list = lines_value(body, keys[k]);
            if (!list || list->kind != node_list) continue;
            list = varied_list(grade, list);
            body = list ? node_with(&grade->arena, body, keys[k], list) : NULL;
            made = body ? node_with(&grade->arena, made, name, body) : NULL;
        }
    return made;
}

/* The parameters of a tree, and one for each correct reaction. */
static const struct node *with_reactions(struct fbd_grade *grade, const struct node *root)
{
    struct arena *arena = &grade->arena;
    const struct node *all = lines_value(root, "parameters");
    if (!all || all->kind != node_map) all = node_empty_map(arena);
    for (struct drawn *one = grade->drawn; all && one; one = one->next) {
        const char *name = one->name ? one->name : one->symbol;
        if (!isfinite(one->size) || !name) continue;
        one->parameter = arena_printf(arena, "%s__%s", name, one->body);
        const char *text = arena_printf(arena, "%.17g %s", one->size, one->unit);
        const struct node *value = one->parameter && text ? text_node(arena, root, text) : NULL;
        all = value ? node_with(arena, all, one->parameter, value) : NULL;
    }
    return all ? node_with(arena, root, "parameters", all) : NULL;
}

static fbd_model *make_varied(struct lines *lines)
{
    struct fbd_grade *grade = lines->grade;
    const struct node *root = with_reactions(grade, lines->answer);
    const struct node *bodies = root ? varied_bodies(grade, lines_value(root, "bodies")) : NULL;
    lines->varied = bodies ? node_with(&grade->arena, root, "bodies", bodies) : NULL;
    if (!lines->varied) grade->arena.failed = true;
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = NULL;
    if (errors && lines->varied) model = grade_compile(grade, lines->varied, grade->key->file, false, errors);
    fbd_errors_free(errors);
    return model;
}

/* Compute all sums, once for all lines; false if they cannot be computed. */
static bool find_sums(struct lines *lines)
{
    struct fbd_grade *grade = lines->grade;
    const size_t rows = sums * fbd_model_body_count(grade->sheet);
    struct rest *rest = ARENA_NEW(&grade->arena, struct rest);
    if (lines->rest_made) return lines->rest != NULL;
    lines->rest_made = true;
    if (!rest) return false;
    *rest = (struct rest){.draws = rows <= 12 ? 2 * (int)rows + 6 : 30, .rows = rows};
    rest->sum = ARENA_ARRAY(&grade->arena, (size_t)(rest->draws + 1) * rows + 1, double);
    rest->size = ARENA_ARRAY(&grade->arena, rows + 1, double);
    double *other = ARENA_ARRAY(&grade->arena, rows + 1, double);
    fbd_model *answer = lines->answer ? make_varied(lines) : NULL;
    bool done = rest->sum && rest->size && other && (answer || !lines->answer);
    for (int k = 0; done && k <= rest->draws; k++)
        done = take_sums(lines, answer, k, rest->sum + (size_t)k * rows, k == 0 ? rest->size : other);
    fbd_model_free(answer);
    if (done) lines->rest = rest;
    return done;
}

/* ---- one equation */

/* The key's scene with only this equation, with the parameters of the reactions. */
static const struct node *root_of_line(struct lines *lines, int body, const char *text)
{
    struct fbd_grade *grade = lines->grade;
    struct arena *arena = &grade->arena;
    const struct node *root = lines->root, *bodies = lines_value(root, "bodies"), *made = bodies;
    const char *name = fbd_model_body_name(grade->sheet, (size_t)body);
    for (size_t b = 0; made && b < bodies->count; b++) {
        const struct node *one = node_with(arena, bodies->pairs[b].value, "hand", NULL);
        made = one ? node_with(arena, made, bodies->pairs[b].key, one) : NULL;
    }
    const struct node *line = text_node(arena, root, text);
    if (line && lines->answer) line = line_over_parameters(grade, lines->answer, line, name);
    const struct node *list = line ? node_appended(arena, NULL, line) : NULL;
    const struct node *own = made && list ? node_with(arena, lines_value(made, name), "hand", list) : NULL;
    made = own ? node_with(arena, made, name, own) : NULL;
    root = made ? node_with(arena, root, "bodies", made) : NULL;
    return root && lines->answer ? with_reactions(grade, root) : root;
}

static double rest_norm(const double *a, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) sum += a[i] * a[i];
    return sqrt(sum);
}

static double rest_beyond(double *a, const double *base, int count)
{
    double along = 0;
    for (int i = 0; i < count; i++) along += a[i] * base[i];
    for (int i = 0; i < count; i++) a[i] -= along * base[i];
    return rest_norm(a, count);
}

static double lack_of(const fbd_model *model, int body, double *size)
{
    fbd_state *state = model ? grade_start(model) : NULL;
    const fbd_residual residual = fbd_state_residual(state, (size_t)body, 0);
    fbd_state_free(state);
    *size = residual.size;
    return residual.value;
}

/* Changes of left minus right; false if it cannot be evaluated, or is not zero for the sheet. */
static bool find_changes(struct lines *lines, int body, const char *text, double *changes)
{
    struct fbd_grade *grade = lines->grade;
    const struct node *root = root_of_line(lines, body, text);
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = NULL;
    if (!root || !errors) grade->arena.failed = true;
    if (root && errors) model = grade_compile(grade, root, grade->key->file, true, errors);
    double size = 0, lack = lack_of(model, body, &size);
    bool done = model && fabs(lack) <= 0.3 * grade->key->grading.tolerance * size;
    for (int k = 1; done && k <= lines->rest->draws; k++) {
        fbd_model *changed = changed_model(grade, root, model, true, k);
        double other;
        changes[k - 1] = lack_of(changed, body, &other) - lack;
        done = isfinite(changes[k - 1]);
        fbd_model_free(changed);
    }
    fbd_model_free(model);
    fbd_errors_free(errors);
    const double rounding = 1e-9;
    return done && rest_norm(changes, lines->rest->draws) > rounding * size;
}

/* True if the changes are a combination of those of the sums that are zero. */
static bool is_of_sums(const struct lines *lines, const double *changes)
{
    enum { most_rows = 30, most_draws = 30 };
    const struct rest *rest = lines->rest;
    const double tolerance = lines->grade->key->grading.tolerance, apart = 1e-6, like = 0.01;
    double base[most_rows][most_draws], left[most_draws];
    size_t found = 0, n = (size_t)rest->draws;
    memcpy(left, changes, n * sizeof *left);
    for (size_t r = 0; r < rest->rows && found < most_rows && found + 4 < n; r++) {
        if (!(fabs(rest->sum[r]) <= tolerance * rest->size[r])) continue;
        double *column = base[found];
        for (size_t k = 0; k < n; k++) column[k] = rest->sum[(k + 1) * rest->rows + r] - rest->sum[r];
        double before = rest_norm(column, rest->draws), after = before;
        for (size_t j = 0; j < found; j++) after = rest_beyond(column, base[j], rest->draws);
        if (!(after > apart * before)) continue;
        for (size_t k = 0; k < n; k++) column[k] /= after;
        rest_beyond(left, column, rest->draws);
        found++;
    }
    return rest_norm(left, rest->draws) <= like * rest_norm(changes, rest->draws);
}

bool line_is_of_rest(struct lines *lines, int body, const char *text, const double **changes)
{
    *changes = NULL;
    if (!find_sums(lines)) return !lines->grade->arena.failed;
    double *made = ARENA_ARRAY(&lines->grade->arena, (size_t)lines->rest->draws, double);
    if (made && find_changes(lines, body, text, made) && is_of_sums(lines, made)) *changes = made;
    return !lines->grade->arena.failed;
}

bool form_is_new(const double *form, int numbers, double *base, size_t count)
{
    const double apart = 0.03;
    double *made = base + count * (size_t)numbers;
    memcpy(made, form, (size_t)numbers * sizeof *made);
    double before = rest_norm(made, numbers), after = before;
    for (size_t k = 0; k < count; k++) after = rest_beyond(made, base + k * (size_t)numbers, numbers);
    for (int k = 0; k < numbers; k++) made[k] /= after;
    return after > apart * before;
}

bool rest_is_new(const struct lines *lines, const double *changes, double *base, size_t count)
{
    return form_is_new(changes, lines->rest->draws, base, count);
}
