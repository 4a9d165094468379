/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/holds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "holds/mend.h"
#include "holds/parts.h"
#include "numeric/lcp.h"
#include "numeric/lu.h"

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

/* ---- affine functions of z: rows of `width` numbers, the coefficients of z and then the constant */

struct affine {
    const struct hold_problem *problem;
    size_t m, width;   /* unknowns z, and one more */
    size_t *first;     /* count + guide_count: the first unknown of a hold or guide */
    double *f, *N, *c; /* rows of the holds, guides, holds */
    double *M, *q, *z, *w;
    double *implicit; /* count x count: f = f(z) + H N with N = N_0 + B f */
    size_t *pivot;
    double *column;
};

static size_t unknowns_of(const struct hold *hold)
{
    return hold->kind == hold_one_sided ? 1 : hold->slip == 0 ? 2 : 0;
}

static double *row(double *rows, const struct affine *of, size_t i)
{
    return rows + i * of->width;
}

static void add_row(const struct affine *of, double *to, double share, const double *from)
{
    for (size_t k = 0; k < of->width; k++) to[k] += share * from[k];
}

static void affine_free(struct affine *of)
{
    free(of->f);
    free(of->first);
}

static bool affine_new(struct affine *of, const struct hold_problem *problem)
{
    size_t count = problem->count, guides = problem->guide_count, m = guides;
    for (size_t i = 0; i < count; i++) m += unknowns_of(&problem->holds[i]);
    *of = (struct affine){.problem = problem, .m = m, .width = m + 1};
    of->f =
        calloc((2 * count + guides) * of->width + m * m + 3 * m + count * count + count + 1, sizeof *of->f);
    of->first = calloc(2 * count + guides + 1, sizeof *of->first);
    if (!of->f || !of->first) return false;
    of->N = of->f + count * of->width;
    of->c = of->N + guides * of->width;
    of->M = of->c + count * of->width;
    of->q = of->M + m * m;
    of->z = of->q + m;
    of->w = of->z + m;
    of->implicit = of->w + m;
    of->column = of->implicit + count * count;
    of->pivot = of->first + count + guides;
    for (size_t i = 0, next = 0; i < count + guides; i++) {
        of->first[i] = next;
        next += i < count ? unknowns_of(&problem->holds[i]) : 1;
    }
    return true;
}

/* Add `share` times P of a friction constraint, without the term of N of a two-sided guide, P = 2 N' - N. */
static void add_press(const struct affine *of, const struct hold *hold, double share, double *to)
{
    const struct hold_problem *problem = of->problem;
    if (hold->press == press_constant) to[of->m] += share;
    if (hold->press == press_hold) to[of->first[hold->presses]] += share;
    if (hold->press != press_guide) return;
    bool two_sided = problem->guides[hold->presses].two_sided;
    to[of->first[problem->count + (size_t)hold->presses]] += (two_sided ? 2 : 1) * share;
}

static bool lint_friction_on_both_sides(const struct affine *of, const struct hold *hold)
{
    return hold->kind == hold_friction && hold->press == press_guide &&
           of->problem->guides[hold->presses].two_sided;
}

/* The factor of P in f, besides r: -mu_s at rest, -slip mu_k where it slips. */
static double share_of(const struct hold *hold)
{
    return hold->slip == 0 ? -hold->mu_s : -hold->slip * hold->mu_k;
}

/* f = F z + H (N_0 + B f), so that (1 - H B) f = F z + H N_0. False when friction on guides makes that
 * singular. */
static bool set_forces(struct affine *of)
{
    const struct hold_problem *problem = of->problem;
    size_t count = problem->count;
    bool implicit = false;
    for (size_t i = 0; i < count; i++) {
        const struct hold *hold = &problem->holds[i];
        double *f = row(of->f, of, i);
        if (unknowns_of(hold) > 0) f[of->first[i]] = 1;
        if (hold->kind == hold_one_sided) continue;
        add_press(of, hold, share_of(hold), f);
        of->implicit[i * count + i] = 1;
        if (!lint_friction_on_both_sides(of, hold)) continue;
        implicit = true;
        f[of->m] -= share_of(hold) * problem->guides[hold->presses].free;
    }
    if (!implicit) return true;
    for (size_t i = 0; i < count; i++) {
        const struct hold *hold = &problem->holds[i];
        for (size_t j = 0; j < count; j++) {
            double B =
                lint_friction_on_both_sides(of, hold) ? problem->B[(size_t)hold->presses * count + j] : 0;
            of->implicit[i * count + j] = (i == j) + share_of(hold) * B;
        }
    }
    if (!lu_decompose(count, of->implicit, of->pivot)) return false;
    for (size_t k = 0; k < of->width; k++) {
        for (size_t i = 0; i < count; i++) of->column[i] = row(of->f, of, i)[k];
        lu_solve(count, of->implicit, of->pivot, of->column);
        for (size_t i = 0; i < count; i++) row(of->f, of, i)[k] = of->column[i];
    }
    return true;
}

