/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Models from trees: from the key and from answers with other entries, values and derivations.
 */
#include <stdlib.h>

#include "fbd_grade.h"
#include "grade/grade.h"
#include "output/hand_forces.h"

static struct override *overrides_of(const fbd_setting *settings, size_t count)
{
    struct override *overrides = calloc(count + 1, sizeof *overrides);
    for (size_t i = 0; overrides && i < count; i++)
        overrides[i] = (struct override){.name = settings[i].name, .value = settings[i].value};
    return overrides;
}

fbd_model *tree_compile(const struct node *root, const char *file, const fbd_setting *settings, size_t count,
                        bool hands, fbd_errors *errors)
{
    const struct document document = {.file = file,
                                      .root = root,
                                      .without_hands = !hands,
                                      .split_hands = hands};
    struct override *overrides = overrides_of(settings, count);
    fbd_model *model = overrides ? hands_compile(&document, overrides, count, errors) : NULL;
    if (!overrides) diag_out_of_memory(errors);
    free(overrides);
    return model;
}

fbd_model *grade_compile(struct fbd_grade *grade, const struct node *root, const char *file, bool hands,
                         fbd_errors *errors)
{
    fbd_setting *settings;
    size_t count = student_settings(&grade->arena, grade->key, grade->student, root, &settings);
    if (grade->arena.failed) return NULL;
    return tree_compile(root, file, settings, count, hands, errors);
}

void grade_read_hands(struct fbd_grade *grade, const struct node *root, const struct hand_reader *reader)
{
    struct document document = {.file = grade->key->file, .root = root, .hand_reader = reader};
    fbd_setting *settings;
    size_t count = student_settings(&grade->arena, grade->key, grade->student, root, &settings);
    struct override *overrides = settings ? overrides_of(settings, count) : NULL;
    fbd_errors *errors = fbd_errors_new();
    bool listed = hand_forces_list(grade->sheet, &grade->arena, &document);
    if (errors && overrides && listed && !grade->arena.failed)
        scene_free(scene_make(&document, overrides, count, errors));
    if (!errors || !overrides || !listed || errors->out_of_memory) grade->arena.failed = true;
    fbd_errors_free(errors);
    free(overrides);
}
