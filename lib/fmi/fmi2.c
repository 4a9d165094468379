/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * FMI 2.0: life cycle, values, co-simulation. A step ended by an event of the file is discarded, as the standard requires: the
 * importer queries fmi2GetBooleanStatus whether the FMU has terminated, and fmi2GetRealStatus for the time.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi/derivative.h"
#include "fmi/fmi2.h"
#include "fmi/instance.h"

/* NOLINTBEGIN(readability-non-const-parameter): the standard dictates the parameters. */

const char *fmi2GetTypesPlatform(void)
{
    return "default";
}

const char *fmi2GetVersion(void)
{
    return "2.0";
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean on, size_t count,
                               const fmi2String categories[])
{
    if (!instance_allows(component, phase_any, "fmi2SetDebugLogging")) return fmi2Error;
    return (fmi2Status)instance_set_logging(component, on != 0, count, categories);
}

/* ---- instantiation */

static void log_message(const struct instance *instance, enum instance_status status, const char *category,
                        const char *message)
{
    fmi2CallbackLogger logger = (fmi2CallbackLogger)instance->callback;
    if (logger)
        logger(instance->environment, instance->name ? instance->name : "", (fmi2Status)status, category,
               "%s", message);
}

static int hexadecimal(char c)
{
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* The folder of a URI `file:///tmp/a%20b/resources`, to be freed; NULL for another URI, or when memory is
 * out. */
static char *folder_of(const char *uri)
{
    if (!uri || strncmp(uri, "file:", 5) != 0) return NULL;
    const char *path = uri + 5;
    if (strncmp(path, "//", 2) == 0) path = strchr(path + 2, '/');
    char *folder = path ? malloc(strlen(path) + 1) : NULL, *to = folder;
    for (; folder && *path; path++) {
        bool coded = path[0] == '%' && hexadecimal(path[1]) >= 0 && hexadecimal(path[2]) >= 0;
        *to++ = coded ? (char)(16 * hexadecimal(path[1]) + hexadecimal(path[2])) : *path;
        if (coded) path += 2;
    }
    if (folder) *to = '\0';
    return folder;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    (void)visible;
    struct instance *instance = calloc(1, sizeof *instance);
    if (!instance) {
        if (functions && functions->logger && logging)
            functions->logger(functions->componentEnvironment, name ? name : "", fmi2Error,
                              log_category_names[log_error], "%s", "out of memory");
        return NULL;
    }
    instance->log = log_message;
    instance->callback = functions ? (void (*)(void))functions->logger : NULL;
    instance->environment = functions ? functions->componentEnvironment : NULL;
    for (int k = 0; k < log_categories; k++) instance->logs[k] = logging != 0;
    char *folder = folder_of(resources);
    bool opened = type == fmi2CoSimulation ? instance_open(instance, name, folder, guid)
                                           : instance_open_exchange(instance, name, folder, guid);
    free(folder);
    if (opened) return instance;
    free(instance);
    return NULL;
}

void fmi2FreeInstance(fmi2Component component)
{
    if (!component) return;
    instance_close(component);
    free(component);
}

/* ---- state machine */

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    if (!instance_allows(component, phase_instantiated, "fmi2SetupExperiment")) return fmi2Error;
    struct instance *instance = component;
    fmi2Status status = (fmi2Status)instance_initialize(instance, start, has_stop ? stop : NAN,
                                                        has_tolerance ? tolerance : 0);
    if (status == fmi2OK) instance->phase = phase_instantiated;
    return status;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component)
{
    if (!instance_allows(component, phase_instantiated, "fmi2EnterInitializationMode")) return fmi2Error;
    struct instance *instance = component;
    if (!instance->plant->running) return (fmi2Status)instance_initialize(instance, 0, NAN, 0);
    instance->phase = phase_initialization;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component)
{
    if (!instance_allows(component, phase_initialization, "fmi2ExitInitializationMode")) return fmi2Error;
    return (fmi2Status)instance_begin(component);
}

fmi2Status fmi2Terminate(fmi2Component component)
{
    if (!instance_allows(component, phase_running, "fmi2Terminate")) return fmi2Error;
    struct instance *instance = component;
    instance->phase = phase_terminated;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component component)
{
    if (!instance_allows(component, phase_any, "fmi2Reset")) return fmi2Error;
    return (fmi2Status)instance_reset(component);
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real t, fmi2Real h, fmi2Boolean never_back)
{
    (void)never_back;
    if (!instance_allows(component, phase_step, "fmi2DoStep")) return fmi2Error;
    struct instance_step step;
    fmi2Status status = (fmi2Status)instance_step(component, t, h, &step);
    bool ended = status == fmi2OK && step.terminate;
    if (ended)
        instance_say(component, instance_discard, log_error, "fmi2DoStep: an event of the model ends it");
    return ended ? fmi2Discard : status;
}

fmi2Status fmi2CancelStep(fmi2Component component)
{
    if (!component) return fmi2Error;
    return (fmi2Status)instance_fail(component, "fmi2CancelStep", "no step is under way");
}

