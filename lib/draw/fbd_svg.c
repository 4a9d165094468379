/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The free-body diagrams of a state as an SVG document: a panel for each body, in columns on a sheet that
 * fits an A4 page, each with its heading, its scales and the names of zero forces.
 *
 * Forces have the same scale in all panels, so that action and reaction have equal lengths.
 */
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/format.h"
#include "draw/panel.h"
#include "draw/system_svg.h"
#include "fbd_export.h"
#include "fbd_view.h"

/* A4 minus the margins of printers; lengths in mm. */
static const double page_width = 190, page_height = 270;
static const double margin = 5, gap = 8, heading_height = 13, line_height = 4.2, writing_height = 8;

/* Sheets are scaled down to fit a page, to at least the readable size; longer sheets exceed a page. */
static const double least_size = 0.55, size_step = 0.05;

struct sheet {
    struct arena arena;
    struct fbd_state *state;
    const fbd_drawing *drawing;
    const fbd_model *model;
    fbd_view *view;
    bool symbols;
    struct panel *panels;
    size_t count;
    struct text text;
    struct text *notes; /* per panel: lines under it, separated by newlines */
};

/* ---- panels */

bool panel_start(struct panel *panel, const fbd_state *state, const fbd_view *view, size_t body,
                 const fbd_drawing *drawing, struct arena *arena)
{
    const fbd_model *model = fbd_state_model(state);
    *panel = (struct panel){.arena = arena,
                            .model = model,
                            .state = state,
                            .view = view,
                            .index = body,
                            .body = fbd_model_body(model, body),
                            .pose = fbd_view_pose(view, body),
                            .G = vec_of(fbd_model_inertia(model, body).G),
                            .force_count = fbd_view_force_count(view, body),
                            .units = fbd_model_units(model),
                            .drawing = drawing,
                            .labels = {.arena = arena},
                            .extent = box_nothing};
    panel->forces = ARENA_ARRAY(arena, panel->force_count + 1, fbd_force);
    for (size_t i = 0; panel->forces && i < panel->force_count; i++)
        panel->forces[i] = fbd_view_force(view, body, i);
    return panel->forces != NULL;
}

static bool start_panel(struct sheet *sheet, struct panel *panel, size_t body)
{
    if (!panel_start(panel, sheet->state, sheet->view, body, sheet->drawing, &sheet->arena)) return false;
    if (!sheet->symbols) return true;
    const char **symbols = ARENA_ARRAY(&sheet->arena, panel->force_count + 1, const char *);
    const char **moments = ARENA_ARRAY(&sheet->arena, panel->force_count + 1, const char *);
    for (size_t i = 0; symbols && moments && i < panel->force_count; i++) {
        symbols[i] = panel_indexed(&sheet->arena, panel->forces[i].symbol);
        moments[i] = panel->forces[i].moment ? symbols[i] : arena_printf(&sheet->arena, "M(%s)", symbols[i]);
    }
    panel->symbols = symbols;
    panel->moments = moments;
    return symbols && moments;
}

/* Set the scales by the maxima of all bodies, including those not drawn, so that a part of a scene has the
 * scale of the whole, and forces at round-off level are recognized. For moments, the maximum includes the
 * forces times their arms. */
static void set_scales(struct sheet *sheet, size_t body_count)
{
    struct arrow_scale all = {0, 0};
    double arm = 0;
    for (size_t i = 0; i < body_count; i++) {
        const struct panel *panel = &sheet->panels[i];
        struct arrow_scale most = panel_largest(panel);
        all.force = fmax(all.force, most.force);
        all.moment = fmax(all.moment, most.moment);
        for (size_t k = 0; k < panel->force_count; k++)
            arm = fmax(arm, vec_norm((struct vec){panel->forces[k].arrow.x - panel->pose.x,
                                                  panel->forces[k].arrow.y - panel->pose.y}));
    }
    double force =
        sheet->drawing->scale > 0 ? sheet->drawing->scale : round_up(10 * all.force / longest_arrow);
    for (size_t i = 0; i < body_count; i++) {
        struct panel *panel = &sheet->panels[i];
        panel->scale.force = force;
        panel->scale.moment = round_up(all.moment / 3.4); /* up to 306 degrees */
        panel->largest.force = all.force;
        panel->largest.moment = isfinite(arm) ? fmax(all.moment, all.force * arm) : all.moment;
    }
}

