/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The library against itself: a scene and the same scene said in another way.
 */
#ifndef CROSS_INVARIANCE_H
#define CROSS_INVARIANCE_H

#include "compare.h"
#include "variants.h"

/* `absolute`: the scene settled at its start. False when the scene has no such variant. */
bool scene_compare_variant(const struct scene *scene, const struct absolute *absolute, enum variant variant,
                           struct outcome *outcome);

#endif
