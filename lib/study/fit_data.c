/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The measured data of a fit: a CSV text.
 */
#include <math.h>
#include <string.h>

#include "base/number.h"
#include "fbd_view.h"
#include "study/fit.h"

enum { most_columns = 200 };

/* A column of the file. */
struct data_column {
    enum { column_ignored, column_t, column_value, column_deviation } kind;
    size_t quantity; /* index into data.columns */
    double factor;   /* from its unit to that of the model */
    const char *unit;
};

struct csv {
    struct fit_data *data;
    struct arena *arena;
    const fbd_model *model;
    fbd_errors *errors;
    struct data_column columns[most_columns];
    size_t column_count;
    size_t room;
    double last; /* time of the last row */
    const char *next, *end, *line_start;
    int line;
};

static bool refuse(struct csv *csv, const char *at, const char *id, const char *hint, const char *message,
                   const char *text)
{
    const struct pos pos = {csv->line, at ? (int)(at - csv->line_start) + 1 : 0};
    diag_add(csv->errors, FBD_ERROR, id, pos, hint, message, text);
    return false;
}

/* ---- cells */

struct cell {
    const char *at;   /* in the text */
    const char *text; /* without blanks and quotes */
    bool last;        /* of its line */
};

/* The next cell of the line; NULL text when memory is out. */
static struct cell next_cell(struct csv *csv)
{
    const char *start = csv->next, *stop = start;
    const bool quoted = start < csv->end && *start == '"';
    if (quoted) {
        start = ++stop;
        while (stop < csv->end && *stop != '"' && *stop != '\n') stop++;
    } else {
        while (stop < csv->end && *stop != ',' && *stop != '\n') stop++;
    }
    csv->next = stop + (quoted && stop < csv->end && *stop == '"');
    while (start < stop && strchr(" \t\r", *start)) start++;
    while (start < stop && strchr(" \t\r", stop[-1])) stop--;
    while (csv->next < csv->end && *csv->next != ',' && *csv->next != '\n') csv->next++;
    const bool last = csv->next >= csv->end || *csv->next == '\n';
    if (csv->next < csv->end) csv->next++;
    return (struct cell){start, arena_text(csv->arena, start, (size_t)(stop - start)), last};
}

/* Begin the next line that is no comment. */
static void begin_line(struct csv *csv)
{
    csv->line++;
    for (; csv->next < csv->end && *csv->next == '#'; csv->line++) {
        const char *stop = memchr(csv->next, '\n', (size_t)(csv->end - csv->next));
        csv->next = stop ? stop + 1 : csv->end;
    }
    csv->line_start = csv->next;
}

/* ---- the header */

/* Cut `NAME [UNIT]` in two. */
static const char *cut_unit(char *text)
{
    char *bracket = strchr(text, '['), *end = text + strlen(text);
    if (!bracket || end[-1] != ']') return "";
    end[-1] = '\0';
    const char *unit = bracket + 1;
    while (bracket > text && bracket[-1] == ' ') bracket--;
    *bracket = '\0';
    return unit;
}

/* Cut off a sign of standard deviations behind a name. */
static bool cut_deviation(char *text)
{
    static const char *const signs[] = {"\xC2\xB1", "+-"};
    size_t length = strlen(text);
    for (size_t i = 0; i < sizeof signs / sizeof *signs; i++) {
        const size_t sign = strlen(signs[i]);
        if (length <= sign || strcmp(text + length - sign, signs[i]) != 0) continue;
        for (length -= sign; length && text[length - 1] == ' ';) length--;
        text[length] = '\0';
        return true;
    }
    return false;
}

/* The unit of a quantity; NULL for an unknown name. */
static const char *unit_of(const struct csv *csv, const char *name)
{
    for (size_t i = 0; i < fbd_model_coordinate_count(csv->model); i++) {
        const fbd_coordinate coordinate = fbd_model_coordinate(csv->model, i);
        if (strcmp(coordinate.name, name) == 0) return coordinate.unit;
        if (strcmp(coordinate.rate_name, name) == 0) return coordinate.rate_unit;
    }
    for (size_t i = 0; i < fbd_model_state_count(csv->model); i++)
        if (strcmp(fbd_model_state(csv->model, i).name, name) == 0)
            return fbd_model_state(csv->model, i).unit;
    return NULL;
}