static bool set_lengths(struct sheet *sheet, size_t body_count)
{
    double *sizes = ARENA_ARRAY(&sheet->arena, body_count, double), largest = 0;
    if (!sizes) return false;
    for (size_t i = 0; i < body_count; i++) {
        sizes[i] = panel_measure(&sheet->panels[i]);
        if (isfinite(sizes[i])) largest = fmax(largest, sizes[i]);
    }
    for (size_t i = 0; i < body_count; i++) panel_set_scale(&sheet->panels[i], sizes[i], largest);
    return true;
}

/* ---- text under a panel */

static void note_scale(struct panel *panel, struct text *notes, const char *name, double size,
                       const char *unit)
{
    text_printf(notes, "%s = %s\n", name, panel_scale_value(panel, size, unit));
}

static void note_scales(struct panel *panel, struct text *notes)
{
    bool forces = false, moments = false;
    for (size_t i = 0; i < panel->drawn_count; i++)
        (panel->drawn[i].radius > 0 ? (moments = true) : (forces = true));
    if (forces) note_scale(panel, notes, "forces: 10 mm", panel->scale.force, panel->units.force);
    if (moments) note_scale(panel, notes, "moments: 90° of arc", panel->scale.moment, panel->units.moment);
    if (panel->sized)
        note_scale(panel, notes, panel->enlarged ? "enlarged, lengths: 10 mm" : "lengths: 10 mm",
                   10 / panel->millimetres, panel->units.length);
    bool small = false;
    for (size_t i = 0; i < panel->drawn_count; i++) small |= panel->drawn[i].small;
    if (small) text_add(notes, "dashed: too small for the scale\n");
}

static void note_zeros(const struct panel *panel, struct text *notes)
{
    const char *before = "zero here: ";
    const double widest = 70;
    double width = 0;
    for (size_t i = 0; i < panel->force_count; i++) {
        bool drawn = false;
        for (size_t k = 0; k < panel->drawn_count; k++) drawn |= panel->drawn[k].source == &panel->forces[i];
        if (drawn) continue;
        const char *name = panel->symbols ? panel->symbols[i] : panel->forces[i].arrow.name;
        width += svg_text_width(before, note_size) + svg_text_width(name, note_size);
        if (width > widest) before = ",\n", width = svg_text_width(name, note_size);
        text_printf(notes, "%s%s", before, name);
        before = ", ";
    }
    if (before[0] == ',') text_add(notes, "\n");
}

/* List the symbols with values and names, one line for each line of the worksheet. */
static void note_answers(struct panel *panel, struct text *notes)
{
    for (size_t i = 0; i < panel->drawn_count; i++) {
        const struct panel_arrow *arrow = &panel->drawn[i];
        if (arrow->component) continue;
        const char *symbol = panel_symbol(panel, arrow);
        const char *unit = arrow->radius > 0 ? panel->units.moment : panel->units.force;
        bool named = strcmp(symbol, arrow->source->arrow.name) != 0;
        text_printf(notes, "%s = %s%s%s\n", symbol, panel_value(panel, arrow->value, unit), named ? ", " : "",
                    named ? arrow->source->arrow.name : "");
    }
}

/* One more line than arrows, so that their number is not revealed. */
static void note_lines(const struct panel *panel, struct text *notes)
{
    for (size_t i = 0; i <= panel->force_count; i++) text_add(notes, "_\n");
}

static void write_notes_of(struct panel *panel, struct text *notes)
{
    const fbd_drawing *drawing = panel->drawing;
    if (drawing->worksheet) {
        note_lines(panel, notes);
        return;
    }
    note_scales(panel, notes);
    if (drawing->solution) note_answers(panel, notes);
    note_zeros(panel, notes);
}

