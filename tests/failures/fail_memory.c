/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The allocator of the layer: the C library's, with calls that fail, and a table of the blocks that are in
 * use.
 */
#include "layer.h"

#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* The C library's own, which can be called before anything else is found. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

/* ---- blocks in use: a hash table by address, with linear probing
 *
 * Neighbours in memory are neighbours in the table, so that a run touches few of its pages: each run is a fork, to which
 * every page comes anew. */

enum { table_size = 1 << 18 };

struct block {
    const void *memory, *caller;
};

static struct block table[table_size];
static long in_use; /* how many are in it */
static bool noting;
static atomic_flag lock = ATOMIC_FLAG_INIT;

static size_t home(const void *memory)
{
    return (uintptr_t)memory / 16 % table_size;
}

static size_t next(size_t place)
{
    return (place + 1) % table_size;
}

static void *note(void *memory, const void *caller)
{
    if (!noting || !memory) return memory;
    while (atomic_flag_test_and_set(&lock)) {
    }
    size_t place = home(memory);
    while (table[place].memory) place = next(place);
    table[place] = (struct block){memory, caller};
    in_use++;
    atomic_flag_clear(&lock);
    return memory;
}

/* Those behind a gap that would not be found over it move into it (Knuth, 6.4, algorithm R). */
static void close_gap(size_t gap)
{
    for (size_t place = next(gap); table[place].memory; place = next(place)) {
        size_t from_home = (place - home(table[place].memory)) % table_size;
        if (from_home < (place - gap) % table_size) continue;
        table[gap] = table[place];
        gap = place;
    }
    table[gap].memory = NULL;
    in_use--;
}

static void forget(const void *memory)
{
    if (!noting || !memory) return;
    while (atomic_flag_test_and_set(&lock)) {
    }
    size_t place = home(memory);
    while (table[place].memory && table[place].memory != memory) place = next(place);
    if (table[place].memory) close_gap(place);
    atomic_flag_clear(&lock);
}

void layer_memory_begin(void)
{
    noting = true;
}

const void *layer_memory_left(long *place)
{
    for (; in_use > 0 && *place < table_size; ++*place) {
        if (!table[*place].memory) continue;
        in_use--;
        return table[(*place)++].caller;
    }
    return NULL;
}

/* ---- the functions */

static bool refuse(const char *what, const void *caller)
{
    bool refused = layer_refuses(layer_memory, what, caller);
    if (refused) errno = ENOMEM;
    return refused;
}

#define CALLER __builtin_return_address(0)

void *malloc(size_t size)
{
    return refuse("malloc", CALLER) ? NULL : note(__libc_malloc(size), CALLER);
}

void *calloc(size_t count, size_t size)
{
    return refuse("calloc", CALLER) ? NULL : note(__libc_calloc(count, size), CALLER);
}

static void *change(void *memory, size_t size, const void *caller)
{
    forget(memory);
    void *changed = __libc_realloc(memory, size);
    bool kept = !changed && size > 0;
    note(kept ? memory : changed, caller);
    return changed;
}

void *realloc(void *memory, size_t size)
{
    return refuse("realloc", CALLER) ? NULL : change(memory, size, CALLER);
}

void *reallocarray(void *memory, size_t count, size_t size)
{
    if (refuse("reallocarray", CALLER) || (size > 0 && count > SIZE_MAX / size)) return NULL;
    return change(memory, count * size, CALLER);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    return refuse("aligned_alloc", CALLER) ? NULL : note(__libc_memalign(alignment, size), CALLER);
}

int posix_memalign(void **memory, size_t alignment, size_t size)
{
    void *made = refuse("posix_memalign", CALLER) ? NULL : note(__libc_memalign(alignment, size), CALLER);
    if (!made) return ENOMEM;
    *memory = made;
    return 0;
}

void free(void *memory)
{
    forget(memory);
    __libc_free(memory);
}

/* A thread needs memory, which is not taken by malloc. */
int pthread_create(pthread_t *thread, const pthread_attr_t *how, void *(*start)(void *), void *argument)
{
    static int (*create)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
    if (!create) *(void **)&create = dlsym(RTLD_NEXT, "pthread_create");
    return refuse("pthread_create", CALLER) ? EAGAIN : create(thread, how, start, argument);
}
