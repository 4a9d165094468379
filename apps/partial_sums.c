/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "partial_sums.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "partial_lines.h"
#include "whole_file.h"

/* The line between key and checksums. */
static const char heading[] = "rows";

enum { digits = 16, entry_length = digits + 1 };

/* FNV-1a (RFC 9923). Each step is one to one, so a single changed byte is always detected. Not a protection
 * against deliberate changes. */
static uint64_t hash(uint64_t start, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) start = (start ^ (unsigned char)text[i]) * UINT64_C(0x100000001B3);
    return start;
}

/* Seed by key and header, so that checksums of one sweep do not fit the rows of another. */
static uint64_t seed_of(const char *key, const char *header)
{
    return hash(hash(UINT64_C(0xCBF29CE484222325), key, strlen(key)), header, strlen(header));
}

/* ---- opening */

bool partial_sums_make(struct partial_sums *sums, const char *path, const char *key, const char *header)
{
    char *text = partial_format("%s%s\n", key, heading);
    if (!text) return false;
    *sums = (struct partial_sums){.seed = seed_of(key, header), .start = (long)strlen(text)};
    if (whole_file_put(path, text)) sums->stream = fopen(path, "r+");
    free(text);
    return sums->stream && fseek(sums->stream, sums->start, SEEK_SET) == 0;
}

/* True if the next line of the stream is `line`; otherwise sets *why, or leaves it NULL when the line cannot
 * be read. */
static bool is_line(FILE *stream, const char *line, size_t length, char **why)
{
    size_t there_length = 0;
    char *there = partial_line(stream, &there_length);
    bool same = there && there_length == length && memcmp(there, line, length) == 0;
    if (!same && (there || !partial_line_failed(stream)))
        *why = partial_format("it belongs to another sweep: there `%s`, here `%.*s`", there ? there : "",
                              (int)length, line);
    free(there);
    return same;
}

static bool same_key(FILE *stream, const char *key, char **why)
{
    for (; *key; key += strcspn(key, "\n") + 1)
        if (!is_line(stream, key, strcspn(key, "\n"), why)) return false;
    return is_line(stream, heading, strlen(heading), why);
}

enum partial_sums_opening partial_sums_open(struct partial_sums *sums, const char *path, const char *key,
                                            const char *header, char **why)
{
    *why = NULL;
    *sums = (struct partial_sums){.stream = fopen(path, "r+"), .seed = seed_of(key, header)};
    if (!sums->stream) return partial_sums_failed;
    if (!same_key(sums->stream, key, why)) return *why ? partial_sums_differ : partial_sums_failed;
    sums->start = ftell(sums->stream);
    return sums->start < 0 ? partial_sums_failed : partial_sums_opened;
}

void partial_sums_close(struct partial_sums *sums)
{
    if (sums->stream) fclose(sums->stream);
    sums->stream = NULL;
}

/* ---- checksums */

static void write_entry(const struct partial_sums *sums, const char *row, size_t length,
                        char entry[entry_length + 1])
{
    snprintf(entry, entry_length + 1, "%016" PRIx64 "\n", hash(sums->seed, row, length));
}

enum partial_row partial_sums_check(struct partial_sums *sums, const char *row, size_t length)
{
    char there[entry_length], here[entry_length + 1];
    if (fread(there, 1, sizeof there, sums->stream) != sizeof there) return partial_row_unknown;
    write_entry(sums, row, length, here);
    return memcmp(there, here, sizeof there) == 0 ? partial_row_same : partial_row_differs;
}

bool partial_sums_cut(struct partial_sums *sums, size_t rows)
{
    long end = sums->start + (long)rows * entry_length;
    return fseek(sums->stream, end, SEEK_SET) == 0 && ftruncate(fileno(sums->stream), end) == 0;
}

bool partial_sums_add(struct partial_sums *sums, const char *rows, size_t length)
{
    char entry[entry_length + 1];
    for (const char *row = rows, *end = rows + length; row < end;) {
        const char *stop = memchr(row, '\n', (size_t)(end - row));
        if (!stop) break;
        write_entry(sums, row, (size_t)(stop - row), entry);
        if (fwrite(entry, 1, entry_length, sums->stream) != entry_length) return false;
        row = stop + 1;
    }
    return fflush(sums->stream) == 0;
}
