/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: simplifications of a scene.
 */
#include "api/simplify.h"

#include <stdlib.h>
#include <string.h>

#include "base/api_check.h"

static bool keep_start(fbd_simplifications *list)
{
    list->size = scene_size(list->model->scene);
    list->start = ARENA_ARRAY(&list->arena, list->size + 1, double);
    if (list->start && list->motion.count > 0)
        memcpy(list->start, list->motion.values, list->size * sizeof *list->start);
    return list->start != NULL;
}

static fbd_simplifications *simplify(const fbd_model *model, const fbd_motion *motion, fbd_errors *errors)
{
    fbd_simplifications *list = calloc(1, sizeof *list);
    bool made = list != NULL;
    if (made) {
        list->model = model;
        list->motion = *motion;
        made = keep_start(list) && simplify_list(list);
        list->motion = (fbd_motion){.count = 0};
    }
    if (made) return list;
    fbd_simplifications_free(list);
    diag_out_of_memory(errors);
    return NULL;
}

fbd_simplifications *fbd_simplify(const fbd_model *model, const fbd_motion *motion, fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_simplifications *simplifications = NULL;
    if (!model)
        api_refuse(errors, "there is no model");
    else if (!motion || (motion->count > 0 && (!motion->t || !motion->values)))
        api_refuse(errors, "there is no motion");
    else
        simplifications = simplify(model, motion, errors);
    diag_end(&call);
    return simplifications;
}

void fbd_simplifications_free(fbd_simplifications *simplifications)
{
    if (!simplifications) return;
    arena_free(&simplifications->arena);
    free(simplifications);
}

size_t fbd_simplifications_count(const fbd_simplifications *simplifications)
{
    return simplifications ? simplifications->count : 0;
}

fbd_simplification fbd_simplifications_get(const fbd_simplifications *simplifications, size_t index)
{
    return index < fbd_simplifications_count(simplifications) ? simplifications->items[index]
                                                              : (fbd_simplification){.body = NULL};
}

static fbd_model *make_model(const fbd_simplifications *simplifications, size_t index, fbd_errors *errors)
{
    struct edit edit = simplifications->edits[index];
    if (edit.refusal) {
        api_refuse(errors, edit.refusal);
        return NULL;
    }
    if (edit.kind == edit_linear_scene) return simplify_linear_scene(simplifications, &edit.about, errors);
    return model_variant(simplifications->model, simplify_edit, &edit, errors);
}

fbd_model *fbd_simplifications_model(const fbd_simplifications *simplifications, size_t index,
                                     fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_model *model = NULL;
    if (index < fbd_simplifications_count(simplifications))
        model = make_model(simplifications, index, errors);
    else
        api_refuse(errors, "there is no such simplification");
    diag_end(&call);
    return model;
}
