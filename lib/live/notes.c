/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Notes on a model as JSON.
 */
#include "base/diag.h"
#include "base/json.h"
#include "fbd_export.h"

static void write_note(struct text *text, const fbd_error *error)
{
    if (!error) return;
    text_add(text, "{");
    json_text_member(text, "severity", error->severity == FBD_ERROR ? "error" : "warning");
    json_text_member(text, "id", error->id);
    json_text_member(text, "message", error->message);
    json_text_member(text, "hint", error->hint ? error->hint : "");
    text_printf(text, "\"line\":%d,\"column\":%d}", error->line, error->column);
}

char *fbd_errors_json(fbd_errors *errors)
{
    struct text text = {0};
    text_add(&text, "[");
    for (size_t i = 0; i < fbd_errors_count(errors); i++) {
        json_comma(&text, i);
        write_note(&text, diag_get(errors, i));
    }
    text_add(&text, "]");
    if (text.failed) text_free(&text);
    return text.data;
}
