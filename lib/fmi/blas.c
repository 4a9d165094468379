/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The error exit of CBLAS. That of GSL's archive prints to a stream of the C library in a way that cannot be linked into
 * a shared object; GSL calls BLAS with arguments of its own, so nothing ever comes here.
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
