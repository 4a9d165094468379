/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A piece is mapped to s in [-1, 1] and sampled at the extremes of the Chebyshev polynomial T_d, which gives
 * the series sum c_j T_j(s) (L. N. Trefethen, Approximation Theory and Approximation Practice, SIAM 2013,
 * chapters 3 and 4), rewritten in powers of s. Over a stretch around s0 of half width r the polynomial is
 * shifted to s0 by Horner's scheme, p(s0 + r x) = sum b_k (r x)^k, and with |x| <= 1
 *
 *     |p - b_0 - b_1 r x| <= sum_{k>1} |b_k| r^k,   |p' - b_1| <= sum_{k>1} k |b_k| r^(k-1).
 */
#include "events/trajectory_poly.h"
#include "numeric/tolerances.h"

#include <string.h>

enum {
    room = trajectory_most_degree + 1,
    power_room = trajectory_most_powers + 1,
    coarse_room = trajectory_coarse_degree + 1
};

/* Used instead of a highest power. */
enum { at_rest = -1, not_followed = -2 };

static const double pi = 3.14159265358979323846;

bool trajectory_init(struct trajectory *trajectory, size_t size, const bool *used, struct arena *memory)
{
    *trajectory = (struct trajectory){.size = size};
    for (size_t i = 0; i < size; i++) trajectory->count += used[i];
    size_t count = trajectory->count;
    size_t grids =
        count > 0 ? 2 * (size_t)coarse_room * (2 * coarse_room + 1) + (size_t)room * (2 * room + 1) : 0;
    trajectory->component = ARENA_ARRAY(memory, 3 * count + size, int);
    trajectory->coefficients =
        ARENA_ARRAY(memory, (size_t)(power_room + room) * count + 6 * count + size, double);
    double *behind = arena_take(memory, grids, sizeof *behind, false);
    trajectory->now = ARENA_ARRAY(memory, size, struct enclosure);
    if (memory->failed) return false;
    trajectory->top = trajectory->component + count;
    trajectory->fresh = trajectory->top + count;
    trajectory->place = trajectory->fresh + count;
    trajectory->samples = trajectory->coefficients + power_room * count;
    trajectory->doubt = trajectory->samples + room * count;
    trajectory->scale = trajectory->doubt + count;
    trajectory->floor = trajectory->scale + count;
    trajectory->tail = trajectory->floor + count;
    trajectory->noise = trajectory->tail + count;
    trajectory->extent = trajectory->noise + count;
    trajectory->y = trajectory->extent + count;
    for (size_t i = 0; i < trajectory_grids; i++) {
        size_t own = i == trajectory_grid_full ? room : coarse_room;
        trajectory->grids[i] = (struct trajectory_grid){0, behind, behind + own, behind + own * (own + 1)};
        behind += own * (2 * own + 1);
    }
    for (size_t i = 0, k = 0; i < size; i++) {
        trajectory->now[i] = enclosure_everything();
        trajectory->place[i] = used[i] ? (int)k : -1;
        if (used[i]) trajectory->component[k++] = (int)i;
    }
    return true;
}

void trajectory_start(struct trajectory *trajectory)
{
    if (trajectory->count > 0) memset(trajectory->scale, 0, trajectory->count * sizeof *trajectory->scale);
    trajectory->length = HUGE_VAL;
}

/* cos(pi k / degree); by its symmetry, so that it is odd to the last bit. */
static double cosine(int k, int degree)
{
    k %= 2 * degree;
    if (k > degree) k = 2 * degree - k;
    return 2 * k == degree ? 0 : 2 * k < degree ? cos(pi * k / degree) : -cos(pi * (degree - k) / degree);
}

/* Row j of the powers of T_0 .. T_d: T_{j+1} = 2 s T_j - T_{j-1}. */
static void set_powers(int degree, double *power)
{
    size_t width = (size_t)degree + 1;
    memset(power, 0, width * width * sizeof *power);
    power[0] = power[width + 1] = 1;
    for (size_t j = 1; j + 1 < width; j++, power += width)
        for (size_t k = 0; k <= j + 1; k++)
            power[2 * width + k] = (k > 0 ? 2 * power[width + k - 1] : 0) - power[k];
}

