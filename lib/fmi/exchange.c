/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * Model exchange: the calls of both versions.
 */
#include <math.h>

#include "fmi/instance.h"

enum instance_status instance_change(struct instance *instance, enum phase from, enum phase to,
                                     const char *function)
{
    if (!instance_allows(instance, from, function)) return instance_error;
    const bool continuous = instance->continuous != NULL;
    if (((from | to) & phase_continuous && !continuous) || ((from | to) & phase_step && continuous))
        return instance_fail(instance, function, "an instance of the other interface has this mode");
    if (!continuous && !instance->event_mode)
        return instance_fail(instance, function, "the importer has said that it uses no Event Mode");
    instance->phase = to;
    return instance_ok;
}

/* Is the call allowed, with these numbers, of which there are to be `count`? */
static bool allows(struct instance *instance, unsigned phases, const char *function, const double *numbers,
                   size_t count, size_t wanted)
{
    if (!instance_allows(instance, phases, function)) return false;
    const char *why = !instance->continuous                         ? "the instance is for co-simulation"
                      : count != wanted || (wanted > 0 && !numbers) ? "the number of values is another one"
                                                                    : NULL;
    if (why) instance_fail(instance, function, why);
    if (!why && continuous_ready(instance->continuous)) return true;
    if (!why) instance_fail(instance, function, instance->continuous->reason);
    return false;
}

static size_t states_of(const struct instance *instance)
{
    const fbd_model *model = instance ? instance->plant->first : NULL;
    return 2 * fbd_model_coordinate_count(model) + fbd_model_state_count(model);
}

static size_t indicators_of(const struct instance *instance)
{
    return instance ? instance->plant->extras.indicators : 0;
}

enum instance_status instance_set_time(struct instance *instance, const char *function, double t)
{
    if (!allows(instance, phase_continuous, function, &t, 1, 1)) return instance_error;
    if (!isfinite(t)) return instance_fail(instance, function, "the time is not finite");
    continuous_set_time(instance->continuous, t);
    return instance_ok;
}

enum instance_status instance_set_states(struct instance *instance, const char *function,
                                         const double *states, size_t count)
{
    if (!allows(instance, phase_continuous, function, states, count, states_of(instance)))
        return instance_error;
    continuous_set(instance->continuous, states);
    return instance_ok;
}

enum instance_status instance_get_states(struct instance *instance, const char *function, double *states,
                                         size_t count)
{
    if (!allows(instance, phase_begun, function, states, count, states_of(instance))) return instance_error;
    continuous_get(instance->continuous, states);
    return instance_ok;
}

/* A solver may try states at which a derivative is not finite: it takes a shorter step then. */
enum instance_status instance_get_derivatives(struct instance *instance, const char *function,
                                              double *derivatives, size_t count)
{
    if (!allows(instance, phase_begun, function, derivatives, count, states_of(instance)))
        return instance_error;
    if (continuous_derivatives(instance->continuous, derivatives)) return instance_ok;
    instance_say(instance, instance_discard, log_warning, "%s: %s", function, instance->continuous->reason);
    return instance_discard;
}

enum instance_status instance_get_indicators(struct instance *instance, const char *function,
                                             double *indicators, size_t count)
{
    if (!allows(instance, phase_begun, function, indicators, count, indicators_of(instance)))
        return instance_error;
    continuous_indicators(instance->continuous, indicators);
    return instance_ok;
}

/* Lengths in metres or feet, angles in radians: 1 is of the size of the states. */
enum instance_status instance_get_nominals(struct instance *instance, const char *function, double *nominals,
                                           size_t count)
{
    if (!allows(instance, phase_begun, function, nominals, count, states_of(instance))) return instance_error;
    for (size_t i = 0; i < count; i++) nominals[i] = 1;
    return instance_ok;
}

enum instance_status instance_get_counts(struct instance *instance, const char *function, size_t *states,
                                         size_t *indicators)
{
    if (!instance_allows(instance, phase_any, function)) return instance_error;
    if (!instance->continuous || !(states || indicators))
        return instance_fail(instance, function,
                             instance->continuous ? "there is no place for an answer"
                                                  : "the instance is for co-simulation");
    if (states) *states = states_of(instance);
    if (indicators) *indicators = indicators_of(instance);
    return instance_ok;
}

enum instance_status instance_complete(struct instance *instance, const char *function, bool *event)
{
    if (!allows(instance, phase_continuous, function, NULL, 0, 0)) return instance_error;
    continuous_complete(instance->continuous, event);
    return instance_ok;
}

enum instance_status instance_update(struct instance *instance, const char *function,
                                     struct continuous_event *event)
{
    *event = (struct continuous_event){.ends = instance->stopped, .next = NAN};
    if (!instance->continuous) return instance_ok;
    if (!continuous_ready(instance->continuous) || !continuous_update(instance->continuous, event))
        return instance_fail(instance, function, instance->continuous->reason);
    instance->stopped = event->ends;
    return instance_ok;
}
