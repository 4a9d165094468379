/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The elements of a file that can be changed by a slider or switched off, and their positions in the text:
 *
 * - parameters: {name, unit, value, low, high, description, input, derived, written} - initial: {name, unit,
 * value, written} of coordinates, rates and user states - until, method, tolerance: {unit, value, written} -
 * effects: {name, line} - methods: their names
 *
 * written: {from, to} of the text in UTF-16 units, as scripts count; with `number` and `factor` if it is a
 * number with a unit (value = factor * number), otherwise the file has an expression or a word there. Without
 * `to` the value is not written yet: it is to be inserted at `from` between the texts `before` and `behind`.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "draw/page_json.h"
#include "expr/unit.h"
#include "fbd_export.h"
#include "integrate/method.h"
#include "live/live.h"

struct controls {
    const struct fbd_model *model;
    const struct spans *spans;
    struct text *text;
    size_t at, units; /* bytes from the start, and the equivalent number of UTF-16 units */
};

/* The number of UTF-16 units before a byte; continues from the last position, since calls are mostly in
 * ascending order. */
static size_t units_before(struct controls *controls, size_t at)
{
    if (at < controls->at) controls->at = controls->units = 0;
    for (; controls->at < at; controls->at++) {
        unsigned char byte = (unsigned char)controls->model->source[controls->at];
        if ((byte & 0xC0) != 0x80) controls->units += byte >= 0xF0 ? 2 : 1;
    }
    return controls->units;
}

/* ---- existing values */

static size_t span_length(struct span span)
{
    return span.to - span.from;
}

/* True for a number, with or without a unit of the table. */
static bool is_quantity(struct controls *controls, struct span span, size_t *digits, double *factor)
{
    const char *source = controls->model->source + span.from;
    struct unit unit = {.factor = 1};
    size_t length = span_length(span), i = 0;
    char number[40], *end;
    while (i < length && i + 1 < sizeof number && strchr("+-.0123456789eE", source[i])) {
        bool exponent = source[i] == 'e' || source[i] == 'E';
        if (exponent && (i + 1 == length || !strchr("+-0123456789", source[i + 1]))) break;
        number[i] = source[i];
        i++;
    }
    number[i] = '\0';
    *digits = i;
    if (i == 0 || !isfinite(strtod(number, &end)) || *end) return false;
    while (i < length && source[i] == ' ') i++;
    *factor = 1;
    if (i == length) return true;
    struct pos nowhere = {0, 0};
    if (!unit_parse(source + i, length - i, controls->model->scene->units, NULL, nowhere, &unit))
        return false;
    *factor = unit.factor;
    return true;
}

static void write_place(struct controls *controls, int value)
{
    struct span span = spans_inside(controls->spans, value);
    struct text *text = controls->text;
    size_t digits;
    double factor;
    bool plain = spans_is_plain(controls->spans, value);
    if (!plain || span.to == span.from) {
        text_add(text, "null");
        return;
    }
    text_printf(text, "{\"from\":%zu,", units_before(controls, span.from));
    if (is_quantity(controls, span, &digits, &factor)) {
        text_printf(text, "\"number\":%zu,", digits);
        json_number_member(text, "factor", factor);
    }
    text_printf(text, "\"to\":%zu}", units_before(controls, span.to));
}

/* Write the position `from` of a missing value, and the texts around it. */
static void write_gap(struct controls *controls, size_t from, const char *before, const char *behind)
{
    text_printf(controls->text, "{\"from\":%zu,", units_before(controls, from));
    json_text_member(controls->text, "before", before);
    json_key(controls->text, "behind");
    text_json_string(controls->text, behind);
    text_add(controls->text, "}");
}

/* The blanks before the first character of a line; NULL if `at` is not the first one. */
static char *indent_of(const struct controls *controls, size_t at)
{
    const char *source = controls->model->source;
    size_t start = at;
    while (start > 0 && source[start - 1] == ' ') start--;
    if (start > 0 && source[start - 1] != '\n') return NULL;
    char *indent = malloc(at - start + 1);
    if (!indent) return NULL;
    memset(indent, ' ', at - start);
    indent[at - start] = '\0';
    return indent;
}

