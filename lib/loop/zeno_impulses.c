/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The impulses of the impacts beyond the cut of a series, compared with those of rest (loop/zeno.h).
 */
#include <stdlib.h>
#include <string.h>

#include "dynamics/tree_system.h"
#include "loop/contacts.h"
#include "loop/run.h"
#include "numeric/qr.h"
#include "numeric/tolerances.h"

/* Sticks without a limit; slips; stops, or remains at rest; or slips whatever the impulses do. */
enum fate { sticks, slips, stops, slips_on };

/* Lines of the system: normal and tangent of each impact constraint, then the slides. */
struct remainder {
    struct run *run;
    int count, all;
    double *A; /* all x all */
    double *b, *P;
    double slow;     /* the speed that rest takes from a body in the time of the series */
    enum fate *fate; /* of each line along a surface or a guide */
};

static bool remainder_new(struct remainder *remainder, struct run *run, int count, double slow)
{
    const int all = 2 * count + run->contacts.slide_count;
    const size_t size = (size_t)all;
    *remainder = (struct remainder){.run = run, .count = count, .all = all, .slow = slow};
    remainder->A = calloc(size * (size + 2) + 1, sizeof(double));
    remainder->fate = calloc(size + 1, sizeof *remainder->fate);
    if (!remainder->A || !remainder->fate) return false;
    remainder->b = remainder->A + size * size;
    remainder->P = remainder->b + size;
    return true;
}

static void remainder_free(struct remainder *remainder)
{
    free(remainder->A);
    free(remainder->fate);
}

static const struct coupling *coupling_of(const struct remainder *remainder, int i)
{
    return &remainder->run->model->tree->couplings[remainder->run->contacts.strikers[i].coupling];
}

static bool is_normal(const struct remainder *remainder, int line)
{
    return line < 2 * remainder->count && line % 2 == 0;
}

/* Does the velocity along a surface or a guide end at zero? */
static bool is_held(const struct remainder *remainder, int line)
{
    return remainder->fate[line] == sticks || remainder->fate[line] == stops;
}

/* Does constraint i stay closed? */
static bool rests(const struct remainder *remainder, int i)
{
    const struct contacts_work *work = &remainder->run->contacts;
    return work->strikers[i].stays || !(work->v[(ptrdiff_t)2 * i] > 0);
}

/* The unit of the impulse of a line: that which changes its velocity by one. */
static double unit_of(const struct remainder *remainder, int line)
{
    const double own = remainder->run->contacts.W[(ptrdiff_t)line * (remainder->all + 1)];
    return own > 0 ? 1 / sqrt(own) : 1;
}

/* The velocity of the line ends at zero: W P = -v. */
static void give_velocity(struct remainder *remainder, int line)
{
    const struct contacts_work *work = &remainder->run->contacts;
    const int all = remainder->all;
    const double unit = unit_of(remainder, line);
    for (int k = 0; k < all; k++)
        remainder->A[line * all + k] = unit * work->W[line * all + k] * unit_of(remainder, k);
    remainder->b[line] = -unit * work->v[line];
}

/* The impulse of the line is `share` times that of line `of`. */
static void give_impulse(struct remainder *remainder, int line, int of, double share)
{
    double *row = remainder->A + (ptrdiff_t)line * remainder->all;
    row[line] += 1;
    row[of] -= share * unit_of(remainder, of) / unit_of(remainder, line);
}

static double against(double v)
{
    return v > 0 ? -1 : v < 0 ? 1 : 0;
}

/* The tangential line of impact constraint i. */
static void set_tangent(struct remainder *remainder, int i)
{
    const struct contacts_work *work = &remainder->run->contacts;
    const struct impacts_point *point = &work->points[i];
    const int line = 2 * i + 1;
    if (!work->strikers[i].rubs || point->mu == 0)
        give_impulse(remainder, line, 2 * i, 0);
    else if (point->slips)
        give_impulse(remainder, line, 2 * i, -point->slips * point->mu);
    else if (is_held(remainder, line))
        give_velocity(remainder, line);
    else
        give_impulse(remainder, line, 2 * i, against(work->v[line]) * point->mu);
}

/* A slide: the impulses of all lines load its guide, whose side is that of the last load. */
static void set_slide(struct remainder *remainder, int k)
{
    const struct contacts_work *work = &remainder->run->contacts;
    const int line = 2 * remainder->count + k, all = remainder->all;
    const double share =
        against(work->v[line]) * work->slide[k].mu * remainder->run->state->pull[work->slides[k]];
    if (is_held(remainder, line)) {
        give_velocity(remainder, line);
        return;
    }
    give_impulse(remainder, line, line, 0);
    for (int j = 0; j < all; j++)
        remainder->A[line * all + j] -=
            share * work->B[k * all + j] * unit_of(remainder, j) / unit_of(remainder, line);
}

static bool solve(struct remainder *remainder)
{
    const size_t all = (size_t)remainder->all;
    struct qr qr = {0};
    memset(remainder->A, 0, all * (all + 2) * sizeof(double));
    for (int i = 0; i < remainder->count; i++) {
        if (rests(remainder, i))
            give_velocity(remainder, 2 * i);
        else
            give_impulse(remainder, 2 * i, 2 * i, 0);
        set_tangent(remainder, i);
    }
    for (int k = 0; k < remainder->run->contacts.slide_count; k++) set_slide(remainder, k);
    const bool done = qr_decompose(&qr, all, all, remainder->A, singular_value_zero);
    if (done) qr_add_solution(&qr, remainder->b, remainder->P);
    qr_free(&qr);
    for (int k = 0; k < remainder->all; k++) remainder->P[k] *= unit_of(remainder, k);
    return done;
}

