/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/together.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "holds/holds.h"
#include "holds/others.h"
#include "numeric/tolerances.h"

/* v += W P for additional impulses; returns their work. */
static double add_impulses(const struct impacts *impacts, const double *P, double *v)
{
    int n = impacts_size(impacts);
    double work = 0;
    for (int i = 0; i < n; i++) {
        double gain = 0;
        for (int j = 0; j < n; j++) gain += impacts->W[i * n + j] * P[j];
        work += P[i] * (v[i] + gain / 2);
        v[i] += gain;
    }
    return work;
}

/* The work of normal impulses between two velocities, with a linear change between them. */
static double normal_work(const struct impacts *impacts, const double *P, const double *before,
                          const double *after, int point)
{
    int row = 2 * point;
    (void)impacts;
    return P[row] * (before[row] + after[row]) / 2;
}

struct together {
    const struct impacts *impacts;
    struct hold_problem problem;
    double *compressed; /* all unknowns: velocities after compression */
    double *P;          /* impulses of compression */
    double *v, *more;   /* velocities after restitution, its impulses */
    bool several;       /* other modes give other velocities */
};

static void set_slides(struct together *together)
{
    const struct impacts *impacts = together->impacts;
    size_t n = (size_t)impacts_size(impacts), slides = (size_t)impacts->slides;
    struct hold_problem *problem = &together->problem;
    for (size_t i = 0; i < slides; i++) {
        struct hold *along = &problem->holds[n - slides + i];
        along->kind = hold_friction;
        along->mu_s = along->mu_k = impacts->slide[i].mu;
        along->press = press_guide;
        along->presses = (int)i;
        problem->guides[i].two_sided = impacts->slide[i].two_sided;
    }
    if (slides > 0) memcpy(problem->B, impacts->B, slides * n * sizeof(double));
}

static bool together_new(struct together *together, const struct impacts *impacts)
{
    size_t count = (size_t)impacts->count, n = (size_t)impacts_size(impacts);
    *together = (struct together){.impacts = impacts};
    if (!holds_new(&together->problem, n, (size_t)impacts->slides)) return false;
    together->compressed = calloc(4 * n + 1, sizeof(double));
    if (!together->compressed) return false;
    together->P = together->compressed + n;
    together->v = together->P + n;
    together->more = together->v + n;
    memcpy(together->problem.A, impacts->W, n * n * sizeof(double));
    for (size_t i = 0; i < count; i++) {
        struct hold *along = &together->problem.holds[2 * i + 1];
        along->kind = hold_friction;
        along->mu_s = along->mu_k = impacts->points[i].mu;
        along->slip = impacts->points[i].slips;
        along->press = press_hold;
        along->presses = (int)(2 * i);
    }
    set_slides(together);
    return true;
}

static void together_free(struct together *together)
{
    holds_free(&together->problem);
    free(together->compressed);
}

static enum impacts_end decide(struct together *together)
{
    enum holds_found found = holds_decide(&together->problem);
    together->several = found == holds_several;
    if (found == holds_no_memory) return impacts_no_memory;
    return found <= holds_several ? impacts_done : impacts_unsolvable;
}

/* Set the velocity of closed or sticking constraints to exactly zero. */
static void take(const struct together *together, double *v)
{
    for (int i = 0; i < impacts_size(together->impacts); i++) {
        const struct hold *hold = &together->problem.holds[i];
        v[i] = hold->mode == hold_keeps ? 0 : hold->c;
    }
}

/* Compression; with `newton` and `moreau` the whole impact. */
static enum impacts_end compress(struct together *together)
{
    const struct impacts *impacts = together->impacts;
    const int n = impacts_size(impacts), points = 2 * impacts->count;
    bool newton = impact_by_velocity(impacts->law);
    for (int i = 0; i < n; i++) {
        bool bounces = newton && i < points && i % 2 == 0 && impacts->v[i] < 0;
        together->problem.holds[i].free = (bounces ? 1 + impacts->points[i / 2].e : 1) * impacts->v[i];
    }
    enum impacts_end end = decide(together);
    if (end != impacts_done) return end;
    take(together, together->compressed);
    for (int i = 0; i < n; i++) {
        bool bounces = newton && i < points && i % 2 == 0 && impacts->v[i] < 0;
        if (bounces) together->compressed[i] -= impacts->points[i / 2].e * impacts->v[i];
        together->P[i] = together->problem.holds[i].force;
    }
    return impacts_done;
}

/* Is the impulse at round-off level of the largest, or does it change no speed by more than the tolerance? It
 * gets no restitution, since closing and opening could not be distinguished. */
