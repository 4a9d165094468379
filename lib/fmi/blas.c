/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The error exit of CBLAS. That of GSL's archive writes to a stream of the C library in a way that cannot be
 * linked into a shared object. It is never called, since GSL checks the arguments of its BLAS calls.
 */
#include <stdlib.h>

void cblas_xerbla(int p, const char *routine, const char *form, ...);

void cblas_xerbla(int p, const char *routine, const char *form, ...)
{
    (void)p;
    (void)routine;
    (void)form;
    abort();
}