static double velocity_after(const struct remainder *remainder, int line)
{
    const struct contacts_work *work = &remainder->run->contacts;
    double v = work->v[line];
    for (int k = 0; k < remainder->all; k++) v += work->W[line * remainder->all + k] * remainder->P[k];
    return v;
}

static double response_of(const struct remainder *remainder, int line)
{
    return remainder->run->contacts.W[(ptrdiff_t)line * (remainder->all + 1)];
}

/* Is the impulse along a surface or a guide more than its friction can be? That of rest is about N T = slow/W; bodies that
 * lean on each other, or a body that jams, would need far more. */
static bool exceeds_limit(const struct remainder *remainder, int line)
{
    const struct contacts_work *work = &remainder->run->contacts;
    const double many = 64;
    const int slide = line - 2 * remainder->count;
    const double P = fabs(remainder->P[line]), rest = many * remainder->slow / response_of(remainder, line);
    double load = 0;
    if (slide < 0) return P > work->points[line / 2].mu * fabs(remainder->P[line - 1]) + rest;
    for (int k = 0; k < remainder->all; k++) load += work->B[slide * remainder->all + k] * remainder->P[k];
    return P > work->slide[slide].mu * fabs(load) + rest;
}

/* Slips that the impulses would reverse stop; those that friction cannot stop slip on, whatever their direction: the
 * friction of rest ends them in a time of the order of T. True when a line has changed: twice at most. */
static bool stop_slips(struct remainder *remainder)
{
    const double *v = remainder->run->contacts.v, hardly = 1e-3;
    bool any = false;
    for (int line = 0; line < remainder->all; line++) {
        if (is_normal(remainder, line)) continue;
        enum fate *fate = &remainder->fate[line];
        const enum fate before = *fate;
        const double after = velocity_after(remainder, line);
        if (before == slips && (after * v[line] < 0 || fabs(after) <= hardly * remainder->slow))
            *fate = stops;
        if (before == stops && exceeds_limit(remainder, line)) *fate = slips_on;
        any |= *fate != before;
    }
    return any;
}

/* The tangent of a point without friction, or that no impulse moves, slips on. */
static enum fate fate_of(const struct remainder *remainder, int line)
{
    const struct contacts_work *work = &remainder->run->contacts;
    const bool slide = line >= 2 * remainder->count;
    const struct impacts_point *point = slide ? NULL : &work->points[line / 2];
    const int pair =
        slide ? work->slides[line - 2 * remainder->count] : coupling_of(remainder, line / 2)->pair;
    if (point && (point->mu == 0 || point->slips)) return slips_on;
    if (pair < 0) return sticks;
    return work->v[line] == 0 || remainder->run->state->slip[pair] == stick ? stops : slips;
}

/* The velocities after, exactly zero where a line stops, and the impulses. */
static void keep(const struct remainder *remainder)
{
    struct contacts_work *work = &remainder->run->contacts;
    double *after = remainder->b;
    for (int line = 0; line < remainder->all; line++) {
        const bool zero = is_normal(remainder, line) ? rests(remainder, line / 2) : is_held(remainder, line);
        after[line] = zero ? 0 : velocity_after(remainder, line);
    }
    memcpy(work->v, after, (size_t)remainder->all * sizeof *after);
    memcpy(work->P, remainder->P, (size_t)remainder->all * sizeof *after);
}

/* Points that stop stick from here on, and those that slip on do so whether they stuck before or not: a projection of the
 * velocities would else stop them without an impulse. */
static void set_slips(const struct remainder *remainder)
{
    struct run *run = remainder->run;
    for (int i = 0; i < remainder->count; i++) {
        const struct coupling *coupling = coupling_of(remainder, i);
        const int line = 2 * i + 1, pair = coupling->pair;
        if (coupling->meeting < 0 || pair < 0) continue;
        const double v_t = run->contacts.v[line];
        int *slip = &run->state->slip[pair];
        if (!is_held(remainder, line)) {
            if (*slip == stick && v_t != 0) *slip = v_t > 0 ? slip_plus : slip_minus;
        } else if (*slip != stick) {
            coupling_rezero(run->model, run->state->tree, (int)(coupling - run->model->tree->couplings));
            *slip = stick;
        }
    }
}

void zeno_apply_remaining(struct run *run, int count, double slow)
{
    struct remainder remainder;
    bool done = remainder_new(&remainder, run, count, slow);
    for (int line = 0; done && line < remainder.all; line++)
        if (!is_normal(&remainder, line)) remainder.fate[line] = fate_of(&remainder, line);
    do done = done && solve(&remainder);
    while (done && stop_slips(&remainder));
    if (done) {
        keep(&remainder);
        contacts_apply_impulses(run, count);
        set_slips(&remainder);
        for (int i = 0; i < count; i++) {
            const ptrdiff_t line = (ptrdiff_t)2 * i;
            run->impact_work[coupling_of(&remainder, i)->load] +=
                striker_taken(&run->contacts.strikers[i], run->contacts.v + line, run->contacts.P + line);
        }
    } else {
        run_fail(run, FBD_OUT_OF_MEMORY, "out of memory");
    }
    remainder_free(&remainder);
}
