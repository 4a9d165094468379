/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Memory that runs out on demand. Programs listed as `allocation_tests` are linked so that every malloc,
 * calloc and realloc of the library, of GSL and of libyaml passes here (those that libc makes for itself do
 * not).
 *
 * A test fails each allocation of a call in turn, until the call asks for less than that:
 *
 *     for (size_t n = 0;; n++) {
 *         fail_alloc_at(n);
 *         bool ok = call_under_test();
 *         if (!fail_alloc_end()) break; // the whole call has passed, and `ok` must hold
 *         assert_false(ok);
 *     }
 *
 * What such a call leaks is found by the same test under AddressSanitizer or valgrind.
 */
#ifndef FBD_TESTS_FAIL_ALLOC_H
#define FBD_TESTS_FAIL_ALLOC_H

#include <stdbool.h>
#include <stddef.h>

/* From now on allocation `n` returns NULL, counted from 0; the others succeed. */
void fail_alloc_at(size_t n);

/* The same, but memory stays out: allocation `n` and all later ones return NULL. */
void fail_alloc_from(size_t n);

/* Back to normal. True if any allocation was made to fail since fail_alloc_at or fail_alloc_from. */
bool fail_alloc_end(void);

/* How many allocations were asked for since fail_alloc_at or fail_alloc_from. */
size_t fail_alloc_count(void);

/* From now on the bytes in use are counted, from 0; and how many there were at most. (For one thread.) */
void alloc_peak_start(void);
long alloc_peak(void);

#endif
