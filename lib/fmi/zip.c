/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/zip.h"

#include <stdint.h>
#include <string.h>

/* CRC-32 of ISO 3309, bit by bit: a table is not worth its length. */
static uint32_t checksum(const char *bytes, size_t length)
{
    uint32_t crc = UINT32_MAX;
    for (size_t i = 0; i < length; i++) {
        crc ^= (unsigned char)bytes[i];
        for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ ((crc & 1u) ? UINT32_C(0xEDB88320) : 0u);
    }
    return ~crc;
}

/* Append a number, little endian. */
static void put(struct text *text, uint32_t number, int bytes)
{
    for (int i = 0; i < bytes; i++) {
        char byte = (char)(unsigned char)(number >> 8 * i & 0xFFu);
        text_add_bytes(text, &byte, 1);
    }
}

struct entry {
    const char *name, *bytes;
    size_t length;  /* of the bytes */
    uint32_t whole; /* of the file */
    uint32_t crc;   /* of the file */
    bool deflated;
};

/* Append the common part of a file header and a directory entry: version 1.0, for deflated files 2.0, names in UTF-8,
 * midnight of 1 January 1980. */
static void put_common(struct text *text, const struct entry *entry)
{
    put(text, entry->deflated ? 20 : 10, 2);
    put(text, 0x0800, 2);
    put(text, entry->deflated ? 8 : 0, 2);
    put(text, 0, 2);
    put(text, 1 << 5 | 1, 2);
    put(text, entry->crc, 4);
    put(text, (uint32_t)entry->length, 4);
    put(text, entry->whole, 4);
    put(text, (uint32_t)strlen(entry->name), 2);
    put(text, 0, 2);
}

static void add(struct zip *zip, const struct entry *entry)
{
    size_t start = zip->files.length;
    if (entry->length > UINT32_MAX / 2 || start > UINT32_MAX / 2 || zip->count == UINT16_MAX)
        zip->failed = true;
    if (zip->failed) return;
    put(&zip->files, 0x04034B50, 4);
    put_common(&zip->files, entry);
    text_add(&zip->files, entry->name);
    text_add_bytes(&zip->files, entry->bytes, entry->length);
    put(&zip->directory, 0x02014B50, 4);
    put(&zip->directory, entry->deflated ? 20 : 10, 2);
    put_common(&zip->directory, entry);
    put(&zip->directory, 0, 2); /* no comment, first disk, no attributes */
    put(&zip->directory, 0, 2);
    put(&zip->directory, 0, 2);
    put(&zip->directory, 0, 4);
    put(&zip->directory, (uint32_t)start, 4);
    text_add(&zip->directory, entry->name);
    zip->count++;
}

void zip_add(struct zip *zip, const char *name, const char *bytes, size_t length)
{
    add(zip, &(struct entry){name, bytes, length, (uint32_t)length, checksum(bytes, length), false});
}

/* A number of four bytes, little endian. */
static uint32_t number_at(const char *bytes)
{
    uint32_t number = 0;
    for (int i = 0; i < 4; i++) number |= (uint32_t)(unsigned char)bytes[i] << 8 * i;
    return number;
}

/* Ten bytes of a header without optional fields, the deflated file, its checksum and its length. */
void zip_add_gzip(struct zip *zip, const char *name, const char *bytes, size_t length)
{
    enum { header = 10, trailer = 8 };
    static const char start[] = {'\x1f', '\x8b', 8, 0};
    if (length < header + trailer || memcmp(bytes, start, sizeof start) != 0) {
        zip_add(zip, name, bytes, length);
        return;
    }
    const char *end = bytes + length - trailer;
    add(zip, &(struct entry){name, bytes + header, length - header - trailer, number_at(end + 4),
                             number_at(end), true});
}

char *zip_finish(struct zip *zip, size_t *length)
{
    size_t start = zip->files.length, size = zip->directory.length;
    if (zip->directory.data) text_add_bytes(&zip->files, zip->directory.data, size);
    put(&zip->files, 0x06054B50, 4);
    put(&zip->files, 0, 4);
    put(&zip->files, zip->count, 2);
    put(&zip->files, zip->count, 2);
    put(&zip->files, (uint32_t)size, 4);
    put(&zip->files, (uint32_t)start, 4);
    put(&zip->files, 0, 2);
    bool failed = zip->failed || zip->files.failed || zip->directory.failed;
    text_free(&zip->directory);
    if (failed) text_free(&zip->files);
    char *bytes = zip->files.data;
    *length = zip->files.length;
    *zip = (struct zip){0};
    return failed ? NULL : bytes;
}
