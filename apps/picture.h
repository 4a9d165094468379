/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Drawings in another format than SVG, by a program that is found when one is asked for.
 */
#ifndef FBD_APPS_PICTURE_H
#define FBD_APPS_PICTURE_H

#include "command_line.h"

/* Can a drawing be written to this file: is it SVG (whatever its name ends in but .pdf and .png), or is a converter
 * there? Else says what is missing. */
bool picture_can_be_written(const struct command_line *line, const char *file);

/* Write the drawing, as the name of the file says; "-" is standard output. False when it fails, which is said. */
bool picture_write(const char *file, const char *svg);

#endif
