/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds_by_modes.h"

#include <math.h>
#include <string.h>

#include "numeric/lu.h"

enum { most = 8 };

static int choices(const struct hold *hold)
{
    return hold->kind == hold_one_sided ? 2 : hold->slip == 0 ? 3 : 1;
}

/* Set the modes of this combination, and the sides of the guides. */
static void set_modes(struct hold_problem *problem, int number, int *side)
{
    static const int modes[] = {hold_keeps, hold_gives, hold_slips_back};
    for (size_t g = 0; g < problem->guide_count; g++, number /= 2) side[g] = number % 2 ? -1 : 1;
    for (size_t i = 0; i < problem->count; i++) {
        struct hold *hold = &problem->holds[i];
        hold->mode = hold->slip != 0 ? hold->slip : modes[number % choices(hold)];
        number /= choices(hold);
    }
}

/* The normal force as a row of coefficients, and its constant part. */
static double press_row(const struct hold_problem *problem, const struct hold *hold, const int *side,
                        double *row)
{
    size_t n = problem->count;
    if (hold->press == press_constant) return 1;
    if (hold->press == press_hold) row[hold->presses] = 1;
    if (hold->press == press_hold) return hold->preload;
    const struct hold_guide *guide = &problem->guides[hold->presses];
    if (side[hold->presses] < 0 && !guide->two_sided) return 0;
    for (size_t j = 0; j < n; j++) row[j] = side[hold->presses] * problem->B[(size_t)hold->presses * n + j];
    return side[hold->presses] * guide->free;
}

/* False where the forces of the modes are not unique. */
static bool set_forces(struct hold_problem *problem, const int *side)
{
    const double give = 1e-10; /* of redundant rows */
    size_t n = problem->count, pivot[most];
    double A[most * most] = {0}, f[most] = {0};
    for (size_t i = 0; i < n; i++) {
        const struct hold *hold = &problem->holds[i];
        double press[most] = {0}, *row = A + i * n;
        if (hold->mode == hold_keeps) memcpy(row, problem->A + i * n, n * sizeof *row);
        row[i] = hold->mode == hold_keeps ? row[i] * (1 + give) : 1;
        f[i] = hold->mode == hold_keeps ? -hold->free : 0;
        if (hold->mode == hold_keeps || hold->kind == hold_one_sided) continue;
        f[i] = -hold->mode * hold->mu_k * press_row(problem, hold, side, press);
        for (size_t j = 0; j < n; j++) row[j] += hold->mode * hold->mu_k * press[j];
    }
    if (!lu_decompose(n, A, pivot)) return false;
    lu_solve(n, A, pivot, f);
    for (size_t i = 0; i < n; i++) {
        problem->holds[i].force = f[i];
        problem->holds[i].c = problem->holds[i].free;
        for (size_t j = 0; j < n; j++) problem->holds[i].c += problem->A[i * n + j] * f[j];
    }
    return true;
}

static bool obeys(const struct hold_problem *problem, const struct hold *hold, const int *side, double zero)
{
    double press[most] = {0}, P = 0;
    if (hold->kind == hold_one_sided) return hold->force >= -zero && hold->c >= -zero;
    P = press_row(problem, hold, side, press);
    for (size_t j = 0; j < problem->count; j++) P += press[j] * problem->holds[j].force;
    if (hold->mode == hold_keeps) return fabs(hold->force) <= hold->mu_s * P + zero;
    return P >= -zero && (hold->slip != 0 || hold->mode * hold->c >= -zero);
}

static bool agree(const struct hold_problem *problem, const int *side, double size)
{
    size_t n = problem->count;
    for (size_t g = 0; g < problem->guide_count; g++) {
        double N = problem->guides[g].free;
        for (size_t j = 0; j < n; j++) N += problem->B[g * n + j] * problem->holds[j].force;
        if (side[g] * N < -1e-9 * size) return false;
    }
    for (size_t i = 0; i < n; i++)
        if (!obeys(problem, &problem->holds[i], side, 1e-9 * size)) return false;
    return true;
}

static double size_of(const struct hold_problem *problem)
{
    double size = 0;
    for (size_t i = 0; i < problem->count; i++)
        size = fmax(size, fmax(fabs(problem->holds[i].free), fabs(problem->holds[i].force)));
    return size;
}

int holds_by_modes(struct hold_problem *problem)
{
    int all = 1 << problem->guide_count, solutions = 0, side[most];
    double c[most] = {0}, force[most] = {0};
    for (size_t i = 0; i < problem->count; i++) all *= choices(&problem->holds[i]);
    for (int number = 0; number < all; number++) {
        set_modes(problem, number, side);
        if (!set_forces(problem, side) || !agree(problem, side, size_of(problem))) continue;
        bool other = false;
        for (size_t i = 0; solutions > 0 && i < problem->count; i++)
            other |= fabs(problem->holds[i].c - c[i]) > 1e-6 * size_of(problem);
        if (solutions > 0 && !other) continue;
        for (size_t i = 0; solutions == 0 && i < problem->count; i++) {
            c[i] = problem->holds[i].c;
            force[i] = problem->holds[i].force;
        }
        solutions++;
    }
    for (size_t i = 0; solutions > 0 && i < problem->count; i++) {
        problem->holds[i].c = c[i];
        problem->holds[i].force = force[i];
    }
    return solutions;
}
