/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Answers that are drawings, and answers that contain only additions to the sheet.
 *
 * A drawing is a list of objects as written by Meclib (of STACK) or `pl-drawing` (of PrairieLearn), in place
 * of the answer or under `drawing` of a body. Each arrow becomes an entry `applied`, and a sketch with its
 * position in the world; sketch.c compares that with the key. Supports, dimensions, labels and the like are
 * ignored.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "document/node_edit.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/lines.h"

/* An arrow in units of the drawing. */
struct arrow_drawn {
    const struct node *object;
    struct pos at;
    const char *label;
    bool couple, clockwise, down; /* `down`: y points down */
    struct vec tail, tip;
    double snap;
};

/* The body of the current drawing, and its lists. */
struct desk {
    struct fbd_grade *grade;
    fbd_errors *failures;
    const char *body;
    const struct node *forces, *moments;
};

/* ---- nodes */

static const char *text_of(const struct node *node)
{
    return node && node->kind == node_scalar ? node->text : "";
}

static bool number_of(const struct node *node, double *number)
{
    char *end = NULL;
    if (!node || node->kind != node_scalar || node->length == 0) return false;
    *number = strtod(node->text, &end);
    return *end == '\0' && isfinite(*number);
}

static bool point_of(const struct node *node, struct vec *point)
{
    return node && node->kind == node_list && node->count == 2 && number_of(node->items[0], &point->x) &&
           number_of(node->items[1], &point->y);
}

static const struct node *item_of(const struct node *list, size_t index)
{
    return index < list->count ? list->items[index] : NULL;
}

static const struct node *map_with(struct arena *arena, const struct node *map, const char *key,
                                   const struct node *value)
{
    return map && value ? node_with(arena, map, key, value) : NULL;
}

static const struct node *empty_map_at(struct arena *arena, struct pos at)
{
    struct node *made = ARENA_NEW(arena, struct node);
    const struct node *empty = node_empty_map(arena);
    if (!made || !empty) return NULL;
    *made = *empty;
    made->at = at;
    return made;
}

static void say_unreadable(struct desk *desk, const struct node *object, const char *name, const char *why)
{
    fbd_finding *finding = finding_add(desk->grade, FBD_FINDING_UNREADABLE, desk->body, name, object->at);
    finding_say(desk->grade, finding, why);
}

/* ---- labels */

static bool is_of_word(char c, bool first)
{
    bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (!first && c == '_');
    return letter || (!first && c >= '0' && c <= '9');
}

/* The label without LaTeX markup. */
static const char *plain(struct arena *arena, const char *label)
{
    char *made = arena_text(arena, label, strlen(label)), *to = made;
    for (const char *from = label; made && *from; from++)
        if (!strchr("$\\{}", *from) && (to > made || *from != ' ')) *to++ = *from;
    while (made && to > made && to[-1] == ' ') to--;
    if (made) *to = '\0';
    return made;
}

/* True if the sheet has a parameter of that name that may be the value of a force, or of a moment. */
static bool is_value(const struct desk *desk, const char *name, size_t length, bool couple)
{
    const fbd_model *sheet = desk->grade->sheet;
    for (size_t i = 0; i < fbd_model_parameter_count(sheet); i++) {
        const fbd_parameter one = fbd_model_parameter(sheet, i);
        fbd_unit unit;
        if (strlen(one.name) != length || strncmp(one.name, name, length) != 0) continue;
        if (!*one.unit) return !one.derived; /* a number whose dimension follows from its use */
        return fbd_unit_read(sheet, one.unit, strlen(one.unit), &unit) && unit.mass == 1 &&
               unit.length == (couple ? 2 : 1) && unit.time == -2 && unit.current == 0 &&
               unit.temperature == 0;
    }
    return false;
}

