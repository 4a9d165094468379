/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * FMI 2.0: functions of model exchange.
 */
#include <math.h>

#include "fmi/fmi2.h"
#include "fmi/instance.h"

/* NOLINTBEGIN(readability-non-const-parameter): the standard dictates the parameters. */

fmi2Status fmi2EnterEventMode(fmi2Component component)
{
    return (fmi2Status)instance_change(component, phase_continuous, phase_event, "fmi2EnterEventMode");
}

fmi2Status fmi2NewDiscreteStates(fmi2Component component, fmi2EventInfo *info)
{
    struct continuous_event event = {.next = NAN};
    if (!instance_allows(component, phase_event, "fmi2NewDiscreteStates")) return fmi2Error;
    if (!info)
        return (fmi2Status)instance_fail(component, "fmi2NewDiscreteStates",
                                         "there is no place for an answer");
    const fmi2Status status = (fmi2Status)instance_update(component, "fmi2NewDiscreteStates", &event);
    *info = (fmi2EventInfo){.terminateSimulation = event.ends,
                            .valuesOfContinuousStatesChanged = event.jumps,
                            .nextEventTimeDefined = !isnan(event.next),
                            .nextEventTime = isnan(event.next) ? 0 : event.next};
    return status;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component component)
{
    return (fmi2Status)instance_change(component, phase_event, phase_continuous,
                                       "fmi2EnterContinuousTimeMode");
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component component, fmi2Boolean never_back, fmi2Boolean *event,
                                       fmi2Boolean *terminate)
{
    (void)never_back;
    bool happens = false;
    const fmi2Status status =
        (fmi2Status)instance_complete(component, "fmi2CompletedIntegratorStep", &happens);
    if (event) *event = happens;
    if (terminate) *terminate = fmi2False;
    return status;
}

fmi2Status fmi2SetTime(fmi2Component component, fmi2Real time)
{
    return (fmi2Status)instance_set_time(component, "fmi2SetTime", time);
}

fmi2Status fmi2SetContinuousStates(fmi2Component component, const fmi2Real states[], size_t count)
{
    return (fmi2Status)instance_set_states(component, "fmi2SetContinuousStates", states, count);
}

fmi2Status fmi2GetContinuousStates(fmi2Component component, fmi2Real states[], size_t count)
{
    return (fmi2Status)instance_get_states(component, "fmi2GetContinuousStates", states, count);
}

fmi2Status fmi2GetDerivatives(fmi2Component component, fmi2Real derivatives[], size_t count)
{
    return (fmi2Status)instance_get_derivatives(component, "fmi2GetDerivatives", derivatives, count);
}

fmi2Status fmi2GetEventIndicators(fmi2Component component, fmi2Real indicators[], size_t count)
{
    return (fmi2Status)instance_get_indicators(component, "fmi2GetEventIndicators", indicators, count);
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component component, fmi2Real nominals[], size_t count)
{
    return (fmi2Status)instance_get_nominals(component, "fmi2GetNominalsOfContinuousStates", nominals, count);
}

/* NOLINTEND(readability-non-const-parameter) */
