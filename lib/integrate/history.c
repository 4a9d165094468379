/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/history.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

struct history {
    size_t n;
    int count, latest; /* number of points; index of the latest one in the ring */
    double t[history_points];
    double y[]; /* history_points states */
};

struct history *history_alloc(size_t n)
{
    if (n > (SIZE_MAX - sizeof(struct history)) / (history_points * sizeof(double))) return NULL;
    struct history *history = calloc(1, sizeof *history + history_points * n * sizeof(double));
    if (history) history->n = n;
    return history;
}

void history_free(struct history *history)
{
    free(history);
}

void history_clear(struct history *history)
{
    history->count = 0;
}

void history_add(struct history *history, double t, const double *y)
{
    history->latest = (history->latest + 1) % history_points;
    history->t[history->latest] = t;
    memcpy(history->y + (size_t)history->latest * history->n, y, history->n * sizeof *y);
    if (history->count < history_points) history->count++;
}

/* Index in the ring of the point that was added `age` points ago. */
static int ring(const struct history *history, int age)
{
    return (history->latest - age + history_points) % history_points;
}

void history_eval(const struct history *history, int degree, double t, double *y)
{
    int points = degree + 1 < history->count ? degree + 1 : history->count;
    memset(y, 0, history->n * sizeof *y);
    for (int j = 0; j < points; j++) {
        double tj = history->t[ring(history, j)], lagrange = 1;
        for (int m = 0; m < points; m++) {
            double tm = history->t[ring(history, m)];
            if (m != j) lagrange *= (t - tm) / (tj - tm);
        }
        const double *yj = history->y + (size_t)ring(history, j) * history->n;
        for (size_t i = 0; i < history->n; i++) y[i] += lagrange * yj[i];
    }
}
