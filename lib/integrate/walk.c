/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/walk.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"

enum { most_tries = 500 };

struct walk {
    size_t n;
    bool made;
    size_t count, room; /* of marks */
    double *times;      /* after the start of the step, ascending */
    double *marks;      /* y and f at each */
    double next[];      /* 2 n */
};

struct walk *walk_alloc(size_t n)
{
    if (n == 0 || n > SIZE_MAX / sizeof(double) / 4) return NULL;
    struct walk *walk = block_alloc(sizeof *walk + 2 * n * sizeof(double));
    if (walk) walk->n = n;
    return walk;
}

void walk_free(struct walk *walk)
{
    if (!walk) return;
    free(walk->times);
    free(walk->marks);
    free(walk);
}

void walk_forget(struct walk *walk)
{
    walk->made = false;
}

static bool make_room(struct walk *walk)
{
    if (walk->count < walk->room) return true;
    size_t room = walk->room ? 2 * walk->room : 16, state = 2 * walk->n * sizeof(double);
    if (room > SIZE_MAX / state) return false;
    double *times = realloc(walk->times, room * sizeof *times);
    if (times) walk->times = times;
    double *marks = times ? realloc(walk->marks, room * state) : NULL;
    if (!marks) return false;
    walk->marks = marks;
    walk->room = room;
    return true;
}

static bool add_mark(struct walk *walk, double time, const double *y, const double *f)
{
    if (!make_room(walk)) return false;
    double *mark = walk->marks + 2 * walk->n * walk->count;
    memcpy(mark, y, walk->n * sizeof *y);
    memcpy(mark + walk->n, f, walk->n * sizeof *f);
    walk->times[walk->count++] = time;
    return true;
}

/* All parts, or as many as can be made in so many tries. */
static int make(struct walk *walk, const struct walk_source *source, double whole, const double *y0,
                const double *f0)
{
    const double longer = 1.5, shorter = 0.4, ease = 0.1;
    size_t n = walk->n;
    walk->count = 0;
    if (!add_mark(walk, 0, y0, f0)) return GSL_ENOMEM;
    double now = 0, h = whole;
    for (int k = 0; k < most_tries && now < whole && now + h > now; k++) {
        double next = now + h < whole ? now + h : whole, *y = walk->next, *f = y + n;
        memcpy(y, walk->marks + 2 * n * (walk->count - 1), 2 * n * sizeof *y);
        double ratio = source->part(source->context, now, next - now, y, f);
        h = ratio <= ease ? longer * h : ratio <= 1 ? h : shorter * h;
        if (!(ratio <= 1)) continue;
        now = next;
        if (!add_mark(walk, now, y, f)) return GSL_ENOMEM;
    }
    walk->made = true;
    return GSL_SUCCESS;
}

/* From a mark by so many parts to the time `to`. */
static bool reach(struct walk *walk, const struct walk_source *source, size_t mark, int parts, double to,
                  double *y, double *f)
{
    size_t n = walk->n;
    double from = walk->times[mark], now = from;
    memcpy(y, walk->marks + 2 * n * mark, n * sizeof *y);
    memcpy(f, walk->marks + 2 * n * mark + n, n * sizeof *f);
    for (int k = 1; k <= parts; k++) {
        double next = k < parts ? from + (to - from) * k / parts : to;
        if (next > now && !(source->part(source->context, now, next - now, y, f) <= 1)) return false;
        now = next;
    }
    return true;
}

int walk_to(struct walk *walk, const struct walk_source *source, double whole, const double *y0,
            const double *f0, double to, double *y, double *f)
{
    enum { most_parts = 64 };
    size_t last = 0;
    int code = walk->made ? GSL_SUCCESS : make(walk, source, whole, y0, f0);
    if (code != GSL_SUCCESS) return code;
    if (to > walk->times[walk->count - 1]) return GSL_EFAILED;
    while (last + 1 < walk->count && walk->times[last + 1] <= to) last++;
    for (int parts = 1; parts <= most_parts;
         parts *= 2) /* where a longer one was good a shorter one need not be */
        if (reach(walk, source, last, parts, to, y, f)) return GSL_SUCCESS;
    return GSL_EFAILED;
}
