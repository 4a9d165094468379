/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * What the lanes of a batch bring to sweeps over a pendulum, a damped one and a double one: the rows one after the other,
 * beside the same rows with four runs abreast and with as many as this processor has lanes for, in turn, by one thread.
 * The texts are compared.
 *
 * Usage: bench_lanes PENDULUM DAMPED DOUBLE, whose parameters theta0, c and theta_2 are varied
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "batch/rows_simd.h"
#include "claim.h"
#include "fbd_study.h"
#include "open_sweep.h"
#include "study/sweep.h"
#include "timing.h"

enum { rounds = 15, ways = 3 };

/* Of each way what it needs, and its rows. */
struct way {
    struct row_maker *maker;
    struct rows_simd *abreast; /* NULL: one after the other */
    struct text rows;
};

static double time_of(struct way *way, size_t runs)
{
    const double begin = processor_seconds();
    way->rows.length = 0;
    if (way->abreast) {
        rows_simd_make(way->abreast, 0, runs, &way->rows);
    } else {
        for (size_t run = 0; run < runs; run++) row_make(way->maker, run, &way->rows);
    }
    return (processor_seconds() - begin) / (double)runs;
}

static void open_way(struct way *way, const fbd_sweep *sweep, unsigned lanes)
{
    *way = (struct way){0};
    if (lanes == 0)
        way->maker = row_maker_new(sweep->rows, NULL, NULL);
    else if (rows_simd_suits(sweep->rows))
        way->abreast = rows_simd_new(sweep->rows, lanes, NULL, NULL);
    if (!way->maker && !way->abreast) exit(1);
}

static void close_way(struct way *way)
{
    row_maker_free(way->maker);
    rows_simd_free(way->abreast);
    text_free(&way->rows);
}

/* Where the processor has no four lanes it is not measured. */
static void measure(const char *name, const char *path, double until, const char *vary, double bound)
{
    static const unsigned lanes[ways] = {0, 4, rows_simd_most};
    static double seconds[ways][rounds], gain[ways][rounds];
    fbd_sweep *sweep = open_sweep(path, vary, until);
    const size_t runs = fbd_sweep_run_count(sweep);
    struct way way[ways];
    for (int i = 0; i < ways; i++) open_way(&way[i], sweep, lanes[i]);
    for (int round = 0; round < rounds; round++)
        for (int i = 0; i < ways; i++) {
            seconds[i][round] = time_of(&way[i], runs);
            gain[i][round] = seconds[0][round] / seconds[i][round];
        }
    printf("%s for %g s: %.1f us a run", name, until, 1e6 * median(seconds[0], rounds));
    for (int i = 1; i < ways; i++) {
        const bool same = way[i].rows.length == way[0].rows.length &&
                          memcmp(way[i].rows.data, way[0].rows.data, way[0].rows.length) == 0;
        const double most = median(gain[i], rounds); /* which sorts them */
        printf(", %u abreast %.1f us: %.2f times as many (quartiles %.2f to %.2f)",
               rows_simd_lanes(way[i].abreast), 1e6 * median(seconds[i], rounds), most, gain[i][rounds / 4],
               gain[i][3 * rounds / 4]);
        if (!same) fputs("\nthe rows abreast differ from the others\n", stderr), exit(1);
    }
    printf("\n");
    char what[160];
    snprintf(what, sizeof what, "sweep: runs of %s (%g s) in four lanes over the same one by one", name,
             until);
    const bool four = rows_simd_lanes(way[1].abreast) == 4;
    if (bound > 0) claim_at_least(what, four ? median(gain[1], rounds) : (double)NAN, bound);
    for (int i = 0; i < ways; i++) close_way(&way[i]);
    fbd_sweep_free(sweep);
}

int main(int argc, char **argv)
{
    const double enough = 3;
    gsl_set_error_handler_off();
    if (argc != 4) return 2;
    measure("a pendulum", argv[1], 10, "theta0=0.1:3:2000", 0);
    measure("a pendulum", argv[1], 100, "theta0=0.1:3:500", enough);
    measure("a damped pendulum", argv[2], 10, "c=0.01:0.1:1000", enough);
    measure("a double pendulum", argv[3], 5, "theta_2=1:2:500", enough);
    measure("a double pendulum", argv[3], 60, "theta_2=1:2:50", 0);
    return 0;
}
