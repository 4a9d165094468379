/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/file.h"

#include "base/diag.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { largest_file = 64 * 1024 * 1024 };

static const char no_plain_file[] = "it is no plain file";

/* `why` is NULL when memory is out. */
static void cannot_read(fbd_errors *errors, const char *path, const char *why)
{
    const char *hint = why == no_plain_file ? "a pipe is read as standard input: `-`" : NULL;
    if (!why) {
        diag_out_of_memory(errors);
        return;
    }
    diag_in_file(errors, path);
    diag_add(errors, FBD_ERROR, "cannot-read", (struct pos){0, 0}, hint, "cannot read the file: %s", why);
}

/* Read the whole of a stream, with a zero behind it; NULL with *why, which is NULL when memory is out. */
static char *read_stream(FILE *stream, size_t *length, const char **why)
{
    size_t room = 16384;
    char *text = NULL;
    *length = 0;
    for (;;) {
        char *more = realloc(text, room);
        if (!more) break;
        text = more;
        *length += fread(text + *length, 1, room - *length, stream);
        if (*length < room) {
            *why = ferror(stream) ? strerror(errno) : NULL;
            text[*length] = '\0';
            if (!*why) return text;
            free(text);
            return NULL;
        }
        if (room > largest_file) {
            free(text);
            *why = "it is larger than 64 MiB";
            return NULL;
        }
        room *= 2;
    }
    free(text);
    *why = NULL;
    return NULL;
}

/* The descriptor of an open file under this path, as of `<(...)` in a shell; -1 for any other path. */
static int number_of(const char *path)
{
    static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/"};
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        const char *digits = path + strlen(folders[i]);
        if (strncmp(path, folders[i], strlen(folders[i])) != 0) continue;
        bool number = *digits && strlen(digits) < 9 && digits[strspn(digits, "0123456789")] == '\0';
        return number ? (int)strtol(digits, NULL, 10) : -1;
    }
    return strcmp(path, "/dev/stdin") == 0 ? 0 : -1;
}

/* A plain file. Opening a pipe by its name would wait for a writer, and reading a device might never end. */
static FILE *open_plain(const char *path, const char **why)
{
    struct stat info;
    int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    FILE *stream = NULL;
    if (descriptor < 0 && errno == ENXIO)
        *why = no_plain_file; /* a socket */
    else if (descriptor < 0 || fstat(descriptor, &info) != 0)
        *why = strerror(errno);
    else if (!S_ISREG(info.st_mode))
        *why = S_ISDIR(info.st_mode) ? strerror(EISDIR) : no_plain_file;
    else if (!(stream = fdopen(descriptor, "rb")))
        *why = errno == ENOMEM ? NULL : strerror(errno);
    if (!stream && descriptor >= 0) close(descriptor);
    return stream;
}

/* Do not reopen an open file: a pipe whose writer has ended would wait for another. */
static FILE *open_stream(const char *path, const char **why)
{
    int number = number_of(path), copy = number < 0 ? -1 : dup(number);
    if (number < 0) return open_plain(path, why);
    FILE *stream = copy < 0 ? NULL : fdopen(copy, "rb");
    if (!stream) *why = errno == ENOMEM ? NULL : strerror(errno);
    if (!stream && copy >= 0) close(copy);
    return stream;
}

char *file_text(const char *path, size_t *length, fbd_errors *errors)
{
    bool standard = strcmp(path, "-") == 0;
    if (!standard) diag_reads(errors, path);
    const char *why = NULL;
    FILE *stream = standard ? stdin : open_stream(path, &why);
    if (!stream) {
        cannot_read(errors, path, why);
        return NULL;
    }
    char *text = read_stream(stream, length, &why);
    if (!standard) fclose(stream);
    if (!text) cannot_read(errors, path, why);
    return text;
}

char *file_copy(const char *text, size_t length, fbd_errors *errors)
{
    char *copy = malloc(length + 1);
    if (!copy) {
        diag_out_of_memory(errors);
        return NULL;
    }
    memcpy(copy, text, length);
    copy[length] = '\0';
    return copy;
}

const char *file_name(const char *path)
{
    return strcmp(path, "-") == 0 ? "<stdin>" : path;
}
