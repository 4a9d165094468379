/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The head of a note: file, version, day, hashes; at its end the text of the file.
 */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/number.h"
#include "note/note.h"

/* Seconds since 1970: SOURCE_DATE_EPOCH (reproducible-builds.org), else the present time. */
static time_t seconds_of_day(void)
{
    const char *given = getenv("SOURCE_DATE_EPOCH");
    double seconds;
    if (given && number_read(given, strlen(given), &seconds) && seconds >= 0 && seconds < 1e11)
        return (time_t)seconds;
    return time(NULL);
}

static void add_date(struct making *making, struct block *table)
{
    const time_t seconds = seconds_of_day();
    struct tm day;
    char text[32] = "";
    if (making->options->date)
        document_cell(making->document, table, making->options->date);
    else if (gmtime_r(&seconds, &day) && strftime(text, sizeof text, "%Y-%m-%d", &day) > 0)
        document_cell(making->document, table, text);
    else
        document_cell(making->document, table, "");
}

static void row(struct making *making, struct block *table, const char *name, const char *value)
{
    struct text shown = {0};
    text_shown(&shown, value ? value : "");
    document_cell(making->document, table, name);
    document_cell(making->document, table, shown.data ? shown.data : "");
    making->document->arena.failed |= shown.failed;
    text_free(&shown);
}

static void add_data_file(struct making *making, struct block *table, size_t index)
{
    const fbd_data_file file = fbd_model_data_file(making->model, index);
    struct arena *arena = &making->document->arena;
    row(making, table, arena_printf(arena, "Data of the table %s", file.table),
        arena_printf(arena, "%s, SHA-256 %s", file.path, fbd_model_data_hash(making->model, index)));
}

static void add_settings(struct making *making, struct block *table)
{
    const fbd_note_options *options = making->options;
    if (options->setting_count == 0) return;
    struct text *text = making_begin(making);
    for (size_t i = 0; i < options->setting_count; i++)
        text_printf(text, "%s%s = %s", i ? ", " : "", options->settings[i].name, options->settings[i].value);
    row(making, table, "Set for this run", making_take(making));
}

static const char *outcome(const struct making *making)
{
    switch (fbd_result_outcome(making->result)) {
    case FBD_STOPPED: return "stopped by an event of the file";
    case FBD_BROKEN: return "ended early, see the limits";
    default: return "complete";
    }
}

void note_identity(struct making *making)
{
    static const char *const heads[] = {"Item", "Value"};
    struct document *document = making->document;
    struct block *table = document_table(document, "identification", "lw", heads);
    const char *file = fbd_model_file(making->model);
    row(making, table, "Model file", !file ? "a text" : strcmp(file, "-") == 0 ? "standard input" : file);
    row(making, table, "SHA-256 of its text", document_take(document, fbd_model_hash(making->model)));
    for (size_t i = 0; i < fbd_model_data_file_count(making->model); i++) add_data_file(making, table, i);
    add_settings(making, table);
    row(making, table, "Program", arena_printf(&document->arena, "fbd %s", fbd_version()));
    document_cell(document, table, "Day");
    add_date(making, table);
    row(making, table, "Units", fbd_model_scene(making->model).units);
    document_cell(document, table, "Run");
    document_cell_format(document, table, "t = 0 to %s, %s, %lu event%s",
                         making_value(making, making->t, "s", note_digits), outcome(making),
                         making->stats.events, making->stats.events == 1 ? "" : "s");
    document_cell(document, table, "Prepared by");
    document_cell(document, table, "");
    document_cell(document, table, "Checked by");
    document_cell(document, table, "");
}

void note_file(struct making *making)
{
    enum { most_bytes = 60000 };
    size_t length = 0;
    const char *source = fbd_model_source(making->model, &length);
    document_heading(making->document, 2, "Appendix: the model file");
    if (length > most_bytes)
        document_paragraph(making->document,
                           "Its %zu bytes are not printed here; the hash above identifies it.", length);
    else
        document_verbatim(making->document, source, length);
}
