/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Bounds over [s0 - r, s0 + r]: with B >= |p''| there,
 *
 *     |p - p(s0)| <= |p'(s0)| r + B r^2/2,   |p' - p'(s0)| <= B r,
 *
 * where |T_j''(s)| <= j^2 (j^2 - 1)/3, and inside, by T_j = cos(j theta), |T_j''| <= j^2/(1 - s^2) +
 * j |s| (1 - s^2)^(-3/2).
 */
#include "events/series.h"

#include <assert.h>
#include <string.h>

#include "numeric/lu.h"
#include "numeric/tolerances.h"

enum { nodes = series_nodes, most = series_most_degree };

static const int degrees[series_levels] = {5, 8, 16};
static const int counts[series_levels] = {3, 9, 17}; /* number of nodes of a level */
static const int strides[series_levels] = {0, 2, 1};

/* Node k of a level. The first level uses the ends and a node beside the middle: at the middle, a wave whose
 * periods fit into the halves of a panel would have the same values as at the ends. */
static int node_of(int level, int k)
{
    static const int first[] = {0, 6, 16};
    assert(level >= 0 && level < series_levels);
    return level == 0 ? first[k] : k * strides[level];
}

/* Offset of the matrix of a level; for the number of levels the size of all. */
static size_t place_of_matrix(int level)
{
    size_t place = 0;
    assert(level <= series_levels);
    for (int k = 0; k < level; k++) place += (size_t)((degrees[k] + 1) * (degrees[k] + 1));
    return place;
}

static bool is_taken(int level, int k)
{
    return level == 0 ? k == 0 || k == 6 || k == most : level > 0 && k % strides[level] == 0;
}

/* cos(pi k / 16), odd about k = 8 to the last bit. */
static double node(int k)
{
    const double pi = 3.14159265358979323846;
    k %= 2 * most;
    if (k > most) k = 2 * most - k;
    return 2 * k == most ? 0 : 2 * k < most ? cos(pi * k / most) : -cos(pi * (most - k) / most);
}

/* c_j = (2/d) sum_k f_k cos(pi j k/d), where the first and last of both sums count half. */
static void set_matrix(int level, double *matrix)
{
    int d = degrees[level], stride = strides[level];
    for (int j = 0; j <= d; j++)
        for (int k = 0; k <= d; k++) {
            double half = (k == 0 || k == d ? 0.5 : 1) * (j == 0 || j == d ? 0.5 : 1);
            *matrix++ = 2 * half * node(j * k * stride) / d;
        }
}

/* T_j and T_j' = j U_{j-1} at s. */
static double wave(int j, double s, double *slope)
{
    double t = s, before = 1, u = 1, u_before = 0;
    *slope = j;
    if (j == 0) return 1;
    for (int k = 1; k < j; k++) {
        double next = 2 * s * t - before, u_next = 2 * s * u - u_before;
        before = t, t = next;
        u_before = u, u = u_next;
    }
    *slope = j * u;
    return t;
}

/* From values and rates at three nodes to the six coefficients: the inverse of the matrix of values and
 * rates. */
static void set_rates_matrix(double *matrix)
{
    enum { n = 6 };
    double a[n * n];
    size_t order[n];
    for (int k = 0; k < n / 2; k++)
        for (int j = 0; j < n; j++) a[k * n + j] = wave(j, node(node_of(0, k)), &a[(k + n / 2) * n + j]);
    lu_decompose(n, a, order);
    for (int k = 0; k < n; k++) {
        double unit[n] = {0};
        unit[k] = 1;
        lu_solve(n, a, order, unit);
        for (int j = 0; j < n; j++) matrix[j * n + k] = unit[j];
    }
}

void series_init(struct series *series, size_t count, struct arena *memory)
{
    size_t matrices = count > 0 ? place_of_matrix(series_levels) : 0;
    *series = (struct series){.count = count};
    series->values = ARENA_ARRAY(memory, (3 * nodes + 9) * count, double);
    series->matrices = arena_take(memory, matrices, sizeof *series->matrices, false);
    if (memory->failed) return;
    series->rates = series->values + nodes * count;
    series->c = series->rates + nodes * count;
    series->doubt = series->c + nodes * count;
    series->scale = series->doubt + count;
    series->floor = series->scale + count;
    series->tail = series->floor + count;
    series->value = series->tail + count;
    series->rate = series->value + count;
    series->rounding = series->rate + count;
    series->jump = series->rounding + count;
    series->off = series->jump + count;
}

