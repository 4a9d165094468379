/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Resolution of paths of the command line: through links, to an open file, to a device. Two spellings may be
 * the same file, and an input file must not be overwritten.
 */
#ifndef FBD_APPS_PLACE_H
#define FBD_APPS_PLACE_H

#include <limits.h>

#include "command_line.h"

#ifdef PATH_MAX
enum { place_size = PATH_MAX };
#else
enum { place_size = 4096 };
#endif

/* The descriptor of the open file that a path denotes: 1 for "-", /dev/stdout and /dev/fd/1; -1 for a path in
 * the file system. */
int place_descriptor(const char *path);

/* True if the path is standard output. False for NULL (an output that is not requested). */
bool place_is_stdout(const char *path);

/* Follow the links at the end of a path, whether their target exists or not. False with errno set: a cycle of
 * links, a path that is too long. */
bool place_target(const char *path, char target[place_size]);

/* An output: its option, and its path (NULL: not requested). */
struct output_place {
    const char *option, *path;
};

/* False, with a message, when an output would overwrite a file that was read, according to the list of
 * errors. */
bool places_spare(const struct command_line *line, const fbd_errors *errors,
                  const struct output_place *outputs, size_t count);

/* False, with a message, when an output would overwrite the model file or another output, in any spelling.
 * Only /dev/null may be used several times. */
bool places_differ(const struct command_line *line, const char *model, const struct output_place *outputs,
                   size_t count);

#endif
