/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Distributed loads: how the resultant is distributed along the line.
 */
#ifndef FBD_SECTION_SPREAD_H
#define FBD_SECTION_SPREAD_H

#include "scene/loads.h"

enum { spread_most_ends = 1001 };

/* The part of the resultant per length at the distance s from the start of the line. */
double spread_density(const struct spread *spread, double s);

/* The ends of the intervals of s on which it is smooth; returns their number. */
size_t spread_ends(const struct spread *spread, double ends[spread_most_ends]);

#endif
