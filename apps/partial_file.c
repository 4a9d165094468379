/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "partial_file.h"

#include "whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- texts */

static char *format(const char *text, ...)
{
    va_list args;
    va_start(args, text);
    int length = vsnprintf(NULL, 0, text, args);
    va_end(args);
    char *made = length < 0 ? NULL : malloc((size_t)length + 1);
    va_start(args, text);
    if (made) vsnprintf(made, (size_t)length + 1, text, args);
    va_end(args);
    return made;
}

/* Why a file is not opened. */
struct obstacle {
    enum partial_opening kind;
    char *text;
};

static bool cannot(struct obstacle *why, const char *what, const char *path)
{
    why->kind = partial_failed;
    why->text = format("cannot %s `%s`: %s", what, path, strerror(errno));
    return false;
}

/* A line of a stream without its end, to be freed; NULL at the end, and for a line that was torn off. What
 * cannot be read, or held in memory, is no end: `has_failed` tells, before anything is cut off for it. */
static char *read_line(FILE *stream)
{
    char *line = NULL;
    size_t room = 0;
    ssize_t length = getline(&line, &room, stream);
    if (length > 0 && line[length - 1] == '\n') {
        line[length - 1] = '\0';
        return line;
    }
    free(line);
    return NULL;
}

static bool has_failed(FILE *stream)
{
    return ferror(stream) || !feof(stream);
}

/* True when the lines of the stream are those of `key`; else what differs first, or no text when it cannot be
 * read. */
static bool same_key(FILE *stream, const char *key, struct obstacle *why)
{
    for (; *key; key += strcspn(key, "\n") + 1) {
        size_t length = strcspn(key, "\n");
        char *line = read_line(stream);
        bool same = line && strlen(line) == length && strncmp(line, key, length) == 0;
        if (!line && has_failed(stream)) return false;
        if (!same)
            why->text = format("it belongs to another sweep: there `%s`, here `%.*s`", line ? line : "",
                               (int)length, key);
        free(line);
        if (!same) return false;
    }
    char *more = read_line(stream);
    if (more) why->text = format("it belongs to another sweep: there also `%s`", more);
    bool same = !more && !has_failed(stream);
    free(more);
    return same;
}

/* ---- what is there */

/* A run that ended well has no reason to give. */
static bool ended_well(const char *row)
{
    static const char *const ends[] = {",done,", ",stopped,"};
    size_t length = strlen(row);
    for (int i = 0; i < 2; i++) {
        size_t end = strlen(ends[i]);
        if (length >= end && strcmp(row + length - end, ends[i]) == 0) return true;
    }
    return false;
}

/* Read the header and the rows; returns where the last whole line ends, or -1 with *why. */
static long check_rows(struct partial_file *file, FILE *stream, const char *header, struct obstacle *why)
{
    char *line = read_line(stream);
    size_t columns = strcspn(header, "\n");
    bool fine = line && strlen(line) == columns && strncmp(line, header, columns) == 0;
    bool empty = !line;
    free(line);
    if (empty) return 0;
    if (!fine) {
        why->text = format("`%s` has other columns", file->part);
        return -1;
    }
    long whole = ftell(stream);
    while ((line = read_line(stream)) != NULL) {
        char number[32];
        int digits = snprintf(number, sizeof number, "%zu,", file->rows + 1);
        bool next = strncmp(line, number, (size_t)digits) == 0;
        if (next) file->failed += !ended_well(line);
        free(line);
        if (!next) {
            why->text = format("`%s` is damaged behind row %zu", file->part, file->rows);
            return -1;
        }
        file->rows++;
        whole = ftell(stream);
    }
    return whole;
}

static bool check_key(const struct partial_file *file, const char *key, struct obstacle *why)
{
    FILE *stream = fopen(file->key, "r");
    if (!stream) return cannot(why, "read", file->key);
    struct obstacle differs = {0};
    bool same = same_key(stream, key, &differs);
    if (!same && !differs.text) cannot(why, "read", file->key);
    fclose(stream);
    if (!same && !differs.text) return false;
    if (!same) why->text = format("`%s` cannot be gone on with: %s", file->part, differs.text);
    free(differs.text);
    return same;
}

