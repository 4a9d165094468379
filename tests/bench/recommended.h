/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Is what fbd-cost recommends the cheapest, and does it say the same again?
 *
 * Each scene is studied twice. What the first study recommends for an accuracy is looked up in the second,
 * and its time there is held against the best time there.
 */
#ifndef FBD_TESTS_BENCH_RECOMMENDED_H
#define FBD_TESTS_BENCH_RECOMMENDED_H

#include <stdio.h>

enum { most_advice = 100 };

struct advice {
    const char *scene;
    char setting[80]; /* "rk8pd --tolerance 1e-07" */
    char best[80];    /* of the second study */
    double target, seconds, ratio;
};

struct recommended {
    struct advice advice[most_advice];
    size_t count;
    double worst_ratio;
    double seconds; /* of fbd-cost on the compound pendulum with default options */
    double repeat;  /* the largest change of its answers' times, relative */
};

/* `source` is the folder that has models/. */
void recommended_measure(struct recommended *recommended, const char *source);
void recommended_write(FILE *out, const struct recommended *recommended);

#endif
