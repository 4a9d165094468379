/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The functions of lanes.h, to be included once by a file that defines the name of their table,
 * `LANES_TABLE`, and the number of lanes, `LANES`. All arguments `kind` and `n` (the number of coordinates)
 * are compile-time constants after inlining.
 */
#ifndef FBD_BATCH_LANES_STEP_H
#define FBD_BATCH_LANES_STEP_H

#include "batch/lanes_vector.h"
#include "integrate/nystrom_sums.h"
#include "integrate/rk8pd_table.h"

#ifndef LANES_TABLE
#define LANES_TABLE lanes_by_two
#endif

/* ---- equations of motion */

struct system {
    wide constants[most_constants];
    mask beyond; /* lanes in which the argument of a sine exceeded SINE_MOST */
};

INLINE void note_beyond(struct system *system, wide angle)
{
    system->beyond |= ~(size_of(angle) <= SINE_MOST);
}

/* rates_row.c, scalar_row */
INLINE void swing(struct system *system, const wide *q, const wide *v, wide *a)
{
    const wide *c = system->constants;
    note_beyond(system, q[0]);
    a[0] = c[swing_inverse] * (0.0 - c[swing_kv] * v[0] + c[swing_s] * sine_of(q[0]));
}

INLINE struct unit turned(struct unit r, wide x, wide y)
{
    return (struct unit){r.x * x - r.y * y, r.y * x + r.x * y};
}

/* tree_bare.c, two_links */
INLINE void swing_double(struct system *system, const wide *q, const wide *v, wide *a)
{
    const wide *k = system->constants;
    const wide angle = k[first_along] + q[0], sum = angle + k[last_along] + q[1];
    note_beyond(system, angle);
    note_beyond(system, sum);
    const struct unit turn0 = unit_of(angle), turn1 = unit_of(sum);
    const struct unit d = turned(turn0, k[last_at_x], k[last_at_y]),
                      h = turned(turn1, k[last_moment_x], k[last_moment_y]);
    const wide C = d.x * h.x + d.y * h.y, X = d.x * h.y - d.y * h.x, D = k[last_D], w = v[0] + v[1];
    const wide u = D * (k[last_g] + (k[last_sine] * turn1.y + k[last_cosine] * turn1.x) - v[0] * v[0] * X);
    const wide moment = k[first_g] - k[last_g] + (k[first_sine] * turn0.y + k[first_cosine] * turn0.x) +
                        (d.x * k[last_force_y] - d.y * k[last_force_x]) + w * w * X;
    const wide J = k[first_I_O] +
                   k[last_across] * (k[last_at_x] * k[last_at_x] + k[last_at_y] * k[last_at_y]) + D * X * X;
    const wide alpha = (moment - C * u) / J;
    a[0] = alpha;
    a[1] = u - D * C * alpha - alpha;
}

INLINE void accelerate(enum lane_motion kind, struct system *system, const wide *q, const wide *v, wide *a)
{
    if (kind == swings_double)
        swing_double(system, q, v, a);
    else
        swing(system, q, v, a);
}

/* ---- the result of a step of size h from y = q, v, a */

struct attempt {
    wide y[3 * most_pairs], error[2 * most_pairs], rest[2 * most_pairs];
    wide dy[2 * most_pairs], da[most_pairs]; /* pair8_differences */
};

#define A(i, j) (nystrom_a[i][j] * k[j])
#define STAGE(i, sum)                                                                                        \
    {                                                                                                        \
        const wide at = q + (nystrom_c[i] * h * v + h * h * (sum));                                          \
        accelerate(kind, system, &at, &v, &k[i]);                                                            \
    }

