/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/holds.h"

#include <math.h>
#include <stdlib.h>

#include "numeric/pivoting.h"

bool holds_new(struct hold_problem *problem, size_t count, size_t guide_count)
{
    *problem = (struct hold_problem){.count = count, .guide_count = guide_count};
    problem->holds = calloc(count + 1, sizeof *problem->holds);
    problem->guides = calloc(guide_count + 1, sizeof *problem->guides);
    problem->A = calloc((count + guide_count) * count + 1, sizeof *problem->A);
    if (problem->holds && problem->guides && problem->A) {
        problem->B = problem->A + count * count;
        return true;
    }
    holds_free(problem);
    return false;
}

void holds_free(struct hold_problem *problem)
{
    free(problem->holds);
    free(problem->guides);
    free(problem->A);
    *problem = (struct hold_problem){0};
}

double holds_weight(const struct hold_problem *problem, size_t i)
{
    double own = problem->A[i * problem->count + i];
    return own > 0 ? 1 / sqrt(own) : 0;
}

/* The largest acceleration, and the largest change of one by a force. */
static double largest(const struct hold_problem *problem)
{
    double most = problem->size;
    for (size_t i = 0; i < problem->count; i++) {
        double size = fabs(problem->holds[i].free);
        for (size_t j = 0; j < problem->count; j++)
            size = fmax(size, fabs(problem->A[i * problem->count + j] * problem->holds[j].force));
        most = fmax(most, holds_weight(problem, i) * size);
    }
    return most;
}

bool holds_is_on_open(const struct hold_problem *problem, const struct hold *hold)
{
    return hold->kind == hold_friction && hold->press == press_hold && hold->preload == 0 &&
           problem->holds[hold->presses].mode != hold_keeps;
}

bool holds_is_still(const struct hold_problem *problem, size_t i, double share)
{
    return fabs(holds_weight(problem, i) * problem->holds[i].c) <= share * largest(problem);
}

/* ---- as a problem of pivoting: the rows of the constraints, then those of the guides */

/* No force moves a constraint with A_ii = 0, whose acceleration counts as zero. mu_k > mu_s is not physical, but possible in a
 * file: the friction force would exceed the limit at breakaway, so the larger one is used. */
static struct pivoting_row row_of(const struct hold_problem *problem, size_t i)
{
    const struct hold *hold = &problem->holds[i];
    double b = holds_weight(problem, i) > 0 ? hold->free : 0, mu = hold->mu_s;
    if (hold->kind == hold_one_sided)
        return (struct pivoting_row){.b = b, .high = HUGE_VAL, .of = -1, .mode = b > 0 ? at_low : between};
    double given = mu * (hold->press == press_constant ? 1 : hold->preload);
    struct pivoting_row row = {.b = b, .low = -given, .high = given, .of = -1, .slips = -hold->slip};
    if (mu > 0) row.loss = 1 - fmin(1, hold->mu_k / mu);
    if (hold->press == press_constant) return row;
    row.of = hold->presses + (hold->press == press_guide ? (int)problem->count : 0);
    row.low_share = -mu;
    row.high_share = mu;
    return row;
}

static double scale_of_guide(const struct hold_problem *problem, size_t g)
{
    double most = 0;
    for (size_t i = 0; i < problem->count; i++) {
        const struct hold *hold = &problem->holds[i];
        bool on_it = hold->kind == hold_friction && hold->press == press_guide && hold->presses == (int)g;
        if (on_it) most = fmax(most, problem->A[i * problem->count + i]);
    }
    return most > 0 ? most : 1;
}

static void add_guide(const struct hold_problem *problem, size_t g, struct pivoting_problem *to, double *A)
{
    size_t n = problem->count, all = to->count, own = n + g;
    const struct hold_guide *guide = &problem->guides[g];
    const double *B = problem->B + g * n, alpha = scale_of_guide(problem, g);
    to->rows[own] = (struct pivoting_row){.b = -alpha * guide->free,
                                          .low = -HUGE_VAL,
                                          .high = HUGE_VAL,
                                          .of = -1,
                                          .load = guide->two_sided ? load_of_both_sides : load_of_one_side,
                                          .mode = guide->free < 0 ? at_low : at_high};
    A[own * all + own] = alpha;
    for (size_t i = 0; i < n; i++) {
        to->rows[i].b += alpha * B[i] * guide->free;
        A[i * all + own] = A[own * all + i] = -alpha * B[i];
        for (size_t j = 0; j < n; j++) A[i * all + j] += alpha * B[i] * B[j];
    }
}

static void take(struct hold_problem *problem, const struct pivoting_row *rows)
{
    for (size_t i = 0; i < problem->count; i++) {
        struct hold *hold = &problem->holds[i];
        hold->force = rows[i].x;
        hold->c = holds_weight(problem, i) > 0 ? rows[i].w : hold->free;
        hold->mode = hold->slip != 0 ? hold->slip : (rows[i].w > 0) - (rows[i].w < 0);
    }
    for (size_t g = 0; g < problem->guide_count; g++) {
        struct hold_guide *guide = &problem->guides[g];
        guide->N = guide->free; /* its sign is that of N itself, beyond the tolerance of the limit */
        for (size_t i = 0; i < problem->count; i++)
            guide->N += problem->B[g * problem->count + i] * rows[i].x;
    }
}

/* Where no path from these modes ends in a solution, one from all constraints closed or sticking may. */
static enum pivoting solve(struct pivoting_problem *rows)
{
    enum pivoting found = pivoting_solve(rows);
    if (found != pivoting_ray) return found;
    rows->basic = false;
    for (size_t i = 0; i < rows->count; i++)
        if (rows->rows[i].load == load_is_force) rows->rows[i].mode = between;
    return pivoting_solve(rows);
}

enum holds_found holds_decide(struct hold_problem *problem)
{
    static const enum holds_found found_as[] = {
        [pivoting_solved] = holds_decided,  [pivoting_unexamined] = holds_decided,
        [pivoting_several] = holds_several, [pivoting_ray] = holds_lost,
        [pivoting_none] = holds_none,       [pivoting_no_memory] = holds_no_memory};
    size_t n = problem->count, all = n + problem->guide_count;
    double *A = calloc(all * all + 1, sizeof *A);
    struct pivoting_problem rows = {all,
                                    calloc(all + 1, sizeof *rows.rows),
                                    A,
                                    .basic = problem->basic,
                                    .coarse = problem->coarse,
                                    .examine = true,
                                    .size = problem->size};
    enum holds_found found = holds_no_memory;
    if (A && rows.rows) {
        for (size_t i = 0; i < n; i++) {
            problem->holds[i].mu_s = fmax(problem->holds[i].mu_s, problem->holds[i].mu_k);
            rows.rows[i] = row_of(problem, i);
            for (size_t j = 0; j < n; j++) A[i * all + j] = problem->A[i * n + j];
        }
        for (size_t g = 0; g < problem->guide_count; g++) add_guide(problem, g, &rows, A);
        found = found_as[solve(&rows)];
        if (found <= holds_several) take(problem, rows.rows);
    }
    free(rows.rows);
    free(A);
    return found;
}
