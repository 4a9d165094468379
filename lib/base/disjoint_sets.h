/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Disjoint sets of the numbers 0 ... n-1, with path halving (Tarjan and van Leeuwen, Journal of the ACM 31 (1984) 245). At
 * the start parent[i] = i.
 */
#ifndef FBD_BASE_DISJOINT_SETS_H
#define FBD_BASE_DISJOINT_SETS_H

/* The first number of the set of i. */
static inline int sets_first(int *parent, int i)
{
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

static inline void sets_join(int *parent, int a, int b)
{
    const int first = sets_first(parent, a), other = sets_first(parent, b);
    if (first < other)
        parent[other] = first;
    else
        parent[first] = other;
}

#endif
