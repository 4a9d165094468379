/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The help of fbd-run: options of a run, and of what is done instead.
 */
#ifndef FBD_APPS_OPTIONS_HELP_H
#define FBD_APPS_OPTIONS_HELP_H

extern const char options_help[], options_help_without_run[];

#endif
