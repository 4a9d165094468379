/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Draws: random numbers that depend only on their position, not on earlier draws.
 *
 * Draw i of a member of a sweep is the same for any worker and any order. So each draw has its own generator:
 * SplitMix64, whose state is a counter, started at a hash of (seed, member, i) and written as a GSL generator
 * for use with GSL's distributions.
 *
 * Source: Steele, Lea & Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014, section 5 and
 * figure 17 (variant 13 of the mixing function).
 */
#ifndef FBD_STUDY_DRAWS_H
#define FBD_STUDY_DRAWS_H

#include <stdint.h>

enum distribution {
    draw_uniform,    /* between a and b */
    draw_normal,     /* mean a, standard deviation b */
    draw_loguniform, /* between a and b, uniform in the logarithm */
};

/* The position of a draw. */
struct draw_place {
    uint64_t seed, member, index;
};

double draw(enum distribution distribution, double a, double b, struct draw_place place);

#endif
