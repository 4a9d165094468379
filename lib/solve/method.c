/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/method.h"

#include <string.h>

#include "solve/dop853.h"
#include "solve/rodas5p.h"

/* The orders are measured ones (tests/unit/test_stepper.c): GSL's rk2 gives the result of its formula of
 * order 3. So are the limits of stability; dop853 looks after its own. */
static const struct method methods[] = {
    {"dop853", "explicit Runge-Kutta, Dormand-Prince 8(5,3), dense output of order 7", &step_dop853, 8, 8,
     false, false, false, 0},
    {"rodas5p", "Rosenbrock of order 5(4), L-stable, dense output of order 4, for stiff systems",
     &step_rodas5p, 5, 5, true, false, false, 0},
    {"rk8pd", "explicit Runge-Kutta, Prince-Dormand 8(7)", &gsl_odeiv2_step_rk8pd, 8, 8, false, false, false,
     5.167},
    {"rkf45", "explicit Runge-Kutta-Fehlberg 4(5)", &gsl_odeiv2_step_rkf45, 5, 5, false, false, false, 3.678},
    {"rkck", "explicit Runge-Kutta, Cash-Karp 4(5)", &gsl_odeiv2_step_rkck, 5, 5, false, false, false, 3.735},
    {"rk4", "classical Runge-Kutta of order 4, error by step doubling", &gsl_odeiv2_step_rk4, 4, 5, false,
     false, false, 5.571},
    {"rk2", "explicit Runge-Kutta 2(3)", &gsl_odeiv2_step_rk2, 3, 3, false, false, false, 2.513},
    {"msadams", "Adams multistep in Nordsieck form, orders 1 to 12", &gsl_odeiv2_step_msadams, 12, 0, false,
     true, true, 2},
    {"msbdf", "backward differentiation multistep in Nordsieck form, orders 1 to 5, for stiff systems",
     &gsl_odeiv2_step_msbdf, 5, 0, true, true, true, 0},
    {"bsimp", "implicit extrapolation of Bader and Deuflhard, order 12, for stiff systems",
     &gsl_odeiv2_step_bsimp, 12, 13, true, false, false, 0},
    {"rk4imp", "Gauss implicit Runge-Kutta of order 4", &gsl_odeiv2_step_rk4imp, 4, 5, true, false, true, 0},
    {"rk2imp", "implicit midpoint rule, order 2", &gsl_odeiv2_step_rk2imp, 2, 3, true, false, true, 0},
    {"rk1imp", "implicit Euler, order 1", &gsl_odeiv2_step_rk1imp, 1, 2, true, false, true, 0},
};

const struct method *method_at(size_t index)
{
    return index < sizeof methods / sizeof *methods ? &methods[index] : NULL;
}

const struct method *method_find(const char *name)
{
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++)
        if (strcmp(methods[i].name, name) == 0) return &methods[i];
    return NULL;
}