static enum trajectory_grid_kind grid_of(int degree)
{
    if (degree == trajectory_coarse_degree) return trajectory_grid_coarse;
    return degree < trajectory_coarse_degree ? trajectory_grid_simple : trajectory_grid_full;
}

/* The coefficients of the Chebyshev series are c_j = (2/d) sum_k f_k cos(pi j k/d), where the first and last
 * of both sums count half. */
static void prepare(struct trajectory *trajectory, int degree)
{
    struct trajectory_grid *grid = &trajectory->grids[grid_of(degree)];
    trajectory->degree = degree;
    trajectory->grid = grid;
    if (grid->degree == degree) return;
    grid->degree = degree;
    set_powers(degree, grid->power);
    for (int k = 0; k <= degree; k++) {
        grid->node[k] = cosine(k, degree);
        for (int j = 0; j <= degree; j++) {
            double half = (k == 0 || k == degree ? 0.5 : 1) * (j == 0 || j == degree ? 0.5 : 1);
            grid->series[j * (degree + 1) + k] = 2 * half * cosine(j * k, degree) / degree;
        }
    }
}

/* Another piece. */
static void choose(struct trajectory *trajectory, const bool *wanted)
{
    trajectory->piece++;
    trajectory->exact = false;
    for (size_t i = 0; i < trajectory->count; i++)
        trajectory->top[i] = wanted && !wanted[i] ? not_followed : 0;
}

static int take_samples(struct trajectory *trajectory, trajectory_sampler *sample, void *context)
{
    trajectory->enclosed.from = NAN;
    double radius = (trajectory->to - trajectory->from) / 2, middle = trajectory->from + radius;
    for (int k = 0; k <= trajectory->degree; k++) {
        double t = middle + radius * trajectory->grid->node[k];
        if (k == 0 || t > trajectory->to) t = trajectory->to;
        if (k == trajectory->degree || t < trajectory->from) t = trajectory->from;
        int status = sample(context, t, trajectory->y);
        if (status) return status;
        for (size_t i = 0; i < trajectory->count; i++)
            trajectory->samples[i * room + (size_t)k] = trajectory->y[trajectory->component[i]];
    }
    return 0;
}

static bool all_equal(int degree, const double *sample)
{
    for (int k = 1; k <= degree; k++)
        if (sample[k] != sample[0]) return false;
    return true;
}

/* The Chebyshev series through the samples. The matrix is symmetric; summing all coefficients side by side is
 * faster. */
static void set_series(int width, const double *row, const double *sample, double *restrict series)
{
    for (int k = 0; k < width; k++, row += width)
        for (int j = 0; j < width; j++) series[j] += row[j] * sample[k];
}

/* Set the polynomial of component i in powers of s; returns its size. Terms below the rounding of the samples
 * are left to the error bound: in powers they would be 2^(d-1) times as large. */
static double set_powers_of(struct trajectory *trajectory, size_t i, double *series)
{
    const double rounding = round_off(1, 1);
    int width = trajectory->degree + 1;
    double *c = trajectory->coefficients + i * power_room, size = 0;
    const double *sample = trajectory->samples + i * room, *power = trajectory->grid->power;
    for (int k = 0; k < width; k++) size = interval_larger(fabs(sample[k]), size);
    set_series(width, trajectory->grid->series, sample, series);
    memset(c, 0, room * sizeof *c);
    for (int j = 0; j < width; j++, power += width) {
        if (j > 0 && fabs(series[j]) <= rounding * size) continue;
        trajectory->top[i] = j;
        for (int k = j % 2; k <= j; k += 2) c[k] += series[j] * power[k];
    }
    return size;
}

static double last_terms(const struct trajectory *trajectory, const double *series)
{
    return fabs(series[trajectory->degree]) + fabs(series[trajectory->degree - 1]);
}

