/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ctrl-C (SIGINT), SIGTERM and SIGHUP while output files are open: the run ends at the next step, its files
 * are completed, and then the process is ended by that signal, as its caller expects (a shell shows 130, 143,
 * 129). The same applies when the reader of standard output has closed it (SIGPIPE, 141), but then no files
 * are left.
 *
 * The signals are blocked, and polled between steps. So no handler is needed, and no system call is
 * interrupted in the middle of a file.
 */
#ifndef FBD_APPS_INTERRUPT_H
#define FBD_APPS_INTERRUPT_H

#include <signal.h>
#include <stdbool.h>

struct interrupt {
    sigset_t held, before;
};

/* Block the signals from now on; those that the caller ignores stay ignored. */
void interrupt_hold(struct interrupt *interrupt);

/* True if one of them is pending. */
bool interrupt_asked(const struct interrupt *interrupt);

/* Unblock them. Does not return when one is pending: it ends the process. */
void interrupt_release(const struct interrupt *interrupt);

/* True if a SIGPIPE is pending. Then an error of writing is not reported. */
bool interrupt_by_pipe(void);

#endif
