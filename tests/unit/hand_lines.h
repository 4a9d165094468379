/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Lines of derivations in scenes, with the verdicts that they should get.
 */
#ifndef TESTS_HAND_LINES_H
#define TESTS_HAND_LINES_H

#include <stdbool.h>
#include <stddef.h>

struct hand_line {
    const char *scene; /* with %s for the line */
    const char *line;  /* an equation, or a mapping in braces */
    bool right;
    const char *says; /* a part of the verdict; NULL: any */
};

/* The verdict of fbd_check_hand, to be freed. */
char *hand_verdict(const char *scene, const char *line, size_t *differing);

/* How many of the lines get another verdict; each is printed. */
int hand_lines_wrong(const struct hand_line *lines, size_t count);

#endif
