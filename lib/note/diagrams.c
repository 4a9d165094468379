/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The sketch of the system, the free-body diagrams with values, and the equations.
 */

#include "note/note.h"

static size_t drawn_bodies(const struct making *making)
{
    const size_t count = fbd_model_body_count(making->model);
    return count < most_drawn_bodies ? count : most_drawn_bodies;
}

/* A drawing of the start; without one the caller's list has the reason. */
static void draw(struct making *making, const fbd_drawing *drawing, const char *caption,
                 const char *alternative)
{
    char *svg = fbd_diagram_svg(making->start, drawing, making->list);
    if (svg)
        document_picture(making->document, svg, caption, alternative);
    else
        making->refused = true;
}

/* "crank, connecting_rod, piston" */
static const char *names(struct making *making)
{
    const size_t count = fbd_model_body_count(making->model);
    struct text *text = making_begin(making);
    for (size_t b = 0; b < drawn_bodies(making); b++)
        text_printf(text, "%s%s", b ? ", " : "", fbd_model_body_name(making->model, b));
    if (count > most_drawn_bodies) text_printf(text, " and %zu more", count - most_drawn_bodies);
    return making_take(making);
}

void note_system(struct making *making)
{
    struct arena *arena = &making->document->arena;
    const size_t count = fbd_model_body_count(making->model);
    const fbd_drawing drawing = {.size = sizeof drawing, .system = true, .untitled = true};
    document_heading(making->document, 2, "System");
    if (count > most_drawn_bodies) {
        document_paragraph(making->document, "%zu bodies: %s.", count, names(making));
        return;
    }
    const char *alternative =
        arena_printf(arena, "The bodies %s joined, at the start, with their supports and the applied forces.",
                     names(making));
    draw(making, &drawing, "the system at the start: supports, applied forces, dimensions and masses",
         alternative);
}

/* ---- free-body diagrams */

/* Each force of the diagram in words, for readers without the picture. */
static const char *describe(struct making *making, size_t body)
{
    const char *unit = fbd_model_units(making->model).force, *moment = fbd_model_units(making->model).moment;
    struct text *text = making_begin(making);
    text_printf(text, "Free-body diagram of %s at t = 0", fbd_model_body_name(making->model, body));
    for (size_t i = 0; i < fbd_view_force_count(making->view, body); i++) {
        const fbd_arrow arrow = fbd_view_force(making->view, body, i).arrow;
        const bool force = arrow.fx != 0 || arrow.fy != 0;
        text_printf(text, "; %s: ", arrow.name);
        if (force) {
            text_add(text, "(");
            number_write(text, arrow.fx, force_digits);
            text_add(text, ", ");
            number_write(text, arrow.fy, force_digits);
            text_printf(text, ") %s", unit);
        }
        if (arrow.couple != 0) {
            if (force) text_add(text, " with ");
            value_write(text, arrow.couple, moment, force_digits, false);
        }
        if (!force && arrow.couple == 0) text_add(text, "0");
    }
    return making_take(making);
}

/* The letters of the equations. */
static void draw_letters(struct making *making)
{
    const fbd_drawing drawing = {.size = sizeof drawing, .symbols = true, .untitled = true};
    draw(making, &drawing, "each body cut free, forces by their letters",
         arena_printf(&making->document->arena,
                      "The bodies %s cut free, every force as an arrow with its letter.", names(making)));
}

void note_diagrams(struct making *making)
{
    struct arena *arena = &making->document->arena;
    const size_t count = fbd_model_body_count(making->model);
    document_heading(making->document, 2, "Free-body diagrams");
    if (count <= most_drawn_bodies) draw_letters(making);
    for (size_t b = 0; b < drawn_bodies(making); b++) {
        const char *name = fbd_model_body_name(making->model, b);
        const fbd_drawing drawing = {.size = sizeof drawing, .body = name, .untitled = true};
        draw(making, &drawing, arena_printf(arena, "%s cut free, at t = 0, with values", name),
             describe(making, b));
    }
    if (count > most_drawn_bodies)
        document_paragraph(making->document,
                           "And %zu more bodies; fbd-run --svg FILE --body NAME draws each.",
                           count - most_drawn_bodies);
}

/* ---- equations */

void note_equations(struct making *making)
{
    static const fbd_format formats[note_formats] = {
        [FBD_NOTE_HTML] = FBD_MATHML, [FBD_NOTE_MARKDOWN] = FBD_TEXT, [FBD_NOTE_LATEX] = FBD_LATEX};
    char *forms[note_formats];
    document_heading(making->document, 2, "Equations");
    if (fbd_model_body_count(making->model) > most_drawn_bodies) {
        document_paragraph(making->document,
                           "fbd-run --equations --components prints those of the %zu bodies.",
                           fbd_model_body_count(making->model));
        return;
    }
    document_paragraph(
        making->document,
        "Each equation of motion in letters, then with the numbers at t = 0: inertia times acceleration "
        "is the sum of the forces, or moments. G is the centre of mass, O the axis of a pivot; the letters "
        "are those of the figures. N is positive where it presses, f where it acts against +x, T and S where "
        "they pull, M counter-clockwise; the arrows point as the forces do at that time.");
    for (int i = 0; i < note_formats; i++) {
        const fbd_equations_options options = {.size = sizeof options,
                                               .format = formats[i],
                                               .components = true};
        forms[i] = fbd_equations_write(making->start, &options, making->list);
        if (!forms[i]) making->document->arena.failed = true;
    }
    document_equations(making->document, forms);
}
