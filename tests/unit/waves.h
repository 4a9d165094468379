/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Sums of sines along motions in closed form, and all their zeros.
 *
 * A switching function h(t) = sum_k a_k sin(w_k x(t) + p_k) - c along a motion x(t) known in closed form has
 * |h''| <= M with M from the amplitudes alone. On [m - r, m + r] it has no zero where |h(m)| > |h'(m)| r + M
 * r^2/2, and at most one where |h'(m)| > M r. Halving until one of both holds finds every zero.
 */
#ifndef TESTS_WAVES_H
#define TESTS_WAVES_H

#include <stdbool.h>
#include <stddef.h>

#include "random_numbers.h"

enum { most_waves = 6, most_zeros = 4096 };

enum trajectory { along_time, along_coast, along_oscillation };

struct waves {
    int count;
    double a[most_waves], w[most_waves], p[most_waves], c;
    enum trajectory trajectory;
    double speed; /* of the coast; of the oscillation x = cos(speed t) */
};

struct zeros {
    size_t count;
    double t[most_zeros];
    bool doubtful; /* a zero that rounding does not tell from none */
};

/* h, h' and M at t. */
double waves_value(const struct waves *h, double t, double *slope, double *most);

/* Add the zeros between `low` and `high`. */
void waves_find(const struct waves *h, double low, double high, struct zeros *zeros);

/* Up to three waves. Thresholds near the crest of one wave, by gaps from 1e-12 to 1, or anywhere. */
struct waves waves_random(struct random_numbers *numbers, enum trajectory trajectory);

/* Two waves along time whose sizes add up to R and a share of 1e-4 to 1e-2 more or less, less R: their peaks are
 * just beyond it, or not. */
struct waves waves_near(struct random_numbers *numbers, double R);

/* The first time before `until` at which the sum is above c, or with `both` above c or below -c; HUGE_VAL without
 * one. */
double waves_first(const struct waves *h, double until, bool both);

/* sum_k a_k sin(w_k x + p_k) as an expression, for an argument of the unit 1/`unit`; returns its length. */
int waves_write(const struct waves *h, const char *argument, const char *unit, char *text, size_t size);

/* Between two sizes, with even logarithms. */
double random_power(struct random_numbers *numbers, double low, double high);

#endif
