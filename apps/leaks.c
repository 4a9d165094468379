/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * For a build under AddressSanitizer: at the end of a program LeakSanitizer looks through all of its memory only when a
 * block is left that was not freed. Where none is left, nothing can have leaked; and the search takes longer than
 * all the rest of a short run, of which the tests start thousands.
 */
#include <sanitizer/allocator_interface.h>
#include <sanitizer/lsan_interface.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdio_ext.h>

static atomic_long in_use; /* blocks */

static void allocated(const volatile void *block, size_t size)
{
    (void)size;
    if (block) atomic_fetch_add(&in_use, 1);
}

static void freed(const volatile void *block)
{
    if (block) atomic_fetch_sub(&in_use, 1);
}

static void __attribute__((constructor)) count_blocks(void)
{
    __sanitizer_install_malloc_and_free_hooks(allocated, freed);
}

/* LeakSanitizer asks this at the end. The C library never frees the buffers of the standard streams. */
int __lsan_is_turned_off(void)
{
    FILE *const streams[] = {stdin, stdout, stderr};
    long buffers = 0;
    for (int i = 0; i < 3; i++) buffers += __fbufsize(streams[i]) > 1;
    return atomic_load(&in_use) <= buffers;
}
