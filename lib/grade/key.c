/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The key with which answers are compared, and the parts of it that each student gets.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"
#include "fbd_grade.h"
#include "fbd_view.h"
#include "grade/grade.h"
#include "study/draws.h"

/* ---- values of a student */

static const char *draw_for_student(struct arena *arena, const fbd_grading *grading,
                                    const fbd_drawn_parameter *drawn, const char *student)
{
    const struct draw_place place = {.seed = 1,
                                     .member = hash_text(drawn->name, strlen(drawn->name)),
                                     .index = hash_text(student, strlen(student))};
    double value = draw(draw_uniform, drawn->low, drawn->high, place);
    /* So many digits of the larger limit: 20 to 40 deg in whole degrees. */
    double largest = fmax(fabs(drawn->low), fabs(drawn->high));
    double unit = pow(10, floor(log10(largest)) + 1 - grading->digits);
    double rounded = fmin(fmax(round(value / unit) * unit, drawn->low), drawn->high);
    const char *blank = *drawn->unit ? " " : "";
    return arena_printf(arena, "%.*g%s%s", grading->digits + 2, rounded, blank, drawn->unit);
}

const char *value_for_student(struct arena *arena, const struct fbd_key *key, const char *name,
                              const char *student)
{
    const fbd_grading *grading = &key->grading;
    for (size_t i = 0; i < key->set_count; i++)
        if (strcmp(key->set[i].name, name) == 0) return key->set[i].value;
    for (size_t i = 0; student && i < grading->draw_count; i++)
        if (strcmp(grading->draws[i].name, name) == 0)
            return draw_for_student(arena, grading, &grading->draws[i], student);
    return NULL;
}

size_t student_settings(struct arena *arena, const struct fbd_key *key, const char *student,
                        const struct node *root, fbd_setting **settings)
{
    const struct pair *pair = node_find(root, "parameters");
    const size_t most = fbd_model_parameter_count(key->model);
    size_t count = 0;
    *settings = ARENA_ARRAY(arena, most + 1, fbd_setting);
    for (size_t i = 0; *settings && pair && i < most; i++) {
        const char *name = fbd_model_parameter(key->model, i).name;
        const char *value =
            node_find(pair->value, name) ? value_for_student(arena, key, name, student) : NULL;
        if (value) (*settings)[count++] = (fbd_setting){.name = name, .value = value};
    }
    return count;
}

/* ---- reading */

size_t key_asks(const struct fbd_key *key, size_t b)
{
    size_t count = 0;
    for (size_t i = 0; i < key->asked_count[b]; i++) count += isnan(key->asked[b][i]) ? 0 : 1;
    return count;
}

void fbd_key_free(fbd_key *key)
{
    if (!key) return;
    fbd_model_free(key->model);
    free(key->source);
    arena_free(&key->arena);
    free(key);
}
