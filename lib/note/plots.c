/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The plots of a note: coordinates, then rates, those of one unit in one plot, at most six in each.
 */
#include <string.h>

#include "base/printed.h"
#include "note/note.h"

enum { most_plots = 8, most_in_plot = 6 };

/* The column of a name; 0, that of the time, if there is none. */
static size_t column_of(const struct making *making, const char *name)
{
    for (size_t c = 1; c < making->table.columns; c++)
        if (strcmp(making->table.heads[c].name, name) == 0) return c;
    return 0;
}

static void add_plot(struct making *making, const size_t *columns, size_t count)
{
    const fbd_column *heads = making->table.heads;
    const struct scaled_unit unit = unit_for(heads[columns[0]].unit, 1, false);
    struct text *text = making_begin(making);
    for (size_t i = 0; i < count; i++) {
        if (i) text_add(text, ", ");
        text_symbol(text, heads[columns[i]].name);
    }
    text_printf(text, " [%s] over the time [s]", unit.name);
    const char *caption = making_take(making);
    char *svg = plot_svg(making, columns, count, caption);
    document_picture(making->document, svg, caption, caption);
}

/* Plots of the coordinates, or of their rates; `seen` marks those that have been drawn. */
static void add_plots(struct making *making, bool rates, size_t *made)
{
    const size_t count = fbd_model_coordinate_count(making->model);
    bool *seen = ARENA_ARRAY(&making->document->arena, count + 1, bool);
    for (size_t i = 0; seen && i < count && *made < most_plots; i++) {
        size_t columns[most_in_plot], drawn = 0;
        const fbd_coordinate first = fbd_model_coordinate(making->model, i);
        for (size_t k = i; k < count && drawn < most_in_plot; k++) {
            const fbd_coordinate c = fbd_model_coordinate(making->model, k);
            if (seen[k] || strcmp(rates ? c.rate_unit : c.unit, rates ? first.rate_unit : first.unit) != 0)
                continue;
            columns[drawn] = column_of(making, rates ? c.rate_name : c.name);
            drawn += columns[drawn] > 0;
            seen[k] = true;
        }
        if (drawn == 0) continue;
        add_plot(making, columns, drawn);
        ++*made;
    }
}

void note_plots(struct making *making)
{
    const size_t rows = making->table.rows;
    size_t made = 0;
    if (rows < 2) return;
    document_heading(making->document, 3, "Plots");
    add_plots(making, false, &made);
    add_plots(making, true, &made);
}
