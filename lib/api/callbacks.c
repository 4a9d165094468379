/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: models whose inputs are computed by callbacks of the program, or set between steps.
 *
 * The file is read again with the values of the model. There such an input is a quantity behind the extended
 * vector (dynamics/world_refs.h), as positions in the world are, and no constant.
 */
#include <stdlib.h>
#include <string.h>

#include "api/input_slopes.h"
#include "base/api_check.h"
#include "base/file.h"
#include "dynamics/world_refs.h"
#include "fbd.h"

static bool are_callbacks(const fbd_callback *callbacks, size_t count)
{
    if (count > 0 && !callbacks) return false;
    for (size_t i = 0; i < count; i++)
        if (!callbacks[i].input) return false;
    return true;
}

static const char *nearest_input(const struct scene *scene, const char *name, struct arena *arena,
                                 fbd_errors *errors)
{
    const char **names = ARENA_ARRAY(arena, scene->parameter_count + 1, const char *);
    size_t count = 0;
    for (size_t i = 0; names && i < scene->parameter_count; i++)
        if (scene->parameters[i].input) names[count++] = scene->parameters[i].name;
    return count > 0 ? diag_nearest(errors, name, names, count) : "the file has no `inputs`";
}

/* Put the callbacks into the overrides of the parameters. */
static bool place_callbacks(const struct scene *scene, const fbd_callback *callbacks, size_t count,
                            struct override *parameters, struct arena *arena, fbd_errors *errors)
{
    for (size_t i = 0; i < count; i++) {
        size_t k = 0;
        while (k < scene->parameter_count &&
               !(scene->parameters[k].input && strcmp(scene->parameters[k].name, callbacks[i].input) == 0))
            k++;
        if (k == scene->parameter_count) {
            diag_add(errors, FBD_ERROR, "unknown-input", (struct pos){0, 0},
                     nearest_input(scene, callbacks[i].input, arena, errors),
                     "the file declares no input `%.40s`", callbacks[i].input);
            return false;
        }
        parameters[k].call =
            (struct input_call){callbacks[i].function, callbacks[i].context, !callbacks[i].function};
    }
    return true;
}

static bool has_functions(const fbd_callback *callbacks, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (callbacks[i].function) return true;
    return false;
}

static bool fits(const fbd_model *model, const fbd_callback *callbacks, size_t count, fbd_errors *errors)
{
    if (model->root) {
        api_refuse(errors, "a model made from a document has no callbacks: parse its text");
        return false;
    }
    if (plan_size(&model->plan) <= most_called_numbers || !has_functions(callbacks, count)) return true;
    api_refuse(errors, "a model with more than 500 coordinates, rates and user states has no callbacks");
    return false;
}

static struct scene *read_again(const fbd_model *model, const fbd_callback *callbacks, size_t count,
                                fbd_errors *errors)
{
    struct arena arena = {0};
    size_t overrides = 0;
    struct override *list = model_overrides(model, &arena, &overrides);
    const struct scene *scene = model->scene;
    struct scene *read = NULL;
    if (!list)
        diag_out_of_memory(errors);
    else if (place_callbacks(scene, callbacks, count, list + overrides - scene->parameter_count, &arena,
                             errors))
        read = scene_read(model->source, model->source_length, scene->file, list, overrides, scene, errors);
    arena_free(&arena);
    return read;
}

static fbd_model *with_callbacks(const fbd_model *model, const fbd_callback *callbacks, size_t count,
                                 fbd_errors *errors)
{
    diag_in_file(errors, model->scene->file);
    if (!fits(model, callbacks, count, errors)) return NULL;
    char *source = file_copy(model->source, model->source_length, errors);
    struct scene *scene = source ? read_again(model, callbacks, count, errors) : NULL;
    fbd_model *made = scene ? model_compile(scene, errors) : NULL;
    if (!made) {
        free(source);
        return NULL;
    }
    made->source = source;
    made->source_length = model->source_length;
    return made;
}

fbd_model *fbd_model_with_callbacks(const fbd_model *model, const fbd_callback *callbacks, size_t count,
                                    fbd_errors *list)
{
    struct diag_call call;
    fbd_errors *errors = diag_begin(&call, list);
    fbd_model *made = NULL;
    if (!model || !are_callbacks(callbacks, count))
        api_refuse(errors, "there is no model, or a callback has no input");
    else
        made = with_callbacks(model, callbacks, count, errors);
    diag_end(&call);
    return made;
}
