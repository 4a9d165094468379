/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Findings: the points that an answer gets, and its errors.
 */
#include <string.h>

#include "base/text.h"
#include "fbd_grade.h"
#include "grade/grade.h"

static const char *copy(struct fbd_grade *grade, const char *text)
{
    const char *made = arena_text(&grade->arena, text, strlen(text));
    return made ? made : "";
}

fbd_finding *finding_add(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                         struct pos at)
{
    struct finding *made = ARENA_NEW(&grade->arena, struct finding);
    if (!made) return &grade->lost;
    made->finding = (fbd_finding){.kind = kind,
                                  .body = copy(grade, body),
                                  .name = copy(grade, name),
                                  .line = at.line,
                                  .column = at.column,
                                  .message = "",
                                  .detail = ""};
    if (grade->last)
        grade->last->next = made;
    else
        grade->first = made;
    grade->last = made;
    grade->count++;
    return &made->finding;
}

void finding_say(struct fbd_grade *grade, fbd_finding *finding, const char *message)
{
    finding->message = copy(grade, message);
}

void finding_tell(struct fbd_grade *grade, fbd_finding *finding, const char *detail)
{
    finding->detail = copy(grade, detail);
}

const fbd_error *first_error(fbd_errors *errors)
{
    const fbd_error *error;
    for (size_t i = 0; (error = diag_get(errors, i)) != NULL; i++)
        if (error->severity == FBD_ERROR) return error;
    return NULL;
}

void finding_of_error(struct fbd_grade *grade, fbd_finding_kind kind, const char *body, const char *name,
                      const fbd_error *error)
{
    struct text text = {0};
    fbd_finding *finding = finding_add(grade, kind, body, name, (struct pos){error->line, error->column});
    text_add(&text, error->message);
    if (error->hint) text_printf(&text, " (%s)", error->hint);
    if (text.failed) grade->arena.failed = true;
    finding_say(grade, finding, text.data ? text.data : "");
    text_free(&text);
}

const char *fbd_finding_kind_name(fbd_finding_kind kind)
{
    static const char *const names[] = {
        [FBD_FINDING_RIGHT] = "right",
        [FBD_FINDING_MISSING] = "missing",
        [FBD_FINDING_SUPERFLUOUS] = "superfluous",
        [FBD_FINDING_PLACE] = "place",
        [FBD_FINDING_DIRECTION] = "direction",
        [FBD_FINDING_SENSE] = "sense",
        [FBD_FINDING_MAGNITUDE] = "magnitude",
        [FBD_FINDING_UNIT] = "unit",
        [FBD_FINDING_COEFFICIENT] = "coefficient",
        [FBD_FINDING_INERTIA] = "inertia",
        [FBD_FINDING_REFERENCE_POINT] = "reference_point",
        [FBD_FINDING_MOTION] = "motion",
        [FBD_FINDING_BODY] = "body",
        [FBD_FINDING_UNREADABLE] = "unreadable",
        [FBD_FINDING_DERIVATION] = "derivation",
        [FBD_FINDING_NO_SUBMISSION] = "no_submission",
    };
    size_t index = (size_t)kind;
    return index < sizeof names / sizeof *names && names[index] ? names[index] : "";
}
