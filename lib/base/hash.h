/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Hash: 64 bits to distinguish texts. FNV-1a (Fowler, Noll & Vo; RFC 9923); no protection against deliberate
 * collisions.
 */
#ifndef FBD_BASE_HASH_H
#define FBD_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

static inline uint64_t hash_text(const char *text, size_t length)
{
    uint64_t hash = UINT64_C(0xCBF29CE484222325);
    for (size_t i = 0; i < length; i++) hash = (hash ^ (unsigned char)text[i]) * UINT64_C(0x100000001B3);
    return hash;
}

#endif
