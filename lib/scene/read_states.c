/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * User states: z' = rate. Any expression may name them, so their units are determined at their first use:
 * from `unit`, else from the unit of `initial`, else from the rate, which then must not depend on the unit.
 */
#include <string.h>

#include "document/scalar.h"
#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

/* ---- names */

static bool is_taken(struct reader *reader, const struct pair *pair, const struct node *others,
                     const char *what)
{
    if (!others || !node_find(others, pair->key)) return false;
    diag_add(reader->errors, FBD_ERROR, "duplicate-name", pair->at, "choose another name",
             "%s is called `%s`, too", what, pair->key);
    return true;
}

static bool check_name(struct reader *reader, const struct pair *pair)
{
    if (!name_check(reader->errors, pair->key, pair->at, "a state")) return false;
    if (name_is_reserved(pair->key) || strcmp(pair->key, "g") == 0 || strcmp(pair->key, "m") == 0) {
        diag_add(reader->errors, FBD_ERROR, "reserved-name", pair->at, "choose another name",
                 "`%s` cannot be a state: it is the time, a number, a coordinate or a property of bodies",
                 pair->key);
        return false;
    }
    return !is_taken(reader, pair, reader->parameters, "a parameter") &&
           !is_taken(reader, pair, reader->tables, "a table");
}

/* Refuse a body called `states`: `states.x` would be ambiguous. */
static bool check_bodies(struct reader *reader)
{
    const struct pair *body = reader->bodies ? node_find(reader->bodies, "states") : NULL;
    if (!body || reader->scene->own_count == 0) return true;
    diag_add(
        reader->errors, FBD_ERROR, "reserved-name", body->at, "choose another name",
        "a body cannot be called `states` beside the states of the file, which are called `states.name`");
    return false;
}

static void start(struct reader *reader, size_t index)
{
    const struct pair *pair = &reader->own->pairs[index];
    struct own_draft *draft = &reader->own_drafts[index];
    struct own_state_keys keys = {0};
    draft->factor = 1;
    reader->scene->own[index].name = arena_text(reader->arena, pair->key, strlen(pair->key));
    reader->scene->own[index].at = pair->at;
    bool named = check_name(reader, pair);
    if (pair->value->kind == node_scalar)
        keys.rate = pair->value;
    else if (!fields_read(reader, &own_state_group, pair->value, pair->at, &reader->constants, &keys))
        named = false;
    draft->rate = keys.rate;
    draft->initial = keys.initial;
    draft->unit = keys.unit;
    if (!named || !keys.rate) draft->progress = failed;
}

bool own_states_start(struct reader *reader)
{
    enum { most_states = 1000 };
    struct scene *scene = reader->scene;
    size_t count = reader->own ? reader->own->count : 0;
    if (count > most_states) {
        diag_add(reader->errors, FBD_ERROR, "too-many-states", reader->own->at, NULL, "more than %d states",
                 most_states);
        return true;
    }
    scene->own_count = count;
    scene->own = ARENA_ARRAY(reader->arena, count, struct own_state);
    reader->own_drafts = ARENA_ARRAY(reader->arena, count, struct own_draft);
    if (!scene->own || !reader->own_drafts) return false;
    for (size_t i = 0; i < count; i++) start(reader, i);
    check_bodies(reader);
    return !reader->arena->failed;
}

/* ---- units */

static bool read_unit(struct reader *reader, const struct node *node, struct unit *unit)
{
    *unit = (struct unit){.factor = 1};
    if (node->length == 0)
        return value_refuse(reader, node, "unit", "a unit", "write for example `unit: N*s`");
    if (strcmp(node->text, "1") == 0) return true;
    return unit_parse(node->text, node->length, reader->scene->units, reader->errors, node->text_at, unit);
}

static bool read_initial(struct reader *reader, struct own_draft *draft, struct expr_want want)
{
    const struct node *node = draft->initial;
    if (!node) return true;
    want.constant = true;
    want.what = "initial";
    if (node->length == 0)
        return value_refuse(reader, node, "initial", "a quantity", "write for example `initial: 0`");
    if (!scalar_check_number(node->text, node->text_at, want.what, reader->errors)) return false;
    draft->start = value_compile(reader, node, &want, &reader->constants);
    return draft->start != NULL;
}

