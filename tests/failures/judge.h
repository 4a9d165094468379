/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a run in which a call has failed may have done, and nothing else: the whole of its work all the same,
 * or an end with exit code 1, one line that says why, and no traces.
 */
#ifndef FBD_TESTS_FAILURES_JUDGE_H
#define FBD_TESTS_FAILURES_JUDGE_H

#include "snapshot.h"

/* NULL when all is well, else what is wrong. `whole` is the undisturbed run; files that are not written are
 * as `before` (which all had before the run), or, for those of a sweep that can be gone on with, FILE.part
 * and its key. */
const char *judge(const struct snapshot *whole, const struct snapshot *run, const struct layer_page *page,
                  const struct piece *before);

#endif