/* Is the component at rest? If so, or if it moves by rounding alone, it is a constant. */
static bool rests(struct trajectory *trajectory, size_t i)
{
    const double *sample = trajectory->samples + i * room;
    trajectory->doubt[i] = trajectory->noise[i];
    trajectory->coefficients[i * power_room] = sample[0];
    trajectory->top[i] = all_equal(trajectory->degree, sample) ? at_rest : 0;
    return trajectory->top[i] == at_rest;
}

/* Is the truncation error of the polynomial of component i too large? Its size is that of the last terms.
 * Those of a smooth function fall by 2^(d-1) from a piece to its half; those that do not are round-off. */
static bool follow(struct trajectory *trajectory, size_t i, double negligible, bool halved)
{
    const double rounding = round_off(32, 1), least_fall = 1.0 / 8;
    if (trajectory->top[i] == not_followed || rests(trajectory, i)) return false;
    double series[room] = {0}, size = set_powers_of(trajectory, i, series);
    double tail = negligible == 0 ? 0 : last_terms(trajectory, series);
    trajectory->doubt[i] += rounding * size + tail;
    trajectory->scale[i] = fmax(trajectory->scale[i], size);
    double share = tail / trajectory->scale[i], before = trajectory->tail[i];
    trajectory->tail[i] = share;
    if (halved && share > negligible && share > least_fall * before)
        trajectory->floor[i] = fmax(trajectory->floor[i], 2 * before);
    return share > negligible && share > trajectory->floor[i];
}

int trajectory_set(struct trajectory *trajectory, double from, double to, const bool *wanted, int degree,
                   double negligible, trajectory_sampler *sample, void *context)
{
    enum { most_halvings = 20 };
    trajectory->from = from;
    trajectory->to = to - from > 2 * trajectory->length ? from + 2 * trajectory->length : to;
    if (trajectory->count == 0) return 0;
    prepare(trajectory, degree);
    choose(trajectory, wanted);
    for (int halving = 0;; halving++) {
        bool rough = false;
        int status = take_samples(trajectory, sample, context);
        if (status) return status;
        for (size_t i = 0; i < trajectory->count; i++)
            rough |= follow(trajectory, i, negligible, halving > 0);
        double half = from + (trajectory->to - from) / 2;
        if (!rough || halving == most_halvings || !(half > from && half < trajectory->to)) break;
        trajectory->to = half;
        trajectory->length = half - from;
    }
    if (trajectory->length < HUGE_VAL) trajectory->length = fmax(trajectory->length, trajectory->to - from);
    return 0;
}

/* A motion that a step approximates accurately is smooth on the scale of the step, so that the terms fall
 * from the third on; if the last two vanish by chance, T_2 counts. */
int trajectory_set_coarse(struct trajectory *trajectory, double from, double to, const bool *wanted,
                          trajectory_sampler *sample, void *context)
{
    const double rounding = round_off(32, 1), safe = 2;
    trajectory->from = from;
    trajectory->to = to;
    if (trajectory->count == 0) return 0;
    prepare(trajectory, trajectory_coarse_degree);
    choose(trajectory, wanted);
    int status = take_samples(trajectory, sample, context);
    if (status) return status;
    for (size_t i = 0; i < trajectory->count; i++) {
        if (trajectory->top[i] == not_followed || rests(trajectory, i)) continue;
        double series[room] = {0}, size = set_powers_of(trajectory, i, series);
        double tail = fmax(last_terms(trajectory, series), fabs(series[2]) / 16);
        trajectory->doubt[i] += rounding * size + safe * tail;
    }
    return 0;
}

/* Bound of the distance between a motion and the polynomial of its ends, a quintic in q and a quartic in v.
 * That of an oscillation errs by (w h)^6/46080 of its amplitude, in v by (w h)^5/13500, and has curvature
 * terms of (w h)^2/8 or (w h)^3/48 of it, by its phase: even at w h = 4, which no method resolves, a quarter
 * of these is four times the error. */
