/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The data of a page about a run, as JSON: page_data.c has its members.
 */
#ifndef FBD_API_PAGE_DATA_H
#define FBD_API_PAGE_DATA_H

#include "output/run_record.h"

/* Append the data; its numbers take at most `most_bytes`, 0: the limit of an ordinary page. Returns false when memory is
 * out. */
bool page_data_write(struct text *text, fbd_result *result, struct record *record, size_t most_bytes);

/* The member `speed` of a surface that runs: null where it varies. */
void page_speed_write(struct text *text, const struct value *speed);

/* The members `links` and `couplings` of the data. */
void page_links_write(struct text *text, const struct record *record);
void page_couplings_write(struct text *text, const fbd_result *result, const struct record *record);

#endif
