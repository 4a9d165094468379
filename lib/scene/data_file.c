/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/data_file.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/number.h"
#include "expr/expr.h"
#include "expr/glyph.h"
#include "scene/span.h"

enum { most_columns = 10000, most_complaints = 20 };

/* ---- headings */

/* The text between the last `open` and the `close` behind it. */
static bool find_brackets(struct span whole, char open, char close, struct span *inside)
{
    size_t start = whole.length;
    while (start > 0 && whole.text[start - 1] != open) start--;
    const char *end = start > 0 ? memchr(whole.text + start, close, whole.length - start) : NULL;
    if (!end) return false;
    *inside = (struct span){whole.text + start, (size_t)(end - whole.text) - start};
    return true;
}

/* Split a heading into name and unit. A unit in parentheses counts only if it is a valid unit: they may hold
 * other words. */
struct heading heading_read(const char *text, size_t length)
{
    struct span whole = trim((struct span){text, length}), unit;
    struct unit read;
    bool found = find_brackets(whole, '[', ']', &unit);
    if (!found && find_brackets(whole, '(', ')', &unit)) {
        struct span inside = trim(unit);
        found = unit_parse(inside.text, inside.length, unit_si, NULL, (struct pos){0}, &read);
    }
    if (!found) return (struct heading){.name = whole.text, .name_length = whole.length};
    struct span name = trim((struct span){whole.text, (size_t)(unit.text - whole.text) - 1});
    unit = trim(unit);
    return (struct heading){name.text, unit.text, name.length, unit.length};
}

/* ---- lines and cells */

struct data_reader {
    struct span rest; /* the unread text */
    int line;         /* number of the line read last */
    int first;        /* the line after the headings */
    char separator;   /* ' ' for any number of blanks */
    size_t width;     /* number of cells of the first row */
    fbd_errors *errors;
    size_t complaints;
};

/* The next line; it ends with LF, CR LF or CR. */
static bool next_line(struct data_reader *reader, struct span *line)
{
    if (reader->rest.length == 0) return false;
    const char *start = reader->rest.text, *end = start + reader->rest.length, *stop = start;
    while (stop < end && *stop != '\n' && *stop != '\r') stop++;
    *line = (struct span){start, (size_t)(stop - start)};
    if (stop < end && *stop == '\r' && stop + 1 < end && stop[1] == '\n') stop++;
    if (stop < end) stop++;
    reader->rest = (struct span){stop, (size_t)(end - stop)};
    reader->line++;
    return true;
}

/* The first of `;`, tab, `,` that occurs outside of quotes; else a blank. */
static char separator_of(struct span line)
{
    static const char order[] = ";\t,";
    bool found[sizeof order] = {false}, quoted = false;
    for (size_t i = 0; i < line.length; i++) {
        if (line.text[i] == '"') quoted = !quoted;
        const char *c = quoted || !line.text[i] ? NULL : strchr(order, line.text[i]);
        if (c) found[c - order] = true;
    }
    for (size_t i = 0; order[i]; i++)
        if (found[i]) return order[i];
    return ' ';
}

/* The next cell of a line, without its quotes. */
static bool next_cell(char separator, struct span *line, struct span *cell)
{
    if (separator == ' ') *line = trim(*line);
    if (!line->text || (separator == ' ' && line->length == 0)) return false;
    bool quoted = false;
    size_t end = 0;
    for (; end < line->length; end++) {
        char c = line->text[end];
        if (c == '"') quoted = !quoted;
        if (!quoted && (c == separator || (separator == ' ' && is_blank(c)))) break;
    }
    *cell = trim((struct span){line->text, end});
    if (cell->length >= 2 && cell->text[0] == '"' && cell->text[cell->length - 1] == '"')
        *cell = trim((struct span){cell->text + 1, cell->length - 2});
    bool more = end < line->length;
    *line = more ? (struct span){line->text + end + 1, line->length - end - 1} : (struct span){NULL, 0};
    return true;
}

/* Read a number. With `;` or tabs as separators a comma is a decimal comma. */
static bool read_number(char separator, struct span cell, double *value)
{
    char plain[64];
    const char *comma = separator == ';' || separator == '\t' ? memchr(cell.text, ',', cell.length) : NULL;
    if (!comma || cell.length > sizeof plain) return number_read(cell.text, cell.length, value);
    memcpy(plain, cell.text, cell.length);
    plain[comma - cell.text] = '.';
    return number_read(plain, cell.length, value);
}

/* A row that contains a number is not a row of headings, even if other cells are malformed. */
static bool has_number(char separator, struct span line)
{
    struct span cell;
    double value;
    while (next_cell(separator, &line, &cell))
        if (read_number(separator, cell, &value)) return true;
    return false;
}