static double doubt_of_ends(int degree, const double *c)
{
    double bends = fabs(c[1]) / 16;
    for (int k = 2; k <= degree; k++) bends += fabs(c[k]);
    return bends / 4;
}

bool trajectory_set_powers(struct trajectory *trajectory, double from, double to, const bool *wanted,
                           bool rough, trajectory_powers *powers, void *context)
{
    const double rounding = round_off(32, 1);
    trajectory->enclosed.from = NAN;
    trajectory->from = from;
    trajectory->to = to;
    trajectory->degree = 0;
    choose(trajectory, wanted);
    trajectory->exact = !rough;
    for (size_t i = 0; i < trajectory->count; i++) {
        double *c = trajectory->coefficients + i * power_room, bends = 0;
        if (trajectory->top[i] == not_followed) continue;
        int degree = powers(context, from, to, trajectory->component[i], c), top = at_rest;
        if (degree < 0) return false;
        for (int k = 1; k <= degree; k++) bends += fabs(c[k]);
        double size = fabs(c[0]) + bends;
        trajectory->extent[i] = size;
        if (bends > 0) top = degree;
        while (top > 0 && fabs(c[top]) <= round_off(1, size)) top--; /* left to the error bound */
        trajectory->top[i] = top;
        trajectory->doubt[i] = trajectory->noise[i] + (top == at_rest ? 0 : rounding * size);
        if (rough && top != at_rest) trajectory->doubt[i] += doubt_of_ends(degree, c);
        if (degree > trajectory->degree) trajectory->degree = degree;
    }
    return true;
}

/* b_k of the polynomial c about s0. */
static void shift(int degree, const double *c, double s0, double *b)
{
    memcpy(b, c, (size_t)(degree + 1) * sizeof *b);
    if (s0 == 0) return;
    for (int k = 0; k < degree; k++)
        for (int j = degree - 1; j >= k; j--) b[j] += s0 * b[j + 1];
}

void trajectory_enclose(struct trajectory *trajectory, const struct stretch *stretch, const bool *wanted)
{
    double radius = (trajectory->to - trajectory->from) / 2, middle = trajectory->from + radius,
           b[power_room];
    if (!(radius > 0)) return;
    double s0 = (stretch->middle - middle) / radius, r = stretch_radius(stretch) / radius;
    bool other = stretch->from != trajectory->enclosed.from || stretch->to != trajectory->enclosed.to;
    if (other) memset(trajectory->fresh, 0, trajectory->count * sizeof *trajectory->fresh);
    trajectory->enclosed = *stretch;
    for (size_t i = 0; i < trajectory->count; i++) {
        if (trajectory->fresh[i] || (wanted && !wanted[i])) continue;
        trajectory->fresh[i] = true;
        const double *c = trajectory->coefficients + i * power_room;
        double doubt = trajectory->doubt[i], bend = 0, slope = 0, power = 1;
        struct enclosure *now = &trajectory->now[trajectory->component[i]];
        int top = trajectory->top[i];
        if (top == not_followed) {
            *now = enclosure_everything();
            continue;
        }
        if (top == at_rest) {
            *now = enclosure_point(c[0]);
            if (doubt > 0) now->value = now->middle = interval_around(c[0], doubt);
            continue;
        }
        b[1] = 0;
        shift(top, c, s0, b);
        for (int k = 2; k <= top; k++) {
            power *= r;
            slope += k * fabs(b[k]) * power;
            bend += fabs(b[k]) * power * r;
        }
        double steep = doubt * trajectory->degree; /* doubt over the spacing of samples */
        now->value = interval_around(b[0], fabs(b[1]) * r + bend + doubt);
        now->rate = interval_scale(1 / radius, interval_around(b[1], slope + steep));
        now->middle = interval_around(b[0], doubt);
    }
}

int trajectory_top(const struct trajectory *trajectory, size_t place)
{
    int top = trajectory->top[place];
    return top == at_rest ? 0 : top;
}

const double *trajectory_powers_of(const struct trajectory *trajectory, size_t place)
{
    return trajectory->coefficients + place * power_room;
}
