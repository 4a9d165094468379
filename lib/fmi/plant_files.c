/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plant: the files of an unpacked FMU, and models by them.
 */
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "base/file.h"
#include "base/format.h"
#include "fmi/plant.h"

/* A zero-terminated copy of `content`, which is freed. */
static char *terminate(char *content, size_t length, fbd_errors *errors)
{
    char *text = content ? malloc(length + 1) : NULL;
    if (content && !text) diag_out_of_memory(errors);
    if (text) {
        memcpy(text, content, length);
        text[length] = '\0';
    }
    free(content);
    return text;
}

/* Read a file of the resources; text and path are to be freed. */
static char *read_resource(const char *resources, const char *name, size_t *length, char **path,
                           fbd_errors *errors)
{
    struct text text = {0};
    text_printf(&text, "%s/%s", resources, name);
    if (text.failed) diag_out_of_memory(errors);
    *path = text.data;
    return text.failed ? NULL : file_text(text.data, length, errors);
}

bool plant_read_files(struct plant *plant, const char *resources, fbd_errors *errors)
{
    size_t length = 0;
    char *path = NULL, *settings = NULL;
    plant->text = read_resource(resources, "model.yaml", &plant->length, &plant->path, errors);
    if (plant->text) settings = read_resource(resources, "settings", &length, &path, errors);
    plant->settings_text = terminate(settings, length, errors);
    free(path);
    if (!plant->settings_text) return false;
    package_token(plant->text, plant->length, plant->settings_text, plant->token);
    if (package_settings_read(&plant->settings, plant->settings_text, resources)) return true;
    diag_add(errors, FBD_ERROR, "cannot-read", (struct pos){0, 0}, NULL, "`%s/settings` is not understood",
             resources);
    return false;
}

/* ---- models */

static bool is_own(const struct plant *plant, const double *values, size_t index)
{
    const fbd_parameter parameter = fbd_model_parameter(plant->first, index);
    return !parameter.derived && values[index] != parameter.value;
}

/* The settings of the FMU, then the changed values. */
static fbd_setting *list_settings(const struct plant *plant, const double *values, struct arena *arena,
                                  size_t *count)
{
    size_t most = plant->settings.count + plant->parameter_count;
    fbd_setting *list = ARENA_ARRAY(arena, most + 1, fbd_setting);
    if (!list) return NULL;
    for (*count = 0; *count < plant->settings.count; ++*count) list[*count] = plant->settings.list[*count];
    for (size_t i = 0; i < plant->parameter_count; i++) {
        char number[40];
        if (!is_own(plant, values, i)) continue;
        format_shortest(number, sizeof number, values[i]);
        const char *text = arena_text(arena, number, strlen(number));
        if (!text) return NULL;
        list[(*count)++] = (fbd_setting){fbd_model_parameter(plant->first, i).name, text};
    }
    return list;
}

fbd_model *plant_model(const struct plant *plant, const double *values, bool holds_inputs, fbd_errors *errors)
{
    struct arena arena = {0};
    size_t count;
    const fbd_setting *settings = list_settings(plant, values, &arena, &count);
    fbd_model *model = NULL;
    if (settings)
        model = fbd_model_parse(plant->text, plant->length, plant->path, settings, count, errors);
    else
        diag_out_of_memory(errors);
    arena_free(&arena);
    if (!model || !holds_inputs) return model;
    fbd_model *with = extra_model(model, errors);
    fbd_model_free(model);
    return with;
}