/* For one coordinate. */
INLINE void try_nystrom(enum lane_motion kind, struct system *system, wide h, const wide *y,
                        struct attempt *end)
{
    const wide q = y[0], v = y[1];
    wide k[nystrom_stages + 1];
    k[1] = y[2];
    NYSTROM_STAGES_2_TO_9(STAGE, A)
    NYSTROM_STAGES_10_TO_14(STAGE, A)
    NYSTROM_STAGES_15_TO_17(STAGE, A)
    const wide b = NYSTROM_SUM(nystrom_b, k), d = NYSTROM_SUM(nystrom_d, k);
    end->y[0] = q + (h * v + h * h * b);
    end->y[1] = v + h * d;
    end->error[0] = h * h * (b - NYSTROM_SUM(nystrom_b_low, k));
    end->error[1] = h * (d - NYSTROM_SUM(nystrom_d_low, k));
    accelerate(kind, system, &end->y[0], &end->y[1], &end->y[2]);
}

#undef A
#undef STAGE

enum { stages = 13 };

/* The stages of one component. */
struct slopes {
    wide k[stages + 1];
};

/* The sum over the stages before `count`; terms with zero coefficients are skipped. */
INLINE wide sum_of(const double *row, const struct slopes *slopes, int count)
{
    const wide *k = slopes->k;
    wide sum = row[1] * k[1];
    if (count > 2 && row[2] != 0) sum += row[2] * k[2];
    if (count > 3 && row[3] != 0) sum += row[3] * k[3];
    if (count > 4 && row[4] != 0) sum += row[4] * k[4];
    if (count > 5 && row[5] != 0) sum += row[5] * k[5];
    if (count > 6 && row[6] != 0) sum += row[6] * k[6];
    if (count > 7 && row[7] != 0) sum += row[7] * k[7];
    if (count > 8 && row[8] != 0) sum += row[8] * k[8];
    if (count > 9 && row[9] != 0) sum += row[9] * k[9];
    if (count > 10 && row[10] != 0) sum += row[10] * k[10];
    if (count > 11 && row[11] != 0) sum += row[11] * k[11];
    if (count > 12 && row[12] != 0) sum += row[12] * k[12];
    if (count > 13 && row[13] != 0) sum += row[13] * k[13];
    return sum;
}

/* Stage i of all components; its argument is stored in `u`. */
INLINE void make_stage(enum lane_motion kind, int n, struct system *system, int i, wide h, const wide *y,
                       const wide *rest, struct slopes *slopes, wide *u)
{
    wide a[most_pairs];
    for (int c = 0; c < 2 * n; c++) u[c] = y[c] + (rest[c] + h * sum_of(rk8pd_a[i], &slopes[c], i));
    accelerate(kind, system, u, u + n, a);
    for (int c = 0; c < n; c++) {
        slopes[c].k[i] = u[n + c];
        slopes[n + c].k[i] = a[c];
    }
}

/* The rounding error a + b - sum, where `sum` is a + b rounded (pair8.c). */
INLINE wide lost_by(wide a, wide b, wide sum)
{
    const wide b_part = sum - a, a_part = sum - b_part;
    return (a - a_part) + (b - b_part);
}

