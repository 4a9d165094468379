/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Enumeration of all modes: in each of them the forces solve a linear system.
 */
#include "holds/trial.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "numeric/lu.h"

static size_t choices(const struct hold *hold)
{
    return hold->kind == hold_one_sided ? 2 : hold->slip == 0 ? 3 : 1;
}

/* The modes of combination `number`; closed and sticking ones come first. */
static void set_modes(struct trial *trial, size_t number)
{
    static const int of_friction[] = {hold_keeps, hold_gives, hold_slips_back};
    struct hold_problem *problem = trial->problem;
    for (size_t g = 0; g < problem->guide_count; g++, number /= 2) trial->side[g] = number % 2 == 0 ? 1 : -1;
    for (size_t i = 0; i < problem->count; i++) {
        struct hold *hold = &problem->holds[i];
        size_t choice = number % choices(hold);
        number /= choices(hold);
        hold->mode = hold->slip != 0 ? hold->slip : of_friction[choice];
    }
}

/* f_i + slip mu P = 0, with P for the assumed side of a guide. */
static void slipping_row(const struct trial *trial, size_t i, double *row, double *right)
{
    const struct hold_problem *problem = trial->problem;
    const struct hold *hold = &problem->holds[i];
    double share = hold->mode * hold->mu_k;
    row[i] += 1;
    if (hold->press == press_constant) *right -= share;
    if (hold->press == press_hold) row[hold->presses] += share;
    if (hold->press != press_guide) return;
    const struct hold_guide *guide = &problem->guides[hold->presses];
    int side = trial->side[hold->presses];
    if (side < 0 && !guide->two_sided) return;
    for (size_t j = 0; j < problem->count; j++)
        row[j] += share * side * problem->B[(size_t)hold->presses * problem->count + j];
    *right -= share * side * guide->free;
}

/* Friction on an open surface has no force in any mode: only one of them is enumerated. */
static bool is_repeated(const struct hold_problem *problem)
{
    for (size_t i = 0; i < problem->count; i++) {
        const struct hold *hold = &problem->holds[i];
        if (hold->slip == 0 && hold->mode != hold_keeps && holds_is_on_open(problem, hold)) return true;
    }
    return false;
}

/* The number of different combinations: a surface is open, or closed with each mode of its friction. */
static double different_modes(const struct hold_problem *problem)
{
    double all = 1;
    for (size_t g = 0; g < problem->guide_count; g++) all *= 2;
    for (size_t i = 0; i < problem->count; i++) {
        const struct hold *hold = &problem->holds[i];
        double closed = 1;
        for (size_t k = 0; hold->kind == hold_one_sided && k < problem->count; k++) {
            const struct hold *on = &problem->holds[k];
            bool rubs = on->kind == hold_friction && on->press == press_hold && on->presses == (int)i;
            if (rubs) closed *= (double)choices(on);
        }
        if (hold->kind == hold_one_sided)
            all *= 1 + closed;
        else if (hold->press != press_hold)
            all *= (double)choices(hold);
    }
    return all;
}

void trial_set_system(struct trial *trial, double give)
{
    struct hold_problem *problem = trial->problem;
    size_t n = problem->count;
    memset(trial->A, 0, n * n * sizeof *trial->A);
    memset(trial->f, 0, n * sizeof *trial->f);
    for (size_t i = 0; i < n; i++) {
        const struct hold *hold = &problem->holds[i];
        double *row = trial->A + i * n, most = 0;
        bool held = hold->mode == hold_keeps && !holds_is_on_open(problem, hold);
        if (held) {
            memcpy(row, problem->A + i * n, n * sizeof *row);
            row[i] *= 1 + give;
            trial->f[i] = -hold->free;
        } else if (hold->kind == hold_one_sided) {
            row[i] = 1;
        } else {
            slipping_row(trial, i, row, &trial->f[i]);
        }
        for (size_t j = 0; j < n; j++) most = fmax(most, fabs(row[j]));
        if (most == 0) row[i] = most = 1; /* no force moves it */
        for (size_t j = 0; j < n; j++) row[j] /= most;
        trial->f[i] /= most;
        trial->row[i] = most;
    }
}

