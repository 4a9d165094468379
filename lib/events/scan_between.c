/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Setup of a scan, and its state between intervals.
 */
#include <math.h>

#include "events/scan.h"

enum { spare_points = 3 };

bool scan_init(struct scan *scan, size_t count, scan_sampler *sample, void *context, struct arena *memory)
{
    *scan = (struct scan){.count = count, .sample = sample, .context = context};
    if (count == 0) return true; /* no functions */
    scan->points = ARENA_ARRAY(memory, spare_points, struct scan_point);
    double *next = ARENA_ARRAY(memory, (size_t)2 * spare_points * count, double);
    scan->crossed = ARENA_ARRAY(memory, 7 * count, bool);
    scan->lone = ARENA_ARRAY(memory, count, struct root_group);
    scan->prover.now =
        ARENA_ARRAY(memory, 2 * count, struct enclosure); /* enough for a group of all functions */
    scan->prover.waiting = ARENA_ARRAY(memory, count, bool);
    series_init(&scan->series, count, memory);
    if (memory->failed) return false;
    scan->prover.end = scan->prover.now + count;
    scan->sampled = scan->crossed + count;
    scan->chosen = scan->sampled + count;
    scan->dipped = scan->chosen + count;
    scan->waits = scan->dipped + count;
    scan->silent = scan->waits + count;
    scan->unfinished = scan->silent + count;
    for (size_t i = 0; i < count; i++) {
        scan->sampled[i] = true;
        scan->lone[i] = (struct root_group){.first = i, .count = 1};
    }
    for (int i = 0; i < spare_points; i++, next += 2 * count)
        scan->points[i] = (struct scan_point){0, next, next + count};
    return true;
}

void scan_use_enclosures(struct scan *scan, struct root_group *groups, size_t count, roots_enclose *enclose,
                         scan_follower *follow)
{
    if (scan->count == 0) return;
    scan->enclose = enclose;
    scan->groups = groups;
    scan->group_count = count;
    scan->follow = follow;
}

void scan_forget(struct scan *scan)
{
    series_forget(&scan->series);
    for (size_t g = 0; g < scan->group_count; g++) {
        scan->groups[g].clear = NAN;
        scan->groups[g].stuck = false;
    }
}

void scan_pass_over(struct scan *scan)
{
    for (size_t i = 0; i < scan->count; i++) scan->dipped[i] |= scan->crossed[i];
    scan->resumed = true;
}

bool scan_leave_out(struct scan *scan)
{
    bool any = false;
    for (size_t i = 0; i < scan->count; i++) {
        bool more = scan->crossed[i] && !scan->silent[i];
        scan->silent[i] |= more;
        any |= more;
    }
    return any;
}

void scan_start(struct scan *scan)
{
    for (size_t i = 0; i < scan->count; i++) scan->dipped[i] = scan->silent[i] = false;
    scan->resumed = false;
}
