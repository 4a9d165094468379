/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "interrupt.h"
#include "place.h"

/* ---- modes and owners */

/* mkstemp makes files readable only by their owner; a new file gets the usual mode. */
static mode_t usual_mode(void)
{
    mode_t mask = (mode_t)umask(0);
    umask(mask);
    return (mode_t)(0666 & ~mask);
}

/* If the group cannot be kept, reduce the permissions of the new group to those of all others. */
void whole_file_be_like(int descriptor, const struct stat *before)
{
    struct stat now;
    if (fstat(descriptor, &now) != 0) return;
    mode_t mode = before->st_mode & 0777;
    bool owner = now.st_uid == before->st_uid || fchown(descriptor, before->st_uid, (gid_t)-1) == 0;
    bool group = now.st_gid == before->st_gid || fchown(descriptor, (uid_t)-1, before->st_gid) == 0;
    if (!group) mode = (mode & ~(mode_t)070) | (mode & (mode & 07) << 3);
    if (owner && group) mode = before->st_mode & 07777;
    (void)fchmod(descriptor, mode);
}

/* ---- opening */

/* True for a pipe, a terminal or an open file, which cannot be replaced by renaming and is written directly. */
static bool is_special(const char *path)
{
    struct stat status;
    return place_descriptor(path) >= 0 || (stat(path, &status) == 0 && !S_ISREG(status.st_mode));
}

FILE *whole_file_straight(const char *path)
{
    int descriptor = place_descriptor(path);
    if (descriptor == STDOUT_FILENO) return stdout;
    if (descriptor < 0) return fopen(path, "w");
    int copy = dup(descriptor);
    FILE *stream = copy >= 0 ? fdopen(copy, "w") : NULL;
    if (!stream && copy >= 0) close(copy);
    return stream;
}

static char *joined(const char *start, const char *end)
{
    size_t size = strlen(start) + strlen(end) + 1;
    char *text = malloc(size);
    if (text) snprintf(text, size, "%s%s", start, end);
    return text;
}

static bool open_temporary(struct whole_file *file, const struct stat *before)
{
    int descriptor = mkstemp(file->temporary);
    if (descriptor < 0) return false;
    if (before)
        whole_file_be_like(descriptor, before);
    else
        (void)fchmod(descriptor, usual_mode());
    file->stream = fdopen(descriptor, "w");
    if (file->stream) return true;
    close(descriptor);
    unlink(file->temporary);
    return false;
}

static void forget(struct whole_file *file)
{
    int reason = errno;
    free(file->target);
    free(file->temporary);
    file->target = file->temporary = NULL;
    errno = reason;
}

/* Refuse an existing file without write permission, though its folder would permit replacing it. */
static bool open_beside(struct whole_file *file)
{
    struct stat before;
    char target[place_size];
    if (!place_target(file->path, target)) return false;
    bool there = stat(target, &before) == 0;
    if (there && faccessat(AT_FDCWD, target, W_OK, AT_EACCESS) != 0) return false;
    file->target = joined(target, "");
    file->temporary = joined(target, ".XXXXXX");
    if (file->target && file->temporary && open_temporary(file, there ? &before : NULL)) return true;
    forget(file);
    return false;
}

bool whole_file_open(struct whole_file *file, const char *path)
{
    *file = (struct whole_file){.path = path};
    if (!is_special(path)) return open_beside(file);
    file->stream = whole_file_straight(path);
    return file->stream != NULL;
}

/* ---- writing and closing */

int whole_file_write(void *context, const char *text, size_t length)
{
    struct whole_file *file = context;
    return fwrite(text, 1, length, file->stream) == length ? 0 : 1;
}

bool whole_file_close(struct whole_file *file, bool keep)
{
    if (!file->stream) return true;
    bool written = fflush(file->stream) == 0 && !ferror(file->stream);
    int reason = errno;
    if (file->stream != stdout && fclose(file->stream) != 0) {
        if (written) reason = errno;
        written = false;
    }
    file->stream = NULL;
    if (!file->temporary) {
        errno = reason;
        return written;
    }
    if (written && keep) {
        written = rename(file->temporary, file->target) == 0;
        reason = errno;
    }
    if (!written || !keep) unlink(file->temporary);
    forget(file);
    errno = reason;
    return written;
}

bool whole_file_put_bytes(const char *path, const char *bytes, size_t length)
{
    struct whole_file file;
    struct interrupt interrupt;
    bool beside = !is_special(path); /* opening a pipe may block for ever */
    if (beside) interrupt_hold(&interrupt);
    bool written = whole_file_open(&file, path);
    if (written) {
        whole_file_write(&file, bytes, length); /* an error is reported at closing */
        written = whole_file_close(&file, true);
    }
    int reason = errno;
    if (beside) interrupt_release(&interrupt);
    errno = reason;
    return written;
}

bool whole_file_put(const char *path, const char *text)
{
    return whole_file_put_bytes(path, text, strlen(text));
}
