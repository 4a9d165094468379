/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Answers of students held against a key: fbd-run --grade.
 */
#ifndef FBD_APPS_GRADING_H
#define FBD_APPS_GRADING_H

#include "options.h"

/* Grade all answers and write what was asked for. exit_hand_differs when one does not pass. */
enum exit_code grading(const struct options *options);

/* Do the options of --grade and --handout go together? `others`: there are some of runs or drawings. */
bool grading_agrees(const struct options *options, const struct command_line *line, bool others);

/* Print the sheet of a student, or write it as a page. */
enum exit_code handout(const struct options *options);

#endif
