/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * All that a run has left behind: what it has printed and the files of its directory.
 */
#ifndef FBD_TESTS_FAILURES_SNAPSHOT_H
#define FBD_TESTS_FAILURES_SNAPSHOT_H

#include "server.h"

struct piece {
    char *name, *data; /* data ends with a zero that does not count */
    size_t size;
};

enum { most_files = 32 };

struct snapshot {
    int status; /* of waitpid */
    struct piece out, err;
    struct piece files[most_files];
    size_t count;
};

struct snapshot snapshot_take(const struct server *server, const char *place, int status);
void snapshot_free(struct snapshot *snapshot);

/* A file of it, or NULL. */
const struct piece *snapshot_find(const struct snapshot *snapshot, const char *name);

bool piece_same(const struct piece *a, const struct piece *b);

/* A directory with no files, and a file in it. Directories and links stay. */
void place_clear(const char *place);
void place_put(const char *place, const char *name, const char *data, size_t size);

#endif
