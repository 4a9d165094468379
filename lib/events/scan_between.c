/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Setup of a scan, and its state between intervals.
 */
#include <math.h>

#include "events/scan.h"

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
