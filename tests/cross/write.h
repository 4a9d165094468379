/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A scene as a model file.
 */
#ifndef CROSS_WRITE_H
#define CROSS_WRITE_H

#include <stddef.h>

#include "scene.h"

enum { text_room = 60000 };

/* Length of the text; the run goes until `until`. */
size_t scene_write(const struct scene *scene, double until, char text[text_room]);

#endif
