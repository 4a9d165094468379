/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The text of a model with a body pulled by hand: a spring and a damper from a point of the body to a place that
 * follows the path of a pointer, for a while. They are an `applied` force of the text, its path a table of it, so
 * that the run, the saved file and the input of fbd-run agree, and the ledger has the work of the hand under the
 * name of that force.
 *
 * On a slide of the ground the spring acts along the line: one that pulled across it would change the normal force,
 * and lift the body off. Derivations by hand and known solutions are those of the scene without the pull, and become
 * comments.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "base/number.h"
#include "fbd_export.h"
#include "fbd_view.h"
#include "live/edits.h"
#include "live/live.h"

struct pulling {
    const fbd_model *model;
    const fbd_pull *pull;
    const struct spans *spans;
    struct edits edits;
    fbd_body body;
    fbd_units units;
    char name[40]; /* of the force, its table and its point; not yet in the text */
    bool on_line;  /* along a slide of the ground */
    bool at_point; /* at a named point of the body, else at G */
    double damping;
    fbd_errors *errors;
};

/* ---- names */

static bool is_letter(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

static bool has_word(const struct edits *edits, const char *word)
{
    const size_t length = strlen(word);
    for (size_t at = 0; at + length <= edits->length; at++) {
        if (memcmp(edits->text + at, word, length) != 0) continue;
        bool begins = at == 0 || !is_letter(edits->text[at - 1]);
        if (begins && (at + length == edits->length || !is_letter(edits->text[at + length]))) return true;
    }
    return false;
}

/* True if the text has the name, or that of one of its tables. */
static bool is_taken(const struct edits *edits, const char *name)
{
    char tables[2][44];
    for (size_t axis = 0; axis < 2; axis++)
        snprintf(tables[axis], sizeof tables[axis], "%s_%c", name, "xy"[axis]);
    return has_word(edits, name) || has_word(edits, tables[0]) || has_word(edits, tables[1]);
}

/* `pull`, or `pull_2`, `pull_3`, ... after earlier ones. */
static void choose_name(struct pulling *pulling)
{
    strcpy(pulling->name, "pull");
    for (unsigned i = 2; is_taken(&pulling->edits, pulling->name); i++)
        snprintf(pulling->name, sizeof pulling->name, "pull_%u", i);
}

/* ---- the force */

/* (K (pull_x(t) - x) - C v) while the hand pulls. */
static void write_law(struct text *text, const struct pulling *pulling, char axis, const char *position,
                      const char *velocity)
{
    const fbd_pull *pull = pulling->pull;
    const fbd_units *units = &pulling->units;
    text_printf(text, "\"pulse(t, %.9g[s], %.9g[s])*(%.4g[%s/%s]*(%s_%c(t) - %s)", pull->from,
                pull->to - pull->from, pull->stiffness, units->force, units->length, pulling->name, axis,
                position);
    if (pulling->damping > 0)
        text_printf(text, " - %.4g[%s*s/%s]*%s", pulling->damping, units->force, units->length, velocity);
    text_add(text, ")\"");
}

static void write_component(struct text *text, const struct pulling *pulling, char axis)
{
    struct text position = {0}, velocity = {0};
    const char *point = pulling->at_point ? pulling->name : "G";
    text_printf(&position, "%s.%s.%c", pulling->body.name, point, axis);
    text_printf(&velocity, "%s.%s.v%c", pulling->body.name, point, axis);
    text->failed |= position.failed || velocity.failed;
    if (!text->failed) write_law(text, pulling, axis, position.data, velocity.data);
    text_free(&position);
    text_free(&velocity);
}

static void write_force(struct text *text, const struct pulling *pulling)
{
    text_printf(text, "applied: {name: %s, ", pulling->name);
    if (pulling->on_line) {
        text_add(text, "value: ");
        write_law(text, pulling, 'x', "x", "v");
    } else {
        if (pulling->at_point) text_printf(text, "at: %s, ", pulling->name);
        text_add(text, "fx: ");
        write_component(text, pulling, 'x');
        text_add(text, ", fy: ");
        write_component(text, pulling, 'y');
    }
    text_add(text, "}");
}

/* ---- the path */

/* The coordinate of the pointer that the spring follows: along the line of a slide, where the grabbed point of the
 * body is `offset` before its x. */
static double follows(const struct pulling *pulling, const double *sample, int axis)
{
    const fbd_body *body = &pulling->body;
    if (!pulling->on_line) return sample[1 + axis];
    const double *at = pulling->pull->at, dx = sample[1] - body->joint[0], dy = sample[2] - body->joint[1];
    return dx * body->along[0] + dy * body->along[1] - (at[0] - body->pin[0]);
}

/* A table of the coordinate by the time, smooth and without overshoot, each point later than the one before as it is written; it holds its last
 * value to the end of the pull, and has two points at least. */
static void write_path(struct text *text, const struct pulling *pulling, int axis)
{
    const fbd_pull *pull = pulling->pull;
    double last = -INFINITY, value = 0;
    text_add(text, "{interpolation: steffen, points: [");
    for (size_t i = 0; i <= pull->count; i++) {
        struct text time = {0};
        double written = last;
        text_printf(&time, "%.9g", i < pull->count ? pull->path[3 * i] : pull->to);
        text->failed |= time.failed;
        if (!time.failed) number_read(time.data, time.length, &written);
        if (i < pull->count) value = follows(pulling, pull->path + 3 * i, axis);
        if (written > last)
            text_printf(text, "%s[%s s, %.6g %s]", i > 0 ? ", " : "", time.data, value,
                        pulling->units.length);
        last = written;
        text_free(&time);
    }
    text_add(text, "]}");
}

/* ---- where they are put */

static bool refuse(struct pulling *pulling, const char *hint, const char *why)
{
    diag_add(pulling->errors, FBD_ERROR, "not-pulled", (struct pos){pulling->body.line, pulling->body.column},
             hint, "`%.80s` cannot be pulled: %s", pulling->body.name, why);
    return false;
}

static bool refuse_layout(struct pulling *pulling, const char *key)
{
    return refuse(pulling, "write it there itself, as a list in brackets or of lines with `-`",
                  diag_hint(pulling->errors, "the text has no place for a new entry of `%s`", key));
}

struct pair {
    struct text name, value;
};

/* Add pairs to the mapping under `key` of `map`, or that mapping with them. */
static bool add_pairs(struct pulling *pulling, int map, const char *key, struct pair *pairs, size_t count)
{
    struct edits *edits = &pulling->edits;
    int found = spans_find(pulling->spans, map, key);
    struct text text = {0};
    size_t at = 0;
    bool placed = found || edits_new_pair(edits, pulling->spans, map, key, &text, &at);
    for (size_t i = 0; i < count && placed; i++) {
        struct pair *pair = &pairs[i];
        text.failed |= pair->name.failed || pair->value.failed;
        if (text.failed) break;
        if (found)
            placed = edits_new_pair(edits, pulling->spans, found, pair->name.data, &text, &at);
        else
            text_printf(&text, "%s%s: ", i > 0 ? ", " : "{", pair->name.data);
        text_add(&text, pair->value.data);
    }
    if (!found) text_add(&text, "}");
    edits->failed |= text.failed;
    if (placed && !text.failed) edits_replace(edits, at, at, text.data);
    text_free(&text);
    for (size_t i = 0; i < count; i++) {
        text_free(&pairs[i].name);
        text_free(&pairs[i].value);
    }
    return placed || refuse_layout(pulling, key);
}

/* Behind the last entry of a list. */
static void add_entry(struct pulling *pulling, int list, const char *force)
{
    struct edits *edits = &pulling->edits;
    const size_t count = spans_count(pulling->spans, list);
    struct text text = {0};
    struct span last = spans_of(pulling->spans, spans_item(pulling->spans, list, count - 1));
    size_t at = last.to;
    if (spans_is_flow(pulling->spans, list)) {
        text_printf(&text, ", %s", force);
    } else {
        size_t dash = edits_dash(edits, spans_of(pulling->spans, spans_item(pulling->spans, list, 0)).from),
               line = dash;
        while (line > 0 && edits->text[line - 1] != '\n') line--;
        const char *end = memchr(edits->text + at, '\n', edits->length - at);
        at = end ? (size_t)(end - edits->text) : edits->length;
        text_printf(&text, "\n%*s- %s", (int)(dash - line), "", force);
    }
    edits->failed |= text.failed;
    if (!text.failed) edits_replace(edits, at, at, text.data);
    text_free(&text);
}

static bool add_force(struct pulling *pulling, int map, const char *force)
{
    const struct spans *spans = pulling->spans;
    int list = spans_find(spans, map, "forces");
    struct span span = spans_of(spans, list);
    struct text text = {0};
    size_t at;
    if (!list) {
        bool placed = edits_new_pair(&pulling->edits, spans, map, "forces", &text, &at);
        text_printf(&text, "[%s]", force);
        pulling->edits.failed |= text.failed;
        if (placed && !text.failed) edits_replace(&pulling->edits, at, at, text.data);
        text_free(&text);
        return placed || refuse_layout(pulling, "forces");
    }
    if (span.from < spans_key(spans, map, "forces").to)
        return refuse_layout(pulling, "forces"); /* an alias */
    if (spans_is_list(spans, list) && spans_count(spans, list) > 0) {
        add_entry(pulling, list, force);
        return true;
    }
    if (spans_is_map(spans, list) && !spans_is_flow(spans, list)) return refuse_layout(pulling, "forces");
    if (spans_is_list(spans, list)) { /* an empty one */
        text_printf(&text, "[%s]", force);
        at = span.from;
    } else { /* a single entry */
        text_printf(&text, ", %s]", force);
        edits_replace(&pulling->edits, span.from, span.from, "[");
        at = span.to;
    }
    pulling->edits.failed |= text.failed;
    if (!text.failed) edits_replace(&pulling->edits, at, span.to, text.data);
    text_free(&text);
    return true;
}

/* Derivations and solutions hold for the scene without the pull only. */
static void remove_known(struct pulling *pulling, int bodies)
{
    static const char *const keys[] = {"hand", "exact"};
    for (size_t i = 0; i < spans_count(pulling->spans, bodies); i++) {
        const char *name = spans_key_name(pulling->spans, bodies, i);
        int map = name ? spans_find(pulling->spans, bodies, name) : 0;
        for (size_t k = 0; k < sizeof keys / sizeof *keys; k++)
            edits_remove_pair(&pulling->edits, pulling->spans, map, keys[k]);
    }
}

static bool is_driven(const struct pulling *pulling, int map)
{
    static const char *const joints[] = {"slide", "track", "pivot"}, *const names[] = {"x", "s", "theta"};
    int motion = spans_find(pulling->spans, map, "motion");
    for (size_t i = 0; i < sizeof joints / sizeof *joints; i++)
        if (spans_find(pulling->spans, spans_find(pulling->spans, motion, joints[i]), names[i])) return true;
    return false;
}

static bool place_force(struct pulling *pulling, int map)
{
    struct text force = {0};
    write_force(&force, pulling);
    pulling->edits.failed |= force.failed;
    bool placed = !force.failed && add_force(pulling, map, force.data);
    text_free(&force);
    return placed;
}

static bool place_point(struct pulling *pulling, int map)
{
    struct pair point = {0};
    text_add(&point.name, pulling->name);
    text_printf(&point.value, "[%.6g, %.6g]", pulling->pull->at[0], pulling->pull->at[1]);
    return add_pairs(pulling, map, "points", &point, 1);
}

static bool place_path(struct pulling *pulling)
{
    struct pair paths[2] = {0};
    const size_t count = pulling->on_line ? 1 : 2;
    for (size_t axis = 0; axis < count; axis++) {
        text_printf(&paths[axis].name, "%s_%c", pulling->name, "xy"[axis]);
        write_path(&paths[axis].value, pulling, (int)axis);
    }
    return add_pairs(pulling, spans_root(pulling->spans), "tables", paths, count);
}

static bool place_all(struct pulling *pulling)
{
    const struct spans *spans = pulling->spans;
    int bodies = spans_find(spans, spans_root(spans), "bodies"),
        map = spans_find(spans, bodies, pulling->body.name);
    if (is_driven(pulling, map)) return refuse(pulling, "pull another body", "its motion is prescribed");
    if (spans_of(spans, map).from < spans_key(spans, bodies, pulling->body.name).to)
        return refuse(pulling, "write its mapping there itself",
                      "the text has it as an alias of another body");
    bool placed =
        place_force(pulling, map) && (!pulling->at_point || place_point(pulling, map)) && place_path(pulling);
    if (placed)
        remove_known(pulling, bodies); /* after insertions at the place from which a pair is cut out */
    return placed;
}

/* ---- the pull */

static bool find_body(struct pulling *pulling)
{
    const fbd_model *model = pulling->model;
    const size_t count = fbd_model_body_count(model);
    const char **names = calloc(count + 1, sizeof *names);
    for (size_t b = 0; b < count; b++) {
        pulling->body = fbd_model_body(model, b);
        if (strcmp(pulling->body.name, pulling->pull->body) == 0) {
            free(names);
            return true;
        }
        if (names) names[b] = pulling->body.name;
    }
    diag_add(pulling->errors, FBD_ERROR, "unknown-body", (struct pos){0, 0},
             names ? diag_nearest(pulling->errors, pulling->pull->body, names, count) : NULL,
             "the file has no body `%.80s`", pulling->pull->body);
    free(names);
    return false;
}

static char *write_pulled(const fbd_model *model, const fbd_pull *pull, fbd_errors *errors)
{
    struct pulling pulling = {.model = model,
                              .pull = pull,
                              .errors = errors,
                              .units = fbd_model_units(model)};
    if (!find_body(&pulling)) return NULL;
    const fbd_body *body = &pulling.body;
    struct text text = {0};
    pulling.edits.text = fbd_model_source(model, &pulling.edits.length);
    struct spans *spans = spans_open(pulling.edits.text, pulling.edits.length);
    pulling.spans = spans;
    pulling.on_line = body->motion == FBD_MOTION_SLIDE && body->carrier == FBD_GROUND;
    pulling.at_point = body->motion == FBD_MOTION_PIVOT || body->motion == FBD_MOTION_PLANAR ||
                       body->motion == FBD_MOTION_WELD;
    pulling.damping = sqrt(pull->stiffness * body->inertia.mass); /* half of critical for this mass alone */
    choose_name(&pulling);
    bool placed = spans && place_all(&pulling);
    if (placed) edits_apply(&text, &pulling.edits);
    if (!spans || pulling.edits.failed || text.failed) diag_out_of_memory(errors);
    if (!placed || text.failed) text_free(&text);
    edits_free(&pulling.edits);
    spans_close(spans);
    return text.data;
}

/* The path begins with the pull, and its times grow. */
static bool is_pull(const fbd_pull *pull)
{
    bool fine = pull->body && pull->path && pull->count > 0 && pull->stiffness > 0 &&
                isfinite(pull->stiffness) && isfinite(pull->at[0]) && isfinite(pull->at[1]) &&
                pull->from >= 0 && pull->to > pull->from && isfinite(pull->to);
    for (size_t i = 0; fine && i < pull->count; i++) {
        const double *sample = pull->path + 3 * i;
        fine = isfinite(sample[0] + sample[1] + sample[2]) && (i == 0 || sample[0] >= sample[-3]);
    }
    return fine;
}

char *fbd_model_pulled(const fbd_model *model, const fbd_pull *pull, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_pull own = {0};
    char *text = NULL;
    if (!model || !pull) {
        api_refuse(errors, "there is no model, or no pull");
    } else if (api_take_options(&own, sizeof own, pull, errors)) {
        diag_in_file(errors, fbd_model_file(model));
        if (is_pull(&own))
            text = write_pulled(model, &own, errors);
        else
            api_refuse(errors,
                       "a pull needs a body, a stiffness above 0, a time and a path whose times grow");
    }
    diag_end(&call);
    return text;
}
