/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/utf8.h"

#include <stdio.h>
#include <string.h>

size_t utf8_decode(const char *text, size_t length, unsigned *code)
{
    static const unsigned least[] = {0, 0, 0x80, 0x800, 0x10000};
    if (length == 0) return 0;
    unsigned lead = (unsigned char)text[0];
    size_t width = lead < 0x80   ? 1
                   : lead < 0xC0 ? 0
                   : lead < 0xE0 ? 2
                   : lead < 0xF0 ? 3
                   : lead < 0xF8 ? 4
                                 : 0;
    if (width == 0 || width > length) return 0;
    unsigned value = width == 1 ? lead : lead & (0x7Fu >> width);
    for (size_t i = 1; i < width; i++) {
        unsigned byte = (unsigned char)text[i];
        if ((byte & 0xC0) != 0x80) return 0;
        value = value << 6 | (byte & 0x3F);
    }
    if (value < least[width] || value > 0x10FFFF || (value >= 0xD800 && value <= 0xDFFF)) return 0;
    *code = value;
    return width;
}

/* Unicode's categories Cc, Cf, Zl and Zp, the property Default_Ignorable, and the noncharacters of a block:
 * first and last of each run, in order. */
static const unsigned hidden[][2] = {
    {0x0000, 0x001F},   {0x007F, 0x009F},   {0x00AD, 0x00AD},   {0x034F, 0x034F},   {0x0600, 0x0605},
    {0x061C, 0x061C},   {0x06DD, 0x06DD},   {0x070F, 0x070F},   {0x0890, 0x0891},   {0x08E2, 0x08E2},
    {0x115F, 0x1160},   {0x17B4, 0x17B5},   {0x180B, 0x180F},   {0x200B, 0x200F},   {0x2028, 0x202E},
    {0x2060, 0x206F},   {0x3164, 0x3164},   {0xFDD0, 0xFDEF},   {0xFE00, 0xFE0F},   {0xFEFF, 0xFEFF},
    {0xFFA0, 0xFFA0},   {0xFFF0, 0xFFFB},   {0x110BD, 0x110BD}, {0x110CD, 0x110CD}, {0x13430, 0x1343F},
    {0x1BCA0, 0x1BCA3}, {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF},
};

bool utf8_is_plain(unsigned code)
{
    size_t low = 0, high = sizeof hidden / sizeof *hidden;
    if (code >= ' ' && code <= '~') return true;
    if ((code & 0xFFFE) == 0xFFFE) return false; /* the last two of each plane are noncharacters */
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (code > hidden[middle][1])
            low = middle + 1;
        else
            high = middle;
    }
    return low == sizeof hidden / sizeof *hidden || code < hidden[low][0];
}

struct utf8_shown utf8_show(const char *text)
{
    unsigned code = 0;
    struct utf8_shown shown = {.taken = utf8_decode(text, strnlen(text, 4), &code)};
    if (shown.taken > 0 && utf8_is_plain(code)) {
        shown.plain = true;
        shown.length = shown.taken;
        memcpy(shown.text, text, shown.taken);
        return shown;
    }
    const char *format = code < 0x80 ? "\\x%02x" : code < 0x10000 ? "\\u%04x" : "\\U%08x";
    if (shown.taken == 0) {
        code = (unsigned char)*text;
        format = "\\x%02x";
        shown.taken = 1;
    }
    shown.length = (size_t)snprintf(shown.text, sizeof shown.text, format, code);
    return shown;
}