INLINE void try_rk8pd(enum lane_motion kind, int n, struct system *system, wide h, const wide *y,
                      const wide *rest, struct attempt *end)
{
    struct slopes slopes[2 * most_pairs];
    wide u[2 * most_pairs];
    for (int c = 0; c < 2 * n; c++) slopes[c].k[1] = y[n + c];
    make_stage(kind, n, system, 2, h, y, rest, slopes, u);
    make_stage(kind, n, system, 3, h, y, rest, slopes, u);
    make_stage(kind, n, system, 4, h, y, rest, slopes, u);
    make_stage(kind, n, system, 5, h, y, rest, slopes, u);
    make_stage(kind, n, system, 6, h, y, rest, slopes, u);
    make_stage(kind, n, system, 7, h, y, rest, slopes, u);
    make_stage(kind, n, system, 8, h, y, rest, slopes, u);
    make_stage(kind, n, system, 9, h, y, rest, slopes, u);
    make_stage(kind, n, system, 10, h, y, rest, slopes, u);
    make_stage(kind, n, system, 11, h, y, rest, slopes, u);
    make_stage(kind, n, system, 12, h, y, rest, slopes, u);
    make_stage(kind, n, system, 13, h, y, rest, slopes, u);
    for (int c = 0; c < 2 * n; c++) {
        const wide rise = rest[c] + h * sum_of(rk8pd_a[14], &slopes[c], stages + 1);
        end->error[c] = h * sum_of(rk8pd_e7, &slopes[c], stages + 1);
        end->y[c] = y[c] + rise;
        end->rest[c] = lost_by(y[c], rise, end->y[c]);
        end->dy[c] = end->y[c] - u[c];
    }
    accelerate(kind, system, end->y, &end->y[n], &end->y[n + n]);
    for (int c = 0; c < n; c++) end->da[c] = end->y[2 * n + c] - slopes[n + c].k[stages];
}

/* ---- its error (error_norm.c) */

struct measure {
    wide tolerance, cap[most_pairs], noise[most_pairs], floor[most_pairs], scale[2 * most_pairs];
};

INLINE wide scale_or_motion(wide scale, wide y, wide motion)
{
    scale = larger_of(scale, size_of(y));
    return select(scale > 0, scale, motion);
}

INLINE wide level_of(wide tolerance, wide scale, wide y, wide motion, wide hidden)
{
    const wide moved = smaller_of(motion, scale + size_of(y));
    return larger_of(larger_of(tolerance * scale, DBL_EPSILON * (size_of(y) + moved)), hidden);
}

INLINE wide scale_of_rate(const struct measure *m, int i, wide scale, wide swing)
{
    return smaller_of(scale, larger_of(swing, larger_of(m->floor[i], 1e-3 * scale)));
}

INLINE wide amplitude_of(int n, int i, const wide *y0, const wide *y1)
{
    const wide q = y1[i], v = y1[n + i], a = y1[2 * n + i], a0 = y0[2 * n + i];
    const wide fast = larger_of(size_of(v), size_of(y0[n + i])), mean = (a0 + a) / 2;
    const wide square = fast * fast + mean * mean * size_of((q - y0[i]) / (a - a0));
    return select(square >= 0, larger_of(root_of(square), fast), (wide){0} + INFINITY);
}

/* For pair i of coordinate and rate. */
INLINE wide ratio_of_pair(int n, int i, const struct measure *m, wide h, const struct attempt *end,
                          wide swing, wide ratio)
{
    const wide q = end->y[i], v = end->y[n + i], a = end->y[2 * n + i];
    const wide q_motion = size_of(h * v) + size_of(h * h * a), v_motion = size_of(h * a);
    const wide noise_v = m->noise[i] * size_of(h), noise_q = noise_v * size_of(h);
    const wide scale_q = smaller_of(scale_or_motion(m->scale[i], q, q_motion), m->cap[i]);
    const wide scale_v = scale_of_rate(m, i, scale_or_motion(m->scale[n + i], v, v_motion), swing);
    const wide hidden =
        larger_of(DBL_EPSILON * smaller_of(size_of(q), m->cap[i]) / size_of(h), 4 * m->noise[i] * size_of(h));
    const wide level_q = level_of(m->tolerance, scale_q, q, q_motion, 4 * noise_q),
               level_v = level_of(m->tolerance, scale_v, v, v_motion, hidden);
    const wide error_q = size_of(end->error[i]), error_v = size_of(end->error[n + i]);
    const wide least = (wide){0} + DBL_MIN;
    const wide ratio_q = error_q / larger_of(level_q, least), ratio_v = error_v / larger_of(level_v, least);
    const wide by_q = select(error_q > noise_q, larger_of(ratio, ratio_q), ratio);
    return select(error_v > noise_v, larger_of(by_q, ratio_v), by_q);
}

