/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The initial angle of the frame of a body in the world, before couplings are assembled.
 */
#ifndef FBD_SCENE_START_ANGLE_H
#define FBD_SCENE_START_ANGLE_H

#include "scene/scene.h"

/* From the x axis of the world to that of the body, or of its parent; 0 for the ground. All motions, parents and
 * initial values must have been read. */
double start_angle(const struct scene *scene, int body);

#endif