void trial_take_forces(struct hold_problem *problem, const double *f)
{
    size_t n = problem->count;
    for (size_t i = 0; i < n; i++) {
        struct hold *hold = &problem->holds[i];
        hold->force = f[i];
        hold->c = hold->free;
        for (size_t j = 0; j < n; j++) hold->c += problem->A[i * n + j] * f[j];
    }
    for (size_t g = 0; g < problem->guide_count; g++) {
        problem->guides[g].N = problem->guides[g].free;
        for (size_t j = 0; j < n; j++) problem->guides[g].N += problem->B[g * n + j] * f[j];
    }
}

static const double touch = 1e-10;

bool trial_find_forces(struct trial *trial)
{
    size_t n = trial->problem->count;
    trial_set_system(trial, touch);
    if (!lu_decompose(n, trial->A, trial->pivot)) return false;
    lu_solve(n, trial->A, trial->pivot, trial->f);
    trial_take_forces(trial->problem, trial->f);
    return true;
}

/* Have normal forces of guides the assumed signs, to rounding? */
static bool sides_agree(const struct trial *trial)
{
    const double rounding = 1e-9;
    const struct hold_problem *problem = trial->problem;
    for (size_t g = 0; g < problem->guide_count; g++) {
        double size = fabs(problem->guides[g].free);
        for (size_t j = 0; j < problem->count; j++)
            size = fmax(size, fabs(problem->B[g * problem->count + j] * problem->holds[j].force));
        if (trial->side[g] * problem->guides[g].N < -rounding * size) return false;
    }
    return true;
}

/* Do the accelerations c agree with those of `other` to the tolerance of one motion? */
static bool same_motion(const struct hold_problem *problem, const double *c, const double *other)
{
    const double near = 1e-6;
    double difference = 0, size = 0;
    for (size_t i = 0; i < problem->count; i++) {
        double own = problem->A[i * problem->count + i], weight = own > 0 ? 1 / sqrt(own) : 0;
        difference = fmax(difference, weight * fabs(c[i] - other[i]));
        size = fmax(size, weight * fmax(fabs(problem->holds[i].free), fabs(other[i])));
    }
    return difference <= near * size;
}

static void take_accelerations(const struct hold_problem *problem, double *c)
{
    for (size_t i = 0; i < problem->count; i++) c[i] = problem->holds[i].c;
}

static bool same_as_first(struct trial *trial)
{
    take_accelerations(trial->problem, trial->row);
    return same_motion(trial->problem, trial->row, trial->first);
}

static void keep_first(struct trial *trial, size_t *number, size_t own)
{
    if (trial->solutions++ > 0) return;
    *number = own;
    take_accelerations(trial->problem, trial->first);
}

bool trial_new(struct trial *trial, struct hold_problem *problem)
{
    size_t n = problem->count;
    *trial = (struct trial){.problem = problem};
    trial->side = calloc(problem->guide_count + 1, sizeof *trial->side);
    trial->A = calloc(n * n + 3 * n + 1, sizeof *trial->A);
    trial->pivot = calloc(n + 1, sizeof *trial->pivot);
    if (!trial->side || !trial->A || !trial->pivot) return false;
    trial->f = trial->A + n * n;
    trial->first = trial->f + n;
    trial->row = trial->first + n;
    return true;
}

void trial_free(struct trial *trial)
{
    free(trial->side);
    free(trial->A);
    free(trial->pivot);
}

static size_t all_modes(const struct hold_problem *problem)
{
    size_t all = 1;
    for (size_t g = 0; g < problem->guide_count; g++) all *= 2;
    for (size_t i = 0; i < problem->count; i++) all *= choices(&problem->holds[i]);
    return all;
}

