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

/* Append the common part of a file header and a directory entry: version 1.0, names in UTF-8, stored,
 * midnight of 1 January 1980. */
static void put_common(struct text *text, uint32_t crc, size_t length, size_t name_length)
{
    put(text, 10, 2);
    put(text, 0x0800, 2);
    put(text, 0, 2);
    put(text, 0, 2);
    put(text, 1 << 5 | 1, 2);
    put(text, crc, 4);
    put(text, (uint32_t)length, 4);
    put(text, (uint32_t)length, 4);
    put(text, (uint32_t)name_length, 2);
    put(text, 0, 2);
}

void zip_add(struct zip *zip, const char *name, const char *bytes, size_t length)
{
    size_t start = zip->files.length, name_length = strlen(name);
    uint32_t crc = checksum(bytes, length);
    if (length > UINT32_MAX / 2 || start > UINT32_MAX / 2 || zip->count == UINT16_MAX) zip->failed = true;
    if (zip->failed) return;
    put(&zip->files, 0x04034B50, 4);
    put_common(&zip->files, crc, length, name_length);
    text_add(&zip->files, name);
    text_add_bytes(&zip->files, bytes, length);
    put(&zip->directory, 0x02014B50, 4);
    put(&zip->directory, 10, 2);
    put_common(&zip->directory, crc, length, name_length);
    put(&zip->directory, 0, 2); /* no comment, first disk, no attributes */
    put(&zip->directory, 0, 2);
    put(&zip->directory, 0, 2);
    put(&zip->directory, 0, 4);
    put(&zip->directory, (uint32_t)start, 4);
    text_add(&zip->directory, name);
    zip->count++;
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
