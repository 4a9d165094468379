/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A page of --html that reloads when --watch has written it again. A page opened from a file may not read
 * files, but may load scripts: PAGE.stamp.js next to PAGE contains the stamp of the last run, and the page
 * loads it twice a second (watched_page.js).
 */
#ifndef FBD_APPS_LIVE_PAGE_H
#define FBD_APPS_LIVE_PAGE_H

#include <stdbool.h>
#include <stddef.h>

extern const unsigned char watched_page[]; /* the script, by lib/embed */
extern const size_t watched_page_length;

/* Make `page` a live page and free the original; NULL when memory is out or `page` is NULL. */
char *live_page_make(char *page, const char *stamp);

/* Write the stamp of this run for the page at `path`, after the page was renamed there. False with errno set. */
bool live_page_announce(const char *path, const char *stamp);

/* At the end of the watch, make the page an ordinary one and remove its stamp file. */
void live_page_settle(const char *path);

#endif
