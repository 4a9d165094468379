/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/extra.h"

#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "base/format.h"

/* ---- inputs that are set between steps */

fbd_model *extra_model(const fbd_model *model, fbd_errors *errors)
{
    size_t count = fbd_model_parameter_count(model), used = 0;
    fbd_callback *inputs = calloc(count + 1, sizeof *inputs);
    if (!inputs) {
        diag_out_of_memory(errors);
        return NULL;
    }
    for (size_t i = 0; i < count; i++) {
        const fbd_parameter parameter = fbd_model_parameter(model, i);
        if (parameter.input) inputs[used++] = (fbd_callback){.input = parameter.name};
    }
    fbd_model *with = fbd_model_with_callbacks(model, inputs, used, errors);
    free(inputs);
    return with;
}

/* ---- the list */

static void take_reason(struct extras *extras, fbd_errors *errors)
{
    const fbd_error *first = diag_first_error(errors);
    format_into(extras->why, sizeof extras->why, "%s", first ? first->message : "");
}

/* Count the indicators by a start, in a model as instances use it. */
static bool count_indicators(struct extras *extras, const fbd_model *model, fbd_errors *errors)
{
    const fbd_options options = {.size = sizeof options, .until = 1};
    fbd_model *with = extra_model(model, errors);
    fbd_state *state = with ? fbd_state_new(with) : NULL;
    if (with && !state) diag_out_of_memory(errors);
    fbd_exchange *exchange = state ? fbd_exchange_new(state, &options, errors) : NULL;
    if (exchange) extras->indicators = fbd_exchange_indicator_count(exchange);
    const bool made = exchange != NULL;
    fbd_exchange_free(exchange);
    fbd_state_free(state);
    fbd_model_free(with);
    return made;
}

/* Without model exchange the reason is kept. */
static bool try_exchange(struct extras *extras, const fbd_model *model)
{
    fbd_errors *errors = fbd_errors_new();
    extras->exchanges = errors && count_indicators(extras, model, errors);
    const bool whole = errors && !errors->out_of_memory;
    if (whole && !extras->exchanges) take_reason(extras, errors);
    fbd_errors_free(errors);
    return whole;
}

static void add(struct extras *extras, struct extra extra)
{
    extras->list[extras->count++] = extra;
}

/* Is one of the names separated by commas this one? */
static bool is_among(const char *names, const char *name)
{
    const size_t length = strlen(name);
    for (; names; names = strchr(names, ','), names += names != NULL)
        if (strncmp(names, name, length) == 0 && (names[length] == ',' || names[length] == '\0')) return true;
    return false;
}

/* Works are integrals that cost time: they are variables only as outputs. */
static void add_columns(struct extras *extras, const char *outputs)
{
    for (size_t i = 0; i < fbd_force_columns_count(extras->columns); i++) {
        const fbd_column_kind kind = fbd_force_columns_kind(extras->columns, i);
        const char *name = fbd_force_columns_name(extras->columns, i);
        const bool output = is_among(outputs, name);
        if (kind == FBD_COLUMN_WORK && !output) continue;
        add(extras, (struct extra){extra_column, kind, name, fbd_force_columns_unit(extras->columns, i), i, 0,
                                   output});
        extras->works |= kind == FBD_COLUMN_WORK;
    }
}

/* The rates of user states, by the names that the standard gives to derivatives. */
static void add_rates(struct extras *extras, const fbd_model *model)
{
    const size_t variables = fbd_model_variable_count(model);
    for (size_t i = 0, index = 0; i < variables; i++) {
        const fbd_variable variable = fbd_model_variable(model, i);
        if (variable.kind != FBD_VARIABLE_STATE) continue;
        const char *name = arena_printf(&extras->arena, "der(%s%s%s)", variable.owner,
                                        variable.owner[0] ? "." : "", variable.name);
        add(extras, (struct extra){extra_rate, FBD_COLUMN_FORCE, name,
                                   fbd_model_state(model, index).rate_unit, index, i, false});
        index++;
    }
}

static bool refuse_name(struct extras *extras, const char *name, size_t length, fbd_errors *errors)
{
    const size_t count = fbd_force_columns_count(extras->columns);
    const char **names = ARENA_ARRAY(&extras->arena, count + 1, const char *);
    const char *wrong = arena_text(&extras->arena, name, length);
    for (size_t i = 0; names && i < count; i++) names[i] = fbd_force_columns_name(extras->columns, i);
    if (names && wrong)
        diag_add(errors, FBD_ERROR, "unknown-output", (struct pos){0, 0},
                 diag_nearest(errors, wrong, names, count),
                 "no force, reaction, energy or work is called `%s`", wrong);
    else
        diag_out_of_memory(errors);
    return false;
}

static bool are_known(struct extras *extras, const char *names, fbd_errors *errors)
{
    while (names) {
        const char *comma = strchr(names, ',');
        const size_t length = comma ? (size_t)(comma - names) : strlen(names);
        bool known = false;
        for (size_t i = 0; !known && i < fbd_force_columns_count(extras->columns); i++) {
            const char *name = fbd_force_columns_name(extras->columns, i);
            known = strlen(name) == length && memcmp(name, names, length) == 0;
        }
        if (!known) return refuse_name(extras, names, length, errors);
        names = comma ? comma + 1 : NULL;
    }
    return true;
}

static void add_indicators(struct extras *extras)
{
    for (size_t i = 0; i < extras->indicators; i++)
        add(extras, (struct extra){extra_indicator, FBD_COLUMN_FORCE,
                                   arena_printf(&extras->arena, "indicator[%zu]", i + 1), "", i, 0, false});
}

static bool make_list(struct extras *extras, const fbd_model *model, const char *outputs)
{
    const size_t columns = fbd_force_columns_count(extras->columns), states = fbd_model_state_count(model);
    if (!try_exchange(extras, model)) return false;
    extras->list = ARENA_ARRAY(&extras->arena, columns + states + extras->indicators + 1, struct extra);
    if (!extras->list) return false;
    add_columns(extras, outputs);
    if (extras->works && extras->exchanges) {
        extras->exchanges = false;
        extras->indicators = 0;
        format_into(extras->why, sizeof extras->why, "%s",
                    "a work is an output, and the importer's steps have no works");
    }
    if (extras->exchanges) add_rates(extras, model);
    add_indicators(extras);
    return !extras->arena.failed;
}

bool extras_make(struct extras *extras, const fbd_model *model, const char *outputs, fbd_errors *errors)
{
    *extras = (struct extras){.columns = fbd_force_columns_new(model)};
    if (extras->columns && !are_known(extras, outputs, errors)) return false;
    if (extras->columns && make_list(extras, model, outputs)) return true;
    diag_out_of_memory(errors);
    return false;
}

void extras_free(struct extras *extras)
{
    fbd_force_columns_free(extras->columns);
    arena_free(&extras->arena);
    *extras = (struct extras){0};
}
