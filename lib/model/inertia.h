/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Mass, centre of mass and moment of inertia of a body from its parts.
 *
 * All moments of inertia are about axes perpendicular to the plane. Parts add up: m = sum m_k, m r_G = sum
 * m_k r_k, and by the parallel-axis theorem I_G = sum (I_k + m_k |r_k - r_G|^2). A hole is a part of negative
 * mass.
 */
#ifndef FBD_MODEL_INERTIA_H
#define FBD_MODEL_INERTIA_H

#include "scene/scene.h"

struct inertia {
    double mass;
    struct vec G; /* centre of mass in the body frame */
    double I_G;   /* about G */
};

/* Sum up `count` parts. The result may be unphysical (mass <= 0, I_G < 0) when holes outweigh the rest: the
 * caller checks. */
struct inertia inertia_of_parts(const struct part *parts, size_t count, struct vec pivot);

/* Parallel-axis theorem: the moment of inertia about `point` of the body frame. */
double inertia_about(const struct inertia *inertia, struct vec point);

#endif
