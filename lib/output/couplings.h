/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Couplings as text: the joined bodies, redundant rows, and the constraint drift of a run.
 */
#ifndef FBD_OUTPUT_COUPLINGS_H
#define FBD_OUTPUT_COUPLINGS_H

#include "record/result.h"

/* The section of --explain; `state` is settled. Empty without couplings. */
void couplings_explain(struct text *text, struct fbd_state *state);

/* The section of the report, and the member "couplings" of the JSON; empty without couplings that close
 * loops. */
void couplings_report(struct text *text, const fbd_result *result);
void couplings_json(struct text *text, const fbd_result *result);

#endif
