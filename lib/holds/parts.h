/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The connected parts of a graph.
 */
#ifndef FBD_HOLDS_PARTS_H
#define FBD_HOLDS_PARTS_H

#include <stdbool.h>

/* Number the connected parts of `count` nodes from 0; `meet` returns whether two nodes are coupled. Returns
 * the number of parts. */
int parts_find(int count, bool (*meet)(const void *context, int i, int j), const void *context, int *part);

#endif
