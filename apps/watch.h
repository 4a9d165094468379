/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * --watch: repeat a run whenever a file that it has read changes.
 *
 * Files are polled (stat) ten times a second, which costs less than one thousandth of a processor.
 * Notification by the system (inotify, kqueue) differs between systems, does not cover network files, and
 * would have to follow editors that replace a file by a new one; polling by name always refers to the file
 * that a run would read.
 *
 * Each run is a separate process: it starts from a clean state, is ended when one of its files changes, and
 * cannot end the watch.
 */
#ifndef FBD_APPS_WATCH_H
#define FBD_APPS_WATCH_H

#include "command_line.h"

/* Data for a run under --watch: the descriptor to which it writes the names of its input files, and a unique
 * stamp. */
struct watched_run {
    int descriptor;
    const char *stamp;
};

struct watch {
    const char *program, *model;
    bool quiet; /* print only errors */

    /* Make one run; clean up at the end of the watch (may be NULL). */
    enum exit_code (*run)(void *context, const struct watched_run *run);
    void (*end)(void *context);
    void *context;
};

/* False, with a message, on systems without the processes that it needs. */
bool watch_is_possible(const struct command_line *line);

/* Alternate between running and waiting until a signal ends the process (Ctrl-C: 130). Returns only on
 * failure. */
enum exit_code watch_files(const struct watch *watch);

/* In a run: report its input files, from its list of errors. */
void watch_tell(const struct watched_run *run, const fbd_errors *errors);

#endif
