/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * SHA-256 (FIPS 180-4) of a text, as `sha256sum` prints it: identifies the model file and the data files of a result.
 */
#ifndef FBD_BASE_SHA256_H
#define FBD_BASE_SHA256_H

#include <stddef.h>

enum { sha256_size = 65 }; /* 64 hexadecimal digits and the terminating zero */

void sha256_text(const char *text, size_t length, char digits[static sha256_size]);

#endif
