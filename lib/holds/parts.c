/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/parts.h"

#include "base/disjoint_sets.h"

int parts_find(int count, bool (*meet)(const void *context, int i, int j), const void *context, int *part)
{
    int parts = 0;
    for (int i = 0; i < count; i++) part[i] = i;
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++)
            if (meet(context, i, j)) sets_join(part, i, j);
    for (int i = 0; i < count; i++) part[i] = sets_first(part, i);
    for (int i = 0; i < count; i++) part[i] = part[i] == i ? parts++ : part[part[i]];
    return parts;
}
