/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "impacts_by_sets.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Of a point: whether it is held up, and what its friction does. */
enum rub { rub_plus, rub_minus, rub_holds, rubs };

struct state {
    bool closed;
    enum rub rub;
};

/* One problem: velocities `free` without impulses, normal impulses that are given, and what is wanted of each point:
 * v_n >= 0 with more impulse only where it is 0, and friction by v_t. */
struct problem {
    const struct points_by_sets *points;
    double free[sets_rows], given[sets_most], small; /* small: of velocities */
};

struct answer {
    double v[sets_rows], P[sets_rows]; /* P: with what is given */
};

static const double rounding = 1e-9;

/* a x = b by elimination; false where it is singular. */
static bool eliminate(int n, double a[sets_rows][sets_rows], double *b)
{
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k; i < n; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
        if (!(fabs(a[pivot][k]) > 1e-9)) return false;
        for (int j = 0; j < n; j++) {
            double keep = a[k][j];
            a[k][j] = a[pivot][j];
            a[pivot][j] = keep;
        }
        double keep = b[k];
        b[k] = b[pivot];
        b[pivot] = keep;
        for (int i = 0; i < n; i++) {
            double factor = i == k ? 0 : a[i][k] / a[k][k];
            for (int j = k; j < n; j++) a[i][j] -= factor * a[k][j];
            b[i] -= factor * b[k];
        }
    }
    for (int k = 0; k < n; k++) b[k] /= a[k][k];
    return true;
}

/* Friction for each unit of the normal impulse. */
static double share(const struct points_by_sets *points, const struct state *set, int k)
{
    if (set[k].rub == rub_holds) return 0;
    return set[k].rub == rub_plus ? -points->mu[k] : points->mu[k];
}

/* By how much row i answers to unknown j: a normal impulse, with the friction that it brings, or that of what holds. */
static double answer_of(const struct points_by_sets *points, const struct state *set, int i, int j)
{
    double answer = points->W[i][j];
    return j % 2 == 1 ? answer : answer + share(points, set, j / 2) * points->W[i][j + 1];
}

static void give(const struct points_by_sets *points, const struct state *set, int j, double impulse,
                 struct answer *answer)
{
    for (int i = 0; i < 2 * points->count; i++) answer->v[i] += answer_of(points, set, i, j) * impulse;
    answer->P[j] += impulse;
    if (j % 2 == 0) answer->P[j + 1] += share(points, set, j / 2) * impulse;
}

static bool solve_set(const struct problem *problem, const struct state *set, struct answer *answer)
{
    const struct points_by_sets *points = problem->points;
    int rows[sets_rows], n = 0;
    double a[sets_rows][sets_rows] = {{0}}, b[sets_rows] = {0};
    memcpy(answer->v, problem->free, sizeof answer->v);
    memset(answer->P, 0, sizeof answer->P);
    for (int k = 0; k < points->count; k++) {
        give(points, set, 2 * k, problem->given[k], answer);
        if (set[k].closed) rows[n++] = 2 * k;
        if (set[k].rub == rub_holds) rows[n++] = 2 * k + 1;
    }
    for (int i = 0; i < n; i++) {
        b[i] = -answer->v[rows[i]];
        for (int j = 0; j < n; j++) a[i][j] = answer_of(points, set, rows[i], rows[j]);
    }
    if (!eliminate(n, a, b)) return false;
    for (int j = 0; j < n; j++) give(points, set, rows[j], b[j], answer);
    return true;
}

static bool is_right(const struct problem *problem, const struct state *set, const struct answer *answer)
{
    const double small = problem->small;
    for (ptrdiff_t k = 0; k < problem->points->count; k++) {
        const double *v = &answer->v[2 * k], *P = &answer->P[2 * k],
                     inverse = problem->points->W[2 * k][2 * k];
        if (v[0] < -small || (P[0] - problem->given[k]) * inverse < -small) return false;
        switch (set[k].rub) {
        case rub_plus:
            if (v[1] < -small && problem->points->mu[k] > 0) return false;
            break;
        case rub_minus:
            if (v[1] > small) return false;
            break;
        default:
            if ((fabs(P[1]) - problem->points->mu[k] * P[0]) * inverse > small) return false;
        }
    }
    return true;
}

static bool all_agree(int n, const double *a, const double *b, double small)
{
    for (int i = 0; i < n; i++)
        if (fabs(a[i] - b[i]) > small) return false;
    return true;
}

/* By the velocities that they give to each row by itself. */
static bool impulses_agree(const struct problem *problem, const struct answer *a, const struct answer *b)
{
    for (int i = 0; i < 2 * problem->points->count; i++)
        if (fabs(a->P[i] - b->P[i]) * problem->points->W[i][i] > 1e3 * problem->small) return false;
    return true;
}