/* The ratio of the next step to this one, for an error estimate of order 11 or 8. */
INLINE wide factor_of(enum lane_motion kind, wide ratio)
{
    const double safety = 0.7, shrink = 0.333, grow = 6;
    const wide eighth = root_of(root_of(root_of(ratio))), one = (wide){0} + 1;
    wide root = eighth;
    if (kind == swings) {
        const wide sixteenth = root_of(eighth);
        root = sixteenth * root_of(sixteenth);
    }
    const wide factor = safety / root, least = (wide){0} + shrink, most = (wide){0} + grow;
    return select(ratio == 0, most, select(ratio > one, larger_of(factor, least), smaller_of(factor, most)));
}

INLINE mask is_finite(int n, const struct attempt *end)
{
    wide probe = {0};
    for (int c = 0; c < 3 * n; c++) probe += 0 * end->y[c];
    for (int c = 0; c < 2 * n; c++) probe += 0 * end->error[c];
    return probe == 0;
}

/* The fastest rate estimated from the step (error_norm_rate). */
INLINE wide rate_of(int n, const struct measure *m, const struct attempt *end)
{
    const wide zero = {0};
    wide by_q = zero, by_v = zero, by_a = zero;
    for (int i = 0; i < n; i++) {
        const wide scale = larger_of(m->scale[n + i], size_of(end->y[n + i]));
        const mask counts = scale != 0;
        by_q = select(counts, by_q + size_of(end->dy[i]) / scale, by_q);
        by_v = select(counts, by_v + size_of(end->dy[n + i]) / scale, by_v);
        by_a = select(counts, by_a + larger_of(size_of(end->da[i]) - 8 * m->noise[i], zero) / scale, by_a);
    }
    const wide root = by_v + root_of(by_v * by_v + 4 * by_q * by_a);
    return select((by_a > 0) & (root > 0), 2 * by_a / root, zero);
}

/* ---- state of the lanes */

struct standing {
    struct measure m;
    wide y[3 * most_pairs], before[3 * most_pairs], rest[2 * most_pairs], most[2 * most_pairs];
    wide t, h, tried, rate, tried_rate, since, left, growth, attempts, accepted, rejected;
};

INLINE void load_each(int count, wide *to, const double *from)
{
    for (int c = 0; c < count; c++) to[c] = load(from + (size_t)c * most_lanes);
}

INLINE void store_each(int count, double *to, const wide *from)
{
    for (int c = 0; c < count; c++) store(to + (size_t)c * most_lanes, from[c]);
}

INLINE void load_all(int n, const struct lanes *lanes, struct standing *s)
{
    load_each(n, s->m.cap, lanes->cap[0]);
    load_each(n, s->m.noise, lanes->noise[0]);
    load_each(n, s->m.floor, lanes->floor[0]);
    load_each(2 * n, s->m.scale, lanes->scale[0]);
    load_each(3 * n, s->y, lanes->y[0]);
    load_each(3 * n, s->before, lanes->before[0]);
    load_each(2 * n, s->rest, lanes->rest[0]);
    load_each(2 * n, s->most, lanes->most[0]);
    s->m.tolerance = load(lanes->tolerance);
    s->t = load(lanes->t);
    s->h = load(lanes->h);
    s->tried = load(lanes->tried);
    s->rate = load(lanes->rate);
    s->tried_rate = load(lanes->tried_rate);
    s->since = load(lanes->since);
    s->left = load(lanes->steps_left);
    s->growth = load(lanes->growth);
    s->attempts = load(lanes->attempts);
    s->accepted = load(lanes->accepted);
    s->rejected = load(lanes->rejected);
}

