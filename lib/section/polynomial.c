/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "section/polynomial.h"

#include <math.h>

double polynomial_at(const struct polynomial *p, double t)
{
    double sum = 0;
    for (int i = polynomial_most; i >= 0; i--) sum = sum * t + p->a[i];
    return sum;
}

void polynomial_add(struct polynomial *p, double factor, const struct polynomial *q)
{
    for (int i = 0; i <= polynomial_most; i++) p->a[i] += factor * q->a[i];
}

struct polynomial polynomial_product(const struct polynomial *p, const struct polynomial *q)
{
    struct polynomial product = {{0}};
    for (int i = 0; i <= polynomial_most; i++)
        for (int k = 0; i + k <= polynomial_most; k++) product.a[i + k] += p->a[i] * q->a[k];
    return product;
}

struct polynomial polynomial_derivative(const struct polynomial *p)
{
    struct polynomial derivative = {{0}};
    for (int i = 1; i <= polynomial_most; i++) derivative.a[i - 1] = i * p->a[i];
    return derivative;
}

struct polynomial polynomial_integral(const struct polynomial *p, double start)
{
    struct polynomial integral = {{0}};
    for (int i = 1; i <= polynomial_most; i++) integral.a[i] = p->a[i - 1] / i;
    integral.a[0] = start - polynomial_at(&integral, -1);
    return integral;
}

/* ---- interpolation */

/* By the values at the nodes, the coefficients of Chebyshev's polynomials T_k, and these in powers of t by
 * T_{k+1} = 2 t T_k - T_{k-1}. */
struct polynomial polynomial_fit(double (*f)(double t, void *context), void *context)
{
    enum { nodes = polynomial_fitted + 1 };
    const double pi = 3.14159265358979323846;
    double value[nodes];
    for (int j = 0; j < nodes; j++) value[j] = f(cos(pi * (j + 0.5) / nodes), context);
    struct polynomial fitted = {{0}}, before = {{0}}, T = {{1}};
    const struct polynomial twice_t = {{0, 2}};
    for (int k = 0; k < nodes; k++) {
        double c = 0;
        for (int j = 0; j < nodes; j++) c += value[j] * cos(pi * k * (j + 0.5) / nodes);
        polynomial_add(&fitted, c * (k == 0 ? 1. : 2.) / nodes, &T);
        struct polynomial next = polynomial_product(&twice_t, &T);
        polynomial_add(&next, k == 0 ? 0 : -1, &before);
        if (k == 0) next.a[1] = 1;
        before = T;
        T = next;
    }
    return fitted;
}

/* ---- roots */

/* A root of p between two places where its signs differ. */
static double bisect(const struct polynomial *p, double low, double high)
{
    const bool rises = polynomial_at(p, high) > 0;
    for (int i = 0; i < 200; i++) {
        const double middle = low + (high - low) / 2;
        if (middle == low || middle == high) break;
        if ((polynomial_at(p, middle) > 0) == rises)
            high = middle;
        else
            low = middle;
    }
    return low + (high - low) / 2;
}

/* Find the roots of p where those of its derivative, and the ends, are known. */
static int roots_between(const struct polynomial *p, const double *turns, int turn_count,
                         double roots[polynomial_most])
{
    int count = 0;
    double low = -1, a = polynomial_at(p, low);
    for (int i = 0; i <= turn_count; i++) {
        const double high = i < turn_count ? turns[i] : 1, b = polynomial_at(p, high);
        if (b == 0) continue; /* the sign does not change there, or it does between its neighbours */
        if (((a < 0 && b > 0) || (a > 0 && b < 0)) && count < polynomial_most)
            roots[count++] = bisect(p, low, high);
        low = high;
        a = b;
    }
    return count;
}

int polynomial_roots(const struct polynomial *p, double roots[polynomial_most])
{
    struct polynomial derivatives[polynomial_most + 1];
    double turns[polynomial_most];
    int count = 0;
    derivatives[0] = *p;
    for (int i = 1; i <= polynomial_most; i++) derivatives[i] = polynomial_derivative(&derivatives[i - 1]);
    for (int i = polynomial_most; i >= 0; i--) {
        for (int k = 0; k < count; k++) turns[k] = roots[k];
        count = roots_between(&derivatives[i], turns, count, roots);
    }
    return count;
}
