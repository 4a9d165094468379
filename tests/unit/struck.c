/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "struck.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <math.h>

void struck_check(double actual, double expected, double tolerance)
{
    if (fabs(actual - expected) <= tolerance) return;
    fail_msg("%.15g, expected %.15g, off by %.3g of %.3g", actual, expected, fabs(actual - expected),
             tolerance);
}

void struck_set_answers(struct scene *scene)
{
    int n = 2 * scene->points;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            scene->W[i * n + j] = 0;
            for (int k = 0; k < scene->coordinates; k++)
                scene->W[i * n + j] += scene->J[i][k] * scene->w[k] * scene->J[j][k];
        }
}

double struck_energy(const struct scene *scene)
{
    double sum = 0;
    for (int k = 0; k < scene->coordinates; k++) sum += scene->v[k] * scene->v[k] / scene->w[k] / 2;
    return sum;
}

double struck_speed(const struct scene *scene, int row)
{
    double v = 0;
    for (int k = 0; k < scene->coordinates; k++) v += scene->J[row][k] * scene->v[k];
    return v;
}

long struck_in_turn;
bool struck_several;

enum impacts_end strike(struct scene *scene, enum impact_law law, bool one_after_the_other, double *v,
                        double *P, double *work)
{
    struck_set_answers(scene);
    for (int i = 0; i < 2 * scene->points; i++) v[i] = struck_speed(scene, i);
    for (int i = 0; i < scene->points; i++) scene->laws[i].law = law;
    struct impacts impacts = {.count = scene->points,
                              .propagate = one_after_the_other,
                              .points = scene->laws,
                              .W = scene->W,
                              .v = v,
                              .P = P};
    enum impacts_end end = impacts_solve(&impacts);
    for (int k = 0; k < scene->coordinates; k++)
        for (int i = 0; i < 2 * scene->points; i++) scene->v[k] += scene->w[k] * scene->J[i][k] * P[i];
    *work = impacts.work;
    struck_in_turn += impacts.in_turn;
    struck_several = impacts.several;
    assert_false(impacts.in_turn && (one_after_the_other || impact_by_velocity(law)));
    return end;
}
