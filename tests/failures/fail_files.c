/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The files of the layer: every call that opens, reads, writes, closes or moves one may fail, with what a
 * full or broken disk says. Streams of the C library reach the system on ways of their own, which nobody can
 * come between; so each is replaced by one whose reads and writes are functions of this file (fopencookie),
 * with the same buffer: calls come when they would come.
 */
#undef _FILE_OFFSET_BITS /* both names of each function are wanted: that of a program may be open or open64  \
                          */

#include "layer.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define REAL(name, type)                                                                                     \
    static __typeof__(type) *real;                                                                           \
    if (!real) *(void **)&real = dlsym(RTLD_NEXT, name)

static bool refuse(const char *what, int error)
{
    bool refused = layer_refuses(layer_files, what, NULL);
    if (refused) errno = error;
    return refused;
}

/* ---- streams */

struct cookie {
    FILE *stream;
    int descriptor;
};

enum { most_streams = 64 };
static struct cookie cookies[most_streams]; /* not from the heap, which is being watched */

static ssize_t cookie_read(void *context, char *text, size_t length)
{
    const struct cookie *cookie = context;
    return refuse("read", EIO) ? -1 : read(cookie->descriptor, text, length);
}

/* A disk gets full within a write: what still fits is written. Less than all is an error here. */
static ssize_t cookie_write(void *context, const char *text, size_t length)
{
    const struct cookie *cookie = context;
    if (!layer_refuses(layer_files, "write", NULL)) return write(cookie->descriptor, text, length);
    ssize_t written = length > 1 ? write(cookie->descriptor, text, length / 2) : 0;
    errno = ENOSPC;
    return written;
}

static int cookie_seek(void *context, off64_t *offset, int whence)
{
    const struct cookie *cookie = context;
    off_t at = lseek(cookie->descriptor, *offset, whence);
    *offset = at;
    return at < 0 ? -1 : 0;
}

static int really_close(int descriptor)
{
    REAL("close", int(int));
    return real(descriptor);
}

/* What is lost is said when the file is closed, by a file system over a network; it is closed all the same.
 */
static int cookie_close(void *context)
{
    struct cookie *cookie = context;
    bool refused = layer_refuses(layer_files, "close", NULL);
    int closed = really_close(cookie->descriptor);
    *cookie = (struct cookie){0};
    if (refused) errno = EIO;
    return refused ? -1 : closed;
}

static const cookie_io_functions_t functions = {cookie_read, cookie_write, cookie_seek, cookie_close};

static FILE *stream_on(int descriptor, const char *mode)
{
    for (int i = 0; i < most_streams; i++) {
        if (cookies[i].stream) continue;
        FILE *stream = fopencookie(&cookies[i], mode, functions);
        if (stream) cookies[i] = (struct cookie){stream, descriptor};
        return stream;
    }
    errno = EMFILE;
    return NULL;
}

int fileno(FILE *stream)
{
    REAL("fileno", int(FILE *));
    for (int i = 0; i < most_streams; i++)
        if (cookies[i].stream == stream) return cookies[i].descriptor;
    return real(stream);
}

void layer_files_begin(void)
{
    static char input[BUFSIZ], output[BUFSIZ];
    stdin = stream_on(STDIN_FILENO, "r");
    stdout = stream_on(STDOUT_FILENO, "w");
    if (!stdin || !stdout) _exit(70);
    setvbuf(stdin, input, _IOFBF, sizeof input);
    setvbuf(stdout, output, _IOFBF, sizeof output);
}

/* ---- opening */

static int flags_of(const char *mode)
{
    bool both = strchr(mode, '+') != NULL;
    switch (mode[0]) {
    case 'r': return both ? O_RDWR : O_RDONLY;
    case 'w': return (both ? O_RDWR : O_WRONLY) | O_CREAT | O_TRUNC;
    default: return (both ? O_RDWR : O_WRONLY) | O_CREAT | O_APPEND;
    }
}

static int really_open(const char *path, int flags, mode_t mode)
{
    REAL("open64", int(const char *, int, ...));
    return real(path, flags, mode);
}

FILE *fopen(const char *path, const char *mode)
{
    int descriptor = refuse("fopen", EACCES) ? -1 : really_open(path, flags_of(mode), 0666);
    FILE *stream = descriptor < 0 ? NULL : stream_on(descriptor, mode);
    if (!stream && descriptor >= 0) really_close(descriptor);
    return stream;
}

FILE *fopen64(const char *path, const char *mode)
{
    return fopen(path, mode);
}

FILE *fdopen(int descriptor, const char *mode)
{
    return refuse("fdopen", ENFILE) ? NULL : stream_on(descriptor, mode);
}

FILE *tmpfile(void)
{
    char name[] = "/tmp/layer-XXXXXX";
    REAL("mkstemp", int(char *));
    int descriptor = refuse("tmpfile", ENOSPC) ? -1 : real(name);
    if (descriptor < 0) return NULL;
    unlink(name);
    FILE *stream = stream_on(descriptor, "w+");
    if (!stream) really_close(descriptor);
    return stream;
}

FILE *tmpfile64(void)
{
    return tmpfile();
}

int open(const char *path, int flags, ...)
{
    va_list args;
    va_start(args, flags);
    mode_t mode = flags & O_CREAT ? va_arg(args, mode_t) : 0;
    va_end(args);
    return refuse("open", EACCES) ? -1 : really_open(path, flags, mode);
}

int open64(const char *path, int flags, ...)
{
    va_list args;
    va_start(args, flags);
    mode_t mode = flags & O_CREAT ? va_arg(args, mode_t) : 0;
    va_end(args);
    return refuse("open", EACCES) ? -1 : really_open(path, flags, mode);
}

int mkstemp(char *name)
{
    REAL("mkstemp", int(char *));
    return refuse("mkstemp", EACCES) ? -1 : real(name);
}

int mkstemp64(char *name)
{
    return mkstemp(name);
}

/* ---- what is done to files beside writing */

int close(int descriptor)
{
    bool refused = layer_refuses(layer_files, "close", NULL);
    int closed = really_close(descriptor);
    if (refused) errno = EIO;
    return refused ? -1 : closed;
}

int fsync(int descriptor)
{
    REAL("fsync", int(int));
    return refuse("fsync", EIO) ? -1 : real(descriptor);
}

int rename(const char *from, const char *to)
{
    REAL("rename", int(const char *, const char *));
    return refuse("rename", EACCES) ? -1 : real(from, to);
}

int ftruncate(int descriptor, off_t length)
{
    REAL("ftruncate64", int(int, off64_t));
    return refuse("ftruncate", EIO) ? -1 : real(descriptor, length);
}

int ftruncate64(int descriptor, off64_t length)
{
    REAL("ftruncate64", int(int, off64_t));
    return refuse("ftruncate", EIO) ? -1 : real(descriptor, length);
}
