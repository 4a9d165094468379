/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * One right-hand side of a chain of n rods beside a recursion written for this one chain.
 *
 * The rods are uniform, of length 1 and mass 1, pinned end to end; only gravity acts. The recursion by hand
 * is the articulated-body algorithm with everything known put in: two sweeps with a sine and a cosine a rod.
 * Both are run in turns, and the median of the ratios of neighbours is what counts.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "dynamics/state.h"

enum { most_rods = 512, pairs_of_runs = 15 };

/* ---- by hand */

struct rod {
    double c, s, omega;  /* of the absolute angle, from straight down */
    double fx, fy;       /* what the rest of the chain asks of the joint, less its inertia */
    double hx, hy, J, u; /* at the joint */
};

/* q and v are those of fbd: relative angles. The acceleration of each joint goes to a. */
static void chain_by_hand(int n, const double *q, const double *v, struct rod *rods, double *a)
{
    const double g = 9.81, I_O = 1.0 / 3;
    double angle = 0, omega = 0, ax = 0, ay = 0;
    double xx = 0, xy = 0, yy = 0, px = 0, py = 0; /* of the part that hangs on the rod */
    for (int i = 0; i < n; i++) {
        angle += q[i];
        omega += v[i];
        rods[i].c = cos(angle);
        rods[i].s = sin(angle);
        rods[i].omega = omega;
    }
    /* A rod points along d = (s, -c). The part below passes M a + p at its end, d away; with k x d = (c, s):
     * a_end = a + alpha (c, s) - omega^2 d. */
    for (int i = n - 1; i >= 0; i--) {
        struct rod *r = &rods[i];
        double c = r->c, s = r->s, w2 = r->omega * r->omega;
        double bx = -w2 * s, by = w2 * c;
        double qx = px + xx * bx + xy * by, qy = py + xy * bx + yy * by;
        double tx = xx * c + xy * s, ty = xy * c + yy * s;
        r->J = I_O + tx * c + ty * s;
        r->hx = tx + 0.5 * c;
        r->hy = ty + 0.5 * s;
        double fx = qx + 0.5 * bx, fy = qy + 0.5 * by + g, moment = c * qx + s * qy + 0.5 * s * g;
        r->u = -moment / r->J;
        px = fx + r->hx * r->u;
        py = fy + r->hy * r->u;
        double kx = r->hx / r->J, ky = r->hy / r->J;
        xx += 1 - kx * r->hx;
        xy -= kx * r->hy;
        yy += 1 - ky * r->hy;
    }
    double before = 0;
    for (int i = 0; i < n; i++) {
        struct rod *r = &rods[i];
        double alpha = r->u - (r->hx * ax + r->hy * ay) / r->J, w2 = r->omega * r->omega;
        a[i] = alpha - before;
        before = alpha;
        ax += alpha * r->c - w2 * r->s;
        ay += alpha * r->s + w2 * r->c;
    }
}

/* ---- the same chain as a model */

static fbd_model *chain_model(int n)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out) return NULL;
    fprintf(out, "fbd: 1\nbodies:\n");
    for (int i = 0; i < n; i++) {
        fprintf(out,
                "  r%d: {mass: 1, shape: rod, from: [0, 0], to: [0, -1], forces: [gravity], motion: ", i);
        if (i == 0)
            fprintf(out, "pivot}\n");
        else
            fprintf(out, "{pivot: {on: r%d, at: right, point: left}}}\n", i - 1);
    }
    fclose(out);
    fbd_errors *errors = fbd_errors_new();
    fbd_model *model = fbd_model_parse(text, size, "chain", NULL, 0, errors);
    if (!model) fbd_errors_print(errors, stderr);
    fbd_errors_free(errors);
    free(text);
    return model;
}

static double now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, ascending);
    return values[count / 2];
}

static void bench(int n)
{
    static double y[2 * most_rods], f[2 * most_rods], a[most_rods];
    static struct rod rods[most_rods];
    double ours[pairs_of_runs], ratio[pairs_of_runs], worst = 0;
    fbd_model *model = chain_model(n);
    struct fbd_state *state = model ? state_new(model) : NULL;
    if (!state) exit(1);
    for (int i = 0; i < n; i++) {
        y[i] = 0.3 * sin(1.7 * i);
        y[n + i] = 0.5 * cos(2.3 * i);
    }
    struct instant at = state_instant(state);
    at.y = y;
    int turns = 400000 / n + 1;
    for (int k = 0; k < pairs_of_runs; k++) {
        double start = now();
        for (int turn = 0; turn < turns; turn++) state_rates(model, &at, state->slots, f);
        double middle = now();
        for (int turn = 0; turn < turns; turn++) chain_by_hand(n, y, y + n, rods, a);
        double end = now();
        ours[k] = (middle - start) / turns;
        ratio[k] = (middle - start) / (end - middle);
    }
    for (int i = 0; i < n; i++) worst = fmax(worst, fabs(a[i] - f[n + i]) / (1 + fabs(a[i])));
    printf("%5d rods  %8.1f ns  %6.1f ns a rod  %5.2f times by hand  (accelerations differ by %.1e)\n", n,
           1e9 * median(ours, pairs_of_runs), 1e9 * median(ours, pairs_of_runs) / n,
           median(ratio, pairs_of_runs), worst);
    state_free(state);
    fbd_model_free(model);
}

int main(void)
{
    for (int n = 1; n <= most_rods; n *= 2) bench(n);
}
