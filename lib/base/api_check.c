/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/api_check.h"

#include <stdlib.h>
#include <string.h>

void *api_refuse(fbd_errors *errors, const char *what)
{
    diag_add(errors, FBD_ERROR, "bad-call", (struct pos){0, 0}, NULL, "%s", what);
    return NULL;
}

bool api_take_options(void *whole, size_t room, const void *given, fbd_errors *errors)
{
    enum { most = 4096 }; /* a larger size is uninitialised memory */
    size_t size = room;
    if (!given) return true;
    memcpy(&size, given, sizeof size);
    if (size == 0) size = room;
    bool known = size >= sizeof size && size <= most;
    for (size_t i = room; known && i < size; i++) known = ((const unsigned char *)given)[i] == 0;
    if (known) memcpy(whole, given, size < room ? size : room);
    if (!known) api_refuse(errors, "options of a size that is none, or with members that are not known here");
    return known;
}

void api_fill_options(void *options, size_t size, const void *defaults, size_t room)
{
    if (size < sizeof size) return;
    memset(options, 0, size);
    memcpy(options, defaults, size < room ? size : room);
    memcpy(options, &size, sizeof size);
}

void fbd_free(void *memory)
{
    free(memory);
}

bool api_has_texts(const char *const *texts, size_t count)
{
    if (count > 0 && !texts) return false;
    for (size_t i = 0; i < count; i++)
        if (!texts[i]) return false;
    return true;
}

bool api_has_settings(const fbd_setting *settings, size_t count)
{
    if (count > 0 && !settings) return false;
    for (size_t i = 0; i < count; i++)
        if (!settings[i].name || !settings[i].value) return false;
    return true;
}
