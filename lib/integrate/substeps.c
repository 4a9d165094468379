/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/substeps.h"

#include <gsl/gsl_errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"

enum { most_tries = 500 };

struct substeps {
    size_t n;
    bool made;
    size_t count, room; /* of marks */
    double *times;      /* after the start of the step, ascending */
    double *marks;      /* y and f at each */
    double next[];      /* 2 n */
};

struct substeps *substeps_alloc(size_t n)
{
    if (n == 0 || n > SIZE_MAX / sizeof(double) / 4) return NULL;
    struct substeps *substeps = block_alloc(sizeof *substeps + 2 * n * sizeof(double));
    if (substeps) substeps->n = n;
    return substeps;
}

void substeps_free(struct substeps *substeps)
{
    if (!substeps) return;
    free(substeps->times);
    free(substeps->marks);
    free(substeps);
}

void substeps_forget(struct substeps *substeps)
{
    substeps->made = false;
}

static bool make_room(struct substeps *substeps)
{
    if (substeps->count < substeps->room) return true;
    size_t room = substeps->room ? 2 * substeps->room : 16, state = 2 * substeps->n * sizeof(double);
    if (room > SIZE_MAX / state) return false;
    double *times = realloc(substeps->times, room * sizeof *times);
    if (times) substeps->times = times;
    double *marks = times ? realloc(substeps->marks, room * state) : NULL;
    if (!marks) return false;
    substeps->marks = marks;
    substeps->room = room;
    return true;
}

static bool add_mark(struct substeps *substeps, double time, const double *y, const double *f)
{
    if (!make_room(substeps)) return false;
    double *mark = substeps->marks + 2 * substeps->n * substeps->count;
    memcpy(mark, y, substeps->n * sizeof *y);
    memcpy(mark + substeps->n, f, substeps->n * sizeof *f);
    substeps->times[substeps->count++] = time;
    return true;
}

/* Make all parts, or those that the limit of attempts permits. */
static int make(struct substeps *substeps, const struct substeps_source *source, double whole,
                const double *y0, const double *f0)
{
    const double longer = 1.5, shorter = 0.4, ease = 0.1;
    size_t n = substeps->n;
    substeps->count = 0;
    if (!add_mark(substeps, 0, y0, f0)) return GSL_ENOMEM;
    double now = 0, h = whole;
    for (int k = 0; k < most_tries && now < whole && now + h > now; k++) {
        double next = now + h < whole ? now + h : whole, *y = substeps->next, *f = y + n;
        memcpy(y, substeps->marks + 2 * n * (substeps->count - 1), 2 * n * sizeof *y);
        double ratio = source->part(source->context, now, next - now, y, f);
        h = ratio <= ease ? longer * h : ratio <= 1 ? h : shorter * h;
        if (!(ratio <= 1)) continue;
        now = next;
        if (!add_mark(substeps, now, y, f)) return GSL_ENOMEM;
    }
    substeps->made = true;
    return GSL_SUCCESS;
}

/* Integrate from a mark to the time `to` in so many parts. */
static bool reach(struct substeps *substeps, const struct substeps_source *source, size_t mark, int parts,
                  double to, double *y, double *f)
{
    size_t n = substeps->n;
    double from = substeps->times[mark], now = from;
    memcpy(y, substeps->marks + 2 * n * mark, n * sizeof *y);
    memcpy(f, substeps->marks + 2 * n * mark + n, n * sizeof *f);
    for (int k = 1; k <= parts; k++) {
        double next = k < parts ? from + (to - from) * k / parts : to;
        if (next > now && !(source->part(source->context, now, next - now, y, f) <= 1)) return false;
        now = next;
    }
    return true;
}

int substeps_to(struct substeps *substeps, const struct substeps_source *source, double whole,
                const double *y0, const double *f0, double to, double *y, double *f)
{
    enum { most_parts = 64 };
    size_t last = 0;
    int code = substeps->made ? GSL_SUCCESS : make(substeps, source, whole, y0, f0);
    if (code != GSL_SUCCESS) return code;
    if (to > substeps->times[substeps->count - 1]) return GSL_EFAILED;
    while (last + 1 < substeps->count && substeps->times[last + 1] <= to) last++;
    for (int parts = 1; parts <= most_parts;
         parts *= 2) /* a shorter step may be rejected although a longer one was accepted */
        if (reach(substeps, source, last, parts, to, y, f)) return GSL_SUCCESS;
    return GSL_EFAILED;
}
