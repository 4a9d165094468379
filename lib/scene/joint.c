/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "scene/joint.h"

#define ANGLE(inertia, sum)                                                                                  \
    {                                                                                                        \
        "theta", "omega", "theta_dot", "omega_dot", {"alpha", "theta_ddot"}, true, inertia, sum              \
    }

static const struct joint_coordinate on_line[] = {
    {"x", "v", "x_dot", "v_dot", {"a", "x_ddot"}, false, "m", "sum of forces along x"}};
static const struct joint_coordinate on_curve[] = {
    {"s", "v", "s_dot", "v_dot", {"a", "s_ddot"}, false, "m", "sum of forces along the track"}};
static const struct joint_coordinate about_axis[] = {ANGLE("I_O", "sum of moments about O")};
const struct joint_coordinate free_coordinates[] = {
    {"x", "vx", "x_dot", "vx_dot", {"ax", "x_ddot"}, false, "m", "sum of forces along x"},
    {"y", "vy", "y_dot", "vy_dot", {"ay", "y_ddot"}, false, "m", "sum of forces along y"},
    ANGLE("I_G", "sum of moments about G")};

const struct joint_type joint_types[] = {
    [motion_slide] = {"slide", "slides on a line", 1, on_line, -1, false, path_line, "guide", "N", false},
    [motion_pivot] = {"pivot", "turns about an axis", 1, about_axis, 0, true, path_none, "pin", "R", false},
    [motion_particle] = {"particle", "moves in the plane as a particle", 2, free_coordinates, -1, false,
                         path_none, "guide", "M", true},
    [motion_planar] = {"planar", "moves in the plane", 3, free_coordinates, 2, false, path_none, NULL, "R",
                       false},
    [motion_weld] = {"weld", "is fixed on", 0, NULL, -1, false, path_none, "weld", "R", false},
    [motion_track] = {"track", "runs on a track", 1, on_curve, -1, false, path_curve, "guide", "N", false},
};
