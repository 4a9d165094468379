/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fail_alloc.h"

#include <malloc.h>
#include <stdint.h>

/* NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp): --wrap dictates the names. */

/* The linker's option --wrap gives these names: calls of malloc come to __wrap_malloc, and the C library's
 * own is left as __real_malloc. */
void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *memory, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *memory, size_t size);
void __real_free(void *memory);
void __wrap_free(void *memory);

static size_t asked;
static size_t first_failing = SIZE_MAX;
static size_t last_failing = SIZE_MAX;
static bool failed;
static long live, peak; /* bytes */

static void start(size_t first, size_t last)
{
    asked = 0;
    first_failing = first;
    last_failing = last;
    failed = false;
}

void fail_alloc_at(size_t n)
{
    start(n, n);
}

void fail_alloc_from(size_t n)
{
    start(n, SIZE_MAX);
}

bool fail_alloc_end(void)
{
    first_failing = last_failing = SIZE_MAX;
    return failed;
}

size_t fail_alloc_count(void)
{
    return asked;
}

static bool refuse(void)
{
    size_t n = asked++;
    bool refused = n >= first_failing && n <= last_failing;
    failed = failed || refused;
    return refused;
}

void alloc_peak_start(void)
{
    live = peak = 0;
}

long alloc_peak(void)
{
    return peak;
}

static void *note(void *memory, long before)
{
    live += (long)malloc_usable_size(memory) - before;
    if (live > peak) peak = live;
    return memory;
}

void *__wrap_malloc(size_t size)
{
    return refuse() ? NULL : note(__real_malloc(size), 0);
}

void *__wrap_calloc(size_t count, size_t size)
{
    return refuse() ? NULL : note(__real_calloc(count, size), 0);
}

void *__wrap_realloc(void *memory, size_t size)
{
    long before = (long)malloc_usable_size(memory);
    return refuse() ? NULL : note(__real_realloc(memory, size), before);
}

void __wrap_free(void *memory)
{
    live -= (long)malloc_usable_size(memory);
    __real_free(memory);
}

/* NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp) */
