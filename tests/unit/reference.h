/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Reference numbers by name: "A03.b_t_stop".
 *
 * A number holds when |got - value| <= max(relative |value|, absolute).
 */
#ifndef FBD_TESTS_REFERENCE_H
#define FBD_TESTS_REFERENCE_H

enum { reference_count = 184 };

struct reference {
    const char *name; /* case and quantity, as in the reference answers */
    double t;         /* when; NAN for what belongs to no time or to an event */
    double value, relative, absolute;
};

extern const struct reference references[reference_count];

/* Index of a number, or -1 when there is none of that name. */
int reference_find(const char *name);

#endif
