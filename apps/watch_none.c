/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "watch.h"

bool watch_is_possible(const struct command_line *line)
{
    return command_line_usage(line, "--watch is not available on Windows: run the model again after a change",
                              "");
}

enum exit_code watch_files(const struct watch *watch)
{
    (void)watch;
    return exit_failed;
}

void watch_tell(const struct watched_run *run, const fbd_errors *errors)
{
    (void)run, (void)errors;
}