static void write_heading(struct panel *panel, struct text *text, struct vec at)
{
    const fbd_mass mass = fbd_view_mass(panel->view, panel->index);
    const bool pivot = panel->body.motion == FBD_MOTION_PIVOT;
    struct text line = {0};
    text_printf(&line, "%s = %s", panel->symbols ? panel_indexed(panel->arena, mass.symbol) : "m",
                panel_value(panel, mass.mass, panel->units.mass));
    if (pivot || panel->body.motion == FBD_MOTION_PLANAR)
        text_printf(&line, ", %s = %s", pivot ? "I_{O}" : "I_{G}",
                    panel_value(panel, pivot ? mass.I_O : mass.I_G, panel->units.inertia));
    svg_text_at(text, "heading", at, panel->body.name);
    if (line.failed)
        text->failed = true;
    else
        svg_text_at(text, "note", (struct vec){at.x, at.y + 5}, line.data);
    text_free(&line);
}

/* Write the labels that do not belong to an arrow: those of the fixtures. */
void panel_write_notes(const struct panel *panel, struct text *text)
{
    for (size_t i = 0; i < panel->labels.label_count; i++) {
        bool owned = false;
        for (size_t k = 0; k < panel->drawn_count; k++) owned |= panel->drawn[k].label == i;
        if (owned) continue;
        const struct label_place *label = &panel->labels.labels[i];
        if (label->leader) svg_line(text, "leader", label->anchor, labelling_leader(label));
        svg_text(text, "label axis-label", label->center, label_size, label->text);
    }
}

void panel_draw(struct panel *panel)
{
    bool in_front = panel_fixtures_in_front(panel);
    if (!in_front) panel_fixtures(panel);
    panel_body(panel);
    if (in_front) panel_fixtures(panel);
    if (!panel->drawing->worksheet) panel_arrows(panel);
    labelling_solve(&panel->labels);
    for (size_t i = 0; i < panel->labels.label_count; i++) {
        struct box box = labelling_box(&panel->labels.labels[i]);
        box_join(&panel->extent, &box);
    }
    if (!panel->drawing->worksheet) return;
    const double room = 20; /* for the arrows of the student */
    panel->extent.low = vec_sub(panel->extent.low, (struct vec){room, room});
    panel->extent.high = vec_add(panel->extent.high, (struct vec){room, room});
}

/* ---- layout */

/* The height of the lines under a panel; empty lines of a worksheet are higher. */
static double height_of(const struct text *notes)
{
    double height = 0;
    for (const char *c = notes->data; c && *c; c++)
        if (*c == '\n') height += c > notes->data && c[-1] == '_' ? writing_height : line_height;
    return height;
}

static double widest_line(const struct text *notes)
{
    double widest = 0;
    char line[400];
    for (const char *c = notes->data; c && *c;) {
        size_t length = strcspn(c, "\n");
        snprintf(line, sizeof line, "%.*s", (int)length, c);
        widest = fmax(widest, svg_text_width(line, note_size));
        c += length + (c[length] == '\n');
    }
    return widest;
}

static struct vec panel_size(const struct panel *panel, const struct text *notes)
{
    double wide = panel->extent.high.x - panel->extent.low.x,
           high = panel->extent.high.y - panel->extent.low.y;
    wide = fmax(wide, fmax(widest_line(notes), svg_text_width(panel->body.name, 5)));
    return (struct vec){fmax(wide, 50), high + heading_height + height_of(notes) + 3};
}

static void write_lines(struct text *notes, struct vec at, struct text *text)
{
    const double line_width = 50;
    for (char *c = notes->data; c && *c;) {
        size_t length = strcspn(c, "\n");
        bool more = c[length] == '\n', blank = strncmp(c, "_", length) == 0;
        c[length] = '\0';
        if (blank) {
            at.y += writing_height - line_height;
            svg_line(text, "leader", at, (struct vec){at.x + line_width, at.y});
        } else {
            svg_text_at(text, "note", at, c);
        }
        at.y += line_height;
        c += length + more;
    }
}

