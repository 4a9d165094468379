/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/system.h"

#include <gsl/gsl_errno.h>
#include <math.h>

static int note(struct counted_system *system, int code, double t)
{
    system->last_code = code;
    system->last_time = t;
    return code;
}

/* The rare case: the sum of the values is not finite. Either one of them is not, or their sum overflows. */
static int search(struct counted_system *system, double t, const double *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(values[i])) {
            system->last_element = i;
            system->last_value = values[i];
            return note(system, system_not_finite, t);
        }
    }
    return GSL_SUCCESS;
}

/* One addition for each value, as this is in the innermost loop. */
static inline double sum_of(const double *values, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += values[i];
    return sum;
}

static int counted_rhs(double t, const double y[], double dydt[], void *params)
{
    struct counted_system *system = params;
    system->rhs++;
    int code = system->inner.function(t, y, dydt, system->inner.params);
    if (code != GSL_SUCCESS) return note(system, code, t);
    size_t n = system->inner.dimension;
    return isfinite(sum_of(dydt, n)) ? GSL_SUCCESS : search(system, t, dydt, n);
}

static int counted_jacobian(double t, const double y[], double *dfdy, double dfdt[], void *params)
{
    struct counted_system *system = params;
    system->jacobians++;
    int code = system->inner.jacobian(t, y, dfdy, dfdt, system->inner.params);
    if (code != GSL_SUCCESS) return note(system, code, t);
    return search(system, t, dfdy, system->inner.dimension * system->inner.dimension);
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
