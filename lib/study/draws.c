/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/draws.h"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>

/* ---- SplitMix64 */

static const uint64_t golden = UINT64_C(0x9E3779B97F4A7C15);

static uint64_t mix(uint64_t z)
{
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return z ^ z >> 31;
}

static uint64_t next(void *state)
{
    uint64_t *counter = state;
    *counter += golden;
    return mix(*counter);
}

static unsigned long next_integer(void *state)
{
    return (unsigned long)(next(state) >> 32);
}

/* The upper 53 bits as a double in [0, 1). */
static double next_double(void *state)
{
    return (double)(next(state) >> 11) * 0x1p-53;
}

static void start(void *state, unsigned long seed)
{
    uint64_t *counter = state;
    *counter = seed;
}

static const gsl_rng_type splitmix64 = {.name = "splitmix64",
                                        .max = 0xFFFFFFFFUL,
                                        .min = 0,
                                        .size = sizeof(uint64_t),
                                        .set = start,
                                        .get = next_integer,
                                        .get_double = next_double};

/* ---- draws */

double draw(enum distribution distribution, double a, double b, struct draw_place place)
{
    uint64_t counter = mix(mix(mix(place.seed + golden) ^ place.member) + golden * place.index);
    const gsl_rng generator = {&splitmix64, &counter};
    switch (distribution) {
    case draw_uniform: return gsl_ran_flat(&generator, a, b);
    case draw_normal: return a + gsl_ran_gaussian_ziggurat(&generator, b);
    case draw_loguniform: return exp(gsl_ran_flat(&generator, log(a), log(b)));
    }
    return NAN;
}
