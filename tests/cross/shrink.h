/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A failing scene made small: whatever can be left out, or be a simpler number, while it still fails.
 */
#ifndef CROSS_SHRINK_H
#define CROSS_SHRINK_H

#include <stdbool.h>

#include "scene.h"

/* Does the scene fail? It may bring velocities onto the couplings. */
typedef bool still_fails(void *context, struct scene *scene);

void scene_shrink(struct scene *scene, still_fails *fails, void *context);

#endif
