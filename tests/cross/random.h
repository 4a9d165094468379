/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Random numbers from a seed, the same everywhere (splitmix64).
 */
#ifndef CROSS_RANDOM_H
#define CROSS_RANDOM_H

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

struct random {
    uint64_t state;
};

static inline uint64_t random_bits(struct random *random)
{
    uint64_t z = random->state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static inline int random_below(struct random *random, int n)
{
    return (int)(random_bits(random) % (uint64_t)n);
}

static inline bool random_chance(struct random *random, double probability)
{
    return (double)(random_bits(random) >> 11) * 0x1p-53 < probability;
}

/* With three decimals, so that a file can be read. */
static inline double random_between(struct random *random, double low, double high)
{
    double u = (double)(random_bits(random) >> 11) * 0x1p-53;
    return round((low + u * (high - low)) * 1000) / 1000;
}

#endif
