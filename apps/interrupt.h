/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Ctrl-C (SIGINT), SIGTERM and SIGHUP while output files are open: the run ends at the next step, its files
 * are completed, and then the process dies by that signal, as its caller expects (a shell shows 130, 143,
 * 129). So it does when nobody reads standard output any more (SIGPIPE, 141), but then it leaves no files.
 *
 * The signals are held back and asked for between steps. So there is no handler, and no call of the system
 * that a signal breaks off in the middle of a file.
 */
#ifndef FBD_APPS_INTERRUPT_H
#define FBD_APPS_INTERRUPT_H

#include <signal.h>
#include <stdbool.h>

struct interrupt {
    sigset_t held, before;
};

/* Hold the signals back from now on; those that the caller has set to be ignored stay ignored. */
void interrupt_hold(struct interrupt *interrupt);

/* Has one of them come? */
bool interrupt_asked(const struct interrupt *interrupt);

/* Let them through again. Does not return when one has come: that one ends the process. */
void interrupt_release(const struct interrupt *interrupt);

/* Is one held back that says that nobody reads any more? Then an error of writing need not be told. */
bool interrupt_by_pipe(void);

#endif