INLINE void store_all(int n, struct lanes *lanes, const struct standing *s)
{
    store_each(2 * n, lanes->scale[0], s->m.scale);
    store_each(3 * n, lanes->y[0], s->y);
    store_each(3 * n, lanes->before[0], s->before);
    store_each(2 * n, lanes->rest[0], s->rest);
    store_each(2 * n, lanes->most[0], s->most);
    store(lanes->t, s->t);
    store(lanes->h, s->h);
    store(lanes->tried, s->tried);
    store(lanes->rate, s->rate);
    store(lanes->tried_rate, s->tried_rate);
    store(lanes->since, s->since);
    store(lanes->steps_left, s->left);
    store(lanes->growth, s->growth);
    store(lanes->attempts, s->attempts);
    store(lanes->accepted, s->accepted);
    store(lanes->rejected, s->rejected);
}

/* ---- one attempt of all lanes */

/* The size of an attempt (stepper.c, plan_step). */
struct size {
    mask half, ready; /* half of the remaining run; ready for an ordinary step */
    wide asked, step, t1;
};

INLINE struct size plan_size_of(const struct standing *s, wide until)
{
    const wide room = until - s->t;
    struct size size = {.half = 2 * s->tried > room};
    size.asked = select(size.half, room / 2, s->tried);
    size.t1 = s->t + size.asked;
    size.step = size.t1 - s->t;
    size.ready = (1.01 * s->tried < room) & (room > 64 * DBL_EPSILON * size_of(s->t)) &
                 (size.step > 8 * DBL_EPSILON * size_of(size.t1)) & (size.step > 1e-30 * room) &
                 (s->left > 0);
    return size;
}

/* The assessment of an attempt. */
struct verdict {
    mask odd, passes; /* to be left to the run; accepted */
    wide factor, rate;
};

INLINE struct verdict judge(enum lane_motion kind, int n, const struct standing *s, wide h,
                            const struct attempt *end, const wide *swings_of)
{
    wide ratio = {0};
    for (int i = 0; i < n; i++) ratio = ratio_of_pair(n, i, &s->m, h, end, swings_of[i], ratio);
    struct verdict verdict = {.passes = ratio <= 1, .factor = factor_of(kind, ratio), .rate = s->tried_rate};
    verdict.odd = ~is_finite(n, end) | ~(ratio < INFINITY);
    if (kind == swings) return verdict;
    /* stepper.c, keep_stable */
    const wide goal = (wide){0} + 4, kept = 0.9 * s->tried_rate, seen = rate_of(n, &s->m, end),
               rate = larger_of(seen, kept), h_rate = h * rate;
    const mask fast = verdict.passes & (h_rate > 5);
    verdict.rate = select(verdict.passes, rate, s->tried_rate);
    verdict.factor =
        select(verdict.passes & ~fast & (h_rate * verdict.factor > goal), goal / h_rate, verdict.factor);
    verdict.factor = select(fast, larger_of(goal / h_rate, (wide){0} + 0.1), verdict.factor);
    verdict.passes &= ~fast;
    return verdict;
}

/* True if rounding would be significant in the next step (error_norm_roundoff_counts, roundoff_renew). */
INLINE mask noise_counts(int n, const struct standing *s, const struct attempt *end, wide pause,
                         wide proposed, const wide *swings_of)
{
    const struct measure *m = &s->m;
    const wide zero = {0};
    mask counts = {0};
    for (int i = 0; i < n; i++) {
        const wide scale = larger_of(m->scale[n + i], size_of(end->y[n + i])),
                   allowed = 4 * m->noise[i] * size_of(proposed);
        counts |= (allowed > m->tolerance * scale_of_rate(m, i, scale, zero)) &
                  (allowed > m->tolerance * scale_of_rate(m, i, scale, swings_of[i]));
    }
    return counts & (s->since + 1 >= pause);
}