/* A word that is not the name of another force of the body. */
static const char *free_name(struct desk *desk, const char *label)
{
    struct arena *arena = &desk->grade->arena;
    struct text text = {0};
    for (const char *at = label; *at; at++)
        if (is_of_word(*at, text.length == 0)) text_printf(&text, "%c", *at);
    if (text.length == 0) text_add(&text, "arrow");
    const char *word = text.failed ? NULL : arena_text(arena, text.data, text.length), *name = word;
    text_free(&text);
    for (int number = 2; name; number++) {
        bool taken = !fbd_is_name(name);
        for (const struct sketch *one = desk->grade->sketches; one && !taken; one = one->next)
            taken = one->body == desk->body && strcmp(one->name, name) == 0;
        if (!taken) return name;
        name = arena_printf(arena, "%s_%d", word, number);
    }
    desk->grade->arena.failed = true;
    return NULL;
}

/* The value in a label, as text of a file; NULL for a name. `2 F` is twice the parameter F. */
static const char *value_of(const struct desk *desk, const char *label, bool couple)
{
    struct arena *arena = &desk->grade->arena;
    size_t word = 0, digits = strspn(label, "0123456789.");
    while (is_of_word(label[word], word == 0)) word++;
    if (label[word] == '\0') return word > 0 && is_value(desk, label, word, couple) ? label : NULL;
    const char *behind = label + digits + strspn(label + digits, " ");
    for (word = 0; is_of_word(behind[word], word == 0);) word++;
    if (digits > 0 && behind[word] == '\0' && is_value(desk, behind, word, couple))
        return arena_printf(arena, "%.*s*%s", (int)digits, label, behind);
    return digits > 0 || strpbrk(label, "+-*/^(") ? label : NULL;
}

/* ---- entries */

static struct vec in_the_world(const fbd_canvas *canvas, const struct arrow_drawn *arrow, struct vec point)
{
    struct vec place = vec_scale(canvas->unit, vec_sub(point, vec_of(canvas->origin)));
    if (arrow->down) place.y = -place.y;
    return place;
}

static const struct node *entry_of(struct desk *desk, const struct arrow_drawn *arrow, const char *name,
                                   const char *value)
{
    struct arena *arena = &desk->grade->arena;
    struct pos at = arrow->at;
    const struct node *keys = empty_map_at(arena, at);
    keys = map_with(arena, keys, "name", node_text(arena, name, at));
    keys = map_with(arena, keys, "value", node_text(arena, value ? value : "unknown", at));
    if (!arrow->couple) keys = map_with(arena, keys, "angle", node_text(arena, "0 deg", at));
    return map_with(arena, empty_map_at(arena, at), "applied", keys);
}

static bool has_canvas(struct desk *desk)
{
    if (desk->grade->key->grading.canvas.unit > 0) return true;
    if (fbd_errors_failed_count(desk->failures) == 0)
        diag_add(desk->failures, FBD_ERROR, "no-canvas", (struct pos){0, 0},
                 "write in the key `grading: {canvas: {origin: [200, 300], unit: 1 cm}}`: the origin of the "
                 "scene in the drawing, and the length of a pixel",
                 "an answer is a drawing, and the key has no `canvas` for it");
    return false;
}

static void take_arrow(struct desk *desk, const struct arrow_drawn *arrow)
{
    struct fbd_grade *grade = desk->grade;
    const fbd_canvas *canvas = &grade->key->grading.canvas;
    const char *label = plain(&grade->arena, arrow->label);
    if (!label || !has_canvas(desk)) return;
    if (!arrow->couple && vec_norm(vec_sub(arrow->tip, arrow->tail)) == 0) {
        say_unreadable(desk, arrow->object, label, "the arrow has no length");
        return;
    }
    const char *name = free_name(desk, label), *value = value_of(desk, label, arrow->couple);
    struct sketch *sketch = ARENA_NEW(&grade->arena, struct sketch);
    const struct node *entry = name ? entry_of(desk, arrow, name, value) : NULL;
    if (!sketch || !entry) return;
    double snap = canvas->snap > 0 ? canvas->snap : arrow->snap;
    *sketch = (struct sketch){.at = arrow->at,
                              .body = desk->body,
                              .name = name,
                              .couple = arrow->couple,
                              .clockwise = arrow->clockwise,
                              .tail = in_the_world(canvas, arrow, arrow->tail),
                              .tip = in_the_world(canvas, arrow, arrow->tip),
                              .snap = snap * canvas->unit,
                              .next = grade->sketches};
    grade->sketches = sketch;
    const struct node **list = arrow->couple ? &desk->moments : &desk->forces;
    *list = node_appended(&grade->arena, *list, entry);
}