static bool unknown(struct csv *csv, const char *at, const char *name)
{
    const fbd_coordinate first = fbd_model_coordinate(csv->model, 0);
    return refuse(csv, at, "unknown-column",
                  first.name ? diag_hint(csv->errors,
                                         "`t`, coordinates and rates, as `%s` and `%s`, and `states.name`",
                                         first.name, first.rate_name)
                             : NULL,
                  "a run has no quantity `%.80s` to compare", name);
}

/* The factor of a unit in the header, which must have the dimension of the quantity. */
static bool read_factor(struct csv *csv, const char *at, struct data_column *column, const char *unit)
{
    fbd_unit given, own;
    column->factor = 1;
    if (!unit[0]) return true;
    if (!fbd_unit_read(csv->model, unit, strlen(unit), &given))
        return refuse(csv, at, "bad-data", NULL, "`%.40s` is no unit", unit);
    const bool pure = !column->unit[0] || strcmp(column->unit, "1") == 0;
    if (pure || !fbd_unit_read(csv->model, column->unit, strlen(column->unit), &own))
        own = (fbd_unit){.factor = 1};
    if (given.mass != own.mass || given.length != own.length || given.time != own.time ||
        given.current != own.current || given.temperature != own.temperature)
        return refuse(csv, at, "bad-data", diag_hint(csv->errors, "the run has it in %s", column->unit),
                      "the unit `%.40s` does not fit", unit);
    column->factor = given.factor / own.factor;
    return true;
}

static size_t quantity_index(struct csv *csv, const char *name)
{
    struct fit_data *data = csv->data;
    for (size_t i = 0; i < data->column_count; i++)
        if (strcmp(data->columns[i], name) == 0) return i;
    data->columns[data->column_count] = name;
    return data->column_count++;
}

static bool read_head(struct csv *csv, const struct cell *cell)
{
    struct data_column *column = &csv->columns[csv->column_count];
    if (csv->column_count == most_columns)
        return refuse(csv, cell->at, "bad-data", NULL, "%s", "the data have too many columns");
    char *name = arena_text(csv->arena, cell->text, strlen(cell->text));
    if (!name) return false;
    const char *unit = cut_unit(name);
    const bool deviation = cut_deviation(name), first = csv->column_count++ == 0;
    if (first != (strcmp(name, "t") == 0))
        return refuse(csv, cell->at, "bad-data", "the header is `t`, then names of quantities",
                      first ? "the first column is `%.40s`, not `t`"
                            : "`%.40s` stands in the first column only",
                      name);
    column->unit = first ? "s" : unit_of(csv, name);
    if (!column->unit) return unknown(csv, cell->at, name);
    column->kind = first ? column_t : deviation ? column_deviation : column_value;
    if (!first) column->quantity = quantity_index(csv, name);
    for (size_t i = 0; i + 1 < csv->column_count; i++)
        if (csv->columns[i].kind == column->kind && csv->columns[i].quantity == column->quantity)
            return refuse(csv, cell->at, "bad-data", NULL, "the column `%.40s` stands twice", name);
    return read_factor(csv, cell->at, column, unit);
}

static bool has_column(const struct csv *csv, int kind, size_t quantity)
{
    for (size_t i = 0; i < csv->column_count; i++)
        if ((int)csv->columns[i].kind == kind && csv->columns[i].quantity == quantity) return true;
    return false;
}

/* Standard deviations for all or for none; without them one unit. */
static bool check_heads(struct csv *csv)
{
    struct fit_data *data = csv->data;
    if (data->column_count == 0)
        return refuse(csv, NULL, "bad-data", NULL, "%s", "the data have no column beside `t`");
    data->weighted = has_column(csv, column_deviation, 0);
    for (size_t i = 0; i < data->column_count; i++) {
        const char *unit = unit_of(csv, data->columns[i]);
        if (!(data->units[i] = arena_text(csv->arena, unit, strlen(unit)))) return false;
    }
    data->unit = data->weighted ? "" : data->units[0];
    for (size_t i = 0; i < data->column_count; i++) {
        if (!has_column(csv, column_value, i))
            return refuse(csv, NULL, "bad-data", NULL, "the values of `%.40s` are missing", data->columns[i]);
        if (has_column(csv, column_deviation, i) != data->weighted)
            return refuse(csv, NULL, "bad-data", "give a column `NAME +-` for each quantity, or for none",
                          "`%.40s` differs from the others in having standard deviations", data->columns[i]);
        if (!data->weighted && strcmp(data->units[i], data->unit) != 0)
            return refuse(csv, NULL, "bad-data",
                          "give the standard deviations of each quantity in a column `NAME +-`",
                          "`%.40s` has another unit than the first quantity: their residuals cannot be added",
                          data->columns[i]);
    }
    return true;
}

