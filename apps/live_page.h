/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A page of --html that loads itself anew when --watch has written it again. A page that was opened from a file
 * may not read files, but may load scripts: beside PAGE stands PAGE.stamp.js, which says the stamp of the last
 * run, and the page asks for it twice a second (lib/draw/page/live.js).
 */
#ifndef FBD_APPS_LIVE_PAGE_H
#define FBD_APPS_LIVE_PAGE_H

#include <stdbool.h>

/* The page made live, in place of `page`, which is freed; NULL when memory is out or `page` is NULL. */
char *live_page_make(char *page, const char *stamp);

/* Say that the page at `path` is that of this run, once it is in its place. False with errno set. */
bool live_page_announce(const char *path, const char *stamp);

/* The watch has ended: the page becomes an ordinary one, and no stamp stays. */
void live_page_settle(const char *path);

#endif