/* ---- Meclib: ["force", name, tail, tip, offset, state], ["moment", name, centre, start, end, state], y up */

static const double snap_of_meclib = 0.2, snap_of_pixels = 10;

static bool is_hidden(const struct node *state)
{
    return strcmp(text_of(state), "hide") == 0 || strcmp(text_of(state), "deleted") == 0;
}

static void take_meclib(struct desk *desk, const struct node *object)
{
    const char *kind = text_of(item_of(object, 0)), *label = text_of(item_of(object, 1));
    struct arrow_drawn arrow = {.object = object, .at = object->at, .label = label, .snap = snap_of_meclib};
    struct vec centre = {0, 0};
    arrow.couple = strcmp(kind, "moment") == 0;
    if (strcmp(kind, "q") == 0 && !is_hidden(item_of(object, object->count - 1)))
        say_unreadable(desk, object, label, "a distributed load is not compared: draw its resultant");
    if ((!arrow.couple && strcmp(kind, "force") != 0) || is_hidden(item_of(object, 5))) return;
    bool read = arrow.couple
                    ? point_of(item_of(object, 2), &centre) && point_of(item_of(object, 3), &arrow.tail) &&
                          point_of(item_of(object, 4), &arrow.tip)
                    : point_of(item_of(object, 2), &arrow.tail) && point_of(item_of(object, 3), &arrow.tip);
    if (!read) {
        say_unreadable(desk, object, label, "the arrow has not the points that it needs");
        return;
    }
    if (arrow.couple)
        arrow.clockwise = vec_cross(vec_sub(arrow.tail, centre), vec_sub(arrow.tip, centre)) < 0;
    take_arrow(desk, &arrow);
}

/* ---- pl-drawing: {"type": "pl-vector", "left", "top", "angle", "width", ...}, y down, angles clockwise */

static bool is_true(const struct node *object, const char *key)
{
    return strcmp(text_of(lines_value(object, key)), "true") == 0;
}

/* Tail and tip; `number` is "1" or "2" of a pair, else "". */
static bool read_vector(const struct node *object, const char *number, struct arrow_drawn *arrow)
{
    static const char *const keys[] = {"left", "top", "angle"};
    double values[3], width = 0, scale = 1;
    for (size_t k = 0; k < 3; k++) {
        char key[16];
        snprintf(key, sizeof key, "%s%s", keys[k], number);
        if (!number_of(lines_value(object, key), &values[k])) return false;
    }
    if (!number_of(lines_value(object, "width"), &width)) return false;
    (void)number_of(lines_value(object, "scaleX"), &scale);
    double radians = values[2] * 0.017453292519943295;
    struct vec along = vec_scale(width * scale, (struct vec){cos(radians), sin(radians)});
    arrow->tail = (struct vec){values[0], values[1]};
    if (strcmp(text_of(lines_value(object, "originX")), "center") == 0)
        arrow->tail = vec_sub(arrow->tail, vec_scale(0.5, along));
    arrow->tip = vec_add(arrow->tail, along);
    if (is_true(object, "drawStartArrow") && !is_true(object, "drawEndArrow")) {
        struct vec tip = arrow->tail;
        arrow->tail = arrow->tip;
        arrow->tip = tip;
    }
    return true;
}

/* A moment; its position does not matter. */
static bool read_arc(const struct node *object, struct arrow_drawn *arrow)
{
    arrow->couple = true;
    arrow->clockwise = !is_true(object, "drawStartArrow");
    return lines_value(object, "drawStartArrow") || lines_value(object, "clockwiseDirection");
}

