/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "holds/impacts.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "holds/parts.h"
#include "holds/together.h"
#include "numeric/tolerances.h"

/* ---- sequential impacts */

/* The point that closes fastest; at equal speeds the first, independent of rounding. */
static int fastest(const struct impacts *impacts, double least)
{
    double most = -least;
    int best = -1;
    for (int i = 0; i < impacts->count; i++) {
        double v = impacts->v[(ptrdiff_t)2 * i];
        if (!(v < most * (best < 0 ? 1 : 1 + negligible_sum))) continue;
        most = v;
        best = i;
    }
    return best;
}

static struct impact_point alone(const struct impacts *impacts, int i)
{
    int n = 2 * impacts->count, row = 2 * i;
    const double *W = &impacts->W[row * n + row];
    return (struct impact_point){{W[0], W[1], W[n + 1]},
                                 impacts->points[i].slips ? 0 : impacts->points[i].mu,
                                 impacts->points[i].e,
                                 impacts->points[i].law};
}

/* The friction of a point that slips whatever the impulses. */
static void rub_on(const struct impacts *impacts, int i, struct impact *impact)
{
    const struct impacts_point *point = &impacts->points[i];
    if (!point->slips) return;
    impact->tau = -point->slips * point->mu * impact->p;
    impact->work += impact->tau * impact->v_t;
}

/* Apply the impact of point i to all velocities. Returns the largest change of a speed, below zero where no
 * impulse satisfies the law. */
static double strike(struct impacts *impacts, int i)
{
    int n = 2 * impacts->count, row = 2 * i;
    double most = 0;
    struct impact_point point = alone(impacts, i);
    struct impact impact = impact_at_point(&point, impacts->v[row], impacts->v[row + 1]);
    if (impact.slip == impact_jams) return -1;
    rub_on(impacts, i, &impact);
    for (int k = 0; k < n; k++) {
        double gain = impacts->W[k * n + row] * impact.p + impacts->W[k * n + row + 1] * impact.tau;
        impacts->v[k] += gain;
        most = fmax(most, fabs(gain));
    }
    impacts->v[row] = impact.v_n; /* exactly */
    impacts->v[row + 1] = impact.v_t;
    impacts->P[row] += impact.p;
    impacts->P[row + 1] += impact.tau;
    impacts->work += impact.work;
    return most;
}

static double fastest_speed(const struct impacts *impacts)
{
    double most = 0;
    for (int i = 0; i < 2 * impacts->count; i++) most = fmax(most, fabs(impacts->v[i]));
    return most;
}

/* Weighted as in holds_weight, for distances and angles alike. */
static double weighted_speed(const struct impacts *impacts)
{
    const int n = impacts_size(impacts);
    double most = 0;
    for (int i = 0; i < 2 * impacts->count; i++) {
        double own = impacts->W[i * n + i];
        if (own > 0) most = fmax(most, fabs(impacts->v[i]) / sqrt(own));
    }
    return most;
}

/* A law that may gain energy can do so at each impact: then the sequence diverges. */
static bool grows(const struct impacts *impacts, double before)
{
    const double far = 1e3;
    bool may_grow = false;
    for (int i = 0; i < impacts->count; i++) may_grow |= impact_by_velocity(impacts->points[i].law);
    return may_grow && !(weighted_speed(impacts) <= far * before);
}

/* Each change of a speed adds rounding, by which points between others would close forever: points that close
 * no faster than that are set to rest. */
static enum impacts_end propagate(struct impacts *impacts)
{
    enum { most_rounds = 10000 };
    double least = round_off(8, fastest_speed(impacts)), before = weighted_speed(impacts);
    for (int round = 0; round < most_rounds; round++) {
        int i = fastest(impacts, least);
        if (i < 0) {
            for (int row = 0; row < 2 * impacts->count; row += 2)
                if (fabs(impacts->v[row]) <= least) impacts->v[row] = 0;
            return impacts_done;
        }
        double change = strike(impacts, i);
        if (change < 0) return impacts_jammed;
        least += round_off(1, change);
        if (grows(impacts, before)) return impacts_unsolvable;
    }
    return impacts_endless;
}

