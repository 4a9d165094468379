/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fuzz.h"

#include <gsl/gsl_errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

bool fuzz_hurries = false;

int LLVMFuzzerInitialize(int *argc, char ***argv)
{
    (void)argv;
    fuzz_hurries = argc != NULL;
    gsl_set_error_handler_off(); /* as the programs do */
    return 0;
}

void fuzz_fail(const char *what, ...)
{
    va_list args;
    fputs("\nfound: ", stderr);
    va_start(args, what);
    vfprintf(stderr, what, args);
    va_end(args);
    fputs("\n", stderr);
    abort();
}

static int hexadecimal(char c)
{
    if (c >= '0' && c <= '9') return c - '0';
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

uint64_t fuzz_choices(const char *text, size_t length)
{
    uint64_t given = 0, hash = 14695981039346656037u; /* FNV-1a */
    size_t digits = 0;
    if (length > 2 && text[0] == '#' && text[1] == '?')
        for (; digits < 16 && 2 + digits < length && hexadecimal(text[2 + digits]) >= 0; digits++)
            given = given << 4 | (uint64_t)hexadecimal(text[2 + digits]);
    if (digits == 16) return given;
    for (size_t i = 0; i < length; i++) hash = (hash ^ (uint8_t)text[i]) * 1099511628211u;
    return hash ^ hash >> 29;
}

unsigned fuzz_take(uint64_t *choices, unsigned bits)
{
    unsigned taken = (unsigned)(*choices & ((1u << bits) - 1));
    *choices >>= bits;
    return taken;
}
