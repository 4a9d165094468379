/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The pieces of the report of a run, in full (report.c) and of a scene of many bodies in short (report_short.c).
 */
#ifndef FBD_OUTPUT_REPORT_H
#define FBD_OUTPUT_REPORT_H

#include "record/result.h"

/* Scenes of more bodies have the short report: in full it would fill several screens. */
enum { report_few_bodies = 12, report_digits = 9 };

/* What writes a run: columns are further apart with error bars. */
struct page {
    struct text *text;
    fbd_result *result;
    struct bars *bars; /* NULL without */
};

void report_event(const struct page *page, size_t index);
void report_early_end(const struct page *page);
void report_body_state(const struct page *page, struct fbd_state *state, size_t body);
void report_own_states(const struct page *page, const struct fbd_state *state);
void report_energy(const struct page *page);
void report_cost(const struct page *page);

/* With which values it ran; `most` of them. */
void report_parameters(const struct page *page, size_t most);

/* Totals, events by their kinds, some of the bodies, the largest forces, and what is left out. */
void report_short(const struct page *page);

#endif
