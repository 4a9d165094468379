/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a sanitizer looks for is in a line that runs, however often it runs: tests that are long because they
 * say the same of many methods, tolerances or periods say it of fewer there, and of all in the plain build.
 */
#ifndef FBD_TESTS_THOROUGH_H
#define FBD_TESTS_THOROUGH_H

#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>

static inline bool thorough(void)
{
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    return false;
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
    return false;
#else
    return true;
#endif
#else
    return true;
#endif
}

/* How many times as many random draws as usual: FBD_DRAWS, which `make generators` sets. */
static inline int draws_asked(void)
{
    const char *given = getenv("FBD_DRAWS");
    return given ? (int)strtol(given, NULL, 10) : 1;
}

/* Of so many random draws an eighth where it is not thorough: what a sanitizer sees shows in the first ones. */
static inline int draws_of(int count)
{
    count *= draws_asked();
    return thorough() ? count : (count + 7) / 8;
}

/* Of what is listed, methods or models: which to take where it is not, every third, with `turn` another third. */
static inline bool is_in_turn(size_t index, size_t turn)
{
    return thorough() || (index + turn) % 3 == 0;
}

#endif
