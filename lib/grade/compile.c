/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Models from trees: from the key and from answers with other entries, values and derivations.
 */
#include "document/document.h"
#include "grade/grade.h"

fbd_model *tree_compile(const struct node *root, const char *file, const fbd_setting *settings, size_t count,
                        bool hands, fbd_errors *errors)
{
    const struct fbd_document document = {.file = file, .root = root};
    return fbd_model_parse_document(&document, settings, count, hands, errors);
}

fbd_model *grade_compile(struct fbd_grade *grade, const struct node *root, const char *file, bool hands,
                         fbd_errors *errors)
{
    fbd_setting *settings;
    size_t count = student_settings(&grade->arena, grade->key, grade->student, root, &settings);
    if (grade->arena.failed) return NULL;
    return tree_compile(root, file, settings, count, hands, errors);
}

fbd_state *grade_start(const fbd_model *model)
{
    fbd_state *state = fbd_state_new_start(model);
    fbd_state_let_forces_act(state);
    fbd_state_settle(state);
    return state;
}

void grade_read_hands(struct fbd_grade *grade, const struct node *root, const char *const *names,
                      size_t name_count, fbd_take_derivation *take, void *context)
{
    const struct fbd_document document = {.file = grade->key->file, .root = root};
    fbd_setting *settings;
    size_t count = student_settings(&grade->arena, grade->key, grade->student, root, &settings);
    if (grade->arena.failed ||
        !fbd_document_derivations(&document, settings, count, grade->sheet, names, name_count, take, context))
        grade->arena.failed = true;
}
