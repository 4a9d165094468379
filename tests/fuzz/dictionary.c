/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Prints the words of the model language as a dictionary for libFuzzer.
 */
#include <stdio.h>

#include "words.h"

static void print_set(void *context, const struct word_set *set)
{
    (void)context;
    for (size_t i = 0; i < set->count; i++) printf("\"%s\"\n", set->words[i]);
}

int main(void)
{
    each_word_set(print_set, NULL);
    return 0;
}
