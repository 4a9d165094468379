/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * FMI 3.0: life cycle of an instance, steps of co-simulation, saved states.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi/derivative.h"
#include "fmi/fmi3.h"
#include "fmi/instance.h"

/* NOLINTBEGIN(readability-non-const-parameter,readability-function-size): the standard dictates the parameters. */

const char *fmi3GetVersion(void)
{
    return "3.0";
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean on, size_t count,
                               const fmi3String categories[])
{
    if (!instance_allows(instance, phase_any, "fmi3SetDebugLogging")) return fmi3Error;
    return (fmi3Status)instance_set_logging(instance, on, count, categories);
}

/* ---- instantiation */

static void log_message(const struct instance *instance, enum instance_status status, const char *category,
                        const char *message)
{
    fmi3LogMessageCallback callback = (fmi3LogMessageCallback)instance->callback;
    if (callback) callback(instance->environment, (fmi3Status)status, category, message);
}

static const char other_kind[] = "this FMU is for co-simulation and model exchange only";

static void refuse(fmi3LogMessageCallback callback, fmi3Boolean logging, fmi3InstanceEnvironment environment,
                   const char *why)
{
    if (callback && logging) callback(environment, fmi3Error, log_category_names[log_error], why);
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback callback, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    (void)name, (void)token, (void)resources, (void)visible, (void)update, (void)lock, (void)unlock;
    refuse(callback, logging, environment, other_kind);
    return NULL;
}

/* An instance that is not opened yet; NULL when memory is out. */
static struct instance *make_instance(fmi3Boolean logging, fmi3InstanceEnvironment environment,
                                      fmi3LogMessageCallback callback)
{
    struct instance *instance = calloc(1, sizeof *instance);
    if (!instance) {
        refuse(callback, logging, environment, "out of memory");
        return NULL;
    }
    instance->log = log_message;
    instance->callback = (void (*)(void))callback;
    instance->environment = environment;
    for (int k = 0; k < log_categories; k++) instance->logs[k] = logging;
    return instance;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback callback)
{
    (void)visible;
    struct instance *instance = make_instance(logging, environment, callback);
    if (instance && instance_open_exchange(instance, name, resources, token)) return instance;
    free(instance);
    return NULL;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                         fmi3Boolean early_return, const fmi3ValueReference intermediate[],
                                         size_t intermediate_count, fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback callback,
                                         fmi3IntermediateUpdateCallback update)
{
    (void)visible, (void)intermediate, (void)intermediate_count, (void)update;
    struct instance *instance = make_instance(logging, environment, callback);
    if (instance) {
        instance->event_mode = event_mode;
        instance->early_return = early_return;
    }
    if (instance && instance_open(instance, name, resources, token)) return instance;
    free(instance);
    return NULL;
}

void fmi3FreeInstance(fmi3Instance instance)
{
    if (!instance) return;
    instance_close(instance);
    free(instance);
}

/* ---- state machine */

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance,
                                       fmi3Float64 tolerance, fmi3Float64 start, fmi3Boolean has_stop,
                                       fmi3Float64 stop)
{
    if (!instance_allows(instance, phase_instantiated, "fmi3EnterInitializationMode")) return fmi3Error;
    return (fmi3Status)instance_initialize(instance, start, has_stop ? stop : NAN,
                                           has_tolerance ? tolerance : 0);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    if (!instance_allows(instance, phase_initialization, "fmi3ExitInitializationMode")) return fmi3Error;
    return (fmi3Status)instance_begin(instance);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance)
{
    const struct instance *own = instance;
    const enum phase from = own && own->continuous ? phase_continuous : phase_step;
    return (fmi3Status)instance_change(instance, from, phase_event, "fmi3EnterEventMode");
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance)
{
    return (fmi3Status)instance_change(instance, phase_event, phase_step, "fmi3EnterStepMode");
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *again, fmi3Boolean *terminate,
                                    fmi3Boolean *nominals, fmi3Boolean *values, fmi3Boolean *has_next,
                                    fmi3Float64 *next)
{
    if (!instance_allows(instance, phase_event, "fmi3UpdateDiscreteStates")) return fmi3Error;
    struct continuous_event event = {.next = NAN};
    const fmi3Status status = (fmi3Status)instance_update(instance, "fmi3UpdateDiscreteStates", &event);
    if (again) *again = false;
    if (terminate) *terminate = event.ends;
    if (nominals) *nominals = false;
    if (values) *values = event.jumps;
    if (has_next) *has_next = !isnan(event.next);
    if (next) *next = isnan(event.next) ? 0 : event.next;
    return status;
}

