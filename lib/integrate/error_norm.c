/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/error_norm.h"

#include <float.h>
#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/block_alloc.h"
#include "numeric/tolerances.h"

struct error_norm {
    size_t pairs, size; /* of the layout: number of q, number of all components */
    double tolerance;
    struct step_law law;
    double *scale;   /* size: running maximum of |y| and of the floors given */
    double *cap;     /* pairs: 1 rad for angles, no bound for others */
    double *noise;   /* pairs, then other components: round-off level of a, and of y' */
    double *floor;   /* pairs: floors of the rates, as given */
    double *passing; /* as noise: the part of it that is proportional to a, or to y' */
    double *fastest; /* components outside the pairs: running maximum of |y'|, */
    double *slopes;  /* and y' in the last accepted state */
    double *before;  /* 3 pairs: q, v and a of the last accepted state, */
    double *earlier; /* and of the one before it */
    double in_noise; /* a step size up to which error_norm_roundoff_counts is known to be false */
    double memory[];
};

static size_t numbers(size_t pairs, size_t size)
{
    return 5 * size + 2 * pairs;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* Change of q_i, and of any other component, in a step of size h. */
static inline double motion_of_q(double h, double v, double a)
{
    return fabs(h * v) + fabs(h * h * a);
}

static inline double motion_of(double h, double slope)
{
    return fabs(h * slope);
}

/* The scale S_i of a component that moves by `motion` in the step; q_i is capped besides. */
static inline double scale_of(const struct error_norm *w, size_t i, double y, double motion)
{
    double scale = larger(w->scale[i], fabs(y));
    return scale > 0 ? scale : motion;
}

static inline double scale_of_q(const struct error_norm *w, size_t i, double q, double motion)
{
    return smaller(scale_of(w, i, q, motion), w->cap[i]);
}

/* Amplitude of a rate in the harmonic motion through the state `before` and this one: a = -w^2 q gives 1 /
 * w^2 = |dq / da|, and v^2 + a^2 / w^2 is constant, here with the larger v and the mean a. INFINITY where a
 * does not change, and for methods of variable order, whose steps carry earlier errors along: with it,
 * estimates of msadams on a decaying oscillation were low by half (tests/unit/test_accuracy.c). Squares may
 * underflow after a weak pulse. */
static double amplitude(const struct error_norm *w, const double *before, size_t i, double q, double v,
                        double a)
{
    if (w->law.estimate_order == 0) return INFINITY;
    const double *q0 = before, *v0 = q0 + w->pairs, *a0 = v0 + w->pairs;
    double fast = larger(fabs(v), fabs(v0[i])), mean = (a0[i] + a) / 2;
    double square = fast * fast + mean * mean * fabs((q - q0[i]) / (a - a0[i]));
    return square >= 0 ? larger(sqrt(square), fast) : INFINITY;
}

static inline double scale_of_v(const struct error_norm *w, size_t i, double scale, double swing)
{
    return smaller(scale, larger(swing, larger(w->floor[i], least_rate_scale * scale)));
}

/* The allowed error of y; `hidden` is the part that is invisible for other reasons than the rounding of y.
 * The true change of y is at most the sum of its old and new sizes. The motion by the slope at the end is
 * limited to that, since a step that has gone wrong has a huge slope there (quadratic drag at terminal speed
 * with a step of 1000 s ends with a speed of 1e104 m/s and 1e209 m/s^2). */
static inline double level(double tolerance, double scale, double y, double motion, double hidden)
{
    double moved = smaller(motion, scale + fabs(y));
    return larger(larger(tolerance * scale, round_off(1, fabs(y) + moved)), hidden);
}

/* The tolerance in a step of size h of a component with the scale `way` and the scale `speed` of its rate:
 * reduced where the step is short compared with way / speed, as the errors of many steps add up. */
static double tolerance_by_time(const struct error_norm *w, double way, double speed, double h)
{
    const double most = 1e3, least = least_part_tolerance;
    double part = fabs(h) * speed / (w->law.by_time * way);
    if (!(part > 0 && part < 1)) return w->tolerance;
    return smaller(w->tolerance, larger(w->tolerance * larger(part, 1 / most), least));
}

static inline double allowed_by_noise(const struct error_norm *w, size_t i, double h)
{
    return 4 * w->noise[i] * fabs(h);
}

/* The error of v_i that rounding of q_i hides within a step, or that of the acceleration, `by_noise`. */
static inline double hidden_in_v(const struct error_norm *w, size_t i, double h, double q, double by_noise)
{
    return larger(round_off(1, smaller(fabs(q), w->cap[i])) / fabs(h), by_noise);
}

/* Raise the ratio by an error, unless the rounding of the accelerations, `noise`, explains it. Such an error
 * does not depend on the step size as the law assumes: with a level proportional to h, as it is, the step
 * would shrink without end, because the law requires ratios below safety^k. Larger errors are compared with a
 * level of at least four times the noise, so that a step that has just grown out of the noise is not rejected
 * at once. Levels must not underflow: the far tail of a bell curve drives a body at rest with 1e-300 N.
 * Within the noise of a time-dependent force an error counts as `at_least` (or its own ratio, if less). */
static inline double raised(double ratio, double error, double error_level, double noise, double at_least)
{
    bool counts = fabs(error) > noise;
    if (!counts && at_least == 0) return ratio;
    double own = fabs(error) / larger(error_level, DBL_MIN);
    return larger(ratio, counts ? own : smaller(own, at_least));
}

/* The least ratio within the round-off level, such that the step at most doubles: a step six times as long,
 * beyond that level, errs a million times as much, and of the many steps within a pulse some have a small
 * estimate by chance. */
static inline double least_in_noise(const struct error_norm *w, size_t i)
{
    return w->passing[i] > 0 ? w->law.doubles : 0;
}

/* The round-off level in a step over which an acceleration goes from a0 to a1. The part proportional to the
 * acceleration falls with it: the level on the flank of a pulse must not excuse a step that ends behind the
 * pulse. */
static inline double noise_over(const struct error_norm *w, size_t i, double a0, double a1)
{
    double noise = w->noise[i], passing = w->passing[i];
    if (passing == 0) return noise;
    double left = (fabs(a1) + noise) / (fabs(a0) + noise);
    return noise - passing + passing * smaller(left, 1);
}

double error_norm_ratio(const gsl_odeiv2_control *control, double h, const double *y, const double *yerr,
                        const double *f)
{
    const struct error_norm *w = control->state;
    size_t n = w->pairs;
    bool by_time = w->law.by_time > 0;
    double ratio = 0, probe = 0; /* zero times a sum stays zero unless a term is infinite or NaN */
    for (size_t i = 0; i < n; i++) {
        double q = y[i], v = y[n + i], a = f[n + i], at_least = least_in_noise(w, i);
        double q_motion = motion_of_q(h, v, a), v_motion = motion_of(h, a);
        double noise_v = noise_over(w, i, w->before[2 * n + i], a) * fabs(h), noise_q = noise_v * fabs(h);
        double tolerance = by_time ? tolerance_by_time(w, smaller(w->scale[i], w->cap[i]), w->scale[n + i], h)
                                   : w->tolerance;
        ratio =
            raised(ratio, yerr[i], level(tolerance, scale_of_q(w, i, q, q_motion), q, q_motion, 4 * noise_q),
                   noise_q, at_least);
        double scale_v =
            scale_of_v(w, i, scale_of(w, n + i, v, v_motion), amplitude(w, w->before, i, q, v, a));
        ratio = raised(ratio, yerr[n + i],
                       level(tolerance, scale_v, v, v_motion, hidden_in_v(w, i, h, q, 4 * noise_v)), noise_v,
                       at_least);
        probe += 0 * (q + v + a + yerr[i] + yerr[n + i]);
    }
    for (size_t i = 2 * n; i < w->size; i++) {
        double motion = motion_of(h, f[i]);
        double tolerance =
            by_time ? tolerance_by_time(w, w->scale[i], w->fastest[i - 2 * n], h) : w->tolerance;
        double noise = noise_over(w, i - n, w->slopes[i - 2 * n], f[i]) * fabs(h);
        ratio =
            raised(ratio, yerr[i], level(tolerance, scale_of(w, i, y[i], motion), y[i], motion, 4 * noise),
                   noise, least_in_noise(w, i - n));
        probe += 0 * (y[i] + f[i] + yerr[i]);
    }
    return probe == 0 ? ratio : INFINITY;
}

/* ratio^(1/k). Square roots are rounded correctly on every platform, pow is not: so the methods that `auto`
 * chooses give the same steps with every mathematics library. They are faster, too. */
static double root_of(double ratio, int k)
{
    double eighth = k == 8 || k == 11 ? sqrt(sqrt(sqrt(ratio))) : 0;
    if (k == 8) return eighth;
    double sixteenth = sqrt(eighth);
    if (k == 11) return sixteenth * sqrt(sixteenth); /* 3/32 for 1/11 */
    return pow(ratio, 1.0 / k);
}

double error_norm_factor(const gsl_odeiv2_control *control, double ratio, unsigned order)
{
    const struct error_norm *w = control->state;
    const struct step_law *law = &w->law;
    if (!(ratio < INFINITY)) return 0.1;
    if (ratio == 0) return law->grow;
    int k = law->estimate_order > 0 ? law->estimate_order : (int)order + 1;
    double factor = law->safety / root_of(ratio, k);
    if (ratio > 1) return larger(factor, law->shrink);
    return factor < law->keep_below ? 1 : smaller(factor, law->grow);
}

double error_norm_rate(const gsl_odeiv2_control *control, const double *y, const double *dy, const double *df)
{
    const struct error_norm *w = control->state;
    size_t n = w->pairs;
    double by_q = 0, by_v = 0, by_a = 0;
    for (size_t i = 0; i < n; i++) {
        double scale = larger(w->scale[n + i], fabs(y[n + i]));
        if (scale == 0) continue;
        by_q += fabs(dy[i]) / scale;
        by_v += fabs(dy[n + i]) / scale;
        by_a += larger(fabs(df[n + i]) - 8 * w->noise[i], 0) / scale;
    }
    double root = by_v + sqrt(by_v * by_v + 4 * by_q * by_a);
    return by_a > 0 && root > 0 ? 2 * by_a / root : 0;
}

void error_norm_scales(const gsl_odeiv2_control *control, double h, const double *y, const double *f,
                       double *scales)
{
    const struct error_norm *w = control->state;
    size_t n = w->pairs;
    for (size_t i = 0; i < n; i++) scales[i] = scale_of_q(w, i, y[i], motion_of_q(h, y[n + i], f[n + i]));
    for (size_t i = n; i < w->size; i++) scales[i] = scale_of(w, i, y[i], motion_of(h, f[i]));
}

static void exchange_states(struct error_norm *w)
{
    double *now = w->earlier;
    w->earlier = w->before;
    w->before = now;
}

void error_norm_update(gsl_odeiv2_control *control, const double *y, const double *f)
{
    struct error_norm *w = control->state;
    for (size_t i = 0; i < w->size; i++) w->scale[i] = larger(w->scale[i], fabs(y[i]));
    size_t n = w->pairs;
    for (size_t i = 2 * n; i < w->size; i++)
        w->fastest[i - 2 * n] = larger(w->fastest[i - 2 * n], fabs(f[i]));
    memcpy(w->slopes, f + 2 * n, (w->size - 2 * n) * sizeof *f);
    exchange_states(w);
    memcpy(w->before, y, 2 * n * sizeof *y);
    memcpy(w->before + 2 * n, f + n, n * sizeof *f);
}

void error_norm_set_floor(gsl_odeiv2_control *control, size_t i, double floor)
{
    struct error_norm *w = control->state;
    size_t n = w->pairs;
    w->scale[i] = larger(w->scale[i], floor);
    if (i >= n && i < 2 * n) w->floor[i - n] = larger(w->floor[i - n], floor);
}

void error_norm_set_roundoff(gsl_odeiv2_control *control, size_t i, double noise, double passing)
{
    struct error_norm *w = control->state;
    w->noise[i] = noise;
    w->passing[i] = smaller(passing, noise);
    w->in_noise = 0;
}

/* The largest h for which no error that noise allows can exceed the tolerances: scales only grow. */
static double longest_in_noise(const struct error_norm *w)
{
    const double share = 0.9;
    double longest = INFINITY;
    size_t n = w->pairs;
    for (size_t i = 0; i < n; i++) /* a lower bound of the scale: no amplitude */
        longest = smaller(scale_of_v(w, i, w->scale[n + i], 0) / allowed_by_noise(w, i, 1), longest);
    for (size_t i = 2 * n; i < w->size; i++)
        longest = smaller(w->scale[i] / allowed_by_noise(w, i - n, 1), longest);
    return share * w->tolerance * longest;
}

bool error_norm_roundoff_counts(const gsl_odeiv2_control *control, double h)
{
    struct error_norm *w = control->state;
    size_t n = w->pairs;
    const double *q = w->before, *v = q + n, *a = v + n;
    if (h <= w->in_noise) return false;
    w->in_noise = longest_in_noise(w);
    for (size_t i = 0; i < n; i++) {
        double allowed = allowed_by_noise(w, i, h), scale = w->scale[n + i];
        if (!(allowed > w->tolerance * scale_of_v(w, i, scale, 0))) continue;
        double swing = amplitude(w, w->earlier, i, q[i], v[i], a[i]);
        if (allowed > w->tolerance * scale_of_v(w, i, scale, swing)) return true;
    }
    for (size_t i = 2 * n; i < w->size; i++)
        if (allowed_by_noise(w, i - n, h) > w->tolerance * w->scale[i]) return true;
    return false;
}

double error_norm_tolerance(const gsl_odeiv2_control *control)
{
    return ((const struct error_norm *)control->state)->tolerance;
}

bool error_norm_view(const gsl_odeiv2_control *control, struct stepper_state_view *view)
{
    const struct error_norm *w = control->state;
    const size_t n = w->pairs, bytes = n * sizeof(double);
    if (n == 0 || n > view_most_pairs || w->size != 2 * n) return false;
    view->pairs = n;
    view->tolerance = w->tolerance;
    memcpy(view->scale, w->scale, 2 * bytes);
    memcpy(view->cap, w->cap, bytes);
    memcpy(view->noise, w->noise, bytes);
    memcpy(view->floor, w->floor, bytes);
    memcpy(view->last, w->before, 3 * bytes);
    memcpy(view->before, w->earlier, 3 * bytes);
    return true;
}

void error_norm_settle(gsl_odeiv2_control *control, const struct stepper_state_view *view)
{
    struct error_norm *w = control->state;
    const size_t bytes = w->pairs * sizeof(double);
    memcpy(w->scale, view->scale, 2 * bytes);
    memcpy(w->before, view->last, 3 * bytes);
    memcpy(w->earlier, view->before, 3 * bytes);
}

void error_norm_follow(gsl_odeiv2_control *control, const gsl_odeiv2_control *other)
{
    struct error_norm *w = control->state;
    const struct error_norm *from = other->state;
    memcpy(w->memory, from->memory, numbers(w->pairs, w->size) * sizeof *w->memory);
    if (w->before - w->memory != from->before - from->memory) exchange_states(w);
    w->in_noise = 0;
}

/* The largest scale among the components of the same group (q, v or x) as `i`: a replacement for a scale of
 * zero. */
static double scale_of_group(const struct error_norm *w, size_t i)
{
    size_t n = w->pairs,
           first = i < n       ? 0
                   : i < 2 * n ? n
                               : 2 * n,
           last = i < n       ? n
                  : i < 2 * n ? 2 * n
                              : w->size;
    double scale = 0;
    for (size_t j = first; j < last; j++)
        scale = larger(scale, j < n ? smaller(w->scale[j], w->cap[j]) : w->scale[j]);
    return scale;
}

static int control_hadjust(void *state, size_t n, unsigned order, const double y[], const double yerr[],
                           const double yp[], double *h)
{
    const gsl_odeiv2_control control = {.state = state};
    (void)n;
    double ratio = error_norm_ratio(&control, *h, y, yerr, yp),
           factor = error_norm_factor(&control, ratio, order);
    *h *= factor;
    if (ratio > 1) return GSL_ODEIV_HADJ_DEC;
    return factor > 1 ? GSL_ODEIV_HADJ_INC : GSL_ODEIV_HADJ_NIL;
}

/* Implicit and multistep methods end their iterations by this level, before there is a new state. They divide
 * by it, so it must not be zero: a component whose scale and motion are zero takes the largest scale of its
 * group. In a state where all scales are zero the number 1 is used, which does no harm, as hadjust checks the
 * result. */
static int control_errlevel(void *state, const double y, const double dydt, const double h, const size_t i,
                            double *errlev)
{
    const struct error_norm *w = state;
    size_t n = w->pairs;
    double motion = i < n ? motion_of_q(h, dydt, w->before[2 * n + i]) : motion_of(h, dydt);
    double scale = i < n ? scale_of_q(w, i, y, motion) : scale_of(w, i, y, motion);
    double hidden = i < n       ? 0
                    : i < 2 * n ? hidden_in_v(w, i - n, h, w->scale[i - n], allowed_by_noise(w, i - n, h))
                                : allowed_by_noise(w, i - n, h);
    *errlev = level(w->tolerance, scale, y, motion, hidden);
    if (*errlev == 0) *errlev = w->tolerance * scale_of_group(w, i);
    if (*errlev == 0) *errlev = w->tolerance;
    return GSL_SUCCESS;
}

static int control_init(void *state, double eps_abs, double eps_rel, double a_y, double a_dydt)
{
    struct error_norm *w = state;
    (void)a_y, (void)a_dydt;
    if (eps_abs != 0 || !(eps_rel > 0)) return GSL_EINVAL;
    w->tolerance = eps_rel;
    return GSL_SUCCESS;
}

static int control_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

/* GSL would allocate the state before the dimension is set, so only error_norm_alloc makes controls of this
 * type. */
static void *control_alloc(void)
{
    return NULL;
}

static const gsl_odeiv2_control_type error_norm_type = {
    .name = "weights",
    .alloc = control_alloc,
    .init = control_init,
    .hadjust = control_hadjust,
    .errlevel = control_errlevel,
    .set_driver = control_set_driver,
    .free = free,
};

/* The numbers of HNW I, II.4 and of dop853.f, with two changes, by measured evaluations at equal error. Order
 * 8: where the allowed step changes much within one step, safety 0.9 has a quarter of the steps rejected; 0.7
 * needs fewer evaluations for dop853 and rk8pd, 0.6 hardly fewer. Multistep methods: a step size that stays
 * constant until it may double takes fewer evaluations than one that follows every estimate; msadams on van
 * der Pol's oscillator with mu = 20 is an exception. */
struct step_law step_law_for(int estimate_order)
{
    struct step_law law = {.safety = 0.9, .shrink = 0.2, .grow = 5, .keep_below = 0};
    law.estimate_order = estimate_order;
    if (estimate_order == 8 || estimate_order == 11) {
        law.safety = 0.7;
        law.shrink = 0.333;
        law.grow = 6;
    }
    if (estimate_order == 0) {
        law.safety = 0.7;
        law.keep_below = 2;
    }
    law.doubles = pow(law.safety / 2, estimate_order > 0 ? estimate_order : 5);
    return law;
}

static struct error_norm *error_norm_state(const struct layout *layout)
{
    size_t pairs = layout->pairs, size = layout_size(layout);
    if (size == 0 || size > (SIZE_MAX - sizeof(struct error_norm)) / (8 * sizeof(double))) return NULL;
    struct error_norm *w = block_alloc(sizeof *w + numbers(pairs, size) * sizeof(double));
    if (!w) return NULL;
    w->pairs = pairs;
    w->size = size;
    w->scale = w->memory;
    w->cap = w->scale + size;
    w->noise = w->cap + pairs;
    w->floor = w->noise + (size - pairs);
    w->before = w->floor + pairs;
    w->earlier = w->before + 3 * pairs;
    w->passing = w->earlier + 3 * pairs;
    w->fastest = w->passing + (size - pairs);
    w->slopes = w->fastest + (size - 2 * pairs);
    for (size_t i = 0; i < pairs; i++) w->cap[i] = layout->angle && layout->angle[i] ? 1.0 : INFINITY;
    return w;
}

gsl_odeiv2_control *error_norm_alloc(const struct layout *layout, double tolerance, struct step_law law)
{
    if (!(tolerance > 0)) return NULL;
    gsl_odeiv2_control *control = malloc(sizeof *control);
    struct error_norm *w = control ? error_norm_state(layout) : NULL;
    if (!w) {
        free(control);
        return NULL;
    }
    w->tolerance = tolerance;
    w->law = law;
    *control = (gsl_odeiv2_control){.type = &error_norm_type, .state = w};
    return control;
}
