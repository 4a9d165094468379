/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Tracks: a curve, x and y as expressions of its parameter p (or y of x), and the initial position of the
 * body on it.
 */
#include "expr/curve.h"

#include "scene/fields.h"
#include "scene/reader.h"
#include "scene/values.h"

#include <string.h>

/* The scope of a curve: constants, tables, and the parameter of the curve. */
struct track_names {
    struct names names; /* first member: values.c uses it as struct names */
    struct scope constants;
    const char *parameter;
    struct dim dim;
};

static struct symbol look_up(void *context, const char *name, struct pos at)
{
    struct track_names *track = context;
    if (strcmp(name, track->parameter) == 0) {
        size_t parameter;
        if (parameters_find(track->names.reader, name, &parameter))
            return two_meanings(track->names.reader, name, "the variable of the curve", at);
        return (struct symbol){.kind = symbol_variable, .dim = track->dim, .slot = 1};
    }
    return track->constants.lookup(&track->names, name, at);
}

static struct track_names names_of(struct reader *reader, int body, const char *parameter, struct dim dim)
{
    struct track_names track = {
        .names = {.reader = reader, .place = place_constant, .body = body, .curve = parameter},
        .parameter = parameter,
        .dim = dim};
    track.constants = names_scope(&track.names);
    return track;
}

/* ---- the range */

/* Read a constant of any dimension, or of the given one. */
static bool read_bound(struct reader *reader, const struct node *node, const char *key, const struct dim *dim,
                       double *value, struct dim *own, bool *bare)
{
    struct expr_want want = {.any_dim = dim == NULL, .constant = true, .what = key};
    if (dim) want.dim = *dim;
    const struct expr *expr = value_compile(reader, node, &want, &reader->constants);
    if (!expr) return false;
    *value = expr_value(expr);
    *own = expr_dim(expr);
    *bare = expr_is_bare(expr);
    return true;
}

/* The range must be representable: large enough to be divided, and its square neither zero nor infinite. */
static bool check_range(struct reader *reader, const struct node *to, double from, double end)
{
    const double share = 1e-9, least = 1e-100, most = 1e100;
    double range = end - from;
    if (range >= fmax(share * fmax(fabs(from), fabs(end)), least) && range <= most) return true;
    if (from < end)
        diag_add(reader->errors, FBD_ERROR, "out-of-range", to->at,
                 "choose a parameter of ordinary size, such as x or an angle",
                 "the range from `from` to `to` is too %s for numbers", range > most ? "long" : "short");
    else
        diag_add(reader->errors, FBD_ERROR, "out-of-range", to->at, "let the parameter grow along the track",
                 "`to` must be above `from`");
    return false;
}

/* Read the range and the dimension of the parameter, which is that of its ends. Bare numbers are lengths in
 * y(x). */
static bool read_range(struct reader *reader, const struct curve_keys *keys, struct curve *curve,
                       struct dim *dim)
{
    const struct dim length = DIM_LENGTH;
    const struct dim *known = keys->x ? NULL : &length;
    struct dim first, second;
    bool bare[2];
    if (!read_bound(reader, keys->from, "from", known, &curve->from, &first, &bare[0])) return false;
    if (!known && !bare[0]) known = &first;
    if (!read_bound(reader, keys->to, "to", known, &curve->to, &second, &bare[1])) return false;
    *dim = bare[0] && bare[1] && keys->x ? DIM_NONE : bare[0] ? second : first;
    if (!keys->x) *dim = length;
    return check_range(reader, keys->to, curve->from, curve->to);
}

/* ---- the formulas */

static const struct expr *read_formula(struct reader *reader, const struct node *node, const char *key,
                                       const char *what, struct track_names *track)
{
    struct scope scope = track->constants;
    struct value value;
    scope.lookup = look_up;
    scope.context = track;
    if (!value_formula(reader, node, key, a_length, 0, &scope, &value)) return NULL;
    if (!expr_is_constant(value.expr) && expr_uses_time(value.expr)) {
        diag_add(reader->errors, FBD_ERROR, "not-here", node->at,
                 diag_hint(reader->errors,
                           "write it as an expression of `%s`; %s that moves lies on a body that does",
                           track->parameter, what),
                 "the `%s` of %s may depend on its parameter `%s` only", key, what, track->parameter);
        return NULL;
    }
    return value.expr;
}

/* y(x): the parameter itself. */
static const struct expr *parameter_itself(struct reader *reader, struct track_names *track, struct pos at)
{
    const struct expr_want want = {.dim = DIM_LENGTH, .what = "x"};
    struct scope scope = track->constants;
    scope.lookup = look_up;
    scope.context = track;
    return expr_compile(reader->arena, "x", at, &scope, &want, reader->errors);
}

