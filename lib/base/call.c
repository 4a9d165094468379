/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/call.h"

void *call_refuse(fbd_errors *errors, const char *what)
{
    diag_add(errors, FBD_ERROR, "bad-call", (struct pos){0, 0}, NULL, "%s", what);
    return NULL;
}

bool call_has_texts(const char *const *texts, size_t count)
{
    if (count > 0 && !texts) return false;
    for (size_t i = 0; i < count; i++)
        if (!texts[i]) return false;
    return true;
}

bool call_has_settings(const fbd_setting *settings, size_t count)
{
    if (count > 0 && !settings) return false;
    for (size_t i = 0; i < count; i++)
        if (!settings[i].name || !settings[i].value) return false;
    return true;
}
