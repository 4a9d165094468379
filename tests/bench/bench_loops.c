/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One right-hand side of a row of n four-bars, n = 1 ... 320, and bringing a state back onto their pins, per
 * loop: with the windows listed along the row, and in any order. Medians over rounds.
 */
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics/project.h"
#include "fbd.h"
#include "timing.h"

enum { rounds = 51, most_loops = 320 };

static const double a_batch = 2e-4; /* s */

/* Place k of a list of n: itself, or in an order without an order (a stride that has no factor with n). */
static int listed(int k, int n, bool any_order)
{
    int stride = any_order ? (int)(0.618 * n) + 1 : 1;
    for (int a = n, b = stride; any_order; stride++, a = n, b = stride) {
        while (b != 0) {
            int rest = a % b;
            a = b;
            b = rest;
        }
        if (a == 1) break;
    }
    return (int)((long)k * stride % n);
}

/* IFToMM benchmark A02; release with free(). */
static char *text_of(int n, bool any_order)
{
    char *text = NULL;
    size_t length;
    FILE *file = open_memstream(&text, &length);
    if (!file) return NULL;
    fputs("fbd: 1\nbodies:\n", file);
    for (int k = 0; k <= n; k++) {
        int i = listed(k, n + 1, any_order);
        fprintf(file, "  v%d: {shape: rod, mass: 1, length: 1, motion: {pivot: {at: [%d, 0], ", i, i);
        fputs("point: left}}, initial: {theta: 1 rad, omega: -1}, forces: [gravity]}\n", file);
        if (i == n) continue;
        fprintf(file, "  h%d: {shape: rod, mass: 1, length: 1, motion: {pivot: {on: v%d, at: right, ", i, i);
        fputs("point: left}}, initial: {theta: -1 rad, omega: 1}, forces: [gravity]}\n", file);
    }
    fputs("couplings:\n", file);
    for (int k = 0; k < n; k++) {
        int i = listed(k, n, any_order);
        fprintf(file, "  - pin: {name: p%d, between: [h%d.right, v%d.right]}\n", i, i, i + 1);
    }
    fclose(file);
    return text;
}

struct bench {
    struct fbd_state *state;
    double *dydt, *start;
};

static void rates(struct bench *bench)
{
    struct instant at = state_instant(bench->state);
    state_rates(bench->state->model, &at, bench->state->slots, bench->dydt);
}

/* From a state that is off by what a step may be off. */
static void project(struct bench *bench)
{
    memcpy(bench->state->y, bench->start, 2 * (size_t)bench->state->model->plan.n * sizeof *bench->start);
    state_return(bench->state);
}

/* Seconds of one call, the median over the rounds. */
static double time_of(void (*call)(struct bench *bench), struct bench *bench)
{
    double seconds[rounds], start = processor_seconds();
    call(bench);
    int calls = (int)fmin(1e4, fmax(1, a_batch / (processor_seconds() - start)));
    for (int round = 0; round < rounds; round++) {
        start = processor_seconds();
        for (int k = 0; k < calls; k++) call(bench);
        seconds[round] = (processor_seconds() - start) / calls;
    }
    return median(seconds, rounds);
}

static bool open_bench(struct bench *bench, fbd_model **model, int n, bool any_order)
{
    char *text = text_of(n, any_order);
    fbd_errors *errors = fbd_errors_new();
    *model = text && errors ? fbd_model_parse(text, strlen(text), "loops", NULL, 0, errors) : NULL;
    if (errors && fbd_errors_count(errors) > 0) fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    free(text);
    bench->state = *model ? state_new(*model) : NULL;
    if (!bench->state) return false;
    size_t size = 2 * (size_t)bench->state->model->plan.n;
    bench->dydt = calloc(2 * size, sizeof *bench->dydt);
    if (!bench->dydt) return false;
    bench->start = bench->dydt + size;
    for (size_t i = 0; i < size; i++) bench->start[i] = bench->state->y[i] + 1e-8 * (double)(i % 7);
    return true;
}

/* Microseconds a loop of both. */
static bool measure(int n, bool any_order, double microseconds[2])
{
    struct bench bench = {0};
    fbd_model *model = NULL;
    bool open = open_bench(&bench, &model, n, any_order);
    if (open) {
        microseconds[0] = 1e6 * time_of(rates, &bench) / n;
        microseconds[1] = 1e6 * time_of(project, &bench) / n;
    }
    free(bench.dydt);
    state_free(bench.state);
    fbd_model_free(model);
    return open;
}

int main(void)
{
    gsl_set_error_handler_off();
    printf("four-bars in a row: microseconds a loop of one right-hand side, and of one return to the pins\n");
    printf("%6s %28s %28s\n", "loops", "listed along the row", "listed in any order");
    for (int n = 1; n <= most_loops; n = n == 1 ? 5 : 2 * n) {
        double along[2], any[2];
        if (!measure(n, false, along) || !measure(n, true, any)) return 1;
        printf("%6d %13.3f %14.3f %13.3f %14.3f\n", n, along[0], along[1], any[0], any[1]);
    }
    return 0;
}
