/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A run as a script for gnuplot that contains its data: one plot for each unit, one below the other, with
 * events as lines.
 */
#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"
#include "base/diag.h"
#include "base/gnuplot.h"
#include "dynamics/modes.h"
#include "fbd_export.h"
#include "output/display_units.h"
#include "output/run_record.h"
#include "output/words.h"

enum { digits = 10, most_events = 200, most_rows = gnuplot_most_rows };

/* The plotted columns of the record, those of one unit together. */
struct choice {
    const struct record *record;
    int *columns;
    size_t count;
    bool degrees; /* show angles and their rates in degrees */
};

/* ---- names of columns */

static bool is_shown(const struct record_column *column)
{
    return column->kind != quantity_pose && column->kind != quantity_term && column->kind != quantity_arrow;
}

static int find_column(const struct record *record, const char *name, size_t length)
{
    for (size_t c = 0; c < record->column_count; c++)
        if (is_shown(&record->columns[c]) && strlen(record->columns[c].name) == length &&
            memcmp(record->columns[c].name, name, length) == 0)
            return (int)c;
    return -1;
}

static void unknown_column(const struct record *record, const char *name, size_t length, fbd_errors *errors)
{
    const char **names = calloc(record->column_count, sizeof *names);
    const char *wrong = diag_hint(errors, "%.*s", (int)length, name);
    size_t count = 0;
    for (size_t c = 0; names && c < record->column_count; c++)
        if (is_shown(&record->columns[c])) names[count++] = record->columns[c].name;
    if (names && wrong)
        diag_add(errors, FBD_ERROR, "unknown-column", (struct pos){0, 0},
                 diag_nearest(errors, wrong, names, count), "there is no column `%s`", wrong);
    else
        diag_out_of_memory(errors);
    free(names);
}

/* Choose the columns of a list "block.v,block.friction"; returns false with a note for each unknown one. */
static bool choose_named(struct choice *choice, const char *list, fbd_errors *errors)
{
    bool found = true;
    for (const char *name = list;; name++) {
        size_t length = strcspn(name, ",");
        int column = find_column(choice->record, name, length);
        if (column < 0) {
            unknown_column(choice->record, name, length, errors);
            found = false;
        } else if (choice->count < choice->record->column_count) {
            choice->columns[choice->count++] = column;
        }
        name += length;
        if (!*name) return found;
    }
}

static void choose_usual(struct choice *choice)
{
    const struct record *record = choice->record;
    for (size_t c = 0; c < record->column_count; c++) {
        enum column_quantity kind = record->columns[c].kind;
        bool residual = (int)c == record->energy + 3;
        if (kind == quantity_coordinate || kind == quantity_own || (kind == quantity_energy && !residual))
            choice->columns[choice->count++] = (int)c;
    }
}

static bool has_columns(const fbd_model *model, const char *columns, fbd_errors *errors)
{
    struct record record = {.model = model};
    struct choice choice = {.record = &record};
    diag_in_file(errors, model->scene->file);
    record.probe = state_new(model);
    record.arrows = calloc(diagram_most_arrows(model), sizeof *record.arrows);
    bool done = record.probe && record.arrows && modes_settle(record.probe, NULL), found = false;
    if (done) state_evaluate(record.probe);
    done = done && record_define(&record, record.probe);
    if (done) choice.columns = calloc(record.column_count, sizeof *choice.columns);
    if (choice.columns)
        found = choose_named(&choice, columns, errors);
    else
        diag_out_of_memory(errors);
    free(choice.columns);
    record_free(&record);
    return found;
}

bool fbd_model_has_columns(const fbd_model *model, const char *columns, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    bool found = model && columns ? has_columns(model, columns, errors)
                                  : api_refuse(errors, "there is no model, or no list of columns") != NULL;
    diag_end(&call);
    return found;
}

/* ---- the script */

/* The displayed unit of a chosen column, and the divisor of its numbers. */
static struct display display_of_column(const struct choice *choice, size_t index)
{
    const struct record_column *column = &choice->record->columns[choice->columns[index]];
    const struct display display = {column->name, column->unit, 1};
    const bool moves = column->kind == quantity_coordinate || column->kind == quantity_rate;
    return moves ? display_in_degrees(display, choice->degrees) : display;
}