static void write_panel(struct panel *panel, struct text *notes, struct vec corner, struct text *text)
{
    text_printf(text, "<g class=\"diagram\" id=\"%s\">\n", panel->body.name);
    write_heading(panel, text, (struct vec){corner.x, corner.y + 4});
    struct vec shift = {corner.x - panel->extent.low.x, corner.y + heading_height - panel->extent.low.y};
    text_add(text, "<g transform=\"translate(");
    svg_point(text, shift);
    text_add(text, ")\">\n");
    if (panel->under.data) text_add(text, panel->under.data);
    panel_write_arrows(panel, text);
    panel_write_notes(panel, text);
    text_add(text, "</g>\n");
    double y = corner.y + heading_height + panel->extent.high.y - panel->extent.low.y + 5;
    write_lines(notes, (struct vec){corner.x, y}, text);
    text_add(text, "</g>\n");
}

enum { most_columns = 8 };

/* Arrange the panels in columns of the width of the widest panel, each in the shortest column so far; returns
 * the size of the document. Also writes them if `text` is not NULL. */
static struct vec lay_out(const struct sheet *sheet, double width, double top, struct text *text)
{
    double wide = 0, heights[most_columns] = {0};
    for (size_t i = 0; i < sheet->count; i++)
        wide = fmax(wide, panel_size(&sheet->panels[i], &sheet->notes[i]).x);
    double fit = (width - 2 * margin + gap) / (wide + gap);
    int columns = fit >= most_columns ? most_columns : fit < 1 ? 1 : (int)fit;
    if ((size_t)columns > sheet->count && sheet->count > 0) columns = (int)sheet->count;
    for (int c = 0; c < columns; c++) heights[c] = top;
    for (size_t i = 0; i < sheet->count; i++) {
        int shortest = 0;
        for (int c = 1; c < columns; c++)
            if (heights[c] < heights[shortest]) shortest = c;
        struct vec corner = {margin + shortest * (wide + gap), heights[shortest]};
        heights[shortest] += panel_size(&sheet->panels[i], &sheet->notes[i]).y + gap;
        if (text) write_panel(&sheet->panels[i], &sheet->notes[i], corner, text);
    }
    double bottom = top;
    for (int c = 0; c < columns; c++) bottom = fmax(bottom, heights[c] - gap);
    return (struct vec){2 * margin + columns * (wide + gap) - gap, bottom + margin};
}

/* The scale at which the sheet fits the page. */
static double fitting_size(const struct sheet *sheet, double top)
{
    double size = 1;
    while (size > least_size) {
        struct vec whole = lay_out(sheet, page_width / size, top, NULL);
        if (whole.y * size <= page_height && whole.x * size <= page_width) break;
        size -= size_step;
    }
    return size;
}

static void write_sheet(struct sheet *sheet)
{
    struct text *text = &sheet->text;
    const char *given = fbd_model_title(sheet->model), *title = given[0] ? given : "Free-body diagram";
    double t = 0;
    fbd_state_get(sheet->state, "t", &t);
    const double top = margin + (sheet->drawing->untitled ? 0 : 14), scale = fitting_size(sheet, top);
    struct vec size = lay_out(sheet, page_width / scale, top, NULL);
    char time[80], description[200];
    const char *what = sheet->drawing->worksheet ? "Free-body diagram, to be drawn," : "Free-body diagram";
    format_into(time, sizeof time, "%s at t = %.6g s", what, t);
    snprintf(description, sizeof description,
             sheet->drawing->worksheet
                 ? "%s: each body cut free"
                 : "%s: each force as an arrow at the point where it acts, each moment as an arc",
             time);
    if (!sheet->drawing->untitled)
        size.x = fmax(size.x, 2 * margin + fmax(svg_text_width(title, 4.8), svg_text_width(time, note_size)));
    svg_begin(text, size, scale, title, description);
    if (!sheet->drawing->untitled) {
        svg_text_at(text, "heading", (struct vec){margin, margin + 4}, title);
        svg_text_at(text, "note", (struct vec){margin, margin + 9}, time);
    }
    lay_out(sheet, page_width / scale, top, text);
    text_add(text, "</svg>\n");
}

/* ---- the whole */

/* The first body whose lengths or forces, though finite, are too large or too small for any scale; or NULL. */
static const char *body_without_scale(const struct sheet *sheet)
{
    for (size_t i = 0; i < sheet->count; i++) {
        const struct panel *panel = &sheet->panels[i];
        bool odd = sheet->text.odd || panel->under.odd || sheet->notes[i].odd;
        odd |= !isfinite(panel->scale.force) || !isfinite(panel->scale.moment);
        if (odd || !isfinite(10 / panel->millimetres)) return panel->body.name;
    }
    return NULL;
}

