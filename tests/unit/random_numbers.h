/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random numbers for tests: the same everywhere for the same seed, which a failing test prints.
 */
#ifndef TESTS_RANDOM_NUMBERS_H
#define TESTS_RANDOM_NUMBERS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

struct random_numbers {
    uint64_t state; /* begins as the seed */
};

/* 64 random bits: splitmix64 (Steele, Lea and Flood, OOPSLA 2014). */
static inline uint64_t random_bits(struct random_numbers *numbers)
{
    uint64_t z = numbers->state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* Evenly between `low` and `high`. */
static inline double random_between(struct random_numbers *numbers, double low, double high)
{
    return low + (high - low) * ((double)(random_bits(numbers) >> 11) * 0x1p-53);
}

/* True for a share of all. */
static inline bool random_chance(struct random_numbers *numbers, double share)
{
    return random_between(numbers, 0, 1) < share;
}

/* The same for a share of all, else 0. */
static inline double random_perhaps(struct random_numbers *numbers, double share, double low, double high)
{
    double value = random_between(numbers, low, high);
    return random_chance(numbers, share) ? value : 0;
}

/* How many to draw, or from which seed: a variable of the environment, or what is usual. */
static inline int number_of(const char *name, int usual)
{
    const char *given = getenv(name);
    return given ? (int)strtol(given, NULL, 10) : usual;
}

#endif