static bool is_no_impulse(const struct together *together, int row)
{
    const struct hold_problem *problem = &together->problem;
    double most = problem->size * holds_weight(problem, (size_t)row);
    for (int k = 0; k < 2 * together->impacts->count; k += 2) most = fmax(most, together->P[k]);
    return together->P[row] <= undecided_part * most;
}

/* Restitution with `share` times e: given normal impulses, the friction that they cause, and impulses at
 * points that would close by it. */
static enum impacts_end restore(struct together *together, double share)
{
    const struct impacts *impacts = together->impacts;
    const int count = impacts->count, n = impacts_size(impacts);
    double *given = together->more;
    memset(given, 0, (size_t)n * sizeof *given);
    for (int i = 0; i < count; i++) {
        int row = 2 * i;
        given[row] = is_no_impulse(together, row) ? 0 : share * impacts->points[i].e * together->P[row];
        together->problem.holds[row + 1].preload = given[row];
    }
    for (int k = 0; k < impacts->slides; k++) {
        double *N = &together->problem.guides[k].free;
        *N = 0;
        for (int i = 0; i < n; i++) *N += impacts->B[k * n + i] * given[i];
    }
    memcpy(together->v, together->compressed, (size_t)n * sizeof *together->v);
    add_impulses(impacts, given, together->v);
    for (int i = 0; i < n; i++) together->problem.holds[i].free = together->v[i];
    enum impacts_end end = decide(together);
    take(together, together->v);
    for (int i = 0; i < n; i++) given[i] += together->problem.holds[i].force;
    return end;
}

/* The work of restitution beyond its limit; below zero when it is less. */
static double excess(const struct together *together)
{
    const struct impacts *impacts = together->impacts;
    double back = 0, due = 0;
    for (int i = 0; i < impacts->count; i++) {
        double e = impacts->points[i].e;
        back += normal_work(impacts, together->more, together->compressed, together->v, i);
        due -= e * e * normal_work(impacts, together->P, impacts->v, together->compressed, i);
    }
    return back - fmax(due, 0);
}

static double work_of(const struct impacts *impacts, const double *P, const double *before,
                      const double *after)
{
    double work = 0;
    for (int i = 0; i < impacts_size(impacts); i++) work += P[i] * (before[i] + after[i]) / 2;
    return work;
}

static double made(const struct together *together)
{
    const struct impacts *impacts = together->impacts;
    return work_of(impacts, together->P, impacts->v, together->compressed) +
           work_of(impacts, together->more, together->compressed, together->v);
}

static double surplus(const struct together *together)
{
    double work = made(together);
    return together->impacts->law == impact_stronge ? fmax(excess(together), work) : work;
}

/* Factors of e that bracket a zero of the surplus, and its values there. */
struct between {
    double low, high, at_low, at_high;
};

static enum impacts_end try_share(struct together *together, double share, double *at)
{
    enum impacts_end end = restore(together, share);
    *at = surplus(together);
    return end;
}

/* The zero of the surplus, which is quadratic between changes of modes: by the Illinois method, with a
 * bisection every few steps. */
static enum impacts_end close_in(struct together *together, struct between *between, double least)
{
    enum { most_rounds = 60, patience = 8 };
    enum impacts_end end = impacts_done;
    double count_low = 1, count_high = 1, last = 0;
    for (int k = 1; k <= most_rounds && end == impacts_done; k++) {
        double width = between->high - between->low, at;
        if (between->at_low >= -least || width <= round_off(4, between->high)) break;
        double low = count_low * between->at_low, high = count_high * between->at_high;
        double share = between->low + width * (k % patience == 0 ? 0.5 : low / (low - high));
        end = try_share(together, share, &at);
        bool stays = (at > 0) == (last > 0);
        count_low = at > 0 && stays ? count_low / 2 : 1;
        count_high = at <= 0 && stays ? count_high / 2 : 1;
        last = at > 0 ? 1 : -1;
        if (at > 0)
            *between = (struct between){between->low, share, between->at_low, at};
        else
            *between = (struct between){share, between->high, at, between->at_high};
    }
    return end;
}

/* The factor of e at which restitution returns the energy of the law: a zero of an increasing function.
 * Without friction it is 1, and 0 where only points without compression have e > 0. */
