/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Points x_k = (1 - cos(pi k/32))/2, every fourth and second of them for the lower degrees. Between them by
 * the second barycentric formula, whose weights are (-1)^k, half as much at both ends (Berrut, Trefethen,
 * Barycentric Lagrange interpolation, SIAM Review 46 (2004) 501).
 */
#include "integrate/dense_by_resteps.h"
#include "numeric/tolerances.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { finest = 32, nodes = finest + 1, coarsest = 8, tail_terms = 3 };

enum belief { untried, polynomial, none };

struct resteps {
    size_t n;
    enum belief belief;
    int stride; /* between the points that are used */
    const double *y0, *y1;
    double share[nodes];    /* positions of the points in the step */
    double *tail, *scratch; /* n, n */
    double points[];
};

/* sin^2 preserves the digits of a small share. */
static double share_of(int k)
{
    const double pi = 3.14159265358979323846;
    double half = sin(pi * k / (2 * finest));
    return half * half;
}

struct resteps *resteps_alloc(size_t n)
{
    if (n == 0 || n > (SIZE_MAX - sizeof(struct resteps)) / ((nodes + 2) * sizeof(double))) return NULL;
    struct resteps *inside = calloc(1, sizeof *inside + (nodes + 2) * n * sizeof(double));
    if (!inside) return NULL;
    inside->n = n;
    inside->tail = inside->points + nodes * n;
    inside->scratch = inside->tail + n;
    for (int k = 0; k < nodes; k++) inside->share[k] = share_of(k);
    return inside;
}

void resteps_free(struct resteps *inside)
{
    free(inside);
}

void resteps_set(struct resteps *inside, const double *y0, const double *y1)
{
    inside->y0 = y0;
    inside->y1 = y1;
    inside->belief = untried;
}

/* Sample the points that no coarser stride has. */
static bool take_points(struct resteps *inside, const struct resteps_source *source, int stride)
{
    for (int k = stride; k < finest; k += stride) {
        if (stride < finest / coarsest && k % (2 * stride) == 0) continue;
        double *y = inside->points + (size_t)k * inside->n;
        if (!source->sample(source->context, inside->share[k], y)) return false;
        for (size_t i = 0; i < inside->n; i++)
            if (!isfinite(y[i])) return false;
    }
    return true;
}

/* |c_d-2| + |c_d-1| + |c_d| of each component: c_j = (2/d) sum_k y_k cos(pi j k/d), where the first and last
 * of the sum, and c_d, count half. */
static void set_tail(struct resteps *inside, int stride)
{
    const double pi = 3.14159265358979323846;
    int d = finest / stride;
    memset(inside->tail, 0, inside->n * sizeof *inside->tail);
    for (int j = d - tail_terms + 1; j <= d; j++)
        for (size_t i = 0; i < inside->n; i++) {
            double sum = 0;
            for (int k = 0; k <= d; k++) {
                double half = k == 0 || k == d ? 0.5 : 1, wave = cos(pi * ((j * k) % (2 * d)) / d);
                sum += half * wave * inside->points[(size_t)(k * stride) * inside->n + i];
            }
            inside->tail[i] += fabs(sum) * (j == d ? 1 : 2) / d;
        }
}

/* Effect of a minimal change of the share, relative to the allowed error: the round-off level of the step. At
 * tolerances near it the step is not smoother than that, and interpolation between points is as good as any
 * sample. */
static double rounding_of(struct resteps *inside, const struct resteps_source *source)
{
    double *y = inside->scratch;
    memset(inside->tail, 0, inside->n * sizeof *inside->tail);
    for (int k = finest / 8; k < finest; k += finest / 8) {
        const double *point = inside->points + (size_t)k * inside->n;
        if (!source->sample(source->context, (1 - negligible_part) * inside->share[k], y)) return 0;
        for (size_t i = 0; i < inside->n; i++) inside->tail[i] = fmax(inside->tail[i], fabs(y[i] - point[i]));
    }
    return source->excess(source->context, inside->tail);
}

static enum belief try_degrees(struct resteps *inside, const struct resteps_source *source)
{
    const double enough = 0.01, roundings = 30;
    size_t bytes = inside->n * sizeof(double);
    double excess = 0;
    memcpy(inside->points, inside->y0, bytes);
    memcpy(inside->points + finest * inside->n, inside->y1, bytes);
    for (int stride = finest / coarsest; stride > 0; stride /= 2) {
        inside->stride = stride;
        if (!take_points(inside, source, stride)) return none;
        set_tail(inside, stride);
        excess = source->excess(source->context, inside->tail);
        if (excess <= enough) return polynomial;
    }
    return excess <= roundings * rounding_of(inside, source) ? polynomial : none;
}

/* A power of two near the distance to the nearest point: weights times that are finite, at any distance. */
static double scale_of(const struct resteps *inside, double share)
{
    double least = 1;
    int power;
    for (int k = 0; k <= finest; k += inside->stride) least = fmin(least, fabs(share - inside->share[k]));
    frexp(least, &power);
    return ldexp(1, power);
}

static void interpolate(const struct resteps *inside, double share, double *y)
{
    const double scale = scale_of(inside, share);
    double weights = 0;
    memset(y, 0, inside->n * sizeof *y);
    for (int k = 0; k <= finest; k += inside->stride) {
        const double *point = inside->points + (size_t)k * inside->n;
        double from = share - inside->share[k];
        if (from == 0) {
            memcpy(y, point, inside->n * sizeof *y);
            return;
        }
        double sign = k / inside->stride % 2 == 0 ? 1 : -1;
        double weight = (k == 0 || k == finest ? 0.5 : 1) * scale * sign / from;
        weights += weight;
        for (size_t i = 0; i < inside->n; i++) y[i] += weight * point[i];
    }
    for (size_t i = 0; i < inside->n; i++) y[i] /= weights;
}

bool resteps_eval(struct resteps *inside, const struct resteps_source *source, double share, double *y)
{
    if (inside->belief == untried) inside->belief = try_degrees(inside, source);
    if (inside->belief == polynomial) interpolate(inside, share, y);
    return inside->belief == polynomial;
}
