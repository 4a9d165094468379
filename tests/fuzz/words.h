/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The words of the model language, from its own tables: in sets whose words can stand in each other's place.
 */
#ifndef TESTS_FUZZ_WORDS_H
#define TESTS_FUZZ_WORDS_H

#include <stddef.h>

enum { most_words = 128 };

/* The words of a set: all motions, the keys of one group, the choices of a key, units, functions. */
struct word_set {
    const char *words[most_words];
    size_t count;
};

/* Call `visit` with every set. Sets may come more than once. */
void each_word_set(void (*visit)(void *context, const struct word_set *set), void *context);

#endif
