/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The shortest decimal of a number, in exact integers.
 *
 * A double of moderate size is m 2^e, and times a power of ten it is still a ratio of two integers below 2^127. So its
 * digits, and whether fewer of them read back as the same number, are decided by integer arithmetic, some twenty times
 * as fast as by printf and strtod, and without a locale. Numbers outside are left to those.
 */
#ifndef FBD_BASE_SHORTEST_H
#define FBD_BASE_SHORTEST_H

#include <stdint.h>

enum { shortest_size = 32 };

/* Write what %.15g, %.16g or %.17g writes in the C locale, the first of them that reads back as `value`. Returns its
 * length, or -1 for a number that is left to others. */
int shortest_write(char buffer[shortest_size], double value);

/* Write what %.*g with so many digits writes in the C locale. Returns its length, or -1 as above. */
int rounded_write(char buffer[shortest_size], double value, int digits);

#endif