/* Complete the step in lanes `taken`; `proposed` is the size of the next one. */
INLINE void accept(int n, struct standing *s, mask taken, const struct attempt *end, wide t1, wide proposed,
                   wide factor)
{
    s->accepted = select(taken, s->accepted + 1, s->accepted);
    s->rejected = select(taken, s->rejected + s->attempts, s->rejected);
    s->h = select(taken, proposed, s->h);
    s->growth = select(taken, factor, s->growth);
    for (int c = 0; c < 2 * n; c++) {
        s->most[c] = select(taken, larger_of(s->most[c], size_of(s->y[c])), s->most[c]);
        s->m.scale[c] = select(taken, larger_of(s->m.scale[c], size_of(end->y[c])), s->m.scale[c]);
    }
    for (int c = 0; c < 3 * n; c++) {
        s->before[c] = select(taken, s->y[c], s->before[c]);
        s->y[c] = select(taken, end->y[c], s->y[c]);
    }
    s->t = select(taken, t1, s->t);
    s->since = select(taken, s->since + 1, s->since);
    s->left = select(taken, s->left - 1, s->left);
}

/* Make one attempt. Returns the lanes that need something else; their attempts are discarded when they are
 * taken out. */
INLINE mask attempt(enum lane_motion kind, int n, struct standing *s, struct system *system, mask active,
                    wide pause, const struct size *size)
{
    const wide zero = {0}, one = zero + 1;
    struct attempt end;
    wide swings_of[most_pairs];
    system->beyond = (mask){0};
    if (kind == swings)
        try_nystrom(kind, system, size->step, s->y, &end);
    else
        try_rk8pd(kind, n, system, size->step, s->y, s->rest, &end);
    for (int i = 0; i < n; i++) swings_of[i] = amplitude_of(n, i, s->y, end.y);
    struct verdict verdict = judge(kind, n, s, size->step, &end, swings_of);
    verdict.odd |= system->beyond;
    const wide next = size->step * select(s->attempts > 0, smaller_of(verdict.factor, one), verdict.factor),
               proposed = select(size->half, larger_of(next, s->tried), next);
    const mask counts = noise_counts(n, s, &end, pause, proposed, swings_of),
               taken = active & verdict.passes & ~(verdict.odd | counts),
               again = active & ~(verdict.odd | verdict.passes);
    accept(n, s, taken, &end, size->t1, proposed, verdict.factor);
    if (kind != swings) {
        for (int c = 0; c < 2 * n; c++) s->rest[c] = select(taken, end.rest[c], s->rest[c]);
        s->tried_rate = select(taken | again, verdict.rate, s->tried_rate);
        s->rate = select(taken, verdict.rate, s->rate);
    }
    s->attempts = select(taken, zero, select(again, s->attempts + 1, s->attempts));
    s->tried = select(taken, proposed, select(again, size->asked * verdict.factor, s->tried));
    return active & (verdict.odd | (verdict.passes & counts));
}

INLINE unsigned go(enum lane_motion kind, int n, struct lanes *lanes, unsigned active_bits)
{
    const wide until = load(lanes->until), pause = load(lanes->pause);
    const mask active = mask_of(active_bits);
    struct system system;
    struct standing s;
    load_each(most_constants, system.constants, lanes->constants[0]);
    load_all(n, lanes, &s);
    unsigned stops = 0;
    while (!stops) {
        const struct size size = plan_size_of(&s, until);
        stops = bits_of(active & ~size.ready);
        if (!stops) stops = bits_of(attempt(kind, n, &s, &system, active, pause, &size));
    }
    store_all(n, lanes, &s);
    return stops;
}

static unsigned go_swinging(struct lanes *lanes, unsigned active)
{
    return go(swings, 1, lanes, active);
}

static unsigned go_damped(struct lanes *lanes, unsigned active)
{
    return go(swings_damped, 1, lanes, active);
}

static unsigned go_double(struct lanes *lanes, unsigned active)
{
    return go(swings_double, 2, lanes, active);
}

lanes_function *const LANES_TABLE[motions] = {
    [swings] = go_swinging, [swings_damped] = go_damped, [swings_double] = go_double};

#endif
