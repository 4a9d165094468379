/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Where a path of the command line leads: through links, to a file that is already open, to a device. Two
 * spellings may be one place, and what is read must not be written over.
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

/* The number of the open file that a path stands for: 1 for "-", /dev/stdout and /dev/fd/1; -1 for a path
 * that is one of the file system. */
int place_descriptor(const char *path);

/* Is it standard output? False for NULL, an output that is not asked for. */
bool place_is_stdout(const char *path);

/* What a path names when the links at its end are followed, whether it is there or not. False with errno set:
 * links in a circle, a path that is too long. */
bool place_target(const char *path, char target[place_size]);

/* An output: the option that asks for it, and its path (NULL: it is not asked for). */
struct output_place {
    const char *option, *path;
};

/* False, with a message, when an output would be written over a file that was read, as the list of errors knows
 * it. */
bool places_spare(const struct command_line *line, const fbd_errors *errors,
                  const struct output_place *outputs, size_t count);

/* False, with a message, when an output would be written over the model file or over another output, however
 * these are spelled. Only /dev/null takes any number of them. */
bool places_differ(const struct command_line *line, const char *model, const struct output_place *outputs,
                   size_t count);

#endif
