/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Allocation of small zeroed blocks, for objects that every run of a sweep creates anew.
 *
 * glibc reuses the blocks that a thread has freed in malloc, but not in calloc, which takes five times as long for a
 * small block.
 */
#ifndef FBD_BASE_BLOCK_ALLOC_H
#define FBD_BASE_BLOCK_ALLOC_H

#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* `size` zero bytes, to be freed with free(); NULL when memory is out. The additional byte keeps compilers from
 * replacing malloc and memset by calloc. */
static inline void *block_alloc(size_t size)
{
    enum { most_kept = 1024 };
    if (size > most_kept) return calloc(1, size);
    void *block = malloc(size + 1);
    return block ? memset(block, 0, size) : NULL;
}

#endif
