/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Plant: the files of an unpacked FMU.
 */
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "base/file.h"
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