static bool lock(const struct partial_file *file, struct obstacle *why)
{
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fileno(file->stream), F_SETLK, &all) == 0) return true;
    if (errno != EACCES && errno != EAGAIN) return true; /* a file system without locks */
    why->text = format("`%s` is being written by another process", file->part);
    return false;
}

/* ---- opening */

static bool write_key(const struct partial_file *file, const char *key, struct obstacle *why)
{
    return whole_file_put(file->key, key) || cannot(why, "write", file->key);
}

static bool refuse_rest(const struct partial_file *file, struct obstacle *why)
{
    why->text = format("`%s` is there from a sweep that did not end: go on with it by --resume, or delete it",
                       file->part);
    return false;
}

/* The file is locked first, so that its key is changed by nobody else. */
static bool open_part(struct partial_file *file, bool resume, struct obstacle *why)
{
    int descriptor = open(file->part, O_RDWR | O_CREAT | (resume ? 0 : O_EXCL), 0666);
    if (descriptor < 0) return errno == EEXIST ? refuse_rest(file, why) : cannot(why, "write", file->part);
    file->stream = fdopen(descriptor, "r+");
    if (!file->stream) {
        close(descriptor);
        return cannot(why, "open", file->part);
    }
    return lock(file, why);
}

/* What is in the part is checked and its torn end cut off; one that has nothing yet gets key and header. */
static bool fill_part(struct partial_file *file, const char *header, const char *key, struct obstacle *why)
{
    struct stat status;
    bool fresh = fstat(fileno(file->stream), &status) == 0 && status.st_size == 0;
    if (!(fresh ? write_key(file, key, why) : check_key(file, key, why))) return false;
    long whole = fresh ? 0 : check_rows(file, file->stream, header, why);
    if (whole < 0) return false;
    if (!fresh && has_failed(file->stream)) return cannot(why, "read", file->part);
    if (ftruncate(fileno(file->stream), whole) != 0 || fseek(file->stream, whole, SEEK_SET) != 0)
        return cannot(why, "write", file->part);
    if (whole > 0) return true;
    return partial_file_write(file, header, strlen(header)) == 0 || cannot(why, "write", file->part);
}

static bool open_stream(struct partial_file *file, const char *path, const char *header, struct obstacle *why)
{
    file->stream = path ? fopen(path, "w") : stdout;
    if (!file->stream) return cannot(why, "write", path);
    return partial_file_write(file, header, strlen(header)) == 0 || cannot(why, "write", path ? path : "-");
}

static void forget(struct partial_file *file)
{
    if (file->stream && file->path) fclose(file->stream);
    free(file->part);
    free(file->key);
    *file = (struct partial_file){0};
}

enum partial_opening partial_file_open(struct partial_file *file, const char *path, const char *header,
                                       const char *key, bool resume, char **why)
{
    struct stat status;
    struct obstacle obstacle = {.kind = partial_refused};
    bool fine = false;
    *file = (struct partial_file){.path = path};
    if (!path || (stat(path, &status) == 0 && !S_ISREG(status.st_mode))) {
        fine = open_stream(file, path, header, &obstacle);
    } else {
        file->part = format("%s.part", path);
        file->key = format("%s.part.key", path);
        fine = file->part && file->key && open_part(file, resume, &obstacle) &&
               fill_part(file, header, key, &obstacle);
    }
    if (!fine) forget(file);
    *why = obstacle.text;
    return fine ? partial_opened : obstacle.kind;
}

/* ---- writing */

int partial_file_write(void *context, const char *rows, size_t length)
{
    struct partial_file *file = context;
    if (fwrite(rows, 1, length, file->stream) == length && fflush(file->stream) == 0) return 0;
    if (!file->error) file->error = errno;
    return 1;
}

bool partial_file_close(struct partial_file *file, bool whole)
{
    bool fine = !file->error && fflush(file->stream) == 0;
    if (file->part && whole) fine = fine && fsync(fileno(file->stream)) == 0;
    int reason = file->error ? file->error : errno;
    if (file->path && fclose(file->stream) != 0) {
        if (fine) reason = errno;
        fine = false;
    }
    file->stream = NULL;
    if (fine && whole && file->part) {
        fine = rename(file->part, file->path) == 0;
        reason = errno;
        if (fine) unlink(file->key);
    }
    forget(file);
    errno = reason;
    return fine;
}
