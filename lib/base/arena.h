/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Arena: memory that is allocated piece by piece and freed all at once.
 *
 * A scene and a model are built from many small objects that live exactly as long as their owner, so one call
 * frees them. Memory is zeroed and aligned for any type. A failed allocation returns NULL and sets `failed`,
 * so that a builder may check once at the end.
 */
#ifndef FBD_BASE_ARENA_H
#define FBD_BASE_ARENA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct arena_chunk;

struct arena {
    struct arena_chunk *chunks;
    bool failed;    /* true once any allocation has failed */
    bool much_room; /* the first chunk has the largest size, for arenas that are refilled often */
    size_t room;    /* of the first chunk after arena_empty: all that the arena held before */
};

/* `count` zeroed objects of `size` bytes, or NULL when memory is out or count * size overflows. */
void *arena_array(struct arena *arena, size_t count, size_t size);

/* The same, cleared or not: tables that are written completely before they are read need not be. */
void *arena_take(struct arena *arena, size_t count, size_t size, bool cleared);

/* A zero-terminated copy of the first `length` bytes of `text`, or NULL. */
char *arena_text(struct arena *arena, const char *text, size_t length);

/* printf into the arena; NULL when memory is out. */
char *arena_printf(struct arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The address in `b` that corresponds to an address in `a`, if the two were filled by the same calls; 0 if
 * the address is not in `a`. */
uintptr_t arena_twin(const struct arena *a, const struct arena *b, uintptr_t address);

/* Receives a word of one arena that differs from its twin; false ends the comparison. */
typedef bool arena_difference(void *context, uint64_t *word, uint64_t twin);

/* Compare two arenas word by word. False when they were not filled by the same calls, or `differs` returned
 * false. */
bool arena_compare(const struct arena *a, const struct arena *b, arena_difference *differs, void *context);

/* Forget all pieces, and keep the memory in one chunk for as many again. */
void arena_empty(struct arena *arena);

/* Free all memory; the arena is then empty and may be used again. */
void arena_free(struct arena *arena);

#define ARENA_NEW(arena, type)          ((type *)arena_array((arena), 1, sizeof(type)))
#define ARENA_ARRAY(arena, count, type) ((type *)arena_array((arena), (count), sizeof(type)))

#endif
