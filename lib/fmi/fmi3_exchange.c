/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * FMI 3.0: functions of model exchange.
 */
#include "fmi/fmi3.h"
#include "fmi/instance.h"

/* NOLINTBEGIN(readability-non-const-parameter): the standard dictates the parameters. */

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance)
{
    return (fmi3Status)instance_change(instance, phase_event, phase_continuous,
                                       "fmi3EnterContinuousTimeMode");
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    return (fmi3Status)instance_set_time(instance, "fmi3SetTime", time);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 states[], size_t count)
{
    return (fmi3Status)instance_set_states(instance, "fmi3SetContinuousStates", states, count);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 states[], size_t count)
{
    return (fmi3Status)instance_get_states(instance, "fmi3GetContinuousStates", states, count);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[], size_t count)
{
    return (fmi3Status)instance_get_derivatives(instance, "fmi3GetContinuousStateDerivatives", derivatives,
                                                count);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 indicators[], size_t count)
{
    return (fmi3Status)instance_get_indicators(instance, "fmi3GetEventIndicators", indicators, count);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[], size_t count)
{
    return (fmi3Status)instance_get_nominals(instance, "fmi3GetNominalsOfContinuousStates", nominals, count);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *count)
{
    return (fmi3Status)instance_get_counts(instance, "fmi3GetNumberOfEventIndicators", NULL, count);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *count)
{
    return (fmi3Status)instance_get_counts(instance, "fmi3GetNumberOfContinuousStates", count, NULL);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean never_back, fmi3Boolean *event,
                                       fmi3Boolean *terminate)
{
    (void)never_back;
    bool happens = false;
    const fmi3Status status =
        (fmi3Status)instance_complete(instance, "fmi3CompletedIntegratorStep", &happens);
    if (event) *event = happens;
    if (terminate) *terminate = false;
    return status;
}

/* NOLINTEND(readability-non-const-parameter) */
