/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FBD_SCENE_COUPLING_NAMES_H
#define FBD_SCENE_COUPLING_NAMES_H

#include "scene/fields.h"
#include "scene/reader.h"

struct coupling_name {
    const char *name; /* NULL where the file gives none */
    const struct kind *kind;
    struct pos at;
    int body[2]; /* at its first and last end, or ground_body */
};

/* Give a name of its own to each coupling that has none. False, and noted, where a given one is taken by a
 * force of a body, the loads being named, or by an earlier coupling. */
bool couplings_name(struct reader *reader, struct coupling_name *names, size_t count);

#endif
