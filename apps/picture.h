/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drawings in formats other than SVG, by an external converter.
 */
#ifndef FBD_APPS_PICTURE_H
#define FBD_APPS_PICTURE_H

#include "command_line.h"
#include "whole_file.h"

/* True if a drawing can be written to this file: it is SVG (any ending but .pdf and .png), or a converter
 * exists. Otherwise prints the reason. */
bool picture_can_be_written(const struct command_line *line, const char *file);

/* Write the drawing in the format given by the name of the file; "-" is standard output. False, with a
 * message, when it fails. */
bool picture_write(const char *file, const char *svg);

/* True if a converter to PDF is installed; and convert a drawing to PDF into an open file: false with a message. */
bool picture_converts_to_pdf(void);
bool picture_write_pdf(struct whole_file *file, const char *svg);

#endif
