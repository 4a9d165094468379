/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/method.h"

#include <string.h>

#include "integrate/bdf.h"
#include "integrate/bsimp.h"
#include "integrate/implicit_rk.h"
#include "integrate/pair8.h"
#include "integrate/rodas5p.h"

/* The orders are measured (tests/unit/test_stepper.c): GSL's rk2 gives the result of its formula of order 3.
 * So are the limits of stability; rk8pd and dop853 have their own control of stability. */
static const struct method methods[] = {
    {.name = "rk8pd",
     .description = "explicit Runge-Kutta, Prince-Dormand 8(7)",
     .type = &step_rk8pd,
     .order = 8,
     .estimate_order = 8},
    {.name = "dop853",
     .description = "explicit Runge-Kutta, Dormand-Prince 8(5,3), dense output of order 7",
     .type = &step_dop853,
     .order = 8,
     .estimate_order = 8},
    {.name = "rodas5p",
     .description = "Rosenbrock of order 5(4), L-stable, dense output of order 4, for stiff systems",
     .type = &step_rodas5p,
     .order = 5,
     .estimate_order = 5,
     .by_time = 1.0 / 3,
     .implicit = true},
    {.name = "rkf45",
     .description = "explicit Runge-Kutta-Fehlberg 4(5)",
     .type = &gsl_odeiv2_step_rkf45,
     .order = 5,
     .estimate_order = 5,
     .stable = 3.678},
    {.name = "rkck",
     .description = "explicit Runge-Kutta, Cash-Karp 4(5)",
     .type = &gsl_odeiv2_step_rkck,
     .order = 5,
     .estimate_order = 5,
     .stable = 3.735},
    {.name = "rk4",
     .description = "classical Runge-Kutta of order 4, error by step doubling",
     .type = &gsl_odeiv2_step_rk4,
     .order = 4,
     .estimate_order = 5,
     .stable = 5.571},
    {.name = "rk2",
     .description = "explicit Runge-Kutta 2(3)",
     .type = &gsl_odeiv2_step_rk2,
     .order = 3,
     .estimate_order = 3,
     .stable = 2.513},
    {.name = "msadams",
     .description = "Adams multistep in Nordsieck form, orders 1 to 12",
     .type = &gsl_odeiv2_step_msadams,
     .order = 12,
     .multistep = true,
     .needs_driver = true,
     .stable = 2},
    {.name = "msbdf",
     .description = "backward differentiation multistep in Nordsieck form, orders 1 to 5, for stiff systems",
     .type = &step_msbdf,
     .order = 5,
     .implicit = true,
     .multistep = true,
     .needs_driver = true},
    {.name = "bsimp",
     .description = "implicit extrapolation of Bader and Deuflhard, order 12, for stiff systems",
     .type = &step_bsimp,
     .order = 12,
     .estimate_order = 13,
     .implicit = true},
    {.name = "rk4imp",
     .description = "Gauss implicit Runge-Kutta of order 4",
     .type = &step_rk4imp,
     .order = 4,
     .estimate_order = 5,
     .implicit = true,
     .needs_driver = true},
    {.name = "rk2imp",
     .description = "implicit midpoint rule, order 2",
     .type = &step_rk2imp,
     .order = 2,
     .estimate_order = 3,
     .implicit = true,
     .needs_driver = true},
    {.name = "rk1imp",
     .description = "implicit Euler, order 1",
     .type = &step_rk1imp,
     .order = 1,
     .estimate_order = 2,
     .implicit = true,
     .needs_driver = true},
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
