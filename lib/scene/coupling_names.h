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

/* Name each coupling that has no name. The loads must have been named. False, with a note, if a given name is
 * that of a force of a body or of an earlier coupling. */
bool couplings_name(struct reader *reader, struct coupling_name *names, size_t count);

#endif
