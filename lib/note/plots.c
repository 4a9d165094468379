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

static bool varies(const struct making *making, size_t column)
{
    const fbd_table *table = &making->table;
    for (size_t r = 1; r < table->rows; r++)
        if (table->values[r * table->columns + column] != table->values[column]) return true;
    return false;
}

/* The quantities that are plotted: coordinates or rates, and names of those that are constant. */
struct plotting {
    bool rates;
    size_t made; /* plots so far */
    struct block *constant;
};

static const char *unit_of(const fbd_coordinate *c, bool rates)
{
    return rates ? c->rate_unit : c->unit;
}

/* List a quantity that does not change. */
static void add_constant(struct making *making, struct plotting *plotting, const fbd_coordinate *c,
                         size_t column)
{
    const char *name = plotting->rates ? c->rate_name : c->name;
    struct text *text = making_begin(making);
    text_symbol(text, name);
    text_add(text, " = ");
    const double value = making->table.values[column];
    number_write(text, value, note_digits);
    const struct scaled_unit unit = unit_for(making->table.heads[column].unit, 1, false);
    text_printf(text, " %s", unit.name);
    if (!plotting->constant) {
        document_paragraph(making->document, "Constant during the run, and not plotted:");
        plotting->constant = document_list(making->document);
    }
    document_cell(making->document, plotting->constant, making_take(making));
}

/* Those of one unit in one plot; `seen` marks those that have been drawn or listed. */
static void add_plots(struct making *making, struct plotting *plotting)
{
    const bool rates = plotting->rates;
    const size_t count = fbd_model_coordinate_count(making->model);
    bool *seen = ARENA_ARRAY(&making->document->arena, count + 1, bool);
    for (size_t i = 0; seen && i < count && plotting->made < most_plots; i++) {
        size_t columns[most_in_plot], drawn = 0;
        const fbd_coordinate first = fbd_model_coordinate(making->model, i);
        for (size_t k = i; k < count && drawn < most_in_plot; k++) {
            const fbd_coordinate c = fbd_model_coordinate(making->model, k);
            if (seen[k] || strcmp(unit_of(&c, rates), unit_of(&first, rates)) != 0) continue;
            const size_t column = column_of(making, rates ? c.rate_name : c.name);
            seen[k] = true;
            if (column > 0 && varies(making, column)) columns[drawn++] = column;
        }
        if (drawn == 0) continue;
        add_plot(making, columns, drawn);
        plotting->made++;
    }
}

static void list_constants(struct making *making, struct plotting *plotting)
{
    for (size_t i = 0; i < fbd_model_coordinate_count(making->model); i++) {
        const fbd_coordinate c = fbd_model_coordinate(making->model, i);
        const size_t column = column_of(making, plotting->rates ? c.rate_name : c.name);
        if (column > 0 && !varies(making, column)) add_constant(making, plotting, &c, column);
    }
}

void note_plots(struct making *making)
{
    struct plotting plotting = {.made = 0};
    if (making->table.rows < 2) return;
    document_heading(making->document, 3, "Plots");
    for (int rates = 0; rates < 2; rates++) {
        plotting.rates = rates;
        add_plots(making, &plotting);
    }
    for (int rates = 0; rates < 2; rates++) {
        plotting.rates = rates;
        list_constants(making, &plotting);
    }
}