void series_start(struct series *series)
{
    memset(series->scale, 0, 2 * series->count * sizeof *series->scale); /* and floor */
}

void series_open(struct series *series, double from, double to)
{
    bool starts = series->known && from == series->from, follows = series->known && from == series->to;
    int old = follows ? 0 : most;
    double longer = (to - from) / (series->to - series->from);
    series->known = starts || follows;
    for (size_t k = 0; series->known && k < series->count * nodes; k += nodes) {
        series->values[k + most] = series->values[k + (size_t)old];
        series->rates[k + most] = series->rates[k + (size_t)old] * longer;
    }
    series->from = from;
    series->to = to;
    series->level = -1;
}

void series_forget(struct series *series)
{
    series->known = false;
}

/* ---- samples */

static int take(struct series *series, int k, const bool *asked, series_sampler *sample, void *context)
{
    double radius = (series->to - series->from) / 2, t = series->from + radius * (1 + node(k));
    if (k == 0 || t > series->to) t = series->to;
    if (k == most || t < series->from) t = series->from;
    int status = sample(context, t, asked, series->value, series->rate);
    for (size_t i = 0; i < series->count; i++) {
        series->values[i * nodes + (size_t)k] = series->value[i];
        series->rates[i * nodes + (size_t)k] = series->rate[i] * radius;
    }
    return status;
}

static void prepare(struct series *series)
{
    set_rates_matrix(series->matrices);
    for (int level = 1; level < series_levels; level++)
        set_matrix(level, series->matrices + place_of_matrix(level));
    series->prepared = true;
}

int series_refine(struct series *series, series_sampler *sample, void *context, const bool *asked)
{
    if (!series->prepared) prepare(series);
    int level = ++series->level;
    series->degree = degrees[level];
    for (int n = counts[level] - 1; n >= 0; n--) {
        int k = node_of(level, n);
        if (is_taken(level - 1, k) || (level == 0 && k == most && series->known)) continue;
        int status = take(series, k, level == 0 ? NULL : asked, sample, context);
        if (status) return status;
    }
    series->known = true;
    return 0;
}

/* ---- the series */

static void fit_rates(const struct series *series, const double *f, const double *g, double *c)
{
    const double *row = series->matrices;
    for (int j = 0; j < 6; j++, row += 6) {
        c[j] = 0;
        for (int k = 0; k < 3; k++) c[j] += row[k] * f[node_of(0, k)] + row[k + 3] * g[node_of(0, k)];
    }
}

static void fit_values(const struct series *series, const double *f, double *c)
{
    int d = series->degree;
    const double *row = series->matrices + place_of_matrix(series->level);
    for (int j = 0; j <= d; j++, row += d + 1) {
        double sum = 0;
        for (int k = 0; k <= d; k++) sum += row[k] * f[node_of(series->level, k)];
        c[j] = sum;
    }
}

/* p and p' at s, by T_j' = j U_{j-1}. */
static double evaluate(int degree, const double *c, double s, double *slope)
{
    double t = s, before = 1, u = 1, u_before = 0, sum = c[0] + c[1] * s;
    *slope = c[1];
    for (int j = 2; j <= degree; j++) {
        double next = 2 * s * t - before, u_next = 2 * s * u - u_before;
        before = t, t = next;
        u_before = u, u = u_next;
        sum += c[j] * t;
        *slope += j * c[j] * u;
    }
    return sum;
}

/* Bound of the distance of f from a series with wrong rates: a wave T_n of amplitude 1 has slopes up to n^2
 * at the ends and about n inside. */
static double missed(const struct series *series, const double *g, const double *c)
{
    int d = series->degree;
    double worst = 0;
    for (int n = 0; n <= d; n++) {
        int k = node_of(series->level, n);
        double slope, s = node(k), share = (sqrt(1 - s * s) + 1.0 / d) / d;
        evaluate(d, c, s, &slope);
        worst = fmax(worst, share * fabs(slope - g[k]));
    }
    return worst;
}

static double last_terms(const struct series *series, const double *c)
{
    int d = series->degree;
    double last = fabs(c[d]) + fabs(c[d - 1]);
    /* If these two vanish by chance, the two before them count. */
    return fmax(last, (fabs(c[d - 2]) + fabs(c[d - 3])) / 16);
}

