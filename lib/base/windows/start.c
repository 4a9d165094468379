/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The start of a program on Windows, before main: the same bytes in files and streams as elsewhere, texts in UTF-8, and
 * paths of the command line with slashes, which Windows takes too.
 */
#include <windows.h>

static void write_slashes(char *text)
{
    for (; *text; text++)
        if (IsDBCSLeadByte((BYTE)*text) && text[1])
            text++;
        else if (*text == '\\')
            *text = '/';
}

__attribute__((constructor)) static void begin_program(void)
{
    _fmode = _O_BINARY;
    for (int i = 0; i <= 2; i++) _setmode(i, _O_BINARY);
    SetConsoleOutputCP(CP_UTF8);
    for (int i = 1; i < __argc; i++) write_slashes(__argv[i]);
}
