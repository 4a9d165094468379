/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The pivoting kernel alone: a wall of 45 bricks at rest, 20 discs in a bin, and 2,000 blocks with redundant rows. Times are
 * the least of several; the instructions of a single case are counted by
 *
 *     valgrind --tool=callgrind bench_pivoting wall|discs|blocks [again]
 *
 * where `again` solves from the modes found before: the difference to the same without it.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "contact_rows.h"
#include "random_numbers.h"
#include "timing.h"

enum { rounds = 5, blocks = 2000, outcomes = pivoting_no_memory + 1 };

static const char *const outcome_names[outcomes] = {"solved", "unexamined", "several",
                                                    "ray",    "none",       "no memory"};

static void set_open(struct contact_rows *of)
{
    for (size_t i = 0; i < of->problem.count; i++) of->problem.rows[i].mode = at_low;
}

/* From all contacts open, and from the modes found. */
static void measure(const char *name, struct contact_rows *of)
{
    double first = HUGE_VAL, again = HUGE_VAL;
    enum pivoting found = pivoting_none;
    for (int k = 0; k < rounds; k++) {
        set_open(of);
        double start = processor_seconds();
        found = pivoting_solve(&of->problem);
        double middle = processor_seconds();
        (void)pivoting_solve(&of->problem);
        first = fmin(first, middle - start);
        again = fmin(again, processor_seconds() - middle);
    }
    printf(
        "%s: %zu rows, %s, laws violated by %.1e; %.2f ms from open contacts, %.2f ms from the same modes\n",
        name, of->problem.count, outcome_names[found], contact_rows_error(of), 1e3 * first, 1e3 * again);
}

static void measure_blocks(void)
{
    int counts[outcomes] = {0};
    double worst = 0, start = processor_seconds();
    for (int seed = 1; seed <= blocks; seed++) {
        struct random_numbers numbers = {(uint64_t)seed};
        struct contact_rows of;
        contact_rows_block(&of, 2 + seed % 5, &numbers);
        enum pivoting found = pivoting_solve(&of.problem);
        counts[found]++;
        if (found < pivoting_ray) worst = fmax(worst, contact_rows_error(&of));
        contact_rows_free(&of);
    }
    printf("%d random blocks with up to 12 rows: laws violated by %.1e, %.1f us each;", blocks, worst,
           1e6 * (processor_seconds() - start) / blocks);
    for (int k = 0; k < outcomes; k++)
        printf(" %d %s%s", counts[k], outcome_names[k], k + 1 < outcomes ? "," : "\n");
}

static int one(const char *name, bool again)
{
    struct contact_rows of;
    if (strcmp(name, "wall") == 0)
        contact_rows_wall(&of, 9, 5, 0.5);
    else
        contact_rows_bin(&of, 20, 0.3);
    enum pivoting found = pivoting_solve(&of.problem);
    if (again) found = pivoting_solve(&of.problem);
    contact_rows_free(&of);
    return found >= pivoting_ray;
}

int main(int argc, char **argv)
{
    struct contact_rows wall, discs;
    if (argc > 1) return one(argv[1], argc > 2);
    contact_rows_wall(&wall, 9, 5, 0.5);
    contact_rows_bin(&discs, 20, 0.3);
    measure("wall of 45 bricks", &wall);
    measure("20 discs in a bin", &discs);
    measure_blocks();
    contact_rows_free(&wall);
    contact_rows_free(&discs);
    return 0;
}
