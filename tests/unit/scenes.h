/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Scenes that between them have every motion and every kind of load, for tests of what must hold for all of
 * them.
 */
#ifndef FBD_TESTS_SCENES_H
#define FBD_TESTS_SCENES_H

#include "fbd.h"

struct named_scene {
    const char *name, *text;
};

extern const struct named_scene all_scenes[];
extern const size_t all_scenes_count;

/* Parse a text that must be right; prints what is wrong and fails the test otherwise. */
fbd_model *model_from(const char *text);

#endif
