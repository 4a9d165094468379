/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Conversion of a double to its shortest decimal, in exact integer arithmetic.
 *
 * A double of moderate size is m 2^e; multiplied by a power of ten it is a ratio of two integers below 2^127.
 * Its digits, and whether fewer of them read back as the same double, are computed in integers: faster than
 * printf and strtod, and independent of the locale. For other doubles the caller uses printf.
 */
#ifndef FBD_BASE_DTOA_SHORTEST_H
#define FBD_BASE_DTOA_SHORTEST_H

#include <stdint.h>

enum { dtoa_size = 40 };

/* Write `value` as %.15g, %.16g or %.17g in the C locale, the first of them that reads back as `value`.
 * Returns its length, or -1 for a number outside the supported range. */
int dtoa_shortest(char buffer[dtoa_size], double value);

/* Write `value` as %.*g with so many digits in the C locale. Returns its length, or -1 as above. */
int dtoa_rounded(char buffer[dtoa_size], double value, int digits);

#endif