/* True if all rows from `line` on are numbers. The text of a file that is not a table is not shown in
 * messages: the author of the model may have no right to read it. */
static bool is_table(struct data_reader reader, struct span line)
{
    struct span cell;
    double value;
    do {
        struct span row = trim(line);
        if (row.length > 0 && row.text[0] == '#') continue;
        while (row.length > 0 && next_cell(reader.separator, &row, &cell))
            if (cell.length > 0 && !read_number(reader.separator, cell, &value)) return false;
    } while (next_line(&reader, &line));
    return true;
}

static struct pos place_of(const struct data_reader *reader, struct span line, const char *at)
{
    return glyph_pos(line.text, (size_t)(at - line.text), (struct pos){reader->line, 1});
}

/* ---- choice of columns */

struct titles {
    struct span cells[most_columns];
    size_t count;
    struct data_reader reader; /* state after the headings, with the line read last */
    struct span row;
};

/* If blanks separate cells, a unit is a cell of its own: append it to the preceding name. */
static void read_titles(char separator, struct span line, struct titles *titles)
{
    struct span cell, *last = NULL;
    while (titles->count < most_columns && next_cell(separator, &line, &cell)) {
        bool unit = separator == ' ' && cell.length && (cell.text[0] == '[' || cell.text[0] == '(');
        if (unit && last && last->text < cell.text && last->text[last->length - 1] != ']') {
            last->length = (size_t)(cell.text - last->text) + cell.length;
        } else {
            last = &titles->cells[titles->count++];
            *last = cell;
        }
    }
}

static struct span name_of(const struct heading *heading)
{
    return (struct span){heading->name, heading->name_length};
}

/* Number of headings equal to `wanted`, as a whole or by name; *index is the first. */
static size_t count_matches(const struct titles *titles, struct span wanted, bool whole, size_t *index)
{
    struct heading sought = heading_read(wanted.text, wanted.length);
    size_t matches = 0;
    for (size_t i = titles->count; i-- > 0;) {
        struct heading heading = heading_read(titles->cells[i].text, titles->cells[i].length);
        bool same = whole ? is_same(titles->cells[i], wanted) : is_same(name_of(&heading), name_of(&sought));
        if (!same) continue;
        matches++;
        *index = i;
    }
    return matches;
}

static void note_no_column(const struct titles *titles, const char *path, const char *wanted, struct pos at,
                           fbd_errors *errors)
{
    enum { most_named = 50 };
    const char *names[most_named];
    size_t count = 0;
    for (size_t i = 0; i < titles->count && count < most_named; i++) {
        const char *name = diag_hint(errors, "%.*s", (int)titles->cells[i].length, titles->cells[i].text);
        if (name && *name) names[count++] = name;
    }
    const char *hint = count && is_table(titles->reader, titles->row)
                           ? diag_nearest(errors, wanted, names, count)
                           : "columns have numbers, too: `x: 1`, `y: 2`";
    diag_add(errors, FBD_ERROR, "unknown-column", at, hint, "`%s` has no column `%.80s`", path, wanted);
}

static bool find_column(const struct titles *titles, const char *path, const char *wanted, struct pos at,
                        fbd_errors *errors, size_t *index)
{
    struct span name = trim((struct span){wanted, strlen(wanted)});
    size_t matches = count_matches(titles, name, true, index);
    if (matches == 0) matches = count_matches(titles, name, false, index);
    if (matches == 1) return true;
    if (matches > 1) {
        diag_add(errors, FBD_ERROR, "unknown-column", at, "give its number, as `x: 1`",
                 "`%s` has %zu columns called `%.80s`", path, matches, wanted);
        return false;
    }
    struct heading heading = heading_read(wanted, strlen(wanted));
    double place;
    if (number_read(heading.name, heading.name_length, &place) && place >= 1 && place <= most_columns &&
        place == (double)(size_t)place) {
        *index = (size_t)place - 1;
        return true;
    }
    note_no_column(titles, path, wanted, at, errors);
    return false;
}

/* ---- rows */

/* Note an error, up to most_complaints. `message` may be NULL, when memory is out. */
static void complain(struct data_reader *reader, struct pos at, const char *hint, const char *message)
{
    if (reader->complaints++ < most_complaints)
        diag_add(reader->errors, FBD_ERROR, "table-format", at, hint, "%s", message ? message : "");
}

/* True for a unit: instruments write a row of them. */
static bool is_unit(struct span cell)
{
    struct unit read;
    bool closed = cell.length > 2 && ((cell.text[0] == '[' && cell.text[cell.length - 1] == ']') ||
                                      (cell.text[0] == '(' && cell.text[cell.length - 1] == ')'));
    if (closed) cell = trim((struct span){cell.text + 1, cell.length - 2});
    return unit_parse(cell.text, cell.length, unit_si, NULL, (struct pos){0}, &read);
}

