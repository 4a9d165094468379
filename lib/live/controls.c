/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The elements of a file that can be changed by a slider or switched off, and their positions in the text:
 *
 * - parameters: {name, unit, value, low, high, description, input, derived, written} - initial: {name, unit,
 * value, written} of coordinates, rates and user states - masses, slopes: {name, unit, value, written} of a body,
 * with the direction of its slide - until, method, tolerance: {unit, value, written} -
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
#include "base/json.h"
#include "base/number.h"
#include "fbd_export.h"
#include "fbd_study.h"
#include "fbd_view.h"
#include "live/edits.h"
#include "live/live.h"

struct controls {
    const fbd_model *model;
    const char *source;
    size_t length; /* of the source */
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
        unsigned char byte = (unsigned char)controls->source[controls->at];
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
    const char *source = controls->source + span.from;
    fbd_unit unit;
    size_t length = span_length(span), i = 0;
    double value;
    while (i < length && strchr("+-.0123456789eE", source[i])) {
        bool exponent = source[i] == 'e' || source[i] == 'E';
        if (exponent && (i + 1 == length || !strchr("+-0123456789", source[i + 1]))) break;
        i++;
    }
    *digits = i;
    if (!number_read(source, i, &value)) return false;
    while (i < length && source[i] == ' ') i++;
    *factor = 1;
    if (i == length) return true;
    if (!fbd_unit_read(controls->model, source + i, length - i, &unit)) return false;
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

/* Write the position of a new pair `key` after the last one of a nonempty mapping. */
static void write_new_pair(struct controls *controls, int map, const char *key, const char *open,
                           const char *close)
{
    const struct edits edits = {.text = controls->source, .length = controls->length};
    struct text before = {0};
    size_t at;
    bool found = edits_new_pair(&edits, controls->spans, map, key, &before, &at);
    text_add(&before, open);
    if (found && !before.failed)
        write_gap(controls, at, before.data, close);
    else
        text_add(controls->text, "null");
    controls->text->failed |= before.failed;
    text_free(&before);
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
    text_add(controls->text, "\"parameters\":[");
    for (size_t i = 0; i < fbd_model_parameter_count(controls->model); i++) {
        const fbd_parameter parameter = fbd_model_parameter(controls->model, i);
        int map = spans_find(controls->spans, spans_root(controls->spans),
                             parameter.input ? "inputs" : "parameters");
        int value = spans_find(controls->spans, map, parameter.name);
        if (spans_is_map(controls->spans, value)) value = spans_find(controls->spans, value, "value");
        json_comma(controls->text, i);
        begin_value(controls, parameter.name, parameter.unit, parameter.value);
        json_number_member(controls->text, "low", parameter.low);
        json_number_member(controls->text, "high", parameter.high);
        json_text_member(controls->text, "description", parameter.description);
        text_json_flag(controls->text, "input", parameter.input, ",");
        text_json_flag(controls->text, "derived", parameter.derived, ",");
        json_key(controls->text, "written");
        write_place(controls, value);
        text_add(controls->text, "}");
    }
    text_add(controls->text, "],\n");
}

/* Write where the file has the initial value of a coordinate or rate, or may have it, for a body with that
 * mapping. */
static void write_start(struct controls *controls, const fbd_variable *variable, int map)
{
    const struct spans *spans = controls->spans;
    int initial = spans_find(spans, map, "initial"), value = spans_find(spans, initial, variable->name);
    if (value) {
        write_place(controls, value);
    } else if (!variable->start_free) {
        text_add(controls->text, "null");
    } else if (initial) {
        write_new_pair(controls, initial, variable->name, "", "");
    } else {
        struct text open = {0};
        text_printf(&open, "{%s: ", variable->name);
        write_new_pair(controls, map, "initial", open.data ? open.data : "", "}");
        controls->text->failed |= open.failed;
        text_free(&open);
    }
}

static void write_initial(struct controls *controls, const fbd_variable *variable)
{
    bool state = variable->kind == FBD_VARIABLE_STATE;
    int owners = spans_find(controls->spans, spans_root(controls->spans), state ? "states" : "bodies");
    struct text name = {0};
    text_printf(&name, "%s.%s", variable->owner, variable->name);
    begin_value(controls, name.data ? name.data : "", strcmp(variable->unit, "1") == 0 ? "" : variable->unit,
                variable->start);
    controls->text->failed |= name.failed;
    text_free(&name);
    json_key(controls->text, "written");
    if (state)
        write_place(controls, spans_find(controls->spans, spans_find(controls->spans, owners, variable->name),
                                         "initial"));
    else
        write_start(controls, variable, spans_find(controls->spans, owners, variable->owner));
    text_add(controls->text, "}");
}

/* Coordinates and rates, then user states. */
static void write_initials(struct controls *controls)
{
    size_t written = 0;
    text_add(controls->text, "\"initial\":[");
    for (size_t i = 0; i < fbd_model_variable_count(controls->model); i++) {
        const fbd_variable variable = fbd_model_variable(controls->model, i);
        if (variable.kind != FBD_VARIABLE_COORDINATE && variable.kind != FBD_VARIABLE_RATE &&
            variable.kind != FBD_VARIABLE_STATE)
            continue;
        json_comma(controls->text, written++);
        write_initial(controls, &variable);
    }
    text_add(controls->text, "],\n");
}

/* ---- masses and slopes, by which a scene is changed where it is drawn */

static void write_masses(struct controls *controls)
{
    const struct spans *spans = controls->spans;
    const int bodies = spans_find(spans, spans_root(spans), "bodies");
    text_add(controls->text, "\"masses\":[");
    for (size_t b = 0; b < fbd_model_body_count(controls->model); b++) {
        const char *body = fbd_model_body_name(controls->model, b);
        json_comma(controls->text, b);
        begin_value(controls, body, fbd_model_units(controls->model).mass,
                    fbd_model_inertia(controls->model, b).mass);
        json_key(controls->text, "written");
        write_place(controls, spans_find(spans, spans_find(spans, bodies, body), "mass"));
        text_add(controls->text, "}");
    }
    text_add(controls->text, "],\n");
}

/* The direction of a slide, in its own mapping or in that of the line of the ground that it names; 0 without one. */
static int slope_of(const struct controls *controls, const char *body)
{
    const struct spans *spans = controls->spans;
    const int root = spans_root(spans), map = spans_find(spans, spans_find(spans, root, "bodies"), body),
              slide = spans_find(spans, spans_find(spans, map, "motion"), "slide"),
              lines = spans_find(spans, spans_find(spans, root, "ground"), "lines");
    const struct span named = spans_inside(spans, spans_find(spans, slide, "line"));
    for (size_t i = 0; named.to > named.from && i < spans_count(spans, lines); i++) {
        const char *name = spans_key_name(spans, lines, i);
        if (name && strlen(name) == span_length(named) &&
            memcmp(name, controls->source + named.from, span_length(named)) == 0)
            return spans_find(spans, spans_find(spans, lines, name), "along");
    }
    return spans_find(spans, slide, "along");
}

static void write_slopes(struct controls *controls)
{
    size_t written = 0;
    text_add(controls->text, "\"slopes\":[");
    for (size_t b = 0; b < fbd_model_body_count(controls->model); b++) {
        const fbd_body body = fbd_model_body(controls->model, b);
        const int slope = body.motion == FBD_MOTION_SLIDE ? slope_of(controls, body.name) : 0;
        if (!slope) continue;
        json_comma(controls->text, written++);
        begin_value(controls, body.name, "rad", atan2(body.along[1], body.along[0]));
        json_key(controls->text, "written");
        write_place(controls, slope);
        text_add(controls->text, "}");
    }
    text_add(controls->text, "],\n");
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
    fbd_options file;
    fbd_model_options(controls->model, &file, sizeof file);
    write_of_run(controls, "until", "s", file.until);
    write_of_run(controls, "tolerance", "", file.tolerance > 0 ? file.tolerance : NAN);
    write_of_run(controls, "method", "", NAN);
    json_text_member(controls->text, "chosen", file.method ? file.method : "auto");
    text_json_flag(controls->text, "accuracy", file.accuracy > 0, ",");
    text_json_flag(controls->text, "step", file.step > 0, ",");
    text_add(controls->text, "\"methods\":[");
    for (size_t i = 0; i < fbd_method_count(); i++) {
        json_comma(controls->text, i);
        text_json_string(controls->text, fbd_method_get(i).name);
    }
    text_add(controls->text, "],\n");
}

static void write_effects(struct controls *controls)
{
    size_t count;
    struct live_effect *effects = live_effects(controls->model, controls->spans, &count);
    controls->text->failed |= !effects;
    text_add(controls->text, "\"effects\":[");
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
    size_t length;
    const char *source = fbd_model_source(model, &length);
    struct spans *spans = source ? spans_open(source, length) : NULL;
    if (spans) {
        struct controls controls = {model, source, length, spans, &text, 0, 0};
        text_add(&text, "{");
        write_parameters(&controls);
        write_initials(&controls);
        write_masses(&controls);
        write_slopes(&controls);
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
