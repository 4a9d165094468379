/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "interrupt.h"

#include <stddef.h>

static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};

enum { signal_count = sizeof signals / sizeof *signals };

static bool is_ignored(int number)
{
    struct sigaction action;
    return sigaction(number, NULL, &action) == 0 && action.sa_handler == SIG_IGN;
}

void interrupt_hold(struct interrupt *interrupt)
{
    sigemptyset(&interrupt->held);
    for (int i = 0; i < signal_count; i++)
        if (!is_ignored(signals[i])) sigaddset(&interrupt->held, signals[i]);
    sigprocmask(SIG_BLOCK, &interrupt->held, &interrupt->before);
}

bool interrupt_asked(const struct interrupt *interrupt)
{
    sigset_t pending;
    if (sigpending(&pending) != 0) return false;
    for (int i = 0; i < signal_count; i++)
        if (sigismember(&pending, signals[i]) == 1 && sigismember(&interrupt->held, signals[i]) == 1)
            return true;
    return false;
}

void interrupt_release(const struct interrupt *interrupt)
{
    sigprocmask(SIG_SETMASK, &interrupt->before, NULL);
}

bool interrupt_by_pipe(void)
{
    sigset_t pending;
    return sigpending(&pending) == 0 && sigismember(&pending, SIGPIPE) == 1;
}
