/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The files that a run writes, each completely or not at all.
 */
#ifndef FBD_APPS_OUTPUTS_H
#define FBD_APPS_OUTPUTS_H

#include "interrupt.h"
#include "note.h"
#include "options.h"
#include "whole_file.h"

enum output { output_csv, output_json, output_html, output_plot, output_gnuplot, output_count };

struct outputs {
    struct whole_file files[output_count];
    struct note_files note;
    bool note_made; /* else there is none, as of a run that failed */
};

/* Open all requested files, the CSV with the comment lines of --origin; false, with a message and no file left, when one
 * cannot be written. */
bool outputs_open(struct outputs *outputs, const struct options *options, const fbd_model *model);

/* Write the outputs made from the result (the CSV was written during the run). False with a message. */
bool outputs_write(struct outputs *outputs, const struct options *options, fbd_result *result,
                   fbd_errors *errors);

/* With --watch: announce the page to its viewer, if the run that ended with this code has one. False with a
 * message. */
bool outputs_announce(const struct options *options, enum exit_code code);

/* Rename the files to their final names, or remove them all. False with a message. */
bool outputs_close(struct outputs *outputs, bool keep);

/* Make the note of a run that came to its end, and write it into its open files. Sets *code to that of its checks. False
 * with a message when it cannot be made. */
bool outputs_make_note(fbd_simulation *simulation, fbd_result *result, const struct options *options,
                       struct outputs *outputs, const struct interrupt *interrupt, fbd_errors *errors,
                       enum exit_code *code);

#endif
