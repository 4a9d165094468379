/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A grade as text and as JSON.
 */
#include <string.h>

#include "base/text.h"
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

static void member(struct text *text, const char *name, const char *value, const char *behind)
{
    text_json_key(text, name);
    text_json_string(text, value);
    text_add(text, behind);
}

static void number(struct text *text, const char *name, double value, const char *behind)
{
    text_json_key(text, name);
    text_json_number(text, value);
    text_add(text, behind);
}

static void flag(struct text *text, const char *name, bool value, const char *behind)
{
    text_json_key(text, name);
    text_add(text, value ? "true" : "false");
    text_add(text, behind);
}

static void write_finding(struct text *text, const fbd_finding *finding, bool details)
{
    struct text name = {0};
    text_printf(&name, "%s%s%s", finding->body, *finding->body && *finding->name ? ": " : "", finding->name);
    text_add(text, "{");
    member(text, "name", name.data ? name.data : "", ", ");
    member(text, "kind", fbd_finding_kind_name(finding->kind), ", ");
    number(text, "points", finding->points, ", ");
    number(text, "max_points", finding->most, ", ");
    text_printf(text, "\"line\": %d, \"column\": %d, ", finding->line, finding->column);
    member(text, "message", finding->message, details ? ", " : "}");
    if (details) member(text, "output", finding->detail, "}");
    if (name.failed) text->failed = true;
    text_free(&name);
}

char *fbd_grade_json(const fbd_grade *grade, bool details)
{
    struct text text = {0};
    if (!grade) return NULL;
    bool gradable = grade->submitted && grade->readable;
    text_add(&text, "{");
    member(&text, "student", grade->student, ", ");
    member(&text, "file", grade->file, ", ");
    flag(&text, "gradable", gradable, ", ");
    number(&text, "score", grade->points / grade->key->most, ", ");
    number(&text, "points", grade->points, ", ");
    number(&text, "max_points", grade->key->most, ", ");
    flag(&text, "passed", fbd_grade_passed(grade), ", ");
    member(&text, "message", gradable || !grade->first ? "" : grade->first->finding.message,
           ",\n \"tests\": [");
    for (const struct finding *one = grade->first; one; one = one->next) {
        text_add(&text, one == grade->first ? "\n  " : ",\n  ");
        write_finding(&text, &one->finding, details);
    }
    text_add(&text, grade->first ? "\n ]}" : "]}");
    return finish(&text);
}