static bool read_header(struct csv *csv)
{
    begin_line(csv);
    for (bool more = true; more;) {
        struct cell cell = next_cell(csv);
        if (!cell.text || !read_head(csv, &cell)) return false;
        more = !cell.last;
    }
    return check_heads(csv);
}

/* ---- rows */

static bool read_cell(struct csv *csv, const struct cell *cell, double *value)
{
    *value = NAN;
    if (!cell->text[0]) return true;
    if (number_read(cell->text, strlen(cell->text), value) && isfinite(*value)) return true;
    return refuse(csv, cell->at, "bad-data", NULL, "`%.40s` is no number", cell->text);
}

static bool add_value(struct csv *csv, const struct fit_value *value)
{
    struct fit_data *data = csv->data;
    if (data->count == csv->room) {
        const size_t room = csv->room ? 2 * csv->room : 256;
        struct fit_value *larger = ARENA_ARRAY(csv->arena, room, struct fit_value);
        if (!larger) return false;
        if (data->count) memcpy(larger, data->values, data->count * sizeof *larger);
        data->values = larger;
        csv->room = room;
    }
    data->values[data->count++] = *value;
    return true;
}

static bool check_time(struct csv *csv, const struct cell *cell, double t)
{
    if (isnan(t)) return refuse(csv, cell->at, "bad-data", NULL, "%s", "the time is missing");
    if (t < 0)
        return refuse(csv, cell->at, "bad-data", "a run begins at t = 0", "the time `%.40s` is below 0",
                      cell->text);
    if (t < csv->last)
        return refuse(csv, cell->at, "bad-data", "sort the rows by time",
                      "the time `%.40s` is before that of the last row", cell->text);
    csv->last = t;
    return true;
}

static bool add_row(struct csv *csv, const struct cell *cells, const double *numbers)
{
    const double t = numbers[0] * csv->columns[0].factor;
    if (!check_time(csv, &cells[0], t)) return false;
    for (size_t i = 1; i < csv->column_count; i++) {
        if (csv->columns[i].kind != column_value || isnan(numbers[i])) continue;
        struct fit_value value = {t, numbers[i] * csv->columns[i].factor, 1, csv->columns[i].quantity};
        for (size_t k = 1; k < csv->column_count; k++) {
            if (csv->columns[k].kind != column_deviation || csv->columns[k].quantity != value.column)
                continue;
            value.deviation = numbers[k] * csv->columns[k].factor;
            if (!(value.deviation > 0))
                return refuse(csv, cells[k].at, "bad-data", NULL, "%s",
                              "a standard deviation must be above 0");
        }
        if (!add_value(csv, &value)) return false;
    }
    return true;
}

static bool read_row(struct csv *csv)
{
    double numbers[most_columns] = {NAN};
    struct cell cells[most_columns] = {{0}};
    begin_line(csv);
    for (size_t i = 0; i < csv->column_count; i++) {
        cells[i] = next_cell(csv);
        if (!cells[i].text || !read_cell(csv, &cells[i], &numbers[i])) return false;
        if (i == 0 && cells[i].last && !cells[i].text[0]) return true; /* an empty line */
        if (cells[i].last != (i + 1 == csv->column_count))
            return refuse(csv, cells[i].at, "bad-data", NULL, "%s",
                          cells[i].last ? "the row has fewer cells than the header"
                                        : "the row has more cells than the header");
    }
    return add_row(csv, cells, numbers);
}

bool fit_data_read(struct fit_data *data, struct arena *arena, const char *text, size_t length,
                   const char *name, const fbd_model *model, fbd_errors *errors)
{
    static const char mark[] = "\xEF\xBB\xBF"; /* some spreadsheets begin UTF-8 with it */
    struct csv csv = {
        .data = data, .arena = arena, .model = model, .errors = errors, .next = text, .end = text + length};
    *data = (struct fit_data){.columns = ARENA_ARRAY(arena, most_columns, const char *)};
    data->units = ARENA_ARRAY(arena, most_columns, const char *);
    if (!data->columns || !data->units) return false;
    diag_in_file(errors, name);
    if (length >= 3 && memcmp(text, mark, 3) == 0) csv.next += 3;
    if (memchr(text, '\0', length)) return refuse(&csv, NULL, "bad-data", NULL, "%s", "the data are no text");
    if (!read_header(&csv)) return false;
    while (csv.next < csv.end)
        if (!read_row(&csv)) return false;
    return true;
}
