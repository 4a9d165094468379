/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Source: the bytes of a model file, checked before they are parsed as YAML.
 *
 * libyaml gives no position for bytes that it cannot read, and it counts lines at characters where editors do
 * not break them. So the bytes are checked first: valid UTF-8 (a byte order mark is skipped), no control
 * characters but tab and line ends, no exotic line separators, no more than `source_most_bytes`.
 */
#ifndef FBD_DOCUMENT_SOURCE_H
#define FBD_DOCUMENT_SOURCE_H

#include "base/diag.h"

enum { source_most_bytes = 64 * 1024 * 1024 };

struct source {
    const char *text; /* after a byte order mark; not necessarily terminated */
    size_t length;
};

/* Check `text[0..length)`. False with one note (`file-too-large`, `not-utf-8`, `control-character`) at the
 * first wrong byte; else `*source` is the text to parse. */
bool source_open(const char *text, size_t length, fbd_errors *errors, struct source *source);

/* True when a line ends with the byte at `text`: LF, or CR unless LF follows (CR LF is one line end). */
static inline bool source_line_ends(const char *text, const char *end)
{
    return *text == '\n' || (*text == '\r' && (text + 1 == end || text[1] != '\n'));
}

#endif
