/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * How the frame of a body lies in the world where the file puts it, before couplings assemble it.
 */
#ifndef FBD_SCENE_START_ANGLE_H
#define FBD_SCENE_START_ANGLE_H

#include "scene/scene.h"

/* From the x axis of the world to that of the body, or of what carries it; 0 for the ground. All motions, parents and
 * initial values must have been read. */
double start_angle(const struct scene *scene, int body);

#endif
