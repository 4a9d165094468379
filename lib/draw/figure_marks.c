/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Marks of the figure of the system that have a name or a letter: the bodies that a ratio joins, the friction of
 * bearings, gravity into a horizontal plane.
 */
#include <string.h>

#include "draw/figure.h"

/* ---- ratios */

/* The place of a body where a ratio is marked: its axis, else its centre of mass. */
static struct vec mark_place(const struct figure *figure, int body)
{
    const struct panel *panel = &figure->panels[body];
    const bool pivot = panel->body.motion == FBD_MOTION_PIVOT;
    return panel_point(figure->pen, panel_place(panel, pivot ? vec_of(panel->body.pin) : panel->G));
}

/* Dashed lines from the first body of a ratio to the others, with its name at the longest one. */
static void draw_ratio(struct figure *figure, const fbd_connection *ratio)
{
    struct panel *pen = figure->pen;
    struct vec from = {0, 0}, longest = {0, 0}, side = {1, 0};
    double most = 0;
    int first = FBD_GROUND;
    for (size_t k = 0; k < ratio->end_count; k++) {
        const int body = ratio->ends[k].body;
        if (body < 0 || body == first) continue;
        const struct vec at = mark_place(figure, body), way = vec_sub(at, from);
        if (first < 0) {
            first = body;
            from = at;
            continue;
        }
        panel_line(pen, "reference", from, at, on_outline);
        if (vec_norm(way) <= most) continue;
        most = vec_norm(way);
        longest = vec_add(from, vec_scale(0.5, way));
        side = vec_scale(1 / most, vec_perp(way));
    }
    if (most > 0) panel_note(pen, panel_indexed(&figure->arena, ratio->name), longest, side);
}

static bool is_ratio(const fbd_connection *connection)
{
    return strcmp(connection->kind, "ratio") == 0;
}

/* A summand of a ratio: "2 cage.theta", "− left.theta". */
static void write_summand(struct text *text, const struct pair *pair, bool first)
{
    const char *factor = pair->value->kind == node_scalar ? pair->value->text : "";
    const bool minus = factor[0] == '-';
    if (minus) factor++;
    const bool whole = strpbrk(factor, "+-*/") == NULL, one = strcmp(factor, "1") == 0;
    text_add(text, minus ? (first ? "−" : " − ") : (first ? "" : " + "));
    if (!one) text_printf(text, whole ? "%s " : "(%s) ", factor);
    text_add(text, pair->key);
}

/* "gears: 2 cage.theta − left.theta − right.theta is constant" */
static const char *ratio_text(struct figure *figure, const fbd_connection *ratio)
{
    const struct node *entry = letters_entry(&figure->letters, "", ratio->name);
    struct text text = {0};
    size_t written = 0;
    for (size_t i = 0; entry && entry->kind == node_map && i < entry->count; i++)
        if (strchr(entry->pairs[i].key, '.')) write_summand(&text, &entry->pairs[i], written++ == 0);
    const char *kept = text.data && !text.failed
                           ? arena_printf(&figure->arena, "%s: %s is constant", ratio->name, text.data)
                           : NULL;
    text_free(&text);
    return kept;
}

const char *figure_listed(struct figure *figure, size_t index)
{
    size_t letters = 0;
    for (; letters_listed(&figure->letters, letters); letters++)
        if (letters == index) return letters_listed(&figure->letters, letters);
    index -= letters;
    for (size_t i = 0; i < fbd_model_connection_count(figure->model); i++) {
        const fbd_connection connection = fbd_model_connection(figure->model, i);
        if (is_ratio(&connection) && index-- == 0) return ratio_text(figure, &connection);
    }
    return NULL;
}

/* ---- friction of bearings */

/* The letter or the value of the friction of a bearing, at its axis. */
static void name_bearing(struct figure *figure, const struct panel *panel)
{
    for (size_t i = 0; i < panel->force_count; i++) {
        const fbd_force *force = &panel->forces[i];
        if (!force->moment || strcmp(force->kind, "friction") != 0) continue;
        const struct node *entry = letters_entry(&figure->letters, panel->body.name, force->arrow.name);
        const char *text = letters_text(&figure->letters, entry, "bearing", NAN, ""),
                   *moment = letters_text(&figure->letters, entry, "coefficient", NAN, panel->units.moment);
        if (text || moment)
            labelling_add(&figure->pen->labels, text ? text : moment, label_size,
                          mark_place(figure, (int)panel->index), (struct vec){-0.8, 0.6}, 3);
    }
}

/* ---- gravity into the plane */

static void mark_gravity(struct figure *figure)
{
    const struct box *box = &figure->pen->extent;
    if (!(fbd_model_scene(figure->model).pressing > 0)) return;
    panel_note(figure->pen, "⊗ g", (struct vec){box->low.x, box->low.y}, (struct vec){-0.7, -0.7});
}

void figure_marks(struct figure *figure)
{
    for (size_t i = 0; i < fbd_model_connection_count(figure->model); i++) {
        const fbd_connection connection = fbd_model_connection(figure->model, i);
        if (is_ratio(&connection)) draw_ratio(figure, &connection);
    }
    for (size_t b = 0; b < figure->count; b++)
        if (figure->panels[b].body.motion == FBD_MOTION_PIVOT) name_bearing(figure, &figure->panels[b]);
    mark_gravity(figure);
}
