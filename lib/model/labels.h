/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Labels: qualified names and units of coordinates, made once so that outputs need not build them.
 */
#ifndef FBD_MODEL_LABELS_H
#define FBD_MODEL_LABELS_H

#include "scene/scene.h"

struct label {
    const char *name, *rate_name, *acceleration_name; /* "block.x", "block.v", "v_dot" */
    const char *unit, *rate_unit, *acceleration_unit; /* "m", "m/s", "m/s^2"; "rad", ... */
    const char *force_unit;                           /* "N", "N*m" */
    const char *inertia_unit;                         /* "kg", "kg*m^2" */
};

struct own_label {
    const char *name;             /* "states.charge" */
    const char *unit, *rate_unit; /* "1" for a pure number */
};

/* A unit in a text: empty for a pure number. */
static inline const char *unit_word(const char *unit)
{
    return unit[0] == '1' && !unit[1] ? "" : unit;
}

/* One for each user state. */
const struct own_label *own_labels_make(struct arena *arena, const struct scene *scene);

/* One label for each coordinate of the scene, in `arena`; NULL when memory is out. */
const struct label *labels_make(struct arena *arena, const struct scene *scene);

#endif
