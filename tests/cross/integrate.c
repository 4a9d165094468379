/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * In time: the modified midpoint rule, extrapolated to step zero (Gragg, Bulirsch, Stoer; Hairer, Norsett &
 * Wanner I, II.9), in maximal coordinates, brought back onto the conditions after each step.
 */
#include <string.h>

#include "absolute.h"

enum { levels = 7, most_state = 6 * most_bodies + most_states, most_steps = 3000 };

/* Positions, velocities and states, one after the other. */
static int state_size(const struct absolute *absolute)
{
    return 2 * absolute->n + absolute->scene->state_count;
}

static void put_state(struct absolute *absolute, const double *y)
{
    size_t n = (size_t)absolute->n;
    memcpy(absolute->x, y, n * sizeof *y);
    memcpy(absolute->v, y + n, n * sizeof *y);
    memcpy(absolute->z, y + 2 * n, (size_t)absolute->scene->state_count * sizeof *y);
}

static void get_state(const struct absolute *absolute, double *y)
{
    size_t n = (size_t)absolute->n;
    memcpy(y, absolute->x, n * sizeof *y);
    memcpy(y + n, absolute->v, n * sizeof *y);
    memcpy(y + 2 * n, absolute->z, (size_t)absolute->scene->state_count * sizeof *y);
}

static void rates(struct absolute *absolute, double t, const double *y, double *dy)
{
    size_t n = (size_t)absolute->n;
    absolute->t = t;
    put_state(absolute, y);
    absolute_solve(absolute, false);
    if (absolute_turn_guides(absolute)) absolute_solve(absolute, false);
    memcpy(dy, y + n, n * sizeof *y);
    memcpy(dy + n, absolute->a, n * sizeof *y);
    for (int i = 0; i < absolute->scene->state_count; i++)
        dy[2 * n + (size_t)i] = formula_value(absolute, &absolute->scene->state[i].rate);
}

/* Over h in 2 k substeps: its error has even powers of the substep alone. */
static void midpoint(struct absolute *absolute, double t, double h, int k, const double *y, const double *dy,
                     double *end)
{
    int n = state_size(absolute), steps = 2 * k;
    double before[most_state], now[most_state], slope[most_state], s = h / steps;
    for (int i = 0; i < n; i++) {
        before[i] = y[i];
        now[i] = y[i] + s * dy[i];
    }
    for (int step = 1; step < steps; step++) {
        rates(absolute, t + step * s, now, slope);
        for (int i = 0; i < n; i++) {
            double next = before[i] + 2 * s * slope[i];
            before[i] = now[i];
            now[i] = next;
        }
    }
    rates(absolute, t + h, now, slope);
    for (int i = 0; i < n; i++) end[i] = 0.5 * (before[i] + now[i] + s * slope[i]);
}

/* One step; returns the error over the tolerance. T(k, 1) is the rule with 2 k substeps, and
 *
 *     T(k, j + 1) = T(k, j) + (T(k, j) - T(k - 1, j)) / ((k / (k - j))^2 - 1) */
static double step(struct absolute *absolute, double t, double h, const double *y, double tolerance,
                   double *end)
{
    int n = state_size(absolute);
    double before[levels][most_state], dy[most_state], error = INFINITY; /* before[j - 1]: T(k - 1, j) */
    rates(absolute, t, y, dy);
    for (int k = 1; k <= levels && !(k > 4 && error < 1); k++) {
        midpoint(absolute, t, h, k, y, dy, end);
        for (int j = 1; j < k; j++) {
            double ratio = (double)k / (k - j), *old = before[j - 1];
            error = 0;
            for (int i = 0; i < n; i++) {
                double better = end[i] + (end[i] - old[i]) / (ratio * ratio - 1);
                error = fmax(error, fabs(better - end[i]) / (tolerance * (1 + fabs(better))));
                old[i] = end[i];
                end[i] = better;
            }
        }
        memcpy(before[k - 1], end, (size_t)n * sizeof *end);
    }
    return error;
}

/* Far from where the angle by which a rope lies on its drum is no longer known from where its ends are. */
static bool wraps_stay(const struct absolute *absolute)
{
    for (int j = 0; j < absolute->row_count; j++) {
        if (absolute->row[j].kind != row_capstan) continue;
        double lies = fmod(wrap_of(absolute, &absolute->row[j]), 6.283185307179586);
        if (!(lies > 0.1 && lies < 4.6)) return false;
    }
    return true;
}

bool absolute_integrate(struct absolute *absolute, double until, double tolerance)
{
    double y[most_state], end[most_state], t = absolute->t, h = fmin(0.05, until - t);
    for (int steps = 0; t < until; steps++) {
        if (steps == most_steps) return false;
        get_state(absolute, y);
        bool last = t + h >= until;
        if (last) h = until - t;
        double error = step(absolute, t, h, y, tolerance, end);
        bool good = error < 1;
        put_state(absolute, good ? end : y);
        if (!good) {
            absolute->t = t;
            h *= error > 1e4 || !(error < 1e300) ? 0.3 : 0.6;
            continue;
        }
        double begin = t;
        t = last ? until : t + h;
        absolute->t = t;
        if (!absolute_project(absolute, true) || shortest_piece(absolute) < 0.05) return false;
        if (!wraps_stay(absolute)) return false;
        if (isinf(absolute->unpushed_to) && absolute_jams(absolute)) {
            absolute->unpushed_from = begin;
            absolute->unpushed_to = t;
        }
        h *= error < 1e-4 ? 2 : error < 1e-2 ? 1.3 : 1;
    }
    return true;
}
