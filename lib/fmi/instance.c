/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fmi/instance.h"

#include <gsl/gsl_errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "base/diag.h"
#include "base/format.h"
#include "fbd_study.h"

const char *const log_category_names[log_categories] = {"logStatusError", "logStatusWarning", "logEvents"};

/* This binary contains its own copy of GSL; every status is checked. */
__attribute__((constructor)) static void prepare(void)
{
    gsl_set_error_handler_off();
}

/* ---- messages */

enum { longest_message = 700 };

/* Escape `#` as `##`, since `#` begins the reference of a variable in messages. */
static void double_hashes(const char *from, char *to, size_t room)
{
    size_t used = 0;
    for (; *from && used + 3 < room; from++) {
        to[used++] = *from;
        if (*from == '#') to[used++] = '#';
    }
    to[used] = '\0';
}

void instance_say(const struct instance *instance, enum instance_status status, enum log_category category,
                  const char *format, ...)
{
    char message[longest_message], escaped[longest_message];
    va_list args;
    if (!instance->log || !instance->logs[category]) return;
    va_start(args, format);
    format_list(message, sizeof message, format, args);
    va_end(args);
    double_hashes(message, escaped, sizeof escaped);
    instance->log(instance, status, log_category_names[category], escaped);
}

enum instance_status instance_fail(struct instance *instance, const char *function, const char *what)
{
    instance_say(instance, instance_error, log_error, "%s: %s", function, what);
    instance->phase = phase_terminated;
    return instance_error;
}

static const char *phase_name(enum phase phase)
{
    switch (phase) {
    case phase_instantiated: return "Instantiated";
    case phase_initialization: return "Initialization Mode";
    case phase_step: return "Step Mode";
    case phase_event: return "Event Mode";
    case phase_continuous: return "Continuous-Time Mode";
    default: return "Terminated";
    }
}

bool instance_allows(struct instance *instance, unsigned phases, const char *function)
{
    if (!instance) return false;
    if (phases & (unsigned)instance->phase) return true;
    instance_say(instance, instance_error, log_error, "%s: not allowed in the state %s", function,
                 phase_name(instance->phase));
    instance->phase = phase_terminated;
    return false;
}

enum instance_status instance_set_logging(struct instance *instance, bool on, size_t count,
                                          const char *const categories[])
{
    if (count > 0 && !categories)
        return instance_fail(instance, "SetDebugLogging", "there are no categories");
    for (int k = 0; count == 0 && k < log_categories; k++) instance->logs[k] = on;
    for (size_t i = 0; i < count; i++) {
        int k = 0;
        while (k < log_categories && categories[i] && strcmp(categories[i], log_category_names[k]) != 0) k++;
        if (k == log_categories || !categories[i])
            return instance_fail(instance, "SetDebugLogging", "there is no such category");
        instance->logs[k] = on;
    }
    return instance_ok;
}

/* ---- opening */

static void say_notes(const struct instance *instance, fbd_errors *errors)
{
    const fbd_error *note;
    for (size_t i = 0; (note = diag_get(errors, i)) != NULL; i++) {
        bool error = note->severity == FBD_ERROR;
        enum instance_status status = error ? instance_error : instance_warning;
        enum log_category category = error ? log_error : log_warning;
        const char *file = note->file ? note->file : "model.yaml";
        if (note->line > 0)
            instance_say(instance, status, category, "%s:%d:%d: %s", file, note->line, note->column,
                         note->message);
        else
            instance_say(instance, status, category, "%s: %s", file, note->message);
    }
}

static bool is_own_token(const struct instance *instance, const char *token)
{
    if (strcmp(token, instance->plant->token) == 0) return true;
    instance_say(instance, instance_error, log_error,
                 "the token is not that of the resources: model and description are not of one FMU");
    return false;
}