static void set_answers(struct affine *of)
{
    const struct hold_problem *problem = of->problem;
    size_t count = problem->count;
    for (size_t i = 0; i < count; i++) {
        double *c = row(of->c, of, i);
        c[of->m] = problem->holds[i].free;
        for (size_t j = 0; j < count; j++) add_row(of, c, problem->A[i * count + j], row(of->f, of, j));
    }
    for (size_t g = 0; g < problem->guide_count; g++) {
        double *N = row(of->N, of, g);
        N[of->m] = problem->guides[g].free;
        for (size_t j = 0; j < count; j++) add_row(of, N, problem->B[g * count + j], row(of->f, of, j));
    }
}

static void set_w(struct affine *of, size_t i, double share, const double *from)
{
    for (size_t k = 0; k < of->m; k++) of->M[i * of->m + k] += share * from[k];
    of->q[i] += share * from[of->m];
}

static void set_problem(struct affine *of)
{
    const struct hold_problem *problem = of->problem;
    size_t count = problem->count;
    for (size_t i = 0; i < count; i++) {
        const struct hold *hold = &problem->holds[i];
        size_t first = of->first[i];
        if (unknowns_of(hold) == 0) continue;
        set_w(of, first, 1, row(of->c, of, i));
        if (hold->kind == hold_one_sided) continue;
        of->M[first * of->m + first + 1] += 1;       /* c' = c + c'' */
        set_w(of, first + 1, -2, row(of->f, of, i)); /* l = mu P - f = r - 2 f */
        of->M[(first + 1) * of->m + first] += 1;
    }
    for (size_t g = 0; g < problem->guide_count; g++) {
        size_t own = of->first[count + g];
        set_w(of, own, -1, row(of->N, of, g));
        of->M[own * of->m + own] += 1;
    }
}

/* ---- result */

static double value(const struct affine *of, const double *affine, const double *z)
{
    double sum = affine[of->m];
    for (size_t k = 0; k < of->m; k++) sum += affine[k] * z[k];
    return sum;
}

double holds_weight(const struct hold_problem *problem, size_t i)
{
    double own = problem->A[i * problem->count + i];
    return own > 0 ? 1 / sqrt(own) : 0;
}

/* Accelerations below this count as zero: a fraction of the largest, for rounding and the corrections of
 * multipliers. */
static double rounding_of(const struct hold_problem *problem, double share)
{
    double most = problem->beside_c;
    for (size_t i = 0; i < problem->count; i++) {
        double size = fabs(problem->holds[i].free);
        for (size_t j = 0; j < problem->count; j++)
            size = fmax(size, fabs(problem->A[i * problem->count + j] * problem->holds[j].force));
        most = fmax(most, holds_weight(problem, i) * size);
    }
    return share * most;
}

bool holds_is_on_open(const struct hold_problem *problem, const struct hold *hold)
{
    return hold->kind == hold_friction && hold->press == press_hold &&
           problem->holds[hold->presses].mode != hold_keeps;
}

bool holds_is_still(const struct hold_problem *problem, size_t i, double share)
{
    return fabs(holds_weight(problem, i) * problem->holds[i].c) <= rounding_of(problem, share);
}

void holds_set_open(struct hold_problem *problem)
{
    double zero = rounding_of(problem, 1e-11);
    for (size_t i = 0; i < problem->count; i++) {
        struct hold *hold = &problem->holds[i];
        double c = holds_weight(problem, i) * hold->c;
        if (hold->slip == 0 && holds_is_on_open(problem, hold))
            hold->mode = c > zero ? hold_gives : c < -zero ? hold_slips_back : hold_keeps;
    }
}

static void set_modes(struct hold_problem *problem)
{
    double zero = rounding_of(problem, 1e-11);
    for (size_t i = 0; i < problem->count; i++) {
        struct hold *hold = &problem->holds[i];
        double c = holds_weight(problem, i) * hold->c;
        if (hold->slip != 0)
            hold->mode = hold->slip;
        else
            hold->mode = c > zero                                   ? hold_gives
                         : c < -zero && hold->kind == hold_friction ? hold_slips_back
                                                                    : hold_keeps;
    }
}

