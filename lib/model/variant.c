/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "model/variant.h"

#include <stdlib.h>

#include "base/text.h"

/* All parameters as text that reads back as the same number, in `arena`. */
static struct override *parameters_as_they_are(struct arena *arena, const struct scene *scene)
{
    struct override *overrides = ARENA_ARRAY(arena, scene->parameter_count + 1, struct override);
    for (size_t i = 0; overrides && i < scene->parameter_count; i++) {
        struct text text = {0};
        text_number(&text, scene->parameters[i].value, 17);
        if (!text.failed)
            overrides[i] = (struct override){.name = scene->parameters[i].name,
                                             .value = arena_text(arena, text.data, text.length),
                                             .call = scene->parameters[i].call};
        text_free(&text);
        if (!overrides[i].value) return NULL;
    }
    return overrides;
}

struct fbd_model *model_variant(const struct fbd_model *model, scene_edit *edit, void *context,
                                fbd_errors *errors)
{
    struct arena arena = {0};
    const struct override *overrides = parameters_as_they_are(&arena, model->scene);
    struct scene *scene = NULL;
    if (overrides)
        scene = scene_read(model->source, model->source_length, model->scene->file, overrides,
                           model->scene->parameter_count, model->scene, errors);
    else
        diag_out_of_memory(errors);
    arena_free(&arena);
    if (!scene) return NULL;
    edit(scene, context, errors);
    return model_compile(scene, errors);
}