bool instance_open(struct instance *instance, const char *name, const char *resources, const char *token)
{
    instance->phase = phase_instantiated;
    instance->name = strdup(name ? name : "");
    fbd_errors *errors = fbd_errors_new();
    if (instance->name && errors && resources) instance->plant = plant_open(resources, errors);
    if (errors) say_notes(instance, errors);
    if (!errors || !instance->name)
        instance_say(instance, instance_error, log_error, "Instantiate: out of memory");
    fbd_errors_free(errors);
    if (!resources) instance_say(instance, instance_error, log_error, "there is no path of the resources");
    if (instance->plant && token && is_own_token(instance, token)) return true;
    if (!token) instance_say(instance, instance_error, log_error, "there is no token");
    instance_close(instance);
    return false;
}

bool instance_open_exchange(struct instance *instance, const char *name, const char *resources,
                            const char *token)
{
    if (!instance_open(instance, name, resources, token)) return false;
    const struct extras *extras = &instance->plant->extras;
    if (!extras->exchanges)
        instance_say(instance, instance_error, log_error, "this FMU is for co-simulation only: %s",
                     extras->why);
    if (extras->exchanges) instance->continuous = continuous_new(instance->plant);
    if (instance->continuous) return true;
    instance_close(instance);
    return false;
}

void instance_close(struct instance *instance)
{
    continuous_free(instance->continuous);
    instance->continuous = NULL;
    plant_close(instance->plant);
    free(instance->name);
    instance->plant = NULL;
    instance->name = NULL;
}

/* ---- life cycle */

enum instance_status instance_initialize(struct instance *instance, double start, double stop,
                                         double tolerance)
{
    if (!isfinite(start) || stop < start || isinf(stop))
        return instance_fail(instance, "EnterInitializationMode", "start or stop time makes no sense");
    if (!(tolerance >= 0 && tolerance < 1))
        return instance_fail(instance, "EnterInitializationMode", "the tolerance makes no sense");
    plant_begin(instance->plant, start, stop, tolerance);
    if (instance->continuous) continuous_drop(instance->continuous);
    instance->stopped = false;
    instance->phase = phase_initialization;
    return instance_ok;
}

/* Make the motion consistent with the values that have been set. */
static bool update(struct instance *instance, const char *function)
{
    struct continuous *continuous = instance->continuous;
    if (continuous ? continuous_ready(continuous) : plant_update(instance->plant)) return true;
    instance_fail(instance, function, continuous ? continuous->reason : instance->plant->reason);
    return false;
}

enum instance_status instance_begin(struct instance *instance)
{
    if (!update(instance, "ExitInitializationMode")) return instance_error;
    instance->phase = instance->event_mode || instance->continuous ? phase_event : phase_step;
    return instance_ok;
}

enum instance_status instance_reset(struct instance *instance)
{
    plant_reset(instance->plant);
    if (instance->continuous) continuous_drop(instance->continuous);
    instance->stopped = false;
    instance->phase = phase_instantiated;
    return instance_ok;
}

/* ---- values */

enum instance_status instance_get(struct instance *instance, const char *function, const unsigned *references,
                                  size_t count, double *values)
{
    struct plant *plant = instance->plant;
    if (count > 0 && (!references || !values))
        return instance_fail(instance, function, "there is no place for values");
    for (size_t i = 0; i < count; i++)
        if (references[i] >= plant_variable_count(plant))
            return instance_fail(instance, function, "there is no such variable");
    if (count > 0 && !update(instance, function)) return instance_error;
    for (size_t i = 0; i < count; i++) {
        const bool exchanged = instance->continuous && !plant_is_given(plant, references[i]);
        if (exchanged)
            values[i] = continuous_value(instance->continuous, references[i]);
        else if (!plant_get(plant, references[i], &values[i]))
            return instance_fail(instance, function, plant->reason);
    }
    return instance_ok;
}

static const char *why_not_set(const struct instance *instance, unsigned reference, double value)
{
    const fbd_model *model = instance->plant->first;
    const fbd_variable variable = fbd_model_variable(model, reference);
    if (reference >= plant_variable_count(instance->plant)) return "there is no such variable";
    if (!variable.name) return "only parameters and inputs can be set";
    enum fmi_causality kind = package_causality(model, &variable);
    bool parameter = kind == fmi_parameter;
    if (!parameter && kind != fmi_input) return "only parameters and inputs can be set";
    if (parameter && !(instance->phase & (phase_instantiated | phase_initialization)))
        return "parameters are fixed once the motion has begun";
    return isfinite(value) ? NULL : "the value is not finite";
}