/* Solve the problem that was set up. */
static enum holds_found solve_affine(struct affine *of, struct hold_problem *problem, int cover)
{
    if (!set_forces(of)) return holds_lost;
    set_answers(of);
    set_problem(of);
    enum lcp lcp = lcp_solve(of->m, of->M, of->q, cover, of->z, of->w);
    if (lcp != lcp_solved) return lcp == lcp_no_memory ? holds_no_memory : holds_lost;
    for (size_t i = 0; i < problem->count; i++) {
        problem->holds[i].force = value(of, row(of->f, of, i), of->z);
        problem->holds[i].c = value(of, row(of->c, of, i), of->z);
    }
    for (size_t g = 0; g < problem->guide_count; g++)
        problem->guides[g].N = value(of, row(of->N, of, g), of->z);
    set_modes(problem);
    return holds_decided;
}

static enum holds_found solve_once(struct hold_problem *problem, int cover)
{
    struct affine of;
    enum holds_found found = affine_new(&of, problem) ? solve_affine(&of, problem, cover) : holds_no_memory;
    affine_free(&of);
    return found;
}

/* ---- consistency of modes and forces */

static double press_of(const struct hold_problem *problem, const struct hold *hold)
{
    if (hold->press == press_constant) return 1;
    if (hold->press == press_hold) return fmax(0, problem->holds[hold->presses].force);
    const struct hold_guide *guide = &problem->guides[hold->presses];
    return guide->two_sided ? fabs(guide->N) : fmax(0, guide->N);
}

/* Forces of constraint i below this count as zero. */
static double force_rounding(const struct hold_problem *problem, size_t i)
{
    const double rounding = 1e-9, beside = 1e-4;
    const struct hold *hold = &problem->holds[i];
    double own = problem->A[i * problem->count + i], size = fabs(hold->force);
    if (own > 0) size = fmax(size, fabs(hold->free) / own);
    if (hold->kind == hold_friction) size = fmax(size, hold->mu_s * press_of(problem, hold));
    /* A constraint without load has the rounding of the forces of the others. */
    size = fmax(size, beside * problem->beside_force);
    for (size_t j = 0; j < problem->count; j++) size = fmax(size, beside * fabs(problem->holds[j].force));
    return rounding * size;
}

enum hold_breach holds_breach(const struct hold_problem *problem, size_t i)
{
    const struct hold *hold = &problem->holds[i];
    double c = holds_weight(problem, i) * hold->c, zero = rounding_of(problem, 1e-9);
    bool rubs = hold->kind == hold_friction;
    if (holds_is_on_open(problem, hold)) return hold_breaks_nothing;
    if (hold->mode != hold_keeps)
        return hold->slip == 0 && hold->mode * c < -zero ? hold_moves_back : hold_breaks_nothing;
    double over =
        rubs ? fabs(hold->force) - fmax(hold->mu_s, hold->mu_k) * press_of(problem, hold) : -hold->force;
    return over > force_rounding(problem, i) ? hold_overloaded : hold_breaks_nothing;
}

static bool agrees(const struct hold_problem *problem, size_t i, double zero)
{
    const struct hold *hold = &problem->holds[i];
    double c = holds_weight(problem, i) * hold->c, small = force_rounding(problem, i);
    if (hold->kind == hold_one_sided && hold->mode == hold_keeps) return hold->force >= -small && c <= zero;
    if (hold->kind == hold_one_sided) return c >= -zero && fabs(hold->force) <= small;
    double P = press_of(problem, hold);
    if (holds_is_on_open(problem, hold)) return fabs(hold->force) <= small;
    if (hold->mode == hold_keeps)
        return fabs(hold->force) <= fmax(hold->mu_s, hold->mu_k) * P + small && fabs(c) <= zero;
    bool own_way = hold->slip != 0 || hold->mode * c >= -zero;
    return own_way && fabs(hold->force + hold->mode * hold->mu_k * P) <= small;
}

bool holds_agree(const struct hold_problem *problem)
{
    double zero = rounding_of(problem, 1e-9);
    for (size_t i = 0; i < problem->count; i++)
        if (!agrees(problem, i, zero)) return false;
    return true;
}

/* ---- complete solution */

/* With mu_k < mu_s: constraints that slip get mu_k, and the others are decided again. */
static enum holds_found solve(struct hold_problem *problem, int cover)
{
    enum holds_found found = holds_lost;
    for (size_t round = 0; round <= problem->count; round++) {
        bool more = false;
        found = solve_once(problem, cover);
        for (size_t i = 0; found == holds_decided && i < problem->count; i++) {
            struct hold *hold = &problem->holds[i];
            if (hold->kind != hold_friction || hold->slip != 0 || hold->mode == hold_keeps) continue;
            if (hold->mu_k == hold->mu_s) continue;
            hold->slip = hold->mode;
            more = true;
        }
        if (!more) break;
    }
    return found;
}