static bool is_thinned(const struct record *record)
{
    return record_is_thinned(record) || record->count > most_rows;
}

static void write_row(struct text *text, const struct choice *choice, size_t row)
{
    const struct record *record = choice->record;
    text_exact(text, record->times[row]);
    for (size_t k = 0; k < choice->count; k++) {
        text_add(text, " ");
        text_number(text,
                    record->rows[row * record->column_count + (size_t)choice->columns[k]] /
                        display_of_column(choice, k).size,
                    digits);
    }
    text_add(text, "\n");
}

static void write_data(struct text *text, const struct choice *choice)
{
    const struct record *record = choice->record;
    text_add(text, "$data << END\n");
    size_t step = 1 + record->count / most_rows;
    for (size_t row = 0; row < record->count; row++)
        if (row % step == 0 || record->kept[row]) write_row(text, choice, row);
    text_add(text, "END\n");
    if (!is_thinned(record)) return;
    text_add(text, "# least and greatest value of each column in pieces of the run\n$envelope << END\n");
    for (size_t k = 0; k < record->bucket_count; k++) {
        const float *cells = record->envelope + 2 * k * record->column_count;
        const float *first = cells + 2 * (size_t)choice->columns[0];
        if (!(first[0] <= first[1])) continue; /* no samples there */
        text_number(text, ((double)k + 0.5) * record->bucket, digits);
        for (size_t i = 0; i < choice->count; i++) {
            for (int end = 0; end < 2; end++) {
                text_add(text, " ");
                text_number(text,
                            (double)cells[2 * (size_t)choice->columns[i] + (size_t)end] /
                                display_of_column(choice, i).size,
                            digits);
            }
        }
        text_add(text, "\n");
    }
    text_add(text, "END\n");
}

static void write_events(struct text *text, const struct ensemble *run)
{
    for (size_t i = 0; i < run->event_count && run->event_count <= most_events; i++) {
        text_add(text, "set arrow from first ");
        text_number(text, run->events[i].t, digits);
        text_add(text, ", graph 0 to first ");
        text_number(text, run->events[i].t, digits);
        text_add(text, ", graph 1 nohead back linecolor 'gray' dashtype 2\n");
    }
}

/* Write the names of events vertically beside their lines, in the uppermost plot, if they are far enough
 * apart. */
static void write_event_names(struct text *text, const struct choice *choice, const struct ensemble *run)
{
    const struct record *record = choice->record;
    double apart = (record->times[record->count - 1] - record->times[0]) / 40, last = -HUGE_VAL;
    for (size_t i = 0; i < run->event_count && run->event_count <= most_events; i++) {
        const struct run_event *event = &run->events[i];
        const char *name = event_name(run->model, event), *kind = fbd_event_kind_name(event->kind);
        if (event->t - last < apart) continue;
        last = event->t;
        text_add(text, "set label ");
        gnuplot_quote(text, event->kind == FBD_EVENT_USER && name[0] ? name : kind);
        text_add(text, " noenhanced at first ");
        text_number(text, event->t, digits);
        text_add(text, ", graph 0.03 left rotate by 90 offset character -0.6,0 front textcolor 'gray30'\n");
    }
}

static const char *unit_of(const struct choice *choice, size_t index)
{
    return display_of_column(choice, index).unit;
}

/* True for the first column of its unit. */
static bool begins_plot(const struct choice *choice, size_t index)
{
    for (size_t k = 0; k < index; k++)
        if (strcmp(unit_of(choice, k), unit_of(choice, index)) == 0) return false;
    return true;
}

/* The common quantity of the columns of one unit; for a single column its name. */
static const char *axis_title(const struct choice *choice, size_t first, size_t count)
{
    const struct record_column *column = &choice->record->columns[choice->columns[first]];
    if (count == 1) return column->name;
    switch (column->kind) {
    case quantity_coordinate: return strcmp(column->unit, "rad") == 0 ? "angle" : "position";
    case quantity_rate: return strcmp(column->unit, "rad/s") == 0 ? "angular velocity" : "velocity";
    case quantity_acceleration: return "acceleration";
    case quantity_force:
        return strcmp(column->unit, "N") == 0 || strcmp(column->unit, "lbf") == 0 ? "force" : "moment";
    case quantity_work: return "work";
    case quantity_energy: return "energy";
    case quantity_own: return "state";
    case quantity_pose:
    case quantity_term:
    case quantity_arrow: break;
    }
    return "";
}

