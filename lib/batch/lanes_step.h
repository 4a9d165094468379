/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The text of a function of lanes.h, to be included once by a file that says what it is called, `LANES_GO`, and how many
 * lanes it has, `LANES`.
 *
 * A comparison of vectors has all bits set where it holds, and none where it does not.
 */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/sine.h"
#include "batch/lanes.h"
#include "integrate/nystrom_sums.h"

typedef double wide __attribute__((vector_size(LANES * sizeof(double))));
typedef long long mask __attribute__((vector_size(LANES * sizeof(long long))));

#define INLINE static inline __attribute__((always_inline))

/* ---- vectors */

INLINE wide load(const double *from)
{
    wide x;
    memcpy(&x, from, sizeof x);
    return x;
}

INLINE void store(double *to, wide x)
{
    memcpy(to, &x, sizeof x);
}

INLINE wide select(mask which, wide a, wide b)
{
    return (wide)((which & (mask)a) | (~which & (mask)b));
}

INLINE wide larger_of(wide a, wide b)
{
    return select(a > b, a, b);
}

INLINE wide smaller_of(wide a, wide b)
{
    return select(a < b, a, b);
}

INLINE wide size_of(wide x)
{
    return (wide)((mask)x & 0x7fffffffffffffff);
}

INLINE wide root_of(wide x)
{
    double numbers[LANES];
    store(numbers, x);
    for (int i = 0; i < LANES; i++) numbers[i] = sqrt(numbers[i]);
    return load(numbers);
}

/* One bit for each lane. */
INLINE unsigned bits_of(mask which)
{
    unsigned bits = 0;
    for (int i = 0; i < LANES; i++) bits |= (unsigned)(which[i] & 1) << i;
    return bits;
}

INLINE mask mask_of(unsigned bits)
{
    mask which = {0};
    for (int i = 0; i < LANES; i++) which[i] = -(long long)(bits >> i & 1);
    return which;
}

INLINE wide sine_of(wide x)
{
    wide shifted, y0, y1, of_even, of_odd;
    SINE_REDUCE(wide, x, shifted, y0, y1);
    const wide z = y0 * y0;
    SINE_OF_REST(wide, y0, y1, z, of_even);
    COSINE_OF_REST(wide, y0, y1, z, of_odd);
    const mask quarter = (mask)shifted;
    return (wide)((mask)select(-(quarter & 1), of_odd, of_even) ^ (quarter & 2) << 62);
}

/* ---- a step */

struct system {
    wide inverse, s, kv;
};

INLINE wide rate(const struct system *system, wide q, wide v)
{
    return system->inverse * (system->s * sine_of(q) - system->kv * v);
}

/* What a step of size h comes to, and its errors. */
struct attempt {
    wide q, v, a, error_q, error_v;
    mask beyond; /* a sine was asked for of more than SINE_MOST */
};

#define A(i, j) (nystrom_a[i][j] * k[j])
#define STAGE(i, sum)                                                                                        \
    {                                                                                                        \
        const wide at = q + (nystrom_c[i] * h * v + h * h * (sum));                                          \
        beyond |= ~(size_of(at) <= SINE_MOST);                                                               \
        k[i] = rate(system, at, v);                                                                          \
    }

INLINE struct attempt try_step(const struct system *system, wide h, wide q, wide v, wide a)
{
    wide k[nystrom_stages + 1];
    mask beyond = {0};
    k[1] = a;
    NYSTROM_STAGES_2_TO_9(STAGE, A)
    NYSTROM_STAGES_10_TO_14(STAGE, A)
    NYSTROM_STAGES_15_TO_17(STAGE, A)
    const wide b = NYSTROM_SUM(nystrom_b, k), d = NYSTROM_SUM(nystrom_d, k);
    struct attempt end = {.q = q + (h * v + h * h * b),
                          .v = v + h * d,
                          .error_q = h * h * (b - NYSTROM_SUM(nystrom_b_low, k)),
                          .error_v = h * (d - NYSTROM_SUM(nystrom_d_low, k))};
    end.beyond = beyond | ~(size_of(end.q) <= SINE_MOST);
    end.a = rate(system, end.q, end.v);
    return end;
}

#undef A
#undef STAGE

/* ---- its error (weights.c) */

