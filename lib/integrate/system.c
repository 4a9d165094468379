/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "integrate/system.h"

static int note(struct counted_system *system, int code, double t)
{
    system->last_code = code;
    system->last_time = t;
    return code;
}

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

/* The rare case: either a slope is not finite, or their sum overflows. */
int counted_system_note(struct counted_system *system, int code, double t, const double *dydt)
{
    if (code != GSL_SUCCESS) return note(system, code, t);
    return search(system, t, dydt, system->inner.dimension);
}

int counted_system_function(double t, const double y[], double dydt[], void *params)
{
    struct counted_system *system = params;
    return counted_system_eval(&system->gsl, system->inner.dimension, t, y, dydt);
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
    system->gsl = (gsl_odeiv2_system){.function = counted_system_function,
                                      .jacobian = inner->jacobian ? counted_jacobian : NULL,
                                      .dimension = inner->dimension,
                                      .params = system};
}

int counted_system_rhs(struct counted_system *system, double t, const double *y, double *dydt)
{
    return counted_system_function(t, y, dydt, system);
}
