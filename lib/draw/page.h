/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Page: a run as one HTML file that plays it. The template page/page.html is filled with its style, the chart
 * library, the scripts and the data of the run; the files are compiled in (embed).
 */
#ifndef FBD_DRAW_PAGE_H
#define FBD_DRAW_PAGE_H

#include "base/text.h"
#include "fbd.h"

/* A compiled-in file. */
struct page_asset {
    const char *name;
    const unsigned char *data;
    size_t size;
};

/* All of them; none when the library was built without the page. */
extern const struct page_asset page_assets[];
extern const size_t page_asset_count;

/* The asset of this name, or NULL. */
const struct page_asset *page_asset_find(const char *name);

/* The replacement of a line `@MARK@` that does not name an asset. */
struct page_part {
    const char *mark;
    void (*write)(struct text *text, const void *context);
    const void *context;
};

/* The page of a run with those parts; `most_bytes` is that of fbd_result_page_data. The parts, the last one without a mark; lines that begin with `@LIVE` are dropped
 * if no part has their mark. NULL with a note in `errors`. */
char *page_make(fbd_result *result, size_t most_bytes, const struct page_part *parts, fbd_errors *errors);

/* Fill a template with the compiled-in assets and those parts. */
void page_fill(struct text *text, const struct page_asset *template, const struct page_part *parts);

/* The content security policy of every page: only its own scripts. A part with mark POLICY. */
void page_write_policy(struct text *text, const void *context);

/* Append JSON inside a script element. */
void page_add_json(struct text *text, const struct text *json);

#endif
