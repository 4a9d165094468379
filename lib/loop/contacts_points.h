/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The points of an impact: all touching points, each place once.
 */
#ifndef FBD_LOOP_CONTACTS_POINTS_H
#define FBD_LOOP_CONTACTS_POINTS_H

struct row;
struct run;

/* A speed of a row that is rounding: of the speeds that it is made of, and of the largest that contacts have seen. */
double contacts_no_speed(const struct run *run, const struct row *row);

#endif
