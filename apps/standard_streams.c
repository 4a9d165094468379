/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "standard_streams.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "complain.h"
#include "interrupt.h"

/* Open /dev/null in the wrong direction, so that using a closed stream remains an error. */
void standard_streams_begin(void)
{
    static const int ways[] = {
        [STDIN_FILENO] = O_WRONLY, [STDOUT_FILENO] = O_RDONLY, [STDERR_FILENO] = O_RDONLY};
    for (int i = STDIN_FILENO; i <= STDERR_FILENO; i++)
        if (fcntl(i, F_GETFD) < 0) (void)open("/dev/null", ways[i]); /* gets the lowest free descriptor: i */
}

bool standard_output_arrives(const char *program)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) return true;
    if (!interrupt_by_pipe()) complain("%s: cannot write to standard output: %s", program, strerror(errno));
    return false;
}
