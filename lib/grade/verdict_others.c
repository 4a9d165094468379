/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies and couplings that only the answer has, or only the key.
 */
#include <string.h>

#include "fbd_grade.h"
#include "grade/verdict.h"

static const struct pos nowhere = {0, 0};

static bool near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance * fmax(fabs(a), fabs(b));
}

static bool has_body(const fbd_model *model, const char *name)
{
    for (size_t b = 0; b < fbd_model_body_count(model); b++)
        if (strcmp(fbd_model_body_name(model, b), name) == 0) return true;
    return false;
}

/* ---- connections: couplings and contacts, and those that exert a force */

static bool exerts_force(const fbd_connection *connection)
{
    static const char *const kinds[] = {"spring", "damper", "actuator"};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (strcmp(connection->kind, kinds[k]) == 0) return true;
    return false;
}

static const char *end_name(const fbd_model *model, int body)
{
    return body == FBD_GROUND ? "" : fbd_model_body_name(model, (size_t)body);
}

static bool same_end(const fbd_model *key, const fbd_connection_end *a, const fbd_model *answer,
                     const fbd_connection_end *b)
{
    const struct vec point = vec_of(a->point);
    return strcmp(end_name(key, a->body), end_name(answer, b->body)) == 0 && a->whole == b->whole &&
           a->center == b->center &&
           vec_norm(vec_sub(point, vec_of(b->point))) <= 1e-6 * (1e-3 + vec_norm(point)) &&
           near(a->radius, b->radius, 1e-6) && a->wound == b->wound &&
           (a->spare == b->spare || near(a->spare, b->spare, 1e-6));
}

static bool same_connection(const fbd_model *key, const fbd_connection *a, const fbd_model *answer,
                            const fbd_connection *b)
{
    const bool given = !isnan(a->length);
    if (strcmp(a->kind, b->kind) != 0 || a->friction != b->friction || a->end_count != b->end_count)
        return false;
    if (given != !isnan(b->length) || (given && !near(a->length, b->length, 1e-6))) return false;
    if (!near(a->stiffness, b->stiffness, 1e-6) || !near(a->coefficient, b->coefficient, 1e-6) ||
        !near(a->free_length, b->free_length, 1e-6))
        return false;
    for (size_t n = 0; n < a->end_count; n++)
        if (!same_end(key, &a->ends[n], answer, &b->ends[n])) return false;
    return true;
}

/* The number of the first `count` of a model that are like number `index` of another one. */
static size_t like(const fbd_model *model, size_t count, const fbd_model *of, size_t index)
{
    const fbd_connection one = fbd_model_connection(of, index);
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        const fbd_connection other = fbd_model_connection(model, i);
        found += same_connection(of, &one, model, &other);
    }
    return found;
}

/* True if number `index` of a model exceeds the number of its like in the other model. */
static bool is_more(const fbd_model *model, size_t index, const fbd_model *other)
{
    return like(model, index + 1, model, index) >
           like(other, fbd_model_connection_count(other), model, index);
}

static void compare_connections(struct fbd_grade *grade, const fbd_model *key, const fbd_model *answer,
                                bool forces)
{
    const char *lost = "a coupling of the sheet is not in the answer, or was changed",
               *more = "it is not on the sheet";
    size_t changed = 0; /* number of the answer's that are changed ones of the sheet */
    for (size_t i = 0; i < fbd_model_connection_count(key); i++) {
        const fbd_connection one = fbd_model_connection(key, i);
        if (exerts_force(&one) != forces || !is_more(key, i, answer)) continue;
        changed++;
        verdict_superfluous(grade, FBD_FINDING_MOTION, "", one.name, nowhere, lost);
    }
    for (size_t i = 0; i < fbd_model_connection_count(answer); i++) {
        const fbd_connection one = fbd_model_connection(answer, i);
        if (exerts_force(&one) != forces || !is_more(answer, i, key) || (changed > 0 && changed--)) continue;
        verdict_superfluous(grade, FBD_FINDING_SUPERFLUOUS, "", one.name, (struct pos){one.line, one.column},
                            more);
    }
}

/* Connections are given with the sheet: report those that were changed. */
static void compare_all(struct fbd_grade *grade, const fbd_model *answer)
{
    if (strcmp(fbd_model_scene(grade->sheet).units, fbd_model_scene(answer).units) != 0) return;
    compare_connections(grade, grade->sheet, answer, false);
    compare_connections(grade, grade->sheet, answer, true);
}

void verdict_on_others(struct fbd_grade *grade, const fbd_model *answer)
{
    for (size_t b = 0; b < fbd_model_body_count(answer); b++) {
        const fbd_body body = fbd_model_body(answer, b);
        if (!has_body(grade->sheet, body.name))
            verdict_superfluous(grade, FBD_FINDING_BODY, body.name, "", (struct pos){body.line, body.column},
                                "the body is not on the sheet");
    }
    compare_all(grade, answer);
}
