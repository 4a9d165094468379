/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The points of an impact: all touching points, coincident ones once.
 */
#ifndef FBD_LOOP_CONTACTS_POINTS_H
#define FBD_LOOP_CONTACTS_POINTS_H

struct row;
struct run;

/* Round-off level of the velocity of a row, from the speeds of its points and the largest speed of contacts
 * so far. */
double contacts_no_speed(const struct run *run, const struct row *row);

#endif
