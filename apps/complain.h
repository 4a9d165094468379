/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Messages of the programs on standard error. Paths, options and reasons are printed with control characters
 * escaped.
 */
#ifndef FBD_APPS_COMPLAIN_H
#define FBD_APPS_COMPLAIN_H

/* Print one line; the newline is added. Allocates no memory. */
void complain(const char *format, ...) __attribute__((format(printf, 1, 2)));

#endif