/* ---- uncoupled parts */

static bool feel_each_other(const void *context, int i, int j)
{
    const struct impacts *impacts = context;
    const double *W = impacts->W;
    int n = 2 * impacts->count;
    for (int row = 2 * i; row < 2 * i + 2; row++)
        for (int column = 2 * j; column < 2 * j + 2; column++)
            if (W[row * n + column] != 0) return true;
    return false;
}

/* Sequential impacts that lose energy may go on without end, ever slower: the rest is one plastic impact. The
 * same is done if some points lose no energy, but the closing speeds are small: these are caused by rounding.
 */
static enum impacts_end propagate_to_the_end(struct impacts *impacts)
{
    double before = weighted_speed(impacts), slow = undecided_part * fastest_speed(impacts);
    enum impacts_end end = propagate(impacts);
    bool loses = true;
    for (int i = 0; i < impacts->count; i++) loses &= impacts->points[i].e < 1;
    loses |= fastest(impacts, slow) < 0;
    if (end != impacts_endless || !loses) return end;
    struct impacts rest = *impacts;
    struct impacts_point *points = calloc((size_t)impacts->count + 1, sizeof *points);
    if (!points) return impacts_no_memory;
    for (int i = 0; i < impacts->count; i++)
        points[i] =
            (struct impacts_point){impacts->points[i].mu, 0, impact_stronge, impacts->points[i].slips};
    rest.points = points;
    end = impacts_together(&rest, before);
    impacts->work = rest.work;
    impacts->several = rest.several;
    free(points);
    return end == impacts_unsolvable ? impacts_endless : end;
}

/* Are the velocities after consistent with the impulses? Their work P (v before + v after) / 2 is the change
 * of kinetic energy only if v after = v before + W P. With large impulses rounding affects that. */
enum doing { does_not, does_to_rounding, does_to_digits };

static enum doing do_what_they_say(const struct impacts *impacts, const double *before)
{
    const double share = undecided_part, of_products = round_off(4, 1); /* also of the entries of W */
    int n = impacts_size(impacts);
    double wrong = 0, beyond = 0, energy = 0;
    for (int i = 0; i < n; i++) {
        double made = before[i], products = 0, own = impacts->W[i * n + i];
        for (int j = 0; j < n; j++) {
            double product = impacts->W[i * n + j] * impacts->P[j];
            made += product;
            products += fabs(product);
        }
        double off = fabs(impacts->v[i] - made), rounding = of_products * products;
        wrong += fabs(impacts->P[i]) * (off + rounding);
        beyond += fabs(impacts->P[i]) * fmax(0, off - rounding);
        if (own > 0) energy = fmax(energy, before[i] * before[i] / own);
    }
    return wrong <= share * energy ? does_to_digits : beyond <= share * energy ? does_to_rounding : does_not;
}

static void take_back(struct impacts *impacts, const double *before)
{
    size_t n = 2 * (size_t)impacts->count;
    memcpy(impacts->v, before, n * sizeof *before);
    memset(impacts->P, 0, n * sizeof *impacts->P);
    impacts->work = 0;
}

static enum impacts_end find_by(struct impacts *impacts, bool propagates)
{
    return propagates ? propagate_to_the_end(impacts) : impacts_together(impacts, weighted_speed(impacts));
}

/* ---- large impulses */

/* A copy with W, which remains symmetric, and initial velocities perturbed by rounding of pseudo-random sign,
 * the same in every run. */