static void read_cell(struct data_reader *reader, struct span line, struct span cell, size_t column,
                      double *value)
{
    if (read_number(reader->separator, cell, value)) return;
    struct pos at = place_of(reader, line, cell.text);
    const char *hint = memchr(cell.text, ',', cell.length) ? "a decimal point is written `.`"
                                                           : "numbers are written as `0.5` and `-2e3`";
    if (reader->line == reader->first && is_unit(cell))
        hint = "units stand behind the names of the columns: `t [s]`";
    complain(reader, at, cell.length > 0 ? hint : NULL,
             diag_hint(reader->errors, "column %zu %s", column + 1,
                       cell.length > 0 ? "must hold a number" : "is empty here"));
}

/* Note a row with more cells than the first one: a decimal comma may have split a number. */
static void check_rest(struct data_reader *reader, struct span line, struct span rest, size_t count)
{
    struct span cell;
    const char *hint = reader->separator == ',' ? "a decimal point is written `.`" : NULL;
    for (; next_cell(reader->separator, &rest, &cell); count++) {
        if (count < reader->width || cell.length == 0) continue;
        complain(reader, place_of(reader, line, cell.text), hint,
                 diag_hint(reader->errors, "the row has more cells than the first one, %zu", reader->width));
        return;
    }
}

static bool read_row(struct data_reader *reader, struct span line, const size_t columns[2], double values[2])
{
    struct span rest = line, cell;
    size_t before = reader->complaints;
    int found = 0;
    for (size_t i = 0; found < 2 && next_cell(reader->separator, &rest, &cell); i++)
        for (int k = 0; k < 2; k++) {
            if (columns[k] != i) continue;
            read_cell(reader, line, cell, i, &values[k]);
            found++;
        }
    if (found < 2)
        complain(reader, (struct pos){reader->line, 1}, NULL,
                 diag_hint(reader->errors, "the row has no column %zu",
                           1 + (columns[0] > columns[1] ? columns[0] : columns[1])));
    else
        check_rest(reader, line, rest, 1 + (columns[0] > columns[1] ? columns[0] : columns[1]));
    return reader->complaints == before;
}

static bool grow(struct data_columns *columns, size_t *room)
{
    if (columns->count < *room) return true;
    size_t larger = *room ? 2 * *room : 256;
    for (int k = 0; k < 2; k++) {
        double *values = realloc(columns->values[k], larger * sizeof *values);
        if (!values) return false;
        columns->values[k] = values;
    }
    int *lines = realloc(columns->lines, larger * sizeof *lines);
    if (!lines) return false;
    columns->lines = lines;
    *room = larger;
    return true;
}

static bool read_rows(struct data_reader *reader, struct span line, const size_t which[2],
                      struct data_columns *columns)
{
    size_t room = 0;
    bool more = true;
    do {
        struct span row = trim(line);
        if (row.length == 0 || row.text[0] == '#') continue;
        double values[2] = {0};
        if (!read_row(reader, line, which, values)) continue;
        if (!grow(columns, &room)) {
            diag_out_of_memory(reader->errors);
            return false;
        }
        columns->lines[columns->count] = reader->line;
        for (int k = 0; k < 2; k++) columns->values[k][columns->count] = values[k];
        columns->count++;
    } while (more && (more = next_line(reader, &line)));
    return reader->complaints == 0;
}

/* ---- the file */

/* The first line that is neither empty nor a comment. */
struct opening {
    struct span line, remark; /* remark: the last `#` line before it; text NULL without one */
    int remark_line;
};

static bool open_rows(struct data_reader *reader, struct opening *opening)
{
    while (next_line(reader, &opening->line)) {
        struct span row = trim(opening->line);
        if (row.length == 0) continue;
        if (row.text[0] != '#') return true;
        opening->remark = (struct span){row.text + 1, row.length - 1};
        opening->remark_line = reader->line;
    }
    return false;
}

/* Find the headings; then `line` is the first row of numbers. */
static bool open_titles(struct data_reader *reader, struct opening *opening, struct titles *titles,
                        struct pos *titles_at)
{
    reader->separator = separator_of(opening->line);
    *titles_at = (struct pos){reader->line, 1};
    if (has_number(reader->separator, opening->line)) {
        struct span line = opening->line, cell;
        size_t cells = 0;
        while (next_cell(reader->separator, &line, &cell)) cells++;
        if (opening->remark.text) read_titles(separator_of(opening->remark), opening->remark, titles);
        if (titles->count != cells) titles->count = 0;
        reader->width = cells;
        titles_at->line = opening->remark_line;
        return true;
    }
    read_titles(reader->separator, opening->line, titles);
    reader->width = titles->count;
    bool any = open_rows(reader, opening);
    reader->first = reader->line;
    return any;
}