static const struct expr *compile_rate(struct reader *reader, size_t index, struct expr_want want)
{
    const struct node *node = reader->own_drafts[index].rate;
    struct names names = {.reader = reader,
                          .place = place_event,
                          .body = reader->scene->body_count == 1 ? 0 : ground_body};
    struct scope scope = names_scope(&names);
    want.what = "rate";
    if (node->length == 0) {
        value_refuse(reader, node, "rate", "an expression", "write for example `rate: 2[m] - block.x`");
        return NULL;
    }
    return value_compile(reader, node, &want, &scope);
}

static bool find_dimension(struct reader *reader, size_t index)
{
    struct own_draft *draft = &reader->own_drafts[index];
    struct own_state *state = &reader->scene->own[index];
    const struct expr_want any = {.any_dim = true};
    if (draft->unit) {
        struct unit unit;
        if (!read_unit(reader, draft->unit, &unit)) return false;
        state->dim = unit.dim;
        draft->factor = unit.factor;
        return read_initial(reader, draft, (struct expr_want){.dim = unit.dim});
    }
    if (!read_initial(reader, draft, any)) return false;
    if (draft->start && !expr_is_bare(draft->start)) {
        state->dim = expr_dim(draft->start);
        return true;
    }
    const struct expr *rate = compile_rate(reader, index, any);
    if (!rate) return false;
    state->dim = expr_is_bare(rate) ? DIM_NONE : dim_times(expr_dim(rate), DIM_TIME);
    return true;
}

/* Determine the dimension of a state if necessary. False after a note, here or before. */
static bool know_dimension(struct reader *reader, size_t index, struct pos at)
{
    struct own_draft *draft = &reader->own_drafts[index];
    const struct own_state *state = &reader->scene->own[index];
    if (draft->progress == untouched) {
        struct open_definition open;
        draft->progress = failed;
        if (!definition_open(reader, &open, state->name, at)) return false;
        draft->progress = in_progress;
        bool fine = find_dimension(reader, index);
        if (draft->progress == in_progress) draft->progress = fine ? done : failed;
        definition_close(reader, &open);
    } else if (draft->progress == in_progress) {
        diag_add(reader->errors, FBD_ERROR, "missing-unit", state->at,
                 "add `unit: N*s` or the like (`unit: 1` for a pure number), or give `initial` its unit",
                 "the unit of the state `%s` does not follow: its rate depends on the state itself",
                 state->name);
        draft->progress = failed;
    }
    return draft->progress == done;
}

/* ---- symbols */

struct symbol own_state_symbol(const struct names *names, const char *name, struct pos at)
{
    struct reader *reader = names->reader;
    struct scene *scene = reader->scene;
    struct symbol symbol = {.kind = symbol_unknown};
    const struct pair *pair = scene->own_count > 0 ? node_find(reader->own, name) : NULL;
    if (!pair || names->place == place_exact) return symbol;
    size_t index = (size_t)(pair - reader->own->pairs);
    reader->varies = true;
    if (names->place == place_constant) {
        symbol.kind = symbol_variable; /* refused by the caller */
        return symbol;
    }
    if (!know_dimension(reader, index, at)) {
        symbol.kind = symbol_failed;
        return symbol;
    }
    symbol.kind = symbol_variable;
    symbol.dim = scene->own[index].dim;
    symbol.slot = (int)(1 + 2 * scene->coordinate_count + index);
    return symbol;
}

/* ---- the equations */

static bool read_state(struct reader *reader, size_t index)
{
    struct own_draft *draft = &reader->own_drafts[index];
    struct own_state *state = &reader->scene->own[index];
    if (!know_dimension(reader, index, state->at)) return false;
    if (draft->start)
        state->initial = expr_value(draft->start) * (expr_is_bare(draft->start) ? draft->factor : 1);
    state->rate.at = draft->rate->at;
    state->rate.expr = compile_rate(reader, index, (struct expr_want){.dim = dim_over(state->dim, DIM_TIME)});
    return state->rate.expr != NULL;
}

bool own_states_read(struct reader *reader)
{
    bool fine = true;
    for (size_t i = 0; i < reader->scene->own_count; i++)
        if (!read_state(reader, i)) fine = false;
    return fine;
}