/* Start the panels of all bodies for the scales, and move the requested ones to the front of `panels`. */
static bool make_panels(struct sheet *sheet)
{
    const fbd_drawing *drawing = sheet->drawing;
    const size_t count = fbd_model_body_count(sheet->model);
    sheet->panels = ARENA_ARRAY(&sheet->arena, count, struct panel);
    sheet->notes = ARENA_ARRAY(&sheet->arena, count, struct text);
    sheet->symbols = drawing->symbols || drawing->solution;
    if (!sheet->panels || !sheet->notes) return false;
    for (size_t b = 0; b < count; b++)
        if (!start_panel(sheet, &sheet->panels[b], b)) return false;
    set_scales(sheet, count);
    if (!set_lengths(sheet, count)) return false;
    for (size_t b = 0; b < count; b++)
        if (!drawing->body || strcmp(sheet->panels[b].body.name, drawing->body) == 0)
            sheet->panels[sheet->count++] = sheet->panels[b];
    for (size_t i = 0; i < sheet->count; i++) {
        panel_draw(&sheet->panels[i]);
        write_notes_of(&sheet->panels[i], &sheet->notes[i]);
    }
    return !sheet->arena.failed;
}

static bool body_is_there(const fbd_model *model, const char *name, fbd_errors *errors)
{
    const size_t count = fbd_model_body_count(model);
    const char **names = calloc(count + 1, sizeof *names);
    bool found = false;
    for (size_t b = 0; b < count; b++) {
        found |= strcmp(fbd_model_body_name(model, b), name) == 0;
        if (names) names[b] = fbd_model_body_name(model, b);
    }
    if (!found && names)
        diag_add(errors, FBD_ERROR, "unknown-body", (struct pos){0, 0},
                 diag_nearest(errors, name, names, count), "there is no body `%s`", name);
    else if (!found)
        diag_out_of_memory(errors);
    free(names);
    return found;
}

static char *make_svg(fbd_state *state, const fbd_drawing *drawing, fbd_errors *errors)
{
    struct sheet sheet = {.model = fbd_state_model(state), .state = state, .drawing = drawing};
    double t = 0;
    fbd_state_get(state, "t", &t);
    diag_in_file(errors, fbd_model_file(sheet.model));
    if (drawing->body && !body_is_there(sheet.model, drawing->body, errors)) return NULL;
    sheet.view = fbd_view_new(state, errors);
    if (!sheet.view) return NULL;
    bool done = make_panels(&sheet);
    if (done) write_sheet(&sheet);
    const char *odd = done ? body_without_scale(&sheet) : NULL;
    sheet.text.failed |= sheet.arena.failed;
    for (size_t i = 0; i < sheet.count; i++) {
        if (sheet.panels[i].under.failed || sheet.notes[i].failed) sheet.text.failed = true;
        text_free(&sheet.panels[i].under);
        text_free(&sheet.notes[i]);
    }
    arena_free(&sheet.arena);
    fbd_view_free(sheet.view);
    if (odd && !sheet.text.failed) {
        diag_add(errors, FBD_ERROR, "not-finite", (struct pos){0, 0}, NULL,
                 "the diagram of `%s` cannot be drawn at t = %.9g: a length or a force is too large or too "
                 "small for any scale",
                 odd, t);
        text_free(&sheet.text);
        return NULL;
    }
    if (!done || sheet.text.failed) {
        text_free(&sheet.text);
        diag_out_of_memory(errors);
        return NULL;
    }
    return sheet.text.data;
}

char *fbd_diagram_svg(fbd_state *state, const fbd_drawing *drawing, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_drawing own = {0};
    char *svg = NULL;
    if (!state)
        api_refuse(errors, "there is no state");
    else if (api_take_options(&own, sizeof own, drawing, errors))
        svg = own.system ? system_svg(state, &own, errors) : make_svg(state, &own, errors);
    diag_end(&call);
    return svg;
}
