/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The calculation note of a run: one file, or a file with drawings beside it, by the ending of its name: .html, .md, .tex
 * and .pdf. A PDF is made by Chromium from the HTML, or by LaTeX.
 */
#ifndef FBD_APPS_NOTE_H
#define FBD_APPS_NOTE_H

#include "command_line.h"
#include "fbd_export.h"
#include "whole_file.h"

struct note_files {
    struct whole_file document, *drawings;
    size_t count; /* of drawings */
    char *names;  /* the paths of the drawings */
};

/* True if a note can be written to this file: the ending is known and the programs that it needs are installed.
 * Otherwise prints the reason. */
bool note_can_be_written(const struct command_line *line, const char *file);

/* Write the note into the open files->document, and its drawings to new files beside it. False with a message. */
bool note_write(struct note_files *files, const fbd_note *note);

/* Rename the files to their final names, or remove them all. False with errno set, and *path the file. */
bool note_close(struct note_files *files, bool keep, const char **path);

#endif
