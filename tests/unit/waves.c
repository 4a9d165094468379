/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "waves.h"

#include <math.h>
#include <stdio.h>

/* x(t), its first derivative, and bounds of the first two. */
static double place(const struct waves *h, double t, double *rate, double *first, double *second)
{
    if (h->trajectory == along_oscillation) {
        *rate = -h->speed * sin(h->speed * t);
        *first = h->speed;
        *second = h->speed * h->speed;
        return cos(h->speed * t);
    }
    *rate = *first = h->trajectory == along_time ? 1 : h->speed;
    *second = 0;
    return *rate * t;
}

double waves_value(const struct waves *h, double t, double *slope, double *most)
{
    double rate, first, second, x = place(h, t, &rate, &first, &second), sum = -h->c;
    *slope = *most = 0;
    for (int k = 0; k < h->count; k++) {
        double phase = h->w[k] * x + h->p[k], a = fabs(h->a[k]);
        sum += h->a[k] * sin(phase);
        *slope += h->a[k] * h->w[k] * cos(phase) * rate;
        *most += a * h->w[k] * (h->w[k] * first * first + second);
    }
    return sum;
}

static double bisect(const struct waves *h, double low, double high)
{
    double slope, most, sign = waves_value(h, low, &slope, &most) < 0 ? -1 : 1;
    for (int k = 0; k < 200; k++) {
        double m = low + (high - low) / 2;
        if (!(m > low && m < high)) break;
        if (sign * waves_value(h, m, &slope, &most) > 0)
            low = m;
        else
            high = m;
    }
    return high;
}

void waves_find(const struct waves *h, double low, double high, struct zeros *zeros)
{
    double r = (high - low) / 2, m = low + r, slope, most, s, b;
    double v = waves_value(h, m, &slope, &most);
    if (fabs(v) > fabs(slope) * r + most * r * r / 2 + 1e-14) return;
    if (fabs(slope) > most * r * (1 + 1e-9)) {
        double from = waves_value(h, low, &s, &b), to = waves_value(h, high, &s, &b);
        zeros->doubtful |= fabs(from) < 1e-14 || fabs(to) < 1e-14;
        if ((from < 0) != (to < 0) && zeros->count < most_zeros)
            zeros->t[zeros->count++] = bisect(h, low, high);
        return;
    }
    if (r < 1e-11) {
        zeros->doubtful = true;
        return;
    }
    waves_find(h, low, m, zeros);
    waves_find(h, m, high, zeros);
}

double random_power(struct random_numbers *numbers, double low, double high)
{
    return low * pow(high / low, random_between(numbers, 0, 1));
}

struct waves waves_random(struct random_numbers *numbers, enum trajectory trajectory)
{
    struct waves h = {.trajectory = trajectory, .count = 1 + (int)(random_bits(numbers) % 3)};
    h.speed = random_between(numbers, 0.5, 4);
    for (int k = 0; k < h.count; k++) {
        h.a[k] = k == 0 ? 1 : random_between(numbers, -1, 1);
        h.w[k] = random_power(numbers, 0.5, trajectory == along_time ? 100 : 12);
        h.p[k] = random_between(numbers, -3, 3);
    }
    double gap = random_power(numbers, 1e-12, 1);
    bool crest = h.count == 1 && trajectory == along_time;
    h.c = crest ? (random_bits(numbers) % 2 ? 1 - gap : -1 + gap) : random_between(numbers, -1, 1);
    return h;
}

struct waves waves_near(struct random_numbers *numbers, double R)
{
    static const double beyond[] = {1e-2, 1e-3, 1e-4, -1e-4, -1e-3};
    double most = R * (1 + beyond[(int)random_between(numbers, 0, 4.999)]);
    struct waves h = {.count = 2, .c = R, .trajectory = along_time};
    for (int k = 0; k < 2; k++) {
        h.w[k] = k == 0 ? random_between(numbers, 1, 60) : random_between(numbers, 0.3, 8);
        h.p[k] = random_between(numbers, 0, 6.28);
    }
    h.a[0] = random_between(numbers, 0.2, 0.8) * most;
    h.a[1] = most - h.a[0];
    return h;
}

double waves_first(const struct waves *h, double until, bool both)
{
    static struct zeros zeros;
    struct waves other = *h;
    double first = HUGE_VAL;
    for (int k = 0; k < h->count; k++) other.a[k] = -h->a[k];
    for (int side = 0; side < 1 + both; side++) {
        zeros = (struct zeros){0};
        waves_find(side == 0 ? h : &other, 0, until, &zeros);
        if (zeros.count > 0) first = fmin(first, zeros.t[0]);
    }
    return first;
}

int waves_write(const struct waves *h, const char *argument, const char *unit, char *text, size_t size)
{
    int length = 0;
    for (int k = 0; k < h->count; k++)
        length += snprintf(text + length, size - (size_t)length, "%s(%.17g)*sin(%.17g[%s]*%s + (%.17g))",
                           k ? " + " : "", h->a[k], h->w[k], unit, argument, h->p[k]);
    return length;
}
