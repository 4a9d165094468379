/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A grade as text and as JSON.
 */
#include <string.h>

#include "base/text.h"
#include "fbd_grade.h"
#include "grade/grade.h"

static char *finish(struct text *text)
{
    if (text->failed) text_free(text);
    return text->data;
}

static void write_name(struct text *text, const fbd_finding *finding)
{
    text_shown(text, finding->body);
    if (*finding->body && *finding->name) text_add(text, ": ");
    if (*finding->name) text_add(text, "`");
    text_shown(text, finding->name);
    if (*finding->name) text_add(text, "`");
    if (*finding->body || *finding->name) text_add(text, ": ");
}

static void write_points(struct text *text, const fbd_finding *finding)
{
    if (finding->most == 0 && finding->points == 0) {
        text_printf(text, "  %11s  ", "");
        return;
    }
    if (finding->most > 0)
        text_printf(text, "  %4.4g of %4.4g  ", finding->points, finding->most);
    else
        text_printf(text, "  %4.4g %7s", finding->points, "");
    if (finding->most == 0) text_add(text, " ");
}

/* Lines of a detail, each under its finding. */
static void write_detail(struct text *text, const char *detail)
{
    while (*detail) {
        size_t blanks = strspn(detail, " "), length = strcspn(detail, "\n");
        if (length > blanks) {
            text_printf(text, "%17s", "");
            struct text line = {0};
            text_add_bytes(&line, detail + blanks, length - blanks);
            text_shown(text, line.data ? line.data : "");
            if (line.failed) text->failed = true;
            text_free(&line);
            text_add(text, "\n");
        }
        detail += length + (detail[length] == '\n');
    }
}

char *fbd_grade_text(const fbd_grade *grade, bool details)
{
    struct text text = {0};
    if (!grade) return NULL;
    text_shown(&text, grade->student);
    text_printf(&text, ": %.4g of %.4g points%s\n", grade->points, grade->key->most,
                fbd_grade_passed(grade) ? ", passed" : "");
    for (const struct finding *one = grade->first; one; one = one->next) {
        write_points(&text, &one->finding);
        if (one->finding.line > 0) text_printf(&text, "line %d: ", one->finding.line);
        write_name(&text, &one->finding);
        text_shown(&text, one->finding.message);
        text_add(&text, "\n");
        if (details) write_detail(&text, one->finding.detail);
    }
    return finish(&text);
}

static void write_finding(struct text *text, const fbd_finding *finding, bool details)
{
    struct text name = {0};
    text_printf(&name, "%s%s%s", finding->body, *finding->body && *finding->name ? ": " : "", finding->name);
    text_add(text, "{");
    text_json_words(text, "name", name.data ? name.data : "", ", ");
    text_json_words(text, "kind", fbd_finding_kind_name(finding->kind), ", ");
    text_json_member(text, "points", finding->points, ", ");
    text_json_member(text, "max_points", finding->most, ", ");
    text_printf(text, "\"line\": %d, \"column\": %d, ", finding->line, finding->column);
    text_json_words(text, "message", finding->message, details ? ", " : "}");
    if (details) text_json_words(text, "output", finding->detail, "}");
    if (name.failed) text->failed = true;
    text_free(&name);
}

char *fbd_grade_json(const fbd_grade *grade, bool details)
{
    struct text text = {0};
    if (!grade) return NULL;
    bool gradable = grade->submitted && grade->readable;
    text_add(&text, "{");
    text_json_words(&text, "student", grade->student, ", ");
    text_json_words(&text, "file", grade->file, ", ");
    text_json_flag(&text, "gradable", gradable, ", ");
    text_json_member(&text, "score", grade->points / grade->key->most, ", ");
    text_json_member(&text, "points", grade->points, ", ");
    text_json_member(&text, "max_points", grade->key->most, ", ");
    text_json_flag(&text, "passed", fbd_grade_passed(grade), ", ");
    text_json_words(&text, "message", gradable || !grade->first ? "" : grade->first->finding.message,
                    ",\n \"tests\": [");
    for (const struct finding *one = grade->first; one; one = one->next) {
        text_add(&text, one == grade->first ? "\n  " : ",\n  ");
        write_finding(&text, &one->finding, details);
    }
    text_add(&text, grade->first ? "\n ]}" : "]}");
    return finish(&text);
}
