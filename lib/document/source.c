/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "document/source.h"

#include <string.h>

#include "base/utf8.h"

/* True for characters that a text file must not contain: C0 and C1 controls, the separators that libyaml
 * counts as line ends but editors do not, a byte order mark in the middle, and the two noncharacters. */
static bool is_control(unsigned code)
{
    if (code < 0x20) return code != '\t' && code != '\n' && code != '\r';
    return (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029 || code == 0xFEFF ||
           code == 0xFFFE || code == 0xFFFF;
}

static bool is_utf16(const char *text, size_t length)
{
    return length >= 2 && (memcmp(text, "\xFF\xFE", 2) == 0 || memcmp(text, "\xFE\xFF", 2) == 0);
}

static void note_bad_byte(fbd_errors *errors, struct pos at, unsigned byte)
{
    diag_add(errors, FBD_ERROR, "not-utf-8", at, "save the file as plain text in UTF-8",
             "byte 0x%02X is not UTF-8 text", byte);
}

static void note_control(fbd_errors *errors, struct pos at, unsigned code)
{
    if (code == 0)
        diag_add(errors, FBD_ERROR, "control-character", at,
                 "is this a model file? it looks like binary data", "a zero byte in the text");
    else
        diag_add(errors, FBD_ERROR, "control-character", at, "delete it; it may be invisible in an editor",
                 "the control character U+%04X is not allowed in a model file", code);
}

bool source_open(const char *text, size_t length, fbd_errors *errors, struct source *source)
{
    struct pos at = {1, 1};
    if (length > source_most_bytes) {
        diag_add(errors, FBD_ERROR, "file-too-large", at, NULL, "the file has %zu bytes; the limit is %d MiB",
                 length, source_most_bytes / (1024 * 1024));
        return false;
    }
    if (is_utf16(text, length)) {
        diag_add(errors, FBD_ERROR, "not-utf-8", at, "save the file as plain text in UTF-8",
                 "the file is UTF-16");
        return false;
    }
    if (length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0) {
        text += 3;
        length -= 3;
    }
    *source = (struct source){text, length};
    for (size_t i = 0; i < length;) {
        if (text[i] >= ' ' && text[i] <= '~') {
            at.column++;
            i++;
            continue;
        }
        unsigned code;
        size_t width = utf8_decode(text + i, length - i, &code);
        if (width == 0) {
            note_bad_byte(errors, at, (unsigned char)text[i]);
            return false;
        }
        if (is_control(code)) {
            note_control(errors, at, code);
            return false;
        }
        at.column++;
        if (source_line_ends(text + i, text + length)) at = (struct pos){at.line + 1, 1};
        i += width;
    }
    return true;
}
