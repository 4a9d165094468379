/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/stiffness.h"
#include "numeric/tolerances.h"

#include <math.h>

enum { shortest_interval = 8, longest_interval = 64, steps_to_confirm = 3, votes_needed = 2 };

/* A step of rodas5p takes 8 evaluations, a Jacobian and a decomposition, one of rk8pd 13 evaluations: in
 * small systems up to twice the time. So the switch to rodas5p requires more gain than the switch back. The
 * product of both is above 1; otherwise an intermediate motion could switch back and forth. */
static const double gain_for_implicit = 1.8, gain_for_explicit = 1.2;

/* Well within the limit of stability, as the steps of the explicit method are longer. */
static const double h_rate_for_explicit = 3;

/* Limit of h_rate when the explicit method's attempt has no error above rounding. Such an attempt does not
 * predict the error of longer steps; but if even the fastest rate is slow compared with the step, longer
 * steps will follow and the implicit method is not needed. Near a singular position of a mechanism both
 * methods make short steps; without this rule the attempts of dop853 behind it were always too short to have
 * an error. */
static const double h_rate_without_error = 1;

/* The shortest and the longest wait: an attempt by rodas5p costs as much as so many steps. */
static int waits(const struct stiffness *s, int steps)
{
    return s->implicit ? steps : (int)(steps * s->dear);
}

static void wait_shortly(struct stiffness *s)
{
    s->votes = 0;
    s->interval = waits(s, shortest_interval);
}

void stiffness_start(struct stiffness *s, size_t coordinates)
{
    *s = (struct stiffness){.dear = fmax(1, ((double)coordinates + 2) / 6)};
    wait_shortly(s);
    s->wait = s->interval;
}

void stiffness_forget(struct stiffness *s)
{
    wait_shortly(s);
    if (s->wait > s->interval) s->wait = s->interval;
}

/* h_rate measured with rk8pd, tolerances of 1e-4 to 1e-10: 0.6 to 4 in stiff motion, up to 0.5 below 1e-6 in
 * motions that have to be followed. The rate is detected only in components that differ between two stages,
 * so attempts are not put off forever. */
bool stiffness_due(struct stiffness *s, double h_rate)
{
    enum { most_waits = 4 };
    const double slow = 0.5;
    if (s->wait > 0) s->wait--;
    if (s->wait > 0) return false;
    bool calm = !s->implicit && h_rate<slow, large = s->dear> 1;
    if (calm && ++s->calm < (large ? waits(s, longest_interval) : most_waits)) {
        if (!large) s->wait = s->interval;
        return false;
    }
    s->calm = 0;
    return true;
}

double stiffness_stride(const struct stiffness *s)
{
    return s->implicit ? 1 / s->dear : s->dear;
}

/* A ratio of zero is no evidence: for a body at rest or in free flight every method is without error. */
static bool gains(double ratio, int estimate_order, double gain)
{
    return ratio > 0 && pow(ratio, -1.0 / estimate_order) > gain;
}

/* Oscillations that have to be followed have ratios of 3 and more; steps near the limit of stability vary by
 * a factor of two, so that stiff motion may have a ratio of 6 as well. */
bool stiffness_doubts(const struct stiffness *s, double ratio, int estimate_order)
{
    const double most = 32;
    return !s->implicit && ratio > 0 && ratio < most && !gains(ratio, estimate_order, gain_for_implicit);
}

bool stiffness_decide(struct stiffness *s, double ratio, int estimate_order, double h_rate)
{
    bool better = gains(ratio, estimate_order, s->implicit ? gain_for_explicit : gain_for_implicit);
    if (s->implicit && ratio == 0) better = h_rate < h_rate_without_error;
    if (s->implicit && !(h_rate < h_rate_for_explicit)) better = false;
    if (!better) {
        s->votes = 0;
        s->wait = s->interval;
        if (s->interval < waits(s, longest_interval)) s->interval *= 2;
        return false;
    }
    s->wait = steps_to_confirm;
    if (++s->votes < votes_needed) return false;
    s->implicit = !s->implicit;
    wait_shortly(s);
    s->wait = s->interval;
    return true;
}

/* The largest |lambda| of J is at most that of |J|, and this is at most max_i (|J| x)_i / x_i for every x > 0
 * (Collatz, Wielandt), which does not depend on the units of the components. The best x is approached by
 * geometric means of x and |J| x; plain power iteration would cycle for q' = v, v' = -k q. Every round takes
 * the square root of the distance; the start may be wrong by many powers of ten. */
double stiffness_rate(size_t n, const double *jacobian, double *work)
{
    enum { rounds = 12 };
    double *x = work, *image = work + n, rate = 0;
    for (size_t i = 0; i < n; i++) x[i] = 1;
    for (int round = 0; round < rounds; round++) {
        rate = 0;
        for (size_t i = 0; i < n; i++) {
            image[i] = 0;
            for (size_t j = 0; j < n; j++) image[i] += fabs(jacobian[i * n + j]) * x[j];
            if (!(image[i] <= rate * x[i])) rate = image[i] / x[i];
        }
        if (!(rate > 0 && rate < INFINITY)) return rate;
        /* A component with a zero row would go to zero. */
        for (size_t i = 0; i < n; i++) x[i] = sqrt(x[i] * fmax(image[i] / rate, least_growth * x[i]));
    }
    return rate;
}
