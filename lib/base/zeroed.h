/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Zeroed: small blocks for what is made anew in every run of a sweep.
 *
 * The C library of GNU keeps what a thread has freed at hand for malloc, and not for calloc, which takes five times as
 * long for a small block.
 */
#ifndef FBD_BASE_ZEROED_H
#define FBD_BASE_ZEROED_H

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* `size` bytes that are zero, to be freed; NULL when memory is out. The byte more keeps compilers from making calloc of
 * it. */
static inline void *zeroed(size_t size)
{
    enum { most_kept = 1024 };
    if (size > most_kept) return calloc(1, size);
    void *block = malloc(size + 1);
    return block ? memset(block, 0, size) : NULL;
}

#endif