static void set_off(const struct impacts *impacts, const double *before, struct impacts *off, double *W,
                    unsigned *chance)
{
    const double rounding = round_off(2, 1);
    const int n = impacts_size(impacts);
    double fastest = 0;
    for (int i = 0; i < n; i++) {
        double own = impacts->W[i * n + i];
        if (own > 0) fastest = fmax(fastest, fabs(before[i]) / sqrt(own));
    }
    for (int i = 0; i < n; i++) {
        double own = sqrt(fmax(0, impacts->W[i * n + i]));
        for (int j = 0; j <= i; j++) {
            *chance = *chance * 1664525U + 1013904223U; /* Numerical Recipes, 7.1 */
            double by = *chance >> 31 ? rounding : -rounding;
            W[i * n + j] = impacts->W[i * n + j] + by * own * sqrt(fmax(0, impacts->W[j * n + j]));
            W[j * n + i] = W[i * n + j];
            if (j == i) off->v[i] = before[i] == 0 ? 0 : before[i] + by * own * fastest;
        }
    }
    memset(off->P, 0, (size_t)n * sizeof *off->P);
    off->W = W;
    off->work = 0;
}

/* Are velocities and works equal to a relative 1e-9? */
static bool is_same(const struct impacts *impacts, const struct impacts *off, const double *before)
{
    const int n = impacts_size(impacts);
    double energy = 0;
    bool same = true;
    for (int i = 0; i < n; i++) {
        double own = impacts->W[i * n + i];
        double v = fmax(fabs(before[i]), fabs(impacts->v[i]));
        if (own > 0) energy = fmax(energy, v * v / own);
    }
    for (int i = 0; i < n; i++) {
        double own = fmax(0, impacts->W[i * n + i]);
        same &= fabs(impacts->v[i] - off->v[i]) <= undecided_part * sqrt(energy * own);
    }
    return same && fabs(impacts->work - off->work) <= undecided_part * energy;
}

/* For impulses far larger than each point alone would need, so that rounding affects their sums. They arise
 * from laws that contradict each other - three points of one body cannot all satisfy `newton` - or from
 * nearly collinear normals. The accuracy of the solution is tested by solving again with W and initial
 * velocities perturbed by rounding. */
static enum impacts_end stays_when_off(const struct impacts *impacts, const double *before, bool propagates)
{
    enum { tries = 3 };
    const size_t n = (size_t)impacts_size(impacts);
    double *room = calloc(n * n + 2 * n + 1, sizeof *room);
    unsigned chance = 1;
    enum impacts_end end = room ? impacts_done : impacts_no_memory;
    for (int k = 0; k < tries && end == impacts_done; k++) {
        struct impacts off = *impacts;
        off.v = room + n * n;
        off.P = off.v + n;
        set_off(impacts, before, &off, room, &chance);
        end = find_by(&off, propagates);
        if (end == impacts_done && !is_same(impacts, &off, before)) end = impacts_lost;
    }
    free(room);
    return end == impacts_done || end == impacts_no_memory ? end : impacts_lost;
}

static enum impacts_end solve_by(struct impacts *impacts, const double *before, bool propagates)
{
    enum impacts_end end = find_by(impacts, propagates);
    if (end != impacts_done) return end;
    enum doing doing = do_what_they_say(impacts, before);
    if (doing == does_not) return impacts_lost;
    return doing == does_to_digits ? impacts_done : stays_when_off(impacts, before, propagates);
}

/* The law of the fastest point, of those with restitution if there are any. */
static enum impact_law law_of_fastest(const struct impacts *impacts)
{
    const struct impacts_point *points = impacts->points;
    const double *v = impacts->v;
    int best = 0;
    for (int i = 1; i < impacts->count; i++) {
        bool bounces = points[i].e > 0, as_well = bounces == (points[best].e > 0);
        if (as_well ? v[(ptrdiff_t)2 * i] < v[(ptrdiff_t)2 * best] : bounces) best = i;
    }
    return points[best].law;
}

