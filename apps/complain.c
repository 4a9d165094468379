/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "complain.h"

#include <stdarg.h>
#include <stdio.h>

#include "fbd_export.h"

void complain(const char *format, ...)
{
    enum { longest = 8192 }; /* two paths of maximum length */
    char message[longest], shown[2 * longest];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    fbd_escape(message, shown, sizeof shown);
    fprintf(stderr, "%s\n", shown);
}
