/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/arena.h"

#include "base/format.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct arena_chunk {
    struct arena_chunk *next;
    size_t used, size;
    max_align_t data[];
};

/* Chunks grow from the first to the largest size, since many arenas hold no more than one expression. Only
 * requested memory is cleared, and only on request. */
enum { first_chunk = 512, largest_chunk = 16384 };

static size_t round_up(size_t size)
{
    size_t unit = sizeof(max_align_t);
    return (size + unit - 1) / unit * unit;
}

/* Put a chunk with room for `wanted` bytes at the head. The chunk of a single large piece comes zeroed from
 * calloc and is not cleared again. */
static bool add_chunk(struct arena *arena, size_t wanted, bool *clear)
{
    size_t next = arena->chunks ? 4 * arena->chunks->size : first_chunk;
    if (next > largest_chunk || arena->much_room) next = largest_chunk;
    if (!arena->chunks && next < arena->room) next = arena->room;
    *clear = wanted >= next;
    size_t room = wanted > next ? wanted : next, size = sizeof(struct arena_chunk) + room;
    struct arena_chunk *chunk = *clear ? calloc(1, size) : malloc(size);
    if (!chunk) return false;
    chunk->used = 0;
    chunk->size = room;
    chunk->next = arena->chunks;
    arena->chunks = chunk;
    return true;
}

void *arena_take(struct arena *arena, size_t count, size_t size, bool cleared)
{
    size_t bytes;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 2) {
        arena->failed = true;
        return NULL;
    }
    size_t wanted = round_up(bytes > 0 ? bytes : 1);
    struct arena_chunk *chunk = arena->chunks;
    bool clear = false;
    if ((!chunk || chunk->size - chunk->used < wanted) && !add_chunk(arena, wanted, &clear)) {
        arena->failed = true;
        return NULL;
    }
    chunk = arena->chunks;
    void *start = (char *)chunk->data + chunk->used;
    chunk->used += wanted;
    return clear || !cleared ? start : memset(start, 0, wanted);
}

void *arena_array(struct arena *arena, size_t count, size_t size)
{
    return arena_take(arena, count, size, true);
}

char *arena_text(struct arena *arena, const char *text, size_t length)
{
    char *copy = arena_array(arena, length + 1, 1);
    if (copy && length) memcpy(copy, text, length);
    return copy;
}

char *arena_printf(struct arena *arena, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = format_list(NULL, 0, format, args);
    va_end(args);
    char *text = length < 0 ? NULL : arena_array(arena, (size_t)length + 1, 1);
    if (text) format_list(text, (size_t)length + 1, format, again);
    va_end(again);
    return text;
}

uintptr_t arena_twin(const struct arena *a, const struct arena *b, uintptr_t address)
{
    const struct arena_chunk *of_a = a->chunks, *of_b = b->chunks;
    for (; of_a && of_b; of_a = of_a->next, of_b = of_b->next) {
        uintptr_t start = (uintptr_t)of_a->data;
        if (address >= start && address < start + of_a->used)
            return (uintptr_t)of_b->data + (address - start);
    }
    return 0;
}

bool arena_compare(const struct arena *a, const struct arena *b, arena_difference *differs, void *context)
{
    struct arena_chunk *of_a = a->chunks;
    const struct arena_chunk *of_b = b->chunks;
    for (; of_a && of_b; of_a = of_a->next, of_b = of_b->next) {
        if (of_a->used != of_b->used) return false;
        uint64_t *words = (uint64_t *)of_a->data;
        const uint64_t *twins = (const uint64_t *)of_b->data;
        for (size_t i = 0; i < of_a->used / sizeof *words; i++)
            if (words[i] != twins[i] && !differs(context, &words[i], twins[i])) return false;
    }
    return !of_a && !of_b;
}

void arena_free(struct arena *arena)
{
    while (arena->chunks) {
        struct arena_chunk *next = arena->chunks->next;
        free(arena->chunks);
        arena->chunks = next;
    }
    arena->failed = false;
}

void arena_empty(struct arena *arena)
{
    struct arena_chunk *only = arena->chunks;
    if (!only || !only->next) {
        if (only) only->used = 0;
        arena->failed = false;
        return;
    }
    size_t room = 0;
    for (; only; only = only->next) room += only->size;
    arena_free(arena);
    arena->room = room;
}