/* `before` contains the initial velocities, too. */
static enum impacts_end solve_whole(struct impacts *impacts, const double *before)
{
    impacts->law = law_of_fastest(impacts);
    if (impacts->slides > 0) return solve_by(impacts, before, false);
    if (impacts->count == 1) return strike(impacts, 0) < 0 ? impacts_jammed : impacts_done;
    enum impacts_end end = solve_by(impacts, before, impacts->propagate);
    /* With nearly collinear normals sequential impacts satisfy the same laws, and may exist where no
     * simultaneous solution is found. */
    bool has_found = end == impacts_done || end == impacts_no_memory;
    if (has_found || impacts->propagate || impact_by_velocity(impacts->law)) return end;
    take_back(impacts, before);
    end = solve_by(impacts, before, true);
    impacts->in_turn = true;
    return end == impacts_done || end == impacts_no_memory ? end : impacts_lost;
}

/* Memory for the solution in parts: one block. */
struct room {
    struct impacts_point *points;
    double *numbers;
    int *part, *member; /* of each point; of a part */
};

static bool room_init(struct room *room, size_t count)
{
    size_t n = 2 * count, numbers = n * n + 3 * n;
    room->points =
        block_alloc(count * sizeof *room->points + numbers * sizeof(double) + 2 * count * sizeof(int));
    if (!room->points) return false;
    room->numbers = (double *)(room->points + count);
    void *behind = room->numbers + numbers;
    room->part = behind;
    room->member = room->part + count;
    return true;
}

/* Solve the part of the points `member`; unchanged if no point of it closes. */
static enum impacts_end solve_part(struct impacts *all, const int *member, int count, struct room *room)
{
    int n = 2 * count, of = 2 * all->count;
    double *W = room->numbers, *v = W + (size_t)n * (size_t)n, *P = v + n, *before = P + n;
    struct impacts_point *points = room->points;
    bool closes = false;
    for (int i = 0; i < n; i++) {
        int row = 2 * member[i / 2] + i % 2;
        for (int j = 0; j < n; j++) W[i * n + j] = all->W[row * of + 2 * member[j / 2] + j % 2];
        before[i] = v[i] = all->v[row];
        P[i] = 0;
        points[i / 2] = all->points[member[i / 2]];
        closes |= i % 2 == 0 && v[i] < 0;
    }
    struct impacts part = *all;
    part.count = count;
    part.points = points;
    part.W = W;
    part.v = v;
    part.P = P;
    part.work = 0;
    part.in_turn = part.several = false;
    enum impacts_end end = closes ? solve_whole(&part, before) : impacts_done;
    for (int i = 0; i < n; i++) {
        all->v[2 * member[i / 2] + i % 2] = v[i];
        all->P[2 * member[i / 2] + i % 2] = P[i];
    }
    all->work += part.work;
    if (closes) all->law = part.law;
    all->in_turn |= part.in_turn;
    all->several |= part.several;
    return end;
}

/* Slides may load each other's guides: the problem is not divided into parts. */
static enum impacts_end solve_with_slides(struct impacts *impacts)
{
    size_t n = (size_t)impacts_size(impacts);
    double *before = calloc(n, sizeof *before);
    if (!before) return impacts_no_memory;
    memcpy(before, impacts->v, n * sizeof *before);
    memset(impacts->P, 0, n * sizeof *impacts->P);
    enum impacts_end end = solve_whole(impacts, before);
    free(before);
    return end;
}

enum impacts_end impacts_solve(struct impacts *impacts)
{
    impacts->work = 0;
    impacts->in_turn = impacts->several = false;
    if (impacts->slides > 0) return solve_with_slides(impacts);
    struct room room;
    memset(impacts->P, 0, 2 * (size_t)impacts->count * sizeof *impacts->P);
    if (!room_init(&room, (size_t)impacts->count)) return impacts_no_memory;
    enum impacts_end end = impacts_done;
    int parts = parts_find(impacts->count, feel_each_other, impacts, room.part);
    for (int p = 0; p < parts && end == impacts_done; p++) {
        int members = 0;
        for (int i = 0; i < impacts->count; i++)
            if (room.part[i] == p) room.member[members++] = i;
        end = solve_part(impacts, room.member, members, &room);
    }
    free(room.points);
    return end;
}