/* Parameters belong to the start, which is made again; inputs do not. */
static void set_one(struct instance *instance, unsigned reference, double value)
{
    const size_t parameter = fbd_model_variable(instance->plant->first, reference).index;
    plant_set(instance->plant, parameter, value);
    if (!instance->continuous) return;
    if (instance->phase & (phase_instantiated | phase_initialization))
        continuous_drop(instance->continuous);
    else
        continuous_set_input(instance->continuous, parameter, value);
}

enum instance_status instance_set(struct instance *instance, const char *function, const unsigned *references,
                                  size_t count, const double *values)
{
    if (count > 0 && (!references || !values))
        return instance_fail(instance, function, "there are no values");
    for (size_t i = 0; i < count; i++) {
        const char *why = why_not_set(instance, references[i], values[i]);
        if (why) return instance_fail(instance, function, why);
    }
    for (size_t i = 0; i < count; i++) set_one(instance, references[i], values[i]);
    return instance_ok;
}

/* ---- a step */

/* True if two times agree to rounding. */
static bool is_time(double t, double other, double size)
{
    const double rounding = 1e-9;
    return fabs(t - other) <= rounding * fmax(fabs(size), fmax(fabs(t), fabs(other)));
}

static const char *why_no_step(const struct instance *instance, double t, double h)
{
    const double rounding = 1e-9;
    const struct plant *plant = instance->plant;
    if (!isfinite(t) || !(h > 0) || isinf(h)) return "the communication step makes no sense";
    if (instance->stopped) return "an event of the model has ended the simulation";
    if (!is_time(t, plant->t, h)) return "the communication point is not where the last step has ended";
    if (t + h > plant->stop && !is_time(t + h, plant->stop, rounding * h))
        return "the step goes beyond the stop time";
    return NULL;
}

static void log_step_events(const struct instance *instance, double from)
{
    fbd_simulation *simulation = instance->plant->simulation;
    size_t count = fbd_simulation_event_count(simulation), first = count;
    if (!instance->logs[log_events]) return;
    while (first > 0 && fbd_simulation_event(simulation, first - 1).t > from) first--;
    for (size_t i = first; i < count; i++) {
        fbd_event event = fbd_simulation_event(simulation, i);
        if (event.t > instance->plant->t) break;
        instance_say(instance, instance_ok, log_events, "t = %.9g s: %s %s %s", event.t,
                     fbd_event_kind_name(event.kind), event.body[0] ? event.body : event.name, event.detail);
    }
}

/* Check the energy balance: if it is violated, the result is not a motion of the model, whatever the error
 * estimates. */
static bool step_balances(struct instance *instance)
{
    double residual, explained;
    char why[200];
    if (fbd_simulation_balanced(instance->plant->simulation, &residual, &explained)) return true;
    format_into(
        why, sizeof why,
        "the motion is not accurate: the residual of its energy is %.2g, where the tolerance explains "
        "%.2g; steps have gone over something much shorter than they are",
        residual, explained);
    instance_fail(instance, "DoStep", why);
    return false;
}

enum instance_status instance_step(struct instance *instance, double t, double h, struct instance_step *step)
{
    struct plant *plant = instance->plant;
    const char *why = why_no_step(instance, t, h);
    *step = (struct instance_step){.reached = plant->t};
    if (why) return instance_fail(instance, "DoStep", why);
    double before = plant->t, target = fmax(t + h, before);
    if (target > plant->stop) target = plant->stop;
    enum plant_step end = plant_step(plant, target, instance->event_mode && instance->early_return);
    if (end == plant_failed) return instance_fail(instance, "DoStep", plant->reason);
    if (!step_balances(instance)) return instance_error;
    log_step_events(instance, before);
    step->reached = plant->t;
    step->early = plant->t < target && instance->early_return;
    step->event = end == plant_event && instance->event_mode;
    instance->stopped = step->terminate = end == plant_stopped;
    return instance_ok;
}
