/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: models from files and texts, and what they contain.
 */
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "model/model.h"

enum { largest_file = 64 * 1024 * 1024 };

static void cannot_read(fbd_errors *errors, const char *path, const char *why)
{
    errors->file = diag_hint(errors, "%s", path);
    diag_add(errors, FBD_ERROR, "cannot-read", (struct pos){0, 0}, NULL, "cannot read the file: %s", why);
}

/* The whole of a stream, or NULL with *why. */
static char *read_stream(FILE *stream, size_t *length, const char **why)
{
    size_t room = 16384;
    char *text = NULL;
    *length = 0;
    for (;;) {
        char *more = realloc(text, room);
        if (!more) break;
        text = more;
        *length += fread(text + *length, 1, room - *length, stream);
        if (*length < room) {
            *why = ferror(stream) ? strerror(errno) : NULL;
            if (!*why) return text;
            free(text);
            return NULL;
        }
        if (room > largest_file) {
            free(text);
            *why = "it is larger than 64 MiB";
            return NULL;
        }
        room *= 2;
    }
    free(text);
    *why = "out of memory";
    return NULL;
}

/* `text` is taken over. */
static fbd_model *compile(char *text, size_t length, const char *name, const fbd_setting *settings,
                          size_t count, fbd_errors *errors)
{
    struct override *overrides = calloc(count + 1, sizeof *overrides);
    fbd_model *model = NULL;
    if (overrides) {
        for (size_t i = 0; i < count; i++)
            overrides[i] = (struct override){settings[i].name, settings[i].value};
        struct scene *scene = scene_read(text, length, name, overrides, count, errors);
        model = scene ? model_compile(scene, errors) : NULL;
    } else {
        diag_out_of_memory(errors);
    }
    free(overrides);
    if (!model) {
        free(text);
        return NULL;
    }
    model->source = text;
    model->source_length = length;
    return model;
}

fbd_model *fbd_model_parse(const char *text, size_t length, const char *name, const fbd_setting *settings,
                           size_t setting_count, fbd_errors *errors)
{
    char *copy = malloc(length + 1);
    if (!copy) {
        diag_out_of_memory(errors);
        return NULL;
    }
    memcpy(copy, text, length);
    return compile(copy, length, name, settings, setting_count, errors);
}

fbd_model *fbd_model_read(const char *path, const fbd_setting *settings, size_t setting_count,
                          fbd_errors *errors)
{
    bool standard = strcmp(path, "-") == 0;
    FILE *stream = standard ? stdin : fopen(path, "rb");
    if (!stream) {
        cannot_read(errors, path, strerror(errno));
        return NULL;
    }
    size_t length;
    const char *why = NULL;
    char *text = read_stream(stream, &length, &why);
    if (!standard) fclose(stream);
    if (!text) {
        cannot_read(errors, path, why);
        return NULL;
    }
    return compile(text, length, standard ? "<stdin>" : path, settings, setting_count, errors);
}

void fbd_model_free(fbd_model *model)
{
    model_free(model);
}

const char *fbd_model_title(const fbd_model *model)
{
    return model->scene->title;
}

size_t fbd_model_bodies(const fbd_model *model)
{
    return model->body_count;
}

const char *fbd_model_body_name(const fbd_model *model, size_t body)
{
    return model->bodies[body].name;
}

fbd_inertia fbd_model_inertia(const fbd_model *model, size_t body)
{
    const struct model_body *b = &model->bodies[body];
    bool pivot = b->kind == motion_pivot;
    return (fbd_inertia){.mass = b->inertia.mass,
                         .I_G = b->inertia.I_G,
                         .I_O = pivot ? b->I_O : 0,
                         .L = pivot ? b->L : 0,
                         .G = {b->inertia.G.x, b->inertia.G.y}};
}

size_t fbd_model_coordinates(const fbd_model *model)
{
    return model->scene->coordinate_count;
}

fbd_coordinate fbd_model_coordinate(const fbd_model *model, size_t index)
{
    const struct label *label = &model->labels[index];
    return (fbd_coordinate){.name = label->name,
                            .unit = label->unit,
                            .rate_name = label->rate_name,
                            .rate_unit = label->rate_unit,
                            .body = (size_t)model->scene->coordinates[index].body};
}

const char *fbd_version(void)
{
    return FBD_VERSION;
}
