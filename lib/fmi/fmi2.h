/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The C interface of FMI 2.0.5, as declared in its specification (sections 2.1, 3.2 and 4.2).
 * With FBD_FMI_HEADERS the published headers are used instead.
 */
#ifndef FBD_FMI_FMI2_H
#define FBD_FMI_FMI2_H

#ifdef FBD_FMI_HEADERS
#include <fmi2Functions.h>
#else

#include <stddef.h>

typedef void *fmi2Component, *fmi2ComponentEnvironment, *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer, fmi2Boolean;
typedef char fmi2Byte;
typedef const char *fmi2String;

#define fmi2True  1
#define fmi2False 0

typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment, fmi2String name, fmi2Status, fmi2String category,
                                   fmi2String message, ...);
typedef void *(*fmi2CallbackAllocateMemory)(size_t, size_t);
typedef void (*fmi2CallbackFreeMemory)(void *);
typedef void (*fmi2StepFinished)(fmi2ComponentEnvironment, fmi2Status);

typedef struct {
    fmi2CallbackLogger logger;
    fmi2CallbackAllocateMemory allocateMemory;
    fmi2CallbackFreeMemory freeMemory;
    fmi2StepFinished stepFinished;
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

#define FMI2 __attribute__((visibility("default")))

/* ---- life */

FMI2 const char *fmi2GetTypesPlatform(void);
FMI2 const char *fmi2GetVersion(void);
FMI2 fmi2Status fmi2SetDebugLogging(fmi2Component, fmi2Boolean on, size_t count,
                                    const fmi2String categories[]);
FMI2 fmi2Component fmi2Instantiate(fmi2String name, fmi2Type, fmi2String guid, fmi2String resources,
                                   const fmi2CallbackFunctions *, fmi2Boolean visible, fmi2Boolean logging);
FMI2 void fmi2FreeInstance(fmi2Component);
FMI2 fmi2Status fmi2SetupExperiment(fmi2Component, fmi2Boolean has_tolerance, fmi2Real tolerance,
                                    fmi2Real start, fmi2Boolean has_stop, fmi2Real stop);
FMI2 fmi2Status fmi2EnterInitializationMode(fmi2Component);
FMI2 fmi2Status fmi2ExitInitializationMode(fmi2Component);
FMI2 fmi2Status fmi2Terminate(fmi2Component);
FMI2 fmi2Status fmi2Reset(fmi2Component);
FMI2 fmi2Status fmi2DoStep(fmi2Component, fmi2Real t, fmi2Real h, fmi2Boolean never_back);
FMI2 fmi2Status fmi2CancelStep(fmi2Component);

/* ---- values */

#define FMI2_VALUES(Type)                                                                                    \
    FMI2 fmi2Status fmi2Get##Type(fmi2Component, const fmi2ValueReference[], size_t, fmi2##Type[]);          \
    FMI2 fmi2Status fmi2Set##Type(fmi2Component, const fmi2ValueReference[], size_t, const fmi2##Type[])

FMI2_VALUES(Real);
FMI2_VALUES(Integer);
FMI2_VALUES(Boolean);
FMI2_VALUES(String);
FMI2 fmi2Status fmi2SetRealInputDerivatives(fmi2Component, const fmi2ValueReference[], size_t,
                                            const fmi2Integer[], const fmi2Real[]);
FMI2 fmi2Status fmi2GetRealOutputDerivatives(fmi2Component, const fmi2ValueReference[], size_t,
                                             const fmi2Integer[], fmi2Real[]);
FMI2 fmi2Status fmi2GetDirectionalDerivative(fmi2Component, const fmi2ValueReference unknowns[], size_t,
                                             const fmi2ValueReference knowns[], size_t, const fmi2Real seed[],
                                             fmi2Real sensitivity[]);

/* ---- states */

FMI2 fmi2Status fmi2GetFMUstate(fmi2Component, fmi2FMUstate *);
FMI2 fmi2Status fmi2SetFMUstate(fmi2Component, fmi2FMUstate);
FMI2 fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate *);
FMI2 fmi2Status fmi2SerializedFMUstateSize(fmi2Component, fmi2FMUstate, size_t *);
FMI2 fmi2Status fmi2SerializeFMUstate(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
FMI2 fmi2Status fmi2DeSerializeFMUstate(fmi2Component, const fmi2Byte[], size_t, fmi2FMUstate *);
FMI2 fmi2Status fmi2GetStatus(fmi2Component, fmi2StatusKind, fmi2Status *);
FMI2 fmi2Status fmi2GetRealStatus(fmi2Component, fmi2StatusKind, fmi2Real *);
FMI2 fmi2Status fmi2GetIntegerStatus(fmi2Component, fmi2StatusKind, fmi2Integer *);
FMI2 fmi2Status fmi2GetBooleanStatus(fmi2Component, fmi2StatusKind, fmi2Boolean *);
FMI2 fmi2Status fmi2GetStringStatus(fmi2Component, fmi2StatusKind, fmi2String *);

/* ---- model exchange */

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged,
        valuesOfContinuousStatesChanged, nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

FMI2 fmi2Status fmi2EnterEventMode(fmi2Component);
FMI2 fmi2Status fmi2NewDiscreteStates(fmi2Component, fmi2EventInfo *);
FMI2 fmi2Status fmi2EnterContinuousTimeMode(fmi2Component);
FMI2 fmi2Status fmi2CompletedIntegratorStep(fmi2Component, fmi2Boolean never_back, fmi2Boolean *event,
                                            fmi2Boolean *terminate);
FMI2 fmi2Status fmi2SetTime(fmi2Component, fmi2Real);
FMI2 fmi2Status fmi2SetContinuousStates(fmi2Component, const fmi2Real[], size_t);
FMI2 fmi2Status fmi2GetContinuousStates(fmi2Component, fmi2Real[], size_t);
FMI2 fmi2Status fmi2GetDerivatives(fmi2Component, fmi2Real[], size_t);
FMI2 fmi2Status fmi2GetEventIndicators(fmi2Component, fmi2Real[], size_t);
FMI2 fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component, fmi2Real[], size_t);

#endif
#endif
