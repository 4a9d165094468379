/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The reactions of a scene at rest, as of --static.
 */
#include <math.h>

#include "note/note.h"

static void put(struct making *making, struct block *table, double value, double size,
                const struct scaled_unit *unit)
{
    document_cell(making->document, table,
                  making_number(making, rounded_off(value, NAN, size) / unit->size, force_digits));
}

/* The largest moment on any body: others are at the round-off level beside it. */
static double largest_moment(struct making *making)
{
    double largest = 0;
    for (size_t b = 0; b < fbd_model_body_count(making->model); b++) {
        const size_t room = fbd_statics_diagram(making->statics, b, NULL, 0);
        fbd_arrow *arrows = ARENA_ARRAY(&making->document->arena, room + 1, fbd_arrow);
        const size_t count = arrows ? fbd_statics_diagram(making->statics, b, arrows, room) : 0;
        for (size_t i = 0; i < count && i < room; i++) largest = fmax(largest, fabs(arrows[i].moment));
    }
    return largest;
}

/* The forces on a body, and their sums. */
static void list_body(struct making *making, size_t body, double scene_moment)
{
    struct document *document = making->document;
    struct arena *arena = &document->arena;
    const char *name = fbd_model_body_name(making->model, body);
    const fbd_units units = fbd_model_units(making->model);
    const size_t room = fbd_statics_diagram(making->statics, body, NULL, 0);
    fbd_arrow *arrows = ARENA_ARRAY(arena, room + 1, fbd_arrow), sum = {.name = "sum"};
    double size = 0, moment_size = 0;
    if (!arrows || room == 0) return;
    fbd_statics_diagram(making->statics, body, arrows, room);
    for (size_t i = 0; i < room; i++) {
        size = fmax(size, hypot(arrows[i].fx, arrows[i].fy));
        moment_size = fmax(moment_size, fabs(arrows[i].moment));
        sum.fx += arrows[i].fx;
        sum.fy += arrows[i].fy;
        sum.moment += arrows[i].moment;
    }
    arrows[room] = sum;
    const struct scaled_unit force = unit_for(units.force, size, false),
                             moment = unit_for(units.moment, moment_size, false);
    const char *const heads[] = {"Force", arena_printf(arena, "Fx [%s]", force.name),
                                 arena_printf(arena, "Fy [%s]", force.name),
                                 arena_printf(arena, "Moment [%s]", moment.name)};
    struct block *table =
        document_table(document, arena_printf(arena, "forces on %s at rest", name), "lrrr", heads);
    for (size_t i = 0; i <= room; i++) {
        document_cell(document, table, arrows[i].name);
        put(making, table, arrows[i].fx, size, &force);
        put(making, table, arrows[i].fy, size, &force);
        put(making, table, arrows[i].moment, scene_moment, &moment);
    }
}

static void list_limits(struct making *making)
{
    static const char *const heads[] = {"Limit", "Needed", "Available", "Utilisation", "Within"};
    struct document *document = making->document;
    struct block *table = NULL;
    for (size_t i = 0; i < fbd_statics_limit_count(making->statics); i++) {
        const fbd_limit limit = fbd_statics_limit(making->statics, i);
        if (!table)
            table = document_table(document, "limits of surfaces, friction and ropes", "lrrrl", heads);
        table->table.marked = true;
        const bool friction = limit.kind == FBD_LIMIT_FRICTION;
        document_cell(document, table, limit.name);
        document_cell(document, table, making_value(making, limit.needed, limit.unit, force_digits));
        document_cell(document, table,
                      friction ? making_value(making, limit.limit, limit.unit, force_digits) : "not below 0");
        if (friction && limit.limit > 0)
            document_cell_format(document, table, "%s\u00a0%%",
                                 making_number(making, 100 * limit.needed / limit.limit, 3));
        else
            document_cell(document, table, "");
        document_cell(document, table, limit.holds ? "yes" : "NO");
    }
}

void note_statics(struct making *making)
{
    const size_t degree = making->statics ? fbd_statics_indeterminacy(making->statics) : 0;
    if (!making->statics) return;
    document_heading(making->document, 2, "Statics");
    document_paragraph(
        making->document,
        "The scene is in equilibrium at its start; the sums of forces and of moments are zero for each "
        "body. Moments are about the axis of a pivot, else about the centre of mass.");
    if (degree == 0) document_paragraph(making->document, "It is statically determinate.");
    if (degree > 0) {
        document_paragraph(
            making->document,
            "It is statically indeterminate to degree %zu: of all reactions that balance, those of the "
            "least sum of squares are listed. Not determined:",
            degree);
        struct block *list = document_list(making->document);
        for (size_t i = 0; i < fbd_statics_undetermined_count(making->statics); i++)
            document_cell(making->document, list, fbd_statics_undetermined(making->statics, i));
    }
    const double moment = largest_moment(making);
    for (size_t b = 0; b < fbd_model_body_count(making->model) && b < most_drawn_bodies; b++)
        list_body(making, b, moment);
    list_limits(making);
}