static bool is_kind(const struct node *object, const char *type, const char *name)
{
    return strcmp(text_of(lines_value(object, "type")), type) == 0 ||
           strcmp(text_of(lines_value(object, "gradingName")), name) == 0;
}

static void take_pixels(struct desk *desk, const struct node *object)
{
    static const char *const numbers[] = {"", "1", "2"};
    struct arrow_drawn arrow = {.object = object, .at = object->at, .down = true, .snap = snap_of_pixels};
    arrow.label = text_of(lines_value(object, "label"));
    bool two = is_kind(object, "pl-paired-vector", "paired_vector"),
         arc = is_kind(object, "pl-arc-vector", "arc_vector");
    if (is_kind(object, "pl-distributed-load", "distTrianLoad"))
        say_unreadable(desk, object, arrow.label, "a distributed load is not compared: draw its resultant");
    if (!two && !arc && !is_kind(object, "pl-vector", "vector")) return;
    for (size_t k = two ? 1 : 0; k < (two ? 3 : 1); k++, arrow.at.column++) {
        if (arc ? read_arc(object, &arrow) : read_vector(object, numbers[k], &arrow))
            take_arrow(desk, &arrow);
        else
            say_unreadable(desk, object, arrow.label, "the arrow has not the numbers that it needs");
    }
}

/* ---- answers */

static const struct node *list_or_none(const struct node *body, const char *key)
{
    const struct node *list = lines_value(body, key);
    return list && list->kind == node_list ? list : NULL;
}

/* A body with entries in place of `drawing`. */
static const struct node *take_drawing(struct fbd_grade *grade, const char *name, const struct node *body,
                                       fbd_errors *failures)
{
    struct arena *arena = &grade->arena;
    const struct node *drawing = lines_value(body, "drawing");
    struct desk desk = {grade, failures, name, list_or_none(body, "forces"), list_or_none(body, "moments")};
    for (size_t i = 0; drawing->kind == node_list && i < drawing->count; i++) {
        const struct node *object = drawing->items[i];
        if (object->kind == node_list && object->count > 0)
            take_meclib(&desk, object);
        else if (object->kind == node_map)
            take_pixels(&desk, object);
        else
            say_unreadable(&desk, object, "", "this is no object of a drawing");
    }
    body = node_with(arena, body, "drawing", NULL);
    if (body && desk.forces) body = node_with(arena, body, "forces", desk.forces);
    return body && desk.moments ? node_with(arena, body, "moments", desk.moments) : body;
}

static const struct node *take_drawings(struct fbd_grade *grade, const struct node *root,
                                        fbd_errors *failures)
{
    const struct node *bodies = lines_value(root, "bodies"), *made = bodies;
    for (size_t b = 0; made && bodies->kind == node_map && b < bodies->count; b++) {
        const char *name = bodies->pairs[b].key;
        const struct node *body = bodies->pairs[b].value;
        if (!node_find(body, "drawing")) continue;
        body = take_drawing(grade, name, body, failures);
        made = body ? node_with(&grade->arena, made, name, body) : NULL;
    }
    if (!bodies || made == bodies) return root;
    return made ? node_with(&grade->arena, root, "bodies", made) : NULL;
}

/* The same without file positions, as errors in an answer are not in the key. */
static const struct node *without_places(struct arena *arena, const struct node *node)
{
    struct node *made = ARENA_NEW(arena, struct node);
    if (!made) return NULL;
    *made = *node;
    made->at = (struct pos){0, 0};
    if (node->kind == node_scalar) made->text_at = made->at;
    if (node->kind == node_list) {
        const struct node **items = ARENA_ARRAY(arena, node->count + 1, const struct node *);
        for (size_t i = 0; items && i < node->count; i++)
            if (!(items[i] = without_places(arena, node->items[i]))) return NULL;
        made->items = items;
        return items ? made : NULL;
    }
    const struct node *map = node->kind == node_map ? node_empty_map(arena) : made;
    for (size_t i = 0; map && node->kind == node_map && i < node->count; i++)
        map = map_with(arena, map, node->pairs[i].key, without_places(arena, node->pairs[i].value));
    return map;
}