/* Write the position of a new pair `key` after the last one of a nonempty mapping. */
static void write_new_pair(struct controls *controls, int map, const char *key, const char *open,
                           const char *close)
{
    const struct spans *spans = controls->spans;
    size_t count = spans_count(spans, map);
    const char *last = count > 0 ? spans_key_name(spans, map, count - 1) : NULL;
    struct span value = last ? spans_of(spans, spans_find(spans, map, last)) : (struct span){0, 0};
    struct span name = last ? spans_key(spans, map, last) : value;
    bool flow = spans_is_flow(spans, map);
    char *indent = last && !flow ? indent_of(controls, name.from) : NULL;
    struct text before = {0};
    size_t at = value.to;
    if (flow)
        text_printf(&before, ", %s: %s", key, open);
    else if (indent)
        text_printf(&before, "\n%s%s: %s", indent, key, open);
    if (indent) { /* after a comment on that line */
        const char *end = memchr(controls->model->source + at, '\n', controls->model->source_length - at);
        at = end ? (size_t)(end - controls->model->source) : controls->model->source_length;
    }
    if (before.data && !before.failed && value.to > name.to)
        write_gap(controls, at, before.data, close);
    else
        text_add(controls->text, "null");
    controls->text->failed |= before.failed;
    text_free(&before);
    free(indent);
}

/* ---- numbers */

static void begin_value(struct controls *controls, const char *name, const char *unit, double value)
{
    text_add(controls->text, "\n{");
    json_text_member(controls->text, "name", name);
    json_text_member(controls->text, "unit", unit);
    json_number_member(controls->text, "value", value);
}

static void write_parameters(struct controls *controls)
{
    const struct scene *scene = controls->model->scene;
    text_add(controls->text, "\"parameters\":[");
    for (size_t i = 0; i < scene->parameter_count; i++) {
        const struct parameter *parameter = &scene->parameters[i];
        int map = spans_find(controls->spans, spans_root(controls->spans),
                             parameter->input ? "inputs" : "parameters");
        int value = spans_find(controls->spans, map, parameter->name);
        if (spans_is_map(controls->spans, value)) value = spans_find(controls->spans, value, "value");
        json_comma(controls->text, i);
        begin_value(controls, parameter->name, parameter->unit, parameter->value);
        json_number_member(controls->text, "low", parameter->low);
        json_number_member(controls->text, "high", parameter->high);
        json_text_member(controls->text, "description", parameter->description);
        text_json_flag(controls->text, "input", parameter->input, ",");
        text_json_flag(controls->text, "derived", parameter->derived, ",");
        json_key(controls->text, "written");
        write_place(controls, value);
        text_add(controls->text, "}");
    }
    text_add(controls->text, "],\n");
}

/* True if initial values may be added that the file does not give. */
static bool starts_freely(const struct body *body)
{
    return !body->assemble && body->motion.kind != motion_track && !body->motion.prescribed.expr;
}

static void write_start(struct controls *controls, const struct body *body, int map, const char *name)
{
    const struct spans *spans = controls->spans;
    int initial = spans_find(spans, map, "initial"), value = spans_find(spans, initial, name);
    json_key(controls->text, "written");
    if (value) {
        write_place(controls, value);
    } else if (!starts_freely(body)) {
        text_add(controls->text, "null");
    } else if (initial) {
        write_new_pair(controls, initial, name, "", "");
    } else {
        struct text open = {0};
        text_printf(&open, "{%s: ", name);
        write_new_pair(controls, map, "initial", open.data ? open.data : "", "}");
        controls->text->failed |= open.failed;
        text_free(&open);
    }
    text_add(controls->text, "}");
}

static void write_coordinates(struct controls *controls, bool *first)
{
    const struct scene *scene = controls->model->scene;
    int bodies = spans_find(controls->spans, spans_root(controls->spans), "bodies");
    for (size_t i = 0; i < scene->coordinate_count; i++) {
        const struct coordinate *coordinate = &scene->coordinates[i];
        const struct label *label = &controls->model->labels[i];
        const struct body *body = &scene->bodies[coordinate->body];
        int map = spans_find(controls->spans, bodies, body->name);
        json_comma(controls->text, !*first);
        *first = false;
        begin_value(controls, label->name, label->unit, coordinate->initial);
        write_start(controls, body, map, coordinate->name);
        json_comma(controls->text, 1);
        begin_value(controls, label->rate_name, label->rate_unit, coordinate->initial_rate);
        write_start(controls, body, map, coordinate->rate_name);
    }
}

