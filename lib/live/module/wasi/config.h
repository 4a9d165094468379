/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * For the files of GSL in gsl_files, in place of the one that its configure makes: a C library of C17, and numbers of
 * IEEE 754 in registers of their own size.
 */
#ifndef FBD_WASI_CONFIG_H
#define FBD_WASI_CONFIG_H

#define VERSION                "2.7.1"
#define GSL_DISABLE_DEPRECATED 1
#define GSL_RANGE_CHECK        0
#define HAVE_C99_INLINE        1
#define HAVE_INLINE            1
#define HAVE_IEEE_COMPARISONS  1
#define HAVE_IEEE_DENORMALS    1
#define HAVE_PRINTF_LONGDOUBLE 0
#define GSL_COERCE_DBL(x)      (x)
#define DISCARD_POINTER(p)     ((void)(p))
#define RETURN_IF_NULL(x)                                                                                    \
    if (!(x)) return

#endif