static void note_fault(struct reader *reader, const struct curve_keys *keys, const struct curve *curve,
                       enum curve_fault fault, double p)
{
    static const char *const faults[][2] = {
        [curve_not_finite] = {"has no finite place, direction or curvature",
                              "end it before, or write it otherwise"},
        [curve_stands_still] = {"stands still: it has no direction there, as at a cusp",
                                "end it before, or choose a parameter that does not rest there"},
        [curve_corner] = {"has a corner, which requires an unbounded force",
                          "round it off; of a table take `interpolation: cubic`"},
        [curve_jump] = {"is torn", "let its parts meet"},
        [curve_rough] = {"has a derivative that is infinite",
                         "end it before, or choose another parameter, as the angle for a circle"},
        [curve_intricate] = {"has more pieces than can be followed", "take fewer points or periods"},
        [curve_open] = {"is `closed`, and does not come back to where it begins", "let its ends meet"},
        [curve_bent] = {"is `closed`, and its ends meet at an angle", "round it off"},
    };
    double range = curve->to - curve->from;
    if (fault == curve_no_memory) {
        reader->arena->failed = true;
        return;
    }
    diag_add(reader->errors, FBD_ERROR, "bad-track", keys->y->at, faults[fault][1], "%s %s, at %s = %.6g",
             keys->name, faults[fault][0], keys->x ? "p" : "x", fabs(p) < 1e-8 * range ? 0 : p);
}

const struct curve *curve_read(struct reader *reader, const struct curve_keys *keys)
{
    struct curve *curve = ARENA_ARRAY(reader->arena, 1, struct curve);
    struct dim dim;
    if (!curve || !read_range(reader, keys, curve, &dim)) return NULL;
    struct track_names track = names_of(reader, keys->body, keys->x ? "p" : "x", dim);
    curve->closed = keys->closed;
    curve->x = keys->x ? read_formula(reader, keys->x, "x", keys->what, &track)
                       : parameter_itself(reader, &track, keys->y->at);
    curve->y = read_formula(reader, keys->y, "y", keys->what, &track);
    if (!curve->x || !curve->y) return NULL;
    double place = 0;
    enum curve_fault fault = curve_make(curve, reader->arena, keys->label, &place);
    if (fault == curve_made) return curve;
    note_fault(reader, keys, curve, fault, place);
    return NULL;
}

static struct curve_keys keys_of(const struct motion_keys *keys, int index)
{
    return (struct curve_keys){.x = keys->x,
                               .y = keys->y,
                               .from = keys->from,
                               .to = keys->to,
                               .closed = keys->closed,
                               .body = index,
                               .what = "a track"};
}

bool track_read(struct reader *reader, int index)
{
    struct motion *motion = &reader->scene->bodies[index].motion;
    const struct motion_keys *keys = &reader->drafts[index].motion_keys;
    struct curve_keys own = keys_of(keys, index);
    if (!keys->y || !keys->from || !keys->to) return false;
    own.label = reader->scene->bodies[index].name;
    own.name = arena_printf(reader->arena, "the track of `%s`", own.label);
    motion->curve = own.name ? curve_read(reader, &own) : NULL;
    motion->turns = keys->turn;
    return motion->curve != NULL;
}

/* ---- initial position */

/* Read an initial value of the parameter, in the dimension of the range. */
static bool read_parameter(struct reader *reader, int index, const struct node *node, const char *key,
                           double *s)
{
    const struct curve *curve = reader->scene->bodies[index].motion.curve;
    const struct curve_keys keys = keys_of(&reader->drafts[index].motion_keys, index);
    struct curve range;
    struct dim dim, own;
    double p;
    bool bare;
    if (!read_range(reader, &keys, &range, &dim)) return false;
    if (!read_bound(reader, node, key, &dim, &p, &own, &bare)) return false;
    if (p >= curve->from && p <= curve->to) {
        *s = curve_length_at(curve, p);
        return true;
    }
    diag_add(reader->errors, FBD_ERROR, "out-of-range", node->at, "it starts on its track, or not at all",
             "`%s` is not between `from` and `to` of the track", key);
    return false;
}

bool track_initial_read(struct reader *reader, int index, struct initial_keys *keys)
{
    const struct curve *curve = reader->scene->bodies[index].motion.curve;
    const struct node *node = reader->drafts[index].keys.initial;
    const struct node *place = keys->p ? keys->p : keys->x;
    const char *key = keys->p ? "p" : "x", *known = reader->drafts[index].motion_keys.x ? "p" : "x";
    if (!curve) return true; /* noted before */
    if (place && strcmp(key, known) != 0) {
        diag_add(reader->errors, FBD_ERROR, "not-here", place->at,
                 diag_hint(reader->errors, "write `%s: ...`, or `s: ...`, the length along it", known),
                 "the parameter of this track is `%s`, not `%s`", known, key);
        return false;
    }
    if (place && (!fields_exclude(reader, node, key, "s", "they both say where it starts") ||
                  !fields_exclude(reader, node, "p", "x", "they both say where it starts")))
        return false;
    if (place) return read_parameter(reader, index, place, key, &keys->q[0]);
    double s = keys->q[0];
    if (curve->closed || (s >= curve->start && s <= curve->start + curve->length)) return true;
    const struct pair *pair = node_find(node, "s");
    diag_add(reader->errors, FBD_ERROR, "out-of-range", pair ? pair->value->at : node->at,
             diag_hint(reader->errors, "it goes from s = %.9g to %.9g, and s = 0 where %s", curve->start,
                       curve->start + curve->length, curve->start < 0 ? "its parameter is 0" : "it begins"),
             "`s` is not on the track");
    return false;
}
