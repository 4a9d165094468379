/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/parts.h"

int parts_find(int count, bool (*meet)(const void *context, int i, int j), const void *context, int *part)
{
    int parts = 0;
    for (int i = 0; i < count; i++) part[i] = -1;
    for (int first = 0; first < count; first++) {
        if (part[first] >= 0) continue;
        part[first] = parts;
        for (bool grown = true; grown;) {
            grown = false;
            for (int i = 0; i < count; i++)
                for (int j = 0; j < count && part[i] == parts; j++) {
                    if (part[j] >= 0 || !meet(context, i, j)) continue;
                    part[j] = parts;
                    grown = true;
                }
        }
        parts++;
    }
    return parts;
}
