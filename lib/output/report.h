/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The parts of the report of a run, in full (report.c) and in short for scenes of many bodies
 * (report_short.c).
 */
#ifndef FBD_OUTPUT_REPORT_H
#define FBD_OUTPUT_REPORT_H

#include "record/result.h"

/* Scenes of more bodies have the short report; the full one would be several screens long. */
enum { report_few_bodies = 12, report_digits = 9 };

/* The output and data of a report; columns are wider with error bars. */
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

/* Write at most `most` parameters with their values. */
void report_parameters(const struct page *page, size_t most);

/* Write totals, events by their kinds, some of the bodies, the largest forces, and the number of omitted
 * items. */
void report_short(const struct page *page);

#endif
