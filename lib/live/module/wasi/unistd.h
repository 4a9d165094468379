/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * unistd.h of WASI, with the function that is missing there and that the library calls for numbered files only.
 */
#pragma GCC system_header
#ifndef FBD_WASI_UNISTD_H
#define FBD_WASI_UNISTD_H

#include <errno.h>
#include_next <unistd.h>

#ifdef __wasi__
static inline int dup(int descriptor)
{
    (void)descriptor;
    errno = ENOTSUP;
    return -1;
}
#endif

#endif
