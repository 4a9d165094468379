/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "snapshot.h"

#include <dirent.h>
#include <err.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static struct piece read_all(int descriptor, const char *name)
{
    struct stat status;
    if (fstat(descriptor, &status) != 0) err(70, "%s", name);
    struct piece piece = {.name = strdup(name), .size = (size_t)status.st_size};
    piece.data = calloc(1, piece.size + 1);
    if (!piece.name || !piece.data) err(70, "%s", name);
    if (pread(descriptor, piece.data, piece.size, 0) != status.st_size) err(70, "%s", name);
    return piece;
}

static bool is_regular(const struct dirent *entry)
{
    return entry->d_type == DT_REG;
}

struct snapshot snapshot_take(const struct server *server, const char *place, int status)
{
    struct snapshot snapshot = {.status = status,
                                .out = read_all(server->out, "standard output"),
                                .err = read_all(server->err, "standard error")};
    DIR *folder = opendir(place);
    if (!folder) err(70, "%s", place);
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        if (!is_regular(entry)) continue;
        if (snapshot.count == most_files) errx(70, "too many files");
        int descriptor = openat(dirfd(folder), entry->d_name, O_RDONLY);
        if (descriptor < 0) err(70, "%s", entry->d_name);
        snapshot.files[snapshot.count++] = read_all(descriptor, entry->d_name);
        close(descriptor);
    }
    closedir(folder);
    return snapshot;
}

static void piece_free(struct piece *piece)
{
    free(piece->name);
    free(piece->data);
}

void snapshot_free(struct snapshot *snapshot)
{
    piece_free(&snapshot->out);
    piece_free(&snapshot->err);
    for (size_t i = 0; i < snapshot->count; i++) piece_free(&snapshot->files[i]);
}

const struct piece *snapshot_find(const struct snapshot *snapshot, const char *name)
{
    for (size_t i = 0; i < snapshot->count; i++)
        if (strcmp(snapshot->files[i].name, name) == 0) return &snapshot->files[i];
    return NULL;
}

bool piece_same(const struct piece *a, const struct piece *b)
{
    return a->size == b->size && memcmp(a->data, b->data, a->size) == 0;
}

void place_clear(const char *place)
{
    DIR *folder = opendir(place);
    if (!folder) err(70, "%s", place);
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        if (is_regular(entry)) unlinkat(dirfd(folder), entry->d_name, 0);
    closedir(folder);
}

void place_put(const char *place, const char *name, const char *data, size_t size)
{
    char path[4096];
    snprintf(path, sizeof path, "%s/%s", place, name);
    int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (descriptor < 0 || write(descriptor, data, size) != (ssize_t)size) err(70, "%s", path);
    close(descriptor);
}
