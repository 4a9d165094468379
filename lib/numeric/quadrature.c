/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "numeric/quadrature.h"
#include "numeric/tolerances.h"

#include <gsl/gsl_integration.h>
#include <math.h>
#include <stdbool.h>

/* Each half reduces `left` by one. */
static void add_stretch(const gsl_function *f, double from, double to, int *left, struct quadrature *sum)
{
    const double digits = negligible_part; /* a rule's own error estimate is at least a tenth of this */
    double part, off, magnitude, variation, middle = from + (to - from) / 2;
    gsl_integration_qk21(f, from, to, &part, &off, &magnitude, &variation);
    sum->size = fmax(sum->size, magnitude);
    bool fine = off <= digits * sum->size;
    if (fine || !isfinite(part) || (*left)-- <= 0 || middle == from || middle == to) {
        sum->integral += part;
        sum->error += off;
        return;
    }
    add_stretch(f, from, middle, left, sum);
    add_stretch(f, middle, to, left, sum);
}

/* A rough integral of |f|, the reference of the errors. */
static double size_of(const gsl_function *f, const double *ends, int pieces)
{
    double sum = 0, part, off, magnitude, variation;
    for (int i = 0; i < pieces; i++) {
        gsl_integration_qk21(f, ends[i], ends[i + 1], &part, &off, &magnitude, &variation);
        sum += magnitude;
    }
    return sum;
}

struct quadrature quadrature_over(const gsl_function *f, const double *ends, int pieces, int halves)
{
    struct quadrature sum = {.size = pieces > 1 ? size_of(f, ends, pieces) : 0};
    for (int i = 0; i < pieces; i++) add_stretch(f, ends[i], ends[i + 1], &halves, &sum);
    return sum;
}
