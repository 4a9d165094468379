/* SPDX-License-Identifier: GPL-3.0-or-later
 *
 * The C interface of FMI 3.0.2, as declared in its specification (sections 2.2.1 to 2.3.8, 3.2 and 4.2). With
 * FBD_FMI_HEADERS the published headers are used instead: a test compiles both.
 */
#ifndef FBD_FMI_FMI3_H
#define FBD_FMI_FMI3_H

#ifdef FBD_FMI_HEADERS
#include <fmi3Functions.h>
#else

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef void *fmi3Instance, *fmi3InstanceEnvironment, *fmi3FMUState;
typedef uint32_t fmi3ValueReference;

typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean, fmi3Clock;
typedef const char *fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte *fmi3Binary;

#define fmi3True  true
#define fmi3False false

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum {
    fmi3Independent,
    fmi3Constant,
    fmi3Fixed,
    fmi3Tunable,
    fmi3Discrete,
    fmi3Dependent
} fmi3DependencyKind;
typedef enum { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged } fmi3IntervalQualifier;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String category,
                                       fmi3String message);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64, fmi3Boolean, fmi3Boolean,
                                               fmi3Boolean, fmi3Boolean, fmi3Boolean *, fmi3Float64 *);
typedef void (*fmi3LockPreemptionCallback)(void);
typedef void (*fmi3UnlockPreemptionCallback)(void);

#define FMI3 __attribute__((visibility("default")))

/* ---- life */

FMI3 const char *fmi3GetVersion(void);
FMI3 fmi3Status fmi3SetDebugLogging(fmi3Instance, fmi3Boolean on, size_t count,
                                    const fmi3String categories[]);
FMI3 fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                               fmi3Boolean visible, fmi3Boolean logging,
                                               fmi3InstanceEnvironment, fmi3LogMessageCallback);
FMI3 fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                              fmi3Boolean visible, fmi3Boolean logging,
                                              fmi3Boolean event_mode, fmi3Boolean early_return,
                                              const fmi3ValueReference intermediate[],
                                              size_t intermediate_count, fmi3InstanceEnvironment,
                                              fmi3LogMessageCallback, fmi3IntermediateUpdateCallback);
FMI3 fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String resources,
                                                    fmi3Boolean visible, fmi3Boolean logging,
                                                    fmi3InstanceEnvironment, fmi3LogMessageCallback,
                                                    fmi3ClockUpdateCallback, fmi3LockPreemptionCallback,
                                                    fmi3UnlockPreemptionCallback);
FMI3 void fmi3FreeInstance(fmi3Instance);
FMI3 fmi3Status fmi3EnterInitializationMode(fmi3Instance, fmi3Boolean has_tolerance, fmi3Float64 tolerance,
                                            fmi3Float64 start, fmi3Boolean has_stop, fmi3Float64 stop);
FMI3 fmi3Status fmi3ExitInitializationMode(fmi3Instance);
FMI3 fmi3Status fmi3EnterEventMode(fmi3Instance);
FMI3 fmi3Status fmi3EnterStepMode(fmi3Instance);
FMI3 fmi3Status fmi3Terminate(fmi3Instance);
FMI3 fmi3Status fmi3Reset(fmi3Instance);
FMI3 fmi3Status fmi3DoStep(fmi3Instance, fmi3Float64 t, fmi3Float64 h, fmi3Boolean never_back,
                           fmi3Boolean *event, fmi3Boolean *terminate, fmi3Boolean *early,
                           fmi3Float64 *reached);
FMI3 fmi3Status fmi3UpdateDiscreteStates(fmi3Instance, fmi3Boolean *again, fmi3Boolean *terminate,
                                         fmi3Boolean *nominals, fmi3Boolean *values, fmi3Boolean *has_next,
                                         fmi3Float64 *next);

/* ---- values */

#define FMI3_VALUES(Type)                                                                                    \
    FMI3 fmi3Status fmi3Get##Type(fmi3Instance, const fmi3ValueReference[], size_t, fmi3##Type[], size_t);   \
    FMI3 fmi3Status fmi3Set##Type(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3##Type[],      \
                                  size_t)

FMI3_VALUES(Float32);
FMI3_VALUES(Float64);
FMI3_VALUES(Int8);
FMI3_VALUES(UInt8);
FMI3_VALUES(Int16);
FMI3_VALUES(UInt16);
FMI3_VALUES(Int32);
FMI3_VALUES(UInt32);
FMI3_VALUES(Int64);
FMI3_VALUES(UInt64);
FMI3_VALUES(Boolean);
FMI3_VALUES(String);
FMI3 fmi3Status fmi3GetBinary(fmi3Instance, const fmi3ValueReference[], size_t, size_t sizes[], fmi3Binary[],
                              size_t);
