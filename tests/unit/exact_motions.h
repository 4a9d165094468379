/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Closed forms of models of the gallery: coordinates and rates as functions of time.
 */
#ifndef FBD_TESTS_EXACT_MOTIONS_H
#define FBD_TESTS_EXACT_MOTIONS_H

/* y: coordinates, then rates, at time t, with the values of the file. */
typedef void exact_motion(double t, double *y);

/* That of the model whose path ends in models/`name`; NULL when none is known. */
exact_motion *exact_motion_of(const char *path);

#endif