/* Does an answer do what a set wants? */
static bool does_as(const struct problem *problem, const struct state *set, const struct answer *answer)
{
    const double small = 100 * problem->small;
    for (ptrdiff_t k = 0; k < problem->points->count; k++) {
        const double *v = &answer->v[2 * k], *P = &answer->P[2 * k],
                     inverse = problem->points->W[2 * k][2 * k];
        double slides = P[1] - share(problem->points, set, (int)k) * P[0];
        if (set[k].closed ? fabs(v[0]) > small : fabs(P[0] - problem->given[k]) * inverse > small)
            return false;
        if (set[k].rub == rub_holds ? fabs(v[1]) > small : fabs(slides) * inverse > small) return false;
    }
    return is_right(problem, set, answer);
}

/* Set `number`; what has no friction has one way to rub. False beyond the last one. */
static bool find_set(const struct points_by_sets *points, long number, struct state *set)
{
    for (int k = 0; k < points->count; k++) {
        int ways = points->mu[k] > 0 ? rubs : 1;
        set[k] = (struct state){number % 2, (enum rub)(number / 2 % ways)};
        number /= 2L * ways;
    }
    return number == 0;
}

/* A set whose own impulses are not determined, and that the answer belongs to, has others beside it. */
static bool is_one_of_many(const struct problem *problem, const struct answer *answer)
{
    struct state set[sets_most] = {{0}};
    struct answer ignored;
    for (long number = 0; find_set(problem->points, number, set); number++)
        if (!solve_set(problem, set, &ignored) && does_as(problem, set, answer)) return true;
    return false;
}

/* All sets: 0, 1 or more answers. Velocities that several impulses give are one answer, unless it is the impulses that are
 * asked for. */
static int solve(const struct problem *problem, bool impulses, struct answer *answer)
{
    const int count = problem->points->count;
    struct state set[sets_most] = {{0}};
    int found = 0;
    for (long number = 0; find_set(problem->points, number, set); number++) {
        struct answer here;
        if (!solve_set(problem, set, &here) || !is_right(problem, set, &here)) continue;
        if (found > 0 && all_agree(2 * count, answer->v, here.v, 100 * problem->small) &&
            (!impulses || impulses_agree(problem, answer, &here)))
            continue;
        *answer = here;
        found++;
    }
    return found == 1 && impulses && is_one_of_many(problem, answer) ? 2 : found;
}

static double normal_work(const double *P, const double *before, const double *after, ptrdiff_t k)
{
    return P[2 * k] * (before[2 * k] + after[2 * k]) / 2;
}

struct together {
    const struct points_by_sets *points;
    const double *before;
    struct answer pressed, back;
    double small;
};

/* With `share` of e: by how much more is given back than may be; NAN where there is no one answer. */
static double surplus(struct together *together, double share, bool stronge)
{
    const struct points_by_sets *points = together->points;
    const struct answer *pressed = &together->pressed;
    struct problem problem = {.points = points, .small = together->small};
    double back = 0, due = 0, work = 0;
    memcpy(problem.free, pressed->v, sizeof problem.free);
    for (ptrdiff_t k = 0; k < points->count; k++) problem.given[k] = share * points->e[k] * pressed->P[2 * k];
    if (solve(&problem, stronge, &together->back) != 1) return NAN; /* works are by the impulses of points */
    for (int k = 0; k < points->count; k++) {
        back += normal_work(together->back.P, pressed->v, together->back.v, k);
        due -= points->e[k] * points->e[k] * normal_work(pressed->P, together->before, pressed->v, k);
    }
    for (int i = 0; i < 2 * points->count; i++) {
        work += together->back.P[i] * (pressed->v[i] + together->back.v[i]) / 2;
        work += pressed->P[i] * (together->before[i] + pressed->v[i]) / 2;
    }
    return stronge ? fmax(back - fmax(due, 0), work) : work;
}

/* The share by halves. */
static bool restore(struct together *together, bool stronge)
{
    const double small = 1e-13 * together->small / rounding;
    double low = 0, high = 1, at = surplus(together, 1, stronge);
    if (!(fabs(at) <= HUGE_VAL)) return false;
    if (fabs(at) <= small || (at < 0 && !stronge)) return true;
    if (at > 0 && surplus(together, 0, stronge) >= -small) return true; /* nothing may be given back */
    for (int k = 0; at < 0 && k < 10; k++) {
        low = high;
        at = surplus(together, high *= 2, stronge);
    }
    if (at < 0) return true;
    for (int k = 0; k < 60 && at == at; k++) {
        at = surplus(together, (low + high) / 2, stronge);
        if (at > 0)
            high = (low + high) / 2;
        else
            low = (low + high) / 2;
    }
    if (at != at) return false; /* on the way to it there is more than one answer, or none */
    return surplus(together, low, stronge) <= HUGE_VAL;
}

/* The first of those that are the same to rounding. */
static ptrdiff_t fastest(const struct points_by_sets *points, const double *v)
{
    ptrdiff_t best = 0;
    for (ptrdiff_t k = 1; k < points->count; k++)
        if (v[2 * k] < v[2 * best] - 1e-12 * fabs(v[2 * best])) best = k;
    return best;
}

