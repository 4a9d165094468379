/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "partial_file.h"

#include "partial_lines.h"
#include "place.h"
#include "whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The reason why a file is not opened. */
struct obstacle {
    enum partial_opening kind;
    char *text;
};

static bool cannot(struct obstacle *why, const char *what, const char *path)
{
    why->kind = partial_failed;
    why->text = partial_format("cannot %s `%s`: %s", what, path, strerror(errno));
    return false;
}

/* Write and flush a text. */
static bool put(FILE *stream, const char *text, size_t length)
{
    return fwrite(text, 1, length, stream) == length && fflush(stream) == 0;
}

/* ---- existing rows */

/* True if the run of the row ended well: its reason is empty. */
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

static bool is_header(FILE *stream, const char *header, bool *empty)
{
    size_t length = 0, columns = strcspn(header, "\n");
    char *line = partial_line(stream, &length);
    bool same = line && length == columns && memcmp(line, header, columns) == 0;
    *empty = !line;
    free(line);
    return same;
}

/* Check the number and the checksum of the next row. */
static enum partial_row check_row(struct partial_file *file, const char *line, size_t length)
{
    char number[32];
    int digits = snprintf(number, sizeof number, "%zu,", file->rows + 1);
    if (strncmp(line, number, (size_t)digits) != 0) return partial_row_differs;
    return partial_sums_check(&file->sums, line, length);
}

/* Read the header and the rows; returns the position after the last complete and correct row, or -1 with
 * *why. */
static long check_rows(struct partial_file *file, FILE *stream, const char *header, struct obstacle *why)
{
    bool empty;
    bool fine = is_header(stream, header, &empty);
    if (empty && !partial_line_failed(stream)) return 0;
    if (empty) cannot(why, "read", file->part);
    if (!empty && !fine) why->text = partial_format("`%s` has other columns", file->part);
    if (!fine) return -1;
    long whole = ftell(stream);
    size_t length = 0;
    enum partial_row row = partial_row_same;
    for (char *line; row == partial_row_same && (line = partial_line(stream, &length)) != NULL; free(line)) {
        row = check_row(file, line, length);
        if (row != partial_row_same) continue;
        file->rows++;
        file->failed += !ended_well(line);
        whole = ftell(stream);
    }
    bool unread = row == partial_row_same && partial_line_failed(stream);
    if (unread || ferror(file->sums.stream)) {
        cannot(why, "read", unread ? file->part : file->key);
        return -1;
    }
    if (row != partial_row_differs) return whole;
    why->text = partial_format("`%s` is damaged behind row %zu: keep its first %zu lines, or delete it",
                               file->part, file->rows, file->rows + 1);
    return -1;
}

static bool check_key(struct partial_file *file, const char *header, const char *key, struct obstacle *why)
{
    char *differs;
    enum partial_sums_opening opening = partial_sums_open(&file->sums, file->key, key, header, &differs);
    if (opening == partial_sums_failed) return cannot(why, "read", file->key);
    if (opening == partial_sums_differ)
        why->text = partial_format("`%s` cannot be gone on with: %s", file->part, differs);
    free(differs);
    return opening == partial_sums_opened;
}

static bool lock(const struct partial_file *file, struct obstacle *why)
{
    struct flock all = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fileno(file->stream), F_SETLK, &all) == 0) return true;
    if (errno != EACCES && errno != EAGAIN) return true; /* a file system without locks */
    why->text = partial_format("`%s` is being written by another process", file->part);
    return false;
}

/* ---- opening */

static bool refuse_rest(const struct partial_file *file, struct obstacle *why)
{
    why->text =
        partial_format("`%s` is there from a sweep that did not end: go on with it by --resume, or delete it",
                       file->part);
    return false;
}

/* Lock the file before anything else, so that no other process changes its key. */
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

/* Check the content of the part and cut off an incomplete last line; write key and header if it is empty. */
static bool fill_part(struct partial_file *file, const char *header, const char *key, struct obstacle *why)
{
    struct stat status;
    bool fresh = fstat(fileno(file->stream), &status) == 0 && status.st_size == 0;
    if (fresh && !partial_sums_make(&file->sums, file->key, key, header))
        return cannot(why, "write", file->key);
    if (!fresh && !check_key(file, header, key, why)) return false;
    long whole = fresh ? 0 : check_rows(file, file->stream, header, why);
    if (whole < 0) return false;
    if (!partial_sums_cut(&file->sums, file->rows)) return cannot(why, "write", file->key);
    if (ftruncate(fileno(file->stream), whole) != 0 || fseek(file->stream, whole, SEEK_SET) != 0)
        return cannot(why, "write", file->part);
    return whole > 0 || put(file->stream, header, strlen(header)) || cannot(why, "write", file->part);
}

static bool open_stream(struct partial_file *file, const char *path, const char *header, struct obstacle *why)
{
    file->stream = path ? whole_file_straight(path) : stdout;
    if (!file->stream) return cannot(why, "write", path);
    return put(file->stream, header, strlen(header)) || cannot(why, "write", path ? path : "-");
}

/* Open the part in the folder of the link target, so that it can be renamed. */
static bool open_beside(struct partial_file *file, const char *header, const char *key, bool resume,
                        struct obstacle *why)
{
    char target[place_size];
    if (!place_target(file->path, target)) return cannot(why, "write", file->path);
    file->target = partial_format("%s", target);
    file->part = partial_format("%s.part", target);
    file->key = partial_format("%s.part.key", target);
    return file->target && file->part && file->key && open_part(file, resume, why) &&
           fill_part(file, header, key, why);
}

static void forget(struct partial_file *file)
{
    if (file->stream && file->stream != stdout) fclose(file->stream);
    partial_sums_close(&file->sums);
    free(file->target);
    free(file->part);
    free(file->key);
    *file = (struct partial_file){0};
}

enum partial_opening partial_file_open(struct partial_file *file, const char *path, const char *header,
                                       const char *key, bool resume, char **why)
{
    struct stat status;
    struct obstacle obstacle = {.kind = partial_refused};
    *file = (struct partial_file){.path = path};
    bool straight =
        !path || place_descriptor(path) >= 0 || (stat(path, &status) == 0 && !S_ISREG(status.st_mode));
    bool fine = straight ? open_stream(file, path, header, &obstacle)
                         : open_beside(file, header, key, resume, &obstacle);
    if (!fine) forget(file);
    *why = obstacle.text;
    return fine ? partial_opened : obstacle.kind;
}

/* ---- writing */

int partial_file_write(void *context, const char *rows, size_t length)
{
    struct partial_file *file = context;
    bool written = (!file->sums.stream || partial_sums_add(&file->sums, rows, length)) &&
                   put(file->stream, rows, length);
    if (written) return 0;
    if (!file->error) file->error = errno;
    return 1;
}

/* Rename the table over the target, with the mode of an existing file. */
static bool put_in_place(const struct partial_file *file)
{
    struct stat before;
    if (stat(file->target, &before) == 0) whole_file_be_like(fileno(file->stream), &before);
    return fsync(fileno(file->stream)) == 0 && rename(file->part, file->target) == 0;
}

bool partial_file_close(struct partial_file *file, bool whole)
{
    bool fine = !file->error && fflush(file->stream) == 0;
    int reason = file->error ? file->error : errno;
    if (fine && whole && file->part) {
        fine = put_in_place(file);
        reason = errno;
        if (fine) unlink(file->key);
    }
    if (file->stream != stdout && fclose(file->stream) != 0) {
        if (fine) reason = errno;
        fine = false;
    }
    file->stream = NULL;
    forget(file);
    errno = reason;
    return fine;
}