/* ---- values */

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       fmi2Real values[])
{
    if (!instance_allows(component, phase_any, "fmi2GetReal")) return fmi2Error;
    return (fmi2Status)instance_get(component, "fmi2GetReal", references, count, values);
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    const unsigned phases = phase_any & ~(unsigned)phase_terminated;
    if (!instance_allows(component, phases, "fmi2SetReal")) return fmi2Error;
    return (fmi2Status)instance_set(component, "fmi2SetReal", references, count, values);
}

/* There are no variables of other types, and no derivatives of inputs or outputs. */
static fmi2Status none(struct instance *instance, const char *function, size_t count)
{
    if (!instance_allows(instance, phase_any, function)) return fmi2Error;
    return count == 0 ? fmi2OK : (fmi2Status)instance_fail(instance, function, "no variable has such values");
}

#define NONE(Type)                                                                                           \
    fmi2Status fmi2Get##Type(fmi2Component component, const fmi2ValueReference references[], size_t count,   \
                             fmi2##Type values[])                                                            \
    {                                                                                                        \
        (void)references, (void)values;                                                                      \
        return none(component, "fmi2Get" #Type, count);                                                      \
    }                                                                                                        \
    fmi2Status fmi2Set##Type(fmi2Component component, const fmi2ValueReference references[], size_t count,   \
                             const fmi2##Type values[])                                                      \
    {                                                                                                        \
        (void)references, (void)values;                                                                      \
        return none(component, "fmi2Set" #Type, count);                                                      \
    }

NONE(Integer)
NONE(Boolean)
NONE(String)

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference references[],
                                       size_t count, const fmi2Integer orders[], const fmi2Real values[])
{
    (void)references, (void)orders, (void)values;
    return none(component, "fmi2SetRealInputDerivatives", count);
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference references[],
                                        size_t count, const fmi2Integer orders[], fmi2Real values[])
{
    (void)references, (void)orders, (void)values;
    return none(component, "fmi2GetRealOutputDerivatives", count);
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference unknowns[],
                                        size_t unknown_count, const fmi2ValueReference knowns[],
                                        size_t known_count, const fmi2Real seed[], fmi2Real sensitivity[])
{
    const char *function = "fmi2GetDirectionalDerivative";
    if (!instance_allows(component, phase_begun, function)) return fmi2Error;
    struct derivative_call call = {function,    unknowns, unknown_count, knowns,
                                   known_count, seed,     sensitivity,   false};
    return (fmi2Status)derivative_get(component, &call);
}

/* ---- states */

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate *state)
{
    if (!instance_allows(component, phase_any, "fmi2GetFMUstate")) return fmi2Error;
    if (!state) return (fmi2Status)instance_fail(component, "fmi2GetFMUstate", "there is no place for it");
    struct saved *saved = *state;
    fmi2Status status = (fmi2Status)saved_get(component, &saved);
    *state = saved;
    return status;
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state)
{
    if (!instance_allows(component, phase_any, "fmi2SetFMUstate")) return fmi2Error;
    return (fmi2Status)saved_set(component, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate *state)
{
    if (!instance_allows(component, phase_any, "fmi2FreeFMUstate")) return fmi2Error;
    if (!state) return fmi2OK;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state, size_t *size)
{
    const char *function = "fmi2SerializedFMUstateSize";
    if (!instance_allows(component, phase_any, function)) return fmi2Error;
    if (!state || !size)
        return (fmi2Status)instance_fail(component, function, "there is no state, or no place for it");
    *size = saved_size(state);
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    const char *function = "fmi2SerializeFMUstate";
    if (!instance_allows(component, phase_any, function)) return fmi2Error;
    if (!state || !bytes || size < saved_size(state))
        return (fmi2Status)instance_fail(component, function, "there is no state, or no room for it");
    memcpy(bytes, saved_bytes(state), saved_size(state));
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    const char *function = "fmi2DeSerializeFMUstate";
    if (!instance_allows(component, phase_any, function)) return fmi2Error;
    struct saved *saved = state ? saved_from_bytes((const unsigned char *)bytes, size) : NULL;
    if (!saved) return (fmi2Status)instance_fail(component, function, "these bytes are no saved state");
    free(*state);
    *state = saved;
    return fmi2OK;
}

/* ---- status of the last step */

static fmi2Status unasked(struct instance *instance, const char *function, bool place)
{
    if (!instance) return fmi2Error;
    if (!place) return (fmi2Status)instance_fail(instance, function, "there is no place for an answer");
    return fmi2Discard; /* steps are not asynchronous: no other status exists */
}

fmi2Status fmi2GetStatus(fmi2Component component, fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind;
    return unasked(component, "fmi2GetStatus", value != NULL);
}

fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind, fmi2Real *value)
{
    struct instance *instance = component;
    if (!instance || !value || kind != fmi2LastSuccessfulTime)
        return unasked(instance, "fmi2GetRealStatus", value != NULL);
    *value = instance->plant->t;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind;
    return unasked(component, "fmi2GetIntegerStatus", value != NULL);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind, fmi2Boolean *value)
{
    struct instance *instance = component;
    if (!instance || !value || kind != fmi2Terminated)
        return unasked(instance, "fmi2GetBooleanStatus", value != NULL);
    *value = instance->stopped;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component component, fmi2StatusKind kind, fmi2String *value)
{
    (void)kind;
    return unasked(component, "fmi2GetStringStatus", value != NULL);
}

/* NOLINTEND(readability-non-const-parameter) */