fmi3Status fmi3Terminate(fmi3Instance instance)
{
    if (!instance_allows(instance, phase_running, "fmi3Terminate")) return fmi3Error;
    struct instance *own = instance;
    own->phase = phase_terminated;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    if (!instance_allows(instance, phase_any, "fmi3Reset")) return fmi3Error;
    return (fmi3Status)instance_reset(instance);
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 t, fmi3Float64 h, fmi3Boolean never_back,
                      fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early, fmi3Float64 *reached)
{
    (void)never_back;
    if (!instance_allows(instance, phase_step, "fmi3DoStep")) return fmi3Error;
    if (!event || !terminate || !early || !reached)
        return (fmi3Status)instance_fail(instance, "fmi3DoStep", "there is no place for an answer");
    struct instance_step step;
    fmi3Status status = (fmi3Status)instance_step(instance, t, h, &step);
    *event = step.event;
    *terminate = step.terminate;
    *early = step.early;
    *reached = step.reached;
    return status;
}

/* ---- saved states */

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    if (!instance_allows(instance, phase_any, "fmi3GetFMUState")) return fmi3Error;
    if (!state) return (fmi3Status)instance_fail(instance, "fmi3GetFMUState", "there is no place for it");
    struct saved *saved = *state;
    fmi3Status status = (fmi3Status)saved_get(instance, &saved);
    *state = saved;
    return status;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state)
{
    if (!instance_allows(instance, phase_any, "fmi3SetFMUState")) return fmi3Error;
    return (fmi3Status)saved_set(instance, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *state)
{
    if (!instance_allows(instance, phase_any, "fmi3FreeFMUState")) return fmi3Error;
    if (!state) return fmi3OK;
    free(*state);
    *state = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state, size_t *size)
{
    const char *function = "fmi3SerializedFMUStateSize";
    if (!instance_allows(instance, phase_any, function)) return fmi3Error;
    if (!state || !size)
        return (fmi3Status)instance_fail(instance, function, "there is no state, or no place for it");
    *size = saved_size(state);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    const char *function = "fmi3SerializeFMUState";
    if (!instance_allows(instance, phase_any, function)) return fmi3Error;
    if (!state || !bytes || size < saved_size(state))
        return (fmi3Status)instance_fail(instance, function, "there is no state, or no room for it");
    memcpy(bytes, saved_bytes(state), saved_size(state));
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state)
{
    const char *function = "fmi3DeserializeFMUState";
    if (!instance_allows(instance, phase_any, function)) return fmi3Error;
    struct saved *saved = state ? saved_from_bytes(bytes, size) : NULL;
    if (!saved) return (fmi3Status)instance_fail(instance, function, "these bytes are no saved state");
    free(*state);
    *state = saved;
    return fmi3OK;
}

/* ---- derivatives */

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                        size_t unknown_count, const fmi3ValueReference knowns[],
                                        size_t known_count, const fmi3Float64 seed[], size_t seed_count,
                                        fmi3Float64 sensitivity[], size_t sensitivity_count)
{
    const char *function = "fmi3GetDirectionalDerivative";
    if (!instance_allows(instance, phase_begun, function)) return fmi3Error;
    if (seed_count != known_count || sensitivity_count != unknown_count)
        return (fmi3Status)instance_fail(instance, function,
                                         "the numbers of variables and of values are not the same");
    struct derivative_call call = {function,    unknowns, unknown_count, knowns,
                                   known_count, seed,     sensitivity,   false};
    return (fmi3Status)derivative_get(instance, &call);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t unknown_count, const fmi3ValueReference knowns[],
                                    size_t known_count, const fmi3Float64 seed[], size_t seed_count,
                                    fmi3Float64 sensitivity[], size_t sensitivity_count)
{
    const char *function = "fmi3GetAdjointDerivative";
    if (!instance_allows(instance, phase_begun, function)) return fmi3Error;
    if (seed_count != unknown_count || sensitivity_count != known_count)
        return (fmi3Status)instance_fail(instance, function,
                                         "the numbers of variables and of values are not the same");
    struct derivative_call call = {function,    unknowns, unknown_count, knowns,
                                   known_count, seed,     sensitivity,   true};
    return (fmi3Status)derivative_get(instance, &call);
}

/* NOLINTEND(readability-non-const-parameter,readability-function-size) */
