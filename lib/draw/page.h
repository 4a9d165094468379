/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Page: a run as one HTML file that plays it. The page is page/page.html with its style, the charts' library,
 * our scripts and the data of the run put in where it says so; the files are compiled in (embed).
 */
#ifndef FBD_DRAW_PAGE_H
#define FBD_DRAW_PAGE_H

#include "draw/record.h"

/* A file that was compiled in. */
struct page_asset {
    const char *name;
    const unsigned char *data;
    size_t size;
};

/* All of them; none when the library was built without the page. */
extern const struct page_asset page_assets[];
extern const size_t page_asset_count;

/* The data of the page as JSON: see page_data.c for its members. False when memory is out. */
bool page_data_write(struct text *text, fbd_result *result, struct record *record);

#endif
