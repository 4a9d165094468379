/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Comparison of students' answers with a key: fbd-run --grade.
 */
#ifndef FBD_APPS_GRADING_H
#define FBD_APPS_GRADING_H

#include "options.h"

/* Grade all answers and write the requested outputs. Returns exit_hand_differs when one does not pass. */
enum exit_code grading(const struct options *options);

/* Check that the options of --grade and --handout are compatible. `others`: there are options of runs or
 * drawings. */
bool grading_agrees(const struct options *options, const struct command_line *line, bool others);

/* Print the sheet of a student, or write it as a page. */
enum exit_code handout(const struct options *options);

#endif
