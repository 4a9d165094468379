/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The eigenvalues of a matrix, as the motion that each stands for.
 */
#ifndef FBD_REST_EIGENVALUES_H
#define FBD_REST_EIGENVALUES_H

#include "fbd.h"
#include "fbd_study.h"

/* Of a size x size matrix, row by row, by frequency, the one with the positive imaginary part first. 1 found, 0 the iteration
 * does not end or they are not finite, -1 out of memory. */
int eigenvalues_find(size_t size, const double *matrix, fbd_mode *modes);

#endif
