/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The last decomposition of each part of the indeterminate system (rest_system.h). A scene at rest decomposes
 * it at the same position in the same modes repeatedly. Bitwise equal input has the same results.
 */
#ifndef FBD_DYNAMICS_REST_MEMO_H
#define FBD_DYNAMICS_REST_MEMO_H

#include "numeric/qr.h"

struct rest_memo;

/* qr_decompose for part `which`; the result belongs to *memo, which is allocated if NULL. NULL when memory
 * is out. */
const struct qr *rest_memo_qr(struct rest_memo **memo, int which, size_t rows, size_t cols, const double *a);

void rest_memo_free(struct rest_memo *memo);

#endif