FMI3 fmi3Status fmi3SetBinary(fmi3Instance, const fmi3ValueReference[], size_t, const size_t sizes[],
                              const fmi3Binary[], size_t);
FMI3 fmi3Status fmi3GetClock(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Clock[]);
FMI3 fmi3Status fmi3SetClock(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Clock[]);

/* ---- states and derivatives */

FMI3 fmi3Status fmi3GetFMUState(fmi3Instance, fmi3FMUState *);
FMI3 fmi3Status fmi3SetFMUState(fmi3Instance, fmi3FMUState);
FMI3 fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState *);
FMI3 fmi3Status fmi3SerializedFMUStateSize(fmi3Instance, fmi3FMUState, size_t *);
FMI3 fmi3Status fmi3SerializeFMUState(fmi3Instance, fmi3FMUState, fmi3Byte[], size_t);
FMI3 fmi3Status fmi3DeserializeFMUState(fmi3Instance, const fmi3Byte[], size_t, fmi3FMUState *);
FMI3 fmi3Status fmi3GetDirectionalDerivative(fmi3Instance, const fmi3ValueReference unknowns[], size_t,
                                             const fmi3ValueReference knowns[], size_t,
                                             const fmi3Float64 seed[], size_t, fmi3Float64 sensitivity[],
                                             size_t);
FMI3 fmi3Status fmi3GetAdjointDerivative(fmi3Instance, const fmi3ValueReference unknowns[], size_t,
                                         const fmi3ValueReference knowns[], size_t, const fmi3Float64 seed[],
                                         size_t, fmi3Float64 sensitivity[], size_t);
FMI3 fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance, fmi3ValueReference, size_t *);
FMI3 fmi3Status fmi3GetVariableDependencies(fmi3Instance, fmi3ValueReference, size_t[], fmi3ValueReference[],
                                            size_t[], fmi3DependencyKind[], size_t);
FMI3 fmi3Status fmi3GetOutputDerivatives(fmi3Instance, const fmi3ValueReference[], size_t,
                                         const fmi3Int32 orders[], fmi3Float64[], size_t);

/* ---- functions not supported by this FMU */

FMI3 fmi3Status fmi3EnterConfigurationMode(fmi3Instance);
FMI3 fmi3Status fmi3ExitConfigurationMode(fmi3Instance);
FMI3 fmi3Status fmi3GetIntervalDecimal(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Float64[],
                                       fmi3IntervalQualifier[]);
FMI3 fmi3Status fmi3GetIntervalFraction(fmi3Instance, const fmi3ValueReference[], size_t, fmi3UInt64[],
                                        fmi3UInt64[], fmi3IntervalQualifier[]);
FMI3 fmi3Status fmi3GetShiftDecimal(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Float64[]);
FMI3 fmi3Status fmi3GetShiftFraction(fmi3Instance, const fmi3ValueReference[], size_t, fmi3UInt64[],
                                     fmi3UInt64[]);
FMI3 fmi3Status fmi3SetIntervalDecimal(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Float64[]);
FMI3 fmi3Status fmi3SetIntervalFraction(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                                        const fmi3UInt64[]);
FMI3 fmi3Status fmi3SetShiftDecimal(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3Float64[]);
FMI3 fmi3Status fmi3SetShiftFraction(fmi3Instance, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                                     const fmi3UInt64[]);
FMI3 fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance);
FMI3 fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance);
FMI3 fmi3Status fmi3CompletedIntegratorStep(fmi3Instance, fmi3Boolean, fmi3Boolean *, fmi3Boolean *);
FMI3 fmi3Status fmi3SetTime(fmi3Instance, fmi3Float64);
FMI3 fmi3Status fmi3SetContinuousStates(fmi3Instance, const fmi3Float64[], size_t);
FMI3 fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance, fmi3Float64[], size_t);
FMI3 fmi3Status fmi3GetEventIndicators(fmi3Instance, fmi3Float64[], size_t);
FMI3 fmi3Status fmi3GetContinuousStates(fmi3Instance, fmi3Float64[], size_t);
FMI3 fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance, fmi3Float64[], size_t);
FMI3 fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance, size_t *);
FMI3 fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance, size_t *);
FMI3 fmi3Status fmi3ActivateModelPartition(fmi3Instance, fmi3ValueReference, fmi3Float64);

#endif
#endif