/* Reserve room for the legend within the plot, above the curves. */
static void write_axes(struct text *text, const struct choice *choice, size_t first)
{
    size_t count = 0;
    for (size_t k = first; k < choice->count; k++)
        count += strcmp(unit_of(choice, k), unit_of(choice, first)) == 0;
    size_t rows = (count + 2) / 3;
    text_printf(text, "set offsets 0, 0, graph %.2f, graph 0.04\nset ylabel ", 0.1 * (double)rows + 0.05);
    struct text title = {0};
    text_printf(&title, "%s [", axis_title(choice, first, count));
    gnuplot_unit(&title, unit_of(choice, first));
    text_add(&title, "]");
    text->failed |= title.failed;
    gnuplot_quote(text, title.data ? title.data : "");
    text_free(&title);
    text_add(text, " noenhanced\n");
}

static void write_plot(struct text *text, const struct choice *choice, size_t first)
{
    bool thinned = is_thinned(choice->record);
    write_axes(text, choice, first);
    const char *before = "plot ";
    for (size_t k = first, style = 1; k < choice->count; k++) {
        if (strcmp(unit_of(choice, k), unit_of(choice, first)) != 0) continue;
        text_add(text, before);
        if (thinned)
            text_printf(text,
                        "$envelope using 1:%zu:%zu with filledcurves fillstyle solid 0.3 noborder "
                        "linecolor %zu notitle, ",
                        2 * k + 2, 2 * k + 3, style);
        text_printf(text, "$data using 1:%zu with lines linecolor %zu title ", k + 2, style++);
        gnuplot_quote(text, choice->record->columns[choice->columns[k]].name);
        text_add(text, " noenhanced");
        before = ", \\\n     ";
    }
    text_add(text, "\n");
}

static void write_script(struct text *text, const struct choice *choice, const struct ensemble *run,
                         const char *file)
{
    size_t plots = 0;
    for (size_t k = 0; k < choice->count; k++) plots += begins_plot(choice, k);
    gnuplot_begin(text, file, plots);
    write_data(text, choice);
    gnuplot_layout(text, run->model->scene->title, plots, choice->record->times[0],
                   choice->record->times[choice->record->count - 1]);
    write_events(text, run);
    write_event_names(text, choice, run);
    for (size_t k = 0, plotted = 0; k < choice->count; k++) {
        if (!begins_plot(choice, k)) continue;
        if (plotted++ == 1 && run->event_count > 0) text_add(text, "unset label\n");
        write_plot(text, choice, k);
    }
    text_add(text, "unset multiplot\n");
}

static char *make_script(fbd_result *result, const char *file, const char *columns, fbd_errors *errors)
{
    const struct ensemble *run = result->simulation->ensemble;
    struct choice choice = {.record = result->record, .degrees = result->degrees};
    struct text text = {0};
    diag_in_file(errors, run->model->scene->file);
    if (!result->record) {
        diag_add(errors, FBD_ERROR, "not-recorded", (struct pos){0, 0}, "set `keep` in fbd_recording",
                 "the run was not recorded");
        return NULL;
    }
    choice.columns = calloc(result->record->column_count, sizeof *choice.columns);
    if (!choice.columns) {
        diag_out_of_memory(errors);
        return NULL;
    }
    bool found = true;
    if (columns)
        found = choose_named(&choice, columns, errors);
    else
        choose_usual(&choice);
    if (found) write_script(&text, &choice, run, file);
    free(choice.columns);
    if (found && text.failed) diag_out_of_memory(errors);
    if (text.failed) text_free(&text);
    return text.data;
}

char *fbd_result_gnuplot(fbd_result *result, const char *file, const char *columns, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    char *script =
        result ? make_script(result, file, columns, errors) : api_refuse(errors, "there is no result");
    diag_end(&call);
    return script;
}
