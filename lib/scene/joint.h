/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Joints: the ways in which a body moves relative to its parent, as rows of one table.
 *
 *     joint      coordinates    reference point O of the body        body frame
 *     slide      x              moves along a line, direction e      keeps its angle
 *     pivot      theta          is fixed on the parent: the axis     turns by theta
 *     particle   x, y           moves in the plane                   keeps its angle
 *     planar     x, y, theta    moves in the plane                   turns by theta
 *     weld                      is fixed on the parent               keeps its angle
 *     track      s              moves along a curve, tangent e(s)    keeps its angle or turns with e(s)
 *
 * The equation of motion of a length is the sum of forces along its direction, with the mass; that of an angle is
 * the sum of moments about the axis, with I_O, or where no point is fixed about G, with I_G.
 */
#ifndef FBD_SCENE_JOINT_H
#define FBD_SCENE_JOINT_H

#include "scene/loads.h"

/* A coordinate of a joint: its names, and those of its equation of motion. */
struct joint_coordinate {
    const char *name, *rate, *rate_alias;
    const char *acceleration, *acceleration_alias[2];
    bool angle;
    const char *inertia; /* "m", "I_O", "I_G" */
    const char *sum;     /* "sum of forces along x" */
};

/* The path of O in the frame of the parent where it is given: forces act along it, and its normal force across. */
enum joint_path { path_none, path_line, path_curve };

struct joint_type {
    const char *name;   /* in model files */
    const char *motion; /* of the body: "slides on a line" */
    int count;          /* of its coordinates */
    const struct joint_coordinate *coordinates;
    int angle;     /* the coordinate that is the angle of the body frame, or -1 */
    bool has_axis; /* it turns about O, which is fixed on the parent */
    enum joint_path path;
    const char *force;     /* name of its constraint force, "pin"; NULL without a constraint */
    const char *letter;    /* symbol of that force */
    bool prevents_turning; /* its only constraint is the couple that prevents a rotation */
};

/* The coordinates of a body in the plane, and its equations when it is cut free. */
extern const struct joint_coordinate free_coordinates[most_coordinates_of_a_body];

extern const struct joint_type joint_types[motion_kinds_count]; /* by enum motion_kind */

static inline const struct joint_type *motion_joint(const struct motion *motion)
{
    return &joint_types[motion->kind];
}

#endif
