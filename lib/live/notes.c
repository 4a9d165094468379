/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Notes on a model as JSON.
 */
#include "base/diag.h"
#include "base/json.h"
#include "fbd_export.h"

static void text_or_null(struct text *text, const char *name, const char *value)
{
    if (value)
        json_text_member(text, name, value);
    else
        text_printf(text, "\"%s\":null,", name);
}

static void write_fix(struct text *text, fbd_fix fix)
{
    json_key(text, "fix");
    if (!fix.replace) {
        text_add(text, "null");
        return;
    }
    text_printf(text, "{\"line\":%d,\"column\":%d,\"replace\":", fix.line, fix.column);
    text_json_string(text, fix.replace);
    text_add(text, ",\"with\":");
    text_json_string(text, fix.with);
    text_add(text, "}");
}

static void write_note(struct text *text, const fbd_error *error, fbd_fix fix)
{
    if (!error) return;
    text_add(text, "{");
    json_text_member(text, "severity", error->severity == FBD_ERROR ? "error" : "warning");
    json_text_member(text, "id", error->id);
    json_text_member(text, "message", error->message);
    text_or_null(text, "hint", error->hint);
    text_or_null(text, "see", fbd_errors_guide(error->id));
    text_or_null(text, "file", error->file);
    text_printf(text, "\"line\":%d,\"column\":%d,\"context_line\":%d,\"context_column\":%d,", error->line,
                error->column, error->context_line, error->context_column);
    write_fix(text, fix);
    text_add(text, "}");
}

char *fbd_errors_json(fbd_errors *errors)
{
    struct text text = {0};
    text_add(&text, "[");
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        json_comma(&text, i);
        write_note(&text, diag_get(errors, i), fbd_errors_fix(errors, i));
    }
    text_add(&text, "]");
    if (text.failed) text_free(&text);
    return text.data;
}