static enum impacts_end restore_by_law(struct together *together)
{
    enum { doublings = 10 };
    const struct impacts *impacts = together->impacts;
    double size = 0;
    for (int row = 0; row < 2 * impacts->count; row += 2) size += fabs(together->P[row] * impacts->v[row]);
    struct between between = {0, 1, 0, 0};
    bool stronge = impacts->law == impact_stronge;
    enum impacts_end end = try_share(together, 1, &between.at_high);
    if (end != impacts_done || fabs(between.at_high) <= negligible_part * size) return end;
    if (between.at_high < 0 && !stronge) return end;
    if (between.at_high > 0) end = try_share(together, 0, &between.at_low);
    double jammed = 0; /* factor beyond which larger impulses no longer increase the returned energy */
    for (int k = 0; k < doublings && between.at_high < 0 && end == impacts_done; k++) {
        between.low = between.high;
        between.at_low = between.at_high;
        between.high *= 2;
        end = try_share(together, between.high, &between.at_high);
        bool same = fabs(between.at_high - between.at_low) <= negligible_part * size;
        jammed = !same ? 0 : jammed > 0 ? jammed : between.low;
    }
    if (end == impacts_done && between.at_high < 0 && jammed > 0) return restore(together, jammed);
    if (end != impacts_done || between.at_high <= 0) return end;
    end = close_in(together, &between, negligible_part * size);
    return end == impacts_done ? restore(together, between.low) : end;
}

static bool has_restitution(const struct impacts *impacts)
{
    for (int i = 0; i < impacts->count; i++)
        if (impacts->points[i].e > 0) return !impact_by_velocity(impacts->law);
    return false;
}

static void finish(struct impacts *impacts, const double *P, const double *v)
{
    impacts->work += work_of(impacts, P, impacts->v, v);
    for (int i = 0; i < impacts_size(impacts); i++) {
        impacts->P[i] += P[i];
        impacts->v[i] = v[i];
    }
}

/* ---- other solutions */

static bool are_others(const struct impacts *impacts, const double *v, const double *other, double before)
{
    for (int i = 0, n = impacts_size(impacts); i < n; i++) {
        double own = impacts->W[i * n + i];
        if (own > 0 && fabs(v[i] - other[i]) > distinct_part * before * sqrt(own)) return true;
    }
    return false;
}

/* Do impulses of compression that differ by `step` lead to other velocities, after compression or after
 * restitution? */
static enum impacts_end try_step(const struct together *first, const struct together *second,
                                 const double *step, double before, bool *several)
{
    const struct impacts *impacts = first->impacts;
    const size_t n = (size_t)impacts_size(impacts);
    struct together other;
    enum impacts_end end = together_new(&other, impacts) ? impacts_done : impacts_no_memory;
    if (end == impacts_done) {
        memcpy(other.compressed, first->compressed, n * sizeof *other.compressed);
        add_impulses(impacts, step, other.compressed);
        *several |= are_others(impacts, first->compressed, other.compressed, before);
        for (size_t i = 0; i < n; i++) other.P[i] = first->P[i] + step[i];
    }
    if (end == impacts_done && !*several && second) {
        memcpy(other.compressed, first->compressed, n * sizeof *other.compressed);
        other.problem.size = before;
        end = restore_by_law(&other);
        *several |= end == impacts_done && are_others(impacts, second->v, other.v, before);
    }
    together_free(&other);
    return end == impacts_no_memory ? end : impacts_done;
}

/* Not searched with slides, or with many points (singular values cost their cube). */
static enum impacts_end look_for_others(struct together *first, struct together *second, double before,
                                        bool *several)
{
    enum { most_points = 32 };
    const struct impacts *impacts = first->impacts;
    const size_t n = (size_t)impacts_size(impacts);
    if (*several || impacts->slides > 0 || impacts->count > most_points) return impacts_done;
    double *steps = calloc(2 * n * n + 1, sizeof *steps);
    int count = steps ? holds_other_forces(&first->problem, steps) : -1;
    enum impacts_end end = count >= 0 ? impacts_done : impacts_no_memory;
    for (int k = 0; k < count && end == impacts_done && !*several; k++)
        end = try_step(first, second, steps + (size_t)k * n, before, several);
    free(steps);
    return end;
}

enum impacts_end impacts_together(struct impacts *impacts, double before)
{
    struct together first, second = {0};
    bool made_room = together_new(&first, impacts);
    first.problem.size = before;
    enum impacts_end end = made_room ? compress(&first) : impacts_no_memory;
    bool restores = end == impacts_done && has_restitution(impacts);
    if (restores) {
        end = together_new(&second, impacts) ? impacts_done : impacts_no_memory;
        if (end == impacts_done) {
            second.problem.size = before;
            memcpy(second.compressed, first.compressed, 2 * (size_t)impacts_size(impacts) * sizeof(double));
            end = restore_by_law(&second);
        }
    }
    bool several = first.several || second.several;
    if (end == impacts_done) end = look_for_others(&first, restores ? &second : NULL, before, &several);
    impacts->several |= end == impacts_done && several;
    if (end == impacts_done) finish(impacts, first.P, first.compressed);
    if (end == impacts_done && restores) finish(impacts, second.more, second.v);
    together_free(&second);
    together_free(&first);
    return end;
}