struct measure {
    wide tolerance, cap, noise, floor, scale_q, scale_v;
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

INLINE wide scale_of_rate(const struct measure *m, wide scale, wide swing)
{
    return smaller_of(scale, larger_of(swing, larger_of(m->floor, 1e-3 * scale)));
}

INLINE wide amplitude_of(wide q0, wide v0, wide a0, const struct attempt *end)
{
    const wide fast = larger_of(size_of(end->v), size_of(v0)), mean = (a0 + end->a) / 2;
    const wide square = fast * fast + mean * mean * size_of((end->q - q0) / (end->a - a0));
    return select(square >= 0, root_of(square), (wide){0} + INFINITY);
}

INLINE wide ratio_of(const struct measure *m, wide h, const struct attempt *end, wide swing)
{
    const wide q = end->q, v = end->v, a = end->a, zero = {0};
    const wide q_motion = size_of(h * v) + size_of(h * h * a), v_motion = size_of(h * a);
    const wide noise_v = m->noise * size_of(h), noise_q = noise_v * size_of(h);
    const wide scale_q = smaller_of(scale_or_motion(m->scale_q, q, q_motion), m->cap);
    const wide scale_v = scale_of_rate(m, scale_or_motion(m->scale_v, v, v_motion), swing);
    const wide hidden =
        larger_of(DBL_EPSILON * smaller_of(size_of(q), m->cap) / size_of(h), 4 * m->noise * size_of(h));
    const wide level_q = level_of(m->tolerance, scale_q, q, q_motion, 4 * noise_q),
               level_v = level_of(m->tolerance, scale_v, v, v_motion, hidden);
    const wide error_q = size_of(end->error_q), error_v = size_of(end->error_v);
    const wide by_q = select(error_q > noise_q, larger_of(zero, error_q / level_q), zero);
    return select(error_v > noise_v, larger_of(by_q, error_v / level_v), by_q);
}

/* The next step over this one, for an estimate of order 11. */
INLINE wide factor_of(wide ratio)
{
    const double safety = 0.7, shrink = 0.333, grow = 6;
    const wide sixteenth = root_of(root_of(root_of(root_of(ratio))));
    const wide factor = safety / (sixteenth * root_of(sixteenth)), one = (wide){0} + 1;
    const wide least = (wide){0} + shrink, most = (wide){0} + grow;
    return select(ratio == 0, most, select(ratio > one, larger_of(factor, least), smaller_of(factor, most)));
}

INLINE mask is_finite(const struct attempt *end)
{
    return 0 * (end->q + end->v + end->a + end->error_q + end->error_v) == 0;
}

/* ---- what the lanes have come to */

struct standing {
    struct measure m;
    wide t, h, tried, q, v, a, q0, v0, a0, most_q, most_v, since, left, growth, attempts, accepted, rejected;
};

INLINE struct standing load_all(const struct lanes *lanes)
{
    return (struct standing){
        .m = {load(lanes->tolerance), load(lanes->cap), load(lanes->noise), load(lanes->floor),
              load(lanes->scale_q), load(lanes->scale_v)},
        .t = load(lanes->t),
        .h = load(lanes->h),
        .tried = load(lanes->tried),
        .q = load(lanes->q),
        .v = load(lanes->v),
        .a = load(lanes->a),
        .q0 = load(lanes->q0),
        .v0 = load(lanes->v0),
        .a0 = load(lanes->a0),
        .most_q = load(lanes->most_q),
        .most_v = load(lanes->most_v),
        .since = load(lanes->since),
        .left = load(lanes->steps_left),
        .growth = load(lanes->growth),
        .attempts = load(lanes->attempts),
        .accepted = load(lanes->accepted),
        .rejected = load(lanes->rejected),
    };
}

INLINE void store_all(struct lanes *lanes, const struct standing *s)
{
    store(lanes->scale_q, s->m.scale_q);
    store(lanes->scale_v, s->m.scale_v);
    store(lanes->t, s->t);
    store(lanes->h, s->h);
    store(lanes->tried, s->tried);
    store(lanes->q, s->q);
    store(lanes->v, s->v);
    store(lanes->a, s->a);
    store(lanes->q0, s->q0);
    store(lanes->v0, s->v0);
    store(lanes->a0, s->a0);
    store(lanes->most_q, s->most_q);
    store(lanes->most_v, s->most_v);
    store(lanes->since, s->since);
    store(lanes->steps_left, s->left);
    store(lanes->growth, s->growth);
    store(lanes->attempts, s->attempts);
    store(lanes->accepted, s->accepted);
    store(lanes->rejected, s->rejected);
}

/* ---- one attempt of all lanes */

/* The size that it has (stepper.c, plan_step). */
struct size {
    mask half, ready; /* half of the way to the end of the run; nothing but a step is due */
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

/* The step ends in lanes `taken`, where `proposed` is the next one. */
INLINE void accept(struct standing *s, mask taken, const struct attempt *end, wide t1, wide proposed,
                   wide factor)
{
    s->accepted = select(taken, s->accepted + 1, s->accepted);
    s->rejected = select(taken, s->rejected + s->attempts, s->rejected);
    s->h = select(taken, proposed, s->h);
    s->growth = select(taken, factor, s->growth);
    s->most_q = select(taken, larger_of(s->most_q, size_of(s->q)), s->most_q);
    s->most_v = select(taken, larger_of(s->most_v, size_of(s->v)), s->most_v);
    s->m.scale_q = select(taken, larger_of(s->m.scale_q, size_of(end->q)), s->m.scale_q);
    s->m.scale_v = select(taken, larger_of(s->m.scale_v, size_of(end->v)), s->m.scale_v);
    s->q0 = select(taken, s->q, s->q0);
    s->v0 = select(taken, s->v, s->v0);
    s->a0 = select(taken, s->a, s->a0);
    s->q = select(taken, end->q, s->q);
    s->v = select(taken, end->v, s->v);
    s->a = select(taken, end->a, s->a);
    s->t = select(taken, t1, s->t);
    s->since = select(taken, s->since + 1, s->since);
    s->left = select(taken, s->left - 1, s->left);
}

/* Would rounding count in the step after this one (weights_noise_counts, run_renew_noise)? */
INLINE mask noise_counts(const struct standing *s, const struct attempt *end, wide pause, wide proposed,
                         wide swing)
{
    const struct measure *m = &s->m;
    const wide zero = {0}, scale = larger_of(m->scale_v, size_of(end->v)),
               allowed = 4 * m->noise * size_of(proposed);
    return (s->since + 1 >= pause) & (allowed > m->tolerance * scale_of_rate(m, scale, zero)) &
           (allowed > m->tolerance * scale_of_rate(m, scale, swing));
}

/* Those that have to do something else; what they have tried is forgotten when they are taken out. */
INLINE mask attempt(struct standing *s, const struct system *system, mask active, wide pause,
                    const struct size *size)
{
    const wide zero = {0}, one = zero + 1;
    const struct attempt end = try_step(system, size->step, s->q, s->v, s->a);
    const wide swing = amplitude_of(s->q, s->v, s->a, &end), ratio = ratio_of(&s->m, size->step, &end, swing),
               factor = factor_of(ratio);
    const wide next = size->step * select(s->attempts > 0, smaller_of(factor, one), factor),
               proposed = select(size->half, larger_of(next, s->tried), next);
    const mask odd = ~is_finite(&end) | ~(ratio < INFINITY) | end.beyond, passes = ratio <= 1,
               counts = noise_counts(s, &end, pause, proposed, swing),
               taken = active & passes & ~(odd | counts), again = active & ~(odd | passes);
    accept(s, taken, &end, size->t1, proposed, factor);
    s->attempts = select(taken, zero, select(again, s->attempts + 1, s->attempts));
    s->tried = select(taken, proposed, select(again, size->asked * factor, s->tried));
    return active & (odd | (passes & counts));
}

unsigned LANES_GO(struct lanes *lanes, unsigned active_bits)
{
    const wide until = load(lanes->until), pause = load(lanes->pause);
    const struct system system = {load(lanes->inverse), load(lanes->s), load(lanes->kv)};
    const mask active = mask_of(active_bits);
    struct standing s = load_all(lanes);
    unsigned stops = 0;
    while (!stops) {
        const struct size size = plan_size_of(&s, until);
        stops = bits_of(active & ~size.ready);
        if (!stops) stops = bits_of(attempt(&s, &system, active, pause, &size));
    }
    store_all(lanes, &s);
    return stops;
}
