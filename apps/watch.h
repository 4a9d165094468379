/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * --watch: a run is made again whenever a file that it has read changes.
 *
 * Files are asked for (stat) ten times a second, which costs less than one thousandth of a processor. What the
 * system could tell by itself (inotify, kqueue) is another thing on each system, says nothing of files on a
 * network, and has to follow editors that put a new file in place of the old one; a name that is asked for is
 * always what a run would read.
 *
 * Each run is a process of its own: it starts from nothing, is ended when what it reads changes, and takes the
 * watch with it in no case.
 */
#ifndef FBD_APPS_WATCH_H
#define FBD_APPS_WATCH_H

#include "command_line.h"

/* What a run is told by the watch: where it says what it reads, and a mark that no other run has. */
struct watched_run {
    int descriptor;
    const char *stamp;
};

struct watch {
    const char *program, *model;
    bool quiet; /* say only what is wrong */

    /* Make one run; and what is left to do when the watch ends, which may be NULL. */
    enum exit_code (*run)(void *context, const struct watched_run *run);
    void (*end)(void *context);
    void *context;
};

/* Run and wait in turn until a signal ends the process (Ctrl-C: 130). Returns only when that cannot go on. */
enum exit_code watch_files(const struct watch *watch);

/* In a run: the files that it reads, as the list of its errors knows them. */
void watch_tell(const struct watched_run *run, const fbd_errors *errors);

#endif