/* Set mode combination `number`: holds_decided where its forces are consistent, else holds_lost. */
static enum holds_found try_modes(struct trial *trial, size_t number)
{
    set_modes(trial, number);
    if (is_repeated(trial->problem) || !trial_find_forces(trial) || !sides_agree(trial) ||
        !holds_agree(trial->problem))
        return holds_lost;
    return holds_meet(trial->problem);
}

int holds_try_all(struct hold_problem *problem, size_t most)
{
    struct trial trial;
    size_t best = 0;
    if (different_modes(problem) > (double)most) return -1;
    size_t all = all_modes(problem);
    bool made = trial_new(&trial, problem);
    for (size_t number = 0; made && number < all; number++) {
        enum holds_found found = try_modes(&trial, number);
        made = found != holds_no_memory;
        if (found == holds_decided && (trial.solutions == 0 || !same_as_first(&trial)))
            keep_first(&trial, &best, number);
    }
    if (made && trial.solutions > 0) {
        set_modes(&trial, best);
        trial_find_forces(&trial);
        made = holds_meet(problem) != holds_no_memory;
        holds_set_open(problem);
    }
    trial_free(&trial);
    return made ? trial.solutions : -2;
}

/* ---- uniqueness */

/* Solutions in sequence: modes and accelerations of each constraint. */
struct solutions {
    size_t count, room;
    int *modes;
    double *c;
};

static bool keep_solution(struct solutions *solutions, const struct hold_problem *problem)
{
    size_t n = problem->count;
    if (solutions->count == solutions->room) {
        size_t room = solutions->room ? 2 * solutions->room : 4;
        int *modes = realloc(solutions->modes, room * n * sizeof *modes);
        if (modes) solutions->modes = modes;
        double *c = realloc(solutions->c, room * n * sizeof *c);
        if (c) solutions->c = c;
        if (!modes || !c) return false;
        solutions->room = room;
    }
    for (size_t i = 0; i < n; i++) solutions->modes[solutions->count * n + i] = problem->holds[i].mode;
    take_accelerations(problem, solutions->c + solutions->count * n);
    solutions->count++;
    return true;
}

/* Does some friction stick in `more` that slips in `less`, and none conversely? With mu_k < mu_s the law alone also permits
 * slip where friction sticks; but friction that can stick at rest does. */
static bool holds_more(const struct hold_problem *problem, const int *more, const int *less)
{
    bool longer = false;
    for (size_t i = 0; i < problem->count; i++) {
        const struct hold *hold = &problem->holds[i];
        if (more[i] == less[i]) continue;
        if (hold->kind == hold_one_sided || less[i] == hold_keeps) return false;
        longer |= more[i] == hold_keeps && hold->mu_k < hold->mu_s;
    }
    return longer;
}

/* Does a solution count in addition to the first one: with another motion, and not dominated by one with more
 * sticking contacts? */
static bool counts_beside(const struct solutions *solutions, const struct hold_problem *problem, size_t which)
{
    size_t n = problem->count;
    if (same_motion(problem, solutions->c + which * n, solutions->c)) return false;
    for (size_t k = 0; k < solutions->count; k++)
        if (holds_more(problem, solutions->modes + k * n, solutions->modes + which * n)) return false;
    return true;
}

int holds_is_unique(struct hold_problem *problem, size_t most)
{
    struct trial trial = {0};
    struct solutions solutions = {0};
    if (different_modes(problem) > (double)most) return -1;
    size_t all = all_modes(problem);
    bool made = keep_solution(&solutions, problem) && trial_new(&trial, problem), unique = true;
    for (size_t number = 0; made && number < all; number++) {
        enum holds_found found = try_modes(&trial, number);
        made = found != holds_no_memory && (found != holds_decided || keep_solution(&solutions, problem));
    }
    for (size_t k = 1; made && k < solutions.count; k++) unique &= !counts_beside(&solutions, problem, k);
    trial_free(&trial);
    free(solutions.modes);
    free(solutions.c);
    return made ? unique : -2;
}