static bool choose_columns(const struct titles *titles, const char *path, const char *const wanted[2],
                           const struct pos wanted_at[2], fbd_errors *errors, size_t which[2])
{
    bool fine = true;
    for (size_t k = 0; k < 2; k++) {
        which[k] = k;
        if (wanted[k] && !find_column(titles, path, wanted[k], wanted_at[k], errors, &which[k])) fine = false;
    }
    if (!fine || which[0] != which[1]) return fine;
    diag_add(errors, FBD_ERROR, "unknown-column", wanted_at[1].line ? wanted_at[1] : wanted_at[0],
             "name both: `x: t`, `y: force`", "`x` and `y` are the same column");
    return false;
}

/* Choose the requested columns. Errors of the choice are errors of the model file. */
static bool find_columns(struct data_reader *reader, const struct titles *titles, const char *path,
                         const char *const wanted[2], const struct pos wanted_at[2], const char *model_file,
                         size_t which[2])
{
    const char *data_file = reader->errors->file;
    reader->errors->file = model_file;
    bool fine = choose_columns(titles, path, wanted, wanted_at, reader->errors, which);
    reader->errors->file = data_file;
    return fine;
}

static bool read_text(struct data_reader *reader, const char *path, const char *const wanted[2],
                      const struct pos wanted_at[2], const char *model_file, struct data_columns *columns)
{
    struct opening opening = {.remark_line = 0};
    struct titles *titles = calloc(1, sizeof *titles);
    struct pos at = {1, 1};
    size_t which[2] = {0, 1};
    if (!titles) {
        diag_out_of_memory(reader->errors);
        return false;
    }
    bool any = open_rows(reader, &opening) && open_titles(reader, &opening, titles, &at);
    titles->reader = *reader;
    titles->row = opening.line;
    if (!any)
        diag_add(reader->errors, FBD_ERROR, "table-format", at, NULL, "the file has no rows of numbers");
    bool fine = any && find_columns(reader, titles, path, wanted, wanted_at, model_file, which);
    for (size_t k = 0; fine && k < 2; k++) {
        columns->heading_at[k] = at;
        if (which[k] < titles->count)
            columns->found[k] = heading_read(titles->cells[which[k]].text, titles->cells[which[k]].length);
    }
    fine = fine && read_rows(reader, opening.line, which, columns);
    free(titles);
    return fine;
}

/* Check that the path is a regular file: a pipe, terminal or device would block. */
static bool is_plain_file(const char *path, struct pos at, fbd_errors *errors)
{
    struct stat info;
    bool missing = stat(path, &info) != 0;
    if (!missing && S_ISREG(info.st_mode)) return true;
    diag_add(errors, FBD_ERROR, "cannot-read", at,
             missing && at.line && !PATH_IS_ABSOLUTE(path) ? "the path starts where the model file lies"
                                                           : NULL,
             "cannot read `%s`: %s", path, missing ? strerror(errno) : "it is no plain file");
    return false;
}

void data_text_free(struct data_text *kept)
{
    free(kept->text);
    *kept = (struct data_text){NULL, NULL, 0};
}

static bool read_once(struct data_text *kept, const char *path, fbd_errors *errors)
{
    if (kept->path && strcmp(kept->path, path) == 0) return true;
    data_text_free(kept);
    kept->text = file_text(path, &kept->length, errors);
    kept->path = kept->text ? path : NULL;
    return kept->text != NULL;
}

bool data_file_read(const char *path, const char *const wanted[2], const struct data_places *places,
                    struct data_text *kept, fbd_errors *errors, struct data_columns *columns)
{
    const char *model_file = errors->file;
    bool fine = false;
    *columns = (struct data_columns){.count = 0};
    diag_reads(errors, path);
    if (!is_plain_file(path, places->file, errors)) return false;
    diag_in_file(errors, path);
    if (read_once(kept, path, errors)) {
        const char *text = kept->text;
        const size_t length = kept->length,
                     mark = length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
        struct data_reader reader = {.rest = {text + mark, length - mark}, .errors = errors};
        bool wide = length >= 2 && (memcmp(text, "\xFF\xFE", 2) == 0 || memcmp(text, "\xFE\xFF", 2) == 0);
        if (wide)
            diag_add(errors, FBD_ERROR, "table-format", (struct pos){1, 1}, "save it as UTF-8",
                     "the file is a text in UTF-16");
        fine = !wide && read_text(&reader, path, wanted, places->columns, model_file, columns);
    }
    errors->file = model_file;
    return fine;
}

void data_columns_free(struct data_columns *columns)
{
    for (int k = 0; k < 2; k++) free(columns->values[k]);
    free(columns->lines);
}
