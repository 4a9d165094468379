/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * A hanging chain of sixteen rods whose wave has not yet come to the end.
 *
 * What makes it hard: the far rods are moved by the rounding of forces in the pins alone, which is no motion
 * to follow. A step size control that holds each rod to its own size took 68,000 steps where 320 do.
 *
 * Reference: at 1e-8 rad the chain is linear to the last digit. With absolute angles phi_i from straight
 * down, in units of m l^2 and m g l (Lagrange's equations, mass matrix c_ij = n - max(i, j) + 1/2, c_ii = n -
 * i + 1/3): c phi'' + (g/l) diag(n - i + 1/2) phi = 0. Modes by GSL's symmetric eigenproblem; all start at
 * rest.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <gsl/gsl_blas.h>
#include <gsl/gsl_eigen.h>

#include "hard.h"

enum { rods = 16 };

static const double start = 1e-8, g_over_l = 9.81 / 0.2, until = 1;

/* The pencil of masses and stiffnesses; i and j count from 0. */
static void fill(gsl_matrix *masses, gsl_matrix *stiffnesses)
{
    gsl_matrix_set_zero(stiffnesses);
    for (size_t i = 0; i < rods; i++) {
        for (size_t j = 0; j < rods; j++) {
            double below = (double)(rods - 1 - (i > j ? i : j));
            gsl_matrix_set(masses, i, j, below + (i == j ? 1.0 / 3 : 0.5));
        }
        gsl_matrix_set(stiffnesses, i, i, g_over_l * ((double)(rods - 1 - i) + 0.5));
    }
}

/* The angles at `until` of rods that were at `start` with equal signs; returns the fastest mode [rad/s]. */
static double swing(double phi[rods])
{
    gsl_matrix *masses = gsl_matrix_alloc(rods, rods), *stiffnesses = gsl_matrix_alloc(rods, rods);
    gsl_matrix *copy = gsl_matrix_alloc(rods, rods), *modes = gsl_matrix_alloc(rods, rods);
    gsl_vector *squares = gsl_vector_alloc(rods), *push = gsl_vector_alloc(rods);
    gsl_eigen_gensymmv_workspace *work = gsl_eigen_gensymmv_alloc(rods);
    fill(masses, stiffnesses);
    gsl_matrix_memcpy(copy, masses);
    assert_int_equal(gsl_eigen_gensymmv(stiffnesses, copy, squares, modes, work), GSL_SUCCESS);
    gsl_vector *all = gsl_vector_alloc(rods);
    gsl_vector_set_all(all, start);
    gsl_blas_dgemv(CblasNoTrans, 1, masses, all, 0, push);
    for (size_t i = 0; i < rods; i++) phi[i] = 0;
    for (size_t k = 0; k < rods; k++) { /* GSL scales modes to length 1 */
        gsl_vector_view mode = gsl_matrix_column(modes, k);
        double share, mass;
        gsl_blas_dgemv(CblasNoTrans, 1, masses, &mode.vector, 0, all);
        gsl_blas_ddot(&mode.vector, all, &mass);
        gsl_blas_ddot(&mode.vector, push, &share);
        double amplitude = share / mass * cos(sqrt(gsl_vector_get(squares, k)) * until);
        for (size_t i = 0; i < rods; i++) phi[i] += amplitude * gsl_vector_get(&mode.vector, i);
    }
    double fastest = sqrt(gsl_vector_max(squares));
    gsl_eigen_gensymmv_free(work);
    gsl_matrix_free(masses), gsl_matrix_free(stiffnesses), gsl_matrix_free(copy), gsl_matrix_free(modes);
    gsl_vector_free(squares), gsl_vector_free(push), gsl_vector_free(all);
    return fastest;
}

static double worst_angle(const struct trial *trial, const double phi[rods])
{
    double worst = 0, turned = 0;
    for (int i = 0; i < rods; i++) {
        char name[32];
        snprintf(name, sizeof name, "rod%d.theta", i + 1);
        turned += trial_get(trial, name);
        worst = fmax(worst, fabs(turned - phi[i]));
    }
    return worst;
}

/* The fastest mode makes fastest * until radians. No method of a fifth order or more needs 50 steps for each,
 * at these tolerances; followed to its rounding the chain takes thousands. */
static void the_far_rods_cost_nothing_before_the_wave_is_there(void **unused)
{
    (void)unused;
    struct checks checks = {0};
    struct hard_method method;
    double phi[rods], fastest = swing(phi);
    for (size_t i = 0; hard_method_at(i, &method); i++) {
        if (method.order == 1) continue; /* implicit Euler damps the wave away */
        struct trial trial = trial_open("hard/quiet_end.yaml", NULL);
        hard_start(&trial, &method, NAN);
        if (hard_done(&checks, &trial)) {
            hard_case(&checks, &trial, "angles, relative to the first", worst_angle(&trial, phi) / start,
                      hard_promise(&trial));
            unsigned long steps = fbd_simulation_stats(trial.simulation).steps;
            if (method.order >= 5)
                check_that(&checks, "steps follow the wave, not its rounding",
                           (double)steps < 50 * fastest * until);
        }
        trial_close(&trial);
    }
    checks_end(&checks);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_far_rods_cost_nothing_before_the_wave_is_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