/* Of those with restitution. */
static enum law_by_steps law_of(const struct points_by_sets *points, const double *v)
{
    ptrdiff_t best = -1;
    for (ptrdiff_t k = 0; k < points->count; k++)
        if (points->e[k] > 0 && (best < 0 || v[2 * k] < v[2 * best])) best = k;
    return best < 0 ? steps_stronge : points->law[best];
}

/* By the law of v_n after, in one; else compressed and restored. */
static bool strike_together(const struct points_by_sets *points, double *v, double *P)
{
    enum law_by_steps law = law_of(points, v);
    struct together together = {.points = points, .before = v};
    struct problem problem = {.points = points};
    bool by_velocity = law == steps_newton || law == steps_moreau, restores = false;
    double bounce[sets_most] = {0};
    for (int i = 0; i < 2 * points->count; i++) {
        together.small = fmax(together.small, rounding * fabs(v[i]));
        if (i % 2 == 0 && by_velocity && v[i] < 0) bounce[i / 2] = points->e[i / 2] * v[i];
        problem.free[i] = v[i] + (i % 2 == 0 ? bounce[i / 2] : 0);
    }
    problem.small = together.small;
    for (ptrdiff_t k = 0; k < points->count; k++) restores |= points->e[k] > 0 && !by_velocity;
    if (solve(&problem, restores, &together.pressed) != 1) return false;
    for (ptrdiff_t k = 0; k < points->count; k++) together.pressed.v[2 * k] -= bounce[k];
    if (restores && !restore(&together, law == steps_stronge)) return false;
    for (int i = 0; i < 2 * points->count; i++) P[i] = together.pressed.P[i] + together.back.P[i];
    memcpy(v, restores ? together.back.v : together.pressed.v, 2 * (size_t)points->count * sizeof *v);
    return true;
}

/* The impact of one by itself; others feel it. */
static void strike_one(const struct points_by_sets *points, ptrdiff_t k, double *v, double *all)
{
    const struct point_by_steps point = {{points->W[2 * k][2 * k], points->W[2 * k][2 * k + 1],
                                          points->W[2 * k + 1][2 * k + 1]},
                                         points->mu[k],
                                         points->e[k],
                                         points->law[k]};
    double own[2] = {v[2 * k], v[2 * k + 1]}, P[2];
    impact_by_steps(&point, own, P);
    for (int i = 0; i < 2 * points->count; i++)
        v[i] += points->W[i][2 * k] * P[0] + points->W[i][2 * k + 1] * P[1];
    for (int i = 0; i < 2; i++) {
        v[2 * k + i] = own[i];
        all[2 * k + i] += P[i];
    }
}

static bool strike_in_turn(const struct points_by_sets *points, double *v, double *P)
{
    enum { most_rounds = 9000 };
    double least = 0;
    for (int i = 0; i < 2 * points->count; i++) least = fmax(least, 1e-13 * fabs(v[i]));
    for (int round = 0; round < most_rounds; round++) {
        ptrdiff_t k = fastest(points, v);
        if (v[2 * k] >= -least) return true;
        strike_one(points, k, v, P);
    }
    return false;
}

static bool strike_part(const struct points_by_sets *points, double *v, double *P)
{
    if (v[2 * fastest(points, v)] >= 0) return true;
    if (points->count == 1) {
        strike_one(points, 0, v, P);
        return true;
    }
    return points->in_turn ? strike_in_turn(points, v, P) : strike_together(points, v, P);
}

static bool feels(const struct points_by_sets *points, int i, int j)
{
    for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++)
            if (points->W[2 * i + a][2 * j + b] != 0) return true;
    return false;
}

/* Those that a point feels, by way of others, too. */
static int find_part(const struct points_by_sets *points, int first, bool *taken, int *member)
{
    int count = 1;
    member[0] = first;
    taken[first] = true;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < points->count; j++) {
            if (taken[j] || !feels(points, member[i], j)) continue;
            taken[j] = true;
            member[count++] = j;
        }
    return count;
}

bool impacts_by_sets(const struct points_by_sets *points, double *v, double *P)
{
    bool taken[sets_most] = {false};
    for (int first = 0; first < points->count; first++) {
        int member[sets_most];
        struct points_by_sets part = {.in_turn = points->in_turn};
        double own[sets_rows] = {0}, impulses[sets_rows] = {0};
        if (taken[first]) continue;
        part.count = find_part(points, first, taken, member);
        for (int i = 0; i < 2 * part.count; i++) {
            int row = 2 * member[i / 2] + i % 2;
            own[i] = v[row];
            part.mu[i / 2] = points->mu[row / 2];
            part.e[i / 2] = points->e[row / 2];
            part.law[i / 2] = points->law[row / 2];
            for (int j = 0; j < 2 * part.count; j++) part.W[i][j] = points->W[row][2 * member[j / 2] + j % 2];
        }
        if (!strike_part(&part, own, impulses)) return false;
        for (int i = 0; i < 2 * part.count; i++) {
            v[2 * member[i / 2] + i % 2] = own[i];
            P[2 * member[i / 2] + i % 2] = impulses[i];
        }
    }
    return true;
}