static void write_own_states(struct controls *controls, bool *first)
{
    const struct scene *scene = controls->model->scene;
    int states = spans_find(controls->spans, spans_root(controls->spans), "states");
    for (size_t i = 0; i < scene->own_count; i++) {
        const struct own_label *label = &controls->model->own_labels[i];
        int map = spans_find(controls->spans, states, scene->own[i].name),
            value = spans_find(controls->spans, map, "initial");
        json_comma(controls->text, !*first);
        *first = false;
        begin_value(controls, label->name, strcmp(label->unit, "1") == 0 ? "" : label->unit,
                    scene->own[i].initial);
        json_key(controls->text, "written");
        write_place(controls, value);
        text_add(controls->text, "}");
    }
}

/* ---- the run */

static void write_of_run(struct controls *controls, const char *key, const char *unit, double value)
{
    int simulate = spans_find(controls->spans, spans_root(controls->spans), "simulate"),
        written = spans_find(controls->spans, simulate, key);
    json_key(controls->text, key);
    begin_value(controls, key, unit, value);
    json_key(controls->text, "written");
    if (written)
        write_place(controls, written);
    else
        write_new_pair(controls, simulate, key, "", "");
    text_add(controls->text, "},");
}

static void write_run(struct controls *controls)
{
    const struct simulate *simulate = &controls->model->scene->simulate;
    const struct expr *until = simulate->until.expr;
    bool constant = until && expr_is_constant(until);
    write_of_run(controls, "until", "s", constant ? expr_value(until) : NAN);
    write_of_run(controls, "tolerance", "", simulate->tolerance > 0 ? simulate->tolerance : NAN);
    write_of_run(controls, "method", "", NAN);
    json_text_member(controls->text, "chosen", simulate->method ? simulate->method : "auto");
    text_json_flag(controls->text, "accuracy", simulate->accuracy > 0, ",");
    text_json_flag(controls->text, "step", simulate->step > 0, ",");
    text_add(controls->text, "\"methods\":[");
    for (size_t i = 0; method_at(i); i++) {
        json_comma(controls->text, i);
        text_json_string(controls->text, method_at(i)->name);
    }
    text_add(controls->text, "],\n");
}

static void write_effects(struct controls *controls)
{
    size_t count = live_effects(controls->model, controls->spans, NULL, 0);
    struct live_effect *effects = calloc(count + 1, sizeof *effects);
    controls->text->failed |= !effects;
    text_add(controls->text, "\"effects\":[");
    if (effects) live_effects(controls->model, controls->spans, effects, count);
    for (size_t i = 0; effects && i < count; i++) {
        int list = spans_find(controls->spans, effects[i].owner, effects[i].key), line, column;
        spans_place(controls->spans, spans_item(controls->spans, list, effects[i].index), &line, &column);
        json_comma(controls->text, i);
        text_add(controls->text, "\n{");
        json_text_member(controls->text, "body", effects[i].body ? effects[i].body : "");
        json_text_member(controls->text, "name", effects[i].name);
        text_printf(controls->text, "\"line\":%d}", line);
    }
    text_add(controls->text, "]}");
    free(effects);
}

char *fbd_model_controls(const fbd_model *model, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    struct text text = {0};
    struct spans *spans = model ? spans_open(model->source, model->source_length) : NULL;
    if (spans) {
        struct controls controls = {model, spans, &text, 0, 0};
        bool first = true;
        text_add(&text, "{");
        write_parameters(&controls);
        text_add(&text, "\"initial\":[");
        write_coordinates(&controls, &first);
        write_own_states(&controls, &first);
        text_add(&text, "],\n");
        write_run(&controls);
        write_effects(&controls);
    }
    if (!model)
        api_refuse(errors, "there is no model");
    else if (!spans || text.failed)
        diag_out_of_memory(errors);
    if (text.failed) text_free(&text);
    spans_close(spans);
    diag_end(&call);
    return text.data;
}
