/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What was measured, beside its bound: lines that tests/bench/table makes the table of `make bench` from.
 */
#ifndef FBD_BENCH_CLAIM_H
#define FBD_BENCH_CLAIM_H

#include <math.h>
#include <stdio.h>

static inline void claim_line(const char *what, double measured, const char *relation, double bound, int met)
{
    printf("claim | %s | ", what);
    if (isnan(measured))
        printf("not measured");
    else
        printf("%.3g", measured);
    printf(" | %s %.6g | %s |\n", relation, bound, met ? "met" : "**not met**");
    fflush(stdout);
}

/* What is not measured is not met. */
static inline void claim_at_most(const char *what, double measured, double bound)
{
    claim_line(what, measured, "at most", bound, measured <= bound);
}

static inline void claim_at_least(const char *what, double measured, double bound)
{
    claim_line(what, measured, "at least", bound, measured >= bound);
}

#endif
