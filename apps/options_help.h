/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The text of `fbd-run --help`, in two parts: options of a run, and of the other tasks.
 */
#ifndef FBD_APPS_OPTIONS_HELP_H
#define FBD_APPS_OPTIONS_HELP_H

extern const char options_help[], options_help_without_run[];

#endif
