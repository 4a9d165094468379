/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A program under the layer (layer.h), loaded once and run as often as it is asked to.
 */
#ifndef FBD_TESTS_FAILURES_SERVER_H
#define FBD_TESTS_FAILURES_SERVER_H

#include "layer.h"

#include <sys/types.h>

struct server {
    struct layer_page *page;
    pid_t process;
    int ask, answer;
    int out, err; /* unnamed files for what it prints */
};

/* Start `argv` in the directory `place`. Ends the process with a message when that cannot be done. */
struct server server_start(const char *layer, const char *place, char **argv);

/* One run with the call `at` of a kind failing (and, with `stay`, all after it). The status is waitpid's. */
int server_run(const struct server *server, enum layer_kind kind, long at, bool stay);

void server_end(struct server *server);

#endif