/* Error of a series by its rates: a series that has not resolved f has wrong rates. Sampled rates are only as
 * accurate as the dense output, whose positions and velocities agree to the error of the method; so small
 * differences are ignored, and those that do not fall when the panel is halved. */
static double unseen(struct series *series, size_t i, const double *c, bool halved)
{
    const double share = 0.02, least_fall = 0.5;
    if (series->level == 0) return 0;
    double off = missed(series, series->rates + i * nodes, c), before = series->off[i];
    if (series->level == series_levels - 1) series->off[i] = off;
    bool stays = halved && off > least_fall * before;
    return off > share * series->scale[i] && !stays ? off : 0;
}

static bool all_finite(const struct series *series, size_t i, double *size)
{
    bool finite = true;
    *size = 0;
    for (int n = 0; n < counts[series->level]; n++) {
        size_t k = i * nodes + (size_t)node_of(series->level, n);
        double f = fabs(series->values[k]);
        finite &= isfinite(f) && isfinite(series->rates[k]);
        *size = fmax(*size, f);
    }
    return finite;
}

enum series_state series_fit(struct series *series, size_t i, bool halved)
{
    const double negligible = negligible_part, rounding = round_off(16, 1), safe = 2, least_fall = 1.0 / 8;
    const double *f = series->values + i * nodes;
    double *c = series->c + i * nodes, size, sum = 0;
    if (f[0] == HUGE_VAL && f[most] == HUGE_VAL) return series_inactive;
    if (!all_finite(series, i, &size)) return series_unresolved;
    if (series->level == 0)
        fit_rates(series, f, series->rates + i * nodes, c);
    else
        fit_values(series, f, c);
    for (int j = 0; j <= series->degree; j++) sum += fabs(c[j]);
    series->scale[i] = fmax(series->scale[i], size);
    double tail = fmax(last_terms(series, c), unseen(series, i, c, halved)),
           share = series->scale[i] > 0 ? tail / series->scale[i] : 0;
    series->doubt[i] = safe * tail + rounding * sum + series->rounding[i];
    bool last = series->level == series_levels - 1;
    /* The last terms of a smooth function fall by 2^16 from a panel to its half; those that do not are
     * round-off. */
    const bool stays = last && halved && share > least_fall * series->tail[i];
    if (stays) series->floor[i] = fmax(series->floor[i], fmin(2 * series->tail[i], most_series_rounding));
    if (last) series->tail[i] = share;
    bool small = tail <= series->rounding[i] || (stays && tail <= 2 * series->jump[i]) ||
                 share <= negligible || share <= series->floor[i];
    if (small) return series_followed;
    return last ? series_unresolved : series_rough;
}

/* ---- bounds */

bool series_is_positive(const struct series *series, size_t i)
{
    const double *c = series->c + i * nodes;
    double least = c[0] - series->doubt[i];
    for (int j = 1; j <= series->degree; j++) least -= fabs(c[j]);
    return least >= 0;
}

static double bend(int degree, const double *c, double s)
{
    double q = 1 - s * s, inside = q > 0 ? 1 / q : HUGE_VAL, side = q > 0 ? fabs(s) * inside / sqrt(q) : 0;
    double sum = 0;
    for (int j = 2; j <= degree; j++) {
        double n = j, edge = n * n * (n * n - 1) / 3;
        sum += fabs(c[j]) * fmin(edge, n * n * inside + n * side);
    }
    return sum;
}

struct enclosure series_enclose(const struct series *series, size_t i, const struct stretch *stretch)
{
    const double *c = series->c + i * nodes;
    double radius = (series->to - series->from) / 2, doubt = series->doubt[i];
    double s0 = (stretch->middle - series->from) / radius - 1, r = stretch_radius(stretch) / radius, slope;
    double n = series->degree, p = evaluate(series->degree, c, s0, &slope);
    double curve = bend(series->degree, c, fmin(fabs(s0) + r, 1));
    double reach = fabs(slope) * r + curve * r * r / 2;
    struct interval rate = interval_around(slope, curve * r + n * n * doubt);
    return (struct enclosure){interval_around(p, reach + doubt), interval_scale(1 / radius, rate),
                              interval_around(p, doubt)};
}
