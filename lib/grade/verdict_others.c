/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bodies and couplings that only the answer has, or only the key.
 */
#include <string.h>

#include "base/text.h"
#include "fbd_grade.h"
#include "grade/verdict.h"

static const struct pos nowhere = {0, 0};

static bool near(double a, double b, double tolerance)
{
    return fabs(a - b) <= tolerance * fmax(fabs(a), fabs(b));
}

static bool has_body(const fbd_model *model, const char *name)
{
    for (size_t b = 0; b < model->body_count; b++)
        if (strcmp(model->bodies[b].name, name) == 0) return true;
    return false;
}

static const char *end_name(const struct scene *scene, int body)
{
    return body < 0 ? "" : scene->bodies[body].name;
}

static bool same_point(struct point a, struct point b)
{
    return a.kind == b.kind && vec_norm(vec_sub(a.where, b.where)) <= 1e-6 * (1e-3 + vec_norm(a.where));
}

static bool same_constraint(const struct scene *key, const struct constraint *a, const struct scene *answer,
                            const struct constraint *b)
{
    if (a->kind != b->kind || a->end_count != b->end_count || a->length_given != b->length_given)
        return false;
    if (a->length_given && !near(a->length, b->length, 1e-6)) return false;
    for (int i = 0; i < a->end_count; i++)
        if (strcmp(end_name(key, a->body[i]), end_name(answer, b->body[i])) != 0 ||
            (i < 2 && (a->wound[i] != b->wound[i] ||
                       !(a->spare[i] == b->spare[i] || near(a->spare[i], b->spare[i], 1e-6)))) ||
            !same_point(a->point[i], b->point[i]) || !near(a->radius[i], b->radius[i], 1e-6))
            return false;
    return true;
}

static bool same_coupling(const struct scene *key, const struct force_coupling *a, const struct scene *answer,
                          const struct force_coupling *b)
{
    for (int k = 0; k < 2; k++)
        if (strcmp(end_name(key, a->body[k]), end_name(answer, b->body[k])) != 0 ||
            !same_point(a->point[k], b->point[k]))
            return false;
    return a->load.kind == b->load.kind && near(a->load.stiffness, b->load.stiffness, 1e-6) &&
           near(a->load.coefficient, b->load.coefficient, 1e-6) &&
           near(a->load.free_length, b->load.free_length, 1e-6);
}

/* ---- connections, by number: constraints first, then couplings that exert a force */

static size_t joint_count(const struct scene *scene, bool forces)
{
    return forces ? scene->force_coupling_count : scene->constraint_count;
}

static bool same_joint(const struct scene *a, size_t i, const struct scene *b, size_t k, bool forces)
{
    return forces ? same_coupling(a, &a->force_couplings[i], b, &b->force_couplings[k])
                  : same_constraint(a, &a->constraints[i], b, &b->constraints[k]);
}

/* The number of the first `count` of a scene that are like number `index` of another one. */
static size_t joints_like(const struct scene *scene, size_t count, const struct scene *of, size_t index,
                          bool forces)
{
    size_t found = 0;
    for (size_t i = 0; i < count; i++) found += same_joint(of, index, scene, i, forces);
    return found;
}

/* True if number `index` of a scene exceeds the number of its like in the other scene. */
static bool is_joint_more(const struct scene *scene, size_t index, const struct scene *other, bool forces)
{
    return joints_like(scene, index + 1, scene, index, forces) >
           joints_like(other, joint_count(other, forces), scene, index, forces);
}

static void compare_joints(struct fbd_grade *grade, const struct scene *key, const struct scene *answer,
                           bool forces)
{
    const char *lost = "a coupling of the sheet is not in the answer, or was changed",
               *more = "it is not on the sheet";
    size_t changed = 0; /* number of the answer's that are changed ones of the sheet */
    for (size_t i = 0; i < joint_count(key, forces); i++) {
        if (!is_joint_more(key, i, answer, forces)) continue;
        const char *name = forces ? key->force_couplings[i].load.name : key->constraints[i].name;
        changed++;
        verdict_superfluous(grade, FBD_FINDING_MOTION, "", name, nowhere, lost);
    }
    for (size_t i = 0; i < joint_count(answer, forces); i++) {
        if (!is_joint_more(answer, i, key, forces) || (changed > 0 && changed--)) continue;
        const char *name = forces ? answer->force_couplings[i].load.name : answer->constraints[i].name;
        struct pos at = forces ? answer->force_couplings[i].load.at : answer->constraints[i].at;
        verdict_superfluous(grade, FBD_FINDING_SUPERFLUOUS, "", name, at, more);
    }
}

/* Couplings are given with the sheet: report those that were changed. */
static void compare_couplings(struct fbd_grade *grade, const struct scene *key, const struct scene *answer)
{
    if (key->units != answer->units) return;
    compare_joints(grade, key, answer, false);
    compare_joints(grade, key, answer, true);
}

void verdict_on_others(struct fbd_grade *grade, const fbd_model *answer)
{
    for (size_t b = 0; b < answer->body_count; b++)
        if (!has_body(grade->sheet, answer->bodies[b].name))
            verdict_superfluous(grade, FBD_FINDING_BODY, answer->bodies[b].name, "",
                                answer->bodies[b].source->at, "the body is not on the sheet");
    compare_couplings(grade, grade->sheet->scene, answer->scene);
}
