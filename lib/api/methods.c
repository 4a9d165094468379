/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Public interface: the methods of integration.
 */
#include <string.h>

#include "fbd_study.h"
#include "integrate/method.h"

size_t fbd_method_count(void)
{
    size_t count = 0;
    while (method_at(count)) count++;
    return count;
}

static fbd_method describe(const struct method *method)
{
    if (!method) return (fbd_method){.name = NULL};
    return (fbd_method){.name = method->name,
                        .description = method->description,
                        .order = method->order,
                        .implicit = method->implicit,
                        .multistep = method->multistep};
}

fbd_method fbd_method_get(size_t index)
{
    return describe(index < fbd_method_count() ? method_at(index) : NULL);
}

fbd_method fbd_method_find(const char *name)
{
    return describe(name ? method_find(name) : NULL);
}