/* Merge two mappings; pairs of `over` replace those of `under`. */
static const struct node *put_over(struct arena *arena, const struct node *under, const struct node *over)
{
    for (size_t i = 0; under && over && over->kind == node_map && i < over->count; i++)
        under = node_with(arena, under, over->pairs[i].key, over->pairs[i].value);
    return under;
}

/* A body of the sheet merged with that of the answer. */
static const struct node *body_over(struct arena *arena, const struct node *body, const struct node *own)
{
    static const char *const asked[] = {"forces", "moments", "hand", "exact"};
    for (size_t k = 0; body && k < sizeof asked / sizeof *asked; k++)
        body = node_with(arena, body, asked[k], NULL);
    return put_over(arena, body, own);
}

/* The sheet merged with an answer that contains only additions. */
static const struct node *over_sheet(struct fbd_grade *grade, const struct node *root)
{
    struct arena *arena = &grade->arena;
    const struct node *sheet = without_places(arena, grade->key->root);
    const struct node *own = lines_value(root, "bodies"), *bodies = lines_value(sheet, "bodies"),
                      *made = bodies;
    for (size_t b = 0; made && b < bodies->count; b++) {
        const char *name = bodies->pairs[b].key;
        const struct node *body = body_over(arena, bodies->pairs[b].value, lines_value(own, name));
        made = body ? node_with(arena, made, name, body) : NULL;
    }
    for (size_t b = 0; made && b < own->count; b++)
        if (!node_find(bodies, own->pairs[b].key))
            made = node_with(arena, made, own->pairs[b].key, own->pairs[b].value);
    const struct node *parameters = lines_value(sheet, "parameters"),
                      *given = lines_value(root, "parameters");
    if (parameters && given)
        sheet = map_with(arena, sheet, "parameters", put_over(arena, parameters, given));
    else if (given)
        sheet = node_with(arena, sheet, "parameters", given);
    return made && sheet ? node_with(arena, sheet, "bodies", made) : NULL;
}

/* A drawing without a body belongs to the only body. */
static const struct node *of_only_body(struct fbd_grade *grade, const struct node *drawing)
{
    struct arena *arena = &grade->arena;
    if (fbd_model_body_count(grade->sheet) != 1) {
        fbd_finding *finding = finding_add(grade, FBD_FINDING_UNREADABLE, "", "", drawing->at);
        finding_say(grade, finding,
                    "the sheet has several bodies: write {\"bodies\": {\"NAME\": {\"drawing\": [...]}}}");
        return drawing;
    }
    const struct node *body = map_with(arena, node_empty_map(arena), "drawing", drawing);
    body = map_with(arena, node_empty_map(arena), fbd_model_body_name(grade->sheet, 0), body);
    return map_with(arena, node_empty_map(arena), "bodies", body);
}

const struct node *answer_take_drawings(struct fbd_grade *grade, const struct node *root,
                                        fbd_errors *failures)
{
    bool list = root->kind == node_list && root->count > 0 && root->items[0]->kind != node_scalar;
    if (list) root = of_only_body(grade, root);
    const struct node *bodies = root ? lines_value(root, "bodies") : NULL;
    if (bodies && bodies->kind == node_map && !node_find(root, "fbd")) root = over_sheet(grade, root);
    if (root && root->kind == node_map) root = take_drawings(grade, root, failures);
    if (!root) grade->arena.failed = true;
    return root;
}

const struct sketch *sketch_at(const struct fbd_grade *grade, struct pos at)
{
    for (const struct sketch *one = grade->sketches; one; one = one->next)
        if (one->at.line == at.line && one->at.column == at.column) return one;
    return NULL;
}
