/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reference numbers of joined bodies: "B02.theta1_0.5".
 */
#ifndef FBD_TESTS_JOINED_REFERENCE_H
#define FBD_TESTS_JOINED_REFERENCE_H

struct joined_reference {
    const char *name;
    double t, value, relative, absolute;
};

extern const struct joined_reference joined_references[];
extern const int joined_reference_count;

#endif