/* mu_k > mu_s is not physical, but possible in a file: the friction force would exceed the limit at
 * breakaway, so the larger one is used. */
static double larger(const struct hold *hold)
{
    return fmax(hold->mu_s, hold->mu_k);
}

/* A solution, saved during the search for others. */
struct found {
    struct hold *holds;
    struct hold_guide *guides;
};

static bool found_keep(struct found *found, const struct hold_problem *problem)
{
    found->holds = calloc(problem->count + 1, sizeof *found->holds);
    found->guides = calloc(problem->guide_count + 1, sizeof *found->guides);
    if (!found->holds || !found->guides) return false;
    memcpy(found->holds, problem->holds, problem->count * sizeof *found->holds);
    memcpy(found->guides, problem->guides, problem->guide_count * sizeof *found->guides);
    return true;
}

static void found_restore(struct found *found, struct hold_problem *problem)
{
    if (found->holds) memcpy(problem->holds, found->holds, problem->count * sizeof *found->holds);
    if (found->guides) memcpy(problem->guides, found->guides, problem->guide_count * sizeof *found->guides);
    free(found->holds);
    free(found->guides);
}

/* Can there be other solutions? Only with friction that changes its own normal force, or with mu_s > mu_k
 * together with other constraints. */
static bool may_have_others(const struct hold_problem *problem)
{
    bool may = false;
    for (size_t i = 0; i < problem->count; i++) {
        const struct hold *hold = &problem->holds[i];
        if (hold->kind != hold_friction) continue;
        may |= hold->press != press_constant || (hold->mu_k < hold->mu_s && problem->count > 1);
    }
    return may;
}

/* Is it the only solution? The problem is not changed. */
static enum holds_found look_for_others(struct hold_problem *problem, size_t most)
{
    struct found found = {0};
    if (!may_have_others(problem)) return holds_decided;
    int unique = found_keep(&found, problem) ? holds_is_unique(problem, most) : -2;
    found_restore(&found, problem);
    return unique == -2 ? holds_no_memory : unique == 0 ? holds_several : holds_decided;
}

/* Solve, and restore the given directions of slip. */
static enum holds_found solve_and_keep(struct hold_problem *problem, int cover)
{
    int *slips = calloc(problem->count + 1, sizeof *slips);
    if (!slips) return holds_no_memory;
    for (size_t i = 0; i < problem->count; i++) slips[i] = problem->holds[i].slip;
    enum holds_found found = solve(problem, cover);
    for (size_t i = 0; i < problem->count; i++) problem->holds[i].slip = slips[i];
    free(slips);
    return found;
}

static enum holds_found check(struct hold_problem *problem)
{
    return holds_agree(problem) ? holds_meet(problem) : holds_lost;
}

/* All constraints that do not slip already stick or are closed. */
static void keep_all(struct hold_problem *problem)
{
    for (size_t i = 0; i < problem->count; i++) problem->holds[i].mode = problem->holds[i].slip;
}

/* For too many constraints to enumerate their modes. Where one start of Lemke's method ends in a ray or fails
 * by rounding another may not, and of inconsistent modes only a few may be wrong. */
static enum holds_found try_further(struct hold_problem *problem)
{
    enum { most_covers = 16 };
    keep_all(problem);
    enum holds_found found = holds_mend(problem);
    for (int cover = 0; cover < most_covers && found == holds_lost; cover++) {
        found = solve_and_keep(problem, cover);
        if (found != holds_decided) continue;
        found = check(problem);
        if (found == holds_lost) found = holds_mend(problem);
    }
    return found;
}

static enum holds_found decide(struct hold_problem *problem)
{
    enum { most_modes = 70000 }; /* of eight points with friction */
    enum { few_rows = 8, few_modes = 6561 };
    enum holds_found found = solve_and_keep(problem, 0);
    if (found == holds_decided) found = check(problem);
    if (found == holds_no_memory) return found;
    if (found == holds_decided)
        return problem->count <= few_rows ? look_for_others(problem, few_modes) : holds_decided;
    int solutions = holds_try_all(problem, most_modes);
    if (solutions == -2) return holds_no_memory;
    return solutions < 0    ? try_further(problem)
           : solutions == 0 ? holds_none
           : solutions > 1  ? look_for_others(problem, most_modes)
                            : holds_decided;
}

enum holds_found holds_decide(struct hold_problem *problem)
{
    for (size_t i = 0; i < problem->count; i++) problem->holds[i].mu_s = larger(&problem->holds[i]);
    return parts_decide(problem, decide);
}
