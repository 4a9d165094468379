/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the programs say on standard error. Paths, options and reasons are shown without what a terminal would
 * obey.
 */
#ifndef FBD_APPS_COMPLAIN_H
#define FBD_APPS_COMPLAIN_H

/* One line, to which the end is added. It needs no memory that could be out. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
