/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What a scan remembers between its intervals.
 */
#include <math.h>

#include "events/scan.h"

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
