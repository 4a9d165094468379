/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "solve/system.h"

#include <gsl/gsl_errno.h>
#include <math.h>

/* Zero times a sum is zero unless an infinity or a NaN is among its terms; the search is for the rare case.
 */
static int check(struct counted_system *system, int code, double t, const double *values, size_t count)
{
    if (code == GSL_SUCCESS) {
        double probe = 0;
        for (size_t i = 0; i < count; i++) probe += 0 * values[i];
        if (probe == 0) return GSL_SUCCESS;
        code = system_not_finite;
        system->last_element = 0;
        while (isfinite(values[system->last_element])) system->last_element++;
    }
    system->last_code = code;
    system->last_time = t;
    return code;
}

static int counted_rhs(double t, const double y[], double dydt[], void *params)
{
    struct counted_system *system = params;
    system->rhs++;
    int code = system->inner.function(t, y, dydt, system->inner.params);
    return check(system, code, t, dydt, system->inner.dimension);
}

static int counted_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    struct counted_system *system = params;
    size_t n = system->inner.dimension;
    system->jacobians++;
    int code = system->inner.jacobian(t, y, dfdy, dfdt, system->inner.params);
    return check(system, code, t, dfdy, n * n);
}

void counted_system_init(struct counted_system *system, const gsl_odeiv2_system *inner)
{
    *system = (struct counted_system){.inner = *inner};
    system->gsl = (gsl_odeiv2_system){.function = counted_rhs,
                                      .jacobian = inner->jacobian ? counted_jacobian : NULL,
                                      .dimension = inner->dimension,
                                      .params = system};
}

int counted_system_rhs(struct counted_system *system, double t, const double *y, double *dydt)
{
    return counted_rhs(t, y, dydt, system);
}
