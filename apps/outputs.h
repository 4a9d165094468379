/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The files that a run writes, each whole or not at all.
 */
#ifndef FBD_APPS_OUTPUTS_H
#define FBD_APPS_OUTPUTS_H

#include "options.h"
#include "whole_file.h"

enum output { output_csv, output_json, output_html, output_plot, output_gnuplot, output_count };

struct outputs {
    struct whole_file files[output_count];
};

/* Open all that are asked for; false, with a message and nothing left behind, when one cannot be written. */
bool outputs_open(struct outputs *outputs, const struct options *options);

/* Write what is made of the result (the CSV was written during the run). False with a message. */
bool outputs_write(struct outputs *outputs, const struct options *options, fbd_result *result,
                   fbd_errors *errors);

/* Under --watch: the page is in its place, when the run that has ended with this code has one. False with a
 * message. */
bool outputs_announce(const struct options *options, enum exit_code code);

/* Put the files in their places, or leave nothing behind. False with a message. */
bool outputs_close(struct outputs *outputs, bool keep);

#endif
